"""Motions of strings in closed form: straight ones that turn about their anchor."""

from __future__ import annotations

import numpy as np

from reference.state import Array, Trajectory


def turning(times: Array, rate: float, masses: int = 4, length: float = 1.2) -> Trajectory:
    """A straight string that begins to the right of its anchor at the origin and turns downwards [rad/s]."""
    angle = -rate * times
    along = np.linspace(0, length, masses + 1)[None, :, None]
    positions = along * np.column_stack([np.cos(angle), np.sin(angle)])[:, None, :]
    return Trajectory(times, positions, np.zeros_like(positions))
