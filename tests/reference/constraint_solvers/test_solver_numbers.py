"""What a constraint solver reads of a system, by hand, in double and in single precision."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.constraint_solvers.solver_numbers import kept, numbers_of
from reference.errors import Unsupported
from reference.springs.angular import AngularSprings
from reference.springs.kinds import NonlinearSprings
from reference.state import State
from reference.system import MassSpringSystem

#: Three masses, the first of them fixed, on three springs; no two numbers are alike, and none is one of binary digits.
THREE = MassSpringSystem(
    positions=np.array([[0.0, 0.1], [1.1, 0.2], [2.3, 0.4]]),
    springs=np.array([[1, 0], [1, 2], [0, 2]]),
    masses=np.array([0.1, 0.3, 0.7]),
    rest_lengths=np.array([1.1, 1.2, 1.3]),
    stiffness=np.array([10.1, 20.1, 30.1]),
    damping=np.array([0.1, 0.2, 0.3]),
    drag=0.6,
    gravity=np.array([0.7, -9.1]),
    fixed=np.array([True, False, False]),
)

#: Where it is later.
LATER = State(
    0.5,
    np.array([[0.0, 0.1], [1.3, 0.3], [2.6, 0.7]]),
    np.array([[0.0, 0.0], [0.1, 0.2], [0.3, 0.4]]),
    (np.array([0.1, 0.2, 0.3]), np.array([0.4, 0.5, 0.6])),
)


@pytest.mark.parametrize("single", [False, True])
def test_numbers_by_hand(single: bool) -> None:
    """Inverse masses, weight and drag are zero of what is fixed; in single precision all are rounded, and no others."""
    found = numbers_of(THREE, LATER, "reversed", single)
    kind, rel = (np.float32, 1.2e-7) if single else (np.float64, 2.3e-16)
    expected = {
        "x": LATER.positions,
        "v": LATER.velocities,
        "inverse": [0.0, 1 / 0.3, 1 / 0.7],
        "weight": [[0.0, 0.0], [0.7, -9.1], [0.7, -9.1]],
        "drag": [[0.0], [2.0], [0.6 / 0.7]],
        "rest": [1.1, 1.2, 1.3],
        "stiffness": [10.1, 20.1, 30.1],
        "damping": [0.1, 0.2, 0.3],
        "both": [1 / 0.3, 1 / 0.3 + 1 / 0.7, 1 / 0.7],
    }
    for name, values in expected.items():
        assert getattr(found, name).dtype == kind, name
        np.testing.assert_allclose(getattr(found, name), values, rtol=2 * rel, atol=0.0)
    assert found.ends.tolist() == [[1, 0], [1, 2], [0, 2]]
    assert found.order.tolist() == [2, 1, 0]
    assert found.number(0.1) == kind(0.1)
    assert type(found.number(0.1)) is kind


def test_a_state_is_read_and_not_written() -> None:
    """What the solver makes of x and v is another state, in doubles."""
    found = numbers_of(THREE, LATER, "made", False)
    found.x[1] += 1.0
    found.v[2] -= 1.0
    assert LATER.positions[1].tolist() == [1.3, 0.3]
    assert LATER.velocities[2].tolist() == [0.3, 0.4]
    made = numbers_of(THREE, LATER, "made", True).state(0.7)
    assert (made.time, made.positions.dtype, made.velocities.dtype) == (0.7, np.float64, np.float64)
    assert made.positions == pytest.approx(LATER.positions, rel=1e-7)
    assert made.velocities == pytest.approx(LATER.velocities, rel=1e-7)


@pytest.mark.parametrize("single", [False, True])
def test_a_warm_start_takes_the_first_of_what_is_remembered(single: bool) -> None:
    """A copy, in the solver's numbers; at the start no impulse."""
    found = numbers_of(THREE, LATER, "made", single)
    impulses = kept(LATER, found)
    assert impulses.dtype == found.x.dtype
    assert impulses == pytest.approx([0.1, 0.2, 0.3], rel=1e-7)
    impulses[:] = 0.0
    assert LATER.memory[0].tolist() == [0.1, 0.2, 0.3]
    assert kept(THREE.start, found).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("system", "said"),
    [
        (replace(THREE, rest_lengths=np.array([0.0, 1.2, 1.3])), "a rest length only"),
        (replace(THREE, pulls=np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 1.0]])), "no force that pulls"),
        (replace(THREE, angular_springs=AngularSprings(np.array([[0, 1, 2]]), np.array(1.0))), "resist bending"),
        (replace(THREE, nonlinear=NonlinearSprings(hardening=np.array([0.0, 1.0, 0.0]))), "linear springs only"),
    ],
)
def test_what_they_do_not_have_is_refused(system: MassSpringSystem, said: str) -> None:
    """One such spring or force among others is enough."""
    with pytest.raises(Unsupported, match=said):
        numbers_of(system, system.start, "made", False)
