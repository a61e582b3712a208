"""The experiment `scenes`: every engine on a scene, identified over some steps or said why not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.process.isolation import EngineStepper, in_this_process
from experiments import scenes
from experiments.experiment import Result
from reference.identification import identify_run
from reference.outcome import outcome_of
from reference.scenes import find
from reference.stepper import catalogued
from tests.conformance.doctored import Doctored


def ran(name: str, scheme: str, steps: int = scenes.STEPS, shift: float = 0.0) -> scenes.Run:
    """A run on a scene by kick-drift or another scheme, moved by a little [m], identified among those two and Heun."""
    scene = find(name)
    system = scene.system({})
    known = {s: catalogued()[s].run(system, scene.dt, steps) for s in {"kick_drift", "heun", scheme}}
    outcome = known[scheme]
    assert outcome.trajectory is not None
    moved = replace(outcome.trajectory, positions=outcome.trajectory.positions + shift)
    outcome = replace(outcome, trajectory=moved)
    trajectories = {s: o.trajectory for s, o in known.items() if o.trajectory is not None}
    found = identify_run(scheme, outcome, system, trajectories)
    return scenes.Run(scene, system, catalogued()[scheme], outcome, found)


def of(*runs: scenes.Run) -> Result:
    """The experiment's answer for some runs."""
    return scenes.result_of(list(runs), {})


def test_who_meets_an_obstacle_is_counted_apart() -> None:
    """The barrier's string reaches the circle after 200 steps, not before."""
    assert not ran("barrier", "heun", 200).met_obstacle
    late = ran("barrier", "heun", 600)
    assert late.met_obstacle
    assert "Of 1 engine runs that meet an obstacle 1 are" in " ".join(of(ran("string", "heun"), late).findings)


def test_every_engine_is_identified_on_every_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine of our own that is kick-drift, on two scenes, one after the other; and both scenes are shown."""
    engine = EngineStepper(Doctored(), isolate=in_this_process)
    monkeypatch.setattr(scenes, "installed_engines", lambda: [engine])
    monkeypatch.setattr(scenes, "scenes", lambda: {name: find(name) for name in ("string", "chain")})
    found = scenes.run(lambda _: None)
    (table,) = found.tables
    rows = [dict(zip(table.columns, row, strict=True)) for row in table.rows]
    assert [row["scene"] for row in rows] == ["string", "chain"]
    assert {row["identified as"] for row in rows} == {"kick_drift"}
    assert list(found.data["motions"]) == ["string", "chain"]


@pytest.mark.parametrize(("most", "steps"), [(None, 100), (23, 100), (22, 25), (11, 25)])
def test_an_engine_that_takes_long_on_so_many_masses_takes_fewer_steps(most: int | None, steps: int) -> None:
    """From half the masses on that it says are the most: the string has eleven."""
    engine = EngineStepper(Doctored(), isolate=in_this_process)
    object.__setattr__(engine.engine, "interactive_up_to", most)
    assert scenes.steps_of(engine, find("string").system({})) == steps


def test_runs_of_fewer_steps_are_told_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the table, and in the first finding; by one of two engines here, which is the same scheme in both."""
    monkeypatch.setattr(scenes, "steps_of", lambda stepper, _: 25 if stepper.name == "rk4" else 100)
    found = of(ran("string", "heun"), ran("string", "rk4", 25))
    assert "runs of 100 steps (1 of them of 25, as they take long)" in found.findings[0]
    (table,) = found.tables
    steps = table.columns.index("steps")
    assert [row[steps] for row in table.rows] == [100, 25]
    monkeypatch.undo()
    assert "runs of 100 steps that" in of(ran("string", "heun")).findings[0]


def test_the_motion_shown_is_the_scenes_from_start_to_end() -> None:
    """At most so many states of it, the reference's to the bit."""
    setup = find("string").setup({})
    shown = scenes.shown(find("string")).motion
    assert shown is not None
    whole = catalogued()["heun"].run(setup.system, setup.dt, round(setup.duration / setup.dt)).trajectory
    assert whole is not None
    assert len(shown) == scenes.STATES + 1
    assert np.array_equal(shown.positions[-1], whole.positions[-1])
    assert shown.times[-1] == pytest.approx(setup.duration)


def test_what_drives_a_scene_is_shown() -> None:
    """The truck of `crossing` bends the bridge: it rests at first, and is not where it was in the end."""
    shown = scenes.shown(find("crossing")).motion
    assert shown is not None
    assert np.ptp(shown.positions[:, :, 1], axis=0).max() > 1e-3


@pytest.mark.rotating(3)
@pytest.mark.parametrize("name", ["strip", "string"])
def test_a_scene_is_shown_by_a_run_that_is_done(name: str) -> None:
    """The strip's own dt of 0.1 ms is too long for Heun: half of it will do, and the end is that of a tenth of it.

    The energy of a run that is done is not more than it was given; Heun's own error there is 1e-8 m.
    """
    scene = find(name)
    shown = scenes.shown(scene)
    setup = scene.setup({})
    assert shown.motion is not None
    assert outcome_of(setup.system, shown.motion).ending == "done"
    assert (shown.dt < scene.dt) == bool(shown.failures)
    finer = scenes.shown(scene, scene.dt / 10).motion
    assert finer is not None
    assert shown.motion.positions[-1] == pytest.approx(finer.positions[-1], abs=1e-3 * setup.system.size)


def test_a_scene_that_blows_up_is_told_and_not_shown() -> None:
    """From 10 ms on no step that is tried is short enough: no picture, and the reasons."""
    lost = scenes.shown(find("strip"), 1e-2)
    assert lost.motion is None
    halved = scenes.shown(find("strip"))
    assert halved.dt == find("strip").dt / 2
    result = scenes.result_of([], {"strip": halved, "lost": lost})
    assert list(result.data["motions"]) == ["strip"]
    assert "5e-05 s" in " ".join(result.findings)
    assert len(result.failures) == 1 + len(lost.failures)
    assert "heun on strip, dt = 0.0001 s: diverged" in result.failures[0]
