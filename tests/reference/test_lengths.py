"""Lengths of vectors and springs, and how fast springs get longer: beside NumPy's norms, one spring after the other."""

from __future__ import annotations

import numpy as np
import pytest

from reference import lengths as module
from reference.lengths import divisors, lengths, lengths_and_rates, spring_lengths
from reference.state import Array
from reference.system import IntArray

RNG = np.random.default_rng(3)


def drawn(dimension: int, frames: tuple[int, ...]) -> tuple[Array, Array, IntArray]:
    """Positions and velocities of nine masses in so many frames; eleven springs of them at random."""
    shape = (*frames, 9, dimension)
    springs = np.array([RNG.choice(9, 2, replace=False) for _ in range(11)])
    return RNG.normal(size=shape), RNG.normal(size=shape), springs


@pytest.mark.parametrize("block", [1, 4, 11, 512])
@pytest.mark.parametrize("frames", [(), (3,), (2, 3)])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_lengths_and_rates(
    monkeypatch: pytest.MonkeyPatch, dimension: int, frames: tuple[int, ...], block: int
) -> None:
    """L = |x_b - x_a| and dL/dt = (x_b - x_a).(v_b - v_a)/L, zero where it is not wanted, however many at once."""
    monkeypatch.setattr(module, "BLOCK", block)
    x, v, springs = drawn(dimension, frames)
    wanted = np.arange(11) % 3 > 0
    length, rate = lengths_and_rates(x, v, springs, wanted)
    assert length.shape == rate.shape == (*frames, 11)
    for j, (a, b) in enumerate(springs):
        apart, speed = x[..., b, :] - x[..., a, :], v[..., b, :] - v[..., a, :]
        norm = np.linalg.norm(apart, axis=-1)
        np.testing.assert_allclose(length[..., j], norm, rtol=1e-14)
        np.testing.assert_allclose(rate[..., j], wanted[j] * (apart * speed).sum(axis=-1) / norm, atol=1e-13)
    np.testing.assert_array_equal(spring_lengths(x, springs), length)
    np.testing.assert_allclose(lengths(x), np.linalg.norm(x, axis=-1), rtol=1e-14)
    none, still = lengths_and_rates(x, v, springs, np.zeros(11, dtype=bool))
    np.testing.assert_array_equal(none, length)
    assert not still.any()


def test_a_spring_of_no_length_has_no_direction_and_no_rate() -> None:
    """What its separation is divided by is 1 where it has no rest length either; else it is its length, which is 0."""
    x, v = np.array([[1.0, 2.0], [1.0, 2.0], [1.0, 5.0]]), np.array([[0.0, 0.0], [3.0, 4.0], [0.0, 2.0]])
    springs = np.array([[0, 1], [1, 2]])
    length, rate = lengths_and_rates(x, v, springs, np.array([True, True]))
    assert (length.tolist(), rate.tolist()) == ([0.0, 3.0], [0.0, -2.0])
    assert divisors(np.array([0.0, 0.0, 3.0, 1.0, 3.0]), np.array([0.0, 2.0, 0.0, 0.0, 5.0])).tolist() == [
        1,
        0,
        3,
        1,
        3,
    ]
