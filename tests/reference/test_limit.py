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
