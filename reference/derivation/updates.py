"""The update formulas of a stepper that asks for slopes, read off a recording."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NamedTuple

import numpy as np

from reference.derivation.formula import Number, product
from reference.derivation.irrational import irrational
from reference.derivation.recording import LENGTHS, STEPS, Recording, Step
from reference.derivation.small_fractions import recognised
from reference.errors import Unsupported
from reference.state import Array

#: What a component smaller than this is: rounding.
ROUNDING = 1e-14

#: How far a number may be off the fraction that it is taken for.
OFF = 4e-15

#: What is said of those that do not.
NOT_LINEAR = "its result is not linear in the slopes it asks for: something is clipped, smoothed, rounded or remembered"

#: Dense steps agree with the formulas to this part of their size.
AGREEMENT = 1e-10


class Symbol(NamedTuple):
    """Something that update formulas are linear in.

    Attributes:
        kind: x or v at the start of a step, p or q that the slopes answered, for x' and v'.
        age: how many steps ago; 0 in the step itself.
        call: which answer of that step, from 0.
    """

    kind: Literal["x", "v", "p", "q"]
    age: int
    call: int = 0


class Coefficient(NamedTuple):
    """A number times a power of h."""

    number: Number
    power: int


#: Coefficients of symbols; those of no others are zero.
Form = Mapping[Symbol, Coefficient]


@dataclass(frozen=True)
class Updates:
    """What a step is, in symbols.

    Attributes:
        points: where it asks, x and v, call by call.
        parts: at what part of h it says it is, call by call, (t - t0)/h.
        end: x and v that it comes to.
        reused: whether its first call is the last of the step before, at that step's end (first same as last).
    """

    points: tuple[tuple[Form, Form], ...]
    parts: tuple[Number, ...]
    end: tuple[Form, Form]
    reused: bool = False

    @property
    def calls(self) -> int:
        """How many slopes a step takes."""
        return len(self.points) - self.reused

    @property
    def looks_back(self) -> int:
        """How many steps back it looks; 0 for a one-step method."""
        return max((s.age for form in self._forms() for s in form), default=0)

    @property
    def asks_only_accelerations(self) -> bool:
        """Whether it takes x' to be the velocity it keeps itself."""
        return not any(s.kind == "p" for form in self._forms() for s in form)

    def _forms(self) -> list[Form]:
        return [form for pair in (*self.points, self.end) for form in pair]


def updates_of(recording: Recording) -> Updates:
    """The formulas of a step that has all the past it looks back at.

    Raises:
        Unsupported: where the step has none, with the reason.
    """
    if recording.solved is not None:
        raise Unsupported("it asks for slopes too often in a step: it iterates")
    last = [row[-1] for row in recording.unit]
    if len({len(step.points) for row in (*recording.unit, *recording.dense) for step in row[1:]}) != 1:
        raise Unsupported("how often it asks for slopes depends on what they are: it adapts its step, or iterates")
    names = _symbols(recording.unit[0])
    form_pairs = [
        (_form(ones[0], twos[0], names), _form(ones[1], twos[1], names))
        for ones, twos in zip(_pairs(last[0]), _pairs(last[1]), strict=True)
    ]
    parts = tuple(_part(last[0], time) for time in last[0].times)
    found = _with_reused(Updates(tuple(form_pairs[:-1]), parts, form_pairs[-1]), recording)
    _check(found, recording)
    return found


def first_updates_of(recording: Recording) -> Updates | None:
    """The formulas of a first step, which may be another method's; None where it has none."""
    firsts = [row[0] for row in recording.unit]
    if not firsts or len({len(step.points) for step in firsts}) != 1:
        return None
    names = [symbol._replace(age=0) for symbol in _symbols(recording.unit[0][:1])]
    try:
        pairs = [
            (_form(ones[0], twos[0], names), _form(ones[1], twos[1], names))
            for ones, twos in zip(*map(_pairs, firsts), strict=True)
        ]
        parts = tuple(_part(firsts[0], time) for time in firsts[0].times)
    except Unsupported:
        return None
    return Updates(tuple(pairs[:-1]), parts, pairs[-1])


def _pairs(step: Step) -> list[tuple[Array, Array]]:
    return [*step.points, step.end]


def _symbols(steps: Sequence[Step]) -> list[Symbol]:
    """Which symbol each unit vector is, in the order they were handed out."""
    names = []
    for i, step in enumerate(steps):
        age = STEPS - 1 - i
        names += [Symbol("x", age), Symbol("v", age)]
        for call in range(len(step.points)):
            names += [Symbol("p", age, call), Symbol("q", age, call)]
    return names


