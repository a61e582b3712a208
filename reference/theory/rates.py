"""The eigenvalues of the equations of motion about an equilibrium, z' = A z: how fast every mode swings and decays.

Without damping they are +- i w with w^2 the eigenvalues of M^-1 K, a symmetric problem. With damping all of a small
system's are had at once; of a large one those that lie outermost.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.schemes import catalogue
from reference.state import Array
from reference.theory.equilibria import Equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.step_map import step_jacobian

Complex = npt.NDArray[np.complex128]

#: Up to this many unknowns (positions and velocities) all eigenvalues are taken.
ALL_UP_TO = 1300

#: Up to this many coordinates all are as quick as the fastest alone.
QUICK_UP_TO = 100

#: How many of the outermost are taken of larger systems, in each direction, and in how many rounds of iteration.
OUTER, MOST_ROUNDS = 6, 100

#: Parts of the fastest rate below which a real part, a frequency squared is zero but for rounding.
UNDAMPED, UNRESISTED = 1e-12, 1e-10

#: Parts of the fastest rate: real parts smaller than WEAK have lost digits; eigenvalues TOGETHER have one space.
WEAK, TOGETHER = 1e-9, 1e-12

#: What dampers do to a mode that does not change their length, as a part of what they could: squares of rounding.
UNSEEN = 1e-26


@dataclass(frozen=True, eq=False)
class Rates:
    """Eigenvalues of A.

    Attributes:
        values: [1/s], of motion that something resists; a real part that is rounding is zero.
        unresisted: how many eigenvalues are zero: motion that nothing resists goes on as it is begun.
        all: whether these are all, or the outermost only.
    """

    values: Complex
    unresisted: int
    all: bool

    @property
    def fastest(self) -> float:
        """The largest modulus [1/s]."""
        return float(np.abs(self.values).max(initial=0.0))

    @property
    def least_decay(self) -> float:
        """The smallest rate at which a mode decays [1/s]; zero where one does not."""
        return float(-self.values.real.max(initial=-np.inf))


def rates(rest: Equilibrium) -> Rates:
    """Of whatever equations of motion."""
    linear = rest.linear
    if linear is None:
        return _by_euler(rest)
    if not linear.damped and not linear.dragged:
        return _undamped(linear)
    return _damped(linear) if 2 * len(linear.mass) <= ALL_UP_TO else _outermost(linear)


def fastest_rate(rest: Equilibrium) -> float:
    """The largest modulus of an eigenvalue [1/s], no others: the highest frequency, or the fastest decay."""
    linear = rest.linear
    if linear is None:
        return _by_euler(rest).fastest
    if len(linear.mass) <= QUICK_UP_TO:
        return rates(rest).fastest
    if not linear.damped and not linear.dragged:
        return float(_top_undamped(linear).item())
    return float(np.abs(_eigenvalues(linear, "LM")).max())


def unresisted_directions(linear: Linearisation) -> int:
    """Along how many directions no spring resists a move: eigenvalues of K that are zero but for rounding."""
    values = np.linalg.eigvalsh(linear.scaled_stiffness.toarray())
    return int((values <= UNRESISTED * values.max(initial=0.0)).sum())


def _undamped(linear: Linearisation) -> Rates:
    if 2 * len(linear.mass) <= ALL_UP_TO:
        squares = np.linalg.eigvalsh(linear.scaled_stiffness.toarray())
        kept = squares > UNRESISTED * squares.max(initial=0.0)
        frequencies, unresisted = np.sqrt(squares[kept]), 2 * int((~kept).sum())
    else:
        frequencies, unresisted = _top_undamped(linear), 0
    return Rates(np.concatenate([1j * frequencies, -1j * frequencies]), unresisted, 2 * len(linear.mass) <= ALL_UP_TO)


def _damped(linear: Linearisation) -> Rates:
    values = np.linalg.eigvals(linear.operator.toarray()).astype(complex)
    directions = unresisted_directions(linear)
    # a direction without spring and drag has the eigenvalue zero twice, with drag once, and once the rate it stops at
    unresisted = directions if linear.dragged else 2 * directions
    kept = values[np.argsort(np.abs(values), kind="stable")[unresisted:]]
    if np.abs(kept.real).min(initial=np.inf) <= WEAK * np.abs(kept).max(initial=0.0):
        kept = _with_weak_decay(linear, len(kept))
    return Rates(kept, unresisted, True)


def _with_weak_decay(linear: Linearisation, count: int) -> Complex:
    """So many eigenvalues, the largest, with the real parts of those that hardly decay to their own digits.

    With Omega^2 the eigenvalues of M^-1/2 K M^-1/2 and C of the damping, along their eigenvectors, the motion is

        d/dt (Omega q, v) = [[0, Omega], [-Omega, -C]] (Omega q, v),

    a skew matrix less a symmetric one. So an eigenvector x of length one has the real part -x_v* C x_v, exactly, where
    of the eigenvalue itself rounding leaves some 1e-15 of the fastest. Modes whose frequencies are as near to one
    another as that are taken together: within their space C is diagonalised.
    """
    squares, along = np.linalg.eigh(linear.scaled_stiffness.toarray())
    omega = np.diag(np.sqrt(np.maximum(squares, 0.0)))
    damping = along.T @ linear.scaled(linear.damping_and_drag).toarray() @ along
    values, vectors = np.linalg.eig(np.block([[0 * omega, omega], [-omega, -damping]]))
    order = np.argsort(np.abs(values), kind="stable")[-count:]
    values, vectors = values[order].astype(complex), vectors[:, order]
    fastest = float(np.abs(values).max())
    weak = np.flatnonzero(np.abs(values.real) <= WEAK * fastest)
    weak = weak[np.argsort(values[weak].imag, kind="stable")]
    for together in np.split(weak, 1 + np.flatnonzero(np.diff(values[weak].imag) > TOGETHER * fastest)):
        basis, _ = np.linalg.qr(vectors[:, together])
        velocities = basis[len(omega) :]
        decay = np.linalg.eigvalsh(velocities.conj().T @ damping @ velocities)
        decay[decay <= UNSEEN * np.abs(damping).max()] = 0.0
        values[together] = -decay + 1j * values[together].imag
    return values


def _outermost(linear: Linearisation) -> Rates:
    found = [_eigenvalues(linear, which) for which in ("LM", "LI", "SR")]
    return _without_rounding(np.concatenate(found), 0, False)


def _eigenvalues(linear: Linearisation, which: str) -> Complex:
    """Some of the outermost; those that iteration tells from their neighbours in MOST_ROUNDS."""
    from scipy.sparse.linalg import ArpackNoConvergence, eigs

    start = np.random.default_rng(0).normal(size=2 * len(linear.mass))
    try:
        found = eigs(linear.operator, OUTER, which=which, v0=start, maxiter=MOST_ROUNDS, return_eigenvectors=False)
    except ArpackNoConvergence as error:
        found = error.eigenvalues
    if which == "LM" and not len(found):
        # a bound in its place: no rate is larger than the highest frequency and the fastest decay together
        found = -1j * _top_undamped(linear) - float(abs(linear.scaled(linear.damping)).sum(axis=1).max())
    return np.asarray(found)


def _top_undamped(linear: Linearisation) -> Array:
    """The highest frequency [1/s], shape (1,)."""
    from scipy.sparse.linalg import eigsh

    start = np.random.default_rng(0).normal(size=len(linear.mass))
    top = eigsh(linear.scaled_stiffness, 1, which="LA", v0=start, return_eigenvectors=False)
    return np.asarray(np.sqrt(np.maximum(top, 0.0)))


def _by_euler(rest: Equilibrium) -> Rates:
    """Euler's step of z' = A z is 1 + h A, exactly: its Jacobian has all of A in it."""
    euler, dt = catalogue.find("euler"), 1e-3
    for _ in range(3):
        values = (np.linalg.eigvals(step_jacobian(euler, rest, dt)) - 1) / dt
        fastest = float(np.abs(values).max(initial=0.0))
        if fastest == 0:
            break
        # once more with a step that suits it, so that neither positions nor velocities drown in the other
        dt = 1 / fastest
    # from differences: what is zero is known to their precision only
    moving = np.abs(values) > 1e-6 * fastest
    return _without_rounding(values[moving].astype(complex), int((~moving).sum()), True)


def _without_rounding(values: Complex, unresisted: int, all_of_them: bool) -> Rates:
    fastest = float(np.abs(values).max(initial=0.0))
    real: Array = np.where(np.abs(values.real) <= UNDAMPED * fastest, 0.0, values.real)
    return Rates(real + 1j * values.imag, unresisted, all_of_them)
