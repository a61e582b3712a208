"""Limits of engines, measured without theory, against what is predicted of the schemes they are identified with."""

from __future__ import annotations

from pathlib import Path

import pytest

from engines.engine import Engine, demands, registry, version
from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import EngineStepper, in_this_process
from engines.process.packages import APART
from experiments.limits import limit_rows
from experiments.limits.engine_limit import HIDDEN, measure_engine
from experiments.limits.limit_rows import Row, stability_rows
from experiments.limits.predictions import Predictions
from reference.lecture.listings import listings
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from reference.schemes import catalogue
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from tests.conformance.doctored import Doctored, DoctoredSingle, KickDrift, RoundsToSingle

#: Limits are measured to 1e-4 of themselves, and growth of 8e-4 in a step is seen: together below a thousandth.
TOLERANCE = 1e-3


def quiet(_: object) -> None:
    """No progress."""


@pytest.fixture(scope="module", params=[{}, {"damping": 0.5}], ids=str)
def engine_rows(request: pytest.FixtureRequest) -> tuple[MassSpringSystem, dict[str, Row]]:
    """A string, and a row for each engine that can be started with it, all from one call."""
    system = find("string").system({"masses": 4, **request.param})
    beside = [e for e in registry().values() if version(e) and e.package not in APART]
    able = [e for e in beside if e.capabilities.issuperset(demands(system))]
    return system, {row.stepper: row for row in stability_rows(system, [EngineStepper(e) for e in able], quiet)}


def check_as_predicted(row: Row) -> None:
    """|measured - predicted| < 1e-3 predicted; or neither has a limit, and both say that it is unstable at any dt."""
    assert row.outcome == "done", row.document["reason"]
    assert (row.predicted.dt is None) == (row.measured.dt is None), row.document["reason"]
    if row.predicted.dt is None:
        assert row.predicted.growth is not None
        assert row.predicted.growth > 0
        assert "unstable at any dt" in row.measured.reason  # and not stable at any
        return
    assert row.relative_difference is not None
    assert abs(row.relative_difference) < TOLERANCE


@pytest.mark.rotating(7)
def test_engines_blow_up_where_their_scheme_is_predicted_to(
    engine: Engine, engine_rows: tuple[MassSpringSystem, dict[str, Row]]
) -> None:
    """From random perturbations, measured without any theory, against the limit of the scheme it is identified with.

    Where that has none, as Euler without drag, none is measured either.
    """
    system, rows = engine_rows
    if engine.name not in rows:
        pytest.skip(f"{engine.name} cannot do {sorted({*demands(system)} - engine.capabilities)}")
    check_as_predicted(rows[engine.name])


def test_growth_factors_are_below_one_below_the_limit_and_above_it_above(
    engine_rows: tuple[MassSpringSystem, dict[str, Row]],
) -> None:
    """Of the step of every engine that can start anywhere, at 0.99 and 1.01 of its measured limit.

    Undamped modes stay on the unit circle, up to what differences leave: 3e-4 where an engine solves to 1e-8 m/s only.
    """
    seen = [row.measured.factors for row in engine_rows[1].values() if row.measured.factors is not None]
    assert seen
    for below, above in seen:
        assert below <= 1 + 3e-4
        assert above > 1 + 1e-3


class Halfway(KickDrift):
    """Kick-drift that believes its dt to be half of what it is: stable for twice as long."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system, dt / 2)


@pytest.mark.rotating(7, in_turn=True)
def test_an_engine_with_a_limit_of_its_own_is_caught() -> None:
    """It is no scheme, so that nothing is predicted; and held against kick_drift's limit its own is twice as long."""
    system = find("string").system({"masses": 2})
    row, scheme = stability_rows(
        system, [EngineStepper(Doctored(Halfway)), SchemeStepper(catalogue.find("kick_drift"))], quiet
    )
    assert row.predicted.dt is None
    with pytest.raises(AssertionError):
        check_as_predicted(Row(row.stepper, row.kind, system, scheme.predicted, row.measured))
    assert row.measured.dt == pytest.approx(2 * (scheme.predicted.dt or 0.0), rel=TOLERANCE)


