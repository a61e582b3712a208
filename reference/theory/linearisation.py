"""The equations of motion about an equilibrium, linearised once: M q'' + (C + D) q' + K q = 0, in sparse matrices.

q are small moves of the free masses, coordinate by coordinate, shape (m,). M is diagonal; K is symmetric, its part
from springs' forces across themselves included; C = sum of c_j u_j u_j^T over springs with their directions u; D is
drag, the same on every mass. Every scheme's limit is taken from these (`limits`).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from reference.assembly import Blocks, assemble, damping_blocks, spring_blocks
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.linear_motion import LinearMotion


@dataclass(frozen=True, eq=False)
class Linearisation:
    """A system of springs about an equilibrium.

    Attributes:
        system: whose masses, damping and drag these are.
        state: at rest.
        known_limits: of matrices S(h) that several schemes have in common (`definite`), by what they are made of.
    """

    system: MassSpringSystem
    state: State
    known_limits: dict[object, float] = field(default_factory=dict)

    @cached_property
    def motion(self) -> LinearMotion:
        """The same as equations of motion, for schemes to step."""
        return LinearMotion(self.system, self.state)

    @cached_property
    def mass(self) -> Array:
        """The diagonal of M [kg], shape (m,)."""
        return np.repeat(self.system.masses[~self.system.fixed], self.system.dimension)

    @cached_property
    def stiffness(self) -> Any:
        """K [N/m], sparse, shape (m, m)."""
        return -assemble(self.system, spring_blocks(self.system, self.state)[0], sparse=True)

    @cached_property
    def damping(self) -> Any:
        """C [N s/m], sparse, shape (m, m): of the springs; the drag is not in it."""
        return self.along_springs(self.system.damping)

    def along_springs(self, coefficients: Array) -> Any:
        """Sum of the coefficients, shape (s,), times u u^T over the springs: sparse, shape (m, m)."""
        return -assemble(self.system, damping_blocks(self.system, self.state, coefficients), sparse=True)

    @cached_property
    def _unit_blocks(self) -> Array:
        """U u^T of every spring, shape (s, d, d)."""
        return damping_blocks(self.system, self.state, np.ones(len(self.system.springs))).springs

    def array_of(self, springs: Array, masses: Array) -> Array:
        """What is along the springs and what is on the masses together, as an array, of small systems: shape (m, m)."""
        blocks = Blocks(-springs[:, None, None] * self._unit_blocks, -masses)
        return np.asarray(assemble(self.system, blocks, sparse=False))

    def scaled_array(self, springs: Array, masses: Array) -> Array:
        """M^-1/2 A M^-1/2 of that array."""
        root = self.mass**-0.5
        return root[:, None] * self.array_of(springs, masses) * root

    def on_masses(self, coefficients: Array) -> Any:
        """A diagonal matrix of one coefficient per mass, shape (n,), the same along each axis: shape (m, m)."""
        from scipy.sparse import diags_array

        return diags_array(np.repeat(coefficients[~self.system.fixed], self.system.dimension)).tocsc()

    def moves(self, along: Array) -> Array:
        """Moves of the free masses, coordinate by coordinate, from the coordinates q, shape (m,)."""
        return along

    @property
    def damped(self) -> bool:
        """Whether springs are."""
        return bool(self.system.damping.any())

    @property
    def dragged(self) -> bool:
        """Whether masses are."""
        return self.system.drag > 0

    @cached_property
    def scaled_stiffness(self) -> Any:
        """M^-1/2 K M^-1/2 [1/s^2], whose eigenvalues are the squares of the frequencies: sparse, shape (m, m)."""
        return self.scaled(self.stiffness)

    def scaled(self, matrix: Any) -> Any:
        """M^-1/2 A M^-1/2 of a sparse A."""
        scaled, root = matrix.tocsc(copy=True), self.mass**-0.5
        scaled.data *= root[scaled.indices]
        scaled.data *= np.repeat(root, np.diff(scaled.indptr))
        return scaled

    @cached_property
    def operator(self) -> Any:
        """A in z' = A z, z = (q, q'): sparse, shape (2 m, 2 m)."""
        from scipy.sparse import block_array, diags_array

        inverse = diags_array(1 / self.mass)
        slowed = self.damping_and_drag
        return block_array(
            [[None, diags_array(np.ones(len(self.mass)))], [-inverse @ self.stiffness, -inverse @ slowed]]
        ).tocsr()

    @property
    def damping_and_drag(self) -> Any:
        """All that resists velocities [N s/m]: sparse, shape (m, m)."""
        return self.damping + self.on_masses(np.full(len(self.system.masses), self.system.drag))
