"""Stability polynomials against the textbooks, and where they leave the unit circle, against |R| at many points."""

from __future__ import annotations

from itertools import pairwise
from math import factorial

import numpy as np
import pytest

from reference.schemes.catalogue import find
from reference.state import Array
from reference.theory.runge_kutta import (
    first_limits_along,
    modulus_along,
    stability_polynomial,
    stable_along,
    stable_steps,
)

RNG = np.random.default_rng(6)

#: Made up, of degrees 1 to 6, with R(0) = 1; some stable near 0 as R'(0) = 1, some not.
MADE_UP = [tuple(np.concatenate([[1.0, RNG.choice([1.0, -0.5])], RNG.normal(size=n) / 2])) for n in range(6)]


def size(polynomial: tuple[float, ...], z: Array) -> Array:
    """|R(z)|."""
    return np.abs(np.polyval(polynomial[::-1], z))


@pytest.mark.parametrize(
    ("name", "further"),
    [("euler", ()), ("heun", (2,)), ("ralston", (2,)), ("ssprk3", (2, 6)), ("rk4", (2, 6, 24))],
)
def test_polynomials_are_the_exponentials_series(name: str, further: tuple[int, ...]) -> None:
    """Of s stages and order s: 1 + z + z^2/2 + ... + z^s/s! (HW IV.2)."""
    found = stability_polynomial(find(name))
    assert found == pytest.approx((1.0, 1.0, *(1 / n for n in further)), abs=1e-13)


def test_dormand_and_princes() -> None:
    """Of six stages and order five: z^6/600 is its own (HW IV.2)."""
    series = [1 / factorial(k) for k in range(6)]
    assert stability_polynomial(find("dormand_prince")) == pytest.approx((*series, 1 / 600), abs=1e-13)


@pytest.mark.parametrize(
    "name", ["kick_drift", "velocity_verlet", "implicit_midpoint", "adams_bashforth_2", "kick_drift_implicit_damping"]
)
def test_what_is_no_explicit_runge_kutta_method_has_none(name: str) -> None:
    """Those that treat positions and velocities differently, solve equations, or look back."""
    assert stability_polynomial(find(name)) is None


def towards(angle: float) -> complex:
    """e^(i angle), without rounding on the axes."""
    axes = {np.pi: -1 + 0j, np.pi / 2: 1j, -np.pi / 2: -1j}
    return axes.get(angle, complex(np.exp(1j * angle)))


@pytest.mark.parametrize("angle", [np.pi, np.pi / 2, -np.pi / 2, 2.0, -2.5, 0.3])
@pytest.mark.parametrize("polynomial", MADE_UP, ids=len)
def test_the_modulus_is_that_of_the_polynomial(polynomial: tuple[float, ...], angle: float) -> None:
    """|R(s e^(i angle))|^2 - 1 at ten s, to rounding of its largest terms."""
    s = np.linspace(0, 2, 10)
    expected = size(polynomial, s * np.exp(1j * angle)) ** 2 - 1
    found = np.polyval(modulus_along(polynomial, towards(angle))[::-1], s)
    np.testing.assert_allclose(found, expected, atol=1e-12 * max(1.0, float(np.abs(expected).max())))


@pytest.mark.parametrize("angle", [np.pi, np.pi / 2, 2.0, 2.7])
@pytest.mark.parametrize("polynomial", [*MADE_UP, (1.0, 1.0, 0.5, 1 / 6, 1 / 24), (1.0, 0.0, 1.0)], ids=len)
def test_inside_the_intervals_nothing_grows_and_outside_everything_does(
    polynomial: tuple[float, ...], angle: float
) -> None:
    """At 4,000 s, those within 1e-6 of an edge aside; the first interval begins at 0; many angles at once agree."""
    found = stable_along(polynomial, towards(angle))
    s = np.linspace(1e-3, 20, 4000)
    edges = np.array(found).ravel()
    clear = np.abs(s[:, None] - edges).min(axis=1) > 1e-6
    stable = size(polynomial, s * np.exp(1j * angle)) <= 1
    inside = np.any([(s > low) & (s < high) for low, high in found], axis=0)
    assert np.array_equal(stable[clear], inside[clear])
    assert found[0][0] == 0
    assert all(low < high for low, high in found[1:])
    assert all(high < low for (_, high), (low, _) in pairwise(found))
    assert first_limits_along(polynomial, np.array([0.1, angle]))[1] == pytest.approx(found[0][1], rel=1e-7)