class Stiffer(KickDrift):
    """Kick-drift on springs stiffer by a hundredth than it is told."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system.with_parameter("stiffness", (1.01 * system.stiffness).tolist()), dt)


@pytest.mark.rotating(4, in_turn=True)
def test_a_limit_that_is_not_where_it_is_expected_is_found_as_exactly() -> None:
    """Of an engine that claims kick-drift and is stiffer: h^2 w^2 = 4, so that its limit is 1 / sqrt(1.01) of it.

    Without weight both rest alike. Steps are looked at to 1e-4 of themselves, growth to 2e-8 in a step.
    """
    system = find("string").system({"masses": 2, "gravity": 0.0})
    predictions, scheme = Predictions(system, spring_equilibrium(system)), SchemeStepper(catalogue.find("kick_drift"))
    predicted = predictions.of(scheme)
    found = measure_engine(EngineStepper(Doctored(Stiffer)), predictions, scheme, predicted)
    assert isinstance(found, Limit)
    assert predicted.dt is not None
    assert found.dt == pytest.approx(predicted.dt / 1.01**0.5, rel=1e-4)
    assert found.dt != pytest.approx(predicted.dt, rel=1e-3)


@pytest.mark.rotating(4, in_turn=True)
def test_where_rounding_hides_growth_nothing_is_measured() -> None:
    """An engine in single precision that is not identified: there is no mode to run along, and so no limit, and why.

    The same engine in double precision has one, from random perturbations.
    """
    system = find("string").system({"masses": 2, "angle": 90.0})
    predictions, unknown = Predictions(system, spring_equilibrium(system)), Limit(None, "not identified")
    found = measure_engine(EngineStepper(DoctoredSingle(RoundsToSingle)), predictions, None, unknown)
    assert isinstance(found, Limit)
    assert (found.dt, found.reason) == (None, HIDDEN)
    in_double = measure_engine(EngineStepper(Doctored()), predictions, None, unknown)
    assert isinstance(in_double, Limit)
    assert in_double.dt is not None


def test_a_listing_is_unsupported_with_its_reason() -> None:
    """It is neither scheme nor engine: nothing is predicted, nothing measured."""
    (row,) = stability_rows(find("string").system({"masses": 2}), [listings()["lecture_heun_loops"]], quiet)
    assert row.outcome == "unsupported"
    assert (row.predicted.dt, row.measured.dt) == (None, None)
    assert row.document["reason"]


OF_ITS_OWN = """
def step(f, y, t, dt):
    n = 64 if {more} else 16
    for i in range(n):
        y = y + dt / n * f(y, t + i * dt / n)
    return y
"""


@pytest.mark.parametrize(
    ("more", "adapts"), [("abs(f(y, t)).max() > 0.01", True), ("True", False), ("dt > 0.001", False)]
)
def test_a_step_that_adapts_itself_is_told_beside_its_limit(
    more: str, adapts: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """More steps of its own where forces are larger; as many whatever they are, or by dt alone: nothing is said.

    Where its limit is, is not what is asked here: it is not measured.
    """
    monkeypatch.setattr(limit_rows, "measure_engine", lambda *_: Limit(1.0))
    (tmp_path / "mine.py").write_text(OF_ITS_OWN.format(more=more), encoding="utf-8")
    mine = OwnStepper(own_stepper(str(tmp_path / "mine.py")).engine, isolate=in_this_process)
    (row,) = stability_rows(find("oscillator").system({}), [mine], quiet)
    assert (limit_rows.ADAPTS in row.document["reason"]) == adapts


def test_who_takes_too_long_for_a_few_short_steps_is_not_asked_for_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its row says how it ended; others are measured."""
    slow, quick = EngineStepper(Doctored(KickDrift)), SchemeStepper(catalogue.find("kick_drift"))
    late = Outcome("timed out", "no answer within 1 s")
    measured: list[object] = []
    monkeypatch.setattr(Predictions, "identifying_run", lambda *_: late)
    monkeypatch.setattr(limit_rows, "measure_engine", lambda *given: measured.append(given))
    rows = {row.stepper: row for row in stability_rows(find("oscillator").system({}), [slow, quick], quiet)}
    assert (rows[slow.name].outcome, rows[slow.name].measured.reason) == ("timed out", late.reason)
    assert rows[slow.name].predicted.reason == "not identified; no answer within 1 s"
    assert not measured
    assert rows[quick.name].relative_difference == pytest.approx(0.0, abs=1e-4)
