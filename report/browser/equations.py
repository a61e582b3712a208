"""What a scheme computes in a step, as equations: from the same trace that its loops come from."""

from __future__ import annotations

import re

from reference.compiled.expressions import Expression
from reference.compiled.tracing import trace
from reference.errors import Unsupported
from reference.schemes.catalogue import Scheme

#: How coefficients are written, by their texts.
_WORDS = {"dt": "dt", "truediv(dt, 2)": "(dt/2)", "truediv(dt, 6)": "(dt/6)"}


def equations_of(scheme: Scheme) -> list[str]:
    """A line for each stage's acceleration and one each for the new positions and velocities; none if not traceable.

    >>> from reference.schemes.catalogue import find
    >>> equations_of(find("kick_drift"))
    ['a0 = a(x, v)', "x' = x + dt (v + dt a0)", "v' = v + dt a0"]
    """
    try:
        program = trace(scheme)
    except Unsupported:
        return []
    words = {f"c{k}": _word(text) for k, (text, _) in enumerate(program.coefficients)}

    def written(expression: Expression) -> str:
        return _shown(expression, words)

    lines = [f"a{k} = a({written(x)}, {written(v)})" for k, (x, v) in enumerate(program.stages)]
    x, v = program.end
    return [*lines, f"x' = {written(x)}", f"v' = {written(v)}"]


def _word(text: str) -> str:
    if text in _WORDS:
        return _WORDS[text]
    return "(" + re.sub(r"truediv\((\w+), (\w+)\)", r"\1/\2", text) + ")"


def _shown(expression: Expression, words: dict[str, str]) -> str:
    """With no more brackets than there must be, and products side by side."""
    if not expression.parts:
        return words.get(expression.template, expression.template)
    parts = [_shown(part, words) for part in expression.parts]
    sums = [part.template in ("{} + {}", "{} - {}") for part in expression.parts]
    match expression.template:
        case "{} * {}":
            return " ".join(f"({part})" if is_sum else part for part, is_sum in zip(parts, sums, strict=True))
        case "{} + {}":
            return " + ".join(parts)
        case "{} - {}":
            return f"{parts[0]} - {f'({parts[1]})' if sums[1] else parts[1]}"
    return f"({expression.template.format(*parts)})"
