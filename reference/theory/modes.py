"""Small oscillations about an equilibrium: frequencies, in closed form where there is one."""

from __future__ import annotations

import numpy as np

from reference.assembly import assemble, spring_blocks
from reference.state import Array, State
from reference.system import MassSpringSystem


def squared_frequencies(system: MassSpringSystem, state: State, lowest: int | None = None) -> Array:
    """The squares w^2 [1/s^2] of the small oscillations about an equilibrium, rising, shape (free masses x d,).

    From K q = w^2 M q with K the derivative of the forces, damping and drag left out.

    Args:
        lowest: only this many, the slowest, by sparse matrices: for systems of thousands of masses that are held.
    """
    mass = np.repeat(system.masses[~system.fixed], system.dimension)
    if lowest is not None and lowest < len(mass) - 1:
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import eigsh

        stiffness = -assemble(system, spring_blocks(system, state)[0], sparse=True)
        # always the same start, and one that no symmetry keeps from any of them
        start = np.random.default_rng(0).normal(size=len(mass))
        return np.sort(eigsh(stiffness, lowest, diags_array(mass).tocsc(), sigma=0.0, v0=start)[0])
    from scipy.linalg import eigh

    stiffness = -assemble(system, spring_blocks(system, state)[0], sparse=False)
    values: Array = eigh(stiffness, np.diag(mass), eigvals_only=True)
    return values if lowest is None else values[:lowest]


def laguerre_frequencies(links: int, length: float, gravity: float) -> Array:
    """The squares w^2 [1/s^2] of the swings of n equal masses on n equal rods, rising, shape (n,).

    w^2 = (g/l) x_i with x_i the zeros of the Laguerre polynomial L_n: the hanging string's frequencies across itself
    in the limit of infinite stiffness (Lagrange, *Mecanique analytique*, 1788, on the loaded string).
    """
    from scipy.special import roots_laguerre

    zeros: Array = roots_laguerre(links)[0]
    return gravity / length * zeros


def string_mode(masses: int) -> float:
    """Lambda of the fastest mode of a string along itself, w^2 = (k/m) lambda: 4 sin^2((2n-1) pi / (4n+2))."""
    return float(4 * np.sin((2 * masses - 1) * np.pi / (4 * masses + 2)) ** 2)
