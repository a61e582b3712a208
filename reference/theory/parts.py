"""The parts of a system: what springs hold together, and what each part carries at rest.

Parts that no spring joins do not know of one another: each has its own equilibrium and its own frequencies. A part
that nothing holds is told about in the frame that falls with it: there nothing weighs, but for what drag does to masses
that differ. A loose mass is such a part, with no spring.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reference.errors import SolverError
from reference.state import Array
from reference.system import BoolArray, IntArray, MassSpringSystem


@dataclass(frozen=True, eq=False)
class Parts:
    """Which part every mass belongs to.

    Attributes:
        of_mass: the part of every mass, shape (n,); fixed masses have none, -1.
        held: whether a spring joins a part to a fixed mass, shape (parts,).
    """

    of_mass: IntArray
    held: BoolArray

    @property
    def loose(self) -> IntArray:
        """The masses of the parts that nothing holds, rising."""
        return np.flatnonzero((self.of_mass >= 0) & ~self.held[self.of_mass])


def parts_of(system: MassSpringSystem) -> Parts:
    """The parts that springs with stiffness hold together, angular ones too; a fixed mass joins nothing to anything."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    n, free = len(system.positions), ~system.fixed
    a, b = system.springs[system.stiffness > 0].T
    if system.angular_springs is not None:
        resists = system.angular_springs.masses[system.angular_springs.stiffness > 0]
        a, b = np.concatenate([[a, b], resists[:, :2].T, resists[:, 1:].T], axis=1)
    inner = free[a] & free[b]
    joined = coo_array((np.ones(inner.sum()), (a[inner], b[inner])), shape=(n, n))
    _, labels = connected_components(joined, directed=False)
    numbers, of_free = np.unique(labels[free], return_inverse=True)
    of_mass = np.full(n, -1)
    of_mass[free] = of_free
    held = np.zeros(len(numbers), dtype=bool)
    for one, other in ((a, b), (b, a)):
        held[of_mass[one[free[one] & ~free[other]]]] = True
    return Parts(of_mass, held)


def loads(system: MassSpringSystem, parts: Parts) -> Array:
    """What springs must carry for every mass at rest [N], shape (n, d): its weight, if its part is held.

    What nothing holds falls, in the long run with one velocity V: with drag, where m g of the whole part is Cd V of the
    whole part, so that mass i is left with (m_i - mean m) g. Without drag all masses fall alike, and nothing is left.

    Raises:
        SolverError: where a damper without stiffness joins what hangs on nothing else to what falls otherwise, or not:
            it creeps for ever.
    """
    _refuse_creep(system, parts)
    carried = system.masses.copy()
    for part in np.flatnonzero(~parts.held):
        members = parts.of_mass == part
        carried[members] = (system.masses[members] - system.masses[members].mean()) if system.drag else 0.0
    carried[system.fixed] = 0.0
    return carried[:, None] * system.gravity + _pulled(system, parts)


def _pulled(system: MassSpringSystem, parts: Parts) -> Array:
    """What pulls on the masses [N]; of a part that nothing holds, in the frame that the whole pull accelerates.

    Raises:
        SolverError: for such a part with drag.
    """
    pulls = np.where(system.fixed[:, None], 0.0, system.pulls)
    for part in np.flatnonzero(~parts.held) if pulls.any() else ():
        members = parts.of_mass == part
        if pulls[members].any() and system.drag:
            raise SolverError("no equilibrium: a mass is pulled, and with drag, that nothing holds; hold it")
        masses = system.masses[members]
        pulls[members] -= masses[:, None] * (pulls[members].sum(axis=0) / masses.sum())
    return pulls


def falling_velocities(system: MassSpringSystem) -> Array:
    """How fast every mass falls in the long run [m/s], shape (n, d): m g over Cd, m the mean of a part nothing holds.

    Zero without drag: all fall alike then, however fast.
    """
    parts, velocities = parts_of(system), np.zeros_like(system.positions)
    for part in np.flatnonzero(~parts.held) if system.drag else ():
        members = parts.of_mass == part
        velocities[members] = system.masses[members].mean() * system.gravity / system.drag
    return velocities


def in_falling_frame(system: MassSpringSystem) -> MassSpringSystem:
    """A system in the frames that fall with its parts in the long run: what falls there stays where it is.

    Forces are linear in velocities, so a perturbation does the same; and it does not drown in how far all has fallen.
    Raises SolverError as `loads` does.
    """
    return replace(system, gravity=np.zeros(system.dimension), pulls=loads(system, parts_of(system)))


def _refuse_creep(system: MassSpringSystem, parts: Parts) -> None:
    """A damper alone between what falls and what does not turns as it creeps: nothing comes to rest."""
    dampers = (system.stiffness == 0) & (system.damping > 0)
    a, b = parts.of_mass[system.springs[dampers]].T
    held = np.append(parts.held, True)  # the part of fixed masses, -1, is the last
    # two that fall alike do not move apart
    apart = np.flatnonzero((a != b) & ((held[a] != held[b]) | (~held[a] & (system.drag > 0))))
    if len(apart) and system.gravity.any():
        j = int(np.flatnonzero(dampers)[apart[0]])
        raise SolverError(
            f"no equilibrium: spring {j} has damping and no stiffness, and what hangs on it creeps; give it a stiffness"
        )
