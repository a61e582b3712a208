"""Pymunk's rounds of damping: ten are a scheme of their own, many converge to an implicit one."""

from __future__ import annotations

import pytest

from engines.engine import version
from engines.process.isolation import EngineStepper
from engines.pymunk.springs import PymunkSprings
from reference.identification import TOLERANCE, identify_run
from reference.scenes import find
from reference.stepper import catalogued

#: So strong a damping, dt c/m = 0.25, that ten rounds are far from converged.
SYSTEM = find("string").system({"damping": 0.5, "mass": 0.002})
DT, STEPS = 1e-3, 200
CONVERGED, TEN_ROUNDS = "drift_kick_exponential_damping", "drift_kick_sequential_damping"

pytestmark = pytest.mark.skipif(version(PymunkSprings()) is None, reason="pymunk is not installed")


def check_is(engine: PymunkSprings, scheme: str) -> None:
    """The engine is the scheme: max |x_engine - x_scheme| <= 1e-12 of the size, as everywhere."""
    outcome = EngineStepper(engine).run(SYSTEM, DT, STEPS)
    right = catalogued()[scheme].run(SYSTEM, DT, STEPS)
    assert right.trajectory is not None
    found = identify_run(engine.name, outcome, SYSTEM, {scheme: right.trajectory}, TOLERANCE)
    assert found.identified_as == scheme, str(found)


def test_with_ten_rounds_it_is_the_scheme_of_ten_rounds() -> None:
    """Spring after spring in their order, ten times over: Pymunk as it comes."""
    check_is(PymunkSprings(), TEN_ROUNDS)


def test_with_many_rounds_every_spring_decays_as_if_alone() -> None:
    """Converged, dt c in the implicit solve is m (exp(dt c/m) - 1), m the spring's effective mass (engine-facts.md)."""
    check_is(PymunkSprings(rounds=400), CONVERGED)


@pytest.mark.parametrize(("rounds", "scheme"), [(10, CONVERGED), (9, TEN_ROUNDS), (11, TEN_ROUNDS), (400, TEN_ROUNDS)])
def test_the_check_tells_one_number_of_rounds_from_another(rounds: int, scheme: str) -> None:
    """Shown to fail: ten rounds are not converged, and neither nine nor eleven are ten."""
    with pytest.raises(AssertionError):
        check_is(PymunkSprings(rounds=rounds), scheme)
