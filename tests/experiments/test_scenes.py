"""The experiment `scenes`: every engine on a scene, identified over some steps or said why not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import scenes
from experiments.experiment import Result
from reference.identification import identify_run
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
