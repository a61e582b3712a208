"""The law of springs that are not linear as JavaScript: its functions, called once with numbers that write themselves.

`reference.springs.nonlinear_law` computes all springs at once, by NumPy: of one spring that is the same text, where a
choice of NumPy's is one of JavaScript's. So nothing of the law is typed twice, and the force ends in the same bits. Of
the energy the fourth power is two squares here, and may be off by its last digit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from reference.springs.nonlinear_law import damping_at, energy_of_springs, secant_stiffness, tangent_stiffness

#: What the functions ask of a spring, in the order of their arguments; then its stretch.
ASKED = ("stiffness", "damping", "hardening", "largest_force", "tension_only", "compression_only")

#: The functions, by what the page calls them.
_FUNCTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "secant_stiffness": secant_stiffness,
    "tangent_stiffness": tangent_stiffness,
    "damping_at": damping_at,
    "energy_of_spring": energy_of_springs,
}


@dataclass(frozen=True)
class Written:
    """A number, or a truth, as the JavaScript that computes it.

    Attributes:
        text: of the expression.
    """

    text: str

    def __add__(self, other: Any) -> Written:
        return _joined(self, "+", other)

    def __radd__(self, other: Any) -> Written:
        return _joined(other, "+", self)

    def __sub__(self, other: Any) -> Written:
        return _joined(self, "-", other)

    def __mul__(self, other: Any) -> Written:
        return _joined(self, "*", other)

    def __rmul__(self, other: Any) -> Written:
        return _joined(other, "*", self)

    def __truediv__(self, other: Any) -> Written:
        return _joined(self, "/", other)

    def __pow__(self, power: int) -> Written:
        square = _joined(self, "*", self)
        return {2: square, 4: _joined(square, "*", square)}[power]

    def __lt__(self, other: Any) -> Written:
        return _joined(self, "<", other)

    def __gt__(self, other: Any) -> Written:
        return _joined(self, ">", other)

    def __and__(self, other: Any) -> Written:
        return _joined(self, "&&", other)

    def __or__(self, other: Any) -> Written:
        return _joined(self, "||", other)

    def __array_ufunc__(self, ufunc: Any, method: str, *values: Any) -> Any:
        """Functions of NumPy's that the law calls for every number."""
        if ufunc is np.absolute and method == "__call__":
            return Written(f"Math.abs({_text(values[0])})")
        if ufunc is np.bitwise_or and method == "__call__":
            return _joined(values[0], "||", values[1])
        return NotImplemented

    def __array_function__(self, function: Any, types: Any, values: Any, named: Any) -> Any:
        """A choice: of one spring, that of JavaScript."""
        if function is np.where and not named:
            condition, one, other = map(_text, values)
            return Written(f"({condition} ? {one} : {other})")
        return NotImplemented


def law_functions() -> list[str]:
    """The law as functions of a page: of a spring's numbers and its stretch [m]."""
    spring = {name: Written(name) for name in ASKED}
    law = SimpleNamespace(**{name: spring[name] for name in ASKED[2:]})
    system = SimpleNamespace(stiffness=spring["stiffness"], damping=spring["damping"], nonlinear=law)
    arguments = ", ".join((*ASKED, "stretch"))
    lines = []
    for name, function in _FUNCTIONS.items():
        written = _text(function(system, Written("stretch")))
        lines += [f"function {name}({arguments}) {{", f"  return {written};", "}"]
    return lines


def _joined(one: Any, operator: str, other: Any) -> Written:
    return Written(f"({_text(one)} {operator} {_text(other)})")


def _text(value: Any) -> str:
    """Of a number, of what is written, and of an array of it alone, which NumPy makes of it."""
    value = value.item() if isinstance(value, np.ndarray) else value
    return value.text if isinstance(value, Written) else repr(value)
