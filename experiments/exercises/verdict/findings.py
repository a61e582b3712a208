"""What is found without the answer catalogue: errors, wrong shapes, numbers that are not finite, changed inputs."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice, permutations
from typing import Any

import numpy as np

from experiments.exercises.c.text import includes_the_exercise, without_comments
from experiments.exercises.exercise import Answer, Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.answer_distance import answer_distance


@dataclass(frozen=True)
class Finding:
    """One thing that was found.

    Attributes:
        name: how it is called in tables.
        words: what it is, in a sentence or two.
        hint: what to look at.
        line: of the submission, where an error has one.
        lines: of the submission, from which what is meant comes.
    """

    name: str
    words: str
    hint: str = ""
    line: int | None = None
    lines: tuple[int, ...] = ()


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
    "ModuleNotFoundError": ("missing_module", "There are NumPy and Python's own modules for computing, nothing else."),
    "ImportError": ("missing_module", "There are NumPy and Python's own modules for computing, nothing else."),
    "IndexError": ("index_error", "Which is the first and which the last number of the array?"),
    "ZeroDivisionError": ("division_by_zero", "What is zero there, and when?"),
}


#: What to look at where something else is returned than was asked for, by name.
ODD = {
    "returns_nothing": "Is there a return on every way through the function? Does it stand where it should?",
    "returns_a_dict": "Return the things themselves, in the order of the text, with commas between them.",
    "returns_a_set": "Return the things themselves, in the order of the text, with commas between them.",
    "wrong_count": "What does the text ask for?",
    "not_numbers": "Print what you return, and its type.",
    "ragged": "Print what you return. Has each mass as many numbers as the others?",
}


#: Memory that is nobody's: the line that reaches it may only use what an earlier one has written over.
BY_MEMORY = (
    "outside_an_array",
    "it crashed here: your program reads or writes outside an array, or follows a pointer that leads nowhere; "
    "an earlier line may have written over what is used here",
    "Arrays begin at 0 and end one before their length: where do your loops end? What is above the first mass?",
)

#: What ends a C program, by the error of `c.calls` and the signal: a name, what it is, and what to look at.
OF_C: Mapping[str, Mapping[str, tuple[str, str, str]]] = {
    "OutsideArrayError": {
        "": (
            "outside_an_array",
            "your program reads or writes outside an array",
            "Arrays begin at 0 and end one before their length. What is above the first mass, what below the last?",
        ),
        **dict.fromkeys(("SIGSEGV", "SIGBUS"), BY_MEMORY),
    },
    "FullStackError": {
        "": (
            "endless_recursion",
            "a function calls itself without an end, or its arrays are larger than the stack",
            "When does the function stop calling itself? How large are its arrays?",
        )
    },
    "EndedBySignalError": {
        "SIGFPE": ("division_by_zero", "your program divides a whole number by zero", "What is zero there, and when?"),
        "": (
            "crashed",
            "your program ended itself: it called abort, or an assert failed; or the C library ended it, where memory "
            "was given back twice or written past its end",
            "Is there an assert or abort, and what does it ask? If there is none: do you need malloc and free?",
        ),
    },
}


def missing_function(name: str) -> Finding:
    """A function that was asked for is not there."""
    return Finding("missing_function", f"There is no function {name}.", "Keep the names of the starter.")


def of_the_end(word: str, reason: str) -> Finding:
    """A process that gave no answer.

    Args:
        word: "timed out" or "crashed". reason: in a line.
    """
    hint = "Which of your loops never comes to its end?" if word == "timed out" else ""
    return Finding(word.replace(" ", "_"), f"It was stopped: {reason}.", hint)


def of_own_trap(found: Finding, source: str) -> Finding:
    """The same finding, or, where the program's own trap stands on its line, that: both are one instruction."""
    by_memory = BY_MEMORY[1] in found.words
    lines = without_comments(source).splitlines() if found.name == "outside_an_array" and not by_memory else []
    text = lines[found.line - 1] if found.line is not None and found.line <= len(lines) else ""
    if "__builtin_trap" not in text:
        return found
    other = ", or an index there is outside its array" if "[" in text else ""
    words = f"line {found.line}: an illegal instruction ended your program: it came to its own __builtin_trap{other}."
    return Finding("crashed", words, "Under which condition does it stand, and why is that so?", found.line)


