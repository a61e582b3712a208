"""What can be wrong with a submission that no arithmetic explains: errors, shapes, numbers that are none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from experiments.exercises.exercise import Answer, Question


@dataclass(frozen=True)
class Finding:
    """One thing that was found: its name in tables, what it is in words, and what to look at."""

    name: str
    words: str
    hint: str = ""


#: Errors that are known by their type: a name and a hint.
ERRORS = {
    "SyntaxError": ("syntax", "Python cannot read this line, or the one before it."),
    "IndentationError": ("syntax", "How far is the line indented, and how far its neighbours?"),
    "NotImplementedError": ("not_written_yet", "Write what is missing; the text says what."),
    "SystemExit": ("ends_the_program", "A function returns; it does not end the program."),
    "KeyboardInterrupt": ("ends_the_program", "A function returns; it does not end the program."),
    "MemoryError": ("too_much_memory", "How large is the array that you ask for?"),
    "RecursionError": ("endless_recursion", "When does the function stop calling itself?"),
    "PermissionError": (
        "reaches_out",
        "A submission may compute. Files, programs and the network are out of its reach.",
    ),
    "ModuleNotFoundError": ("missing_module", "There are Python's own modules and NumPy, nothing else."),
    "IndexError": ("index_error", "Which is the first and which the last number of the array?"),
    "ZeroDivisionError": ("division_by_zero", "What is zero there, and when?"),
}


def fault_of_error(error: Mapping[str, Any] | None, missing: str | None) -> Finding:
    """What an exception says, with the student's own line; or that a function is not there."""
    if error is None:
        return Finding("missing_function", f"There is no function {missing}.", "Keep the names of the starter.")
    kind, words, line = (clean(str(error.get(name))) for name in ("type", "words", "line"))
    where = f"line {line}: " if line != "None" else ""
    if kind == "ValueError" and words.startswith("it returns"):
        name = "returns_nothing" if "nothing" in words else "returns_a_dict" if "dict" in words else "wrong_count"
        return Finding(name, f"Your function does not return what it should: {words}.", "What does the text ask for?")
    if kind == "ValueError" and "not made of real numbers" in words:
        return Finding("not_numbers", f"Your function does not return numbers: {words}.", "Look at what you return.")
    name, hint = ERRORS.get(kind, ("raises_an_error", "Look at that line, and at what its names hold there."))
    if name == "not_written_yet":
        return Finding(name, f"{where}this is not written yet.", hint)
    return Finding(name, f"{where}{kind}: {words}".rstrip(": ") + ".", hint)


def fault_of_values(questions: Sequence[Question], given: Sequence[Answer], right: Sequence[Answer]) -> Finding | None:
    """Whole numbers where there are none, wrong shapes, what is no number."""
    firsts = [pair for answer, want in zip(given, right, strict=True) for pair in zip(answer[0], want[0], strict=True)]
    whole = [_whole(part) and not _whole(want) for part, want in firsts if want.dtype.kind == "f"]
    if whole and all(whole) and any(part.any() or part.dtype.kind in "iu" for part, _ in firsts):
        words = "All your results are whole numbers: what comes after the point is cut off."
        return Finding("whole_numbers", words, "Of which type is the array that you write into?")
    for question, answer, expected in zip(questions, given, right, strict=True):
        for step, want in zip(answer, expected, strict=False):
            for name, part, other in zip(question.parts, step, want, strict=True):
                fault = _fault(name, part, other)
                if fault:
                    return fault
    return None


def _fault(name: str, part: Any, want: Any) -> Finding | None:
    if want.dtype.kind == "U" and part.dtype.kind == "U" and part.shape == ():
        words = f"{name} are one text: expected {want.size} texts, one after another."
        return Finding("one_text", words, "A list has brackets, and every name quotes of its own.")
    if part.shape != want.shape and not (want.shape == () and part.size == 1):
        words = f"{name} has shape {part.shape}: expected {want.shape}."
        if want.ndim == 2 and part.shape == want.shape[::-1]:
            return Finding("transposed", f"{words} Rows and columns are swapped.", "What is a row of the array?")
        return Finding("wrong_shape", words, "Print the shapes of what you return and of what you were given.")
    if (part.dtype.kind == "U") != (want.dtype.kind == "U"):
        return Finding(
            "not_numbers", f"{name} is made of {part.dtype}: expected {want.dtype}.", "Look at what you return."
        )
    if part.dtype.kind == "f" and not np.isfinite(part).all() and np.isfinite(want).all():
        words = f"{name} has NaN or infinity in it."
        return Finding("not_a_number", words, "Where can you divide by zero, or take the root of less than zero?")
    return None


def _whole(part: Any) -> bool:
    return bool(part.dtype.kind in "iub" or (np.round(part) == part).all())


def beside(answers: Sequence[Mapping[str, Any]]) -> tuple[Finding, ...]:
    """What is wrong whatever the numbers are."""
    found = []
    if any(answer.get("modified") for answer in answers):
        words = "Your function changes the arrays that it is given."
        found.append(Finding("modifies_its_input", words, "Which of your names is a copy, and which the same array?"))
    if any(answer.get("overwritten") for answer in answers):
        words = "Your function writes over what it returned before: all its results are one array."
        found.append(Finding("overwrites_its_results", words, "Where is the array made that you return?"))
    return tuple(found)


def not_repeated(same: bool) -> Finding:
    """A call that answers differently the second time: because of the first, or by chance or time.

    Args:
        same: whether another process went through the same answers.
    """
    if same:
        words = "Your function remembers earlier calls: the same call answers differently the second time."
        return Finding("remembers_earlier_calls", words, "Which of your variables outlive a call?")
    words = "Your function answers differently each time: by chance, or by the clock."
    return Finding("random_or_time", words, "A step depends on nothing but what it is given.")


def clean(words: str) -> str:
    """Words that somebody else wrote, on one line, of printable characters, and not too long."""
    return "".join(c if c.isprintable() else " " for c in " ".join(words.split()))[:200]
