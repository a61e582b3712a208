"""The text of loops: the shortest there is, word for word as it is printed where it is explained."""

from __future__ import annotations

from textwrap import dedent, indent

import pytest

from reference.compiled import loops
from reference.compiled.loops import Loops
from reference.compiled.tracing import trace
from reference.schemes.catalogue import find


def test_eulers_text_is_the_one_that_is_printed() -> None:
    """No place is copied that is there already, and no list is kept of what a string joins."""
    explained = loops.__doc__ or ""
    printed = dedent(explained[explained.index("    for step in") : explained.index("No mass writes")]).rstrip()
    text = Loops(trace(find("euler")), dimension=2, string=True).text()
    assert text.endswith(indent(printed, "    ") + "\n")


@pytest.mark.parametrize(("scheme", "kept"), [("euler", []), ("kick_drift", []), ("heun", [0]), ("rk4", [0, 1, 2])])
def test_an_acceleration_is_kept_only_for_a_later_stage(scheme: str, kept: list[int]) -> None:
    """Heun needs the one at the start again at the end; what is not needed again is nowhere written."""
    assert Loops(trace(find(scheme)), dimension=3, string=False).kept == kept
