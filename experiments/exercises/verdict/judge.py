"""The verdict on a submission: which scheme, or which mistakes, its numbers are those of; or where they first differ.

As in `reference.identification`, a name is given only to what reproduces every number to rounding (`naming`). What is
found in other ways (an error, an input that was changed, a call that answers differently the second time) comes from
`findings`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from experiments.exercises.c.compiler import DoesNotCompileError, MissingFunctionError, compiled
from experiments.exercises.c.text import told_by_overflow, unwritten_in_c
from experiments.exercises.exercise import Answer, Exercise, Mistake
from experiments.exercises.handed_in.submission import Language
from experiments.exercises.process import sandbox
from experiments.exercises.process.reply import Reply
from experiments.exercises.verdict import findings
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.first_difference import FirstDifference, Lines, first_difference
from experiments.exercises.verdict.naming import SINGLE, identify
from experiments.exercises.verdict.unwritten import unwritten
from reference.state import Array

#: What a verdict says in a word.
Outcome = Literal[
    "right", "another scheme", "mistake", "mistakes", "not in the catalogue", "error", "timed out", "crashed"
]


@dataclass(frozen=True)
class Verdict:
    """What was found of a submission.

    Attributes:
        findings: what it is or what is wrong, the plainest first; of what is right only that it is so
            to fewer digits than rounding leaves.
        passed: for each question, whether its answer is right.
        error: how far its numbers are from those that it is named for, as a fraction of the largest; None without a
            name.
        right_error: how far from the right ones; None where there are no numbers.
        first_difference: the first number that is not the right one.
        lines: for a plot of where they differ.
        remarks: what is worth a look although it passes.
        layers: of the sandbox, those that were active.
    """

    outcome: Outcome
    findings: tuple[Finding, ...]
    passed: tuple[bool, ...]
    error: float | None = None
    right_error: float | None = None
    first_difference: FirstDifference | None = None
    lines: Lines | None = None
    remarks: tuple[Finding, ...] = ()
    layers: tuple[str, ...] = ()

    @property
    def right(self) -> bool:
        """Whether nothing is wrong."""
        return self.outcome == "right"

    @property
    def name(self) -> str:
        """The findings' names, or the outcome."""
        return " + ".join(f.name for f in self.findings) or self.outcome


def judge(
    exercise: Exercise,
    source: str,
    seed: str = "",
    key: str | None = None,
    limits: sandbox.Limits | None = None,
    language: Language = "python",
) -> Verdict:
    """Run a submission and say what it is.

    Args:
        source: its text.
        seed: the student's.
        key: for the hidden check, the teacher's secret; the public check without.
        language: of the text.

    Raises:
        NotGradedError: where there is no answer and that is not the submission's fault.
    """
    catalogue = catalogue_of(exercise, seed, key)
    functions = [question.function for question in catalogue.questions]
    if language == "c":
        return _judge_c(catalogue, source, functions, limits)
    missing = unwritten(source, exercise.starter, functions)
    if len(missing) == len(set(functions)):
        return _failed(catalogue, "error", findings.not_written(missing))
    asked = [question.asked() for question in [*catalogue.questions, *catalogue.aside.questions]]
    files = exercise.files(seed) if exercise.files else {}
    return _verdict_of_runs(catalogue, lambda: sandbox.run(source, asked, limits, files), missing)


def _verdict_of_runs(catalogue: AnswerCatalogue, run: Callable[[], Reply], missing: Sequence[str] = ()) -> Verdict:
    """The verdict on what a run leaves; a second run tells what was remembered from what was chance."""
    reply = run()
    verdict = verdict_on(catalogue, reply, missing)
    if verdict.name == "not_repeatable":
        again = run()
        same = len(again.answers) == len(reply.answers) and _same_replies(reply, again)
        verdict = replace(verdict, findings=(findings.not_repeatable(same),))
    return replace(verdict, layers=tuple(reply.layers))


def _judge_c(
    catalogue: AnswerCatalogue, source: str, functions: Sequence[str], limits: sandbox.Limits | None
) -> Verdict:
    """Compile a submission and run it. Its catalogue is that of Python; what is asked aside is of C's own."""
    exercise, exposed = catalogue.exercise, limits is not None and limits.exposed
    missing = unwritten_in_c(source, functions)
    if missing:
        return _failed(catalogue, "error", findings.not_written(missing))
    try:
        made = compiled(exercise.number, source, exposed)
    except MissingFunctionError as error:
        return _failed(catalogue, "error", findings.missing_function(str(error)))
    except DoesNotCompileError as error:
        return _failed(catalogue, "error", findings.of_compiler(error.line, str(error), source))
    aside = list(exercise.aside_in_c())
    asked = [question.asked() for question in [*catalogue.questions, *aside]]
    later: list[Mapping[str, Any]] = []

    def run() -> Reply:
        reply = sandbox.run(source, asked, limits, compiled=made, exercise=exercise.number)
        later[:] = reply.answers[len(catalogue.questions) :]
        return replace(reply, answers=reply.answers[: len(catalogue.questions)])

    verdict = _verdict_of_runs(catalogue, run)
    other = told_by_overflow(exercise, aside, later) if verdict.right else None
    if other is not None:
        return _another(verdict, other)
    remarks = tuple(findings.of_warning(line, words) for line, words in made.warnings if verdict.right)
    told = tuple(findings.of_own_trap(findings.in_c(f), source) for f in verdict.findings)
    return replace(verdict, remarks=remarks, findings=told)


