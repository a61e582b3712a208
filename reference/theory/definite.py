"""Where a step with symmetric matrices stops being stable: where one sparse symmetric matrix S(h) stops being definite.

Of a scheme whose step is a quadratic A2 l^2 + A1 l + A0 in its eigenvalue l (`step_coefficients`) every eigenvector q
gives a real quadratic, with coefficients q* A q. Its roots lie within the unit circle if and only if (Jury)

    q*(A2 + A1 + A0) q >= 0,   q*(A2 - A0) q >= 0,   q*(A2 + A0) q >= 0,   q*(A2 - A1 + A0) q >= 0.

The first is h^2 K, the second the damping E; the third is half the sum of the first and the last. So where K and E
are not negative, a step is stable if and only if the last is so for all q: if

    S(h) = A2 - A1 + A0 = 2 (A2 + A0) - h^2 K

has no negative eigenvalue. Its negative pivots are counted (`inertia`) a little below the limit, none, and a little
above, some: that certifies it. A scheme may damp negatively in long steps: one that multiplies velocities
by 1 - h c/m turns them round beyond m/c. There A2 is negative in a direction too, in which the quadratic is h^2 K at
l = 1, and has a root l > 1. So there its limit is, if S has not become negative before.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from reference.bisection import bisect
from reference.errors import SolverError
from reference.schemes.catalogue import Scheme
from reference.schemes.implicit_damping import effective_masses
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.inertia import negative_eigenvalues
from reference.theory.linearisation import Linearisation
from reference.theory.step_coefficients import DampingInStep, coefficients, damping_in_step

#: Up to this many coordinates S is an array, of which all eigenvectors are taken at once.
DENSE_UP_TO = 150

#: A limit is certified between these parts of itself.
BRACKET = 1e-9

#: Negative damping is more than this part of a mass; less is rounding.
NEGATIVE = 1e-6

#: So many dts are looked at for one with negative damping.
LOOKS = 60

#: So often a direction is sought in which S is negative, and a march goes on.
ROUNDS = 60

#: Of large systems a direction is found to this part of S, and is good enough once it lowers the limit by less.
ROUGH = 1e-4


@dataclass(frozen=True, eq=False)
class Definiteness:
    """S(h) of a scheme on a system, as P + h R - g h^2 K with P and R of the damping; all scaled by roots of masses.

    Attributes:
        scheme: whose step is quadratic here.
        linear: the system, linearised.
        unit: about as long as the fastest motion lasts [s].
    """

    scheme: Scheme
    linear: Linearisation
    unit: float

    @property
    def _small(self) -> bool:
        return len(self.linear.mass) <= DENSE_UP_TO

    @cached_property
    def _stiffness(self) -> Array:
        """The scaled stiffness of a small system as an array."""
        return np.asarray(self.linear.scaled_stiffness.toarray())

    @cached_property
    def stiffness_part(self) -> float:
        """By what h^2 K enters S: -1 for explicit schemes, 0 or more for those that are stable at any dt."""
        made = self._made(self.unit).springs
        return 4 * made.implicit_stiffness - 2 * made.damping_stiffness - 1

    @cached_property
    def decides(self) -> bool:
        """Whether all damping in a short step is damping: only then does S alone decide."""
        # where decay is the fastest motion, a scheme may turn velocities round in a step as long as it
        made = self._made(self.unit / 2)
        least = min(made.springs.all.min(initial=0.0), made.drag.all.min(initial=0.0))
        return bool(least >= -1e-12 * self.linear.mass.max() and made.springs.damping_stiffness >= 0)

    def has_negative_damping(self, dt: float) -> bool:
        """Whether E has an entry, of a spring or of a mass, that is negative in a step of dt [s]."""
        made, system = self._made(dt), self.linear.system
        of_springs, of_masses = made.springs.all / effective_masses(system), made.drag.all / system.masses
        return bool(min(of_springs.min(initial=0.0), of_masses.min(initial=0.0)) < -NEGATIVE)

    def negative_damping_from(self, last: float) -> float:
        """The dt [s] above which a step damps negatively; infinite if there is none up to the last one to look at [s].

        Looked at dt by dt, up to one at which the scheme's equations are not solved: above it damping stays negative.
        """
        if self.in_proportion:
            return np.inf
        before = 1e-3 * self.unit
        with suppress(SolverError):
            for dt in np.geomspace(min(before, last), last, LOOKS).tolist():
                if self.has_negative_damping(dt):
                    low, high = bisect(self.has_negative_damping, before, dt, _near)
                    return (low + high) / 2
                before = dt
        return np.inf

    @cached_property
    def never_negative(self) -> bool:
        """Whether S is positive at any dt, term by term."""
        springs, masses = self.damping_part(self.unit)
        rounding = -1e-12 * self.linear.mass.max()
        return bool(self.stiffness_part >= 0 and min(springs.min(initial=0), masses.min(initial=0)) >= rounding)

    @property
    def in_proportion(self) -> bool:
        """Whether the damping's part is in proportion to dt."""
        return not (self.springs_grow or self.drag_grows)

    @property
    def springs_grow(self) -> bool:
        """Whether what damps springs grows faster than dt."""
        return self._grow[0]

    @property
    def drag_grows(self) -> bool:
        """Whether drag in a step grows faster than dt."""
        return self._grow[1]

    @cached_property
    def _grow(self) -> tuple[bool, bool]:
        once, twice = self.damping_part(self.unit), self.damping_part(2 * self.unit)
        # a spring between masses that are held counts as one of 1 kg, be all others ever so light
        masses = effective_masses(self.linear.system), self.linear.system.masses
        springs, drag = (
            not np.allclose(2 * a, b, rtol=1e-9, atol=1e-12 * m) for a, b, m in zip(once, twice, masses, strict=True)
        )
        return springs, drag

    def damping_part(self, dt: float) -> tuple[Array, Array]:
        """4 Q - 2 E [kg] as one number per spring, shape (s,), and one per mass, shape (n,)."""
        made = self._made(dt)
        return 4 * made.springs.implicit - 2 * made.springs.all, 4 * made.drag.implicit - 2 * made.drag.all

    def damping_parts(self, steps: Array) -> list[tuple[Array, Array]]:
        """The same at many dts [s]: in a step of 1 s with as much more damping, all together, as q depends on h c."""
        system = self.linear.system
        masses, drags = np.tile(effective_masses(system), len(steps)), np.tile(system.masses, len(steps))
        none = np.zeros(len(drags))
        springs = coefficients(self.scheme, 1.0, masses, np.outer(steps, system.damping).ravel())
        of_springs = (4 * springs.implicit - 2 * springs.all).reshape(len(steps), -1)
        if not self.linear.dragged:
            return [(row, none[: len(system.masses)]) for row in of_springs]
        return [(row, self.damping_part(float(dt))[1]) for row, dt in zip(of_springs, steps, strict=True)]

    def matrix(self, dt: float, part: tuple[Array, Array] | None = None) -> Any:
        """S(dt), shape (m, m), an array up to DENSE_UP_TO, else sparse; with the damping's part where that is known."""
        return self._with(self._assembled(part or self.damping_part(dt)), dt)

    def damping_matrix(self, dt: float) -> Any:
        """E(dt), in whose lowest eigenvector damping is most negative where it is; as `matrix`."""
        made = self._made(dt)
        return self._assembled((made.springs.all, made.drag.all))

    def with_system(self, system: MassSpringSystem) -> Definiteness:
        """The same with other parameters about the same state."""
        return Definiteness(self.scheme, Linearisation(system, self.linear.state), self.unit)

    def first_limit(self, last: float = np.inf) -> float:
        """The dt [s] up to which S is not negative; infinite where that is beyond the last dt to look at [s]."""
        if not self.in_proportion:
            marched = (self.scheme, self.unit, last)
            if marched not in self.linear.known_limits:
                self.linear.known_limits[marched] = self._march(last)
            return self.linear.known_limits[marched]
        # without damping many schemes have one and the same S
        parts = [np.round(part / self.linear.mass.max(), 12).tobytes() for part in self.damping_part(self.unit)]
        key = (self.unit, self.stiffness_part, *parts)
        if key not in self.linear.known_limits:
            rate = self._assembled(self.damping_part(self.unit)) / self.unit
            quadratic = self._quadratic(0.0, None, rate)
            self.linear.known_limits[key] = first_negative(
                lambda dt: self._with(dt * rate, dt), quadratic, 0.0, self.unit, self._beyond(quadratic)
            )
        return self.linear.known_limits[key]

    def _beyond(self, quadratic: Quadratic) -> float:
        """A dt [s] beyond the limit, by the stiffest direction: beside strong drag it is far from the fastest decay.

        Nothing is known, and it is 0, where S has no stiffness but rounding.
        """
        if self.stiffness_part > -NEGATIVE:
            return 0.0
        root = smallest_root(*quadratic(lowest_eigenvector(-self.linear.scaled_stiffness)), 0.0)
        return root if root < np.inf else 0.0

    def _march(self, last: float) -> float:
        """Of damping that grows faster than dt: on the tangent of its part, which is below it, again and again.

        The part is convex in dt, as an exponential is. So where S on the tangent is not negative S is not either, and
        no interval in which it were could be jumped over.
        """
        dt, not_negative = 1e-3 * self.unit, 0.0
        for _ in range(ROUNDS):
            here, before = (self._assembled(self.damping_part(h)) for h in (dt, (1 - 1e-6) * dt))
            if negative_eigenvalues(self._with(here, dt)):
                # the slope is a difference of what is rounded, and a tangent that is too steep leads too far
                low, high = bisect(self._is_negative, not_negative, dt, _near)
                return (low + high) / 2
            if dt >= last:
                return np.inf
            not_negative = dt
            rate = (here - before) / (1e-6 * dt)
            there = first_negative(
                lambda x, here=here, rate=rate, dt=dt: self._with(here + (x - dt) * rate, x),  # type: ignore[misc]
                self._quadratic(dt, here, rate),
                dt,
                self.unit,
            )
            if there <= (1 + BRACKET) * dt:
                return there
            dt = min(there, 4 * dt, last)
        return dt

    def _is_negative(self, dt: float) -> bool:
        return negative_eigenvalues(self.matrix(dt)) > 0

    def _quadratic(self, dt: float, here: Any, rate: Any) -> Quadratic:
        """The coefficients of q* S(x) q in x, with the damping's part on a line through `here` at dt."""

        def of(q: Array) -> tuple[float, float, float]:
            linear = float(q @ (rate @ q))
            constant = 4 * float(q @ q) - dt * linear + (float(q @ (here @ q)) if here is not None else 0.0)
            return constant, linear, self.stiffness_part * float(q @ (self.linear.scaled_stiffness @ q))

        return of

    def _with(self, damping: Any, dt: float) -> Any:
        if self._small:
            whole = damping + self.stiffness_part * dt**2 * self._stiffness
            whole[np.diag_indices_from(whole)] += 4.0
            return whole
        from scipy.sparse import diags_array

        masses = diags_array(np.full(len(self.linear.mass), 4.0))
        return masses + damping + self.stiffness_part * dt**2 * self.linear.scaled_stiffness

    def _assembled(self, part: tuple[Array, Array]) -> Any:
        springs, masses = part
        if self._small:
            return self.linear.scaled_array(springs, masses)
        along = self.linear.along_springs(springs)
        return self.linear.scaled(along + self.linear.on_masses(masses))

    def _made(self, dt: float) -> DampingInStep:
        return self._made_of_unit if dt == self.unit else damping_in_step(self.scheme, self.linear, dt)

    @cached_property
    def _made_of_unit(self) -> DampingInStep:
        return damping_in_step(self.scheme, self.linear, self.unit)


