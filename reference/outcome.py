"""How a run ended: one of five words, always with its reason."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from reference.state import Array, Trajectory
from reference.system import MassSpringSystem

#: Every run ends as one of these.
Ending = Literal["done", "diverged", "crashed", "timed out", "unsupported"]


@dataclass(frozen=True)
class Outcome:
    """How a run ended and what it left.

    Attributes:
        ending: one of the five words.
        reason: one line; empty only when done.
        trajectory: what there is of it: all when done, up to the blow-up when diverged, else None.
    """

    ending: Ending
    reason: str = ""
    trajectory: Trajectory | None = None


def outcome_of(system: MassSpringSystem, trajectory: Trajectory) -> Outcome:
    """The outcome of a run that came to its end: done, or diverged."""
    reason = blow_up(system, trajectory)
    return Outcome("diverged", reason, trajectory) if reason else Outcome("done", "", trajectory)


def blow_up(system: MassSpringSystem, trajectory: Trajectory, strain: float = 100.0) -> str | None:
    """Says when and how a trajectory has left physics behind, or None if it has not.

    It has where a position is not a finite number, or a spring is more than `strain` times as long as the longer of
    its rest length and its length at the start. Engines' safety nets (resets, clamps, sleep) do not hide the second.
    """
    frame = first_torn(system, trajectory, strain)
    if frame == len(trajectory):
        return None
    time = f"{trajectory.times[frame]:.6g} s"
    lost = ~np.isfinite(trajectory.positions[frame]).all(axis=1)
    if lost.any():
        return f"the position of mass {np.argmax(lost)} is not a number at t = {time}"
    return f"spring {np.argmax(_strain(system, trajectory)[frame])} is over {strain:g} times its length at t = {time}"


def first_torn(system: MassSpringSystem, trajectory: Trajectory, strain: float) -> int:
    """The first frame with a position that is no number or a spring beyond a strain; the frames' number if none is."""
    lost = ~np.isfinite(trajectory.positions).all(axis=(1, 2))
    torn = (_strain(system, trajectory) > strain).any(axis=1)
    broken = lost | torn
    return int(np.argmax(broken)) if broken.any() else len(trajectory)


def _strain(system: MassSpringSystem, trajectory: Trajectory) -> Array:
    """Length over natural length of every spring in every frame, shape (m, s)."""
    x = trajectory.positions
    a, b = system.springs.T
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.linalg.norm(x[:, b] - x[:, a], axis=2)
        return np.asarray(length / np.maximum(system.rest_lengths, length[0]))
