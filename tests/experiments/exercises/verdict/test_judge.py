"""Verdicts without a process: what each question is worth, and what is told beside a name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import TOLERANCE, Answer, find
from experiments.exercises.grading import Grade, grade
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.process import child, sandbox
from experiments.exercises.process.sandbox import Reply
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.judge import Outcome, Verdict, judge
from experiments.exercises.verdict.naming import SINGLE
from tests.experiments.exercises import here as here_by_bytes
from tests.experiments.exercises.corpus import solution

#: A right step of exercise 1, and one of exercise 4 that ends in "return new_x, new_v".
STEP = """
def step(y, v, dt, s):
    a = (s.stiffness * (-s.rest_length - y) - s.damping * v) / s.mass - s.gravity
    return y + dt * v, v + dt * a
"""
STRING = solution("arrays", 4)

#: Forces whose loop gives the reaction of the spring on the anchor to F[-1], the last mass.
REACTION_TO_THE_LAST = """
import numpy as np
def forces(x, v, s):
    F = -s.drag * v
    F[:, 1] -= s.masses * s.gravity
    above = s.anchor
    for i in range(len(x)):
        gap = above - x[i]
        length = np.hypot(*gap)
        F[i] += s.stiffness[i] * (length - s.rest_lengths[i]) * gap / length
        F[i - 1] -= s.stiffness[i] * (length - s.rest_lengths[i]) * gap / length
        above = x[i]
    return F
"""

#: After it: the same, and then the input is changed.
CHANGES_ITS_INPUT = """
inner = step
def step(x, v, dt, string):
    results = inner(x, v, dt, string)
    x += 1
    return results
"""

#: In place of its end: all its results are one array.
KEPT = """
    kept = results.setdefault(len(x), np.zeros((2, len(x), 2)))
    kept[:] = new_x, new_v
    return kept
"""


def run_here(source: str, questions: Sequence[Mapping[str, Any]], *_: object) -> Reply:
    """What the sandbox gives, without a sandbox: for programs that can be trusted."""
    module = ModuleType("submission")
    exec(source, module.__dict__)
    answers = [child.ask(module, dict(question)) for question in questions]
    return Reply("done", "", answers, None, ["limits"], list(module.__dict__))


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Submissions run in this process."""
    monkeypatch.setattr(sandbox, "run", run_here)


def judged(monkeypatch: pytest.MonkeyPatch, exercise: str, change: Callable[[list[Answer]], None]) -> Verdict:
    """The verdict on right answers that were changed."""
    catalogue = catalogue_of(find(exercise), "", None)
    given = deepcopy(catalogue.right)
    change(given)
    answers = [{"values": answer, "again": answer[0]} for answer in given]
    names = [question.function for question in catalogue.questions]
    monkeypatch.setattr(sandbox, "run", lambda *_: Reply("done", "", answers, None, [], names))
    return judge(find(exercise), "")


