"""The verdict on a submission: which scheme, or which mistake, its numbers are those of; or where they depart.

As in `reference.identification`, a name is given only to what reproduces every number to rounding: the right solution
first, then each mistake of the catalogue, then every two that can be made at once. What is found otherwise (an input
that was written to, a call that answers differently the second time) is found by looking, and told beside it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from experiments.exercises import sandbox
from experiments.exercises.answer_catalogue import Catalogue, answer_distance, catalogue
from experiments.exercises.exercise import Answer, Exercise
from experiments.exercises.faults import Finding, beside, fault_of_error, fault_of_values, not_repeated
from experiments.exercises.first_difference import Departure, Lines, first_departure
from experiments.exercises.naming import SINGLE, fault_of_form, identify, told_by_the_exercise

#: What a verdict says in a word.
Outcome = Literal[
    "right", "another scheme", "mistake", "mistakes", "not in the catalogue", "error", "timed out", "crashed"
]


@dataclass(frozen=True)
class Verdict:
    """What was found of a submission.

    Attributes:
        findings: what it is or what is wrong, the plainest first; empty where it is right.
        passed: for each question, whether its answer is right.
        error: how far its numbers are from those that it is named for, as a part of the largest; None without a name.
        right_error: how far from the right ones; None where there are no numbers.
        lines: for a plot of where they part.
        walls: which stood around its process.
    """

    outcome: Outcome
    findings: tuple[Finding, ...]
    passed: tuple[bool, ...]
    error: float | None = None
    right_error: float | None = None
    departure: Departure | None = None
    lines: Lines | None = None
    walls: tuple[str, ...] = ()

    @property
    def right(self) -> bool:
        """Whether nothing is wrong."""
        return self.outcome == "right"

    @property
    def name(self) -> str:
        """The findings' names, or the outcome."""
        return " + ".join(f.name for f in self.findings) or self.outcome


def judge(
    exercise: Exercise, source: str, seed: str = "", key: str | None = None, limits: sandbox.Limits | None = None
) -> Verdict:
    """Run a submission and say what it is.

    Args:
        source: its text.
        seed: the student's.
        key: for the hidden check, the teacher's secret; the public check without.
    """
    return judge_all(exercise, source, seed, [key], limits)[0]


def judge_all(
    exercise: Exercise, source: str, seed: str, keys: Sequence[str | None], limits: sandbox.Limits | None = None
) -> list[Verdict]:
    """The verdicts of several checks, of one run: starting a process is most of what a check takes.

    Where the run comes to a bad end, each check gets a run of its own, so that none pays for another.
    """
    checks = [catalogue(exercise, seed, key) for key in keys]
    if _text(source) == _text(exercise.starter):
        words = Finding("not_written_yet", "This is the starter as it was handed out.", "The text says what to write.")
        return [_failed(known, "error", words) for known in checks]
    asked = [question.asked() for known in checks for question in known.questions]
    files = exercise.files(seed) if exercise.files else {}
    reply = sandbox.run(source, asked, limits, files)
    if len(reply.answers) != len(asked) and reply.error is None and len(checks) > 1:
        return [judge(exercise, source, seed, key, limits) for key in keys]
    verdicts, first = [], 0
    for known in checks:
        part = slice(first, first + len(known.questions))
        verdict = _verdict(known, replace(reply, answers=reply.answers[part]))
        if verdict.name == "not_repeatable":
            again = sandbox.run(source, asked, limits, files)
            same = len(again.answers) == len(reply.answers) and _equal(reply, again)
            verdict = replace(verdict, findings=(not_repeated(same),))
        verdicts.append(replace(verdict, walls=tuple(reply.walls)))
        first = part.stop
    return verdicts


def _text(source: str) -> list[str]:
    """The words of a text, without the lines that say whose it is."""
    return [word for line in source.splitlines() if not line.startswith(("SEED", "KEYED")) for word in line.split()]


def _failed(known: Catalogue, outcome: Outcome, finding: Finding, **found: Any) -> Verdict:
    return Verdict(outcome, (finding,), (False,) * len(known.questions), **found)