def not_asked(exercise: Exercise, seed: str, key: str | None, before: Verdict) -> Verdict:
    """The verdict on questions that were not put, as the process came to a bad end with others."""
    return replace(before, passed=(False,) * len(catalogue_of(exercise, seed, key).questions))


def _failed(catalogue: AnswerCatalogue, outcome: Outcome, finding: Finding, **found: Any) -> Verdict:
    return Verdict(outcome, (finding,), (False,) * len(catalogue.questions), **found)


def verdict_on(catalogue: AnswerCatalogue, reply: Reply, missing: Sequence[str] = ()) -> Verdict:
    """The verdict on what a process left, whatever that is.

    Args:
        reply: its answers are those to the catalogue's questions, then those to what is asked aside.
        missing: functions that are not written yet.
    """
    asked = len(catalogue.questions)
    reply, aside = replace(reply, answers=reply.answers[:asked]), reply.answers[asked:]
    if reply.ended != "done":
        word: Outcome = "timed out" if reply.ended == "timed out" else "crashed"
        return _failed(catalogue, word, findings.of_the_end(word, reply.reason))
    try:
        error = _error(catalogue, reply) or findings.of_words(catalogue, reply.answers)
        given = None if error else _comparable(catalogue, reply)
    except (TypeError, AttributeError, ValueError, IndexError, KeyError):
        error = given = None  # the submission wrote what it was not asked for
    if error is not None:
        return _failed(catalogue, "error", error)
    if given is None:
        return _failed(catalogue, "crashed", Finding("unreadable", "What it answered is not readable."))
    verdict = _verdict_on_answers(catalogue, reply, given, missing)
    other = _told_aside(catalogue.aside, aside) if verdict.right else None
    if other is None:
        return verdict
    return _another(verdict, other)


def _another(verdict: Verdict, other: Mistake) -> Verdict:
    """The verdict on what answers all rightly, and is another scheme."""
    found = Finding(other.name, other.words, other.hint)
    passed = (False,) * len(verdict.passed)
    return replace(verdict, outcome="another scheme", findings=(found,), passed=passed)


def _told_aside(aside: AnswerCatalogue, answers: Sequence[Mapping[str, Any]]) -> Mistake | None:
    """The scheme that what is asked aside tells, if it is another one."""
    try:
        given = _comparable(aside, Reply("done", answers=answers)) if answers else None
        fits = {m.name: m for m in aside.exercise.told_aside if given and _is_that(aside, given, m.parameters)}
    except (TypeError, AttributeError, ValueError, IndexError, KeyError):
        return None
    return None if not fits or (given and _is_that(aside, given, {})) else next(iter(fits.values()))


def _is_that(aside: AnswerCatalogue, given: Sequence[Answer], parameters: Mapping[str, Any]) -> bool:
    return aside.distance(given, aside.answers(parameters)) <= aside.exercise.tolerance


def _error(catalogue: AnswerCatalogue, reply: Reply) -> Finding | None:
    """A function that is missing, or the first exception."""
    missing = [q.function for q in catalogue.questions if q.function not in reply.names]
    if missing and not reply.error:
        return findings.missing_function(missing[0])
    error = reply.error or next((a["error"] for a in reply.answers if a.get("error")), None)
    return findings.of_error(error) if error else None


def _comparable(catalogue: AnswerCatalogue, reply: Reply) -> list[Answer] | None:
    """The answers in the form in which answers are compared; None unless they have as many steps as there are.

    Raises:
        ValueError: where a step has more or fewer parts.
    """
    given: list[Answer] = []
    for question, told in zip(catalogue.questions, reply.answers, strict=True):
        steps = told["values"]
        if not 1 <= len(steps) <= max(1, question.steps):
            return None
        given.append(catalogue.exercise.comparable(question, [list(step) for step in steps]))
    for answer, right in zip(given, catalogue.right, strict=True):
        for step, want in zip(answer, right, strict=False):
            # a number, and an array of one number, are one as good as the other
            step[:] = [p.reshape(()) if w.shape == () and p.size == 1 else p for p, w in zip(step, want, strict=True)]
    return given


