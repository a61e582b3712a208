"""How an engine is started along a mode, and what is made of how the mode then grew; with no engine."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from engines.measured_limit import ModeRun, growths_along_modes
from experiments.limits import engine_limit
from experiments.limits.engine_limit import _unstable_at_any, _Watched, fastest_mode
from experiments.limits.predictions import Predictions
from reference.errors import SolverError
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import SchemeStepper, catalogued
from reference.theory.equilibria import spring_equilibrium
from reference.theory.measured_mode import FastestMode

SYSTEM = find("string").system({"masses": 3})
REST = spring_equilibrium(SYSTEM)
PREDICTIONS = Predictions(SYSTEM, REST)

#: By how much masses are perturbed [m].
SIZE = 1e-5


class Watch:
    """An engine that answers what it is told to, and remembers what it was asked."""

    def __init__(self, answer: Any) -> None:
        self.answer, self.asked = answer, []
        self.engine, self.time_limit = "the engine", 7.0

    def isolate(self, function: object, *arguments: Any, time_limit: float) -> Any:
        """See EngineStepper."""
        self.asked.append((function, *arguments, time_limit))
        return self.answer

    def watched(self) -> _Watched:
        """In the fastest mode of kick-drift."""
        scheme = catalogued()["kick_drift"]
        assert isinstance(scheme, SchemeStepper)
        return _Watched(cast(Any, self), PREDICTIONS, REST, scheme, SIZE)


def test_the_engine_is_started_at_rest_and_perturbed_along_the_mode() -> None:
    """No mass by more than the size, and one by just that; masses hang still, whatever they did in the scene."""
    watch = Watch({"growth": np.array([0.25, 0.5])})
    assert watch.watched().growths([1e-3, 2e-3]) == [0.25, 0.5]
    ((function, engine, at_rest, runs, limit),) = watch.asked
    assert (function, engine, limit) == (growths_along_modes, "the engine", 14.0)
    assert np.array_equal(at_rest.positions, REST.state.positions)
    assert not at_rest.velocities.any()
    assert [run.dt for run in runs] == [1e-3, 2e-3]
    for run in runs:
        moved = np.concatenate([run.positions, run.dt * run.velocities])
        assert np.abs(moved).max() == pytest.approx(SIZE, rel=1e-9)
        assert not run.positions[SYSTEM.fixed].any()


def test_one_run_without_a_mode_is_enough_to_say_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The engine is not asked then; where it fails, why it did is the answer."""
    watch = Watch(Outcome("crashed", "killed"))
    assert watch.watched().growths([1e-3]) == watch.answer
    known = engine_limit.fastest_mode
    monkeypatch.setattr(engine_limit, "fastest_mode", lambda *a: None if a[2] > 1.5e-3 else known(*a))
    watch.asked.clear()
    assert watch.watched().growths([1e-3, 2e-3]) is None
    assert not watch.asked


@pytest.mark.parametrize("error", [SolverError("no step"), np.linalg.LinAlgError("no values")])
def test_a_mode_that_cannot_be_found_is_none(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever it is that fails."""

    def fails(*_: object) -> FastestMode:
        raise error

    monkeypatch.setattr(engine_limit, "fastest_mode_of_step", fails)
    heun = catalogued()["heun"]
    assert isinstance(heun, SchemeStepper)
    assert fastest_mode(heun, REST, 1e-3, PREDICTIONS.rates) is None


@pytest.mark.parametrize(
    ("growths", "tells"),
    [([3e-3, 2e-3], True), ([3e-3, 1e-9], False), ([1e-9, 3e-3], False), ([1e-9, 1e-9], False)],
)
def test_growth_at_any_step_is_told_where_it_is_seen_at_all_that_were_tried(
    growths: Sequence[float], tells: bool
) -> None:
    """More than the margin; the growth told is that of the first."""
    found = _unstable_at_any(cast(Any, SimpleNamespace(predictions=PREDICTIONS, growths=lambda _: growths)), 1e-6)
    if tells:
        assert isinstance(found, Limit)
        assert found.growth == growths[0]
        assert found.dt is None
    else:
        assert found is None


@pytest.mark.parametrize("answer", [None, Outcome("timed out", "240 s")])
def test_what_is_no_growth_is_handed_on(answer: Outcome | None) -> None:
    """None where there is no mode, and an outcome where the engine failed."""
    watched = cast(Any, SimpleNamespace(predictions=PREDICTIONS, growths=lambda _: answer))
    assert _unstable_at_any(watched, 1e-6) is answer


def test_a_run_along_a_mode_has_what_it_is_measured_by() -> None:
    """The mode's left vector, which tells how much of it there is in a state."""
    run = Watch(None).watched()._mode_run(1e-3)
    assert isinstance(run, ModeRun)
    mode = fastest_mode(Watch(None).watched().scheme, REST, 1e-3, PREDICTIONS.rates)
    assert mode is not None
    assert np.array_equal(run.left, mode.left)
