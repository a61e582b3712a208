"""The stability polynomial of a Runge-Kutta method, from its own definition, and where it leaves the unit circle.

On z' = m z a Runge-Kutta step is z -> R(h m) z with R a polynomial (Hairer and Wanner, *Solving Ordinary Differential
Equations II* (1996), IV.2). R is found by running the method itself on v' = v with complex steps around the unit
circle: its Fourier coefficients there are the coefficients of R.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

from reference.errors import InputError, SolverError, Unsupported
from reference.schemes.catalogue import Scheme
from reference.state import Array, Slope, State

Complex = npt.NDArray[np.complex128]

#: R is taken to have no more terms than this.
POINTS = 32

#: Coefficients this small are rounding.
ROUNDING = 1e-13


class _Exponential:
    """The equation v' = v, and x' = v, on complex numbers."""

    def acceleration(self, state: State) -> Array:
        """As it moves."""
        return state.velocities

    def slope(self, state: State) -> Slope:
        """(1, x', v')."""
        return Slope(1.0, state.velocities, state.velocities)


class _Turning:
    """z' = A z of two unknowns that do not commute with anything: x' = v, v' = -2 x - 0.3 v."""

    MATRIX = np.array([[0.0, 1.0], [-2.0, -0.3]])

    def acceleration(self, state: State) -> Array:
        """From both."""
        return np.asarray(-2.0 * state.positions - 0.3 * state.velocities)

    def slope(self, state: State) -> Slope:
        """(1, x', x'')."""
        return Slope(1.0, state.velocities, self.acceleration(state))


@lru_cache(maxsize=64)
def stability_polynomial(scheme: Scheme) -> tuple[float, ...] | None:
    """The coefficients of R, of z^0 first; None where the scheme is no explicit Runge-Kutta method.

    >>> from reference.schemes.catalogue import find
    >>> [round(c, 12) for c in stability_polynomial(find("heun"))]
    [1.0, 1.0, 0.5]
    """
    if scheme.needs != "accelerations" or not scheme.one_step or scheme.implicit:
        return None
    around = np.exp(2j * np.pi * np.arange(POINTS) / POINTS)
    try:
        values = [_multiplied(scheme, complex(z)) for z in around]
    except (TypeError, ValueError, InputError, SolverError, Unsupported):
        return None
    found = np.fft.fft(np.array(values)) / POINTS
    kept = np.trim_zeros(np.where(np.abs(found.real) > ROUNDING, found.real, 0.0), "b")
    polynomial = tuple(float(c) for c in kept)
    return polynomial if _holds_for_systems(scheme, polynomial) else None


def _multiplied(scheme: Scheme, z: complex) -> complex:
    """R(z): by what a step of z multiplies the solution of v' = v."""
    start = State(0.0, np.zeros((1, 1), dtype=complex), np.ones((1, 1), dtype=complex))
    end = scheme.on(_Exponential())(start, z)  # type: ignore[arg-type]
    return complex(end.velocities[0, 0])


def _holds_for_systems(scheme: Scheme, polynomial: tuple[float, ...]) -> bool:
    """Whether a step of z' = A z is R(h A) z: schemes that treat positions and velocities differently are not."""
    h, step = 0.37, scheme.on(_Turning())
    ends = [step(State(0.0, np.array([[x]]), np.array([[v]])), h) for x, v in np.eye(2)]
    jacobian = np.array([[end.positions[0, 0], end.velocities[0, 0]] for end in ends]).T
    expected, power = np.zeros((2, 2)), np.eye(2)
    for c in polynomial:
        expected, power = expected + c * power, power @ (h * _Turning.MATRIX)
    return bool(np.abs(jacobian - expected).max() < 1e-12)


def modulus_along(polynomial: tuple[float, ...], direction: complex) -> Array:
    """The coefficients in s of |R(s u)|^2 - 1, of s^0 first, with u a direction: a complex number of modulus 1.

    Those of odd powers are as small as the real part of u, however small that is, and rounded as that is.
    """
    terms = [c * direction**k for k, c in enumerate(polynomial)]
    square = np.convolve(terms, np.conj(terms)).real
    square[0] -= 1.0
    rounding = np.full(len(square), ROUNDING)
    rounding[1::2] *= abs(direction.real)
    return np.where(np.abs(square) <= rounding, 0.0, square)


