"""A verdict in plain words: what it is, by which evidence, where it first differs, and what to look at."""

from __future__ import annotations

from experiments.exercises.grading import Grade
from experiments.exercises.judge import Verdict
from experiments.exercises.submission import Submission

#: What is said of the hidden check as long as nobody has run it.
UNSEEN = "The hidden one has not run."


def headline(given: Grade) -> str:
    """One line: how it went."""
    if given.public.name == "not_written_yet":
        return "There is nothing to check yet."
    if given.public.right and given.hidden is None:
        return f"Public check passed. {UNSEEN}"
    if given.public.right and given.hidden is not None and given.hidden.right:
        return "Public and hidden check passed."
    if given.public.right:
        return "Public check passed; the hidden one did not."
    return {
        "another scheme": "Right in itself, but not what was asked for.",
        "mistake": "Not right yet. The mistake has a name:",
        "mistakes": "Not right yet. There is more than one thing:",
        "not in the catalogue": "Not right yet, and not in my catalogue of mistakes.",
        "error": "It did not run.",
        "timed out": "It did not come to an end.",
        "crashed": "Its process ended early.",
    }.get(given.public.outcome, "Not right yet.")


def evidence(verdict: Verdict) -> str | None:
    """Why it is called what it is called."""
    if verdict.error is None or verdict.right_error is None:
        return None
    if verdict.right:
        return f"Your numbers are the right ones, to {verdict.error:.1e} of the largest."
    if verdict.right_error <= verdict.error:
        return None
    return (
        f"Identified: your numbers are those of {verdict.name.replace(' + ', ' and ')}, to {verdict.error:.1e} of the "
        f"largest; from the right ones they are {far(verdict.right_error)} away."
    )


def far(distance: float) -> str:
    """A distance as a fraction of the largest number, in words where it is too large for that."""
    return f"{distance:.1e}" if distance < 1e3 else "very far"


def paragraphs(submission: Submission, given: Grade) -> list[str]:
    """All there is to say."""
    verdict = given.verdict
    exercise = submission.exercise
    said = [f"{submission.name}: exercise {exercise.number}, {exercise.title}", headline(given)]
    for finding in verdict.findings:
        said.append(f"- {finding.name}: {finding.words}")
        if finding.hint:
            said.append(f"  Hint: {finding.hint}")
    why = evidence(verdict)
    said += [why] if why else []
    if verdict.first_difference is not None:
        said.append(f"First difference: {verdict.first_difference}.")
    return said
