"""Where masses come to rest on obstacles: least energy outside of them, and which contacts press there.

In two steps. First downhill with a barrier, -mu log g for every mass at a signed distance g, mu [J] ever smaller: no
mass can pass through a surface, and where it comes to rest the surface pushes with mu / g (interior points: Nocedal and
Wright, *Numerical Optimization* (2006), 19.6). Then, with the masses that are pressed held to their surfaces, Newton's
method on the forces' balance itself, in which the contacts' forces N are unknown too:

    F + N n = 0,   g = 0        with N > 0 where a mass touches, g > 0 where it does not.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.errors import SolverError
from reference.obstacles import Obstacle
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem
from reference.theory.contacts import APART, Contacts, block_diagonal, curvatures, curving
from reference.theory.least_energy import Descent, force_tolerance

#: The barrier's mu, as a part of a mass's weight times the size: the first, the last, and each as a part of the one
#: before.
FIRST, LAST, SMALLER = 1e-2, 1e-6, 0.1

#: How far masses that touch at the start are lifted off first, and beyond which a system has fallen past all
#: obstacles; parts of its size.
LIFTED, FAR = 1e-6, 20.0

#: So many steps downhill with each barrier; what slides along a surface may take for ever.
MOST_STEPS = 500

#: How often it is decided anew which masses touch.
ROUNDS = 20

#: What rounding leaves of a stiffness, as a part of the largest.
TRACE = 1e-13


def rest_on_obstacles(system: MassSpringSystem) -> tuple[State, Contacts]:
    """The stable state at rest outside all obstacles, downhill from the start, and the contacts that press there.

    Raises:
        SolverError: if there is none: it falls past them, or slides off; or if it is not reached.
    """
    descent = _OutsideObstacles(system)
    q = descent.lifted(system.positions[~system.fixed].ravel())
    part = FIRST
    while part > 0.5 * LAST:
        descent.barrier = part * descent.ordinary * descent.size
        q = descent.downhill(q)
        part *= SMALLER
    q = descent.off_ridges(q)
    return _balanced(descent, q)


def _loads(system: MassSpringSystem) -> Array:
    """What every free mass weighs, and what pulls on it [N], shape (n, d)."""
    return (system.masses[:, None] * system.gravity + system.pulls) * ~system.fixed[:, None]


class _OutsideObstacles(Descent):
    """The energy of a system with a barrier around every obstacle. All masses weigh, also what nothing holds.

    Attributes:
        barrier: mu [J].
    """

    barrier = 0.0
    most_steps = MOST_STEPS
    quasi_newton_up_to = 0  # it has no use for an energy that is infinite somewhere

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(system, _loads(system))
        # so that no step leads in at one side of an obstacle and out at the other
        self.longest = min(0.1 * self.size, *(0.5 * _half_width(obstacle) for obstacle in system.obstacles))

    @property
    def ordinary(self) -> float:
        """The force that a mass has to bear on average [N]."""
        return self.weight / int((~self.system.fixed).sum())

    def lifted(self, q: Array) -> Array:
        """Off the surfaces by at least LIFTED."""
        least = LIFTED * self.size
        for k in range(len(self.system.obstacles)):
            distance, normals = self.gaps(q, k)
            q = q + (np.maximum(least - distance, 0.0)[:, None] * normals).ravel()
        return q

    def gaps(self, q: Array, obstacle: int) -> tuple[Array, Array]:
        """Signed distances of the free masses from an obstacle, shape (f,), and the normals there, shape (f, d)."""
        distance, normals = self.system.obstacles[obstacle].signed_distances(q.reshape(-1, self.system.dimension))
        return distance[:, 0], normals

    def energy(self, q: Array) -> float:
        """Infinite inside."""
        if np.abs(q).max(initial=0.0) > FAR * self.size + np.abs(self.system.positions).max():
            raise SolverError("no equilibrium: nothing stops it, it falls past the obstacles")
        energy = super().energy(q)
        for k in range(len(self.system.obstacles)):
            distance, _ = self.gaps(q, k)
            if distance.min(initial=np.inf) <= 0:
                return np.inf
            energy -= self.barrier * float(np.log(distance / self.size).sum())
        return energy

    def force(self, q: Array) -> Array:
        """Of springs, weight and barriers."""
        force = super().force(q)
        if not self.barrier:
            return force
        for k in range(len(self.system.obstacles)):
            distance, normals = self.gaps(q, k)
            force = force + (self.barrier / distance[:, None] * normals).ravel()
        return force

    def stiffness(self, q: Array, tension_only: bool = False) -> Any:
        """Of springs and barriers: mu / g^2 along the normal, - mu / g as the surface curves."""
        whole = super().stiffness(q, tension_only)
        if not self.barrier:
            return whole
        places = q.reshape(-1, self.system.dimension)
        for k, obstacle in enumerate(self.system.obstacles):
            distance, normals = self.gaps(q, k)
            pushed = self.barrier / distance[:, None, None]
            blocks = pushed / distance[:, None, None] * normals[:, :, None] * normals[:, None, :]
            if not tension_only:
                blocks = blocks - pushed * curvatures(obstacle, places, APART * self.size)
            whole = whole + block_diagonal(blocks)
        return whole


def _balanced(descent: _OutsideObstacles, q: Array) -> tuple[State, Contacts]:
    """From the barrier's rest to that of hard obstacles."""
    touching = _pressed(descent, q)
    forces = np.array([descent.barrier / descent.gaps(q, k)[0][f] for f, k in touching])
    descent.barrier = 0.0
    for _ in range(ROUNDS):
        q, forces = _newton(descent, q, touching, forces)
        pushing = forces > 0
        inside = _inside(descent, q, touching)
        if pushing.all() and not inside:
            return descent.at(q), _contacts(descent, q, touching, forces)
        touching = [pair for pair, kept in zip(touching, pushing, strict=True) if kept] + inside
        forces = np.concatenate([forces[pushing], np.zeros(len(inside))])
    raise SolverError("no equilibrium: which masses rest on the obstacles could not be told, some hardly touch")


