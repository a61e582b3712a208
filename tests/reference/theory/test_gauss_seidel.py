"""What a round of sequential impulses leaves undone: by hand on two springs, and by the iteration itself."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find
from reference.schemes.implicit_damping import effective_masses, sequential_impulses, spring_directions
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.gauss_seidel import convergence_factor


def straight(springs: int, damping: float) -> MassSpringSystem:
    """The default string, of so many masses."""
    return find("string").system({"masses": springs, "damping": damping})


@pytest.mark.parametrize("damping", [0.5, 5.0, 20.0])
def test_a_round_on_two_springs_leaves_half_the_product_of_their_parts(damping: float) -> None:
    """By hand: p1 = 1 - exp(-dt c/m), p2 = 1 - exp(-2 dt c/m). Each spring passes on p times m'/m, and m'2 = m/2.

    A round takes a spring's impulse to the other and back: p1 p2 / 2. Rounding only; with another dt it is not.
    """
    first, second = (-np.expm1(-1e-3 * damping * n / 0.02) for n in (1, 2))
    assert convergence_factor(straight(2, damping), 1e-3) == pytest.approx(first * second / 2, rel=1e-12)
    assert convergence_factor(straight(2, damping), 2e-3) != pytest.approx(first * second / 2, rel=1e-2)


def left_by_a_round(system: MassSpringSystem, dt: float) -> float:
    """The kernel's own iteration on random velocities: by what the last of 40 rounds multiplies what is missing."""
    mass = effective_masses(system)
    part = -np.expm1(-dt * system.damping / mass)
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)

    def after(rounds: int) -> Array:
        velocities = np.random.default_rng(1).normal(size=system.positions.shape)
        directions = spring_directions(system, system.start)
        sequential_impulses(velocities[:, :, None], system.springs, directions, inverse, mass, part, rounds)
        return velocities

    missing = [float(np.linalg.norm(after(n) - after(1000))) for n in (39, 40)]
    return missing[1] / missing[0]


def test_the_predicted_factor_is_that_of_the_iteration_itself() -> None:
    """After 40 rounds only the slowest mode is left, to (second / first)^40: within 1e-3. Another damping is off."""
    system = straight(6, 40.0)
    assert convergence_factor(system, 1e-3) == pytest.approx(left_by_a_round(system, 1e-3), rel=1e-3)
    assert convergence_factor(straight(6, 30.0), 1e-3) != pytest.approx(left_by_a_round(system, 1e-3), rel=1e-2)
