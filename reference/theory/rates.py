"""The eigenvalues of the equations of motion about an equilibrium, z' = A z: how fast every mode swings and decays.

Without damping they are +- i w with w^2 the eigenvalues of M^-1 K, a symmetric problem. With damping all of a small
system's are had at once; of a large one some of the fastest and of the slowest, by inverse iteration.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.schemes import catalogue
from reference.state import Array
from reference.system import BoolArray
from reference.theory.equilibria import Equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.step_map import step_jacobian

Complex = npt.NDArray[np.complex128]

#: Up to this many unknowns (positions and velocities) all eigenvalues are taken.
ALL_UP_TO = 1300

#: Up to this many coordinates all are as quick as the fastest alone.
QUICK_UP_TO = 100

#: How many are taken of larger systems, those nearest to either end, near so many times the fastest swing; and how
#: often iteration may start again: what has not come to rest then lies as near as others do.
NEAREST, ENDS, RESTARTS = 6, (1.001, 1e-3), 40

#: The part of the fastest rate below which a real part is zero but for rounding; and of the largest eigenvalue of the
#: stiffness, or of what resists velocities, below which, for each coordinate, another is.
UNDAMPED, UNRESISTED = 1e-12, 1e-14

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
        all: whether these are all, or only some of the fastest and of the slowest.
        bound: no eigenvalue is larger [1/s]: what stands for the fastest where iteration has found none.
    """

    values: Complex
    unresisted: int
    all: bool
    bound: float = 0.0

    @property
    def fastest(self) -> float:
        """The largest modulus [1/s]."""
        return float(np.abs(self.values).max()) if len(self.values) else self.bound

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
    return _damped(linear) if 2 * len(linear.mass) <= ALL_UP_TO else _at_both_ends(linear)


def fastest_rate(rest: Equilibrium) -> float:
    """The largest modulus of an eigenvalue [1/s], no others: the highest frequency, or the fastest decay."""
    linear = rest.linear
    if linear is None:
        return _by_euler(rest).fastest
    if len(linear.mass) <= QUICK_UP_TO:
        return rates(rest).fastest
    if not linear.damped and not linear.dragged:
        return _top_undamped(linear)
    return _at_both_ends(linear, ENDS[:1]).fastest


def _is_none(values: Array) -> BoolArray:
    """Which eigenvalues of a symmetric matrix that is not negative are zero but for rounding."""
    return np.asarray(values <= UNRESISTED * len(values) * values.max(initial=0.0))


def moves_without_spring(linear: Linearisation) -> tuple[Array, Array, Array]:
    """Moves that springs answer, those that they do not but damping or drag does, and those that nothing does.

    Returns:
        An orthonormal basis of each, as columns, of M^1/2 q: shapes (m, .), three that make up the whole.
    """
    squares, along = np.linalg.eigh(linear.scaled_stiffness.toarray())
    none = _is_none(squares)
    free = along[:, none]
    slowed = linear.scaled(linear.damping_and_drag).toarray()
    rates, among = np.linalg.eigh(free.T @ slowed @ free)
    resisted = rates > UNRESISTED * len(slowed) * np.linalg.norm(slowed)
    return along[:, ~none], free @ among[:, resisted], free @ among[:, ~resisted]


def _zeros(linear: Linearisation) -> int:
    """How many eigenvalues of A are zero: a direction without spring has two, or one where velocities are resisted."""
    _, slowed, unresisted = moves_without_spring(linear)
    return 2 * unresisted.shape[1] + slowed.shape[1]


def _undamped(linear: Linearisation) -> Rates:
    if 2 * len(linear.mass) <= ALL_UP_TO:
        squares = np.linalg.eigvalsh(linear.scaled_stiffness.toarray())
        none = _is_none(squares)
        frequencies, unresisted = np.sqrt(squares[~none]), 2 * int(none.sum())
    else:
        frequencies, unresisted = np.array([_top_undamped(linear)]), 0
    return Rates(np.concatenate([1j * frequencies, -1j * frequencies]), unresisted, 2 * len(linear.mass) <= ALL_UP_TO)


def _damped(linear: Linearisation) -> Rates:
    values = np.linalg.eigvals(linear.operator.toarray()).astype(complex)
    unresisted = _zeros(linear)
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


