"""A system linearised: whether anything damps it, and its matrices by hand."""

from __future__ import annotations

import numpy as np
import pytest

from reference.theory.linearisation import Linearisation
from tests.reference.theory.test_rates import free_chain


def test_one_damped_spring_among_others_is_damping() -> None:
    """And drag is not."""
    for damping, damped in (([0.0, 0.3], True), ([0.3, 0.0], True), ([0.0, 0.0], False)):
        chain = free_chain(damping=np.array(damping), drag=0.1)
        found = Linearisation(chain, chain.start)
        assert (found.damped, found.dragged) == (damped, True)
    still = free_chain()
    assert not Linearisation(still, still.start).dragged


def test_matrices_by_hand() -> None:
    """Of two unequal masses on a wall: K, C, and what is scaled by the roots of the masses; as arrays, too."""
    chain = free_chain(
        masses=np.array([9.0, 4.0, 0.25]),
        stiffness=np.array([10.0, 30.0]),
        damping=np.array([1.0, 2.0]),
        drag=0.5,
        fixed=np.array([True, False, False]),
    )
    found = Linearisation(chain, chain.start)
    k = np.array([[40.0, -30.0], [-30.0, 30.0]])
    c = np.array([[3.0, -2.0], [-2.0, 2.0]])
    root = np.array([0.5, 2.0])
    assert found.mass.tolist() == [4.0, 0.25]
    assert found.stiffness.toarray() == pytest.approx(k)
    assert found.damping.toarray() == pytest.approx(c)
    assert found.scaled_stiffness.toarray() == pytest.approx(root[:, None] * k * root)
    whole = found.scaled_array(np.array([1.0, 2.0]), np.array([100.0, 7.0, 5.0]))
    assert whole == pytest.approx(root[:, None] * (c + np.diag([7.0, 5.0])) * root)
    operator = found.operator.toarray()
    assert operator[:2].tolist() == [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
    assert operator[2:, :2] == pytest.approx(-k / found.mass[:, None])
    assert operator[2:, 2:] == pytest.approx(-(c + 0.5 * np.eye(2)) / found.mass[:, None])