def test_limits_of_known_polynomials() -> None:
    """Euler's along e^(i angle) is -2 cos(angle); RK4's along the imaginary axis sqrt(8); of R = 1 there is none."""
    angles = np.linspace(np.pi / 2, np.pi, 7)
    np.testing.assert_allclose(first_limits_along((1.0, 1.0), angles), np.maximum(-2 * np.cos(angles), 0), atol=1e-12)
    assert first_limits_along((1.0, 1.0, 0.5, 1 / 6, 1 / 24), np.array([np.pi / 2]))[0] == pytest.approx(np.sqrt(8))
    assert first_limits_along((1.0,), angles).tolist() == [np.inf] * 7
    assert stable_along((1.0, 1.0, 0.5), 1j) == ((0.0, 0.0),)


@pytest.mark.parametrize("decay", [1e-8, 1e-14, 1e-18, 1e-30])
def test_beside_the_imaginary_axis_limits_are_those_of_the_lowest_powers(decay: float) -> None:
    """Of z = s (-d + i): Euler's |R|^2 - 1 = s^2 - 2 s d, up to 2 d; Heun's s^4/4 - 2 s d, up to (8 d)^(1/3)."""
    for polynomial, limit in (((1.0, 1.0), 2 * decay), ((1.0, 1.0, 0.5), (8 * decay) ** (1 / 3))):
        ((_, found), *_) = stable_along(polynomial, complex(-decay, 1.0))
        assert found == pytest.approx(limit, rel=max(1e-9, 10 * decay ** (1 / 3)), abs=0)


def test_a_window_by_hand() -> None:
    """R(-s) = 1 - 0.6 s (4 - s): |R| <= 1 where s (4 - s) <= 2 / 0.6, but for s between 2 -+ sqrt(2 / 3), up to 4."""
    low, high = 2 - np.sqrt(2 / 3), 2 + np.sqrt(2 / 3)
    found = stable_along((1.0, 2.4, 0.6), -1 + 0j)
    assert np.array(found) == pytest.approx(np.array([[0.0, low], [high, 4.0]]), rel=1e-9)
    both = stable_steps((1.0, 2.4, 0.6), np.array([-1.0, -0.9], dtype=complex))
    assert np.array(both) == pytest.approx(np.array([[0.0, low], [high / 0.9, 4.0]]), rel=1e-9)


def test_a_step_is_stable_where_no_mode_grows() -> None:
    """Of modes that decay at 3/s and 40/s, and swing: at 2,000 dt, each mode by its own; what rests has no say."""
    polynomial = MADE_UP[3]
    rates = np.array([-3.0, -40.0, -5 + 20j, -5 - 20j, -0.5 + 4j, -0.5 - 4j, 0.0], dtype=complex)
    h = np.linspace(1e-4, 1.5, 2000)
    for some in (rates, rates[:1], rates[2:4]):
        found = stable_steps(polynomial, some)
        stable = np.all([size(polynomial, h * rate) <= 1 for rate in some if rate], axis=0)
        inside = np.any([(h > low) & (h < high) for low, high in found], axis=0)
        edges = np.array(found).ravel()
        clear = np.abs(h[:, None] - edges[np.isfinite(edges)]).min(axis=1) > 1e-6
        assert np.array_equal(stable[clear], inside[clear])
        assert found[0][0] == 0
        assert all(low < high for low, high in found[1:])
    assert stable_steps(polynomial, np.zeros(2, dtype=complex)) == [(0.0, np.inf)]
    assert stable_steps((1.0, 1.0), np.array([-4.0 + 0j])) == [(0.0, 0.5)]