def of_compiler(line: int | None, words: str, source: str) -> Finding:
    """What a compiler refused; that the exercise's own file is not included, where it is not."""
    said = f"{f'line {line}: ' if line else ''}the compiler says: {clean(words).rstrip('.')}."
    if not includes_the_exercise(source):
        said = f'#include "exercise.h" is missing; {said}'
    is_other = re.search(r"\b(iostream|vector|cmath|std|using|namespace|class|template)\b", words)
    hint = "Is it C++? It is compiled as C." if is_other else "Look at that line, and at the one before it."
    if not is_other and not includes_the_exercise(source):
        hint = 'Write #include "exercise.h" below #define EXERCISE, as the starter does.'
    return Finding("does_not_compile", said, hint, line)


def of_warning(line: int, words: str) -> Finding:
    """What a compiler warns of, in a program that it takes."""
    hint = "It compiles; is it what you mean?"
    return Finding("compiler_warns", f"line {line}: the compiler warns: {clean(words)}.", hint, lines=(line,))


#: Words for students who return something, and for those who write into arrays.
IN_C = (
    ("How far is your return indented?", "Where does your return stand?"),
    ("returns the state", "leaves the state"),
    ("to be returned", "to be written"),
    ("ou return", "ou write"),
)


def in_c(finding: Finding) -> Finding:
    """The same, in words for a C program: there nothing is returned, arrays are written into."""
    for python, c in IN_C:
        finding = replace(finding, words=finding.words.replace(python, c), hint=finding.hint.replace(python, c))
    return finding


def of_whole_division(line: int, words: str) -> Finding:
    """Two whole numbers of the text, one divided by the other with a remainder."""
    said = f"line {line}: {words} is a division of whole numbers, what comes after the point is cut off."
    return Finding("whole_division", said, "How is a number written that is none of the whole ones?", lines=(line,))


def not_written(functions: Sequence[str]) -> Finding:
    """Functions that nothing was written into."""
    names = " and ".join(functions)
    words = f"{names} {'is' if len(functions) == 1 else 'are'} not written yet."
    return Finding("not_written_yet", words, "The text says what to write.")


def of_error(error: Mapping[str, Any]) -> Finding:
    """What an exception says, with the student's own line.

    Args:
        error: type, words and line, as `child.story` makes them.
    """
    kind, words = (clean(str(error.get(name))) for name in ("type", "words"))
    line = error["line"] if isinstance(error.get("line"), int) else None
    where = f"line {line}: " if line is not None else ""
    if kind == "OddAnswerError":
        name, _, what = words.partition(": ")
        return Finding(
            name, f"Your function does not return what it should: {what}.", ODD.get(name, ODD["wrong_count"])
        )
    if kind in OF_C:
        name, what, hint = OF_C[kind].get(words) or OF_C[kind][""]
        return Finding(name, f"{where}{what}.", hint, line)
    if kind == "FileNotFoundError" and "No usable temporary directory" in words:
        kind = "PermissionError"  # no folder can be written
    name, hint = ERRORS.get(kind, ("raises_an_error", "Look at that line, and at what its names hold there."))
    if name == "not_written_yet":
        return Finding(name, f"{where}this is not written yet.", hint, line)
    return Finding(name, f"{where}{kind}: {words}".rstrip(": ") + ".", hint, line)


def of_words(catalogue: AnswerCatalogue, answers: Sequence[Mapping[str, Any]]) -> Finding | None:
    """Words where numbers are asked for: nothing else can be said of such an answer."""
    for answer, right in zip(answers, catalogue.right, strict=False):
        for step in answer["values"]:
            for part, want in zip(step, right[0], strict=False):
                if part.dtype.kind == "U" and want.dtype.kind != "U":
                    words = "Your function does not return numbers, but words."
                    return Finding("not_numbers", words, "Look at what you return: is it in quotes, or made by str?")
    return None