def test_a_question_passes_to_single_precision(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of eight answers five are exact, one off by half of what single precision may lose, one by 1e-3, one is NaN.

    The tolerance of the exercise, 1e-9, is for names; a question passes to SINGLE.
    """

    def change(given: list[Answer]) -> None:
        given[1][0][0] = np.array(given[1][0][0] * (1 + SINGLE / 2))
        given[2][0][0] = np.array(given[2][0][0] * 1.001)
        given[3][0][0] = np.array(np.nan)

    verdict = judged(monkeypatch, "6", change)
    assert verdict.passed == (True, True, False, False, True, True, True, True)
    assert Grade(verdict, None, 0.0).score == 75.0


def test_a_number_may_be_an_array_of_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """In place of a number; not in place of an array of another shape."""

    def change(given: list[Answer]) -> None:
        given[0][0][0] = given[0][0][0].reshape(1)
        given[0][0][1] = given[0][0][1].reshape(1, 1)

    assert judged(monkeypatch, "6", change).right

    def flat(given: list[Answer]) -> None:
        given[3][0][0] = given[3][0][0].reshape(-1)

    assert judged(monkeypatch, "3", flat).name == "wrong_shape"


def test_what_begins_with_no_number_is_not_compared_further(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its first step counts: later ones are made of it. What is right besides is not said to be wrong."""

    def change(given: list[Answer]) -> None:
        given[0][0][0] = np.array(np.nan)

    verdict = judged(monkeypatch, "1", change)
    assert verdict.name == "not_a_number"
    assert "either" not in verdict.findings[0].words
    assert verdict.passed == (False, *[True] * (len(verdict.passed) - 1))


def test_what_is_right_to_single_precision_is_said_to_be(here: None) -> None:
    """A Heun in float32 is 1e-7 off or more, and beyond the 1e-9 that names are given to: it passes, and is told."""
    folder = Path(__file__).parents[1] / "students" / "e04_whole_state"
    single, double = (
        judge(find("4"), (folder / f"{name}.py").read_text(encoding="utf-8")) for name in ("single_precision", "arrays")
    )
    assert (single.outcome, single.name, all(single.passed)) == ("right", "fewer_digits", True)
    assert single.error is not None
    assert TOLERANCE < single.error < SINGLE
    assert (double.outcome, double.findings) == ("right", ())
    rounded = judge(find("1"), STEP.replace("y + dt * v, v + dt * a", "round(y + dt * v, 8), round(v + dt * a, 8)"))
    assert (rounded.outcome, rounded.name) == ("right", single.name)


def test_right_numbers_that_change_the_input_have_no_points(here: None) -> None:
    """The verdict is that mistake, and no question counts as passed."""
    verdict = judge(find("4"), STRING + CHANGES_ITS_INPUT)
    assert (verdict.outcome, verdict.name) == ("mistake", "modifies_its_input")
    assert verdict.error == verdict.right_error
    assert not any(verdict.passed)


@pytest.mark.parametrize(
    ("old", "new", "names", "outcome", "with_another"),
    [
        ("return new_x, new_v", "return new_v, new_x", ["results_in_another_order"], "mistake", "mistake"),
        ("return new_x, new_v", "return x + dt * v, v + dt * a", ["euler"], "another scheme", "mistakes"),
        ("- s.masses * s.gravity", "+ s.masses * s.gravity", ["gravity_sign"], "mistake", "mistakes"),
        ("- s.masses * s.gravity", "- 0.9 * s.masses", [], "not in the catalogue", "not in the catalogue"),
    ],
    ids=["order", "scheme", "mistake", "unknown"],
)
def test_a_changed_input_is_told_beside_whatever_else_there_is(
    here: None, old: str, new: str, names: list[str], outcome: Outcome, with_another: Outcome
) -> None:
    """Another scheme is right in itself only if nothing else is wrong; two names are mistakes."""
    text = STRING.replace(old, new)
    verdict = judge(find("4"), text)
    assert ([finding.name for finding in verdict.findings], verdict.outcome) == (names, outcome)
    verdict = judge(find("4"), text + CHANGES_ITS_INPUT)
    assert [finding.name for finding in verdict.findings] == [*names, "modifies_its_input"]
    assert verdict.outcome == with_another


def test_results_that_are_one_array_are_noticed(here: None) -> None:
    """What a call returned before is written over by the next; the same with a new array each time is right."""
    text = "results = {}\n" + STRING.replace("    return new_x, new_v", KEPT)
    assert judge(find("4"), text).name == "overwrites_its_results"
    assert judge(find("4"), text.replace("return kept", "return kept.copy()")).name == "right"


@pytest.mark.parametrize(
    ("memory", "name"),
    [("calls = []\n", "remembers_earlier_calls"), ("import time\n", "random_or_time")],
)
def test_a_call_that_answers_differently_the_second_time(here: None, memory: str, name: str) -> None:
    """By what it remembers of earlier calls, or by what no call decides: a second run tells which."""
    term = "len(calls)" if "calls" in memory else "(time.perf_counter_ns() % 1000003)"
    text = memory + STEP.replace("    return", "    calls.append(1)\n    return" if "calls" in memory else "    return")
    verdict = judge(find("1"), text.replace("- s.gravity", f"- s.gravity + {term}"))
    assert (verdict.outcome, verdict.name) == ("mistake", name)


def test_a_call_that_answers_differently_only_later(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that adds up dt and gives way after half a second; the questions come to less. A cache is no memory."""
    monkeypatch.setattr(sandbox, "run", here_by_bytes.run)
    tired = STEP.replace("    return", "    time.append(dt)\n    return").replace(
        "- s.gravity", "- s.gravity * (sum(time) < 0.5)"
    )
    assert judge(find("1"), "time = []\n" + tired).name == "remembers_earlier_calls"
    assert judge(find("1"), "time = []\n" + tired.replace(" * (sum(time) < 0.5)", "")).name == "right"


def test_a_crash_at_a_hidden_question_costs_the_hidden_check_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each check has a process of its own, so that the first cannot know what the second asks."""
    public = len(catalogue_of(find("1"), "", None).questions)

    def crashes_at_others(source: str, questions: Sequence[Mapping[str, Any]], *_: object) -> Reply:
        return run_here(source, questions) if len(questions) == public else Reply("crashed", "it ended")

    monkeypatch.setattr(sandbox, "run", crashes_at_others)
    given = grade(Submission("own.py", STEP, find("1")), "sesame")
    assert given.hidden is not None
    assert (given.public.outcome, given.hidden.outcome, given.score) == ("right", "crashed", 50.0)


def test_what_does_not_end_is_asked_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The hidden check of a program that comes to no end in the public one is not run, and has no points."""
    runs = []
    monkeypatch.setattr(sandbox, "run", lambda *_: runs.append(1) or Reply("timed out", "no answer within 20 s"))
    given = grade(Submission("own.py", STEP, find("1")), "sesame")
    assert given.hidden is not None
    assert (len(runs), given.public.outcome, given.hidden.outcome, given.score) == (1, "timed out", "timed out", 0.0)
    assert len(given.hidden.passed) == len(catalogue_of(find("1"), "", "sesame").questions)


def test_a_starter_with_another_seed_is_still_the_starter() -> None:
    """Nothing is written yet; and nothing is run."""
    exercise = find("8")
    text = exercise.starter.replace('SEED = "example"', 'SEED = "ada"\nKEYED = True')
    assert text != exercise.starter
    verdict = judge(exercise, text, "ada\0")
    assert (verdict.name, verdict.layers) == ("not_written_yet", ())


@pytest.mark.parametrize(
    ("public", "hidden", "score", "told"),
    [
        ((1, 1, 1, 1), None, 100.0, "public"),
        ((1, 0, 0, 0), None, 25.0, "public"),
        ((1, 1, 1, 1), (1, 0), 75.0, "hidden"),
        ((0, 0, 0, 0), (1, 1), 50.0, "public"),
        ((1, 1), (1, 1, 1, 1), 100.0, "hidden"),
    ],
)
def test_a_score_is_half_for_public_and_half_for_hidden_questions(
    public: tuple[int, ...], hidden: tuple[int, ...] | None, score: float, told: str
) -> None:
    """Whatever the number of each; what is told is the first check that was not passed, else the hidden one."""

    def verdict(passed: tuple[int, ...]) -> Verdict:
        return Verdict("right" if all(passed) else "not in the catalogue", (), tuple(map(bool, passed)))

    given = Grade(verdict(public), None if hidden is None else verdict(hidden), 1.0)
    assert given.score == score
    assert given.verdict is getattr(given, told)


def test_what_is_no_number_in_one_answer_hides_no_other_mistake(here: None) -> None:
    """Of one mass it makes NaN: that is told, and what is wrong elsewhere, by name and with a plot."""
    text = solution("arrays", 3)
    one = f"{text.split('if __name__')[0]}\ninner = forces\ndef forces(x, v, string):\n    f = inner(x, v, string)\n"
    end = "    return f * np.nan if len(x) == 1 else f\n"
    alone = judge(find("3"), one + end)
    assert (alone.name, alone.outcome) == ("not_a_number", "mistake")
    assert "either" not in alone.findings[0].words
    named = judge(find("3"), f"{one}    f = f + 2 * np.outer(string.masses, [0, string.gravity])\n{end}")
    assert (named.name, named.outcome) == ("not_a_number + gravity_sign", "mistakes")
    assert named.lines is not None
    assert np.isfinite(named.lines.given).all()
    unnamed = judge(find("3"), f"{one}    f = f * 1.5\n{end}")
    assert unnamed.name == "not_a_number"
    assert "either" in unnamed.findings[0].words


def test_what_the_last_mass_gets_is_told_as_it_is_however_it_came_there(here: None) -> None:
    """No spring of the last mass to the first is in this program: the reaction of the first spring lands on F[-1]."""
    verdict = judge(find("3"), REACTION_TO_THE_LAST)
    assert verdict.name == "last_link_wraps"
    assert "spring to the first" not in verdict.findings[0].words
    assert "the force of a spring that does not hold it" in verdict.findings[0].words


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("return y + dt * v", "raise IndexError('out of it')\n    return y + dt * v", "index_error"),
        ("return y + dt * v, v", "return 'up', v", "not_numbers"),
        ("def step(", "def other(", "missing_function"),
    ],
)
def test_what_raises_returns_words_or_is_missing_is_an_error(here: None, old: str, new: str, name: str) -> None:
    """Whichever of these it is, it is told, and no question counts as passed."""
    assert old in STEP
    verdict = judge(find("1"), STEP.replace(old, new))
    assert (verdict.outcome, verdict.name) == ("error", name)
    assert not any(verdict.passed)
