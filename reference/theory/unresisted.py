"""Motion that nothing resists, taken out of a step before its eigenvalues are asked for.

A part that no spring holds has moves u with K u = 0. In every scheme (u, 0) stays where it is, for springs do not see
it: an eigenvector of the step with the eigenvalue 1. If nothing resists its velocity either, C u = 0, a step of the
whole state carries (0, u) into (h u, u): the two are one block of Jordan's, which rounding tears apart by its own root,
and more where something else is damped strongly. The rest of the step is a map of its own, without either: of moves
that are orthogonal to u, by mass, as K and C are symmetric. Only a step that moves one mass before another has seen it
changes the velocity of such motion; there (0, u) stays in, an eigenvalue like any other once its partner is out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of
from reference.theory.rates import moves_without_spring
from reference.theory.step_increments import is_exact


@dataclass(frozen=True)
class Remainder:
    """What is left of a step.

    Attributes:
        onto: from the whole state, free positions, velocities and what is remembered, to what is kept, shape (k, n).
        back: the reverse, shape (n, k).
        positions: how many moves are kept that no spring answers, with velocities that are resisted.
        velocities: how many velocities are kept that nothing resists.
    """

    onto: Array
    back: Array
    positions: int = 0
    velocities: int = 0

    def of(self, increments: Array) -> Array:
        """That of B = J - 1, shape (n, n): shape (k, k)."""
        return self.onto @ increments @ self.back


def remainder(scheme: Scheme, rest: Equilibrium) -> Remainder | None:
    """What is left of a scheme's step without motion that nothing resists; None of steps that are differenced."""
    if rest.linear is None or rest.contacts is not None or not is_exact(scheme, rest):
        return None
    springs, slowed, unresisted = moves_without_spring(rest.linear)
    moving = np.hstack([springs, slowed])
    root = np.sqrt(rest.linear.mass)[:, None]
    if not scheme.one_step:
        # what is remembered of (u, 0) is not known here: of moves without spring those alone are out that nothing slows
        layout, _ = layout_of(scheme, rest, 1.0)
        kept = [moving] * (2 + layout.remembered)
        return None if layout.of_springs else Remainder(*_maps(kept, root), positions=slowed.shape[1])
    if scheme.needs == "accelerations":
        return Remainder(*_maps([springs, moving], root))
    everything = np.hstack([moving, unresisted])
    return Remainder(*_maps([springs, everything], root), velocities=unresisted.shape[1])


def _maps(kept: list[Array], root: Array) -> tuple[Array, Array]:
    """Onto what is kept of each array of the state, and back, from orthonormal moves of M^1/2 q."""
    from scipy.linalg import block_diag

    return block_diag(*[(root * q).T for q in kept]), block_diag(*[q / root for q in kept])