def stable_along(polynomial: tuple[float, ...], direction: complex) -> tuple[tuple[float, float], ...]:
    """The intervals of s >= 0 in which |R(s u)| <= 1, rising; the first from 0, empty if unstable at once.

    >>> stable_along((1.0, 1.0), -1 + 0j)  # Euler, of decay: up to 2
    ((0.0, 2.0),)
    """
    square = modulus_along(polynomial, direction)
    order = int(np.argmax(square != 0)) if square.any() else 0
    roots = np.roots(square[order:][::-1]) if square.any() else np.array([])
    real = np.sort(roots.real[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)])
    ends = np.concatenate([[0.0], real, [2 * real[-1] if len(real) else 1.0]])
    middles = (ends[1:] + ends[:-1]) / 2
    stable = np.polyval(square[::-1], middles) <= 0
    found: list[tuple[float, float]] = []
    for low, high, inside in zip(ends[:-1], ends[1:], stable, strict=True):
        if inside and found and found[-1][1] == low:
            found[-1] = (found[-1][0], float(high))
        elif inside:
            found.append((float(low), float(high)))
    if not found or found[0][0] > 0:
        return ((0.0, 0.0), *found)
    return tuple(found)


def first_limits_along(polynomial: tuple[float, ...], angles: Array) -> Array:
    """Where the first of the intervals of `stable_along` ends, at many angles at once: shape (a,).

    >>> first_limits_along((1.0, 1.0), np.array([np.pi, np.pi / 2]))  # Euler, of decay and of swings
    array([2., 0.])
    """
    order = np.arange(len(polynomial))
    squares = np.zeros((len(angles), 2 * len(polynomial) - 1))
    for j in order:
        for k in order:
            squares[:, j + k] += polynomial[j] * polynomial[k] * np.cos((j - k) * angles)
    squares[:, 0] -= 1.0
    squares[np.abs(squares) < ROUNDING] = 0.0
    limits = np.full(len(angles), np.inf)
    first = np.argmax(squares != 0, axis=1)
    for lowest in np.unique(first):
        rows = (first == lowest) & squares.any(axis=1)
        limits[rows] = _first_rise(squares[rows, lowest:])
    return limits


def _first_rise(squares: Array) -> Array:
    """The first s > 0 above which polynomials are positive, by their coefficients, of s^0 (not zero) first."""
    if squares.shape[1] == 1:
        return np.where(squares[:, 0] > 0, 0.0, np.inf)
    companion = np.zeros((len(squares), *2 * (squares.shape[1] - 1,)))
    companion[:, 1:, :-1] = np.eye(companion.shape[1] - 1)
    companion[:, 0, :] = -squares[:, -2::-1] / squares[:, -1:]
    roots = np.linalg.eigvals(companion)
    real = (np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)
    ends = np.sort(np.where(real, roots.real, np.inf), axis=1)
    last = np.max(np.where(np.isfinite(ends), ends, 0.5), axis=1, keepdims=True)
    ends = np.concatenate([0 * last, np.minimum(ends, 2 * last), 2 * last], axis=1)
    middles = (ends[:, 1:] + ends[:, :-1]) / 2
    values = np.zeros_like(middles)
    for coefficient in squares.T[::-1]:
        values = values * middles + coefficient[:, None]
    rises = (values > 0) & (ends[:, 1:] > ends[:, :-1])
    return np.where(
        rises.any(axis=1), np.take_along_axis(ends, np.argmax(rises, axis=1)[:, None], axis=1)[:, 0], np.inf
    )


def stable_steps(polynomial: tuple[float, ...], rates: Complex) -> list[tuple[float, float]]:
    """The intervals of h in which no mode of these rates [1/s] grows, rising [s]; the first from 0."""
    common = [(0.0, np.inf)]
    for rate in _of_upper_half(rates):
        own = [(a / abs(rate), b / abs(rate)) for a, b in stable_along(polynomial, complex(rate / abs(rate)))]
        common = [
            (max(a, c), min(b, d)) for a, b in common for c, d in own if max(a, c) < min(b, d) or max(a, c) == 0.0
        ]
    return common


def _of_upper_half(rates: Complex) -> Complex:
    """One of every conjugate pair, the fastest first: these leave the least for the others to look at."""
    upper = rates[(rates.imag >= 0) & (np.abs(rates) > 0)]
    return np.asarray(upper[np.argsort(-np.abs(upper), kind="stable")])
