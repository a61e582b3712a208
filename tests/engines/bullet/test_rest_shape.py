"""The shape at which Bullet measures rest lengths: springs have exactly those of the system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engines.bullet.rest_shape import rest_shape
from reference.scenes import find


def test_a_folded_string_has_its_rest_lengths_to_the_bit() -> None:
    """0, L, 0, L, ... are exactly L apart; thirty in a row would be so to rounding only."""
    system = find("string").system({"masses": 30})
    system = replace(system, rest_lengths=np.full(30, 0.1))
    shape = rest_shape(system, np.zeros((31, 3)))
    a, b = system.springs.T
    assert np.array_equal(np.linalg.norm(shape[b] - shape[a], axis=1), system.rest_lengths)
    in_a_row = np.cumsum(np.full(31, 0.1))
    assert not np.array_equal(np.diff(in_a_row), system.rest_lengths)
