"""A timeline: changes at their own steps, moments of the past, the cursor's numbers, and how steps fit into a frame."""

from __future__ import annotations

import math
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from reference.changes import Change
from reference.schemes.catalogue import find
from reference.simulate import simulate
from report.live.lab import Lab
from report.live.timeline import Timeline
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


def held(labs: list[Lab], *names: str) -> Timeline:
    """A spring with an unequal clock: shown twice as slow as it moves, held for some steps."""
    timeline = open_lab(labs, "string", names or ["kick_drift"], masses="3").timeline
    timeline.advance(10, speed=0.5)
    timeline.grab(2, np.array([0.3, -0.1]))
    timeline.advance(10, speed=0.5)
    return timeline


def test_a_moment_of_the_past_is_shown_as_it_was(labs: list[Lab]) -> None:
    """Clock and time are two; what hung on the cursor hangs on it, and the lanes' systems have one mass more."""
    timeline = held(labs)
    before = (timeline.clock, timeline.time, timeline.system, timeline.stepped, timeline.segment)
    there = timeline.lanes[0].state
    assert before[0] >= 2 * before[1] == pytest.approx(0.04)
    timeline.set_dt(2e-3)
    timeline.advance(10)
    timeline.release()
    timeline.advance(10)
    assert (timeline.dt, len(timeline.stepped.masses)) == (2e-3, 4)
    timeline.rewind(timeline.time - 0.02)
    assert (timeline.clock, timeline.time, timeline.system, timeline.stepped, timeline.segment) == before
    assert (timeline.dt, timeline.grabbed, timeline.in_past) == (1e-3, 2, True)
    assert (len(timeline.system.masses), len(timeline.stepped.masses)) == (4, 5)
    assert timeline.lanes[0].state is there
    timeline.rewind(0.01)
    assert timeline.time == pytest.approx(0.04)  # as what is kept is what was shown


def test_the_cursors_spring_keeps_its_own_numbers(labs: list[Lab]) -> None:
    """Whatever all others are set to: each its own, the last the cursor's."""
    timeline = held(labs)
    soft, heavy = timeline.stepped.stiffness[-1], timeline.stepped.masses[-1]
    assert soft == pytest.approx(0.2 * timeline.system.stiffness[0])
    timeline.change("stiffness", (100.0, 200.0, 300.0))
    timeline.change("mass", 0.5)
    assert timeline.system.stiffness.tolist() == [100, 200, 300]
    assert timeline.stepped.stiffness.tolist() == [100, 200, 300, soft]
    assert timeline.stepped.masses.tolist() == [0.5, 0.5, 0.5, 0.5, heavy]
    timeline.change("gravity", (0.0, -3.0))
    assert timeline.stepped.gravity.tolist() == timeline.system.gravity.tolist() == [0, -3]
    assert [change[1] for change in timeline.segment.changes] == ["stiffness", "mass", "gravity"]
    timeline.release()
    assert timeline.stepped is timeline.system
    assert timeline.grabbed is None


@pytest.mark.parametrize(("budget", "pieces"), [(math.inf, [100]), (5.5, [1, 2, 4]), (99.0, [1, 2, 4, 8, 16, 32, 37])])
def test_steps_are_made_twice_as_many_at_a_time_while_there_is_time(
    labs: list[Lab], monkeypatch: pytest.MonkeyPatch, budget: float, pieces: list[int]
) -> None:
    """All at once where it may take for ever; the clock goes on by no less than it took, nor than is shown."""
    timeline, clock, made = open_lab(labs, "spring").timeline, count(0.0, 2.0), []

    def advance(steps: int) -> None:
        made.append(steps)

    monkeypatch.setattr(timeline.lanes[0], "advance", advance)
    monkeypatch.setattr("report.live.timeline.time", SimpleNamespace(perf_counter=lambda: next(clock)))
    timeline.advance(100, budget)
    assert made == pieces
    assert timeline.segment.steps == sum(pieces)
    assert timeline.clock == pytest.approx(2.0 * (len(pieces) + 1))


def test_all_stop_with_the_first_that_stops(labs: list[Lab], monkeypatch: pytest.MonkeyPatch) -> None:
    """The other lane goes on only when asked again; then the one that stopped holds up nobody."""
    timeline, made = open_lab(labs, "spring", ["heun", "rk4"]).timeline, []
    first, second = timeline.lanes

    def stops(steps: int) -> None:
        first.stopped = "it is over"

    monkeypatch.setattr(first, "advance", stops)
    monkeypatch.setattr(second, "advance", made.append)
    timeline.advance(10, budget=1e9)
    assert made == [1]
    timeline.advance(10, budget=1e9)
    assert made == [1, 1, 2, 4, 3]
    second.stopped = "this one, too"
    timeline.advance(10, budget=1e9)
    assert made == [1, 1, 2, 4, 3]
