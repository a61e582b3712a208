"""Coefficients of linear multistep methods, implicit ones too, from a row of steps.

y1 = sum_j alpha_j y_-j + h (beta_0 f(y1) + sum_j beta_j+1 f(y_-j)), with j = 0 .. k - 1: where every unknown is its own
or moves otherwise than the others, a few steps are many equations for these 2 k + 1 numbers. HNW is Hairer, Norsett and
Wanner, *Solving Ordinary Differential Equations I* (1993).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from reference.derivation.formula import Number, exact_text, product
from reference.derivation.small_fractions import fraction_or_itself
from reference.state import Array

#: So many earlier states are looked back at, at most.
MOST = 4

#: What may be left of the equations as a part of a step's change; how far a coefficient may be off.
LEFT, OFF = 1e-9, 1e-8

#: Orders are looked for up to this.
HIGHEST = 8


@dataclass(frozen=True)
class Multistep:
    """A linear multistep method.

    Attributes:
        alpha: of y0, y-1, ...: shape (k,).
        beta: of h f(y1), h f(y0), h f(y-1), ...: shape (k + 1,).
    """

    alpha: tuple[Number, ...]
    beta: tuple[Number, ...]

    @property
    def explicit(self) -> bool:
        """Whether no equations are solved."""
        return not self.beta[0]

    @property
    def order(self) -> int:
        """The largest q up to which sum alpha_j (-j)^q + q sum beta_j (1 - j)^(q - 1) = 1 (HNW III.2)."""
        order = 0
        for q in range(HIGHEST + 1):
            total = sum(float(a) * (-j) ** q for j, a in enumerate(self.alpha))
            total += sum(q * float(b) * (1 - j) ** (q - 1) for j, b in enumerate(self.beta) if q)
            if abs(total - 1) > OFF * 2**q * len(self.beta) ** q:
                break
            order = q
        return order

    def same(self, other: Multistep) -> bool:
        """Whether all coefficients are."""
        pairs = zip((*self.alpha, *self.beta), (*other.alpha, *other.beta), strict=False)
        return len(self.alpha) == len(other.alpha) and all(abs(float(c) - float(its)) <= OFF for c, its in pairs)

    def __str__(self) -> str:
        """As it is written: y1 = 4 y0/3 - y-1/3 + 2 h f(y1)/3."""
        at = ["y1", *(f"y{-j}" for j in range(len(self.alpha)))]
        terms = [(a, name) for a, name in zip(self.alpha, at[1:], strict=True)]
        terms += [(b, f"h f({name})") for b, name in zip(self.beta, at, strict=True)]
        words = ""
        for c, name in terms:
            if c:
                sign, size = ("-" if c < 0 else "+"), product(-c if c < 0 else c, name)
                words += f" {sign} {size}" if words else size if sign == "+" else f"-{size}"
        return f"y1 = {words}"

    def text(self) -> dict[str, list[str]]:
        """Its numbers as they are written."""
        return {"alpha": list(map(exact_text, self.alpha)), "beta": list(map(exact_text, self.beta))}


def multistep_of(h: float, states: Sequence[Array], slopes: Sequence[Array]) -> Multistep | None:
    """The method of the fewest steps back that all later states satisfy; None where it has none, or is of one step.

    Args:
        states: y0, y1, ... of a row of steps, each shape (n,); slopes: f of each.
    """
    for k in range(1, MOST + 1):
        found = _of(k, h, states, slopes)
        if found is not None:
            return found if k > 1 else None
    return None


def _of(k: int, h: float, states: Sequence[Array], slopes: Sequence[Array]) -> Multistep | None:
    rows, wanted = [], []
    for n in range(MOST - 1, len(states) - 1):  # those before may be another method's, that begins it
        back = [n - j for j in range(k)]
        rows.append(
            np.stack([*(states[i] - states[n] for i in back[1:]), *(h * slopes[i] for i in (n + 1, *back))], axis=1)
        )
        wanted.append(states[n + 1] - states[n])
    matrix, change = np.concatenate(rows), np.concatenate(wanted)
    solution, _, rank, _ = np.linalg.lstsq(matrix, change, rcond=1e-13)
    if rank < matrix.shape[1] or np.abs(matrix @ solution - change).max() > LEFT * np.abs(change).max():
        return None
    earlier = [fraction_or_itself(c, OFF) for c in solution[: k - 1].tolist()]
    alpha = (1 - sum(earlier, start=Fraction(0)), *earlier)
    return Multistep(alpha, tuple(fraction_or_itself(c, OFF) for c in solution[k - 1 :].tolist()))
