"""What springs do in a motion: how far they are stretched, and with which force they pull."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from reference.conserved import energy_parts
from reference.scenes import Setup
from reference.springs.breaking import stretches_and_tensions
from reference.state import Array, State, Trajectory
from reference.system import BREAK, MassSpringSystem

#: How many springs in frames are computed at once.
AT_ONCE = 1_000_000


@dataclass(frozen=True, eq=False)
class SpringFrames:
    """Springs at some times.

    Attributes:
        frames: which frames of the trajectory.
        stretch: length less rest length [m], shape (m, s); not a number once a spring is broken.
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
        _forget_broken(setup, which, stretch)
        yield SpringFrames(range(begin, begin + len(which)), stretch, force)


def _forget_broken(setup: Setup, steps: Sequence[int], stretch: Array) -> None:
    """A spring that is broken has no stretch: what its ends do is no longer its own."""
    for change in setup.changes:
        if change.parameter == BREAK:
            since = np.flatnonzero(np.asarray(steps) > change.step(setup.dt))
            stretch[np.ix_(since, np.atleast_1d(change.value).astype(int))] = np.nan


def _springs(system: MassSpringSystem, part: Trajectory) -> tuple[Array, Array]:
    """Stretches and forces in frames with one and the same system, both (m, s)."""
    return stretches_and_tensions(system, part.positions, part.velocities)


def energies(setup: Setup, motion: Trajectory, frames: Sequence[int]) -> dict[str, Array]:
    """Kinetic, elastic, gravitational and total energy [J] at some steps, each of shape (m,)."""
    systems = setup.systems_at(frames)
    parts = [
        energy_parts(system, State(0.0, motion.positions[i], motion.velocities[i]))
        for i, system in zip(frames, systems, strict=True)
    ]
    return {name: np.array([part[name] for part in parts]) for name in parts[0]}
