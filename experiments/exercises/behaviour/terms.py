"""Which terms of a wrong force are right, and which slope of a wrong step: found by questions that isolate them.

A force is asked for with all of its terms but one switched off: no stiffness but that of one spring, no weight, no
drag. What comes out is that term alone, whatever else is in the program. A step of two slopes is asked for with a
shorter dt: where only its second slope is wrong it comes near the right one as dt^2, where already the first is as dt.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from experiments.exercises.behaviour.special_cases import Parts
from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.findings import Finding, listed

#: A row of an answer is right up to this part of its largest number.
SAME = 1e-9

#: What is nearer to the right step than this part of it is off by rounding.
ROUNDING = 1e-13

#: A shorter dt, as a part of the question's; and half of it.
SHORTER = (1 / 64, 1 / 128)

#: The fields that a term is made of.
MADE_OF = {
    "the weight": ("gravity",),
    "the drag": ("drag",),
    "the damping": ("damping",),
    "the spring": ("stiffness", "rest_length"),
}

#: Of more lines than these none is told.
MOST_LINES = 3

#: By what an error shrinks with half the dt: where the first slope is wrong, and where only the second is.
OF_THE_FIRST, OF_THE_SECOND = (1.9, 2.1), (3.6, 4.4)


@dataclass(frozen=True)
class TermCase:
    """A question that has one term of a force left, or a shorter dt.

    Attributes:
        of: the number of the question it was made of.
        rows: the masses that are looked at; all where empty.
        term: what is left, or "" for a shorter dt.
    """

    of: int
    question: Question
    term: str = ""
    rows: tuple[int, ...] = ()


def cases(catalogue: AnswerCatalogue) -> list[TermCase]:
    """Those of all questions on strings and on one spring; of steps only where a slope follows on another."""
    made: list[TermCase] = []
    for i, question in enumerate(catalogue.questions):
        fields = question.arguments[-1] if question.arguments else None
        if isinstance(fields, Mapping) and "gravity" in fields and "stiffness" in fields and "members" not in fields:
            once = replace(question, steps=min(question.steps, 1))
            if "rest_lengths" in fields and "damping" not in fields:
                made += [TermCase(i, *case) for case in _on_a_string(once, fields)]
            elif "rest_length" in fields:
                made += [TermCase(i, *case) for case in _on_one_spring(once, fields)]
            if question.steps and _has_two_slopes(catalogue.exercise, question):
                made += [TermCase(i, _with_dt(once, part)) for part in SHORTER]
    return made


def _has_two_slopes(exercise: Exercise, question: Question) -> bool:
    """Whether the right step is another than Euler's."""
    scheme = inspect.signature(exercise.solutions[question.function]).parameters.get("scheme")
    return scheme is None or scheme.default != "euler"


def _with_fields(question: Question, **fields: Any) -> Question:
    return replace(question, arguments=(*question.arguments[:-1], {**question.arguments[-1], **fields}))


def _with_dt(question: Question, part: float) -> Question:
    x, v, dt, fields = question.arguments
    return replace(question, arguments=(x, v, part * dt, fields))


def _on_a_string(question: Question, fields: Mapping[str, Any]) -> Iterator[tuple[Question, str, tuple[int, ...]]]:
    """The weight, the drag, and each of two springs alone: as the one above its mass, and as the one below the next."""
    none = 0 * fields["stiffness"]
    yield _with_fields(question, stiffness=none, drag=0.0), "the weight", ()
    yield _with_fields(question, stiffness=none, gravity=0.0), "the drag", ()
    count = len(none)
    for spring in sorted({0, count - 1}):
        one = none.copy()
        one[spring] = fields["stiffness"][spring]
        alone = _with_fields(question, stiffness=one, drag=0.0, gravity=0.0)
        if spring == 0:
            yield alone, "the spring on the anchor", (0,)
        else:
            yield alone, "the spring above", (spring,)
            yield alone, "the spring below", (spring - 1,)


def _on_one_spring(question: Question, fields: Mapping[str, Any]) -> Iterator[tuple[Question, str, tuple[int, ...]]]:
    yield _with_fields(question, stiffness=0.0, damping=0.0), "the weight", ()
    yield _with_fields(question, gravity=0.0, damping=0.0), "the spring", ()
    if fields["damping"]:
        yield _with_fields(question, gravity=0.0, stiffness=0.0), "the damping", ()


