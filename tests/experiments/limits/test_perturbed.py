"""About which rest a stepper is perturbed: that of springs, or of rods; and what is perturbed is a copy."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from engines.process.isolation import EngineStepper, in_this_process
from experiments.limits import limit_rows, perturbed, predictions
from experiments.limits.limit_rows import ADAPTS, Row
from experiments.limits.predictions import EnginesLimits, Predictions, limits_of_engines_elsewhere
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import SchemeStepper, stepper_named
from reference.theory.equilibria import pendulum_equilibrium, spring_equilibrium
from tests.conformance.doctored import Doctored

SYSTEM = find("string").system({"masses": 3})
REST = spring_equilibrium(SYSTEM)
ON_RODS = pendulum_equilibrium(SYSTEM)


def test_a_scheme_that_steps_rods_is_about_the_rest_of_rods() -> None:
    """Others are about that of the springs, the very one that is given; where there is none, it is said why."""
    of_rods = perturbed.rest_of_scheme(stepper_named("pendulum_rk4"), SYSTEM, REST)
    assert perturbed.rest_of_scheme(stepper_named("heun"), SYSTEM, REST) is REST
    assert not isinstance(of_rods, Limit)
    assert type(of_rods.motion) is type(ON_RODS.motion)
    cloth = find("cloth").system({"rows": 2, "columns": 2})
    none = perturbed.rest_of_scheme(stepper_named("pendulum_rk4"), cloth, spring_equilibrium(cloth))
    assert isinstance(none, Limit)
    assert none.reason.startswith("pendulum_rk4 has no rest to be predicted about: ")


@pytest.mark.parametrize(
    ("stretched", "claim", "springs"),
    [(True, "kick_drift", True), (True, "pendulum_rk4", False), (False, "kick_drift", False), (True, None, True)],
)
def test_an_engine_hangs_by_its_springs_if_it_can(
    stretched: bool, claim: str | None, springs: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One that cannot start with stretched springs, or takes them for rods, as a pendulum: which has to be a string."""
    monkeypatch.setattr(perturbed, "claimed", lambda _: claim and stepper_named(claim))
    engine = Doctored(capabilities=frozenset({"stretched"} if stretched else ()))
    found = perturbed.rest_of_engine(engine, SYSTEM, REST)
    assert (found is REST) == springs
    cloth = find("cloth").system({"rows": 2, "columns": 2})
    found = perturbed.rest_of_engine(engine, cloth, REST)
    assert (found is REST) == springs
    if not springs:
        assert isinstance(found, Outcome)
        assert "puts rods for springs, whose rest is not known here: " in found.reason


def test_what_is_perturbed_is_a_copy() -> None:
    """Every free mass is moved a little, the fixed one is not; the rest stays what it was."""
    before = REST.state.positions.copy()
    at_rest, moved = perturbed.perturbed(SYSTEM, REST)
    assert np.array_equal(REST.state.positions, before)
    assert np.array_equal(at_rest, before)
    offset = np.abs(moved.positions - before).max(axis=1)
    assert offset[0] == 0
    assert (offset[1:] > 0).all()
    assert offset.max() < 1e-3 * REST.scale


def test_a_scheme_on_rods_has_the_rates_of_rods() -> None:
    """Others those of the system, found once."""
    found = Predictions(SYSTEM, REST)
    assert found.unit == pytest.approx(1 / found.rates.fastest)
    for name, own in (("heun", False), ("pendulum_rk4", True)):
        stepper = stepper_named(name)
        about = found.about(stepper)
        assert not isinstance(about, Limit)
        assert (about[1] is not found.rates) == own


def test_one_engine_that_cannot_travel_keeps_all_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else another process is asked; what either finds on rods is known from then on."""
    monkeypatch.setattr(predictions, "_LIMITS_ON_RODS", {})
    key = cast(Any, "a scheme and a digest")
    monkeypatch.setattr(
        predictions, "limits_of_engines", lambda *_: EnginesLimits(cast(Any, "here"), {key: Limit(1.0)})
    )
    monkeypatch.setattr(predictions, "elsewhere", lambda *_: EnginesLimits(cast(Any, "elsewhere"), {key: Limit(2.0)}))
    travels, stays = EngineStepper(Doctored()), EngineStepper(Doctored(), isolate=in_this_process)
    for engines, where, limit in (((travels, travels), "elsewhere", 2.0), ((travels, stays), "here", 1.0)):
        runs = [(engine, Outcome("done")) for engine in engines]
        assert limits_of_engines_elsewhere(SYSTEM, runs) == where
        assert predictions._LIMITS_ON_RODS[key] == Limit(limit)


def test_a_row_tells_what_it_is_about_and_then_what_is_to_be_known() -> None:
    """After the reasons of both limits, which are told once where they are the same."""
    row = Row("heun", "own", SYSTEM, Limit(None, "one"), Limit(None, "other"), about="about", caveat="caveat")
    assert row.document["reason"] == "predicted: one; measured: other; about; caveat"
    same = Row("heun", "own", SYSTEM, Limit(None, "one"), Limit(None, "one"))
    assert same.document["reason"] == "predicted and measured: one"


@pytest.mark.parametrize(
    ("kind", "adapts", "said"), [("own", True, ADAPTS), ("own", False, ""), ("scheme", True, ""), ("scheme", False, "")]
)
def test_only_own_steppers_that_adapt_are_warned_of(
    kind: str, adapts: bool, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the lab's it is known what they are."""
    monkeypatch.setattr(limit_rows, "slopes_of", lambda *_: SimpleNamespace(adapts=adapts))
    assert limit_rows._caveat(cast(Any, SimpleNamespace(kind=kind))) == said


def test_a_scheme_s_row_has_its_limits_in_their_places(monkeypatch: pytest.MonkeyPatch) -> None:
    """Measured about the rest and the rates that it is predicted with; where there is no rest, why stands for both."""
    heun = stepper_named("heun")
    assert isinstance(heun, SchemeStepper)
    asked: list[Any] = []
    monkeypatch.setattr(limit_rows, "measured_mode_limit", lambda *given: (asked.append(given), Limit(0.4))[1])
    known: Any = SimpleNamespace(about=lambda _: ("rest", "rates"), of=lambda _: Limit(0.3))
    row = limit_rows._scheme_row(heun, SYSTEM, known)
    assert (row.predicted, row.measured) == (Limit(0.3), Limit(0.4))
    assert asked == [(heun.scheme, "rest", Limit(0.3), "rates")]
    none: Any = SimpleNamespace(about=lambda _: Limit(None, "no rest"), of=lambda _: Limit(0.3))
    row = limit_rows._scheme_row(heun, SYSTEM, none)
    assert (row.predicted, row.measured) == (Limit(None, "no rest"), Limit(None, "no rest"))


@pytest.mark.parametrize(
    ("predicted", "measured", "apart"),
    [
        (Limit(0.2), Limit(0.3), 0.5),
        (Limit(0.2), Limit(None, "none"), None),
        (Limit(None, "none"), Limit(0.3), None),
        (Limit(0.2, certainty="between", at_most=0.4), Limit(0.3), None),
        (Limit(0.2), Limit(0.3, certainty="between", at_most=0.4), None),
    ],
)
def test_limits_that_are_known_exactly_are_compared(predicted: Limit, measured: Limit, apart: float | None) -> None:
    """As a part of what was predicted."""
    found = Row("heun", "scheme", SYSTEM, predicted, measured).relative_difference
    assert found == (None if apart is None else pytest.approx(apart))
