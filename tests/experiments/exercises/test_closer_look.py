"""What else is seen of wrong programs: how they behave, and which small change of their own text makes them right."""

from __future__ import annotations

import ast
import doctest
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.behaviour import parts, terms
from experiments.exercises.c import text as c_text
from experiments.exercises.closer_look import SECOND, CloserLook, Effort, _groups, _told, look_closer
from experiments.exercises.exercise import find
from experiments.exercises.grading import Grade, grade, row_of
from experiments.exercises.handed_in import collected
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.repair import program, source_edits
from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.source_edits import edits_of, without_main
from experiments.exercises.repair.source_search import fields_given
from experiments.exercises.teaching.words import paragraphs
from experiments.exercises.verdict.judge import judge
from tests.experiments.exercises.corpus import solution
from tests.experiments.exercises.mutants import mutants

MODELS = Path(__file__).parent / "models"

#: Enough for every change of these programs, whatever the machine.
PATIENT = Effort(60.0, 0.0)


def model(number: int) -> str:
    """A model solution."""
    return next(MODELS.glob(f"e{number:02}_*.py")).read_text(encoding="utf-8")


def looked(number: int, text: str, effort: Effort = PATIENT) -> CloserLook:
    """What is seen of a wrong program."""
    verdict = judge(find(str(number)), text, "example")
    assert not verdict.right
    return look_closer(find(str(number)), text, "example", verdict, effort=effort)


def changed(number: int, old: str, new: str) -> tuple[int, str]:
    """A model solution with other words: the line, and the text."""
    text = model(number)
    assert text.count(old) == 1
    return text[: text.index(old)].count("\n") + 1, text.replace(old, new)


@pytest.mark.rotating(5)
@pytest.mark.parametrize(
    ("number", "old", "new", "family"),
    [
        (1, "v + dt * force", "v - dt * force", "sign"),
        (2, "(y1 + y2) / 2", "(y1 + y2) / 3", "factor"),
        (3, "pull[1:]", "pull[:-1]", "index"),
        (3, "string.stiffness[:, None]", "string.masses[:, None]", "name"),
        (3, "axis=1", "axis=0", "axis"),
        (4, "x + dt * v, v + dt * a", "v + dt * a, x + dt * v", "order"),
        (7, "< circle.radius", "> circle.radius", "condition"),
        (3, "(length - string.rest_lengths[:, None])", "np.abs(length - string.rest_lengths[:, None])", "too much"),
        (3, " - string.drag * v", "", "left out"),
        (3, "gap = np.vstack([string.anchor,", "x -= string.anchor\n    gap = np.vstack([0 * string.anchor,", "copy"),
    ],
)
def test_one_slip_is_led_to_its_line_and_kind(trusted: None, number: int, old: str, new: str, family: str) -> None:
    """A model solution with one thing wrong: the line is among those that are told, with the kind of the change."""
    line, text = changed(number, old, new)
    told = looked(number, text).told
    assert (line, family) in {place for repair in told for place in repair.places}


@pytest.mark.rotating(7, in_turn=True)
def test_two_slips_are_both_found(trusted: None) -> None:
    """Neither change alone makes it right."""
    text = model(3).replace("axis=1", "axis=0").replace("- string.drag", "+ string.drag")
    told = looked(3, text, Effort(60.0, 60.0)).told
    assert told
    assert all(len(repair.places) == 2 for repair in told)
    assert {family for _, family in told[0].places} == {"axis", "sign"}


