"""Springs that share no mass know nothing of one another: each moves in a system of many as it does alone."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.schemes.catalogue import constraint_schemes, find, schemes, wide_schemes
from reference.state import State
from reference.system import MassSpringSystem
from tests.reference.systems import moving_string

#: All schemes, and constraint solvers with what is not their default; in two sub-steps or rounds at most.
NAMES = [
    *schemes(),
    *wide_schemes(),
    *constraint_schemes(),
    "xpbd_jacobi(accumulated=False)",
    "xpbd_gauss_seidel(substeps=2, sweeps=2)",
    "soft_constraints_cold(drag_first=True, substeps=2, sweeps=2)",
    "temporal_gauss_seidel(damping_as_stiffness=True, substeps=2, sweeps_after=2)",
    "vertex_block_descent(braked=True)",
    "vertex_block_descent(jacobi=False)",
]

#: Of each spring: masses of its ends [kg], rest length, stiffness, damping, how much longer it is than at rest.
SPRINGS = (
    (0.5, 2.0, 1.0, 40.0, 0.3, 0.1),
    (0.7, 0.2, 0.5, 90.0, 0.0, -0.05),
    (1.5, 0.4, 0.8, 20.0, 0.8, 0.2),
    (0.3, 0.6, 0.6, 150.0, 0.1, 0.02),
)


@cache
def of_some(chosen: tuple[int, ...]) -> MassSpringSystem:
    """Some of the springs, far from one another, askew in the plane; the first end of every other one is fixed."""
    first, second, rest, stiffness, damping, longer = np.array([SPRINGS[i] for i in chosen]).T
    turn = np.array(chosen) + 0.3
    e = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    begin = np.array([[9.0 * i, -2.0 * i] for i in chosen])
    thrown = np.random.default_rng(5).normal(size=(4, 2, 2))[list(chosen)]
    fixed = np.array([[i % 2 == 0, False] for i in chosen])
    thrown[fixed] = 0.0
    n = len(chosen)
    return MassSpringSystem(
        positions=np.stack([begin, begin + (rest + longer)[:, None] * e], axis=1).reshape(-1, 2),
        velocities=thrown.reshape(-1, 2),
        springs=np.arange(2 * n).reshape(n, 2),
        masses=np.stack([first, second], axis=1).ravel(),
        rest_lengths=rest,
        stiffness=stiffness,
        damping=damping,
        drag=0.02,
        gravity=np.array([1.0, -3.0]),
        fixed=fixed.ravel(),
    )


def moved(name: str, chosen: tuple[int, ...]) -> State:
    """After three steps, each of which may look back."""
    system = of_some(chosen)
    advance, state = find(name).on(SpringMotion(system)), system.start
    for _ in range(3):
        state = advance(state, 0.01)
    return state


@pytest.mark.parametrize("name", NAMES)
def test_springs_apart_move_as_each_alone(name: str) -> None:
    """To rounding of some 30 m, or what a solver leaves."""
    together = moved(name, (0, 1, 2, 3))
    near = 1e-7 if name == "kick_drift_truncated_damping" else 1e-11
    for i in range(4):
        alone, mine = moved(name, (i,)), slice(2 * i, 2 * i + 2)
        np.testing.assert_allclose(together.positions[mine], alone.positions, atol=near)
        np.testing.assert_allclose(together.velocities[mine], alone.velocities, atol=100 * near)


#: To their engines g = 0 is a rod: such a spring holds its masses at the distance that they have.
AS_RODS = ("soft_constraints_warm", "soft_constraints_cold")


@pytest.mark.parametrize("name", [name for name in NAMES if not name.startswith(AS_RODS)])
def test_a_spring_without_stiffness_and_damping_is_none(name: str) -> None:
    """Between two that have both, on a moving string: all moves as where it is not there, to rounding, in three steps.

    XPBD divides by the stiffness: one spring after the other, positions were no numbers.
    """
    string = moving_string(3, drag=0.02)
    ends = []
    for kept in (np.array([0, 1, 2]), np.array([0, 2])):
        stiffness, damping = np.array([200.0, 0.0, 150.0])[kept], np.array([0.1, 0.0, 0.2])[kept]
        fields: dict[str, Any] = {"springs": string.springs[kept], "rest_lengths": string.rest_lengths[kept]}
        system = replace(string, **fields, stiffness=stiffness, damping=damping)
        advance, state = find(name).on(SpringMotion(system)), system.start
        for _ in range(3):
            state = advance(state, 1e-3)
        ends.append(state)
    near = 1e-7 if name == "kick_drift_truncated_damping" else 1e-12
    np.testing.assert_allclose(ends[0].positions, ends[1].positions, atol=near)
    np.testing.assert_allclose(ends[0].velocities, ends[1].velocities, atol=100 * near)