def _verdict(known: Catalogue, reply: sandbox.Reply) -> Verdict:
    if reply.ended != "done":
        word: Outcome = "timed out" if reply.ended == "timed out" else "crashed"
        return _failed(known, word, Finding(word.replace(" ", "_"), f"It was stopped: {reply.reason}."))
    try:
        missing = [q.function for q in known.questions if q.function not in reply.names]
        if missing and not reply.error:
            return _failed(known, "error", fault_of_error(None, missing[0]))
        error = reply.error or next((a["error"] for a in reply.answers if a.get("error")), None)
        if error:
            return _failed(known, "error", fault_of_error(error, None))
        given = _values(known, reply)
    except (TypeError, AttributeError, ValueError, IndexError, KeyError):
        given = None  # the submission wrote what it was not asked for
    if given is None:
        return _failed(known, "crashed", Finding("unreadable", "What it answered is not readable."))
    departure, lines = first_departure(known, given, max(known.exercise.tolerance, 1e-9))
    found: dict[str, Any] = {"departure": departure, "lines": lines}
    if not all(_same(a["values"][0], a.get("again")) for a in reply.answers):
        return _failed(known, "mistake", Finding("not_repeatable", ""), **found)
    found["right_error"] = known.distance(given, known.right)
    passed = tuple(
        answer_distance(answer, right, scales) <= max(SINGLE, known.exercise.tolerance)
        for answer, right, scales in zip(given, known.right, known.scales, strict=True)
    )
    fault = fault_of_values(known.questions, given, known.right) or told_by_the_exercise(known, given)
    if fault is not None:
        return Verdict("mistake", (fault,), passed, **found)
    return _named(known, given, reply, passed, found)


def _named(
    known: Catalogue, given: list[Answer], reply: sandbox.Reply, passed: tuple[bool, ...], found: Mapping[str, Any]
) -> Verdict:
    """The verdict on numbers of the right shapes."""
    also = beside(reply.answers)
    mistakes, error = identify(known, given)
    if mistakes is None and (plain := fault_of_form(known, given)) is not None:
        return Verdict("mistake", (plain, *also), passed, **found)
    if mistakes is None:
        return Verdict("not in the catalogue", also, passed, **found)
    findings = (*(Finding(m.name, m.words, m.hint) for m in mistakes), *also)
    if not findings:
        return Verdict("right", (), (True,) * len(passed), error, error)
    if not mistakes:
        passed = (False,) * len(passed)
    another = len(findings) == 1 and bool(mistakes) and mistakes[0].another
    outcome: Outcome = "another scheme" if another else "mistakes" if len(findings) > 1 else "mistake"
    return Verdict(outcome, findings, passed, error, **found)


def _values(known: Catalogue, reply: sandbox.Reply) -> list[Answer] | None:
    """What was answered, in the form in which answers are compared, if it is as many arrays as was asked for."""
    given: list[Answer] = []
    for question, told in zip(known.questions, reply.answers, strict=True):
        steps = told["values"]
        if not 1 <= len(steps) <= max(1, question.steps) or any(len(step) != len(question.parts) for step in steps):
            return None
        if not all(isinstance(part, np.ndarray) for step in steps for part in step):
            return None
        given.append(known.exercise.plain(question, [list(step) for step in steps]))
    for answer, right in zip(given, known.right, strict=True):
        for step, want in zip(answer, right, strict=False):
            # a number, and an array of one number, are one as good as the other
            step[:] = [p.reshape(()) if w.shape == () and p.size == 1 else p for p, w in zip(step, want, strict=True)]
    return given


def _same(one: Any, other: Any) -> bool:
    if not isinstance(other, list) or len(one) != len(other):
        return False
    return all(a.shape == b.shape and a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))


def _equal(one: sandbox.Reply, other: sandbox.Reply) -> bool:
    answers = zip(one.answers, other.answers, strict=True)
    pairs = [pair for a, b in answers for pair in zip(a["values"], b["values"], strict=False)]
    return all(_same(a, b) for a, b in pairs)
