"""Functions over whole arrays as JavaScript: each kind of statement, and what comes along."""

# These are read, not run.
# ruff: noqa: E731, F841, RET508
# mypy: ignore-errors

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from reference.errors import Unsupported
from report.browser.array_functions import ArrayFunctions

FACTOR = 2.5


def helper(q, by=FACTOR, *, sign=-1):
    """Comes along."""
    return sign * by * q


def statements(x, rows, tol=1e-3):
    """Each once."""
    total = whole = 0.0
    a, b = x, 3
    total += FACTOR * a
    a[rows, :] = b
    for i in range(4):
        total = total - x[i]
    for j in range(1, 3):
        total = total / x[j]
    for row in rows:
        if row is None:
            break
        elif not row:
            total = total**2
        else:
            raise ValueError("no")
    return helper(total, sign=1)


def expressions(x, *others):
    """Each once."""
    twice = lambda one, two: one @ two + x
    found = [np.inf, -x, ~x, True, False, *others]
    found.append(np.where(x < 1, twice(x, x), abs(x)))
    return x if x >= 2 else (found, np.linalg.norm(x, axis=1), np.pi)


def inner(x):
    """With a function of its own."""

    def step(y):
        z = y <= x
        return z & (y > x)

    return step(x)


def refused(x):
    """Unknown to the page."""
    while x:
        x = x % 2


@dataclass
class Pair:
    """Two fields, one of which has a default in the page."""

    positions: float
    memory: tuple = ()

    KIND = 1

    def moved(self, by):
        """Along."""
        return self.positions + by

    @classmethod
    def of(cls, one):
        """Made."""
        return cls(one, one)


def text(*functions) -> list[str]:
    """The functions' lines, without what they stand in."""
    made = ArrayFunctions()
    names = [made.add(function) for function in functions]
    head, *lines, returned, end = made.script(names)
    assert (head, returned, end) == ("(() => {", f"  return {{{', '.join(names)}}};", "})()")
    return [line.removeprefix("  ") for line in lines]


def test_statements_are_said_one_by_one() -> None:
    """Names that are given values are declared; constants of the module are numbers, and what is called comes along."""
    assert text(statements) == [
        "function statements(x, rows, tol = 0.001) {",
        "  let a, b, i, j, row, total, whole;",
        "  total = 0.0;",
        "  whole = total;",
        "  [a, b] = [x, 3];",
        "  total = nd.plus(total, nd.times(2.5, a));",
        "  nd.put(a, b, rows, nd.ALL);",
        "  for (i = 0; i < 4; i++) {",
        "    total = nd.minus(total, nd.at(x, i));",
        "  }",
        "  for (j = 1; j < 3; j++) {",
        "    total = nd.over(total, nd.at(x, j));",
        "  }",
        "  for (row of rows) {",
        "    if (nd.truth((row === null))) {",
        "      break;",
        "    } else {",
        "      if (nd.truth(!nd.truth(row))) {",
        "        total = nd.power(total, 2);",
        "      } else {",
        "        throw new SolverError();",
        "      }",
        "    }",
        "  }",
        "  return helper(total, undefined, 1);",
        "}",
        "function helper(q, by = 2.5, sign = nd.negative(1)) {",
        "  return nd.times(nd.times(sign, by), q);",
        "}",
    ]


def test_expressions_are_said_by_the_pages_own_functions() -> None:
    """NumPy's by their names, keywords as an object behind the others; lambdas know names around them."""
    assert text(expressions) == [
        "function expressions(x, ...others) {",
        "  let found, twice;",
        "  twice = ((one, two) => nd.plus(nd.matmul(one, two), x));",
        "  found = [Infinity, nd.negative(x), nd.invert(x), true, false, ...others];",
        "  found.push(nd.where(nd.less(x, 1), twice(x, x), nd.abs(x)));",
        "  return (nd.truth(nd.least(x, 2)) ? x : [found, nd.linalg.norm(x, {axis: 1}), Math.PI]);",
        "}",
    ]


def test_a_function_within_has_names_of_its_own() -> None:
    """And those around it."""
    assert text(inner) == [
        "function inner(x) {",
        "  function step(y) {",
        "    let z;",
        "    z = nd.most(y, x);",
        "    return nd.and(z, nd.greater(y, x));",
        "  }",
        "  return step(x);",
        "}",
    ]


def test_what_cannot_be_said_is_refused_and_leaves_nothing() -> None:
    """By its first line."""
    made = ArrayFunctions()
    with pytest.raises(Unsupported, match=r"^the page cannot say in JavaScript: while x:$"):
        made.add(refused)
    assert made.texts == {}
    made.add(inner)
    made.add(inner)
    assert list(made.texts) == ["inner"]


def test_a_class_has_its_fields_and_some_methods() -> None:
    """One of the class is made with `new`; it knows itself by the name that Python's text has."""
    made = ArrayFunctions()
    made.add_class(Pair, ("moved", "of"))
    assert made.texts["Pair"] == [
        "class Pair {",
        "  constructor(positions, memory = []) { Object.assign(this, {positions, memory}); }",
        "  moved(by) {",
        "    const self = this;",
        "    return nd.plus(self.positions, by);",
        "  }",
        "  static of(one) {",
        "    const cls = Blocks;",
        "    return new cls(one, one);",
        "  }",
        "}",
    ]
