"""A verdict in plain words: what it is, by which evidence, where it first differs, and what to look at."""

from __future__ import annotations

from experiments.exercises.closer_look import CloserLook
from experiments.exercises.grading import Grade
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.verdict.judge import Verdict

#: Outcomes that have told what is wrong: that no small change was found besides says nothing more.
NAMED = ("mistake", "mistakes", "error")

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
    said += [f"- {finding.words} ({finding.hint})" for finding in (*given.closer.findings, *verdict.remarks)]
    return [*said, *_of_the_text(given.closer, verdict.outcome in NAMED)]


#: What a change is of, to the student, without the change.
FAMILIES = {
    "operator": "the operator",
    "sign": "the sign",
    "factor": "a factor or a number",
    "index": "the index",
    "name": "which value is meant",
    "condition": "the condition",
    "copy": "what is a copy, and what the same array",
    "order": "the order",
    "left out": "something is left out",
    "too much": "something too much",
    "axis": "the axis",
    "whole": "what is a whole number, and what is not",
}


def _of_the_text(closer: CloserLook, named: bool) -> list[str]:
    """Where to look in the text: only what was tried and made it right; that nothing did, where no name was told."""
    if not closer.told:
        if named:
            return []
        short = "" if closer.complete else " The time for trying was used up."
        return [f"{closer.tried} small changes of your text were tried, and none makes it right.{short}"] * bool(
            closer.tried
        )
    one = len(closer.told[0].places) == 1
    said = [f"{'One small change' if one else 'Two small changes'} of your text would make it right. Look at"]
    for repair in closer.told:
        place = " and ".join(f"line {line} ({FAMILIES[family]})" for line, family in repair.places)
        said.append(f"- {place}")
    return list(dict.fromkeys(said))