def of_form(questions: Sequence[Question], given: Sequence[Answer], right: Sequence[Answer]) -> Finding | None:
    """Whole numbers where fractions are expected, wrong shapes, words for numbers, numbers that are not finite."""
    firsts = [pair for answer, want in zip(given, right, strict=True) for pair in zip(answer[0], want[0], strict=True)]
    whole = [_whole(part) and not _whole(want) for part, want in firsts if want.dtype.kind == "f"]
    if whole and all(whole) and any(part.any() or part.dtype.kind in "iu" for part, _ in firsts):
        words = "All your results are whole numbers: what comes after the point is cut off."
        return Finding("whole_numbers", words, "Of which type is the array that you write into?")
    for question, answer, expected in zip(questions, given, right, strict=True):
        for step, want in zip(answer, expected, strict=False):
            for name, part, other in zip(question.parts, step, want, strict=True):
                found = _of_part(name, part, other)
                if found:
                    return found
    return None


def _of_part(name: str, part: Any, want: Any) -> Finding | None:
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
        return Finding(
            "not_a_number",
            words,
            "Where can you divide by zero, take the root of less than zero, or use what nothing was written into?",
        )
    return None


def _whole(part: Any) -> bool:
    return bool(part.dtype.kind in "iub" or (np.round(part) == part).all())


def of_the_exercise(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Finding | None:
    """What the exercise itself says of an answer that cannot be right."""
    diagnose = catalogue.exercise.diagnose
    if diagnose is None:
        return None
    found = (diagnose(question, answer[0][0]) for question, answer in zip(catalogue.questions, given, strict=True))
    return next((Finding(*words) for words in found if words), None)


def of_order(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Finding | None:
    """Right results, but returned in another order than was asked for: v before x."""
    rows = list(zip(catalogue.questions, given, catalogue.right, catalogue.scales, strict=True))
    several = [row for row in rows if len(row[0].parts) > 1]
    single = max((answer_distance(a, right, scales) for q, a, right, scales in rows if len(q.parts) == 1), default=0.0)
    if not several or single > catalogue.exercise.tolerance:
        return None
    parts = several[0][0].parts
    for order in islice(permutations(range(len(parts))), 1, None):
        # the first step only: what is asked next is made of what was answered
        distances = [answer_distance([[a[0][i] for i in order]], right[:1], scales) for _, a, right, scales in several]
        if max(distances) <= catalogue.exercise.tolerance:
            return Finding(
                "results_in_another_order",
                "Your results are right, but not in the order that was asked for.",
                f"What is to be returned are {', '.join(parts)}. Which comes first?",
            )
    return None


def side_effects(answers: Sequence[Mapping[str, Any]]) -> tuple[Finding, ...]:
    """Arrays that a function changes beside what it returns: wrong, whatever the numbers are."""
    found = []
    if any(answer.get("modified") for answer in answers):
        words = "Your function changes the arrays that it is given."
        found.append(Finding("modifies_its_input", words, "Which of your names is a copy, and which the same array?"))
    if any(answer.get("overwritten") for answer in answers):
        words = "Your function writes over what it returned before: all its results are one array."
        found.append(Finding("overwrites_its_results", words, "Where is the array made that you return?"))
    return tuple(found)


def not_repeatable(same: bool) -> Finding:
    """A call that answers differently the second time: because of the first, or by chance or time.

    Args:
        same: whether another process went through the same answers.
    """
    if same:
        words = "Your function remembers earlier calls: the same call answers differently the second time."
        return Finding("remembers_earlier_calls", words, "Which of your variables outlive a call?")
    words = "Your function answers differently each time: by chance, or by the clock."
    return Finding("random_or_time", words, "A step depends on nothing but what it is given.")


def fewer_digits(error: float) -> Finding:
    """Of numbers that are the right ones as closely as single precision has them, whatever the cause.

    Args:
        error: how far they are away, as a fraction of the largest.
    """
    digits = math.floor(-math.log10(error))
    words = f"The numbers are the right ones to about {digits} digits only, not to rounding: it passes."
    hint = "Possible causes: single precision (float32), rounding, a small number added against division by zero."
    return Finding("fewer_digits", words, hint)


def listed(names: Sequence[str]) -> str:
    """Names in a sentence.

    >>> listed(["the weight", "the drag", "the spring"])
    'the weight, the drag and the spring'
    """
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def clean(words: str) -> str:
    """Words that a submission brought, on one line, of printable characters, at most 200."""
    return "".join(c if c.isprintable() else " " for c in " ".join(words.split()))[:200]
