"""The shape at which Bullet measures rest lengths: springs have exactly those of the system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.bullet.rest_shape import rest_shape
from engines.engine import Unsupported
from reference.scenes import find
from reference.system import MassSpringSystem


def test_a_folded_string_has_its_rest_lengths_to_the_bit() -> None:
    """0, L, 0, L, ... are exactly L apart; thirty in a row would be so to rounding only."""
    system = find("string").system({"masses": 30})
    system = replace(system, rest_lengths=np.full(30, 0.1))
    shape = rest_shape(system, np.zeros((31, 3)))
    a, b = system.springs.T
    assert np.array_equal(np.linalg.norm(shape[b] - shape[a], axis=1), system.rest_lengths)
    in_a_row = np.cumsum(np.full(31, 0.1))
    assert not np.array_equal(np.diff(in_a_row), system.rest_lengths)


#: A triangle askew in space, whose springs at rest are longer or shorter.
TRIANGLE = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.3, 0.9, 0.2]])


def triangle(*lengths: float) -> MassSpringSystem:
    """Of these rest lengths, between masses 0 and 1, 1 and 2, 2 and 0."""
    return MassSpringSystem(
        positions=TRIANGLE,
        springs=np.array([[0, 1], [1, 2], [2, 0]]),
        masses=np.array(1.0),
        rest_lengths=np.array(lengths),
        stiffness=np.array(1.0),
    )


def test_a_mesh_off_its_rest_lengths_is_given_a_shape_that_has_them() -> None:
    """To rounding; one that has them already stays to the bit."""
    system = triangle(1.3, 0.8, 0.9)
    shape = rest_shape(system, TRIANGLE)
    a, b = system.springs.T
    assert np.linalg.norm(shape[b] - shape[a], axis=1) == pytest.approx([1.3, 0.8, 0.9], rel=1e-13)
    assert rest_shape(system, shape) is shape


def test_from_a_guess_that_has_no_directions_there_is_no_shape() -> None:
    """Two masses in one place, or one at infinity: no spring is told how to get longer, and nothing is divided by 0."""
    with pytest.raises(Unsupported, match="no shape of the mesh has them all"):
        rest_shape(triangle(1.3, 0.8, 0.9), TRIANGLE[[0, 0, 2]])
    with pytest.raises(Unsupported, match="no shape of the mesh has them all"), np.errstate(invalid="ignore"):
        rest_shape(triangle(1.3, 0.8, 0.9), np.where(TRIANGLE == 0.9, np.inf, TRIANGLE))


def test_a_triangle_of_impossible_sides_has_no_shape() -> None:
    """One side longer than the two others together."""
    with pytest.raises(Unsupported, match="no shape of the mesh has them all"):
        rest_shape(triangle(3.0, 0.8, 0.9), TRIANGLE)
