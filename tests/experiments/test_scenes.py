"""The experiment `scenes`: every engine on a scene, identified over some steps or said why not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import scenes
from experiments.experiment import Result
from reference.identification import identify_run
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import catalogued


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
    return scenes.Run(scene, system, catalogued()[scheme], outcome, found, steps)


def of(*runs: scenes.Run) -> Result:
    """The experiment's answer for some runs."""
    return scenes.result_of(list(runs), {})


def test_the_findings_are_made_from_the_numbers() -> None:
    """Two identified, one a nanometre and more away; one unsupported, with its reason counted."""
    run = ran("string", "heun")
    cannot = replace(run, outcome=Outcome("unsupported", "heun cannot do flying"), compared=scenes.STEPS)
    away = ran("string", "kick_drift", shift=3e-9)
    found = " ".join(of(run, ran("spring", "kick_drift"), away, cannot).findings)
    assert (
        f"Of 3 engine runs of {scenes.STEPS} steps that meet no obstacle, 2 are a scheme of the catalogue to 1e-09 m"
        in found
    )
    assert "Not identified: kick_drift on string, " in found
    assert "1 of 4 runs are unsupported, for flying (1)." in found


def test_who_meets_an_obstacle_is_counted_apart() -> None:
    """The barrier's string reaches the circle after 200 steps, not before."""
    assert not ran("barrier", "heun", 200).met_obstacle
    late = ran("barrier", "heun", 600)
    assert late.met_obstacle
    assert "Of 1 engine runs that meet an obstacle 0 are" in " ".join(of(ran("string", "heun"), late).findings)


def test_without_engines_there_is_a_sentence() -> None:
    """Nothing ran."""
    assert of().findings == ["No engine ran on any scene that could be identified."]


def test_the_motion_shown_is_the_scenes_from_start_to_end() -> None:
    """At most so many states of it, the reference's to the bit."""
    setup = find("string").setup({})
    shown = scenes.motion(setup)
    whole = catalogued()["heun"].run(setup.system, setup.dt, round(setup.duration / setup.dt)).trajectory
    assert whole is not None
    assert len(shown) == scenes.STATES + 1
    assert np.array_equal(shown.positions[-1], whole.positions[-1])
    assert shown.times[-1] == pytest.approx(setup.duration)


def test_what_drives_a_scene_is_shown() -> None:
    """The truck of `crossing` bends the bridge: it rests at first, and is not where it was in the end."""
    shown = scenes.motion(find("crossing").setup({})).positions
    assert np.ptp(shown[:, :, 1], axis=0).max() > 1e-3
