"""Butcher tableaux: of update formulas that are a Runge-Kutta method's, and what they say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from reference.derivation.consequences import Windows, windows
from reference.derivation.formula import Number, exact_text, number
from reference.derivation.order_conditions import order_of
from reference.derivation.updates import Coefficient, Form, Symbol, Updates
from reference.state import Array
from reference.system import BoolArray

#: Growth by less is none.
GROWTH = 1e-9

#: Two numbers that are no fractions are the same within this.
SAME = 1e-12

ZERO = Fraction(0)

#: Which coefficient, and what it is in either.
Difference = tuple[str, Number, Number]


@dataclass(frozen=True)
class Tableau:
    """A Runge-Kutta method: k_i = f(t + c_i h, y + h sum a_ij k_j), y + h sum b_i k_i.

    Attributes:
        a: shape (s, s).
        b: shape (s,).
        c: at what parts of h the method takes its slopes, as it says itself; row sums where it does not.
        within: how far two numbers of it, or the two sides of a condition, may be apart and are the same.
    """

    a: tuple[tuple[Number, ...], ...]
    b: tuple[Number, ...]
    c: tuple[Number, ...]
    within: float = SAME

    @property
    def stages(self) -> int:
        """How many slopes."""
        return len(self.b)

    @property
    def explicit(self) -> bool:
        """Whether every slope asks for earlier ones only."""
        return not any(self.a[i][j] for i in range(self.stages) for j in range(i, self.stages))

    @property
    def order(self) -> int:
        """Up to which order all conditions hold."""
        return order_of(self.a, self.b, self.within)[0]

    @property
    def nearly(self) -> int:
        """The order to six digits, of numbers that are written to so many."""
        return order_of(self.a, self.b, max(self.within, 1e-6))[0]

    @property
    def exact(self) -> bool:
        """Whether all its numbers are fractions."""
        return all(isinstance(c, Fraction) for row in (*self.a, self.b) for c in row)

    @property
    def fails(self) -> str:
        """The first condition that does not."""
        return order_of(self.a, self.b, self.within)[1]

    @property
    def symplectic(self) -> bool:
        """Whether b_i a_ij + b_j a_ji = b_i b_j (Sanz-Serna 1988)."""
        a, b, s = self.a, self.b, range(self.stages)
        return all(not _apart(b[i] * a[i][j] + b[j] * a[j][i], b[i] * b[j], self.within) for i in s for j in s)

    @property
    def times_at_odds(self) -> tuple[str, ...]:
        """Where the times it takes slopes at are not the sums of its rows: each such slope, in words."""
        sums: list[Number] = [sum(row, start=ZERO) for row in self.a]
        return tuple(
            f"slope {i} is taken {number(on)} of a step on, and is told the time {number(c)} of it on"
            for i, (c, on) in enumerate(zip(self.c, sums, strict=True), start=1)
            if _apart(c, on, self.within)
        )

    def step_matrices(self, a: Array, damped: Array | None = None) -> Array:
        """Its step matrices of oscillators, shape (n, 2, 2).

        R(Z) = 1 + (b^T x Z) (1 - A x Z)^-1 (e x 1), of Z = ((0, 1), (-a, -damped)) for (x, h v) (Hairer and Wanner
        1996, IV.3).

        Args:
            a: h^2 k/m, shape (n,).
            damped: h (c + Cd)/m, shape (n,); zero where left out.
        """
        by_a, by_b = np.array(self.a, float), np.array(self.b, float)[None]
        ones = np.kron(np.ones((self.stages, 1)), np.eye(2))
        damping = np.zeros_like(a) if damped is None else damped
        zs = [np.array([[0.0, 1.0], [-each, -its]]) for each, its in zip(a, damping, strict=True)]
        return np.stack(
            [np.eye(2) + np.kron(by_b, z) @ np.linalg.solve(np.eye(len(ones)) - np.kron(by_a, z), ones) for z in zs]
        )

    def stable_along(self, direction: complex) -> Windows:
        """In which intervals of s a step of y' = s direction y does not grow.

        |R| <= 1, with R(z) = det(1 - z A + z e b^T) / det(1 - z A) (Hairer and Wanner 1996, IV.3).
        """
        a, b = np.array(self.a, float), np.array(self.b, float)
        above, below = (np.poly(m)[::-1] for m in (a - b, a))

        def stable(s: Array) -> BoolArray:
            z = s * direction
            return np.asarray(np.abs(np.polyval(above, z)) <= (1 + GROWTH) * np.abs(np.polyval(below, z)))

        return windows(stable)

    def text(self) -> dict[str, list[str] | list[list[str]]]:
        """Its numbers as they are written."""
        return {
            "a": [[exact_text(c) for c in row] for row in self.a],
            "b": [exact_text(c) for c in self.b],
            "c": [exact_text(c) for c in self.c],
        }

    def same(self, other: Tableau) -> bool:
        """Whether all coefficients are."""
        return self.stages == other.stages and not self.differences(other)

    def differences(self, other: Tableau) -> list[Difference]:
        """Which coefficients differ from another's of as many stages: name, this one's, the other's."""
        s = range(self.stages)
        pairs = [(f"a{i + 1}{j + 1}", self.a[i][j], other.a[i][j]) for i in s for j in s]
        pairs += [(f"b{i + 1}", self.b[i], other.b[i]) for i in s]
        if self.times_at_odds:  # else c follows from a
            pairs += [(f"c{i + 1}", self.c[i], other.c[i]) for i in s]
        return [(name, mine, its) for name, mine, its in pairs if _apart(mine, its, self.within)]

    def without_repeated(self) -> Tableau:
        """The same with slopes that are taken at one point, at one time, as one: their weights are added up."""
        s = range(self.stages)
        first = [next(j for j in s if self.a[j] == self.a[i] and self.c[j] == self.c[i]) for i in s]
        kept = sorted(set(first))
        if len(kept) == self.stages:
            return self

        def added(row: Sequence[Number]) -> tuple[Number, ...]:
            return tuple(sum((row[j] for j in s if first[j] == i), start=ZERO) for i in kept)

        a, c = tuple(added(self.a[i]) for i in kept), tuple(self.c[i] for i in kept)
        return Tableau(a, added(self.b), c, self.within).without_repeated()

    def without_unused(self) -> Tableau:
        """The same without slopes that nothing is made of."""
        s = range(self.stages)
        used = [i for i in s if self.b[i] or any(self.a[j][i] for j in s)]
        if len(used) == self.stages or not used:
            return self
        return Tableau(
            tuple(tuple(self.a[i][j] for j in used) for i in used),
            tuple(self.b[i] for i in used),
            tuple(self.c[i] for i in used),
            self.within,
        ).without_unused()


