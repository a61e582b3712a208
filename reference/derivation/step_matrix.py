"""A stepper's step matrix on the damped oscillator, as formulas in a = h^2 k/m, b = h c/m and d = h Cd/m."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from reference.derivation.fit import POLYNOMIAL, Entries, Samples, formula_of, formulas_of
from reference.derivation.oscillators import (
    ASIDE,
    DT,
    FAR_ASIDE,
    FEW,
    MANY,
    ROUNDINGS,
    Runs,
    by_difference,
    one_by_one,
    samples,
    side_by_side,
)
from reference.derivation.substeps import as_whole, of_substeps
from reference.derivation.swings import CERTAIN, NOISE, are_rods, swing_matrices
from reference.errors import Unsupported
from reference.identification.scale import ROUNDING, Precision
from reference.state import Array

#: What is tried, the most first: damping and drag, one of the two, neither.
VARIANTS = ((True, True), (True, False), (False, True), (False, False))

#: With damping, with drag; how oscillators are stepped, and how many.
Way = tuple[tuple[bool, bool], tuple[Callable[..., Array], int]]

#: Under gravity, where nothing else can be done; and when formulas are looked for again, as that may take long.
LAST = ((False, False), (by_difference, FEW))
BOTH_OR_NONE, AGAIN = ((True, True), (False, False)), ((one_by_one, FEW),)

#: Where nothing is found, oscillators are taken so much softer; or values to be off by so many times rounding.
SOFTER, COARSER = 1 / 8, 1e5

#: Formulas of more terms may be those of several sub-steps, each of which has fewer.
MANY_TERMS = 10

#: Steps that multiply by more diverge; and nearer than this a step is the true motion.
HUGE, TRUE = 1e3, 1e-5

#: What is said where there is nothing else.
RODS = "a step does not depend on the springs' stiffness: springs are rods to it"

#: How: all oscillators in one system; one by one, as it takes an engine long to start few, then many.
WAYS = ((side_by_side, MANY), (one_by_one, FEW), (one_by_one, MANY))


@dataclass(frozen=True, eq=False)
class StepMatrix:
    """The 2 x 2 matrix that multiplies (x, h v) in a step.

    Attributes:
        entries: m11, m12, m21, m22; of a sub-step, where a step is many.
        damped: whether it was seen with damping of the spring.
        dragged: whether it was seen with drag.
        samples: where it was measured.
        measured: what was, shape (n, 2, 2).
        only_at: the h [s] it is seen at, where it is another at another h and the same a, b and d; else None.
        substeps: of how many equal ones a step is made.
        of_swings: whether it is that of the small swings of a rod, with a = h^2 g/L, x an angle and v its rate.
        softer: of what part of the usual a, b and d it was seen, as it has no formula with all.
        coarser: how many times rounding its values are off.
        left_out: why it was not seen with damping, or with drag, where it was not.
    """

    entries: Entries
    damped: bool
    dragged: bool
    samples: Samples
    measured: Array
    only_at: float | None = None
    substeps: int = 1
    of_swings: bool = False
    softer: float = 1.0
    coarser: float = 1.0
    left_out: tuple[str, ...] = ()

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
        n = self.substeps
        one = np.stack([entry.at(a / n**2, b / n, d / n) for entry in self.entries], axis=-1).reshape(*a.shape, 2, 2)
        return one if n == 1 else as_whole(one, n)

    def text(self) -> list[list[str]]:
        """Its rows, as they are written."""
        m11, m12, m21, m22 = map(str, self.entries)
        return [[m11, m12], [m21, m22]]


def step_matrix(runs: Runs, precision: Precision = "double", iterates: bool = False, parts: int = 1) -> StepMatrix:
    """Found from single steps of many oscillators, with damping and drag where the stepper can do them.

    Where that gives nothing, from softer ones, as iterations may converge there only; then to fewer digits, as what is
    differenced or solved for has no more. Of a stepper to which springs are rods it is that of small swings.

    Args:
        iterates: whether it solves equations by means of its own, which takes long for many unknowns at once.
        parts: of how many equal sub-steps a step is made, where that is known: formulas are then those of one.

    Raises:
        Unsupported: where it can step no such oscillator, or its entries follow no small formula; with the reason.
    """
    try:
        ways = product(VARIANTS, AGAIN) if iterates else (*product(VARIANTS, WAYS), LAST)
        return _search(runs, precision, ways, parts=parts)
    except NoFormula as error:
        for softer, coarser in ((SOFTER, 1.0), (1.0, COARSER)) if precision == "double" else ():
            try:
                found = _search(runs, precision, product(BOTH_OR_NONE, AGAIN), softer, coarser)
            except Unsupported:
                continue
            if found.exact and found.substeps == 1:
                return replace(found, softer=softer, coarser=coarser)
        raise error


class NoFormula(Unsupported):
    """Oscillators were stepped, and what came out follows no formula."""


def _search(
    runs: Runs, precision: Precision, ways: Iterable[Way], softer: float = 1.0, coarser: float = 1.0, parts: int = 1
) -> StepMatrix:
    reason, together, aside = "", set(), ASIDE if precision == "double" else FAR_ASIDE
    last: tuple[Samples, Array, float] | None = None
    without: dict[tuple[bool, bool], str] = {}
    for (damped, dragged), (measure, count) in ways:
        if measure is by_difference and last is not None:
            break
        if (damped, dragged) in together and count == MANY:
            continue  # as many were stepped side by side: more of them tell no more one by one
        whole = samples(damped, dragged, count)
        at = Samples(whole.a * softer, whole.b * softer, whole.d * softer)
        try:
            measured = measure(runs, at, DT, aside)
        except Unsupported as error:
            reason = without[damped, dragged] = str(error)
            continue
        together |= {(damped, dragged)} if measure is side_by_side else set()
        size = float(np.abs(measured).max())
        noise = coarser * ROUNDINGS * ROUNDING[precision] * ASIDE / aside * max(1.0, size)
        last = at, measured, noise
        found = _found(at, measured, noise, (damped, dragged), parts) if size < HUGE else None
        if found is not None:
            if np.abs(measured - np.eye(2)).max() <= noise:
                raise Unsupported("a step changes nothing: the state stays as it is")
            if not found.asks("a"):
                return _of_swings(runs, RODS)
            found = replace(found, left_out=tuple(_left_out(without, found)))
            once_more = partial(measure, runs, aside=aside)
            return replace(found, only_at=DT) if _asks_for_h(once_more, found, 100 * noise) else found
        digits = "" if precision == "double" else ", to the digits of single precision"
        without[damped, dragged] = f"its steps with that follow no small formula{digits}"
    if last is None:
        return _of_swings(runs, reason)
    raise NoFormula(_why_none(*last, precision))


def _left_out(without: dict[tuple[bool, bool], str], found: StepMatrix) -> Iterable[str]:
    """Why there is no damping in it, or no drag, in words: what happened with it alone, or with both."""
    reasons: dict[str, list[str]] = {}
    for word, there, way in (("damping", found.damped, (True, False)), ("drag", found.dragged, (False, True))):
        why = without.get(way) or without.get((True, True))
        if not there and why:
            reasons.setdefault(why, []).append(word)
    return [f"no {' and no '.join(words)} in its step matrix: {why}" for why, words in reasons.items()]


def _why_none(at: Samples, measured: Array, noise: float, precision: Precision) -> str:
    size = np.abs(measured).max()
    if size >= HUGE:
        return f"a step multiplies an oscillator by up to {size:.1g}: its iterations do not converge there"
    off = float(np.abs(measured - _true(at)).max())
    if off < TRUE:
        return f"a step is an oscillator's true motion, to {off:.1g} of it: by exponentials, or by many small steps"
    digits = "" if precision == "double" else ", to the digits of single precision"
    return f"no small rational function of a, b and d gives {_lost(at, measured, noise)} of its step matrix{digits}"


def _true(at: Samples) -> Array:
    """The exponential of ((0, 1), (-a, -b - d)), shape (n, 2, 2), by its series."""
    matrices = np.zeros((len(at.a), 2, 2))
    matrices[:, 0, 1], matrices[:, 1, 0], matrices[:, 1, 1] = 1.0, -at.a, -at.b - at.d
    total = term = np.broadcast_to(np.eye(2), matrices.shape)
    for k in range(1, 40):
        term = term @ matrices / k
        total = total + term
    return total


def _lost(at: Samples, measured: Array, noise: float) -> str:
    """Which entries have no formula."""
    lost = [formula_of(at, entry, noise) is None for entry in measured.reshape(-1, 4).T]
    return ", ".join(f"m{i}{j}" for (i, j), it in zip(product((1, 2), (1, 2)), lost, strict=True) if it)


def _found(at: Samples, measured: Array, noise: float, seen: tuple[bool, bool], parts: int) -> StepMatrix | None:
    """Of formulas that values follow, or that a sub-step follows, whichever are shorter; of a sub-step, if it is known.

    Args:
        seen: whether with damping, and with drag.
    """
    if parts > 1:
        known = of_substeps(at, measured, noise, (parts,), POLYNOMIAL)
        if known is not None:
            return StepMatrix(known[1], *seen, at, measured, substeps=parts)
    entries = formulas_of(at, measured, noise)
    if entries is not None and _terms(entries) <= MANY_TERMS:
        return StepMatrix(entries, *seen, at, measured)
    found = of_substeps(at, measured, noise)
    if found is not None and (entries is None or _terms(found[1]) < _terms(entries)):
        return StepMatrix(found[1], *seen, at, measured, substeps=found[0])
    return StepMatrix(entries, *seen, at, measured) if entries is not None else None


def _terms(entries: Entries) -> int:
    return sum(len(entry.numerator) + len(entry.denominator) for entry in entries)


def _of_swings(runs: Runs, reason: str) -> StepMatrix:
    """That of small swings of a rod. Raises Unsupported, with the reason why there is no other, where there is none."""
    for dragged in (True, False):
        at = samples(False, dragged, FEW)
        try:
            measured = swing_matrices(runs, at)
            rods = are_rods(runs)
        except Unsupported:
            continue
        entries = formulas_of(at, measured, NOISE)
        if entries is not None and rods and any(entry.asks("a") for entry in entries):
            m11, m12, m21, m22 = (entry.rounded(CERTAIN) for entry in entries)
            return StepMatrix((m11, m12, m21, m22), False, dragged, at, measured, of_swings=True)
    raise Unsupported(reason)


def _asks_for_h(measure: Callable[..., Array], found: StepMatrix, noise: float) -> bool:
    """Whether at half the step, with a, b and d as they were, the matrix is another."""
    at = found.samples
    few = Samples(at.a[:FEW], at.b[:FEW], at.d[:FEW])
    try:
        again = measure(few, DT / 2)
    except Unsupported:
        return False
    return bool(np.abs(again - found.at(few.a, few.b, few.d)).max() > noise)