def _form(one: Array, two: Array, names: Sequence[Symbol]) -> Form:
    """Coefficients as numbers times powers of h, from a vector at each of LENGTHS."""
    form = {}
    for symbol, c, d in zip(names, one, two, strict=False):
        if abs(c) <= ROUNDING and abs(d) <= ROUNDING:
            continue
        power = np.log(abs(c) / abs(d)) / np.log(LENGTHS[0] / LENGTHS[1]) if c and d else np.nan
        if not np.isfinite(power) or abs(power - round(power)) > 1e-6 or c * d < 0:
            raise Unsupported("its coefficients are no powers of the step length")
        form[symbol] = Coefficient(as_number(float(c / LENGTHS[0] ** round(power))), round(power))
    return form


def as_number(c: float) -> Number:
    """A fraction, where there is a simple one."""
    found = recognised(c, OFF * max(1.0, abs(c)))
    return c if found is None else found


def _part(step: Step, time: float) -> Number:
    return as_number((time - step.begun_at) / step.h)


def _with_reused(found: Updates, recording: Recording) -> Updates:
    """With the last answer of the step before as the first of this, where it was asked for at that step's end."""
    before = recording.unit[0][-2]
    old = {s.call for form in found._forms() for s in form if s.age == 1 and s.kind in "pq"}
    others = {s for form in found._forms() for s in form if s.age and not (s.age == 1 and s.kind in "pq")}
    if len(old) != 1 or others:
        return found
    (call,) = old
    if not all(np.array_equal(asked, end) for asked, end in zip(before.points[call], before.end, strict=True)):
        return found

    def renamed(form: Form) -> Form:
        return {
            (Symbol(s.kind, 0, 0) if s.age else Symbol(s.kind, 0, s.call + 1) if s.kind in "pq" else s): c
            for s, c in form.items()
        }

    one = Coefficient(Fraction(1), 0)
    start: tuple[Form, Form] = {Symbol("x", 0): one}, {Symbol("v", 0): one}
    points = (start, *((renamed(x), renamed(v)) for x, v in found.points))
    return Updates(points, (Fraction(0), *found.parts), (renamed(found.end[0]), renamed(found.end[1])), reused=True)


def _check(found: Updates, recording: Recording) -> None:
    """Raise Unsupported where steps from dense vectors are not what the formulas say: it is not linear in slopes."""
    for row in recording.dense:
        step, last = row[-1], len(row) - 1
        pairs = [*found.points[int(found.reused) :], found.end]
        for (x, v), (asked_x, asked_v) in zip(pairs, _pairs(step), strict=True):
            for form, value in ((x, asked_x), (v, asked_v)):
                expected = np.zeros_like(value)
                for s, c in form.items():
                    expected = expected + float(c.number) * step.h**c.power * _vector(row, last, s, found.reused)
                if np.abs(expected - value).max() > AGREEMENT * max(1.0, float(np.abs(value).max())):
                    raise Unsupported(NOT_LINEAR)


def _vector(row: Sequence[Step], last: int, s: Symbol, reused: bool) -> Array:
    """What a symbol stands for in dense steps."""
    if s.kind in "xv":
        return row[last - s.age].start["xv".index(s.kind)]
    which = "pq".index(s.kind)
    if reused:
        return row[last - 1].answers[-1][which] if s.call == 0 else row[last].answers[s.call - 1][which]
    return row[last - s.age].answers[s.call][which]


def in_words(found: Updates) -> list[str]:
    """The update formulas, line by line."""
    name = "a" if found.asks_only_accelerations else "f"
    lines = []
    for i, (x, v) in enumerate(found.points):
        where = f"{_written(x, name)}, {_written(v, name)}"
        again = ", as the step before left it" if found.reused and i == 0 else ""
        lines.append(f"{name}{i + 1} = {'acceleration' if name == 'a' else 'slope'}({where}){again}")
    lines.append(f"x' = {_written(found.end[0], name)}")
    lines.append(f"v' = {_written(found.end[1], name)}")
    numbers = [abs(c.number) for form in found._forms() for c in form.values()]
    roots = {f"{c:.7g}": text for c in numbers if isinstance(c, float) and (text := irrational(c))}
    return [*lines, *(["with " + ", ".join(f"{c} = {text}" for c, text in roots.items())] if roots else [])]


def _written(form: Form, name: str) -> str:
    words = ""
    for s, c in sorted(form.items(), key=lambda item: (item[0].kind in "pq", item[1].power, item[0].age, item[0].call)):
        letter = s.kind if s.kind in "xv" else f"{name}{s.call + 1}"
        if s.kind in "pq" and name == "f":
            letter += ".x" if s.kind == "p" else ".v"
        letter += f"[{-s.age}]" if s.age else ""
        h = "" if c.power == 0 else "h " if c.power == 1 else f"h^{c.power} "
        term = product(-c.number if c.number < 0 else c.number, f"{h}{letter}")
        sign = "-" if c.number < 0 else "+"
        words += f" {sign} {term}" if words else term if sign == "+" else f"-{term}"
    return words or "0"
