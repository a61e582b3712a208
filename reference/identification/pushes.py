"""A motion in which schemes differ, where a system's own motion has none: its masses pushed at random.

A system at rest stays so by every scheme, and one in free fall falls alike by many. A push moves every free mass,
scaled to the springs, and the step is as long as the fastest rate allows: the catalogue then differs by far more than
rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from reference.identification.scale import fastest_rate_bound
from reference.state import Array
from reference.system import MassSpringSystem

#: A push moves masses by up to this part of the shortest spring, along each axis.
PART = 0.1


@dataclass(frozen=True, eq=False)
class Push:
    """A system that is pushed, and how it is stepped.

    Attributes:
        words: what was done, as people say it.
        dt: the step [s]: the system's own, or 1 / the fastest rate if that is longer.
    """

    words: str
    system: MassSpringSystem
    dt: float


def pushes(system: MassSpringSystem, dt: float) -> Iterator[Push]:
    """The system pushed, in the ways that steppers can begin: stretched and in motion, in motion, turning its springs.

    The last is for a string whose springs do not stretch. Obstacles and collisions are left out: a push may take masses
    into them.
    """
    alone = replace(system, obstacles=(), collisions=None)
    rate = fastest_rate_bound(alone)
    step = max(dt, 1 / rate) if rate else dt
    random = np.random.default_rng(0)
    aside, velocities = (_random(alone, random) for _ in range(2))
    length = PART * _length(alone)
    moved = alone.positions + length * aside
    in_motion = alone.velocities + length / step * velocities
    words = "a push of its masses" + (f", away from obstacles, with dt = {step:.3g} s" if system.obstacles else "")
    words += f", with dt = {step:.3g} s" if step != dt and not system.obstacles else ""
    yield Push(words, replace(alone, positions=moved, velocities=in_motion), step)
    yield Push(words, replace(alone, velocities=in_motion), step)
    if system.is_string:
        yield Push(words, replace(alone, velocities=_turning(alone, in_motion)), step)


def lacking(push: Push) -> Iterator[tuple[str, Push]]:
    """The pushed system with what it lacks, "damping" or "drag", to see which schemes differ by that alone."""
    system = push.system
    strength = 0.1 * float(system.masses.min()) / push.dt
    if len(system.springs) and not system.damping.any():
        yield "damping", replace(push, system=replace(system, damping=np.full(len(system.springs), strength)))
    if not system.drag:
        yield "drag", replace(push, system=replace(system, drag=strength))


def _random(system: MassSpringSystem, random: np.random.Generator) -> Array:
    return np.where(system.fixed[:, None], 0.0, random.uniform(-1, 1, system.positions.shape))


def _length(system: MassSpringSystem) -> float:
    """Of the shortest spring, as it is or at rest [m]; the system's scale where there is none."""
    if not len(system.springs):
        return system.scale
    a, b = system.springs.T
    lengths = np.linalg.norm(system.positions[b] - system.positions[a], axis=1)
    return float(min(lengths[lengths > 0].min(initial=np.inf), system.shortest))


def _turning(system: MassSpringSystem, velocities: Array) -> Array:
    """Velocities of a string without what stretches its springs, from the fixed mass on."""
    segments = np.diff(system.positions, axis=0)
    directions = segments / np.linalg.norm(segments, axis=1)[:, None]
    relative = np.diff(velocities, axis=0)
    across = relative - (relative * directions).sum(axis=1)[:, None] * directions
    return np.concatenate([velocities[:1], velocities[0] + np.cumsum(across, axis=0)])
