"""What is made of answers, by hand: a small exercise of two functions, and replies that no process has written."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import Answer, Exercise, Mistake, Question, mistake
from experiments.exercises.process.reply import Reply
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.judge import Verdict, _verdict_of_runs, verdict_on
from experiments.exercises.verdict.naming import SINGLE, Explanation, _in_single_precision


def step(x: Any, v: Any, dt: float, way: float = 1.0, pace: float = 1.0) -> tuple[Any, Any]:
    """Two masses that move on; the second part is one number."""
    return x + way * dt * v, 0.5 * v + 0 * pace if pace == 1.0 else pace * v


def energy(x: Any, half: float = 0.5) -> Any:
    """Of each mass."""
    return half * x**2


X = np.array([1.0, 3.0])
ASKED = [
    Question("step", (X, 2.5, 0.1), ("x", "v"), "three steps", 3),
    Question("energy", (X,), ("the energy",), "two masses"),
    Question("energy", (X[:1],), ("the energy",), "one mass"),
]

WAY = mistake("way", "It goes back.", "Which way?", way=-1.0)
PACE = Mistake("pace", "It keeps its pace.", "How fast?", {"pace": 1.5}, another=True)
HALF = mistake("half", "Half is missing.", "Of what?", half=1.0)


def exercise(**more: Any) -> Exercise:
    """The small one."""
    solutions = {"step": step, "energy": energy}
    return Exercise("", 0, "", solutions, lambda *_: ASKED, (WAY, PACE, HALF), **more)


def reply(answers: Sequence[Answer], names: Sequence[str] = ("step", "energy"), **beside: Any) -> Reply:
    """As it is read: each answer, and the same again."""
    told = [{"values": answer, "again": answer[0] if answer else [], **beside} for answer in answers]
    return Reply("done", answers=told, names=names)


def verdict(parameters: Mapping[str, float], change: Callable[[list[Answer]], None] | None = None) -> Verdict:
    """That on what the solution answers with these parameters, once it was changed."""
    catalogue = AnswerCatalogue(exercise(), ASKED)
    answers = deepcopy(catalogue.answers(parameters))
    if change:
        change(answers)
    return verdict_on(catalogue, reply(answers))


def test_mistakes_are_named_and_each_question_counts() -> None:
    """A scheme that is right in itself only where it is all there is."""
    right = verdict({})
    assert (right.outcome, right.findings, right.passed, right.error) == ("right", (), (True,) * 3, 0.0)
    one = verdict({"way": -1.0})
    assert (one.outcome, one.name, one.passed) == ("mistake", "way", (False, True, True))
    assert (one.findings[0].words, one.findings[0].hint) == (WAY.words, WAY.hint)
    assert verdict({"half": 1.0}).passed == (True, False, False)
    assert verdict({"way": -1.0, "half": 0.5 + 1e-6}).passed == (False, True, True)  # to single precision
    other = verdict({"pace": 1.5})
    assert (other.outcome, other.name) == ("another scheme", "pace")
    both = verdict({"pace": 1.5, "half": 1.0})
    assert (both.outcome, both.name, both.passed) == ("mistakes", "pace + half", (False,) * 3)
    catalogue = AnswerCatalogue(exercise(), ASKED)
    for flag, name in (("modified", "modifies_its_input"), ("overwritten", "overwrites_its_results")):
        beside = verdict_on(catalogue, reply(catalogue.right, **{flag: True}))
        assert (beside.outcome, beside.name, beside.passed) == ("mistake", name, (False,) * 3)


def test_what_has_another_form_is_told_or_not_readable() -> None:
    """More steps than were asked for, parts too many or no arrays, in one step only; a number may be an array of one.

    Fewer steps are an answer: it ended there.
    """

    def changed(step: int, part: int, value: Any) -> Callable[[list[Answer]], None]:
        def change(answers: list[Answer]) -> None:
            answers[0][step][part] = value

        return change

    assert verdict({}, lambda answers: answers[0].append(answers[0][0])).name == "unreadable"
    assert verdict({}, lambda answers: answers[0].clear()).name == "unreadable"
    assert verdict({}, lambda answers: answers[0][1].append(X)).name == "unreadable"
    assert verdict({}, changed(1, 1, 2.5)).name == "unreadable"
    assert verdict({}, changed(2, 0, [1.0, 2.0])).outcome == "crashed"
    assert verdict({}, lambda answers: answers[0].pop()).outcome == "not in the catalogue"
    assert verdict({}, changed(0, 1, np.array([1.25]))).right
    for value in (np.array([1.25, 1.25]), np.zeros(0)):
        assert verdict({}, changed(0, 1, value)).name == "wrong_shape"
    assert verdict({}, lambda answers: answers[2][0].__setitem__(0, np.array(0.5))).name == "wrong_shape"


def test_one_number_that_is_none_is_not_the_only_one_that_counts() -> None:
    """An answer with one among others is compared no further; what is wrong elsewhere is told too."""

    def spoil(answers: list[Answer]) -> None:
        answers[1][0][0][1] = np.nan

    alone = verdict({}, spoil)
    assert (alone.outcome, alone.name, alone.passed) == ("mistake", "not_a_number", (True, False, True))
    assert "either" not in alone.findings[0].words
    named = verdict({"way": -1.0}, spoil)
    assert (named.outcome, named.name) == ("mistakes", "not_a_number + way")
    assert (named.first_difference and named.first_difference.about) == "three steps"
    slightly = verdict({"half": 0.5 * (1 + 1e-6)}, spoil)
    assert "either" in slightly.findings[0].words


def test_functions_that_are_not_written_yet_are_told_beside_mistakes() -> None:
    """Of those that are written; the first one that is not there at all is told alone."""
    catalogue = AnswerCatalogue(exercise(), ASKED)
    wrong = verdict_on(catalogue, reply(catalogue.answers({"way": -1.0, "half": 7.0})), ["energy"])
    assert (wrong.outcome, wrong.name, wrong.passed) == ("mistakes", "not_written_yet + way", (False,) * 3)
    assert "energy is not written yet" in wrong.findings[0].words
    right = verdict_on(catalogue, reply(catalogue.answers({"half": 7.0})), ["energy"])
    assert (right.outcome, right.name) == ("mistake", "not_written_yet")
    nothing = verdict_on(catalogue, reply(catalogue.right, names=("other",)))
    assert (nothing.name, nothing.findings[0].words) == ("missing_function", "There is no function step.")


def test_what_is_asked_aside_tells_a_scheme_that_is_the_same_in_all_questions() -> None:
    """Only where it answers that as this scheme does, and not as the right one; and only of what is right."""
    same = mistake("keeps", "It keeps.", "Why?", half=0.25)
    asked = (Question("energy", (2 * X,), ("the energy",), ""), Question("energy", (X,), ("the energy",), ""))
    unlike = mistake("unlike", "It is not.", "", half=2.0)
    catalogue = AnswerCatalogue(exercise(aside=lambda _: asked, told_aside=(unlike, same)), ASKED)

    def told(half: float | None, own: Mapping[str, float] | None = None) -> Verdict:
        aside = [] if half is None else catalogue.aside.answers({"half": half})
        return verdict_on(catalogue, reply([*catalogue.answers(own or {}), *aside]))

    other = told(0.25)
    assert (other.outcome, other.name, other.passed) == ("another scheme", "keeps", (False,) * 3)
    assert (other.findings[0].words, other.findings[0].hint) == ("It keeps.", "Why?")
    assert all(told(half).right for half in (0.5, 0.3, None))
    assert told(0.25, {"way": -1.0}).name == "way"
    # a scheme that cannot be told from the right one is not told
    unclear = AnswerCatalogue(replace(catalogue.exercise, told_aside=(mistake("no", "", "", half=0.5),)), ASKED)
    assert verdict_on(unclear, reply([*unclear.right, *unclear.aside.right])).right


def test_what_answers_differently_again_is_run_once_more() -> None:
    """The same in both runs: it remembers; another in one question of one run: chance. More parts are no less."""
    catalogue = AnswerCatalogue(exercise(), ASKED)
    runs: list[Reply] = []

    def judged(*answers: Sequence[Answer]) -> str:
        runs[:] = [reply(each) for each in answers]
        for run in runs:
            run.answers[1]["again"] = [np.array([9.0, 9.0])]  # type: ignore[index]
        return _verdict_of_runs(catalogue, lambda: runs.pop(0)).name

    other = deepcopy(catalogue.right)
    other[1][0][0][0] = 7.0
    assert judged(catalogue.right, catalogue.right) == "remembers_earlier_calls"
    assert judged(catalogue.right, other) == "random_or_time"
    assert judged(catalogue.right, catalogue.right[:2]) == "random_or_time"
    more = reply(catalogue.right)
    more.answers[1]["again"] = [*more.answers[1]["again"], X]  # type: ignore[index]
    assert verdict_on(catalogue, more).name == "not_repeatable"


@pytest.mark.parametrize(
    ("distances", "named"),
    [
        ([1e-6], True),
        ([SINGLE, 1.0], True),
        ([2 * SINGLE, 1.0], False),
        ([1e-6, 2.9e-5, 1.0], False),
        ([1e-6, 3.1e-5, 1.0], True),
    ],
)
def test_single_precision_is_a_name_only_where_no_other_is_near(distances: list[float], named: bool) -> None:
    """2e-5 at most, and the next thirty times as far."""
    assert _in_single_precision([Explanation((), distance) for distance in distances], 1e-9) == named


def test_of_mistakes_that_answer_the_same_the_first_is_told() -> None:
    """However many there are, and whatever else is in the catalogue."""
    twins = [mistake(name, "", "", half=1.0) for name in ("one", "two")]
    catalogue = AnswerCatalogue(replace(exercise(), mistakes=(HALF, *twins, WAY)), ASKED)
    answers = deepcopy(catalogue.answers({"half": 1.0}))
    answers[1][0][0] *= 1 + 1e-12
    assert verdict_on(catalogue, reply(answers)).name == "half"
    assert not catalogue.all_differ()
    assert AnswerCatalogue(exercise(), ASKED).all_differ()


def test_all_first_steps_count() -> None:
    """Of each question; what comes later does not."""
    catalogue = AnswerCatalogue(exercise(), ASKED)
    answers = deepcopy(catalogue.answers({"way": -1.0}))
    assert catalogue.begins_with(answers, {"way": -1.0}, 1e-9)
    answers[0][1][0] += 1.0
    assert catalogue.begins_with(answers, {"way": -1.0}, 1e-9)
    for i in range(3):
        changed = deepcopy(answers)
        changed[i][0][0] += 1.0
        assert not catalogue.begins_with(changed, {"way": -1.0}, 1e-9)
