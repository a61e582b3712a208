"""What springs do in a motion: how far they are stretched, and with which force they pull."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from reference.conserved import energy_parts
from reference.lengths import between, spring_lengths
from reference.scenes import Setup
from reference.spring_law import spring_force
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem

#: How many springs in frames are computed at once.
AT_ONCE = 1_000_000


@dataclass(frozen=True, eq=False)
class SpringFrames:
    """Springs at some times.

    Attributes:
        frames: which frames of the trajectory.
        stretch: length less rest length [m], shape (m, s).
        force: with which each pulls its masses together [N], its damper's part included; below zero it pushes.
    """

    frames: range
    stretch: Array
    force: Array


def spring_frames(setup: Setup, motion: Trajectory, frames: Sequence[int] | None = None) -> Iterator[SpringFrames]:
    """Springs in a motion, some frames at a time, with the parameters that the system has then.

    Args:
        motion: of every step, or of its beginning.
        frames: which steps; left out, all.
    """
    chosen = range(len(motion)) if frames is None else frames
    many = max(1, AT_ONCE // max(1, len(setup.system.springs)))
    systems = setup.systems_at(chosen) if setup.changes else None
    for begin in range(0, len(chosen), many):
        which = chosen[begin : begin + many]
        part = motion.frames(list(which))
        if systems is None:
            stretch, force = _springs(setup.system, part)
        else:
            each = [_springs(system, part.frames([i])) for i, system in enumerate(systems[begin : begin + len(which)])]
            stretch, force = (np.concatenate(rows) for rows in zip(*each, strict=True))
        yield SpringFrames(range(begin, begin + len(which)), stretch, force)


def _springs(system: MassSpringSystem, part: Trajectory) -> tuple[Array, Array]:
    """Stretches and forces in frames with one and the same system, both (m, s)."""
    length = spring_lengths(part.positions, system.springs)
    stretch = length - system.rest_lengths
    rate = np.zeros(1)
    if system.damping.any():
        along = zip(between(part.positions, system.springs), between(part.velocities, system.springs), strict=True)
        with np.errstate(invalid="ignore", divide="ignore"):
            rate = np.where(length > 0, sum(x * v for x, v in along) / length, 0.0)
        # an engine that tells no velocities has forces all the same where a spring is not damped
        rate = np.where(system.damping > 0, rate, 0.0)
    return stretch, spring_force(system.stiffness, stretch, system.damping, rate)


def energies(setup: Setup, motion: Trajectory, frames: Sequence[int]) -> dict[str, Array]:
    """Kinetic, elastic, gravitational and total energy [J] at some steps, each of shape (m,)."""
    systems = setup.systems_at(frames)
    parts = [
        energy_parts(system, State(0.0, motion.positions[i], motion.velocities[i]))
        for i, system in zip(frames, systems, strict=True)
    ]
    return {name: np.array([part[name] for part in parts]) for name in parts[0]}
