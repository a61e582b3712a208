"""The pieces of a closer look: what is searched and for how long, which lines are told, what is said of a bad end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest

from experiments.exercises import closer_look
from experiments.exercises.c.compiler import Compiled, DoesNotCompileError
from experiments.exercises.closer_look import (
    BESIDE,
    SECOND,
    CloserLook,
    Effort,
    _groups,
    _is_named,
    _Looks,
    _searched,
    _told,
    look_closer,
)
from experiments.exercises.exercise import find
from experiments.exercises.process import sandbox
from experiments.exercises.process.reply import Reply
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.repair.repaired import Repair
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.judge import Outcome, Verdict


def verdict(outcome: Outcome = "not in the catalogue", *names: str, passed: Sequence[bool] = (False,)) -> Verdict:
    """One with findings of these names."""
    return Verdict(outcome, tuple(Finding(name, "") for name in names), tuple(passed))


def found(tried: int = 5, singles: bool = True, pairs: bool = True, repairs: bool = False) -> Mapping[str, Any]:
    """What a search leaves of one group."""
    return {"tried": tried, "singles_done": singles, "pairs_done": pairs, "repairs": [[1]] if repairs else []}


@pytest.mark.parametrize(
    ("groups", "count", "said"),
    [
        ([found()], 1, (5, True)),
        ([found(), found(7)], 2, (12, True)),
        ([found()], 2, (5, False)),
        ([], 0, (0, True)),
        ([found(singles=False)], 1, (5, False)),
        ([found(pairs=False)], 1, (5, False)),
        ([found(pairs=False, repairs=True)], 1, (5, True)),
        ([found(singles=False, repairs=True)], 1, (5, False)),
        ([found(), found(pairs=False)], 2, (10, False)),
    ],
)
def test_whether_all_was_tried(groups: list[Mapping[str, Any]], count: int, said: tuple[int, bool]) -> None:
    """All single changes of every group; and all pairs, unless a single one does it."""
    assert _searched(groups, [()] * count) == said


def repair(function: str, *lines: int, family: str = "sign") -> Repair:
    """A change on these lines."""
    return Repair(function, tuple((line, family) for line in lines), "", 1.0)


def test_of_each_function_the_cheapest_places_are_told() -> None:
    """Three at most, one for each place, of which the first counts; their lines first, then those of findings."""
    first, again = repair("step", 4), repair("step", 4, family="index")
    others = [repair("step", n) for n in (7, 2, 9)]
    energy = repair("energy", 20, 21)
    behaviour = Finding("right_and_wrong_parts", "", lines=(7, 30))
    closer = CloserLook((behaviour,), (first, again, *others, energy))
    assert closer.told == (first, others[0], others[1], energy)
    assert closer.lines == [4, 7, 2, 20, 21, 30]


@pytest.mark.parametrize("outcome", ["right", "another scheme", "timed out", "crashed"])
def test_what_is_not_searched(outcome: Outcome, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is right, or comes to no end; what is not written yet, cannot be read, or reaches out; names of engines."""
    monkeypatch.setattr(sandbox, "run", lambda *_: pytest.fail("it is run"))
    assert look_closer(find("1"), "", "", verdict(outcome)) == CloserLook()
    for name in ("not_written_yet", "syntax", "missing_module", "missing_function", "reaches_out", "random_or_time"):
        assert look_closer(find("1"), "", "", verdict("error", "other", name)) == CloserLook()
    assert look_closer(find("which_engine"), "", "", verdict()) == CloserLook()


