"""A name for numbers: the mistakes that give just these; or what is to be seen of them without arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice, permutations

import numpy as np

from experiments.exercises.answer_catalogue import Catalogue, answer_distance
from experiments.exercises.exercise import Answer, Mistake
from experiments.exercises.faults import Finding

#: Numbers in single precision are the same up to SINGLE, if nothing else is less than APART times as far.
SINGLE, APART = 2e-5, 30.0

#: Mistakes, and how far the numbers are from theirs.
Identified = tuple[tuple[Mistake, ...] | None, float]


def identify(known: Catalogue, given: Sequence[Answer]) -> Identified:
    """The mistakes whose numbers these are, none where they are right, None where nobody knows; and how far from them.

    The simplest that fits: no mistake, one, two; then as many in each function by itself.
    """
    mistakes, error = _simplest(known, given)
    if mistakes is not None or len(known.functions) < 2:
        return mistakes, error
    answers = list(zip(known.questions, given, strict=True))
    found = [_simplest(part, [a for q, a in answers if q.function == name]) for name, part in known.functions.items()]
    if any(those is None for those, _ in found):
        return None, error
    unlike = {mistake.name: mistake for those, _ in found for mistake in those or ()}
    return tuple(unlike.values()), max(far for _, far in found)


def _simplest(known: Catalogue, given: Sequence[Answer]) -> Identified:
    tolerance, rough = known.exercise.tolerance, max(SINGLE, known.exercise.tolerance)
    right = known.distance(given, known.right)
    if right <= tolerance:
        return (), right
    errors = [known.distance(given, known.answers(m.knobs)) for m in known.exercise.mistakes]
    ranking = sorted(range(len(errors)), key=lambda i: errors[i])
    nearest = errors[ranking[0]] if ranking else np.inf
    if nearest <= tolerance:
        return (known.exercise.mistakes[ranking[0]],), nearest
    if right <= rough and nearest > APART * right:
        return (), right
    second = min([right, *(errors[i] for i in ranking[1:2])])
    if nearest <= rough and second > APART * nearest:
        return (known.exercise.mistakes[ranking[0]],), nearest
    for pair in known.pairs:
        knobs = {**pair[0].knobs, **pair[1].knobs}
        if known.distance(given, known.beginnings(knobs), first_steps=True) <= tolerance:
            error = known.distance(given, known.answers(knobs))
            if error <= tolerance:
                return pair, error
    return None, right


def told_by_the_exercise(known: Catalogue, given: Sequence[Answer]) -> Finding | None:
    """What an exercise itself says of answers that no solution with a mistake gives."""
    if known.exercise.fault is None:
        return None
    faults = (known.exercise.fault(q, answer[0][0]) for q, answer in zip(known.questions, given, strict=True))
    return next((Finding(*words) for words in faults if words), None)


def fault_of_form(known: Catalogue, given: Sequence[Answer]) -> Finding | None:
    """Right numbers, in another order than was asked for: v before x."""
    rows = list(zip(known.questions, given, known.right, known.scales, strict=True))
    several = [row for row in rows if len(row[0].parts) > 1]
    alone = max((answer_distance(a, r, s) for q, a, r, s in rows if len(q.parts) == 1), default=0.0)
    if not several or alone > known.exercise.tolerance:
        return None
    question = several[0][0]
    for order in islice(permutations(range(len(question.parts))), 1, None):
        # the first step only: what is asked next is made of what was answered
        apart = [answer_distance([[a[0][i] for i in order]], r[:1], s) for q, a, r, s in several]
        if max(apart) <= known.exercise.tolerance:
            return Finding(
                "results_in_another_order",
                "Your results are right, but not in the order that was asked for.",
                f"What is to be returned are {', '.join(question.parts)}. Which comes first?",
            )
    return None
