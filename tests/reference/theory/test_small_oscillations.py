"""Frequencies about rest, against closed forms: of one mass, along a string, across it; and how a push swings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.state import Array
from reference.theory.equilibrium import hanging_string
from reference.theory.exact import exact
from reference.theory.modes import laguerre_frequencies, squared_frequencies
from tests import wrong
from tests.reference.schemes.solvers import Solver, solved_by, under


def test_frequencies_of_one_hanging_mass() -> None:
    """Along the spring w^2 = k/m; across, the tension m g over the length L it then has: w^2 = g/L."""
    system = find_scene("spring").system({})
    length = 0.125 + 0.02 * 9.81 / 200.0
    squares = squared_frequencies(system, hanging_string(system))
    assert squares == pytest.approx([9.81 / length, 200.0 / 0.02], rel=1e-12)


def along_frequencies(masses: int, stiffness: float, mass: float) -> Array:
    """w^2 = 4 k/m sin^2((2j - 1) pi / (2 (2n + 1))), j = 1..n: a chain fixed at one end (Goldstein, ch. 12)."""
    j = np.arange(1, masses + 1)
    squares: Array = 4 * stiffness / mass * np.sin((2 * j - 1) * np.pi / (2 * (2 * masses + 1))) ** 2
    return squares


@pytest.mark.parametrize("masses", [1, 2, 5, 10, 30])
def test_frequencies_along_a_hanging_string(masses: int) -> None:
    """A straight chain of linear springs keeps the frequencies along itself, however it is stretched, to rounding.

    The matrix holds k/m (1 + rounding); its eigenvalues are within some eps of the largest.
    """
    system = find_scene("string").system({"masses": masses, "stiffness": 1e4})
    squares = squared_frequencies(system, hanging_string(system))
    expected = along_frequencies(masses, 1e4, 0.02)
    nearest = np.abs(squares[:, None] - expected).min(axis=0)
    assert nearest.max() < 1e-12 * expected.max()


def across_frequencies(masses: int, stiffness: float) -> Array:
    """w^2 of a hanging string across itself: the lowest n, when it is stiff."""
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness})
    return squared_frequencies(system, hanging_string(system))[:masses]


def check_laguerre(frequencies: Callable[[int, float], Array], masses: int) -> None:
    """Across, w^2 -> (g/l) x_i with x_i the zeros of the Laguerre polynomial L_n, with an error of O(1/k).

    With f(k) = f + a/k + b/k^2, the differences fall tenfold from k = 1e5 to 1e6 N/m, to within b/a k ~ 1 %, and
    (10 f(1e6) - f(1e5)) / 9 has the error b/1e11 left, and rounding of eps k/m = 1e-8 /s^2.
    """
    limit = laguerre_frequencies(masses, 0.125, 9.81)
    at = {k: frequencies(masses, k) for k in (1e5, 1e6)}
    assert (at[1e5] - limit) / (at[1e6] - limit) == pytest.approx(np.full(masses, 10.0), rel=0.01)
    assert (10 * at[1e6] - at[1e5]) / 9 == pytest.approx(limit, rel=1e-8)


@pytest.mark.parametrize("masses", [1, 2, 5, 10])
def test_frequencies_across_a_stiff_string_are_laguerres(masses: int) -> None:
    """The hanging string's eigenvalues go to Lagrange's loaded string as 1/k."""
    check_laguerre(across_frequencies, masses)


def lightest_at_the_tip(masses: int, stiffness: float) -> Array:
    """The same string with its last mass halved."""
    mass = [0.02] * (masses - 1) + [0.01]
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness, "mass": mass})
    return squared_frequencies(system, hanging_string(system))[:masses]


def unstretched(masses: int, stiffness: float) -> Array:
    """Frequencies about a string that does not carry its weight."""
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness, "angle": 90.0})
    return squared_frequencies(system, system.start)[:masses]


@pytest.mark.parametrize("frequencies", [lightest_at_the_tip, unstretched])
def test_laguerre_fails_on_other_strings(frequencies: Callable[[int, float], Array]) -> None:
    """Another mass, or another place to oscillate about, has other frequencies."""
    with pytest.raises(AssertionError):
        check_laguerre(frequencies, 5)


def test_laguerre_zeros_by_hand() -> None:
    """L_1 = 1 - x and L_2 = (x^2 - 4 x + 2)/2 have the zeros 1 and 2 -+ sqrt(2)."""
    assert laguerre_frequencies(1, 0.5, 9.81) == pytest.approx([19.62], rel=1e-14)
    assert laguerre_frequencies(2, 1.0, 1.0) == pytest.approx([2 - np.sqrt(2), 2 + np.sqrt(2)], rel=1e-14)


def check_small_swing(solve: Solver) -> None:
    """Pushed across by 1e-6 m, a hanging mass swings as x0 cos(w t) with w^2 = g/L.

    Terms of the third order in x0/L are 1e-15 m; the solver's tolerance is 1e-13 m: 1e-11 m is 1e-5 of the swing.
    """
    system = find_scene("spring").system({})
    rest = hanging_string(system)
    pushed = replace(system, positions=rest.positions + np.array([[0.0, 0.0], [1e-6, 0.0]]))
    w = np.sqrt(squared_frequencies(system, rest)[0])
    found = solve(pushed, 0.05, 20)
    assert np.abs(found.positions[:, 1, 0] - 1e-6 * np.cos(w * found.times)).max() < 1e-11


def test_small_swings_have_the_eigenfrequency() -> None:
    """The eigenvalue is what is seen to move."""
    check_small_swing(exact)


@pytest.mark.parametrize("solve", [under(wrong.sideways), under(wrong.gravity_turned), solved_by("backward_euler")])
def test_small_swings_fail_on_wrong_motions(solve: Solver) -> None:
    """Other forces swing otherwise; backward Euler dies away."""
    with pytest.raises(AssertionError):
        check_small_swing(solve)
