"""Growth in a step that is much smaller than the rounding of 1."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find, schemes, wide_schemes
from reference.theory.equilibria import spring_equilibrium
from reference.theory.rates import rates
from reference.theory.step_increments import growth_of, increments_of_modes, is_exact, step_increments
from reference.theory.step_map import step_jacobian

EXPLICIT = [
    name
    for name, one in {**schemes(), **wide_schemes()}.items()
    if one.linear and one.needs in ("accelerations", "accelerations of one mass")
]


@pytest.mark.parametrize("name", EXPLICIT)
def test_increments_are_the_jacobian_but_for_1(name: str) -> None:
    """B = J - 1, J to rounding: with masses, damping and drag all different, and with what is remembered."""
    system = find_scene("string").system({"masses": 3, "mass": [0.02, 0.03, 0.05], "damping": 0.1, "drag": 0.1})
    rest, scheme = spring_equilibrium(system), find(name)
    assert is_exact(scheme, rest)
    jacobian = step_jacobian(scheme, rest, 4e-3)
    assert np.abs(step_increments(scheme, rest, 4e-3) + np.eye(len(jacobian)) - jacobian).max() < 1e-14


@pytest.mark.parametrize("h", [1e-2, 1e-5, 1e-9, 1.1e-13])
def test_increments_of_a_step_as_short_as_one_likes_are_right_to_the_last_digits(h: float) -> None:
    """Euler on x'' = -k/m x - c/m x': B = ((0, 1), (-h^2 k/m, -h c/m)) in x and h v, here by fractions.

    Of J - 1 as it stands nothing is left in its lower left corner's neighbour: h c/m is far below the rounding of 1.
    """
    system = find_scene("oscillator").system({"damping": 1e-3})
    found = step_increments(find("euler"), spring_equilibrium(system), h)
    k, c, m = (Fraction(float(q)) for q in (system.stiffness[0], system.damping[0], system.masses[1]))
    exact = [[0.0, 1.0], [float(-(Fraction(h) ** 2) * k / m), float(-Fraction(h) * c / m)]]
    assert found.tolist() == [pytest.approx(row, rel=1e-13, abs=0.0) for row in exact]


@pytest.mark.parametrize("h", [1e-1, 1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("scene", ["chain", "cloth"])
def test_what_neither_grows_nor_decays_is_seen_to_do_so_in_proportion_to_dt(scene: str, h: float) -> None:
    """Kick-drift without damping: all |1 + b| = 1. By single eigenvalues to rounding times dt w, by quotients better.

    The larger of two roundings, of h w eigenvalues and of sums over the masses, is 2e-16 x 20. Euler's growth,
    (h w)^2 / 2 at the fastest mode, is seen in the same way to a part in a million.
    """
    rest = spring_equilibrium(
        find_scene(scene).system({"masses": 20} if scene == "chain" else {"rows": 4, "columns": 4})
    )
    dt = h / rates(rest).fastest
    increments = step_increments(find("kick_drift"), rest, dt)
    assert np.abs(growth_of(increments_of_modes(increments))).max() < 4e-15 * h
    eulers = growth_of(increments_of_modes(step_increments(find("euler"), rest, dt))).max()
    assert eulers == pytest.approx(np.hypot(1, h) - 1 if h > 1e-2 else h**2 / 2, rel=1e-6)


def test_without_accelerations_alone_increments_are_those_of_the_jacobian() -> None:
    """An implicit step solves for what it adds; a scheme that is not linear is differenced."""
    rest = spring_equilibrium(find_scene("chain").system({"masses": 3, "damping": 0.1}))
    implicit, differenced = find("backward_euler"), replace(find("heun"), linear=False)
    for scheme in (implicit, differenced):
        assert not is_exact(scheme, rest)
        jacobian = step_jacobian(scheme, rest, 1e-3)
        assert np.array_equal(step_increments(scheme, rest, 1e-3), jacobian - np.eye(len(jacobian)))


@pytest.mark.parametrize("b", [1e-20, -1e-20, 0.5, -1.0, -2.0, -3.0])
def test_growth_is_the_modulus_less_1(b: float) -> None:
    """|1 + b| - 1 on the real axis, beyond -1 too, and of a turn: 1 + i t has sqrt(1 + t^2)."""
    expected = b if b > -1 else -2 - b
    assert growth_of(np.array([b + 0j]))[0] == pytest.approx(expected, rel=1e-15)
    assert growth_of(np.array([1j * abs(b)]))[0] == pytest.approx(b**2 / (1 + np.sqrt(1 + b**2)), rel=1e-15)