def sampled(full: bool) -> list[tuple[int, str]]:
    """Mutants of model solutions, one change each: one of a few exercises, or a quarter of all."""
    chosen = []
    for number in (1, 2, 3, 4, 5, 6, 7, 9, 10) if full else (1, 2, 3, 7):
        texts = [text for _, text in mutants(model(number)) if f"EXERCISE = {number}\n" in text]
        chosen += [
            (number, text) for text in (texts[number % 4 :: 4] if full else texts[len(texts) // 2 :: len(texts)])
        ]
    return chosen


@pytest.mark.rotating(7, in_turn=True)
def test_mutants_fail_and_what_is_told_of_them_was_tried(trusted: None, request: pytest.FixtureRequest) -> None:
    """Each repair that is told makes the program right, in the public check and in a hidden one it was not tried on.

    Most are led to the line that was changed; the others are told no line, or one where a change mends them too.
    """
    wrong = led = 0
    for number, text in sampled(request.config.option.full):
        exercise = find(str(number))
        if all(judge(exercise, text, "example", key).right for key in (None, "k")):
            continue  # the change makes no difference
        verdict = judge(exercise, text, "example")
        closer = look_closer(exercise, text, "example", verdict, effort=Effort(2.0, 0.0))
        lines, before = text.splitlines(), ast.unparse(ast.parse(model(number))).splitlines()
        own = {i + 1 for i, (a, b) in enumerate(zip(lines, before, strict=False)) if a != b}
        wrong, led = wrong + 1, led + bool(own & set(closer.lines))
        if closer.told and len({r.function for r in closer.told}) == 1:
            mended = mended_by(number, text, closer)
            assert all(judge(exercise, mended, "example", key).right for key in (None, "k")), (number, closer.told[0])
    assert led >= (0.9 if request.config.option.full else 0.5) * wrong


def mended_by(number: int, text: str, closer: CloserLook) -> str:
    """The text with the first repair that is told."""
    exercise = find(str(number))
    verdict = judge(exercise, text, "example")
    (group,) = (g for g in _groups(exercise, "example", verdict) if g[0].function == closer.told[0].function)
    tree = without_main(ast.parse(text))
    for edit in edits_of(tree, fields_given([question.asked() for question in group])):
        if ((edit.line, edit.family),) == closer.told[0].places and edit.cost == closer.told[0].cost:
            with edit.applied():
                mended = ast.unparse(ast.fix_missing_locations(tree))
            if judge(exercise, mended, "example").right:
                return mended
    raise AssertionError(closer.told[0])


def test_a_right_change_of_one_check_has_to_hold_in_another() -> None:
    """What is searched on are two checks: a number typed in that fits one does not fit the other."""
    verdict = judge(find("3"), model(3).replace("9.81", "9.81"), "")
    groups = _groups(find("3"), "", verdict)
    assert [len({q.about for q in group}) > 4 for group in groups] == [True]
    assert SECOND
    assert {"right", "scales", "tolerance"} <= set(_told(find("3"), groups[0][0]))


def names_of(found: CloserLook) -> list[str]:
    """What was seen of its behaviour."""
    return [finding.name for finding in found.findings]


def test_behaviour_is_told_as_it_was_seen(trusted: None) -> None:
    """A factor of a thousand; a field that changes nothing; what is right where nothing is dragged; always the same."""
    quick = Effort(0.0, 0.0)
    assert "constant_factor" in names_of(looked(3, model(3).replace("return total", "return 1000 * total"), quick))
    ignored = looked(3, model(3).replace("string.masses *", "0.05 *"), quick)
    assert "not_used" in names_of(ignored)
    assert "masses" in ignored.findings[0].words
    dragged = looked(3, model(3).replace("- string.drag * v", "- string.drag * v**3"), quick)
    assert names_of(dragged)[0] == "right_where"
    assert names_of(looked(3, model(3).replace("return total", "return 0 * total"), quick)) == ["always_the_same"]


@pytest.mark.rotating(4, in_turn=True)
def test_terms_and_slopes_are_told_apart(trusted: None) -> None:
    """One term of a force at a time; and an error of dt^2 or of dt, as the second slope is wrong or the first."""
    quick = Effort(0.0, 0.0)

    def words(number: int, old: str, new: str, name: str) -> str:
        found = looked(number, model(number).replace(old, new), quick).findings
        return next((f.words for f in found if f.name == name), "")

    terms = words(3, "total[:-1] -= pull[1:]", "total[:-1] -= 0.9 * pull[1:]", "right_and_wrong_terms")
    assert terms.index("the spring above") < terms.index(" right") < terms.index("the spring below")
    assert "the drag wrong" in words(3, "- string.drag * v", "- 2 * string.drag * v", "right_and_wrong_terms")
    first = "a = acceleration(1.01 * x, v, string)"
    halved = "guess_x, guess_v = x + 0.9 * dt * v, v + 0.9 * dt * a"
    assert words(4, "guess_x, guess_v = x + dt * v, v + dt * a", halved, "first_slope_right")
    assert words(4, "a = acceleration(x, v, string)", first, "first_slope_wrong")


def test_which_part_is_wrong_is_told_with_the_lines_it_comes_from(trusted: None) -> None:
    """Of two things that are returned one is right; the other is assigned on a line that is told."""
    text = solution("loops", 2)
    line = text[: text.index("dt * (k1v + k2v) / 2")].count("\n") + 1
    found = looked(2, text.replace("dt * (k1v + k2v) / 2", "dt * (k1v + k2v) / 3"), Effort(0.0, 0.0))
    (told,) = (f for f in found.findings if f.name == "right_and_wrong_parts")
    assert line in told.lines


def test_the_part_of_another_function_is_followed(trusted: None) -> None:
    """What is returned is what another function returns: its lines are told."""
    text = solution("loops", 2).replace("dt * (k1v + k2v) / 2", "dt * (k1v + k2v) / 3").replace("def step", "def own")
    text = text.split("if __name__")[0] + "def step(y, v, dt, spring):\n    return own(y, v, dt, spring)\n"
    found = looked(2, text, Effort(0.0, 0.0))
    (told,) = (f for f in found.findings if f.name == "right_and_wrong_parts")
    assert text[: text.index("/ 3")].count("\n") + 1 in told.lines


def test_a_wrong_term_is_told_with_the_lines_that_read_it(trusted: None) -> None:
    """The weight is wrong, and gravity stands on one line; where the drag is wrong another one is told."""
    for old, new in (("string.masses *", "0.9 * string.masses *"), ("- string.drag * v", "- string.drag * v**2")):
        line, text = changed(3, old, new)
        found = looked(3, text, Effort(0.0, 0.0)).findings
        assert [f.lines for f in found if f.name == "right_and_wrong_terms"] == [(line,)]


def test_a_cap_is_told_as_a_cap(trusted: None) -> None:
    """Without time nothing is tried, and that is not told as nothing found."""
    line, text = changed(3, "axis=1", "axis=0")
    none, all_ = looked(3, text, Effort(0.0, 0.0)), looked(3, text)
    assert (none.complete, none.repairs) == (False, ())
    assert line in all_.lines


def test_what_was_tried_in_vain_is_told_where_nothing_has_a_name(trusted: None) -> None:
    """Neither of an error nor of a mistake with a name: there it would say nothing more."""
    for old, new, outcome in (
        ("return total", "total", "error"),
        ("- string.drag * v", "", "mistake"),
        ("- string.drag * v", "- string.drag * v - 0.3 * x", "not in the catalogue"),
    ):
        text = changed(3, old, new)[1]
        verdict = judge(find("3"), text, "example")
        assert verdict.outcome == outcome
        said = paragraphs(Submission("own.py", text, find("3")), Grade(verdict, None, 0.0, CloserLook(tried=7)))
        told = [line for line in said if line.startswith("7 small changes of your text were tried")]
        assert len(told) == (outcome == "not in the catalogue")


def test_students_are_told_the_place_and_teachers_the_change() -> None:
    """In the sandbox: the words have the line and the kind, and not what to write; the table has it, with a key."""
    line, text = changed(3, "- string.rest_lengths", "+ string.rest_lengths")
    submission = Submission("own.py", text, find("3"))
    given: Grade = grade(submission, None)
    assert line in given.closer.lines
    said = "\n".join(paragraphs(submission, given))
    assert f"line {line}" in said
    change = given.closer.told[0].change
    assert change not in said
    assert row_of(submission, given, None)["change"] == ""
    assert change[:100] in row_of(submission, given, "k")["change"]


def test_right_programs_are_not_looked_at(trusted: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither are those that only chose another scheme."""
    looked_at: list[Any] = []
    monkeypatch.setattr("experiments.exercises.grading.look_closer", lambda *a: looked_at.append(a) or CloserLook())
    assert grade(Submission("own.py", solution("loops", 3), find("3")), "k").closer == CloserLook()
    assert looked_at == []


@pytest.mark.parametrize(
    "module",
    [source_edits, program, parts, terms, c_text, collected],
    ids=lambda m: ".".join(m.__name__.split(".")[-2:]),
)
def test_the_worked_examples_are_true(module: Any) -> None:
    """What the docstrings show is what comes out."""
    assert doctest.testmod(module).failed == 0


@pytest.mark.rotating(7, in_turn=True)
def test_a_tree_is_what_it_was_after_every_change() -> None:
    """Each change is taken back, so that thousands can be tried on one tree; each has a line of the text."""
    tree = ast.parse(solution("loops", 3))
    before = ast.dump(tree, include_attributes=True)
    edits: Sequence[Edit] = edits_of(tree)
    assert len(edits) > 500
    for edit in edits:
        with edit.applied():
            compile(tree, "own", "exec")  # every node has its line
        assert 1 <= edit.line <= before.count("lineno")
    assert ast.dump(tree, include_attributes=True) == before