def _at_both_ends(linear: Linearisation, ends: Sequence[float] = ENDS) -> Rates:
    """Of large systems with damping: some of the fastest and of the slowest; decay that outruns all swings, too."""
    slowed = linear.scaled(linear.damping_and_drag)
    (square, mode), (decay, _) = top(linear.scaled_stiffness), top(slowed)
    highest = float(np.sqrt(max(square, 0.0)))
    shifts = [part * _damped_swing(highest, float(mode @ (slowed @ mode))) for part in ends]
    if decay > highest:
        shifts.append(complex(-ENDS[0] * decay))
    found = np.concatenate([_nearest_to(shift, linear.scaled_stiffness, slowed) for shift in shifts])
    bound = highest + decay
    moving = found[np.abs(found) > 1e-6 * bound]
    return Rates(np.concatenate([moving, moving[moving.imag > 0].conj()]), 0, False, bound)


def _nearest_to(shift: complex, stiffness: Any, damping: Any) -> Complex:
    """The eigenvalues mu of mu^2 + mu C + K that are nearest to a shift, in the upper half: by inverse iteration.

    Each from its vector q, as a root of mu^2 + mu q* C q + q* K q with q* q = 1: as exact as these products, of which
    C's tells a decay that is rounding beside the frequency. (Tisseur and Meerbergen, SIAM Review 43 (2001), 3.3.)

    Args:
        stiffness, damping: K [1/s^2] and C [1/s], scaled by the roots of masses: sparse, shape (m, m).
    """
    from scipy.sparse import csc_array, diags_array
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs, splu

    size, _ = stiffness.shape
    shifted = csc_array((stiffness + shift * damping + shift**2 * diags_array(np.ones(size))).astype(complex))
    factors = splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    def solved(z: Complex) -> Complex:
        """(A - shift)^-1 z of z' = A z, z = (q, q')."""
        q = factors.solve(-(z[size:] + damping @ z[:size] + shift * z[:size]))
        return np.concatenate([q, z[:size] + shift * q])

    operator: Any = LinearOperator((2 * size, 2 * size), solved, dtype=complex)
    start = np.random.default_rng(0).normal(size=2 * size).astype(complex)
    try:
        inverse, vectors = eigs(operator, NEAREST, v0=start, maxiter=RESTARTS)
    except ArpackNoConvergence as error:
        inverse, vectors = error.eigenvalues, error.eigenvectors
    q = vectors[:size] / np.linalg.norm(vectors[:size], axis=0)
    slowed, square = ((q.conj() * (matrix @ q)).sum(axis=0).real for matrix in (damping, stiffness))
    apart = np.sqrt(slowed.astype(complex) ** 2 - 4 * square)
    # of the two roots, or their mirror images, the one that was found
    roots = np.array([-slowed + apart, -slowed - apart]) / 2
    found = roots[np.argmin(np.abs(roots - (shift + 1 / inverse)), axis=0), np.arange(len(inverse))]
    return np.asarray(found.real + 1j * np.abs(found.imag))


def _damped_swing(w: float, slowed: float) -> complex:
    """The root of mu^2 + slowed mu + w^2 = 0 in the upper half; i w where that does not swing."""
    swings = w**2 - slowed**2 / 4
    return complex(-slowed / 2, np.sqrt(swings)) if swings > 0 else 1j * w


def _top_undamped(linear: Linearisation) -> float:
    """The highest frequency [1/s]."""
    return float(np.sqrt(max(top(linear.scaled_stiffness)[0], 0.0)))


def top(matrix: Any) -> tuple[float, Array]:
    """The largest eigenvalue of a sparse symmetric matrix, and its vector.

    On long chains they crowd at the end of the spectrum: then by inverse iteration, from a bound that none exceeds.
    """
    from scipy.sparse.linalg import ArpackNoConvergence, eigsh

    start = np.random.default_rng(0).normal(size=matrix.shape[0])
    try:
        (value,), vectors = eigsh(matrix, 1, which="LA", v0=start, maxiter=RESTARTS)
    except ArpackNoConvergence:
        beyond = (1 + 1e-9) * float(abs(matrix).sum(axis=1).max())  # Gershgorin
        (value,), vectors = eigsh(matrix.tocsc(), 1, sigma=beyond, which="LM", v0=start)
    return float(value), vectors[:, 0]


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
