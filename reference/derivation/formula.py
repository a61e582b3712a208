"""A rational function of a = h^2 k/m, b = h c/m and d = h Cd/m, perhaps with E = exp(-b) or D = exp(-d)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import comb

import numpy as np

from reference.derivation.irrational import irrational
from reference.state import Array

#: The variables; and what they count in powers of h, by which terms are ordered. Exponentials count nothing.
VARIABLES, WEIGHTS = ("a", "b", "d", "E", "D"), (2, 1, 1, 0, 0)

#: Powers of the variables.
Monomial = tuple[int, int, int, int, int]

#: A coefficient: a fraction, or a number that none was recognised in.
Number = Fraction | float

Terms = Mapping[Monomial, Number]

ONE: Monomial = (0, 0, 0, 0, 0)


def weight(monomial: Monomial) -> int:
    """Its power of h."""
    return sum(w * n for w, n in zip(WEIGHTS, monomial, strict=True))


def evaluated(monomial: Monomial, a: Array, b: Array, d: Array) -> Array:
    """Its value at many points, shape (n,)."""
    powers = zip((a, b, d, np.exp(-b), np.exp(-d)), monomial, strict=True)
    product = np.ones(np.broadcast(a, b, d).shape)
    for value, power in powers:
        product = product * value**power
    return product


@dataclass(frozen=True)
class Formula:
    """Numerator over denominator; the denominator's constant is 1.

    Attributes:
        numerator: coefficients by monomial, none of them zero.
        denominator: the same.
    """

    numerator: Terms
    denominator: Terms = field(default_factory=lambda: {ONE: Fraction(1)})

    @property
    def exact(self) -> bool:
        """Whether every coefficient is a fraction."""
        return all(isinstance(c, Fraction) for c in (*self.numerator.values(), *self.denominator.values()))

    @property
    def is_polynomial(self) -> bool:
        """Whether nothing stands below."""
        return set(self.denominator) == {ONE}

    def asks(self, variable: str) -> bool:
        """Whether it depends on one of VARIABLES."""
        i = VARIABLES.index(variable)
        return any(m[i] for m in (*self.numerator, *self.denominator))

    def divided_by(self, variable: str) -> bool:
        """Whether one of VARIABLES stands below."""
        return Formula({ONE: Fraction(1)}, self.denominator).asks(variable)

    def at(self, a: Array, b: Array, d: Array) -> Array:
        """Its value at many points, shape (n,)."""
        above, below = (
            sum((float(c) * evaluated(m, a, b, d) for m, c in terms.items()), np.zeros(np.broadcast(a, b, d).shape))
            for terms in (self.numerator, self.denominator)
        )
        return np.asarray(above / below)

    def of_sum(self) -> Formula | None:
        """The same with b alone, meaning b + d, where it depends on their sum only; else None: also of exponentials."""
        if self.asks("E") or self.asks("D"):
            return None
        alone = Formula(*({m: c for m, c in terms.items() if not m[2]} for terms in (self.numerator, self.denominator)))
        spread = Formula(*map(_of_both, (alone.numerator, alone.denominator)))
        return alone if spread == self else None

    def rounded(self, decimals: int) -> Formula:
        """The same with coefficients that are no fractions to so many decimals."""
        return Formula(
            *(
                {m: c if isinstance(c, Fraction) else round(c, decimals) for m, c in terms.items()}
                for terms in (self.numerator, self.denominator)
            )
        )

    def __str__(self) -> str:
        """As it is written: (1 + b)/(1 + a + b)."""
        above, below = written(self.numerator), written(self.denominator)
        if self.is_polynomial:
            return above
        return f"({above})/({below})" if len(self.numerator) > 1 else f"{above}/({below})"


def written(terms: Terms) -> str:
    """A polynomial, the lowest powers of h first: 1 - a/2 + a^2/24.

    >>> written({ONE: Fraction(1), (1, 0, 0, 0, 0): Fraction(-1, 2)})
    '1 - a/2'
    """
    words = ""
    for monomial, c in sorted(terms.items(), key=lambda term: (weight(term[0]), tuple(-n for n in term[0]))):
        sign = "-" if c < 0 else "+"
        term = product(-c if c < 0 else c, _letters(monomial))
        words += f" {sign} {term}" if words else term if sign == "+" else f"-{term}"
    return words or "0"


def product(c: Number, letters: str) -> str:
    """A positive coefficient times letters: a/2, 3 a/4, 0.675604 a."""
    if not letters:
        return number(c)
    if not isinstance(c, Fraction):
        return f"{number(c)} {letters}"
    above = letters if c.numerator == 1 else f"{c.numerator} {letters}"
    return above if c.denominator == 1 else f"{above}/{c.denominator}"


def number(c: Number) -> str:
    """A coefficient as text: a fraction, or seven figures of what is none."""
    return str(c) if isinstance(c, Fraction) else f"{c:.7g}"


def exact_text(c: Number) -> str:
    """A coefficient as text: also with roots, where it is one of such numbers to rounding."""
    return number(c) if isinstance(c, Fraction) else irrational(c) or number(c)


def _of_both(terms: Terms) -> dict[Monomial, Number]:
    """With b + d in place of b, multiplied out."""
    return {(m[0], m[1] - k, k, 0, 0): comb(m[1], k) * c for m, c in terms.items() for k in range(m[1] + 1)}


def _letters(monomial: Monomial) -> str:
    powers = [(v, n) for v, n in zip(VARIABLES, monomial, strict=True) if n]
    return " ".join(v if n == 1 else f"{v}^{n}" for v, n in powers)
