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


def blow_up(system: MassSpringSystem, trajectory: Trajectory, stretch_ratio: float = 100.0) -> str | None:
    """Says when and how a trajectory has left physics behind, or None if it has not.

    It has where a position is not a finite number, or a spring is more than `stretch_ratio` times as long as the longer
    of its rest length and its length at the start. Engines' safety nets (resets, clamps, sleep) do not hide the second.
    """
    frame = first_diverged_frame(system, trajectory, stretch_ratio)
    if frame == len(trajectory):
        return None
    time = f"{trajectory.times[frame]:.6g} s"
    lost = ~np.isfinite(trajectory.positions[frame]).all(axis=1)
    if lost.any():
        return f"the position of mass {np.argmax(lost)} is not a number at t = {time}"
    longest = np.argmax(_stretch_ratios(system, trajectory)[frame])
    return f"spring {longest} is over {stretch_ratio:g} times its length at t = {time}"


def first_diverged_frame(system: MassSpringSystem, trajectory: Trajectory, stretch_ratio: float) -> int:
    """The first frame with a position that is not finite or a spring beyond a stretch ratio; else their number."""
    lost = ~np.isfinite(trajectory.positions).all(axis=(1, 2))
    long = (_stretch_ratios(system, trajectory) > stretch_ratio).any(axis=1)
    diverged = lost | long
    return int(np.argmax(diverged)) if diverged.any() else len(trajectory)


def _stretch_ratios(system: MassSpringSystem, trajectory: Trajectory) -> Array:
    """Stretch ratio: length over natural length, of every spring in every frame, shape (m, s)."""
    x = trajectory.positions
    a, b = system.springs.T
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.linalg.norm(x[:, b] - x[:, a], axis=2)
        return np.asarray(length / np.maximum(system.rest_lengths, length[0]))
