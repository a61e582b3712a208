"""What follows from step matrices, against closed forms."""

from __future__ import annotations

from math import acos, sqrt

import pytest

from reference.derivation.consequences import FAR, consequences
from reference.derivation.oscillators import runs_of
from reference.derivation.step_matrix import step_matrix
from reference.schemes.catalogue import Scheme, schemes
from reference.stepper import SchemeStepper, catalogued
from reference.theory.runge_kutta import stability_polynomial, stable_along
from tests import wrong
from tests.reference.systems import label

#: The real root of 1 + z + z^2/2 + z^3/6 + z^4/24 = 1 below zero: z^3 + 4 z^2 + 12 z + 24 = 0.
RK4_REAL = 2.785293563405282


@pytest.mark.parametrize(
    ("name", "imaginary", "real"),
    [
        ("euler", 0.0, 2.0),
        ("heun", 0.0, 2.0),
        ("kick_drift", 2.0, 2.0),
        ("rk4", sqrt(8), RK4_REAL),
        ("backward_euler", FAR, FAR),
        ("kick_drift_implicit_damping", 2.0, FAR),
    ],
)
def test_first_limits_are_the_textbooks(name: str, imaginary: float, real: float) -> None:
    """Of h w without damping, of h c/m without stiffness; to Jury's rounding, which moves a simple root by 1e-10."""
    found = consequences(step_matrix(runs_of(catalogued()[name])))
    assert found.imaginary_axis[0][1] == pytest.approx(imaginary, abs=1e-9)
    assert found.real_axis is not None
    assert found.real_axis[0][1] == pytest.approx(real, abs=1e-9)


@pytest.mark.parametrize("scheme", [s for s in schemes().values() if stability_polynomial(s) is not None], ids=label)
def test_runge_kutta_limits_are_those_of_the_stability_polynomial(scheme: Scheme) -> None:
    """|R(i s)| <= 1 and |R(-s)| <= 1, which `theory.runge_kutta` solves for exactly."""
    polynomial = stability_polynomial(scheme)
    assert polynomial is not None
    found = consequences(step_matrix(runs_of(SchemeStepper(scheme))))
    for windows, direction in ((found.imaginary_axis, 1j), (found.real_axis, -1 + 0j)):
        assert windows is not None
        assert windows[0][1] == pytest.approx(stable_along(polynomial, direction)[0][1], abs=1e-8)


@pytest.mark.rotating(2)
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.kind != "in_place"], ids=label)
def test_the_order_is_at_least_what_the_catalogue_says(scheme: Scheme) -> None:
    """M - exp(A) = O(h^(p+1)); on linear motion an order may be higher than on any."""
    found = consequences(step_matrix(runs_of(SchemeStepper(scheme))))
    assert scheme.order <= found.order <= found.undamped_order


@pytest.mark.parametrize("scheme", [wrong.heun_without_half, wrong.verlet_with_one_force, wrong.rk4_equally_weighted])
def test_a_wrong_integrator_has_not_the_order_it_claims(scheme: Scheme) -> None:
    """The same check, seen to fail."""
    assert consequences(step_matrix(runs_of(SchemeStepper(scheme)))).order < scheme.order


def test_the_numerical_period_of_kick_drift() -> None:
    """Cos(angle) = 1 - a/2 is half the trace: at h w = 1/2 the period is 0.98939 of the true one, undamped."""
    found = consequences(step_matrix(runs_of(catalogued()["kick_drift"])))
    s, period, amplitude = found.periods[1]
    assert period == pytest.approx(s / acos(1 - s**2 / 2), rel=1e-12)
    assert amplitude == pytest.approx(1.0, abs=1e-12)
    assert found.symplectic
    assert not found.reversible


def test_who_is_symplectic_and_reversible() -> None:
    """Determinant 1, and equal diagonal entries: kick-drift is only the first, RK4 neither, the midpoint rule both."""
    told = {n: consequences(step_matrix(runs_of(catalogued()[n]))) for n in ("kick_drift", "rk4", "implicit_midpoint")}
    assert {n: (c.symplectic, c.reversible) for n, c in told.items()} == {
        "kick_drift": (True, False),
        "rk4": (False, False),
        "implicit_midpoint": (True, True),
    }
    assert told["implicit_midpoint"].implicit == ("stiffness", "damping", "drag")
