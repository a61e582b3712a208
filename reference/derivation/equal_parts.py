"""Steps that are several equal ones in a row: update formulas of a step, taken apart into those of a sub-step.

The slopes of the first sub-step are the first ones, those of the last are the last ones: from where the first are
taken, and from what the last are given in the end, the formulas of one sub-step are had. These, put one after the
other, have to be those of the whole step, coefficient by coefficient.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from reference.derivation.formula import Number
from reference.derivation.tableau import Tableau
from reference.derivation.updates import Coefficient, Form, Symbol, Updates

#: Two numbers that are no fractions are the same within this.
SAME = 1e-12

ONE = Coefficient(Fraction(1), 0)

#: Where a step begins.
START: tuple[Form, Form] = {Symbol("x", 0): ONE}, {Symbol("v", 0): ONE}


@dataclass(frozen=True)
class EqualParts:
    """How many sub-steps a step is, and the formulas of one of them, in its own h.

    Attributes:
        undamped: whether it is made of these without damping and drag only.
    """

    count: int
    one: Updates
    undamped: bool = False


def equal_parts(whole: Updates, known: Callable[[], Mapping[str, Updates]]) -> EqualParts | None:
    """What a step is made of, the most sub-steps first; None where it is not made of equal ones.

    Args:
        known: gives the formulas that a sub-step may have whose last slope is the next one's first, taken once: which
            part of that slope is whose, formulas do not say.
    """
    if whole.looks_back or whole.reused:
        return None
    calls = len(whole.points)
    for count in range(calls, 1, -1):
        one = _part(whole, count) if calls % count == 0 else None
        if one is not None and _kicks_once(one) and same_updates(repeated(one, count), whole):
            return EqualParts(count, one)
    return _of_shared(_merged(whole), known()) if calls > 2 and _ends_with_a_slope(whole) else None


def _kicks_once(one: Updates) -> bool:
    """Whether it takes slopes with weights that add up to h, as a step of h does: else it is one of another length."""
    return abs(sum(float(c.number) for s, c in one.end[1].items() if s.kind == "q") - 1) <= SAME


def _ends_with_a_slope(whole: Updates) -> bool:
    """Whether its last slope is taken where masses are in the end: it may be the first of the next sub-step."""
    return _alike(whole.points[-1][0], whole.end[0])


def _of_shared(merged: Updates, known: Mapping[str, Updates]) -> EqualParts | None:
    for one in known.values():
        count, rest = divmod(len(merged.points) - 1, max(1, len(one.points) - 1))
        if rest or count < 2 or one.looks_back or one.reused:
            continue
        if same_updates(_merged(repeated(one, count)), merged):
            return EqualParts(count, one)
    return None


def of_tableau(tableau: Tableau) -> Updates:
    """The update formulas of a Runge-Kutta method."""

    def moved(row: tuple[Number, ...]) -> tuple[Form, Form]:
        x, v = dict(START[0]), dict(START[1])
        for j, c in enumerate(row):
            if c:
                x[Symbol("p", 0, j)] = v[Symbol("q", 0, j)] = Coefficient(c, 1)
        return x, v

    return Updates(tuple(map(moved, tableau.a)), tableau.c, moved(tableau.b))


def without_damping(updates: Updates) -> Updates:
    """The same for accelerations that do not ask for velocities: at which ones they are taken is left out."""
    return replace(updates, points=tuple((x, {}) for x, _ in updates.points))


def by_accelerations(updates: Updates) -> Updates:
    """The same of who knows that x' is v: no slope of positions is asked for; where one was, there is a velocity."""

    def put(form: Form) -> Form:
        left: dict[Symbol, Coefficient] = {}
        for symbol, c in form.items():
            terms = updates.points[symbol.call][1] if symbol.kind == "p" and not symbol.age else {symbol: ONE}
            for at, its in terms.items():
                before = left.get(at, Coefficient(Fraction(0), c.power + its.power))
                left[at] = Coefficient(before.number + c.number * its.number, c.power + its.power)
        return {symbol: c for symbol, c in left.items() if c.number}

    points = tuple((put(x), put(v)) for x, v in updates.points)
    return replace(updates, points=points, end=(put(updates.end[0]), put(updates.end[1])))


