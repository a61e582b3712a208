"""The sums of a scheme that solves equations or looks back at earlier steps, seen in its steps: no trace shows them.

A step of random states, of the linear motion of a few masses, asks for accelerations at some places. Of few of them,
a0, a1, ..., it is a set of sums if the new state, what is remembered, and the places where these are taken are
combinations of x, v, what was remembered, and a0, a1, ...: by least squares, with nothing but rounding left. An
acceleration that stands in its own place is what equations are solved for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np

from reference.compiled.tracing import trace
from reference.errors import InputError, SolverError, Unsupported
from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.theory.linear_motion import LinearMotion
from reference.theory.step_coefficients import odd_system
from report.site.linear_form import Equations, NotLinear, Sum, equations

#: Steps [s] of which sums are looked for, as long as the fastest motion: coefficients are fractions times powers of dt.
STEPS = (1 / 16, 1 / 32, 1 / 8)

#: So many states at once, so many of the last accelerations that were asked for, and so many in the sums at most.
STATES, LAST, MOST = 8, 6, 3

#: What is left of a sum, and how far coefficients are off, as parts of themselves: rounding.
LEFT, OFF = 1e-9, 1e-10

#: Coefficients are fractions with denominators up to this: so few that 1e-10 is too near for chance.
LARGEST_DENOMINATOR = 10_000


@dataclass(frozen=True)
class _Step:
    """A step of many random states.

    Attributes:
        start: x, v and what is remembered, each all coordinates in a row.
        end: the same after it.
        asked: at which (x, v) accelerations were asked for at last, and these, the last one first.
    """

    start: Sequence[Array]
    end: Sequence[Array]
    asked: Sequence[tuple[Array, Array, Array]]


class _Watched(LinearMotion):
    """Equations of motion that keep where they were asked."""

    def __init__(self) -> None:
        system = odd_system(damped=True, dragged=True)
        super().__init__(system, system.start)
        self.asked: list[tuple[Array, Array, Array]] = []

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """As it is; without damping it is no acceleration of the equations of motion."""
        found = super().acceleration(state, damping)
        if damping:
            self.asked.append((state.positions, state.velocities, found))
        return found


def equations_of(scheme: Scheme) -> Equations:
    """The sums of a scheme's step: by a trace, else as seen in its steps. Raises NotLinear where it is none."""
    try:
        return equations(trace(scheme))
    except (Unsupported, NotLinear):
        pass
    try:
        return solved_equations(scheme)
    except (InputError, SolverError, Unsupported, TypeError, ValueError, IndexError) as error:
        raise NotLinear(f"{scheme.name} does not run on states in columns: {error}") from None


def solved_equations(scheme: Scheme) -> Equations:
    """The sums of a scheme that cannot be traced.

    Raises:
        NotLinear: where a step is none, and whatever the scheme raises.
    """
    if not scheme.linear or scheme.needs == "accelerations of one mass":
        raise NotLinear(f"{scheme.name} is not linear in the state")
    steps = [_stepped(scheme, h) for h in STEPS]
    rows = [_coefficients(step) for step in steps]
    shapes = {found.shape for found in rows}
    if len(shapes) > 1:
        raise NotLinear(f"{scheme.name} is another set of sums at another dt")
    ((_, count),) = shapes
    remembered = len(steps[0].start) - 2
    terms = ["x", "v", *(f"m{i}" for i in range(remembered))]
    terms += [f"a{i}" for i in range(count - len(terms))]
    sums = [_named(row, terms) for row in np.stack(rows, axis=1)]
    places = _pairs(sums[2 + remembered :])
    names = {f"m{i}": _name(i, kept, places) for i, kept in enumerate(sums[2 : 2 + remembered])}
    named = [{names.get(name, name): factor for name, factor in one.items()} for one in sums]
    kept = {name: named[2 + i] for i, name in enumerate(names.values()) if name.startswith("m")}
    return Equations(_pairs(named[2 + remembered :]), (named[0], named[1]), kept)


