"""What a limit says in words."""

from __future__ import annotations

import pytest

from reference.limit import Limit, StableSteps


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        (Limit(0.02), "up to a limit"),
        (Limit(0.02, at_most=0.03, certainty="between"), "up to a limit"),
        (Limit(None, "stable at any dt", certainty="certified"), "any"),
        (Limit(None, "stable at any dt that was tried, up to 100 s"), "any"),
        (Limit(None, "nothing moves"), "any"),
        (Limit(None, "unstable at any dt: grows by 0.005 of itself in a step of 0.001 s", 0.005), "none"),
        (Limit(None, "unstable at any dt that was tried, down to 1e-09 s"), "none"),
        (Limit(None, "no stable step was found, down to 1e-09 s"), "none"),
        (Limit(None, "not computed: neither single oscillators nor a scheme near to it tell where to look"), "unknown"),
        (Limit(None, "unstable at 0.001 s: grows by 0.005 of itself in a step", 0.005), "unknown"),
        (Limit(None, ""), "unknown"),
    ],
)
def test_which_steps_are_stable_is_told_in_one_word(limit: Limit, expected: StableSteps) -> None:
    """For programs; the reason is for people."""
    assert limit.stable_steps == expected


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        (Limit(0.02), ""),
        (Limit(None, "nothing moves", note="but slowly"), "nothing moves; but slowly"),
        (Limit(0.02, at_most=0.03), ""),
        (Limit(0.02, at_most=0.03, certainty="between"), "between 0.02 and 0.03 s"),
        (Limit(0.02, certainty="between", note="at least 0.02 s"), "at least 0.02 s"),
        (
            Limit(0.1, note="so it is", windows=((0.2, 0.3), (0.4, 0.5)), looked_to=0.5),
            "so it is; stable again from 0.2 to 0.3 s; stable again from 0.4 s on, looked at up to 0.5 s",
        ),
        (Limit(0.1, windows=((0.2, float("inf")),)), "stable again from 0.2 s on"),
    ],
)
def test_what_there_is_to_say_besides_the_value(limit: Limit, expected: str) -> None:
    """The reason, the note, the two values it lies between, where it is stable again: in this order."""
    assert limit.remark == expected


def test_one_value_is_exact_and_two_or_none_are_not() -> None:
    """However sure it is."""
    assert Limit(0.02).exact
    assert Limit(0.02, certainty="certified").exact
    assert not Limit(0.02, at_most=0.03, certainty="between").exact
    assert not Limit(None, "nothing moves").exact
