"""Where along a mode an engine's limit is looked for and found: with growth made by hand, and no engine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf, nan
from types import SimpleNamespace
from typing import Any, cast

import pytest

from experiments.limits import engine_limit
from experiments.limits.engine_limit import CERTAIN, MARGIN, PRECISION, _first_unstable, measure_engine
from reference.forces import SpringMotion
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from tests.conformance.doctored import Doctored

SYSTEM = find("string").system({"masses": 2})

#: As long as the fastest mode lasts [s].
UNIT = 0.01


class Case:
    """An engine whose mode grows by a function of dt [s], and what is said of it before."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, grows: Callable[[float], float], beyond: float = 1.0) -> None:
        self.asked: list[float] = []
        self.scheme = SimpleNamespace(on_rods=False, scheme=SimpleNamespace(iterated=False))
        self.stepper = SimpleNamespace(version="1", engine=Doctored(), time_limit=10.0)
        rest = SimpleNamespace(motion=SpringMotion(SYSTEM), scale=1.0)
        self.predictions = SimpleNamespace(system=SYSTEM, rest=rest, rates=None, unit=UNIT)
        self.size = 10

        def growths(watched: object, steps: Sequence[float]) -> list[float]:
            self.asked += steps
            return [grows(dt) for dt in steps]

        monkeypatch.setattr(engine_limit._Watched, "growths", growths)
        monkeypatch.setattr(engine_limit, "rest_of_engine", lambda engine, system, rest: rest)
        monkeypatch.setattr(engine_limit, "layout_of", lambda *_: (SimpleNamespace(size=self.size), None))
        monkeypatch.setattr(engine_limit, "fastest_mode", lambda *_: SimpleNamespace(growth=beyond))
        monkeypatch.setattr(engine_limit, "measure_at_random", self.at_random)

    def at_random(self, *_: object, expected: float | None) -> str:
        """As measured from a random perturbation, where a limit is expected."""
        self.expected = expected
        return "at random"

    def limit(self, predicted: Limit, scheme: bool = True) -> Any:
        """What is measured."""
        known = cast(Any, self.scheme) if scheme else None
        return measure_engine(cast(Any, self.stepper), cast(Any, self.predictions), known, predicted)


