"""Pymunk's rounds of damping: ten are a scheme, others the same with a parameter, many converge to an implicit one."""

from __future__ import annotations

import pytest

from engines.engine import version
from engines.process.isolation import EngineStepper
from engines.pymunk.springs import PymunkSprings
from reference.identification import TOLERANCE, identify_run
from reference.scenes import find
from reference.stepper import stepper_named

#: So strong a damping, dt c/m = 0.25, that ten rounds are far from converged.
SYSTEM = find("string").system({"damping": 0.5, "mass": 0.002})
DT, STEPS = 1e-3, 200
CONVERGED, TEN = "drift_kick_exponential_damping", "drift_kick_sequential_damping"

pytestmark = pytest.mark.skipif(version(PymunkSprings()) is None, reason="pymunk is not installed")


def check_is(engine: PymunkSprings, scheme: str) -> None:
    """The engine is the scheme: max |x_engine - x_scheme| <= 1e-12 of the size, as everywhere."""
    outcome = EngineStepper(engine).run(SYSTEM, DT, STEPS)
    right = stepper_named(scheme).run(SYSTEM, DT, STEPS)
    assert right.trajectory is not None
    found = identify_run(engine.name, outcome, SYSTEM, {scheme: right.trajectory}, TOLERANCE)
    assert found.identified_as == scheme, str(found)


@pytest.mark.parametrize("rounds", [1, 3, 10, 11])
def test_it_claims_the_scheme_of_its_rounds_and_is_it(rounds: int) -> None:
    """Spring after spring in their order, as many times over; ten is Pymunk as it comes, and the scheme as it is."""
    engine = PymunkSprings(rounds=rounds)
    assert stepper_named(engine.identified_as["damping"]).scheme.parameters == {"rounds": rounds}
    check_is(engine, engine.identified_as["damping"])


def test_with_many_rounds_every_spring_decays_as_if_alone() -> None:
    """Converged, dt c in the implicit solve is m (exp(dt c/m) - 1), m the spring's effective mass.

    So much does a spring alone lose: its elongation rate w decays as w' = -(c/m) w, to exp(-dt c/m) w in a step.
    """
    check_is(PymunkSprings(rounds=400), CONVERGED)


@pytest.mark.parametrize(
    ("rounds", "scheme"), [(10, CONVERGED), (9, TEN), (11, TEN), (400, TEN), (3, f"{TEN}(rounds=4)")]
)
def test_the_check_tells_one_number_of_rounds_from_another(rounds: int, scheme: str) -> None:
    """Shown to fail: ten rounds are not converged, neither nine nor eleven are ten, and three are not four."""
    with pytest.raises(AssertionError):
        check_is(PymunkSprings(rounds=rounds), scheme)


def test_what_is_typed_for_damping_is_on_record() -> None:
    """The system's own; or what makes a spring alone decay as by backward Euler. And it is said what is kept then."""
    plain, backward = PymunkSprings(), PymunkSprings("backward", rounds=400, backward_euler=True)
    assert (plain.settings["DampedSpring.damping"], plain.settings["Space.iterations"]) == ("c", 10)
    assert backward.settings["DampedSpring.damping"] == "(m/dt) ln(1 + dt c/m)"
    assert "keeps exp(-dt c/m) of" in plain.semantics
    assert "keeps 1/(1 + dt c/m) of" in backward.semantics
