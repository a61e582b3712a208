"""What a scene changes itself: each change at its own step, however many steps are made at a time."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.changes import Change
from reference.schemes.catalogue import find
from reference.simulate import simulate
from report.live.lab import Lab
from tests.report.live.labs import apart, open_lab

#: Not in the order of their times; two at once; one at the start.
CHANGES = [
    Change(0.016, "stiffness", 150.0),
    Change(0.008, "stiffness", 300.0),
    Change(0.0, "gravity", 3.0),
    Change(0.008, "drag", 0.05),
    Change(0.0165, "gravity", 12.0),
]

TOML = 'scene = "string"\ndt = 1e-3\nduration = 0.1\n' + "".join(
    f'[[changes]]\ntime = {change.time}\nparameter = "{change.parameter}"\nvalue = {change.value}\n'
    for change in CHANGES
)


@pytest.mark.usefixtures("by_loops")
@pytest.mark.parametrize("at_once", [1, 3, 30])
def test_a_scenes_own_changes_are_made_at_their_steps(labs: list[Lab], tmp_path: Path, at_once: int) -> None:
    """To the last bit what a plain run does: one step, a few, all at a time."""
    (tmp_path / "own.toml").write_text(TOML, encoding="utf-8")
    lab = open_lab(labs, str(tmp_path / "own.toml"), ["kick_drift"])
    for _ in range(30 // at_once):
        lab.advance(at_once)
    assert lab.timeline.segment.steps == 30
    assert lab.timeline.time == pytest.approx(0.03)
    wanted = simulate(lab.timeline.opened.system, find("kick_drift"), 1e-3, 0.03, CHANGES).states()[-1]
    assert apart(lab.timeline.lanes[0].state, wanted) == 0
