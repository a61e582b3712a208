"""A stepper's step matrix on the damped oscillator, as formulas in a = h^2 k/m, b = h c/m and d = h Cd/m."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from reference.derivation.fit import Samples, formula_of
from reference.derivation.formula import Formula
from reference.derivation.oscillators import DT, FEW, MANY, ROUNDINGS, Runs, one_by_one, samples, side_by_side
from reference.errors import Unsupported
from reference.identification.scale import ROUNDING, Precision
from reference.state import Array

#: What is tried, the most first: damping and drag, one of the two, neither.
VARIANTS = ((True, True), (True, False), (False, True), (False, False))

#: How: all oscillators in one system; one by one, as it takes an engine long to start few, then many.
WAYS = ((side_by_side, MANY), (one_by_one, FEW), (one_by_one, MANY))


@dataclass(frozen=True, eq=False)
class StepMatrix:
    """The 2 x 2 matrix that multiplies (x, h v) in a step.

    Attributes:
        entries: m11, m12, m21, m22.
        damped: whether it was seen with damping of the spring.
        dragged: whether it was seen with drag.
        samples: where it was measured.
        measured: what was, shape (n, 2, 2).
        only_at: the h [s] it is seen at, where it is another at another h and the same a, b and d; else None.
    """

    entries: tuple[Formula, Formula, Formula, Formula]
    damped: bool
    dragged: bool
    samples: Samples
    measured: Array
    only_at: float | None = None

    @property
    def exact(self) -> bool:
        """Whether all coefficients are fractions."""
        return all(entry.exact for entry in self.entries)

    @property
    def is_polynomial(self) -> bool:
        """Whether nothing is divided by: no equations are solved in the step."""
        return all(entry.is_polynomial for entry in self.entries)

    def asks(self, variable: str) -> bool:
        """Whether any entry depends on one of formula.VARIABLES."""
        return any(entry.asks(variable) for entry in self.entries)

    def at(self, a: Array, b: Array, d: Array) -> Array:
        """The matrices at many points, shape (n, 2, 2)."""
        a, b, d = np.broadcast_arrays(np.asarray(a, float), b, d)
        return np.stack([entry.at(a, b, d) for entry in self.entries], axis=-1).reshape(*a.shape, 2, 2)

    def text(self) -> list[list[str]]:
        """Its rows, as they are written."""
        m11, m12, m21, m22 = map(str, self.entries)
        return [[m11, m12], [m21, m22]]


def step_matrix(runs: Runs, precision: Precision = "double") -> StepMatrix:
    """Found from single steps of many oscillators, with damping and drag where the stepper can do them.

    Raises:
        Unsupported: where it can step no such oscillator, or its entries follow no small formula; with the reason.
    """
    reason, together = "", set()
    for (damped, dragged), (measure, count) in product(VARIANTS, WAYS):
        if (damped, dragged) in together and count == MANY:
            continue  # as many were stepped side by side: more of them tell no more one by one
        at = samples(damped, dragged, count)
        try:
            measured = measure(runs, at)
        except Unsupported as error:
            reason = reason or str(error)
            continue
        together |= {(damped, dragged)} if measure is side_by_side else set()
        noise = ROUNDINGS * ROUNDING[precision] * max(1.0, float(np.abs(measured).max()))
        entries = [formula_of(at, measured[:, i, j], noise) for i, j in product(range(2), range(2))]
        m11, m12, m21, m22 = entries
        if m11 is not None and m12 is not None and m21 is not None and m22 is not None:
            found = StepMatrix((m11, m12, m21, m22), damped, dragged, at, measured)
            if np.abs(measured - np.eye(2)).max() <= noise:
                raise Unsupported("a step changes nothing: the state stays as it is")
            if not found.asks("a"):
                raise Unsupported("a step does not depend on the springs' stiffness: springs are rods to it")
            return replace(found, only_at=DT) if _asks_for_h(runs, found, measure, 100 * noise) else found
        lost = ", ".join(f"m{i}{j}" for (i, j), e in zip(product((1, 2), (1, 2)), entries, strict=True) if e is None)
        reason = f"no small rational function of a, b and d gives {lost} of its step matrix"
    raise Unsupported(reason)


def _asks_for_h(runs: Runs, found: StepMatrix, measure: Callable[..., Array], noise: float) -> bool:
    """Whether at half the step, with a, b and d as they were, the matrix is another."""
    at = found.samples
    few = Samples(at.a[:FEW], at.b[:FEW], at.d[:FEW])
    try:
        again = measure(runs, few, DT / 2)
    except Unsupported:
        return False
    return bool(np.abs(again - found.at(few.a, few.b, few.d)).max() > noise)
