"""Small oscillations about an equilibrium: natural modes, frequencies, in closed form where there is one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.assembly import assemble, spring_blocks
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.linearisation import Linearisation


@dataclass(frozen=True, eq=False)
class NaturalModes:
    """The modes of M q'' + K q = 0 about a rest, slowest first, and what damping and drag make of each.

    Attributes:
        frequencies: natural, without damping [Hz], shape (k,); zero where nothing brings a mass back.
        shapes: moves of all masses, the largest 1, shape (k, n, d).
        rates: of decay, g in q'' + g q' + w^2 q = 0 [1/s], shape (k,).
        coupled: how much of the damping does not act within modes but between them, as a part of it: where that is
            not zero, `rates` are what is left of it.
    """

    frequencies: Array
    shapes: Array
    rates: Array
    coupled: float

    @property
    def damping_ratios(self) -> Array:
        """Zeta = g / (2 w), shape (k,); NaN where w is zero."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.frequencies > 0, self.rates / (4 * np.pi * self.frequencies), np.nan)


#: A square of a frequency below this part of the largest is zero but for rounding.
UNRESISTED = 1e-13


def natural_modes(linear: Linearisation, lowest: int | None = None) -> NaturalModes:
    """Of a linearised system (Meirovitch, *Fundamentals of Vibrations* (2001), 7.5, 7.15).

    With shapes of unit mass, phi^T M phi = 1, the damping within a mode is g = phi^T (C + D) phi.

    Args:
        lowest: only this many, by sparse matrices.
    """
    squares, vectors = _eigenvectors(linear, lowest)
    largest = float(linear.scaled_stiffness.diagonal().max(initial=0.0))
    squares = np.where(squares > UNRESISTED * largest, squares, 0.0)
    drag = linear.on_masses(np.full(len(linear.system.masses), linear.system.drag))
    damping = vectors.T @ (linear.scaled(linear.damping + drag) @ vectors)
    rates = np.diag(damping)
    beyond = damping - np.diag(rates)
    whole = float(np.linalg.norm(damping))
    shapes = np.zeros((len(squares), *linear.system.positions.shape))
    for shape, vector in zip(shapes, vectors.T, strict=True):
        moves = linear.moves(vector / np.sqrt(linear.mass))
        shape[~linear.system.fixed] = moves.reshape(-1, linear.system.dimension) / np.abs(moves).max()
    coupled = float(np.linalg.norm(beyond)) / whole if whole else 0.0
    return NaturalModes(np.sqrt(squares) / (2 * np.pi), shapes, rates, coupled)


def _eigenvectors(linear: Linearisation, lowest: int | None) -> tuple[Array, Array]:
    """Of M^-1/2 K M^-1/2, rising; vectors as columns."""
    matrix = linear.scaled_stiffness
    size, _ = matrix.shape
    if lowest is None or lowest >= size - 1:
        values, vectors = np.linalg.eigh(matrix.toarray() if hasattr(matrix, "toarray") else matrix)
        return values[:lowest], vectors[:, :lowest]
    from scipy.sparse.linalg import eigsh

    # a little below zero, so that what nothing resists is no singular matrix
    shift = -1e-6 * float(matrix.diagonal().max())
    start = np.random.default_rng(0).normal(size=size)
    values, vectors = eigsh(matrix.tocsc(), lowest, sigma=shift, v0=start)
    order = np.argsort(values, kind="stable")
    return values[order], vectors[:, order]


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