@pytest.mark.parametrize(
    "reply", [Reply("timed out"), Reply("crashed"), Reply("done", error={"type": "E", "words": "w", "line": 1}), None]
)
def test_a_bad_end_is_not_told_as_nothing_found(reply: Reply | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """It says that not all was tried."""

    def run(*_: object) -> Reply:
        if reply is None:
            raise NotGradedError("no sandbox")
        return reply

    monkeypatch.setattr(sandbox, "run", run)
    assert look_closer(find("1"), "a = 1", "", verdict()) == CloserLook(complete=False)


@pytest.mark.parametrize(
    ("seen", "singles", "pairs"),
    [
        (verdict(), 8.0, 3.0),
        (verdict("error", "index_error"), 8.0, 3.0),
        (verdict("mistake", "not_a_number"), 8.0, 3.0),
        (verdict("mistake", "gravity_sign"), 4.0, 0.0),
        (verdict("mistakes", "a", "b"), 4.0, 0.0),
    ],
)
def test_how_long_is_searched(seen: Verdict, singles: float, pairs: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the mistake has a name for a share of the time, and no pairs; limits are handed on."""
    tasks: list[Any] = []
    monkeypatch.setattr(sandbox, "run", lambda *given: tasks.append(given) or Reply("crashed"))
    limits = sandbox.Limits()
    look_closer(find("1"), "a = 1", "", seen, limits, Effort(singles=8.0, pairs=3.0, named=0.5))
    ((source, asked, given, files, task),) = tasks
    assert (source, given, files) == ("a = 1", limits, {})
    assert (task["seconds"], task["pair_seconds"]) == (singles, pairs)
    assert _is_named(seen) == (pairs == 0.0)
    public = len(catalogue_of(find("1"), "", None).questions)
    # of an error nothing is asked beside the public check
    assert len(asked) == public if seen.outcome == "error" else len(asked) > 3 * public
    assert len(task["groups"]) == 1
    assert len(task["groups"][0]) > public


def test_wrong_functions_are_searched_in_two_checks() -> None:
    """Where everybody has numbers of their own in one; where none is known to be wrong all are."""
    energy = find("energy")
    asked = [q.function for q in catalogue_of(energy, "", None).questions]
    wrong = _groups(energy, "", verdict(passed=[name != "power" for name in asked]))
    assert [{q.function for q in group} for group in wrong] == [{"power"}]
    second = [q.function for q in catalogue_of(energy, "", SECOND).questions]
    assert len(wrong[0]) == asked.count("power") + second.count("power")
    both = _groups(energy, "", verdict(passed=[False] * len(asked)))
    assert [group[0].function for group in both] == ["energy", "power"]
    assert len(_groups(energy, "", verdict(passed=[True] * len(asked)))) == 2
    seeded = _groups(find("largest_step"), "ada", verdict(passed=[False] * 4))
    assert [len(group) for group in seeded] == [1, 1, 1, 1]


def test_a_question_is_searched_with_its_right_answer() -> None:
    """Its largest number in any step, or 1; to a tolerance that is typed in where numbers are; pairs in any order."""
    question = catalogue_of(find("euler"), "", None).questions[0]
    told = _told(find("euler"), question)
    right = find("euler").answer(question, {})
    assert (len(told["right"]), told["steps"]) == (20, 20)
    assert told["scales"] == [max(abs(float(step[p])) for step in right) for p in (0, 1)]
    assert (told["tolerance"], told["pairs"]) == (1e-7, False)
    limit = _told(find("largest_step"), catalogue_of(find("largest_step"), "ada", None).questions[0])
    assert (limit["tolerance"], limit["pairs"]) == (2e-4, False)
    cloth = catalogue_of(find("cloth"), "", None).questions
    assert _told(find("cloth"), cloth[0])["pairs"]
    (single,) = [q for q in cloth if q.arguments == (1, 1)]
    assert _told(find("cloth"), single)["scales"] == [1.0]
    assert np.asarray(_told(find("cloth"), cloth[0])["right"][0][0]).shape[1] == 2


@pytest.mark.parametrize("name", ["forces", "heun", "energy"])
def test_of_right_answers_to_all_that_is_asked_nothing_is_told(name: str) -> None:
    """Each of the four looks is given its own answers; of an error only the line that raised it is looked at."""
    exercise = find(name)
    catalogue = catalogue_of(exercise, "", None)
    looks = _Looks(exercise, catalogue, verdict())
    asked = [*catalogue.questions, *(c.question for c in [*looks._cases, *looks._terms]), *looks._swinging]
    assert len(looks.asked()) == len(asked)
    assert [q["function"] for q in looks.asked()] == [q.function for q in asked]
    answers = [{"values": exercise.answer(question, {})} for question in asked]
    assert looks.seen(answers, "", "python") == []
    failed = _Looks(exercise, catalogue, Verdict("error", (Finding("index_error", "", line=3),), ()))
    assert len(failed.asked()) == len(catalogue.questions)
    source = "def f(a):\n    c = a\n    return c[9]\n"
    assert [finding.lines for finding in failed.seen([], source, "python")] == [(2,)]
    assert failed.seen([], source, "c") == []


def test_what_is_seen_and_what_is_found_are_two_things(monkeypatch: pytest.MonkeyPatch) -> None:
    """Behaviour is told as findings, changes as repairs; a whole division by its line."""
    exercise = find("forces")
    catalogue = catalogue_of(exercise, "", None)
    looks = _Looks(exercise, catalogue, verdict())
    asked = [*catalogue.questions, *(c.question for c in [*looks._cases, *looks._terms]), *looks._swinging]
    half = [{"values": [[0.5 * part for part in exercise.answer(question, {})[0]]]} for question in asked]
    search = [found(repairs=True)]
    monkeypatch.setattr(sandbox, "run", lambda *_: Reply("done", answers=half, search=search))
    monkeypatch.setattr(closer_look, "_repairs", lambda source, group, one: [repair(group[0].function, 7)])
    closer = look_closer(exercise, "a = 1", "", verdict())
    assert "constant_factor" in [finding.name for finding in closer.findings]
    assert (closer.repairs, closer.tried, closer.complete) == ((repair("forces", 7),), 5, True)


def test_without_a_word_of_it_the_search_takes_its_usual_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """As `Effort` has it."""
    tasks: list[Any] = []
    monkeypatch.setattr(sandbox, "run", lambda *given: tasks.append(given[-1]) or Reply("crashed"))
    look_closer(find("1"), "a = 1", "", verdict())
    assert (tasks[0]["seconds"], tasks[0]["pair_seconds"]) == (Effort().singles, Effort().pairs)


class Changes:
    """In place of a C program with all its changes."""

    library = Compiled(b"changes", (), ())

    def task(self) -> dict[str, Any]:
        """What the search is told."""
        return {"changes": [], "places": 1}

    def repairs(self, found: Sequence[Any]) -> list[Repair]:
        """One for each number."""
        return [repair("step", *numbers) for numbers in found]


@pytest.mark.parametrize("readable", [False, True])
@pytest.mark.parametrize("first", [Reply("crashed"), Reply("done", error={"type": "E"}), Reply("done")])
def test_a_program_in_c_is_run_without_its_changes_where_these_end_it(
    readable: bool, first: Reply, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Or where it is not read; what its compiler warns of is told whatever comes."""
    made = Compiled(b"own", (), ((3, "unused"),))
    monkeypatch.setattr(closer_look, "compiled", lambda *_: made)
    monkeypatch.setattr(closer_look.CChanges, "of", lambda *_: Changes() if readable else None)
    runs: list[Mapping[str, Any]] = []
    exercise = find("1")
    public = catalogue_of(exercise, "", None)
    looks = _Looks(exercise, public, verdict())
    asked = [*public.questions, *(c.question for c in [*looks._cases, *looks._terms]), *looks._swinging]
    right = [{"values": exercise.answer(q, {})} for q in asked]
    search = [{"tried": 4, "singles_done": True, "pairs_done": True, "repairs": [[7]]}]

    def run(source: str, questions: Any, limits: Any, *given: Any, **named: Any) -> Reply:
        runs.append({"given": given, **named, "limits": limits})
        if given:
            return first if first.ended != "done" or first.error else Reply("done", answers=right, search=search)
        return Reply("done", answers=right)

    monkeypatch.setattr(sandbox, "run", run)
    closer = look_closer(exercise, "x = 1 / 2;", "", verdict(), None, Effort(2.0, 1.0), "c")
    assert [finding.name for finding in closer.findings] == ["compiler_warns", "whole_division"]
    assert [finding.lines for finding in closer.findings] == [(3,), (1,)]
    with_changes = readable and first.ended == "done" and not first.error
    assert len(runs) == (1 if with_changes or not readable else 2)
    assert [r.places for r in closer.repairs] == ([((7, "sign"),)] if with_changes else [])
    assert closer.tried == (4 if with_changes else 0)
    assert closer.complete == (with_changes or not readable)
    if readable:
        _, task, compiled, number, variants = runs[0]["given"]
        assert (compiled, number, variants) == (made, 1, Changes.library)
        assert (task["seconds"], task["places"], runs[0]["limits"].seconds) == (2.0, 1, 3 + BESIDE)
    if not with_changes:
        assert (runs[-1]["compiled"], runs[-1]["exercise"], runs[-1]["limits"]) == (made, 1, None)


def test_what_does_not_compile_or_end_in_c_is_not_told_as_nothing_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is known of it stays."""
    warned = Compiled(b"own", (), ((3, "unused"),))
    monkeypatch.setattr(closer_look, "compiled", lambda *_: warned)
    monkeypatch.setattr(closer_look.CChanges, "of", lambda *_: None)
    monkeypatch.setattr(sandbox, "run", lambda *_, **__: Reply("crashed"))
    closer = look_closer(find("1"), "", "", verdict(), language="c")
    assert ([finding.name for finding in closer.findings], closer.complete) == (["compiler_warns"], False)

    def refused(*_: object) -> Compiled:
        raise DoesNotCompileError(1, "no")

    monkeypatch.setattr(closer_look, "compiled", refused)
    assert look_closer(find("1"), "", "", verdict(), language="c") == CloserLook(complete=False)
    for name in ("does_not_compile", "missing_function"):
        assert look_closer(find("1"), "", "", verdict("error", name), language="c") == CloserLook()
