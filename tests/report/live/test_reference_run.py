"""The true motion beside the lanes: followed as long as there is time, and it is said why it is not."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from reference.errors import SolverError
from reference.obstacles import Plane
from reference.scenes import find
from reference.state import Trajectory
from reference.system import MassSpringSystem
from reference.theory.exact import WHY_NOT_EXACT, exact
from report.live import reference_run
from report.live.reference_run import TOO_SLOW, ReferenceRun

SYSTEM = find("spring").system({})


def test_it_goes_on_as_the_true_motion_does_with_the_parameters_of_now() -> None:
    """By one piece after another, each from where the last one ended."""
    run, softer = ReferenceRun(SYSTEM), SYSTEM.with_parameter("stiffness", 50.0)
    assert run.why_not == ""
    wanted = SYSTEM.start
    for i, system in enumerate((SYSTEM, SYSTEM, softer)):
        run.advance(system, 0.01)
        motion = exact(replace(system, positions=wanted.positions, velocities=wanted.velocities), 0.01, 1)
        wanted = replace(wanted, positions=motion.positions[-1], velocities=motion.velocities[-1])
        assert run.state is not None
        assert run.state.time == pytest.approx(0.01 * (i + 1))
        assert run.state.positions == pytest.approx(wanted.positions, abs=1e-9)
        assert run.state.velocities == pytest.approx(wanted.velocities, abs=1e-7)
    assert not np.allclose(wanted.positions, SYSTEM.positions)


def test_on_obstacles_there_is_none() -> None:
    """And that is said, whatever time goes by."""
    run = ReferenceRun(replace(SYSTEM, obstacles=(Plane((0.0, -9.0), (0.0, 1.0)),)))
    run.advance(SYSTEM, 0.01)
    assert (run.state, run.why_not) == (None, WHY_NOT_EXACT)


def test_what_the_solver_cannot_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """In its own words."""

    def fails(*_: object, **__: object) -> Trajectory:
        raise SolverError("it is too stiff")

    monkeypatch.setattr(reference_run, "exact", fails)
    run = ReferenceRun(SYSTEM)
    run.advance(SYSTEM, 0.01)
    assert (run.state, run.why_not) == (None, "it is too stiff")


@pytest.mark.parametrize(("seconds", "frames"), [(0.015, None), (0.05, 10), (0.1, 5), (7.0, 5)])
def test_it_is_given_up_where_it_takes_too_long(
    seconds: float, frames: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """20 ms a frame on average, of some twenty; no single frame counts for more than 0.1 s."""
    clock = [0.0]

    def slow(system: MassSpringSystem, duration: float, *_: object, **__: object) -> Trajectory:
        clock[0] += seconds
        return Trajectory.of([system.start])

    monkeypatch.setattr(reference_run, "exact", slow)
    monkeypatch.setattr(reference_run, "time", SimpleNamespace(perf_counter=lambda: clock[0]))
    run, took = ReferenceRun(SYSTEM), None
    for frame in range(1, 200):
        run.advance(SYSTEM, 0.01)
        if run.state is None:
            took = frame
            break
    assert took == frames
    assert run.why_not == ("" if frames is None else TOO_SLOW)