@pytest.mark.parametrize("true", [1.0, 1.00005, 0.9999, 1.0042, 0.98, 1.03, 0.92])
def test_a_limit_is_found_to_a_ten_thousandth_wherever_it_is_near(true: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """As far as a tenth from what is predicted, by four runs where it is right there; and what growth is beside it."""
    limit = 0.02 * true
    case = Case(monkeypatch, lambda dt: max(0.0, 3 * (dt / limit - 1) - 1e-12) + 1e-12)
    found = case.limit(Limit(0.02))
    assert found.dt == pytest.approx(limit, rel=PRECISION)
    assert found.grows_beyond is True
    below, above = (max(0.0, 3 * (0.02 * (1 + PRECISION) ** n / limit - 1)) for n in (-100, 100))
    assert found.factors == (pytest.approx(1 + below, abs=1e-3), pytest.approx(1 + above, abs=1e-3))
    near = 0.99 < true < 1.01
    assert min(case.asked) / 0.02 == pytest.approx(0.99 if near else 0.905, abs=2e-3)
    assert max(case.asked) / 0.02 == pytest.approx(1.01 if near else 1.105, abs=2e-3)
    assert len(case.asked) == 4 if true == 1 else 4 < len(case.asked) < 50


def test_where_runs_along_the_mode_do_not_tell_it_is_looked_for_at_random(monkeypatch: pytest.MonkeyPatch) -> None:
    """No limit within a tenth; nothing predicted that could be run; not the springs' own mode, or too large a one."""
    assert Case(monkeypatch, lambda dt: 0.0).limit(Limit(0.02)) == "at random"
    assert Case(monkeypatch, lambda dt: 1.0).limit(Limit(0.02)) == "at random"
    good = Case(monkeypatch, lambda dt: float(dt > 0.02))
    assert good.limit(Limit(0.02), scheme=False) == "at random"
    assert good.limit(Limit(None, "stable at any dt")) == "at random"
    assert good.limit(Limit(0.02, note="of springs alone")) == "at random"
    assert good.expected == 0.02
    assert good.limit(Limit(0.02, certainty="between", at_most=0.03)) == "at random"
    assert good.expected is None
    good.scheme.on_rods = True
    assert good.limit(Limit(0.02)) == "at random"
    good.scheme.on_rods = False
    assert good.limit(Limit(0.02)).dt == pytest.approx(0.02, rel=PRECISION)
    good.size = engine_limit.WHOLE_UP_TO + 1
    assert good.limit(Limit(0.02)) == "at random"


def test_growth_too_slow_to_be_seen_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """At once, where it drowns in rounding; after a look, where it might be seen, and is not."""
    margin = MARGIN["double"]
    for beyond, looked in ((0.5 * margin, False), (0.5 * CERTAIN * margin, True)):
        case = Case(monkeypatch, lambda dt: 0.0, beyond)
        found = case.limit(Limit(0.02))
        assert found.dt is None
        assert "too slow for a run" in found.reason
        assert bool(case.asked) == looked
    seen = Case(monkeypatch, lambda dt: float(dt > 0.02), 0.5 * CERTAIN * margin).limit(Limit(0.02))
    assert seen.dt == pytest.approx(0.02, rel=PRECISION)


@pytest.mark.parametrize(("growth", "tells"), [(1e-3, True), (1e-9, False)])
def test_where_growth_at_any_step_is_predicted_it_is_looked_for_at_two(
    growth: float, tells: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A tenth of what the fastest mode lasts, and all of it."""
    case = Case(monkeypatch, lambda dt: growth * dt / UNIT)
    found = case.limit(Limit(None, "unstable at any dt", growth=0.1))
    assert case.asked == [pytest.approx(0.1 * UNIT), pytest.approx(UNIT)]
    if tells:
        assert found.reason == (
            "unstable at any dt that was tried, 0.001 and 0.01 s: grows by 0.0001 of itself in the first"
        )
        assert found.growth == pytest.approx(1e-4)
    else:
        assert found == "at random"


def test_who_is_not_there_or_has_no_rest_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is run; in single precision nothing is looked for at random."""
    case = Case(monkeypatch, lambda dt: 0.0)
    monkeypatch.setattr(engine_limit, "precision_of", lambda engine: "single")
    assert case.limit(Limit(0.02)).reason.startswith("not measured: in single precision")
    nowhere = Outcome("unsupported", "no rest")
    monkeypatch.setattr(engine_limit, "rest_of_engine", lambda *_: nowhere)
    assert case.limit(Limit(0.02)) == nowhere
    case.stepper.version = None
    assert case.limit(Limit(0.02)).ending == "unsupported"
    assert case.limit(Limit(0.02)) != nowhere


@pytest.mark.parametrize(
    ("growths", "first"),
    [
        ([0.0, 0.0, 1.0], 2),
        ([0.0, 1.0, 1.0], 1),
        ([0.5, 0.6, 1.0], 1),
        ([0.5, 0.5, 0.5], None),
        ([1.0, 1.0, 1.0], None),
        ([0.0, 1.0, 0.0, 1.0], None),
        ([1.0, 0.0], None),
        ([0.0, nan, inf], 1),
    ],
)
def test_a_limit_is_between_none_that_grew_and_all_that_did(growths: list[float], first: int | None) -> None:
    """More than 0.5 is growth here; so is what is no number."""
    assert _first_unstable(growths, 0.5) == first


def test_what_is_measured_at_random_is_asked_in_this_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """Engine, rest, what is perturbed, about how long a mode lasts, how precisely, and what is expected."""
    asked: list[Any] = []

    def isolate(function: object, *arguments: Any, time_limit: float) -> Limit:
        asked.extend([function, *arguments, time_limit])
        return Limit(0.02)

    stepper = cast(Any, SimpleNamespace(engine=Doctored(), time_limit=10.0, isolate=isolate))
    monkeypatch.setattr(engine_limit, "rest_of_engine", lambda engine, system, rest: rest)
    monkeypatch.setattr(engine_limit, "perturbed", lambda system, rest: ("at rest", "moved"))
    found = engine_limit.measure_at_random(stepper, SYSTEM, cast(Any, None), UNIT, 1e-3, 0.03)
    assert found == Limit(0.02)
    assert asked == [engine_limit.limit_of_engine, stepper.engine, "at rest", "moved", UNIT, 1e-3, 0.03, 20.0]


@pytest.mark.parametrize("lacks", ["stretched", "velocities"])
def test_an_engine_that_cannot_be_started_along_a_mode_is_looked_at_at_random(
    lacks: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It has to start with stretched springs, and in motion; or is about another rest than springs have."""
    case = Case(monkeypatch, lambda dt: float(dt > 0.02))
    assert case.limit(Limit(0.02)).dt == pytest.approx(0.02, rel=PRECISION)
    case.stepper.engine = Doctored(capabilities=Doctored().capabilities - {lacks})
    assert case.limit(Limit(0.02)) == "at random"
    case.stepper.engine = Doctored()
    case.predictions.rest.motion = "of rods"
    assert case.limit(Limit(0.02)) == "at random"


@pytest.mark.parametrize("answer", [None, Outcome("crashed", "killed")])
def test_a_ladder_that_has_no_growth_is_told_or_looked_at_at_random(
    answer: Outcome | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What crashed has crashed; where there is no mode at one of the steps, nothing is known."""
    case = Case(monkeypatch, lambda dt: 0.0)
    monkeypatch.setattr(engine_limit._Watched, "growths", lambda *_: answer)
    assert case.limit(Limit(0.02)) == (answer or "at random")
