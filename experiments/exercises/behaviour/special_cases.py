"""How a wrong submission behaves: what its answers are beside the right ones, where they are right, what they ignore.

Each case is a question of the public check with one thing changed: no drag, equal masses, nothing moving. An answer
that is right in all such cases tells where the mistake is not; one that stays the same where the right one changes
tells what is not used. Nothing is searched and nothing guessed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, starmap
from typing import Any

import numpy as np

from experiments.exercises.exercise import Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.findings import Finding
from reference.state import Array

#: The arguments of a case, made of a question's, which stay as they are; None where there is no such case.
Change = Callable[[list[Any]], list[Any] | None]

#: What was answered to a question, or after the first of its steps.
Parts = Sequence[Array]

#: Numbers are the same up to this part of the largest.
SAME = 1e-9

#: Factors are, up to this part of them.
SAME_FACTOR = 1e-6

#: Factors that are told by name.
FACTORS = {
    2.0: "twice",
    0.5: "half",
    -1.0: "minus",
    4.0: "four times",
    0.25: "a quarter of",
    0.001: "a thousandth of",
    2 * np.pi: "2 pi times",
    1 / (2 * np.pi): "1 / (2 pi) times",
    np.pi / 180: "pi / 180 times",
    180 / np.pi: "180 / pi times",
}


@dataclass(frozen=True)
class Case:
    """A question with one thing changed.

    Attributes:
        of: the number of the question it was made of.
        where: what is so in it, as in "right where ...".
        ignored: the field that was changed, to see whether it matters.
    """

    of: int
    question: Question
    where: str = ""
    ignored: str = ""


def cases(catalogue: AnswerCatalogue) -> list[Case]:
    """All cases of all questions of the catalogue, one step of each."""
    made = []
    for i, question in enumerate(catalogue.questions):
        if not question.arguments:
            continue
        once = replace(question, steps=min(question.steps, 1))
        for where, change in WHERE.items():
            arguments = change(list(question.arguments))
            if arguments is not None:
                made.append(Case(i, replace(once, arguments=tuple(arguments)), where=where))
        fields = question.arguments[-1]
        if isinstance(fields, Mapping):
            for name, value in fields.items():
                if isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype.kind == "f"):
                    other = {**fields, name: 1.25 * value + 0.01}
                    arguments = [*question.arguments[:-1], other]
                    made.append(Case(i, replace(once, arguments=tuple(arguments)), ignored=name))
    return made


def seen(catalogue: AnswerCatalogue, made: Sequence[Case], answers: Sequence[Mapping[str, Any]]) -> list[Finding]:
    """What the answers show.

    Args:
        answers: those to the catalogue's questions, then those to the cases.
    """
    exercise, asked = catalogue.exercise, catalogue.questions
    own = [_answer(catalogue, q, a) for q, a in zip(asked, answers, strict=False)]
    steps = [exercise.right_at_first(question) for question in asked]
    wrong = [i for i, (a, r) in enumerate(zip(own, steps, strict=True)) if not _same(a, r)]
    found = _constant(own) or _factor(catalogue, own, steps)
    given = [_answer(catalogue, case.question, a) for case, a in zip(made, answers[len(asked) :], strict=True)]
    right = [exercise.right_at_first(case.question) for case in made]
    found += _ignored(made, own, given, steps, right)
    found += _right_where(made, wrong, given, right)
    return found


def _answer(catalogue: AnswerCatalogue, question: Question, answer: Mapping[str, Any]) -> Parts | None:
    """What was answered at first, comparable; None where nothing, or nothing of that form."""
    parts: Parts = next(iter(answer["values"]), [])
    if len(parts) != len(question.parts) or any(part.dtype.kind == "U" for part in parts):
        return None
    (comparable,) = catalogue.exercise.comparable(question, [list(parts)])
    return comparable


def _same(one: Parts | None, other: Parts | None) -> bool:
    """Whether two answers are the same to rounding, each number beside the largest of its part."""
    if one is None or other is None:
        return False
    for a, b in zip(one, other, strict=True):
        if a.shape != b.shape and not (a.size == b.size == 1):
            return False
        numbers, others = a.astype(float).ravel(), b.astype(float).ravel()
        with np.errstate(all="ignore"):
            if not (np.abs(numbers - others) <= SAME * np.abs(others).max(initial=0.0)).all():
                return False
    return True


def _constant(own: Sequence[Parts | None]) -> list[Finding]:
    """The same answer to every question."""
    answers = [answer for answer in own if answer is not None]
    shapes = {tuple(part.shape for part in answer) for answer in answers}
    zero = answers and all(not part.any() for answer in answers for part in answer)
    if zero or (len(answers) > 2 and len(shapes) == 1 and all(starmap(_same, pairwise(answers)))):
        words = "Your answer is the same whatever your function is given" + (": nothing but zeros." if zero else ".")
        return [Finding("always_the_same", words, "Which of the given numbers does it depend on?")]
    return []


def _factor(catalogue: AnswerCatalogue, own: Sequence[Parts | None], right: Sequence[Parts]) -> list[Finding]:
    """A part of the answer that is a constant times the right one, in all questions that have it."""
    ratios: dict[str, list[float]] = {}
    for question, answer, want in zip(catalogue.questions, own, right, strict=True):
        for p, name in enumerate(question.parts):
            if question.steps or answer is None or answer[p].shape != want[p].shape:
                ratios.setdefault(name, []).append(np.nan)
            else:
                ratios.setdefault(name, []).append(_ratio(answer[p], want[p]))
    found = []
    for name, numbers in ratios.items():
        ratio = float(np.mean(numbers))
        if len(numbers) > 1 and np.ptp(numbers) <= SAME_FACTOR * abs(ratio) and abs(ratio - 1) > SAME_FACTOR:
            named = (words for factor, words in FACTORS.items() if abs(ratio / factor - 1) <= SAME_FACTOR)
            told = next(named, f"{ratio:.6g} times")
            words = f"Everywhere {name} is {told} the right one."
            found.append(Finding("constant_factor", words, "From where could such a factor come? A unit, a half?"))
    return found


def _ratio(given: Array, want: Array) -> float:
    """By which number the one is a multiple of the other; NaN where it is none."""
    a, b = given.astype(float).ravel(), want.astype(float).ravel()
    with np.errstate(all="ignore"):
        ratio = float(a @ b / (b @ b)) if b.any() else np.nan
        return ratio if np.isfinite(ratio) and np.abs(a - ratio * b).max() <= SAME * np.abs(b).max() else np.nan


def _ignored(
    made: Sequence[Case],
    own: Sequence[Parts | None],
    given: Sequence[Parts | None],
    steps: Sequence[Parts],
    right: Sequence[Parts],
) -> list[Finding]:
    """Fields whose change changes nothing in the answers, where it should."""
    matters: dict[tuple[str, str], list[bool]] = {}
    for case, answer, want in zip(made, given, right, strict=True):
        if case.ignored and answer is not None and own[case.of] is not None and not _same(want, steps[case.of]):
            used = not _same(answer, own[case.of])
            matters.setdefault((case.question.function, case.ignored), []).append(used)
    ignored = [(function, name) for (function, name), used in matters.items() if not any(used)]
    if not ignored or len(ignored) > 3:
        return []
    names = " and ".join(f"{name} (in {function})" for function, name in ignored)
    words = f"Another value of {names} changes nothing in your answers, and should."
    return [Finding("not_used", words, "Where in your function is it read, and is that what you return?")]


def _right_where(
    made: Sequence[Case], wrong: Sequence[int], given: Sequence[Parts | None], right: Sequence[Parts]
) -> list[Finding]:
    """What has to be so for all answers to be right that are not."""
    holds: dict[str, list[bool]] = {}
    for case, answer, want in zip(made, given, right, strict=True):
        if case.where and case.of in wrong:
            holds.setdefault(case.where, []).append(_same(answer, want))
    told = [where for where, all_right in holds.items() if all(all_right)]
    if not told or len(told) == len(holds):
        return []
    words = f"Your first answers are all right where {', and where '.join(told[:3])}."
    return [Finding("right_where", words, "What of your function is left out of play there?")]


def _fields(**new: Any) -> Change:
    """The last argument with these fields, where it has them; functions make the new value of the old one."""

    def change(arguments: list[Any]) -> list[Any] | None:
        fields = arguments[-1]
        if not isinstance(fields, dict) or not all(name in fields for name in new):
            return None
        changed = {name: value(fields[name]) if callable(value) else value for name, value in new.items()}
        if all(np.array_equal(changed[name], fields[name]) for name in new):
            return None
        return [*arguments[:-1], {**fields, **changed}]

    return change


def _mean(value: Any) -> Any:
    return np.full_like(value, np.mean(value))


def _hung(lengths: Callable[[Array, Array], Array], straight: bool = False) -> Change:
    """A string whose springs have these lengths, of their lengths and rest lengths; straight down, or as they lead."""

    def change(arguments: list[Any]) -> list[Any] | None:
        x, string = arguments[0], arguments[-1]
        if not (isinstance(string, dict) and "rest_lengths" in string and "anchor" in string):
            return None
        separation = np.diff(x, axis=0, prepend=string["anchor"][None])
        length = np.linalg.norm(separation, axis=1)
        unit = np.array([[0.0, -1.0]] * len(x)) if straight else separation / length[:, None]
        new = lengths(length, string["rest_lengths"])
        return [string["anchor"] + np.cumsum(new[:, None] * unit, axis=0), *arguments[1:]]

    return change


def _one_mass(arguments: list[Any]) -> list[Any] | None:
    x, string = arguments[0], arguments[-1]
    if not (isinstance(string, dict) and "rest_lengths" in string and len(x) > 1):
        return None
    cut = {
        n: v[:1] if isinstance(v, np.ndarray) and len(v) == len(x) and n != "anchor" else v for n, v in string.items()
    }
    return [x[:1], arguments[1][:1], *arguments[2:-1], cut]


def _at_rest(arguments: list[Any]) -> list[Any] | None:
    x, v = (*arguments, None, None)[:2]
    if isinstance(v, np.ndarray) and np.shape(v) == np.shape(x):
        return [x, 0 * v, *arguments[2:]]
    return [x, 0.0, *arguments[2:]] if isinstance(v, float) and len(arguments) == 4 else None


def _anchor_at_origin(arguments: list[Any]) -> list[Any] | None:
    for name in ("anchor", "centre"):
        if isinstance(arguments[-1], dict) and name in arguments[-1]:
            origin = arguments[-1][name]
            return [arguments[0] - origin, *arguments[1:-1], {**arguments[-1], name: np.zeros_like(origin)}]
    return None


#: What is changed, by what is so then.
WHERE: Mapping[str, Change] = {
    "nothing is dragged": _fields(drag=0.0),
    "there is no damping": _fields(damping=lambda c: 0 * c),
    "there is no gravity": _fields(gravity=0.0),
    "gravity is 9.81 m/s^2": _fields(gravity=9.81),
    "nothing moves": _at_rest,
    "there is one mass": _one_mass,
    "all masses are equal": _fields(masses=_mean),
    "every mass is 1 kg": _fields(masses=np.ones_like),
    "the mass is 1 kg": _fields(mass=1.0),
    "all springs are alike": _fields(stiffness=_mean, rest_lengths=_mean),
    "the springs are as long as at rest": _hung(lambda length, rest: rest),
    "the springs are a little stretched": _hung(lambda length, rest: 1.3 * rest),
    "the springs are a little pressed": _hung(lambda length, rest: 0.8 * rest),
    "the string hangs straight down": _hung(lambda length, rest: length, straight=True),
    "rest lengths are 0": _fields(rest_lengths=np.zeros_like),
    "the anchor or the centre is at the origin": _anchor_at_origin,
    "the radius is 1 m": _fields(radius=1.0),
    "all members are equally stiff": _fields(stiffness=_mean, members=lambda m: m),
}