def _near(low: float, high: float) -> bool:
    return high - low <= BRACKET * low


#: Of a direction q: the constant, linear and square coefficients of q* S(x) q.
Quadratic = Callable[[Array], tuple[float, float, float]]


def first_negative(
    matrix: Callable[[float], Any], quadratic: Quadratic, dt: float, unit: float, known: float = 0.0
) -> float:
    """The first x above dt at which a symmetric matrix that is not negative at dt gets a negative eigenvalue.

    From above: a direction in which it is negative tells by its own quadratic where it no longer is, and the lowest
    eigenvector there is the next direction. The end is certified by counting negative eigenvalues on both sides of it.

    Args:
        matrix: of x, an array or sparse; in every direction a concave quadratic in x.
        quadratic: its coefficients in a direction.
        unit: about where to look [s].
        known: an x at which it has one, where that is known.

    Returns:
        The x below which it is certified not to be, and above which it is; infinite where that is beyond 1e6 units, and
        beyond the one that is known.
    """
    x = max(2 * dt, 4 * unit)
    while negative_eigenvalues(matrix(x)) == 0:
        x *= 4
        if x > max(1e6 * max(unit, dt), 4 * known):
            return np.inf
    for _ in range(ROUNDS):
        lowest, q = _lowest(matrix(x))
        if lowest >= 0:
            break
        root = smallest_root(*quadratic(q), dt)
        if not root < x * (1 - BRACKET):
            break
        x, moved = root, x - root
        if len(q) > DENSE_UP_TO and moved < ROUGH * x:
            break
    return _certified(matrix, max(x, dt), dt)


