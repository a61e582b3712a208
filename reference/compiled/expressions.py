"""Expressions written down while a function is run on symbols: what the tracing of schemes and obstacles is made of.

Arithmetic on a Symbol makes another Symbol that holds what was done. What depends on dt alone is a Scalar: it is not
written into loops but computed once, by Python, in the very order that the function has, and given to the loops as a
number. So loops and function agree to the bit, also where a compiler would compute a power otherwise.

Only what is known to come out the same is written down. All else is refused by name: the truth of a symbol (`if dt >
0.01`), its entries, assignment in place, functions and powers that are not in OPERATIONS.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NoReturn

import numpy as np

#: What can be done with symbols, by NumPy's function, and how Numba is told to do the same.
OPERATIONS: Mapping[Any, str] = MappingProxyType(
    {
        np.add: "{} + {}",
        np.subtract: "{} - {}",
        np.multiply: "{} * {}",
        np.divide: "{} / {}",
        np.negative: "-{}",
        np.positive: "{}",
        np.square: "{0} * {0}",
        np.less: "{} < {}",
        np.greater: "{} > {}",
        np.less_equal: "{} <= {}",
        np.greater_equal: "{} >= {}",
        np.sqrt: "np.sqrt({})",
        np.absolute: "np.abs({})",
        np.minimum: "np.minimum({}, {})",
        np.maximum: "np.maximum({}, {})",
        np.where: "{1} if {0} else {2}",
    }
)


#: Python's operators as NumPy's functions, which is what they are of arrays. Of plain numbers they are Python's own.
OPERATORS: Mapping[Any, Any] = MappingProxyType(
    {
        operator.add: np.add,
        operator.sub: np.subtract,
        operator.mul: np.multiply,
        operator.truediv: np.divide,
        operator.neg: np.negative,
        operator.pos: np.positive,
        operator.abs: np.absolute,
        operator.lt: np.less,
        operator.gt: np.greater,
        operator.le: np.less_equal,
        operator.ge: np.greater_equal,
    }
)

#: What is a number by itself.
NUMBERS = (bool, int, float, np.number, np.bool_)


class Untraceable(Exception):  # noqa: N818 - no error: the function runs as it is written
    """A function does with symbols what cannot be written down; the message says what."""


@dataclass(frozen=True)
class Expression:
    """What is to be computed for each mass and axis alone: a name, or an operation on other expressions.

    >>> x, v, c0 = Expression("x"), Expression("v"), Expression("c0")
    >>> moved = Expression("{} + {}", (x, Expression("{} * {}", (c0, v))))
    >>> moved.text(lambda name: name if name == "c0" else f"{name}[i]")
    '(x[i] + (c0 * v[i]))'

    Attributes:
        template: the name, or the operation's text with a {} for each part.
        parts: what it is done with.
    """

    template: str
    parts: tuple[Expression, ...] = ()

    def text(self, read: Callable[[str], str]) -> str:
        """As Python text, each name as it is read."""
        if not self.parts:
            return read(self.template)
        return f"({self.template.format(*(part.text(read) for part in self.parts))})"

    @property
    def names(self) -> frozenset[str]:
        """All names in it."""
        if not self.parts:
            return frozenset({self.template})
        return frozenset().union(*(part.names for part in self.parts))


class _Recorded:
    """What symbols and scalars have in common: their operators, and what neither can do."""

    #: NumPy asks those of higher priority first, and numbers of its own are never to make arrays of symbols.
    __array_priority__ = 1000
    shape: tuple[int, ...] = ()

    def _apply(self, function: Any, *inputs: object) -> Any:
        raise NotImplementedError

    def __array_ufunc__(self, function: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """What NumPy's own functions of numbers do with it."""
        if method != "__call__" or options:
            raise Untraceable(f"it asks for {function.__name__} with options")
        return self._apply(function, *inputs)

    def __array_function__(self, function: Any, _: Any, inputs: Any, options: Any) -> Any:
        """What its functions of arrays do."""
        if options:
            raise Untraceable(f"it asks for {function.__name__} with options")
        return self._apply(function, *inputs)

    def _with(self, function: Any, other: object, *inputs: object) -> Any:
        """An operator with another number; what is not a number may know itself what to do."""
        known = isinstance(other, (_Recorded, *NUMBERS))
        return self._apply(function, *inputs) if known else NotImplemented

    def __add__(self, other: object) -> Any:
        return self._with(operator.add, other, self, other)

    def __radd__(self, other: object) -> Any:
        return self._with(operator.add, other, other, self)

    def __sub__(self, other: object) -> Any:
        return self._with(operator.sub, other, self, other)

    def __rsub__(self, other: object) -> Any:
        return self._with(operator.sub, other, other, self)

    def __mul__(self, other: object) -> Any:
        return self._with(operator.mul, other, self, other)

    def __rmul__(self, other: object) -> Any:
        return self._with(operator.mul, other, other, self)

    def __truediv__(self, other: object) -> Any:
        return self._with(operator.truediv, other, self, other)

    def __rtruediv__(self, other: object) -> Any:
        return self._with(operator.truediv, other, other, self)

    def __neg__(self) -> Any:
        return self._apply(operator.neg, self)

    def __pos__(self) -> Any:
        return self._apply(operator.pos, self)

    def __abs__(self) -> Any:
        return self._apply(operator.abs, self)

    def __lt__(self, other: object) -> Any:
        return self._with(operator.lt, other, self, other)

    def __gt__(self, other: object) -> Any:
        return self._with(operator.gt, other, self, other)

    def __le__(self, other: object) -> Any:
        return self._with(operator.le, other, self, other)

    def __ge__(self, other: object) -> Any:
        return self._with(operator.ge, other, self, other)

    def __bool__(self) -> NoReturn:
        raise Untraceable("it branches on what is known only when it runs")

    def __array__(self, *_: object, **__: object) -> NoReturn:
        raise Untraceable("it makes an array of what is known only when it runs")

    def __eq__(self, other: object) -> NoReturn:
        raise Untraceable("it asks whether what is known only when it runs is equal to something")

    def __ne__(self, other: object) -> NoReturn:
        raise Untraceable("it asks whether what is known only when it runs is equal to something")

    __hash__ = None  # type: ignore[assignment]

    def _in_place(self, _: object) -> NoReturn:
        raise Untraceable("it changes in place what it was given")

    __iadd__ = __isub__ = __imul__ = __itruediv__ = __ipow__ = _in_place

    def __setitem__(self, _: object, __: object) -> NoReturn:
        raise Untraceable("it changes in place what it was given")

    def __getitem__(self, _: object) -> NoReturn:
        raise Untraceable("it asks for single entries")

    def __iter__(self) -> Iterator[Any]:
        raise Untraceable("it asks for single entries")

    def __len__(self) -> int:
        raise Untraceable("it asks how many masses there are")

    def __float__(self) -> float:
        raise Untraceable("it asks for the number that is known only when it runs")

    def __int__(self) -> int:
        raise Untraceable("it asks for the number that is known only when it runs")

    __index__ = __int__

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        raise Untraceable(f"it asks for {name!r} of an array")