def _pressed(descent: _OutsideObstacles, q: Array) -> list[tuple[int, int]]:
    """Pairs of a free mass and an obstacle that touch: where the barrier's force says more than the distance."""
    pairs = []
    for k in range(len(descent.system.obstacles)):
        distance, _ = descent.gaps(q, k)
        touching = descent.barrier / distance / descent.ordinary > distance / descent.size
        pairs += [(int(f), k) for f in np.flatnonzero(touching)]
    return pairs


def _inside(descent: _OutsideObstacles, q: Array, touching: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Masses that have come inside an obstacle that they were not held to."""
    found = []
    for k in range(len(descent.system.obstacles)):
        distance, _ = descent.gaps(q, k)
        found += [(int(f), k) for f in np.flatnonzero(distance < -1e-12 * descent.size) if (int(f), k) not in touching]
    return found


def _newton(
    descent: _OutsideObstacles, q: Array, touching: list[tuple[int, int]], forces: Array
) -> tuple[Array, Array]:
    """Coordinates and contact forces at which both equations hold, to rounding."""
    from scipy.sparse import block_array, csc_array
    from scipy.sparse.linalg import splu

    d, c = descent.system.dimension, len(touching)
    for _ in range(40):
        distances = np.array([descent.gaps(q, k)[0][f] for f, k in touching])
        normals = np.zeros((c, len(q)))
        for row, (f, k) in zip(normals, touching, strict=True):
            row[f * d : f * d + d] = descent.gaps(q, k)[1][f]
        along = csc_array(normals)
        free = descent.stiffness(q)
        if c:
            contacts = _contacts(descent, q, touching, forces)
            free = free - curving(descent.system, descent.at(q).positions, contacts)
        stiffest = abs(free).max() or 1.0
        # so that what nothing holds, and contacts that say the same twice, can be solved for
        free = free + TRACE * stiffest * _identity(len(q))
        soft = TRACE / stiffest * _identity(c)
        whole = block_array([[free, -along.T], [-along, -soft]]) if c else free
        right = np.concatenate([descent.force(q) + normals.T @ forces, distances])
        change = splu(whole.tocsc()).solve(right)
        q, forces = q + change[: len(q)], forces + change[len(q) :]
        if np.abs(change[: len(q)]).max(initial=0.0) < 1e-14 * descent.size:
            break
    left = np.abs(descent.force(q) + normals.T @ forces).max(initial=0.0)
    if not left < force_tolerance(descent.system, descent.weight):
        raise SolverError("no equilibrium: the forces do not balance anywhere near the start")
    return q, forces


def _contacts(descent: _OutsideObstacles, q: Array, touching: list[tuple[int, int]], forces: Array) -> Contacts:
    """By mass of the whole system."""
    free = np.flatnonzero(~descent.system.fixed)
    masses: IntArray = np.array([free[f] for f, _ in touching], dtype=int)
    obstacles: IntArray = np.array([k for _, k in touching], dtype=int)
    normals = np.array([descent.gaps(q, k)[1][f] for f, k in touching]).reshape(-1, descent.system.dimension)
    return Contacts(masses, obstacles, normals, forces)


def _half_width(obstacle: Obstacle) -> float:
    """Of its thinnest part [m]."""
    values = obstacle.to_dict()
    return float(min(values.get("radius", np.inf), *values.get("half_sizes", [np.inf])))


def _identity(size: int) -> Any:
    from scipy.sparse import diags_array

    return diags_array(np.ones(size))