def repeated(one: Updates, count: int) -> Updates | None:
    """So many steps of h over that number, as one of h; None where a coefficient is no power of h any more."""
    points: list[tuple[Form, Form]] = []
    start = START
    for i in range(count):
        ends = [
            (_put(x, start, i * len(one.points), count), _put(v, start, i * len(one.points), count))
            for x, v in (*one.points, one.end)
        ]
        kept = [(x, v) for x, v in ends if x is not None and v is not None]
        if len(kept) < len(ends):
            return None
        points += kept[:-1]
        start = kept[-1]
    parts = tuple((i + part) / count for i in range(count) for part in one.parts)
    return Updates(tuple(points), parts, start)


def _put(form: Form, start: tuple[Form, Form], called: int, count: int) -> Form | None:
    """A form of a sub-step in symbols of the whole step: from where it starts, after so many slopes were asked for."""
    total: dict[tuple[Symbol, int], Number] = {}
    for symbol, c in form.items():
        number = c.number / Fraction(count) ** c.power
        if symbol.kind in "xv":
            terms = start["xv".index(symbol.kind)]
        else:
            terms = {symbol._replace(call=symbol.call + called): ONE}
        for at, its in terms.items():
            key = at, its.power + c.power
            total[key] = total.get(key, Fraction(0)) + number * its.number
    left = {key: number for key, number in total.items() if abs(float(number)) > SAME}
    found = {symbol: Coefficient(number, power) for (symbol, power), number in left.items()}
    return found if len(found) == len(left) else None


def _part(whole: Updates, count: int) -> Updates | None:
    """The formulas of one of so many equal steps, if it is made of them."""
    calls = len(whole.points) // count
    before = len(whole.points) - calls
    points = tuple((_in_its_h(x, count), _in_its_h(v, count)) for x, v in whole.points[:calls])
    x, v = ({s: c for s, c in form.items() if s.kind in "xv"} for form in whole.end)
    drift = x.pop(Symbol("v", 0), Coefficient(Fraction(0), 1))
    if x != START[0] or v != START[1] or drift.power != 1:
        return None
    ends: list[Form] = []
    for form, begun in zip(whole.end, START, strict=True):
        last = {s._replace(call=s.call - before): c for s, c in form.items() if s.kind in "pq" and s.call >= before}
        ends.append({**begun, **_in_its_h(last, count)})
    if drift.number:  # all of them together drift as far as the whole does
        ends[0] = {**ends[0], Symbol("v", 0): drift}
    asked = {s.call for pair in (*points, ends) for form in pair for s in form if s.kind in "pq"}
    if any(call >= calls for call in asked):
        return None
    return Updates(points, tuple(part * count for part in whole.parts[:calls]), (ends[0], ends[1]))


def _in_its_h(form: Form, count: int) -> Form:
    return {s: Coefficient(c.number * Fraction(count) ** c.power, c.power) for s, c in form.items()}


def _merged(whole: Updates | None) -> Updates:
    """With slopes that are asked for at the same point as one."""
    if whole is None:
        return Updates((), (), START)
    first: list[int] = []
    kept: list[tuple[Form, Form]] = []
    for point in whole.points:
        now = _renamed(point[0], first), _renamed(point[1], first)
        alike = [i for i, other in enumerate(kept) if _same_forms(now, other)]
        first.append(alike[0] if alike else len(kept))
        kept += [] if alike else [now]
    return Updates(tuple(kept), (), (_renamed(whole.end[0], first), _renamed(whole.end[1], first)))


def _renamed(form: Form, first: list[int]) -> Form:
    """With the calls as these; of two that are one now, the sum."""
    found: dict[Symbol, Coefficient] = {}
    for symbol, c in form.items():
        now = symbol._replace(call=first[symbol.call]) if symbol.kind in "pq" else symbol
        before = found.get(now, Coefficient(Fraction(0), c.power))
        found[now] = Coefficient(before.number + c.number, c.power)
    return found


def same_updates(one: Updates | None, other: Updates) -> bool:
    """Whether all coefficients are; at which times slopes are taken does not count."""
    if one is None or len(one.points) != len(other.points):
        return False
    pairs = zip((*one.points, one.end), (*other.points, other.end), strict=True)
    return all(_same_forms(mine, its) for mine, its in pairs)


def _same_forms(one: tuple[Form, Form], other: tuple[Form, Form]) -> bool:
    return all(_alike(mine, its) for mine, its in zip(one, other, strict=True))


def _alike(one: Form, other: Form) -> bool:
    if one.keys() != other.keys():
        return False
    return all(
        c.power == other[s].power and abs(float(c.number) - float(other[s].number)) <= SAME for s, c in one.items()
    )
