"""Engines are identified, and their limits predicted, in another process than this one where that can be."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from engines.process.isolation import EngineStepper, in_this_process
from experiments.limits import predictions
from experiments.limits.predictions import Predictions, limits_of_engines, limits_of_engines_elsewhere
from reference.identification import Identification
from reference.identification.result import Match
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from reference.theory.equilibria import spring_equilibrium
from tests.conformance.doctored import Doctored

SYSTEM = find("string").system({"masses": 2, "gravity": 0.0})

#: An engine of our own, which is kick-drift.
ENGINE = EngineStepper(Doctored())


def runs_of(engine: EngineStepper) -> list[tuple[EngineStepper, Outcome]]:
    """What an engine is identified from."""
    return [(engine, Predictions(SYSTEM, spring_equilibrium(SYSTEM)).identifying_run(engine))]


def fails(*_: object) -> None:
    """In place of what must not be called."""
    raise AssertionError("called here")


@pytest.mark.rotating(3, in_turn=True)
def test_engines_are_predicted_in_another_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is replaced here is not replaced there, and the answer is kick-drift's limit, dt = 2 / w.

    Of two masses that hang on two springs of stiffness k the fastest mode has w^2 = (3 + 5^(1/2)) / 2 k / m, the larger
    eigenvalue of ((2, -1), (-1, 1)) k / m.
    """
    runs = runs_of(ENGINE)
    monkeypatch.setattr(Predictions, "identified", fails)
    ((found, limit),) = limits_of_engines_elsewhere(SYSTEM, runs)
    assert found.identified_as == "kick_drift"
    fastest = math.sqrt((3 + math.sqrt(5)) / 2 * SYSTEM.stiffness[0] / SYSTEM.masses[-1])
    assert limit.dt == pytest.approx(2 / fastest, rel=1e-8)
    with pytest.raises(AssertionError, match="called here"):
        limits_of_engines(SYSTEM, runs, {})


@pytest.mark.rotating(3, in_turn=True)
def test_a_stepper_that_cannot_travel_is_predicted_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """As one that runs in this process."""
    runs = runs_of(replace(ENGINE, isolate=in_this_process))
    monkeypatch.setattr(predictions, "elsewhere", fails)
    assert [found.identified_as for found, _ in limits_of_engines_elsewhere(SYSTEM, runs)] == ["kick_drift"]


def test_no_process_is_asked_about_no_engines(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where schemes alone are asked for."""
    monkeypatch.setattr(predictions, "elsewhere", fails)
    assert limits_of_engines_elsewhere(SYSTEM, []) == []


def test_limits_on_rods_are_found_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of systems that differ in stiffness and damping only; what is found is told, and need not be found again."""
    hanging = find("string").system({"masses": 2})
    pendulum = Identification(ENGINE.name, (Match("pendulum_rk4", 0.0, 0.0, 200),), 1e-9)
    monkeypatch.setattr(Predictions, "identified", lambda *_: {ENGINE.name: pendulum})
    monkeypatch.setattr(predictions, "_LIMITS_ON_RODS", {})
    monkeypatch.setattr(predictions, "stability_limit", lambda *_: Limit(0.25))
    found = limits_of_engines(hanging, [(ENGINE, Outcome("done"))], {})
    assert [*found.each] == [(pendulum, Limit(0.25))]
    monkeypatch.setattr(predictions, "_LIMITS_ON_RODS", {})
    monkeypatch.setattr(predictions, "stability_limit", fails)
    stiffer = find("string").system({"masses": 2, "stiffness": 500.0, "damping": 0.1})
    assert [*limits_of_engines(stiffer, [(ENGINE, Outcome("done"))], found.on_rods).each] == [(pendulum, Limit(0.25))]
    heavier = find("string").system({"masses": 2, "drag": 0.1})
    with pytest.raises(AssertionError, match="called here"):
        limits_of_engines(heavier, [(ENGINE, Outcome("done"))], found.on_rods)