def _certified(matrix: Callable[[float], Any], x: float, dt: float) -> float:
    """Where S is nearly singular: x itself, where it is certified between BRACKET below and above, else near it."""
    if x <= dt * (1 + BRACKET):
        return dt

    def negative(at: float) -> bool:
        return negative_eigenvalues(matrix(at)) > 0

    width = BRACKET
    while negative(low := max(dt, x * (1 - width))):
        if low == dt:
            return dt
        width *= 10
    high = x * (1 + BRACKET)
    while not negative(high):
        width *= 10
        low, high = high, x * (1 + width)
    if width == BRACKET:
        return x
    low, _ = bisect(negative, low, high, lambda low, high: high - low <= 3 * BRACKET * high)
    return low


def lowest_eigenvector(matrix: Any) -> Array:
    """Of a symmetric matrix, to ROUGH of its largest eigenvalue where it is large."""
    return _lowest(matrix)[1]


def _lowest(matrix: Any) -> tuple[float, Array]:
    """The lowest eigenvalue and its eigenvector; of large matrices to ROUGH of the largest."""
    size, _ = matrix.shape
    if size <= DENSE_UP_TO:
        values, vectors = np.linalg.eigh(matrix if isinstance(matrix, np.ndarray) else matrix.toarray())
        return float(values[0]), np.asarray(vectors[:, 0])
    from scipy.sparse.linalg import ArpackNoConvergence, eigsh

    start = np.random.default_rng(0).normal(size=size)
    try:
        values, vectors = eigsh(matrix, 1, which="SA", v0=start, tol=ROUGH, maxiter=size)
    except ArpackNoConvergence as error:
        values, vectors = error.eigenvalues, error.eigenvectors
    if not len(values):
        return 0.0, start
    return float(values[0]), np.asarray(vectors[:, 0])


def smallest_root(constant: float, linear: float, square: float, beyond: float) -> float:
    """The smallest x > beyond with constant + linear x + square x^2 = 0; infinite without one.

    >>> smallest_root(4.0, 0.0, -1.0, 0.0)
    2.0
    """
    if square == 0:
        found = [-constant / linear] if linear else []
    else:
        inner = linear**2 - 4 * square * constant
        if inner < 0:
            return np.inf
        # the root that is computed without cancellation, and the other one from their product
        far = -(linear + np.copysign(np.sqrt(inner), linear)) / 2
        found = [far / square, *([constant / far] if far else [])]
    return min((float(x) for x in found if x > beyond), default=np.inf)