class Scalar(_Recorded):
    """A number that depends on dt alone, computed once and by Python.

    Args:
        value: makes it of dt.
        text: what it is, for people and as its name in the table.
        known: the texts of the scalars that loops need, with how they are computed, in order.
    """

    def __init__(self, value: Callable[[float], Any], text: str, known: dict[str, Callable[[float], Any]]) -> None:
        self.value, self.text, self.known = value, text, known

    def __repr__(self) -> str:
        return self.text

    def __pow__(self, power: object) -> Any:
        return self._apply(operator.pow, self, power)

    def __rpow__(self, base: object) -> Any:
        return self._apply(operator.pow, base, self)

    def _apply(self, function: Any, *inputs: object) -> Any:
        if any(isinstance(i, Symbol) for i in inputs):
            return Symbol(self.expression())._apply(function, *inputs)
        _refuse_arrays(inputs)
        texts = ", ".join(repr(i) for i in inputs)
        return Scalar(
            lambda dt: function(*(i.value(dt) if isinstance(i, Scalar) else i for i in inputs)),
            f"{function.__name__}({texts})",
            self.known,
        )

    def expression(self) -> Expression:
        """Its name in loops, c0, c1, ..., entered in the table if it is new there."""
        self.known.setdefault(self.text, self.value)
        return Expression(f"c{list(self.known).index(self.text)}")


class Symbol(_Recorded):
    """An expression being written.

    Args:
        expression: what it is.
        lines: where every operation is noted down as a line of its own; else the expression has it all.
    """

    def __init__(self, expression: Expression | str, lines: list[str] | None = None) -> None:
        self.expression = Expression(expression) if isinstance(expression, str) else expression
        self.lines = lines

    def __repr__(self) -> str:
        return self.expression.text(str)

    def __pow__(self, power: object) -> Any:
        if power != 2:
            raise Untraceable(f"it asks for the power {power!r} of an array: of powers only squares are known")
        return self._apply(np.square, self)

    def __and__(self, other: object) -> Any:
        return self._made("{} & {}", (self, other))

    def _apply(self, function: Any, *inputs: object) -> Any:
        function = OPERATORS.get(function, function)
        if function not in OPERATIONS:
            raise Untraceable(f"it asks for {getattr(function, '__name__', function)}, which is not known")
        if len(inputs) != OPERATIONS[function].count("{") and function is not np.square:
            raise Untraceable(f"it asks for {function.__name__} of {len(inputs)} things")
        return self._made(OPERATIONS[function], inputs)

    def _made(self, template: str, inputs: Sequence[object]) -> Symbol:
        _refuse_arrays(inputs)
        whole = Expression(template, tuple(map(_expression_of, inputs)))
        lines = next((i.lines for i in inputs if isinstance(i, Symbol) and i.lines is not None), None)
        if lines is None:
            return Symbol(whole)
        name = f"t{len(lines)}"
        lines.append(f"{name} = {whole.text(str)[1:-1]}")
        return Symbol(name, lines)


def _refuse_arrays(inputs: Sequence[object]) -> None:
    for value in inputs:
        alone = isinstance(value, np.ndarray) and value.ndim == 0
        if not alone and not isinstance(value, (_Recorded, *NUMBERS)):
            raise Untraceable(f"it does arithmetic with a {type(value).__name__}")


def _expression_of(value: Any) -> Expression:
    if isinstance(value, Symbol):
        return value.expression
    if isinstance(value, Scalar):
        return value.expression()
    number = value.item() if isinstance(value, np.generic | np.ndarray) else value
    if isinstance(number, float) and not np.isfinite(number):
        return Expression({np.inf: "np.inf", -np.inf: "(-np.inf)"}.get(number, "np.nan"))
    return Expression(f"({number!r})" if number < 0 else repr(number))
