"""A verdict in plain words: which headline, by which evidence, and where in the text to look."""

from __future__ import annotations

import pytest

from experiments.exercises.closer_look import CloserLook
from experiments.exercises.exercise import find
from experiments.exercises.grading import Grade
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.repair.repaired import Repair
from experiments.exercises.teaching.words import FAMILIES, evidence, far, headline, paragraphs
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.judge import Outcome, Verdict

RIGHT = Verdict("right", (), (True, True), 2e-16, 2e-16)
WRONG = Verdict("not in the catalogue", (), (True, False))


@pytest.mark.parametrize(
    ("public", "hidden", "words"),
    [
        (RIGHT, None, "Public check passed. The hidden one has not run."),
        (RIGHT, RIGHT, "Public and hidden check passed."),
        (RIGHT, WRONG, "Public check passed; the hidden one did not."),
        (WRONG, RIGHT, "Not right yet, and not in my catalogue of mistakes."),
        (Verdict("error", (Finding("not_written_yet", ""),), ()), None, "There is nothing to check yet."),
        *(
            (Verdict(outcome, (), ()), None, words)
            for outcome, words in (
                ("another scheme", "Right in itself, but not what was asked for."),
                ("mistake", "Not right yet. The mistake has a name:"),
                ("mistakes", "Not right yet. There is more than one thing:"),
                ("error", "It did not run."),
                ("timed out", "It did not come to an end."),
                ("crashed", "Its process ended early."),
            )
        ),
    ],
)
def test_the_headline_says_how_it_went(public: Verdict, hidden: Verdict | None, words: str) -> None:
    """Of every outcome of the public check, and of each of the hidden one where that passed."""
    assert headline(Grade(public, hidden, 1.0)) == words


@pytest.mark.parametrize(
    ("error", "right_error", "outcome", "begin"),
    [
        (3e-16, 3e-16, "right", "Your numbers are the right ones, to 3.0e-16 of the largest."),
        (3e-16, 0.02, "mistakes", "Identified: your numbers are those of one and two, to 3.0e-16 of the largest; from"),
        (0.02, 0.02, "mistakes", None),
        (0.03, 0.02, "mistakes", None),
        (None, 0.02, "mistakes", None),
        (3e-16, None, "mistakes", None),
    ],
)
def test_the_evidence_is_how_near_the_numbers_are(
    error: float | None, right_error: float | None, outcome: Outcome, begin: str | None
) -> None:
    """Nearer to those of the name than to the right ones; nothing is said without both distances."""
    found = (Finding("one", ""), Finding("two", "")) if outcome == "mistakes" else ()
    said = evidence(Verdict(outcome, found, (), error, right_error))
    assert said is None if begin is None else said is not None and said.startswith(begin)
    if begin is not None and begin.startswith("Identified"):
        assert said is not None
        assert said.endswith("from the right ones they are 2.0e-02 away.")


@pytest.mark.parametrize(("distance", "words"), [(0.25, "2.5e-01"), (999.0, "1.0e+03"), (1e3, "very far")])
def test_a_distance_is_a_number_up_to_a_thousand(distance: float, words: str) -> None:
    """What is farther is very far."""
    assert far(distance) == words


def said_of(closer: CloserLook, verdict: Verdict = WRONG) -> list[str]:
    """What is told of a submission's text."""
    said = paragraphs(Submission("own.py", "", find("1")), Grade(verdict, None, 1.0, closer))
    assert said[0] == f"own.py: exercise 1, {find('1').title}"
    return said[2:]


def test_findings_come_with_their_hints_and_what_was_seen_comes_last() -> None:
    """In the order of a verdict: what it is, why, what else was seen, what is worth a look."""
    verdict = Verdict(
        "mistake",
        (Finding("gravity_sign", "It falls up.", "Which way is up?"), Finding("plain", "No hint.")),
        (False,),
        1e-16,
        0.5,
        remarks=(Finding("warned", "Unused.", "Line 3"),),
    )
    said = said_of(CloserLook((Finding("seen", "Right at rest.", "And moving?"),), tried=9), verdict)
    assert said[:3] == ["- gravity_sign: It falls up.", "  Hint: Which way is up?", "- plain: No hint."]
    assert said[3].startswith("Identified: your numbers are those of gravity_sign and plain")
    assert said[4:] == ["- Right at rest. (And moving?)", "- Unused. (Line 3)"]


@pytest.mark.parametrize(
    ("outcome", "tried", "complete", "words"),
    [
        ("not in the catalogue", 12, True, ["12 small changes of your text were tried, and none makes it right."]),
        (
            "not in the catalogue",
            12,
            False,
            ["12 small changes of your text were tried, and none makes it right. The time for trying was used up."],
        ),
        ("not in the catalogue", 0, True, []),
        ("mistake", 12, True, []),
        ("mistakes", 12, True, []),
        ("error", 12, True, []),
    ],
)
def test_that_no_change_was_found_is_told_where_no_mistake_has_a_name(
    outcome: Outcome, tried: int, complete: bool, words: list[str]
) -> None:
    """And whether the time for it was used up; of nothing that was tried nothing."""
    assert said_of(CloserLook((), (), tried, complete), Verdict(outcome, (), (False,))) == words


def test_a_change_is_told_by_its_line_and_kind() -> None:
    """One place or two, each place once, and not the change."""
    one, same = (Repair(name, ((3, "sign"),), "a -> b", 1.0) for name in ("step", "forces"))
    assert said_of(CloserLook((), (one, same), 5)) == [
        "One small change of your text would make it right. Look at",
        "- line 3 (the sign)",
    ]
    two = Repair("step", ((3, "index"), (7, "whole")), "a -> b", 2.0)
    assert said_of(CloserLook((), (two,), 5)) == [
        "Two small changes of your text would make it right. Look at",
        "- line 3 (the index) and line 7 (what is a whole number, and what is not)",
    ]
    said = [said_of(CloserLook((), repairs, 5))[0] for repairs in ((one, two), (two, one))]
    assert [line.split()[0] for line in said] == ["One", "Two"]
    assert len(set(FAMILIES.values())) == len(FAMILIES)
