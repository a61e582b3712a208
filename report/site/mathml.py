"""Equations as MathML, which browsers set by themselves: no script, no font, and a screen reader reads them."""

from __future__ import annotations

from fractions import Fraction

from report.site.linear_form import Equations, Polynomial, Sum

#: Digits below and above the line: where there is no font for mathematics, browsers set indices badly.
LOWERED = "\u2080\u2081\u2082\u2083\u2084\u2085\u2086\u2087\u2088\u2089"
RAISED = ("", "", "\u00b2", "\u00b3", "\u2074", "\u2075", "\u2076", "\u2077", "\u2078", "\u2079")


def of_equations(equations: Equations) -> str:
    """Each stage's acceleration, the new state and what is remembered, one below the other."""
    lines = []
    for i, place in enumerate(equations.stages):
        at = (_new("x"), _new("v")) if place == equations.end else (_sum(place[0]), _sum(place[1]))
        lines.append(f"{_indexed('a', i)}<mo>=</mo>{_letter('a')}{_pair(*at)}")
    lines += [f"{_new(name)}<mo>=</mo>{_sum(what)}" for name, what in zip("xv", equations.end, strict=True)]
    lines += [f"{_new(_with_index(name))}<mo>=</mo>{_sum(what)}" for name, what in equations.remembers.items()]
    rows = "".join(f'<mtr><mtd style="text-align:left">{line}</mtd></mtr>' for line in lines)
    return f'<math display="block"><mtable displaystyle="true">{rows}</mtable></math>'


def _pair(one: str, other: str) -> str:
    return f'<mrow><mo stretchy="false">(</mo>{one}<mo separator="true">,</mo>{other}<mo stretchy="false">)</mo></mrow>'


def _sum(what: Sum) -> str:
    """X + h v + h^2/2 a0: positions first, then velocities, what is remembered, and accelerations in their order."""
    terms = [term for name in sorted(what, key=lambda name: "xvma".index(name[0])) for term in _terms(name, what[name])]
    text = "".join(
        (f"<mo>{'-' if factor < 0 else '+'}</mo>" if i or factor < 0 else "") + term
        for i, (factor, term) in enumerate(terms)
    )
    return f"<mrow>{text or '<mn>0</mn>'}</mrow>"


def _terms(name: str, coefficient: Polynomial) -> list[tuple[Fraction, str]]:
    symbol = _letter(_with_index(name))
    return [(factor, _factor(abs(factor), power) + symbol) for power, factor in sorted(coefficient.items())]


def _factor(factor: Fraction, power: int) -> str:
    """A fraction times a power of h; nothing for 1."""
    h = "" if power == 0 else _letter(f"h{RAISED[power]}")
    over = f"<mn>{factor.numerator}</mn>" if factor.numerator != 1 or not h else ""
    if factor.denominator != 1:
        return f"<mfrac><mrow>{over}{h}</mrow><mn>{factor.denominator}</mn></mfrac>"
    return (over if factor != 1 else "") + h


def _indexed(name: str, index: int) -> str:
    return _letter(_with_index(f"{name}{index}"))


def _with_index(name: str) -> str:
    """A0, m0, x-1 with what follows the letter below the line."""
    return name[0] + "".join("\u208b" if sign == "-" else LOWERED[int(sign)] for sign in name[1:])


def _new(name: str) -> str:
    return _letter(f"{name}\N{PRIME}")


def _letter(text: str) -> str:
    """In italics, with what stands below or above it: by themselves browsers set single letters so, and no others."""
    return f'<mi mathvariant="normal" style="font-style:italic">{text}</mi>'
