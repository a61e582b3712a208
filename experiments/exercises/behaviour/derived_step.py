"""What a wrong step computes, derived: its step matrix on one mass that swings about its rest, as formulas.

The student is shown their own formulas and which of their four entries is not that of the right step, not the right
ones. It is what `springlab explain` derives (`reference.derivation`), from answers of the sandbox.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.verdict.findings import Finding, listed
from reference.state import Array

if TYPE_CHECKING:
    from reference.derivation.fit import Samples
    from reference.derivation.formula import Formula

#: Fields by which the last argument of a step is told to be one spring, or a string.
SPRING, STRING = {"mass", "stiffness", "damping"}, {"masses", "stiffness", "drag", "anchor"}

#: The four entries, as a student would write them.
ENTRIES = ("x in the new x", "h v in the new x", "x in the new h v", "h v in the new h v")

#: Of so many oscillators a step of half the length is taken too: whether dt stands in the step as it should.
CHECKED = 4

#: Makes a question: a, and b or d of an oscillator, x [m] and v [m/s] below and downwards from its rest, dt [s].
Make = Callable[[float, float, float, float, float], Question]


def questions(exercise: Exercise, asked: Sequence[Question]) -> list[Question]:
    """Single steps of many oscillators, each displaced and each moving; none of exercises that are no step."""
    make = next((made for question in asked if (made := _maker(question)) is not None), None)
    if make is None:
        return []
    from reference.derivation.oscillators import ASIDE, DT  # half a second, which other exercises have no need of

    at = _samples()
    cases = list(zip(at.a.tolist(), at.b.tolist(), strict=True))
    return [
        make(a, b, x, v, dt)
        for dt, some in ((DT, cases), (DT / 2, cases[:CHECKED]))
        for a, b in some
        for x, v in ((ASIDE, 0.0), (0.0, ASIDE / dt))
    ]


def _samples() -> Samples:
    """With one kind of damping: a spring's of one mass, or the drag of a string, which act alike on it."""
    from reference.derivation.oscillators import FEW, samples

    return samples(True, False, FEW)


def _maker(question: Question) -> Make | None:
    fields = question.arguments[-1] if len(question.arguments) == 4 else None
    if not isinstance(fields, Mapping) or len(question.parts) != 2:
        return None
    if fields.keys() >= SPRING:

        def on_spring(a: float, b: float, x: float, v: float, dt: float) -> Question:
            spring = {"mass": 1.0, "stiffness": a / dt**2, "rest_length": 1.0, "damping": b / dt, "gravity": 0.0}
            return Question(question.function, (-1.0 - x, -v, dt, spring), question.parts, "an oscillator")

        return on_spring
    if fields.keys() >= STRING and "damping" not in fields:

        def on_string(a: float, b: float, x: float, v: float, dt: float) -> Question:
            string = {
                "masses": np.ones(1),
                "stiffness": np.array([a / dt**2]),
                "rest_lengths": np.ones(1),
                "drag": b / dt,
                "gravity": 0.0,
                "anchor": np.zeros(2),
            }
            place, speed = np.array([[0.0, -1.0 - x]]), np.array([[0.0, -v]])
            return Question(question.function, (place, speed, dt, string), question.parts, "an oscillator")

        return on_string
    return None


def seen(exercise: Exercise, asked: Sequence[Question], answers: Sequence[Mapping[str, Any]]) -> list[Finding]:
    """The derived step, where it is another than the right one's, and follows a formula.

    Args:
        asked: what `questions` made. answers: those of the submission to it.
    """
    if not asked:
        return []
    from reference.derivation.fit import formula_of
    from reference.derivation.oscillators import FEW, ROUNDINGS
    from reference.identification.scale import ROUNDING

    own = _matrices(asked, [_ends(next(iter(answer["values"]), [])) for answer in answers])
    right = _matrices(asked, [_ends(exercise.right_at_first(question)) for question in asked])
    if own is None or right is None:
        return []
    noise = ROUNDINGS * ROUNDING["double"] * max(1.0, float(np.abs(own).max()))
    wrong = [n for n, (i, j) in zip(ENTRIES, _places(), strict=True) if np.abs((own - right)[:, i, j]).max() > noise]
    with np.errstate(over="ignore"):  # of numbers that are no step's
        found = [formula_of(_samples(), own[:FEW, i, j], noise) for i, j in _places()] if wrong else []
    formulas = [formula for formula in found if formula is not None and formula.exact]
    if len(formulas) < len(ENTRIES):
        return []
    at = _samples()
    halved = [f.at(at.a[:CHECKED], at.b[:CHECKED], at.d[:CHECKED]) for f in formulas]
    if np.abs(own[FEW:].reshape(CHECKED, -1) - np.stack(halved, axis=1)).max() > 100 * noise:
        return []  # dt stands in it otherwise than as h
    return [Finding("derived_step", f"{_written(formulas)} Not as it should be: {listed(wrong)}.", HINT)]


#: What to look at.
HINT = (
    "Write down by hand what your lines make of the force -k x - c v in one step. At which of them does this part come?"
)


def _written(formulas: Sequence[Formula]) -> str:
    of_x, of_v, by_x, by_v = (
        of if str(f) == "1" else f"({f}) {of}" for f, of in zip(formulas, ("x", "h v", "x", "h v"), strict=True)
    )
    return (
        "Of one mass that swings about its rest, at x, moving at v, your step makes: "
        f"new x = {of_x} + {of_v}, new h v = {by_x} + {by_v}, "
        "with h = dt, a = h^2 k/m, b = h c/m (c is damping or drag)."
    )


def _places() -> list[tuple[int, int]]:
    return list(product(range(2), range(2)))


def _ends(parts: Sequence[Any]) -> tuple[float, float] | None:
    """How far below its rest the mass is then, and how fast it goes downwards; None where there are no such numbers."""
    if len(parts) != 2:
        return None
    x, v = (np.asarray(part) for part in parts)
    if x.dtype.kind not in "iuf" or v.dtype.kind not in "iuf" or x.size not in (1, 2) or v.size != x.size:
        return None
    return -1.0 - float(x.ravel()[-1]), -float(v.ravel()[-1])


def _matrices(asked: Sequence[Question], ends: Sequence[tuple[float, float] | None]) -> Array | None:
    """Step matrices, shape (n, 2, 2); None where an answer is missing, or not finite."""
    from reference.derivation.oscillators import ASIDE

    numbers = np.array([end for end in ends if end is not None])
    if not ends or len(numbers) < len(asked) or not np.isfinite(numbers).all():
        return None
    numbers[:, 1] *= [question.arguments[2] for question in asked]
    return np.asarray((numbers / ASIDE).reshape(-1, 2, 2).swapaxes(1, 2))
