"""Random systems that the page and the reference run side by side."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from reference.errors import InputError
from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.springs.kinds import NonlinearSprings
from reference.system import MassSpringSystem


def random_system(seed: int) -> tuple[MassSpringSystem, float]:
    """A random mesh in one, two or three dimensions, and a dt from safe to far too long for it."""
    random = np.random.default_rng(seed)
    d = int(random.integers(1, 4))
    n = int(random.integers(2, 14))
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    chosen = random.choice(len(pairs), size=min(len(pairs), int(random.integers(1, 3 * n))), replace=False)
    ends = np.array([pairs[k] if random.random() < 0.5 else pairs[k][::-1] for k in sorted(chosen)])
    s = len(ends)
    fixed = random.random(n) < 0.2
    stiffness = random.uniform(0, 300, s)
    masses = random.uniform(0.01, 0.2, n)
    system = MassSpringSystem(
        positions=random.normal(size=(n, d)),
        springs=ends,
        masses=masses,
        rest_lengths=random.uniform(0.1, 1.5, s),
        stiffness=stiffness,
        damping=random.uniform(0, 0.5, s) if random.random() < 0.5 else np.array(0.0),
        drag=float(random.uniform(0, 0.2)) if random.random() < 0.5 else 0.0,
        gravity=random.normal(size=d) if random.random() < 0.3 else np.array(9.81),
        velocities=np.where(fixed[:, None], 0.0, random.normal(size=(n, d))),
        fixed=fixed,
    )
    for obstacle in random_obstacles(random, d):
        with suppress(InputError):  # a mass would start inside
            system = replace(system, obstacles=(*system.obstacles, obstacle))
    safe = random.random() < 0.6
    return system, float(10 ** (random.uniform(-3.5, -1.0) if safe else random.uniform(0.0, 2.0)))


def with_random_kinds(system: MassSpringSystem, seed: int) -> MassSpringSystem:
    """The same with springs each of a kind: linear, hardening, yielding, ropes, struts, and some that break."""
    random = np.random.default_rng(seed)
    s = len(system.springs)
    kind = random.integers(5, size=s)
    breaks = random.random((2, s)) < 0.2
    law = NonlinearSprings(
        tension_only=kind == 1,
        compression_only=kind == 2,
        hardening=np.where(kind == 3, random.uniform(0, 1e3, s), 0.0),
        largest_force=np.where(kind == 4, random.uniform(0.1, 20, s), np.inf),
        breaking_force=np.where(breaks[0], random.uniform(1, 50, s), np.inf),
        breaking_stretch=np.where(breaks[1], random.uniform(0.1, 3, s), np.inf),
    )
    return replace(system, nonlinear=law)


def with_masses_together(system: MassSpringSystem) -> MassSpringSystem:
    """The same with every second spring of rest length 0, the first of them of no length at the start, at rest."""
    rest_lengths, positions, velocities = system.rest_lengths.copy(), system.positions.copy(), system.velocities.copy()
    rest_lengths[::2] = 0.0
    a, b = system.springs[0]
    positions[b], velocities[b] = positions[a], velocities[a]
    fixed = system.fixed.copy()
    fixed[[a, b]] = False
    return replace(
        system, rest_lengths=rest_lengths, positions=positions, velocities=velocities, fixed=fixed, obstacles=()
    )


def random_obstacles(random: np.random.Generator, d: int) -> tuple[Obstacle, ...]:
    """None, one or two of any kinds that there are in that space."""

    def place() -> tuple[float, ...]:
        return tuple(random.normal(size=d).tolist())

    def any_of() -> Obstacle:
        size = float(random.uniform(0.1, 0.8))
        kinds: list[Obstacle] = [Plane(place(), place())]
        if d > 1:
            kinds.append(Box(place(), tuple(random.uniform(0.1, 0.8, d).tolist())))
        if d == 2:
            kinds.append(Circle(place(), size))
        if d == 3:
            kinds += [Sphere(place(), size), Cylinder(place(), place(), size)]
        return kinds[int(random.integers(len(kinds)))]

    return tuple(any_of() for _ in range(int(random.integers(0, 4))))
