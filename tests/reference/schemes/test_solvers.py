"""Large systems are solved by iteration or with sparse matrices: to rounding, what the dense matrices give."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from reference import assembly
from reference import distance_constraints as rope
from reference.assembly import Blocks, solve_velocities, spring_blocks
from reference.distance_constraints import RopeMotion
from reference.scenes import find as find_scene
from reference.schemes import constrained
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array, State
from reference.system import MassSpringSystem

CLOTH = find_scene("cloth").system({"rows": 7, "columns": 6, "damping": 0.05})


def moving(system: MassSpringSystem) -> State:
    """Off its rest lengths, in motion."""
    rng = np.random.default_rng(3)
    free = ~system.fixed[:, None]
    shape = system.positions.shape
    return State(0.0, system.positions + 0.01 * free * rng.normal(size=shape), free * rng.normal(size=shape))


def blocks_of(system: MassSpringSystem, dt: float) -> Blocks:
    """What Newton's method solves with in a step of backward Euler: h df/dv + h^2 df/dx."""
    by_position, by_velocity = spring_blocks(system, moving(system))
    return dt * by_velocity + dt**2 * by_position


def check_solves(solve: Callable[[MassSpringSystem, Blocks, Array], Array], dt: float) -> None:
    """(M - B) v = M r by the dense matrix, to 1e-12 of the largest: a hundred times the rounding of so many sums."""
    blocks, right = blocks_of(CLOTH, dt), moving(CLOTH).velocities
    found = solve(CLOTH, blocks, right)
    free = ~CLOTH.fixed
    mass = np.repeat(CLOTH.masses[free], 3)
    matrix = np.diag(mass) - assembly.assemble(CLOTH, blocks, sparse=False)
    wanted = np.linalg.solve(matrix, mass * right[free].ravel())
    assert found[free].ravel() == pytest.approx(wanted, abs=1e-12 * float(np.abs(wanted).max()))
    assert (found[CLOTH.fixed] == 0).all()


@pytest.mark.parametrize("dt", [1e-4, 1e-3, 0.05])
def test_velocities_are_solved_for_to_rounding(dt: float) -> None:
    """By iteration at the small steps, by the factorised matrix at the large one."""
    check_solves(solve_velocities, dt)
    by_iteration = assembly._by_iteration(CLOTH, blocks_of(CLOTH, dt), moving(CLOTH).velocities)
    assert (by_iteration is None) == (dt > 1e-2)


def test_too_few_rounds_are_no_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then the matrix is factorised. Taken for one, the check fails; so does a solution without the masses' part."""
    monkeypatch.setattr(assembly, "ROUNDS", 2)
    check_solves(solve_velocities, 1e-3)
    monkeypatch.setattr(assembly, "REMAINDER", 1e-3)
    with pytest.raises(AssertionError):
        check_solves(solve_velocities, 1e-3)
    monkeypatch.undo()
    with pytest.raises(AssertionError):
        check_solves(lambda s, b, r: solve_velocities(s, Blocks(b.springs, 0 * b.masses + 1e-6), r), 1e-3)


def test_nothing_is_solved_for_nothing() -> None:
    """From rest there is no change."""
    assert not solve_velocities(CLOTH, blocks_of(CLOTH, 1e-3), np.zeros_like(CLOTH.positions)).any()


def longest(motion: RopeMotion, state: State, rods: rope.Rods, asked: Array) -> Array:
    """X'' = a + M^-1 J^T p with (J M^-1 J^T + R) p = asked - J a, in numbers of 64 bits in place of 53."""
    system = motion.system
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    free = np.where(system.fixed[:, None], 0.0, system.gravity).ravel()
    rows = motion.rows(rods).reshape(len(asked), -1).astype(np.longdouble)
    scaled = rows * np.repeat(inverse, system.dimension)
    softness = constrained.COMPLIANCE * inverse[system.springs].sum(axis=1)
    matrix, wanted = scaled @ rows.T + np.diag(softness), asked - rows @ free
    near, pulls = np.linalg.inv(matrix.astype(float)), np.zeros(len(asked), dtype=np.longdouble)
    for _ in range(10):
        pulls = pulls + near @ (wanted - matrix @ pulls).astype(float)
    return (free + pulls @ scaled).astype(float).reshape(state.positions.shape)


def check_rope() -> None:
    """The pulls of rods that hold one another, whose matrix has a condition of 1e7: x'' to 1e-11 of the largest."""
    motion, state = RopeMotion(CLOTH), moving(CLOTH)
    rods = motion.rods(state)
    asked = -rods.rates / 1e-3 - (rods.lengths - motion.rest_lengths) / 4e-6
    wanted = longest(motion, state, rods, asked)
    found = motion.constrained(state, rods, asked, constrained.COMPLIANCE)
    assert np.abs(found - wanted).max() <= 1e-11 * np.abs(wanted).max()


def test_ropes_of_many_rods_are_solved_for_to_rounding(monkeypatch: pytest.MonkeyPatch) -> None:
    """But not without solving again for what rounding leaves, nor by dense matrices."""
    check_rope()
    monkeypatch.setattr(rope, "REFINEMENTS", 0)
    with pytest.raises(AssertionError):
        check_rope()
    monkeypatch.setattr(rope, "DENSE_UP_TO", 10**9)
    with pytest.raises(AssertionError):
        check_rope()


def test_implicit_schemes_take_the_same_steps_either_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """Backward Euler, each step to rounding of 1 m: twenty of them to 1e-13 m."""
    one = simulate(CLOTH, find("backward_euler"), 1e-3, 0.02)
    monkeypatch.setattr(assembly, "ITERATE_FROM", 10**9)
    other = simulate(CLOTH, find("backward_euler"), 1e-3, 0.02)
    assert one.distance(other).max() <= 1e-13
