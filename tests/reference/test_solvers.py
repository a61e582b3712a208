"""Large systems are solved by iteration or with sparse matrices: to rounding, what the dense matrices give."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from reference import assembly, rope
from reference.assembly import Blocks, solve_velocities, spring_blocks
from reference.catalogue import find
from reference.rope import ROPE_KICK_DRIFT, RopeMotion
from reference.scenes import find as find_scene
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


def check_ropes(refinements: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Twenty steps of many rods by sparse matrices, to 1e-12 m those by dense ones."""
    made = []
    for dense in (10**9, 0):
        monkeypatch.setattr(rope, "DENSE_UP_TO", dense)
        monkeypatch.setattr(rope, "REFINEMENTS", refinements)
        made.append(simulate(CLOTH, ROPE_KICK_DRIFT, 1e-3, 0.02, equations=RopeMotion))
    assert made[0].distance(made[1]).max() <= 1e-12


def test_ropes_of_many_rods_are_those_of_dense_matrices(monkeypatch: pytest.MonkeyPatch) -> None:
    """And not without solving again for what rounding leaves."""
    check_ropes(2, monkeypatch)
    with pytest.raises(AssertionError):
        check_ropes(0, monkeypatch)


def test_implicit_schemes_take_the_same_steps_either_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """Backward Euler, each step to rounding of 1 m: twenty of them to 1e-13 m."""
    one = simulate(CLOTH, find("backward_euler"), 1e-3, 0.02)
    monkeypatch.setattr(assembly, "ITERATE_FROM", 10**9)
    other = simulate(CLOTH, find("backward_euler"), 1e-3, 0.02)
    assert one.distance(other).max() <= 1e-13