def _pairs(rows: Sequence[Sum]) -> tuple[tuple[Sum, Sum], ...]:
    return tuple(zip(rows[::2], rows[1::2], strict=True))


def _named(row: Array, terms: Sequence[str]) -> Sum:
    """The terms that are not zero, by their coefficients at all steps, shape (steps, terms)."""
    found = {name: _term(at) for name, at in zip(terms, row.T, strict=True)}
    return {name: {term[0]: term[1]} for name, term in found.items() if term is not None}


def _stepped(scheme: Scheme, h: float) -> _Step:
    """One step of h [s], from states and memories that have nothing to do with one another."""
    motion, chance = _Watched(), np.random.default_rng(0)
    step, free = scheme.on(motion), ~motion.system.fixed
    shape = (*motion.system.positions.shape, STATES)

    def some() -> Array:
        return np.where(free[:, None, None], chance.normal(size=shape), 0.0)

    start = State(0.0, some(), some())
    start = start.remembering(*(some() for _ in step(start, h).memory)) if not scheme.one_step else start
    motion.asked.clear()
    end = step(start, h)
    before, after = ([q[free].ravel() for q in (s.positions, s.velocities, *s.memory)] for s in (start, end))
    asked = [(x[free].ravel(), v[free].ravel(), a[free].ravel()) for x, v, a in reversed(motion.asked)]
    return _Step(before, after, asked[:LAST])


def _coefficients(step: _Step) -> Array:
    """Of the new state, of what is remembered and of each place, in this order, a row of coefficients of all terms.

    Raises:
        NotLinear: where they are no such sums.
    """
    for count in range(MOST + 1):
        found = [rows for chosen in combinations(step.asked, count) if (rows := _sums(step, chosen)) is not None]
        if found:
            return found[0]
    raise NotLinear("a step is no set of sums")


def _sums(step: _Step, chosen: Sequence[tuple[Array, Array, Array]]) -> Array | None:
    """The rows for some places, which come in the order of how far velocities carry them; None if any does not fit."""
    terms = np.stack([*step.start, *(place[2] for place in chosen)], axis=1)
    wanted = np.stack([*step.end, *(q for place in chosen for q in place[:2])], axis=1)
    rows = np.linalg.lstsq(terms, wanted, rcond=None)[0].T
    if (np.abs(terms @ rows.T - wanted).max(axis=0) > LEFT * np.abs(wanted).max(axis=0)).any():
        return None
    known = len(step.start)
    order = np.argsort(rows[known::2, 1], kind="stable")
    places = [row for k in order for row in (known + 2 * k, known + 2 * k + 1)]
    return rows[[*range(known), *places]][:, [*range(known), *(known + order)]]


def _term(at: Array) -> tuple[int, Fraction] | None:
    """A coefficient, at all steps, as a power of dt and a fraction; None for zero."""
    if np.abs(at).max() <= OFF:
        return None
    power = round(float(np.log2(abs(at[2] / at[0])))) if at[0] and at[2] else -1
    factors = at / np.array(STEPS) ** power
    found = Fraction(factors[0]).limit_denominator(LARGEST_DENOMINATOR)
    if power < 0 or np.abs(factors - float(found)).max() > OFF * max(1.0, abs(float(found))):
        raise NotLinear(f"{at[0]:g} at {STEPS[0]:g} s is no fraction times a power of dt")
    return power, found


def _name(i: int, kept: Sum, places: Sequence[tuple[Sum, Sum]]) -> str:
    """Of what is remembered: as what it was a step before, x-1, v-1 or a-1, else m and a number."""
    here = ({"x": {0: Fraction(1)}}, {"v": {0: Fraction(1)}})
    if kept in here:
        return f"{next(iter(kept))}-1"
    taken_here = [{f"a{k}": {0: Fraction(1)}} for k, place in enumerate(places) if place == here]
    return "a-1" if kept in taken_here else f"m{i}"
