"""A closer look at a wrong submission: how it behaves in special cases, and which small changes of it make it right.

Both are looked for in one more process of the sandbox. Nothing is told that was not seen: answers that are right where
one thing is changed in the questions; a program that is right in all questions of two checks, with one or two places
changed in its text. The student is told the line and the kind of the change, the teacher the change.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from experiments.exercises.behaviour import derived_step, parts, special_cases, terms
from experiments.exercises.c.changes import MOST, CChanges
from experiments.exercises.c.compiler import DoesNotCompileError, MissingFunctionError, compiled
from experiments.exercises.c.text import whole_divisions
from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.handed_in.parsing import PARSING, parsed
from experiments.exercises.handed_in.submission import Language
from experiments.exercises.process import sandbox
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.repair.repaired import Repair, repairs
from experiments.exercises.repair.source_edits import edits_of, without_main
from experiments.exercises.repair.source_search import fields_given
from experiments.exercises.verdict import findings
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.judge import Verdict

#: The key of the second check that a changed program has to pass.
SECOND = "a closer look"

#: Answers of a changed program are right to this part of their scale.
TOLERANCE = 1e-7

#: The same where students may round: a limit of 0.01 s to six digits.
TYPED = 2e-4

#: Seconds of computing beside the search, in C: a change that ends in none costs no more than these.
BESIDE = 4

#: How many lines a student is told at most.
MOST_PLACES = 3

#: Outcomes, and findings, of which no change of the text is looked for.
NOT_SEARCHED = ("right", "another scheme", "timed out", "crashed")
NOT_FOR = ("not_written_yet", "syntax", "missing_module", "missing_function", "reaches_out", "random_or_time")


@dataclass(frozen=True)
class Effort:
    """How long is searched, of processor time [s]: single changes, and pairs of them.

    Where the mistake has a name already no pairs are tried, and single changes for this share of the time. In C so many
    changes are compiled.
    """

    singles: float = 1.2
    pairs: float = 0.7
    named: float = 1.0
    compiled: int = MOST


@dataclass(frozen=True)
class CloserLook:
    """What was seen.

    Attributes:
        findings: of its behaviour.
        repairs: cheapest first. tried: how many changes were.
        complete: whether all were tried that were to be; else the time was used up.
    """

    findings: tuple[Finding, ...] = ()
    repairs: tuple[Repair, ...] = ()
    tried: int = 0
    complete: bool = True

    @property
    def lines(self) -> list[int]:
        """The lines that are told, likeliest first: those of changes, then those from which what is wrong comes."""
        changed = [line for repair in self.told for line, _ in repair.places]
        return list(dict.fromkeys([*changed, *(line for finding in self.findings for line in finding.lines)]))

    @property
    def told(self) -> tuple[Repair, ...]:
        """One repair for each place, of each function the cheapest few."""
        told: dict[tuple[str, tuple[int, ...]], Repair] = {}
        for repair in self.repairs:
            told.setdefault((repair.function, tuple(line for line, _ in repair.places)), repair)
        by_function: dict[str, list[Repair]] = {}
        for repair in told.values():
            by_function.setdefault(repair.function, []).append(repair)
        return tuple(repair for group in by_function.values() for repair in group[:MOST_PLACES])


def look_closer(
    exercise: Exercise,
    source: str,
    seed: str,
    verdict: Verdict,
    limits: sandbox.Limits | None = None,
    effort: Effort | None = None,
    language: Language = "python",
) -> CloserLook:
    """Look at a submission that is not right."""
    if verdict.outcome in NOT_SEARCHED or any(f.name in NOT_FOR for f in verdict.findings) or not exercise.searched:
        return CloserLook()
    effort = effort or Effort()
    if _is_named(verdict):
        effort = replace(effort, singles=effort.named * effort.singles, pairs=0.0)
    if language == "c":
        return _look_closer_at_c(exercise, source, seed, verdict, limits, effort)
    looks = _Looks(exercise, catalogue_of(exercise, seed, None), verdict)
    groups = _groups(exercise, seed, verdict)
    task = _task(exercise, groups, effort)
    files = exercise.files(seed) if exercise.files else {}
    try:
        reply = sandbox.run(source, looks.asked(), limits, files, task)
    except NotGradedError:
        return CloserLook(complete=False)
    if reply.ended != "done" or reply.error is not None:
        return CloserLook(complete=False)
    seen = looks.seen(reply.answers, source, "python")
    with PARSING:
        made = [r for group, found in zip(groups, reply.search, strict=False) for r in _repairs(source, group, found)]
    return CloserLook(tuple(seen), tuple(made), *_searched(reply.search, groups))


def _task(exercise: Exercise, groups: Sequence[Sequence[Question]], effort: Effort) -> dict[str, Any]:
    """What is searched, and for how long."""
    return {
        "groups": [[_told(exercise, q) for q in group] for group in groups],
        "seconds": effort.singles,
        "pair_seconds": effort.pairs,
    }


def _searched(found: Sequence[Mapping[str, Any]], groups: Sequence[Sequence[Question]]) -> tuple[int, bool]:
    """How many changes were tried, and whether that is all."""
    done = [one["singles_done"] and (bool(one["repairs"]) or one["pairs_done"]) for one in found]
    return sum(one["tried"] for one in found), all(done) and len(done) == len(groups)


def _look_closer_at_c(
    exercise: Exercise, source: str, seed: str, verdict: Verdict, limits: sandbox.Limits | None, effort: Effort
) -> CloserLook:
    """The same of a program in C, and what its compiler warns of."""
    if any(f.name in ("does_not_compile", "missing_function") for f in verdict.findings):
        return CloserLook()
    exposed = limits is not None and limits.exposed
    looks = _Looks(exercise, catalogue_of(exercise, seed, None), verdict)
    groups = _groups(exercise, seed, verdict)
    try:
        made = compiled(exercise.number, source, exposed)
        warned = tuple(findings.of_warning(line, words) for line, words in made.warnings)
        warned += tuple(findings.of_whole_division(line, words) for line, words in whole_divisions(source))
        changes = CChanges.of(exercise.number, source, groups, exposed, effort.compiled)
        reply = None
        if changes is not None:
            task = _task(exercise, groups, effort) | changes.task()
            short = replace(limits or sandbox.Limits(), seconds=int(effort.singles + effort.pairs) + BESIDE)
            reply = sandbox.run(source, looks.asked(), short, {}, task, made, exercise.number, changes.library)
        if reply is None or reply.ended != "done" or reply.error is not None:  # a change may end the process
            reply = sandbox.run(source, looks.asked(), limits, compiled=made, exercise=exercise.number)
    except (NotGradedError, DoesNotCompileError, MissingFunctionError):
        return CloserLook(complete=False)
    if reply.ended != "done" or reply.error is not None:
        return CloserLook(warned, complete=False)
    seen = (*warned, *looks.seen(reply.answers, source, "c"))
    if changes is None:
        return CloserLook(seen)
    with PARSING:
        repaired = [r for found in reply.search for r in changes.repairs(found["repairs"])]
    return CloserLook(seen, tuple(repaired), *_searched(reply.search, groups))


def _is_named(verdict: Verdict) -> bool:
    """Whether the mistake has a name; that there is no number in some answers says little of why."""
    return verdict.outcome in ("mistake", "mistakes") and verdict.name != "not_a_number"


class _Looks:
    """What is asked to see how a program behaves; nothing beside the public check of one that raises an error."""

    def __init__(self, exercise: Exercise, catalogue: AnswerCatalogue, verdict: Verdict) -> None:
        runs = verdict.outcome != "error"
        self._catalogue, self._runs = catalogue, runs
        self._line = next((f.line for f in verdict.findings if f.line is not None), None)
        self._named = _is_named(verdict)
        self._cases = special_cases.cases(catalogue) if runs else []
        self._terms = terms.cases(catalogue) if runs else []
        self._swinging = derived_step.questions(exercise, catalogue.questions) if runs else []

    def asked(self) -> list[dict[str, Any]]:
        """All questions."""
        cases = [*(case.question for case in self._cases), *(case.question for case in self._terms)]
        return [question.asked() for question in [*self._catalogue.questions, *cases, *self._swinging]]

    def seen(self, answers: Sequence[Mapping[str, Any]], source: str, language: Language) -> list[Finding]:
        """What the answers show."""
        if not self._runs:
            return parts.of_an_error(source, self._line) if language == "python" else []
        rest = list(answers)
        own, cases, of_terms, swinging = (
            [rest.pop(0) for _ in part]
            for part in (self._catalogue.questions, self._cases, self._terms, self._swinging)
        )
        found = special_cases.seen(self._catalogue, self._cases, [*own, *cases]) if self._cases else []
        found += terms.seen(self._catalogue, self._terms, of_terms, source, self._named)
        found += parts.seen(self._catalogue, own, source, language)
        return found + derived_step.seen(self._catalogue.exercise, self._swinging, swinging)


def _groups(exercise: Exercise, seed: str, verdict: Verdict) -> list[list[Question]]:
    """The questions of each function that has a wrong answer, of the public check and of another one."""
    public = catalogue_of(exercise, seed, None).questions
    checks = [public] if exercise.seeded else [public, catalogue_of(exercise, seed, SECOND).questions]
    wrong = {q.function for q, passed in zip(public, verdict.passed, strict=False) if not passed}
    names = [name for name in exercise.solutions if name in wrong] or list(exercise.solutions)
    return [[q for check in checks for q in check if q.function == name] for name in names]


def _told(exercise: Exercise, question: Question) -> dict[str, Any]:
    """A question with its right answer, for the search."""
    plain = Exercise("", 0, "", exercise.solutions, exercise.questions, ())
    right = plain.answer(question, {})
    scales = [max(float(np.abs(step[p]).max(initial=0.0)) for step in right) or 1.0 for p in range(len(question.parts))]
    unordered = exercise.canonical is not None
    tolerance = TOLERANCE if exercise.tolerance <= TOLERANCE else TYPED
    return {**question.asked(), "right": right, "scales": scales, "tolerance": tolerance, "pairs": unordered}


def _repairs(source: str, group: Sequence[Question], found: Mapping[str, Any]) -> list[Repair]:
    """What was found for a group of questions."""
    if not found["repairs"]:
        return []
    tree = without_main(parsed(source))
    edits = edits_of(tree, fields_given([question.asked() for question in group]))
    return repairs(group[0].function, edits, found["repairs"], lambda: ast.unparse(ast.fix_missing_locations(tree)))