def _verdict_on_answers(
    catalogue: AnswerCatalogue, reply: Reply, given: list[Answer], missing: Sequence[str]
) -> Verdict:
    """The verdict on answers that can be read: their form first, then their numbers."""
    tolerance = catalogue.exercise.tolerance
    different, lines = first_difference(catalogue, given, tolerance)
    found: dict[str, Any] = {"first_difference": different, "lines": lines}
    if not all(_same_arrays(a["values"][0], a["again"]) for a in reply.answers):
        return _failed(catalogue, "mistake", Finding("not_repeatable", ""), **found)
    distances = catalogue.distances(given, catalogue.right)
    found["right_error"] = max(distances)
    passed = tuple(distance <= max(SINGLE, tolerance) for distance in distances)
    finding = findings.of_form(catalogue.questions, given, catalogue.right)
    finding = finding or findings.of_the_exercise(catalogue, given)
    if missing:
        return _verdict_on_the_rest(catalogue, given, missing, passed, found)
    if finding is not None and finding.name == "not_a_number":
        return _verdict_where_finite(catalogue, given, finding, passed, found)
    if finding is not None:
        return Verdict("mistake", (finding,), passed, **found)
    return _verdict_on_numbers(catalogue, reply, given, passed, found)


def _verdict_on_the_rest(
    catalogue: AnswerCatalogue,
    given: list[Answer],
    missing: Sequence[str],
    passed: tuple[bool, ...],
    found: Mapping[str, Any],
) -> Verdict:
    """The verdict where some functions are not written yet: these are told, and the mistakes in the others."""
    rest, unwritten_yet = catalogue.without(missing), findings.not_written(missing)
    answers = [a for q, a in zip(catalogue.questions, given, strict=True) if q.function not in missing]
    explained = identify(rest, answers)
    named = [Finding(m.name, m.words, m.hint) for m in explained.mistakes] if explained else []
    return Verdict("mistakes" if named else "mistake", (unwritten_yet, *named), passed, **found)


def _verdict_where_finite(
    catalogue: AnswerCatalogue,
    given: list[Answer],
    finding: Finding,
    passed: tuple[bool, ...],
    found: Mapping[str, Any],
) -> Verdict:
    """The verdict where some answers are not finite: that is told, and what is wrong in those that are."""
    rows = zip(catalogue.questions, given, strict=True)
    finite = [(q, a) for q, a in rows if all(np.isfinite(part).all() for part in a[0] if part.dtype.kind == "f")]
    rest, answers = AnswerCatalogue(catalogue.exercise, [q for q, _ in finite]), [a for _, a in finite]
    different, lines = first_difference(rest, answers, catalogue.exercise.tolerance)
    if different is None:
        return Verdict("mistake", (finding,), passed, **found)
    explained = identify(rest, answers)
    named = [Finding(m.name, m.words, m.hint) for m in explained.mistakes] if explained else []
    if not named:
        finding = replace(
            finding, words=f"{finding.words} Where your answers are numbers they are not all right either."
        )
    found = {**found, "first_difference": different, "lines": lines}
    return Verdict("mistakes" if named else "mistake", (finding, *named), passed, **found)


def _verdict_on_numbers(
    catalogue: AnswerCatalogue,
    reply: Reply,
    given: list[Answer],
    passed: tuple[bool, ...],
    found: Mapping[str, Any],
) -> Verdict:
    """The verdict on numbers in the right form."""
    beside = findings.side_effects(reply.answers)
    explained = identify(catalogue, given)
    if explained is None:
        reordered = findings.of_order(catalogue, given)
        if reordered is not None:
            return Verdict("mistake", (reordered, *beside), passed, **found)
        return Verdict("not in the catalogue", beside, passed, **found)
    mistakes, error = explained.mistakes, explained.distance
    if not mistakes and not beside:
        beyond = (findings.fewer_digits(error),) if error > catalogue.exercise.tolerance else ()
        return Verdict("right", beyond, (True,) * len(passed), error, error)
    if not mistakes:
        passed = (False,) * len(passed)
    named = (*(Finding(m.name, m.words, m.hint) for m in mistakes), *beside)
    outcome: Outcome = (
        "mistakes" if len(named) > 1 else "another scheme" if any(m.another for m in mistakes) else "mistake"
    )
    return Verdict(outcome, named, passed, error, **found)


def _same_arrays(one: Sequence[Array], other: Sequence[Array]) -> bool:
    """Whether two lists of arrays are the same, bit by bit."""
    if len(one) != len(other):
        return False
    return all(a.shape == b.shape and a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))


def _same_replies(one: Reply, other: Reply) -> bool:
    answers = zip(one.answers, other.answers, strict=True)
    pairs = [pair for a, b in answers for pair in zip(a["values"], b["values"], strict=False)]
    return all(_same_arrays(a, b) for a, b in pairs)
