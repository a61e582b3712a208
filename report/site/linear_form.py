"""What a scheme computes, as sums: positions, velocities and accelerations, each with its coefficient in h.

The trace of a scheme (`reference.compiled.tracing`) has its arithmetic in the scheme's own order, as (x + c1 (v + (v +
c0 a0))). Multiplied out that is x + h v + h^2/2 a0: what a textbook prints.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from reference.compiled.expressions import OPERATIONS, Expression
from reference.compiled.tracing import Program

import numpy as np  # isort: skip

#: A coefficient: by the power of h, its factor.
Polynomial = dict[int, Fraction]

#: A sum: by the name of what is added (x, v, a0, a1, ...), its coefficient. The plain number 1 has the name "".
Sum = dict[str, Polynomial]

#: Coefficients are fractions with denominators up to this; those that are none are refused.
LARGEST_DENOMINATOR = 1000


class NotLinear(Exception):  # noqa: N818 - no error: it is shown as it is written
    """A scheme does more than to add multiples."""


@dataclass(frozen=True)
class Equations:
    """A scheme's step, multiplied out.

    Attributes:
        stages: positions and velocities at which each acceleration is taken.
        end: those of the new state.
        remembers: what the next step is given besides, by its name there: m0, m1, ...
    """

    stages: tuple[tuple[Sum, Sum], ...]
    end: tuple[Sum, Sum]
    remembers: Mapping[str, Sum] = field(default_factory=dict)


def equations(program: Program) -> Equations:
    """The sums of a traced scheme. Raises NotLinear where it is no such thing."""
    known = {f"c{i}": _monomial(value, text) for i, (text, value) in enumerate(program.coefficients)}
    stages = tuple((_sum(x, known), _sum(v, known)) for x, v in program.stages)
    return Equations(stages, (_sum(program.end[0], known), _sum(program.end[1], known)))


def _monomial(value: Callable[[float], Any], text: str) -> Polynomial:
    """A number that depends on dt alone, as a fraction times a power of h: looked at for three steps."""
    at = [float(value(h)) for h in (1.0, 2.0, 4.0)]
    fraction = Fraction(at[0]).limit_denominator(LARGEST_DENOMINATOR)
    power = 0 if at[0] == 0 else round(np.log2(at[1] / at[0])) if at[1] / at[0] > 0 else -1
    expected = [float(fraction) * h**power for h in (1.0, 2.0, 4.0)]
    if power < 0 or not np.allclose(at, expected, rtol=1e-14, atol=0):
        raise NotLinear(f"{text} is no fraction times a power of dt")
    return {power: fraction}


def _sum(expression: Expression, known: dict[str, Polynomial]) -> Sum:
    """An expression multiplied out."""
    if not expression.parts:
        return _leaf(expression.template, known)
    parts = [_sum(part, known) for part in expression.parts]
    operation = next(function for function, text in OPERATIONS.items() if text == expression.template)
    if operation is np.add:
        return _added(parts[0], parts[1])
    if operation is np.subtract:
        return _added(parts[0], _times(parts[1], {0: Fraction(-1)}))
    if operation is np.negative:
        return _times(parts[0], {0: Fraction(-1)})
    if operation is np.positive:
        return parts[0]
    if operation is np.multiply:
        number, other = (parts[0], parts[1]) if set(parts[0]) <= {""} else (parts[1], parts[0])
        if set(number) <= {""}:
            return _times(other, number.get("", {}))
    if operation is np.divide and set(parts[1]) == {""} and set(parts[1][""]) == {0}:
        return _times(parts[0], {0: 1 / parts[1][""][0]})
    raise NotLinear(f"{expression.template} is done with what changes from mass to mass")


def _leaf(name: str, known: dict[str, Polynomial]) -> Sum:
    if name in known:
        return {"": known[name]}
    if name in ("x", "v") or name.startswith("a"):
        return {name: {0: Fraction(1)}}
    return {"": {0: Fraction(float(name.strip("()"))).limit_denominator(LARGEST_DENOMINATOR)}}


def _added(one: Sum, other: Sum) -> Sum:
    total = {name: dict(polynomial) for name, polynomial in one.items()}
    for name, polynomial in other.items():
        into = total.setdefault(name, {})
        for power, factor in polynomial.items():
            into[power] = into.get(power, Fraction(0)) + factor
    cleared = {name: {power: f for power, f in into.items() if f} for name, into in total.items()}
    return {name: into for name, into in cleared.items() if into}


def _times(one: Sum, by: Polynomial) -> Sum:
    result: Sum = {}
    for name, polynomial in one.items():
        products = ((p + q, f * g) for p, f in polynomial.items() for q, g in by.items())
        for power, factor in products:
            result = _added(result, {name: {power: factor}})
    return result