def seen(
    catalogue: AnswerCatalogue,
    made: Sequence[TermCase],
    answers: Sequence[Mapping[str, Any]],
    source: str = "",
    named: bool = False,
) -> list[Finding]:
    """What the answers to the cases show.

    Args:
        source: the program's text.
        named: whether the mistake has a name, which says more than which slope is wrong.
    """
    exercise = catalogue.exercise
    rows = [
        (case, _numbers(exercise, case.question, answer), exercise.right_at_first(case.question))
        for case, answer in zip(made, answers, strict=True)
    ]
    of_terms = _of_terms([row for row in rows if row[0].term], source)
    return of_terms if named else [*of_terms, *_of_slopes([row for row in rows if not row[0].term])]


def _numbers(exercise: Exercise, question: Question, answer: Mapping[str, Any]) -> Parts | None:
    """What was answered at first, in the form of what is right; None where it has another form."""
    right = exercise.right_at_first(question)
    values: Parts = next(iter(answer["values"]), [])
    if len(values) != len(right):
        return None
    if any(v.size != r.size or v.dtype.kind not in "iuf" for v, r in zip(values, right, strict=True)):
        return None
    return [v.astype(float).reshape(r.shape) for v, r in zip(values, right, strict=True)]


#: A case, what was answered, and what is right.
_Row = tuple[TermCase, "Parts | None", Parts]


def _is_right(row: _Row) -> bool:
    """Whether what is looked at is right, each number beside the largest of its part."""
    case, given, right = row
    if given is None:
        return False
    for a, b in zip(given, right, strict=True):
        chosen = (list(case.rows), slice(None)) if case.rows and b.ndim == 2 else ()
        if not (np.abs(a - b)[chosen] <= SAME * np.abs(b).max(initial=0.0)).all():
            return False
    return True


def _of_terms(rows: Sequence[_Row], source: str) -> list[Finding]:
    """Terms that are right in all questions, and terms that are wrong in one; nothing where all are alike."""
    right: dict[str, bool] = {}
    for row in rows:
        right[row[0].term] = right.get(row[0].term, True) and _is_right(row)
    good, bad = ([term for term, ok in right.items() if ok is wanted] for wanted in (True, False))
    if not good or not bad:
        return []
    words = f"Asked for one term at a time, yours has {listed(good)} right, and {listed(bad)} wrong."
    lines = sorted({line for term in bad for name in MADE_OF.get(term, ()) for line in lines_with(source, name)})
    hint = f"Where in your text is {bad[0]}?"
    if not lines or len(lines) > MOST_LINES or not all(term in MADE_OF for term in bad):
        return [Finding("right_and_wrong_terms", words, hint)]
    words = f"{words} What is read for it stands in line{'s' * (len(lines) > 1)} {listed([str(n) for n in lines])}."
    return [Finding("right_and_wrong_terms", words, hint, lines=tuple(lines))]


def lines_with(source: str, field: str) -> list[int]:
    r"""Where a field of what is given is read, in Python or C; where it has got a name of its own, that name.

    >>> lines_with("double g = s->gravity;\nf[1] = -m * g;\nf[0] = 0;", "gravity")
    [2]
    """
    text = re.sub(r"//.*|#.*", "", source).split("\n")
    read = [i for i, line in enumerate(text, 1) if re.search(rf"(\.|->)\s*{field}\b", line)]
    if len(read) != 1:
        return read
    (only,) = read
    named = re.search(rf"\b(\w+)\s*=\s*\w+(\.|->){field}\s*[;,]?\s*$", text[only - 1])
    if named is None:
        return read
    own = named[1]
    return [i for i, line in enumerate(text, 1) if i not in read and re.search(rf"(?<![\w.]){own}\b", line)]


def _of_slopes(rows: Sequence[_Row]) -> list[Finding]:
    """Which slope is wrong: by what the error shrinks with half the dt, the same in all questions that show it."""
    shrinks = [_error(long) / _error(short) for long, short in zip(rows[::2], rows[1::2], strict=True) if _error(short)]
    if not shrinks:
        return []
    if all(OF_THE_SECOND[0] < by < OF_THE_SECOND[1] for by in shrinks):
        words = "For a short dt your step is nearly right: your first slope is right, the second is not."
        return [Finding("first_slope_right", words, "At which state is the second slope taken, and with which parts?")]
    if all(OF_THE_FIRST[0] < by < OF_THE_FIRST[1] for by in shrinks):
        words = "However short dt is your step is wrong: your first slope is wrong, or the weights of the slopes."
        return [Finding("first_slope_wrong", words, "Print the velocity and the acceleration at the beginning.")]
    return []


def _error(row: _Row) -> float:
    """How far an answer is from the right one; 0 where that is rounding, infinite where it cannot be compared."""
    _, given, right = row
    if given is None:
        return np.inf
    pairs = zip(given, right, strict=True)
    far = max(float(np.abs(a - b).max(initial=0.0)) / max(float(np.abs(b).max(initial=0.0)), 1e-300) for a, b in pairs)
    return far if far > ROUNDING else 0.0
