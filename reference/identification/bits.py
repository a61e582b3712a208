"""Trajectories that are the same to the last bit: what single precision allows where whole trajectories are compared.

A stepper in single precision is off a scheme in double precision by rounding that adds up, and the nearest scheme can
be the wrong one. A scheme that does the same operations in single precision in the same order is off by nothing.
"""

from __future__ import annotations

import numpy as np

from reference.state import Trajectory

#: What was compared.
BITS = "every bit of every step"


def same_bits(one: Trajectory, other: Trajectory) -> bool:
    """Whether all positions and velocities after the start are equal, to the last bit, for as long as both go."""
    if len(one) != len(other):
        return False
    return np.array_equal(one.positions[1:], other.positions[1:]) and np.array_equal(
        one.velocities[1:], other.velocities[1:]
    )