def tableau_of(updates: Updates, timed: bool = True, repeated: bool = False) -> Tableau | None:
    """The tableau of update formulas; None where they are no Runge-Kutta method's.

    Positions and velocities have to be treated alike: 1 times what they were at the start, and h times slopes.

    Args:
        timed: whether it says at what times it takes its slopes.
        repeated: whether slopes taken twice at one point stay two stages, as whoever wrote it has them.
    """
    s = len(updates.points)
    rows = [_row(x, v, s) for x, v in (*updates.points, updates.end)]
    if any(row is None for row in rows):
        return None
    kept = [row for row in rows if row is not None]
    a, b = tuple(kept[:-1]), kept[-1]
    c = updates.parts if timed else tuple(sum(row, start=ZERO) for row in a)
    found = Tableau(a, b, tuple(c)).without_unused()
    return found if repeated else found.without_repeated()


def _row(x: Form, v: Form, stages: int) -> tuple[Number, ...] | None:
    """The coefficients of h k_j in a point, where both its halves have the same."""
    rows: list[tuple[Number, ...]] = []
    for form, start, slope in ((x, "x", "p"), (v, "v", "q")):
        allowed = {Symbol(slope, 0, j) for j in range(stages)}  # type: ignore[arg-type]
        if form.get(Symbol(start, 0)) != Coefficient(Fraction(1), 0):  # type: ignore[arg-type]
            return None
        others = {symbol: c for symbol, c in form.items() if symbol != Symbol(start, 0)}  # type: ignore[arg-type]
        if not others.keys() <= allowed or any(c.power != 1 for c in others.values()):
            return None
        rows.append(tuple(_number(others, Symbol(slope, 0, j)) for j in range(stages)))  # type: ignore[arg-type]
    of_x, of_v = rows
    return of_x if all(not _apart(p, q) for p, q in zip(of_x, of_v, strict=True)) else None


def _apart(one: Number, other: Number, within: float = SAME) -> bool:
    return abs(float(one) - float(other)) > within


def _number(form: Form, symbol: Symbol) -> Number:
    return form[symbol].number if symbol in form else ZERO


def nearest(found: Tableau, known: Sequence[tuple[str, Tableau]]) -> tuple[str, list[Difference]] | None:
    """The known tableau of as many stages that differs in the fewest coefficients, and in which."""
    same_size = [(name, found.differences(other)) for name, other in known if other.stages == found.stages]
    return min(same_size, key=lambda item: len(item[1]), default=None)
