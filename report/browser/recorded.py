"""Functions of NumPy arrays run once on numbers that write themselves: what they do to one spring, as JavaScript.

The derivatives of a spring's force are written for all springs at once, by NumPy. Of one spring, run on arrays whose
numbers note down what is done to them, they are a row of assignments, each kept once. So the Jacobians and the bending
forces of the page are those of `reference.assembly` and `reference.springs.angular_law`, and nothing is typed twice.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from reference.errors import Unsupported


@dataclass
class Recorder:
    """What was done, line by line; what is done twice is written once."""

    lines: list[str] = field(default_factory=list)
    _known: dict[str, str] = field(default_factory=dict)

    def keep(self, expression: str) -> str:
        """A name for an expression."""
        if expression not in self._known:
            name = self._known[expression] = f"t{len(self._known)}"
            self.lines.append(f"const {name} = {expression};")
        return self._known[expression]

    def numbers(self, *shape: int, name: str) -> Recorded:
        """An array of numbers that are given, called after it: name0, name1, ..."""
        size = int(np.prod(shape))
        return Recorded(self, np.array([f"{name}{k}" for k in range(size)], dtype=object).reshape(shape))


def _infix(operator: str) -> Callable[..., str]:
    return lambda one, other: f"{one} {operator} {other}"


def _called(function: str) -> Callable[..., str]:
    return lambda *values: f"{function}({', '.join(values)})"


#: How functions of NumPy's that go over numbers are written in JavaScript.
_UFUNCS: dict[str, Callable[..., str]] = {
    "add": _infix("+"),
    "subtract": _infix("-"),
    "multiply": _infix("*"),
    "divide": _infix("/"),
    "equal": _infix("==="),
    "less": _infix("<"),
    "greater": _infix(">"),
    "bitwise_and": _infix("&&"),
    "bitwise_or": _infix("||"),
    "negative": _called("-"),
    "absolute": _called("Math.abs"),
    "sqrt": _called("Math.sqrt"),
    "sin": _called("Math.sin"),
    "cos": _called("Math.cos"),
    "arctan2": _called("Math.atan2"),
}


class Recorded(NDArrayOperatorsMixin):
    """An array of numbers that write themselves.

    Args:
        recorder: where what is done to them is noted.
        texts: of the numbers, any shape.
    """

    def __init__(self, recorder: Recorder, texts: Any) -> None:
        self.recorder, self.texts = recorder, np.asarray(texts, dtype=object)

    @property
    def shape(self) -> tuple[int, ...]:
        """As of any array."""
        return tuple(self.texts.shape)

    def __len__(self) -> int:
        return len(self.texts)

    def __bool__(self) -> bool:
        raise Unsupported("the page cannot say in JavaScript: a choice for all numbers at once")

    def __getitem__(self, key: Any) -> Recorded:
        return Recorded(self.recorder, self.texts[key])

    def all(self) -> bool:
        """What is written down is for those that have it all."""
        return True

    def transpose(self, *axes: int) -> Recorded:
        """As of any array."""
        return Recorded(self.recorder, self.texts.transpose(*axes))

    def each(self, write: Callable[..., str], *others: Any) -> Recorded:
        """What is written of each number and those of other arrays in its place."""
        texts = np.broadcast_arrays(self.texts, *map(_texts, others))
        made = [self.recorder.keep(write(*values)) for values in zip(*(t.ravel() for t in texts), strict=True)]
        return Recorded(self.recorder, np.array(made, dtype=object).reshape(texts[0].shape))

    def __array_ufunc__(self, ufunc: Any, method: str, *values: Any, **named: Any) -> Any:
        if method == "at" and ufunc is np.add:
            into, where, what = values
            for k, place in enumerate(where):
                into.texts[place] = (into[place] + what[k]).texts
            return None
        if method != "__call__" or named:
            return NotImplemented
        if ufunc is np.power and values[1] == 2:
            ufunc, values = np.multiply, (values[0], values[0])
        if ufunc.__name__ not in _UFUNCS:
            raise Unsupported(f"the page cannot say in JavaScript: numpy.{ufunc.__name__}")
        write = _UFUNCS[ufunc.__name__]
        empty = Recorded(self.recorder, np.array("", dtype=object))
        return empty.each(lambda _, *texts: write(*texts), *values)

    def __array_function__(self, function: Any, types: Any, values: Any, named: Any) -> Any:
        if function.__name__ not in _FUNCTIONS:
            raise Unsupported(f"the page cannot say in JavaScript: numpy.{function.__name__}")
        return _FUNCTIONS[function.__name__](self.recorder, *values, **named)


def _texts(value: Any) -> Any:
    if isinstance(value, Recorded):
        return value.texts
    return np.array([repr(v) for v in np.asarray(value).ravel().tolist()], dtype=object).reshape(np.shape(value))


def _where(recorder: Recorder, condition: Any, one: Any, other: Any) -> Recorded:
    if not isinstance(condition, Recorded):
        condition = Recorded(recorder, np.where(condition, "true", "false"))
    return condition.each(lambda when, yes, no: f"{when} ? {yes} : {no}", one, other)


def _sum_of_products(recorder: Recorder, pattern: str, one: Recorded, other: Recorded) -> Recorded:
    assert pattern in ("si,si->s", "...i,...i->..."), pattern
    products = one * other
    total = products[..., 0]
    for axis in range(1, products.shape[-1]):
        total = total + products[..., axis]
    return total


def _norm(recorder: Recorder, vectors: Recorded, axis: int, keepdims: bool = False) -> Recorded:
    assert axis in (-1, len(vectors.shape) - 1)
    size: Recorded = np.sqrt(_sum_of_products(recorder, "...i,...i->...", vectors, vectors))
    return size[..., None] if keepdims else size


def _cross(recorder: Recorder, one: Any, other: Any) -> Recorded:
    a, b = (Recorded(recorder, _texts(vectors)) for vectors in (one, other))
    parts = [a[..., (k + 1) % 3] * b[..., (k + 2) % 3] - a[..., (k + 2) % 3] * b[..., (k + 1) % 3] for k in range(3)]
    return _stack(recorder, parts)


def _stack(recorder: Recorder, parts: Sequence[Recorded], axis: int = -1) -> Recorded:
    return Recorded(recorder, np.stack([part.texts for part in parts], axis=axis))


def _smallest(recorder: Recorder, values: Recorded, axis: int) -> Recorded:
    """The place of the first of the smallest, of three."""
    a, b, c = (values[..., k] for k in range(3))
    return a.each(lambda p, q, r: f"{q} < {p} ? ({r} < {q} ? 2 : 1) : ({r} < {p} ? 2 : 0)", b, c)


def _zeros(recorder: Recorder, like: Recorded) -> Recorded:
    return Recorded(recorder, np.full(like.shape, "0.0", dtype=object))


def _round(recorder: Recorder, values: Recorded) -> Recorded:
    return values.each(_called("nd.rint"))


def _block(recorder: Recorder, rows: Sequence[Sequence[Recorded]]) -> Recorded:
    return Recorded(
        recorder, np.concatenate([np.concatenate([b.texts for b in row], axis=-1) for row in rows], axis=-2)
    )


#: And those that do more.
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "where": _where,
    "einsum": _sum_of_products,
    "norm": _norm,
    "cross": _cross,
    "stack": _stack,
    "argmin": _smallest,
    "zeros_like": _zeros,
    "round": _round,
    "block": _block,
}
