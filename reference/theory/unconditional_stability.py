"""Which implicit schemes are stable at any dt, from their own definition: by the criterion of Routh and Hurwitz.

A Runge-Kutta or multistep method, or one of structural dynamics such as HHT, sees a system M x'' + C x' + K x = 0 mode
by mode. An eigenvector of its step, with positions q, has an eigenvalue l that the step of a single oscillator has:

    P(l; a, b) = 0   with   a = h^2 (q* K q) / (q* M q),   b = h (q* C q) / (q* M q),

and where neither stiffness nor damping is negative, neither is a or b. So if no oscillator at all grows, with any
a, b >= 0, no system does, at any dt (Hughes, *The Finite Element Method* (1987), 9.1 to 9.3).

P has coefficients that are polynomials in a and b. They are found by running the scheme itself on some oscillators.
l = (1 + s) / (1 - s) takes the unit circle to the left half plane: there all roots are, for all a, b > 0, if the first
column of the Routh array is positive (Gantmacher, *The Theory of Matrices* II (1959), XV). On the border, without
damping or without stiffness, they come to the circle at most.

Whether a scheme sees systems in this way is tried on a few masses that share no modes.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from reference.errors import InputError, SolverError, Unsupported
from reference.forces import SpringMotion
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.theory.equilibria import Equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.oscillators import step_matrices
from reference.theory.step_coefficients import AGREEMENT, odd_system
from reference.theory.step_map import step_jacobian

#: The highest degree of P's coefficients that is tried: two stages that are solved together have 2.
HIGHEST_DEGREE = 3

#: How many oscillators are run, with a and b up to FARTHEST.
OSCILLATORS, FARTHEST = 20, 4.0

#: Coefficients this small, of a polynomial whose largest is 1, are rounding.
ROUNDING = 1e-10


@lru_cache(maxsize=256)
def stable_at_any_dt(scheme: Scheme, damped: bool, dragged: bool) -> bool:
    """Whether it is known to be, on all systems without negative stiffness or damping.

    Args:
        damped: whether springs are.
        dragged: whether masses are.

    >>> from reference.schemes.catalogue import find
    >>> stable_at_any_dt(find("bdf2"), True, False), stable_at_any_dt(find("newmark(beta=0.1)"), True, False)
    (True, False)
    """
    if not scheme.implicit or not scheme.linear or scheme.iterated:
        return False
    try:
        characteristic = characteristic_polynomial(scheme)
        return (
            characteristic is not None
            and has_roots_in_left_half(_of_left_half(characteristic))
            and _sees_single_oscillators(scheme, damped, dragged)
        )
    except (SolverError, Unsupported, InputError):
        return False


def characteristic_polynomial(scheme: Scheme) -> Array | None:
    """P of an oscillator, shape (powers of l, of a, of b), the lowest first; None where it is of too high a degree.

    Raises:
        SolverError, Unsupported, InputError: as the scheme's step does.
    """
    points = np.random.default_rng(0).uniform(0.0, FARTHEST, (OSCILLATORS, 2))
    monic = np.array([np.poly(matrix)[::-1] for matrix in _step_matrices(scheme, *points.T)])
    for degree in range(1, HIGHEST_DEGREE + 1):
        powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
        terms = np.array([[a**i * b**j for i, j in powers] for a, b in points])
        found = _common_denominator(monic, terms)
        if found is not None:
            polynomial = np.zeros((monic.shape[1], degree + 1, degree + 1))
            polynomial[:, *np.array(powers).T] = found
            return polynomial
    return None


def _common_denominator(monic: Array, terms: Array) -> Array | None:
    """Numerators of coefficients that are rational in a and b, over one denominator, which is the last of them.

    They are what is left over by no point: numerator - coefficient x denominator = 0 at all.

    Args:
        monic: coefficients of l at every point, shape (points, k + 1), the last of them 1.
        terms: the products of powers of a and b there, shape (points, terms).

    Returns:
        Their coefficients of the terms, shape (k + 1, terms); None where they have others too.
    """
    points, count = terms.shape
    k = monic.shape[1] - 1
    rows = np.zeros((k, points, k + 1, count))
    for i in range(k):
        rows[i, :, i], rows[i, :, k] = terms, -monic[:, i, None] * terms
    _, left, directions = np.linalg.svd(rows.reshape(k * points, -1) / np.abs(rows).max())
    if left[-1] > 1e-3 * ROUNDING * left[0]:
        return None
    found = directions[-1].reshape(k + 1, count)
    return np.asarray(found / found[np.unravel_index(np.abs(found).argmax(), found.shape)])


def _of_left_half(polynomial: Array) -> Array:
    """The polynomial in s with l = (1 + s) / (1 - s), of s^0 first; its largest term is made positive.

    A root l = -1 whatever a and b, as the generalised alpha method's of radius 1, stays on the circle;
    it is s = infinity, and the highest coefficient is nothing.
    """
    k = len(polynomial) - 1
    turned = np.zeros_like(polynomial)
    for i, coefficient in enumerate(polynomial):
        expanded = np.polynomial.polynomial.polymul(
            np.polynomial.polynomial.polypow([1, 1], i), np.polynomial.polynomial.polypow([1, -1], k - i)
        )
        turned += np.multiply.outer(expanded, coefficient)
    turned /= turned.ravel()[np.abs(turned).argmax()]
    return turned[: np.flatnonzero(np.abs(turned).max(axis=(1, 2)) > ROUNDING)[-1] + 1]


def has_roots_in_left_half(polynomial: Array) -> bool:
    """Whether all roots s of a polynomial have negative real parts, for all a, b > 0; False where it is not seen.

    By the Routh array, of which no entry is divided by what is positive, so that all are polynomials in a and b.

    Args:
        polynomial: shape (powers of s, of a, of b), the lowest first.

    >>> has_roots_in_left_half(np.array([[[0.0], [1.0]], [[1.0], [0.0]], [[1.0], [0.0]]]))  # s^2 + s + a
    True
    """
    highest_first = list(polynomial[::-1])
    above, row = highest_first[::2], highest_first[1::2]
    if not is_positive(above[0]):
        return False
    for _ in range(len(polynomial) - 1):
        if not is_positive(row[0]):
            return False
        nothing = np.zeros((1, 1))
        below = [
            _difference(_product(row[0], above[j + 1]), _product(above[0], row[j + 1] if j + 1 < len(row) else nothing))
            for j in range(len(above) - 1)
        ]
        above, row = row, below
    return True


def is_positive(polynomial: Array) -> bool:
    """Whether a polynomial in a and b, shape (powers of a, of b), is positive for all a, b > 0; False if not seen.

    It is if the polynomials in a that are before the powers of b are not negative, and not all zero.
    """
    clean = np.where(np.abs(polynomial) > ROUNDING * np.abs(polynomial).max(), polynomial, 0.0)
    return bool(clean.any()) and all(_is_never_negative(column) for column in clean.T)


def _is_never_negative(coefficients: Array) -> bool:
    """Of a polynomial in a, of a^0 first, for a > 0: tried between all its roots and beyond."""
    if not (coefficients < 0).any():
        return True
    roots = np.roots(coefficients[::-1])
    real = np.sort(roots.real[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)])
    ends = np.concatenate([[0.0], real, [2 * real[-1] if len(real) else 1.0]])
    return bool((np.polyval(coefficients[::-1], (ends[1:] + ends[:-1]) / 2) >= 0).all())


def _product(p: Array, q: Array) -> Array:
    """Of two polynomials in a and b."""
    product, (rows, columns) = np.zeros(np.add(p.shape, q.shape) - 1), q.shape
    for (i, j), coefficient in np.ndenumerate(p):
        product[i : i + rows, j : j + columns] += coefficient * q
    return product


def _difference(p: Array, q: Array) -> Array:
    difference = np.zeros(np.maximum(p.shape, q.shape))
    difference[tuple(map(slice, p.shape))] += p
    difference[tuple(map(slice, q.shape))] -= q
    return difference


def _step_matrices(scheme: Scheme, a: Array, b: Array) -> Array:
    """How steps of 1 s multiply oscillators x'' + b x' + a x = 0, with all that the scheme remembers of them."""
    return step_matrices(scheme, 1.0, np.ones(len(a)), a, b)


def _sees_single_oscillators(scheme: Scheme, damped: bool, dragged: bool) -> bool:
    """Whether eigenvalues of a step on masses that share no modes are those of the oscillators of its eigenvectors."""
    system, dt = odd_system(damped, dragged), 0.08
    linear = Linearisation(system, system.start)
    values, vectors = np.linalg.eig(
        step_jacobian(scheme, Equilibrium(SpringMotion(system), system.start, ~system.fixed, 1.0), dt)
    )
    q = vectors[: len(linear.mass)]
    damping = linear.damping + linear.on_masses(np.full(len(system.masses), system.drag))
    mass, a, b = (
        np.einsum("im,im->m", q.conj(), matrix @ q).real
        for matrix in (np.diag(linear.mass), dt**2 * linear.stiffness, dt * damping)
    )
    alone = np.linalg.eigvals(_step_matrices(scheme, a / mass, b / mass))
    return bool(np.abs(alone - values[:, None]).min(axis=1).max() < AGREEMENT)
