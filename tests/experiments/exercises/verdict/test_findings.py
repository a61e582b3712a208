"""What is said of errors, forms and side effects: in which words, with which hint and line."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.verdict import findings
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.findings import Finding

OUTSIDE = "your program reads or writes outside an array"


@pytest.mark.parametrize(
    ("kind", "words", "line", "name", "said"),
    [
        ("SyntaxError", "invalid syntax", 3, "syntax", "line 3: SyntaxError: invalid syntax."),
        ("IndentationError", "unexpected indent", 1, "syntax", "line 1: IndentationError: unexpected indent."),
        ("NotImplementedError", "", 4, "not_written_yet", "line 4: this is not written yet."),
        ("NotImplementedError", "", None, "not_written_yet", "this is not written yet."),
        ("SystemExit", "", None, "ends_the_program", "SystemExit."),
        ("KeyboardInterrupt", "", 2, "ends_the_program", "line 2: KeyboardInterrupt."),
        ("MemoryError", "", 5, "too_much_memory", "line 5: MemoryError."),
        ("RecursionError", "too deep", 5, "endless_recursion", "line 5: RecursionError: too deep."),
        ("PermissionError", "no", 6, "reaches_out", "line 6: PermissionError: no."),
        ("ModuleNotFoundError", "No module 'a'", 1, "missing_module", "line 1: ModuleNotFoundError: No module 'a'."),
        ("ImportError", "no b", 1, "missing_module", "line 1: ImportError: no b."),
        ("IndexError", "out of range", 7, "index_error", "line 7: IndexError: out of range."),
        ("ZeroDivisionError", "by zero", 7, "division_by_zero", "line 7: ZeroDivisionError: by zero."),
        ("ValueError", "bad", 7, "raises_an_error", "line 7: ValueError: bad."),
        ("ValueError", "bad: ", "7", "raises_an_error", "ValueError: bad."),
        ("FileNotFoundError", "No usable temporary directory in [..]", 2, "reaches_out", ""),
        ("FileNotFoundError", "no such file", 2, "raises_an_error", "line 2: FileNotFoundError: no such file."),
        ("OutsideArrayError", "SIGILL", 8, "outside_an_array", f"line 8: {OUTSIDE}."),
        ("OutsideArrayError", "SIGTRAP", None, "outside_an_array", f"{OUTSIDE}."),
        ("OutsideArrayError", "SIGSEGV", 8, "outside_an_array", ""),
        ("OutsideArrayError", "SIGBUS", 8, "outside_an_array", ""),
        ("FullStackError", "SIGSEGV", 9, "endless_recursion", ""),
        (
            "EndedBySignalError",
            "SIGFPE",
            9,
            "division_by_zero",
            "line 9: your program divides a whole number by zero.",
        ),
        ("EndedBySignalError", "SIGABRT", 9, "crashed", ""),
        (
            "OddAnswerError",
            "wrong_count: it returns 1 thing",
            3,
            "wrong_count",
            "Your function does not return what it should: it returns 1 thing.",
        ),
    ],
)
def test_an_error_is_told_by_its_name_and_line(kind: str, words: str, line: Any, name: str, said: str) -> None:
    """Python's, C's, and those of what was returned; what a program says of its line, if it is no number, is not."""
    found = findings.of_error({"type": kind, "words": words, "line": line})
    assert found.name == name
    assert found.hint[-1] in "?."
    assert not said or found.words == said
    assert found.line == (line if isinstance(line, int) and kind != "OddAnswerError" else None)
    if words in ("SIGSEGV", "SIGBUS") and kind == "OutsideArrayError":
        assert "an earlier line" in found.words


def test_hints_for_what_was_returned_are_of_their_kind() -> None:
    """And of what has none of its own, what the text asks for."""
    hints = {name: findings.of_error({"type": "OddAnswerError", "words": f"{name}: it"}).hint for name in findings.ODD}
    assert hints == findings.ODD
    other = findings.of_error({"type": "OddAnswerError", "words": "new: it"})
    assert (other.name, other.hint) == ("new", findings.ODD["wrong_count"])


@pytest.mark.parametrize(
    ("text", "line", "name", "also"),
    [
        ("a\n__builtin_trap();", 2, "crashed", False),
        ("a\nif (x[i]) __builtin_trap();", 2, "crashed", True),
        ("a\nb = x[i];\n__builtin_trap();", 2, "outside_an_array", False),
        ("a\nb;  // __builtin_trap();", 2, "outside_an_array", False),
        ("__builtin_trap();", None, "outside_an_array", False),
        ("__builtin_trap();", 2, "outside_an_array", False),
    ],
)
def test_the_programs_own_trap_is_told_as_that(text: str, line: int | None, name: str, also: bool) -> None:
    """Where it stands on the line, and not in a comment; an index there may be it too."""
    outside = findings.of_error({"type": "OutsideArrayError", "words": "SIGILL", "line": line})
    found = findings.of_own_trap(outside, text)
    assert (found.name, found.line) == (name, line)
    assert ("or an index there" in found.words) == also
    by_memory = findings.of_error({"type": "OutsideArrayError", "words": "SIGSEGV", "line": line})
    assert findings.of_own_trap(by_memory, text) == by_memory
    other = Finding("crashed", "it", "", line)
    assert findings.of_own_trap(other, text) == other


@pytest.mark.parametrize(
    ("line", "words", "source", "said", "hint"),
    [
        (3, "expected ';'.", '#include "exercise.h"', "line 3: the compiler says: expected ';'.", "that line"),
        (None, "no input", '#include "exercise.h"', "the compiler says: no input.", "that line"),
        (3, "unknown type", "int a;", '#include "exercise.h" is missing; line 3: the compiler says: ', "Write #inc"),
        (3, "std has not been declared", '#include "exercise.h"', "line 3: the compiler says: std", "C++"),
        (3, "no file vector", "int a;", '#include "exercise.h" is missing', "C++"),
        (3, "standard", '#include "exercise.h"', "line 3: the compiler says: standard.", "that line"),
    ],
)
def test_what_a_compiler_says(line: int | None, words: str, source: str, said: str, hint: str) -> None:
    """With its line, and with what is plainly missing; the hint is of what it most likely is."""
    found = findings.of_compiler(line, words, source)
    assert found.words.startswith(said)
    assert found.words.endswith(".")
    assert not found.words.endswith("..")
    assert hint in found.hint
    assert (found.name, found.line) == ("does_not_compile", line)


def test_warnings_divisions_and_what_is_missing() -> None:
    """Each a sentence."""
    assert findings.of_warning(4, "unused\nx").words == "line 4: the compiler warns: unused x."
    assert findings.of_warning(4, "x").lines == (4,)
    assert findings.of_whole_division(5, "1 / 2").words.startswith("line 5: 1 / 2 is a division of whole numbers")
    assert findings.of_whole_division(5, "1 / 2").lines == (5,)
    assert findings.not_written(["step"]).words == "step is not written yet."
    assert findings.not_written(["a", "b"]).words == "a and b are not written yet."
    assert findings.missing_function("step").words == "There is no function step."
    late = findings.of_the_end("timed out", "no answer within 20 s")
    assert (late.name, late.words, bool(late.hint)) == ("timed_out", "It was stopped: no answer within 20 s.", True)
    assert findings.of_the_end("crashed", "it ended").hint == ""
    assert [findings.not_repeatable(same).name for same in (True, False)] == [
        "remembers_earlier_calls",
        "random_or_time",
    ]
    assert [findings.fewer_digits(error).words.split("about ")[1][:1] for error in (2e-7, 9e-7, 1.1e-6)] == [
        "6"
    ] * 2 + ["5"]
    for both in (False, True):
        told = findings.side_effects([{"values": []}, {"modified": both, "overwritten": not both}])
        assert [finding.name for finding in told] == ["modifies_its_input" if both else "overwrites_its_results"]
    assert len(findings.side_effects([{"modified": True}, {"overwritten": True}])) == 2
    assert findings.side_effects([{}]) == ()


def test_words_of_a_submission_are_one_printable_line() -> None:
    """Of at most 200 letters."""
    assert findings.clean("a\n  b\tc\x1b[31m\u202e") == "a b c [31m "
    assert len(findings.clean("x" * 500)) == 200


def test_words_for_c() -> None:
    """Nothing is returned there."""
    python = Finding(
        "a",
        "Your function returns the state; what is to be returned.",
        "How far is your return indented? What do you return?",
    )
    told = findings.in_c(python)
    assert told.words == "Your function leaves the state; what is to be written."
    assert told.hint == "Where does your return stand? What do you write?"


def test_names_in_a_sentence() -> None:
    """Commas between them, and before the last an and."""
    assert [findings.listed("abc"[:n]) for n in (1, 2, 3)] == ["a", "a and b", "a, b and c"]


TWO = Question("f", (), ("x", "v"), "two")


def of_form(given: list[list[Any]], right: list[list[Any]], question: Question = TWO) -> tuple[str, str]:
    """Name and words of what is said of the form of an answer; empty where it is as it should be."""
    answers = [[[np.asarray(part) for part in step] for step in answer] for answer in (given, right)]
    found = findings.of_form([question], answers[:1], answers[1:])
    return (found.name, found.words) if found else ("", "")


@pytest.mark.parametrize(
    ("part", "want", "name", "words"),
    [
        ([1.0, 2.0], [1.0, 2.5], "", ""),
        ([1.0], [1.0, 2.5], "wrong_shape", "x has shape (1,): expected (2,)."),
        (np.ones((3, 2)) / 2, np.ones((2, 3)) / 2, "transposed", "x has shape (3, 2): expected (2, 3). Rows and"),
        (np.ones((3, 1)) / 2, np.ones((2, 3)) / 2, "wrong_shape", "x has shape (3, 1): expected (2, 3)."),
        ([0.5], 0.5, "", ""),
        ([0.5, 0.5], 0.5, "wrong_shape", "x has shape (2,): expected ()."),
        ([1.5, 2.5], ["a", "b"], "not_numbers", "x is made of float64: expected <U1."),
        ("a b", ["a", "b"], "one_text", "x are one text: expected 2 texts, one after another."),
        ([np.nan, 0.5], [1.0, 2.5], "not_a_number", "x has NaN or infinity in it."),
        ([0.5, np.inf], [1.0, 2.5], "not_a_number", "x has NaN or infinity in it."),
        ([np.nan, 0.5], [np.nan, 2.5], "", ""),
    ],
)
def test_the_form_of_a_part(part: Any, want: Any, name: str, words: str) -> None:
    """Its shape, its kind, and whether its numbers are finite; a number may be an array of one."""
    found = of_form([[part, [0.5]]], [[want, [0.5]]])
    assert found[0] == name
    assert found[1].startswith(words)
    later = of_form([[[0.5], [0.5]], [part, [0.5]]], [[[0.5], [0.5]], [want, [0.5]]])
    assert later[0] == name


def test_whole_numbers_are_told_where_all_are() -> None:
    """Where fractions are expected, in all parts of the first step; whole numbers of which all are zero are none."""
    halves = [[[0.5, 1.5], [2.5]]]
    assert of_form([[[1, 2], [3]]], halves)[0] == "whole_numbers"
    assert of_form([[[1.0, 2.0], [3.0]]], halves)[0] == "whole_numbers"
    assert of_form([[[1.0, 2.5], [3.0]]], halves)[0] == ""
    assert of_form([[[0.0, 0.0], [0.0]]], halves)[0] == ""
    assert of_form([[[0, 0], [0]]], halves)[0] == "whole_numbers"
    assert of_form([[[0.0, 2.0], [0.0]]], halves)[0] == "whole_numbers"
    # what may be whole says nothing, nor what is to be whole
    assert of_form([[[1.0, 2.0], [2.5]]], [[[1.0, 2.0], [2.5]]])[0] == ""
    assert of_form([[[1, 2], [3]]], [[[1, 2], [3]]])[0] == ""
    # by the first step, whatever the others are
    assert of_form([[[1, 2], [3]], [[1, 2], [3]]], [*halves, [[1.0, 2.0], [3.0]]])[0] == "whole_numbers"


def catalogue() -> AnswerCatalogue:
    """One function returns three numbers, another one."""
    solutions = {"three": lambda: (1.5, 2.5, -3.5), "one": lambda: 4.5}
    exercise = Exercise("", 0, "", solutions, lambda *_: [], ())
    asked = [Question("three", (), ("a", "b", "c"), "", steps=0), Question("one", (), ("d",), "")]
    return AnswerCatalogue(exercise, asked)


def test_results_in_another_order() -> None:
    """In any other, where they are right otherwise; with the right order in the hint."""
    known = catalogue()
    numbers = [1.5, 2.5, -3.5]

    def told(order: tuple[int, ...], by: float = 1.0, single: float = 4.5) -> Finding | None:
        three = [[np.array(by * numbers[i]) for i in order]]
        return findings.of_order(known, [three, [[np.array(single)]]])

    for order in ((0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
        found = told(order)
        assert found is not None
        assert "What is to be returned are a, b, c." in found.hint
    assert told((0, 1, 2)) is None
    assert told((1, 0, 2), by=1 + 1e-8) is None
    assert told((1, 0, 2), by=1 + 1e-10) is not None
    assert told((1, 0, 2), single=4.6) is None
    # of several questions all have to be right so, and all that return one thing only; the first names the parts
    again, more = Question("three", (), ("p", "q", "r"), ""), Question("one", (), ("e",), "")
    several = AnswerCatalogue(known.exercise, [*known.questions, again, more])
    backwards = [[np.array(number) for number in numbers[::-1]]]
    given: list[Any] = [backwards, [[np.array(4.5)]], backwards, [[np.array(4.5)]]]
    found = findings.of_order(several, given)
    assert found is not None
    assert "are a, b, c." in found.hint
    for i, wrong in ((2, [[np.array(number) for number in numbers]]), (3, [[np.array(4.6)]]), (1, [[np.array(4.6)]])):
        assert findings.of_order(several, [*given[:i], wrong, *given[i + 1 :]]) is None


def test_what_the_exercise_itself_says() -> None:
    """Of the first answer that it has something to say of; most exercises say nothing."""
    known = catalogue()
    given = [[[np.array(1.0)] * 3], [[np.array(4.5)]]]
    assert findings.of_the_exercise(known, given) is None

    def diagnose(question: Question, part: Any) -> tuple[str, str, str] | None:
        return ("odd", f"{part}.", "Why?") if part > 1 else None

    told = findings.of_the_exercise(AnswerCatalogue(replace(known.exercise, diagnose=diagnose), known.questions), given)
    assert told == Finding("odd", "4.5.", "Why?")
    # by the first part of the first step
    given = [[[np.array(1.0), np.array(2.0), np.array(3.0)], [np.array(4.0)] * 3], [[np.array(0.5)]]]
    assert (
        findings.of_the_exercise(AnswerCatalogue(replace(known.exercise, diagnose=diagnose), known.questions), given)
        is None
    )


def test_words_in_place_of_numbers() -> None:
    """In any step, of any question, of any part."""
    known = catalogue()
    good = [{"values": [[np.array(1.0)] * 3]}, {"values": [[np.array(4.5)]]}]
    assert findings.of_words(known, good) is None
    bad = [good[0], {"values": [[np.array("4.5")]]}]
    found = findings.of_words(known, bad)
    assert found is not None
    assert found.name == "not_numbers"
    assert findings.of_words(known, [{"values": [[np.array(1.0), np.array(1.0), np.array("1")]]}, good[1]]) == found
    assert findings.of_words(known, [{"values": []}, good[1]]) is None
