"""What a lab makes of time that passes, and of what people ask for; the lanes themselves are in `test_lab`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from reference.errors import InputError
from report.live.lab import BUDGET, Lab
from report.live.timeline import Timeline
from tests.report.live.labs import apart, open_lab


@pytest.fixture
def lab(labs: list[Lab]) -> Lab:
    """A string of three masses by two schemes, playing."""
    made = open_lab(labs, "string", ["heun", "rk4"], masses="3")
    made.play()
    return made


def test_a_frame_has_as_many_steps_as_the_time_is_worth(lab: Lab, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is left of a step is had in the next frame; not what there was no room for."""
    made: list[tuple[Any, ...]] = []
    monkeypatch.setattr(lab.timeline, "advance", lambda *given: made.append(given))

    def steps(*seconds: float) -> list[int]:
        made.clear()
        for elapsed in seconds:
            lab.frame(elapsed)
        return [given[0] for given in made]

    assert steps(0.0155, 0.0005, 0.0004, 0.0004, 0.0004) == [15, 1, 1]
    assert made[-1][1:] == (BUDGET, 1.0)
    lab.set_speed(0.5)
    assert steps(0.02 - 2 * 0.0002, 0.002) == [10, 1]
    assert made[-1][1:] == (BUDGET, 0.5)
    lab.set_speed(1.0)
    lab.set_most_steps(4)
    assert steps(0.1, 0.0, 0.0) == [4, 1]
    lab.playing = False
    assert steps(0.1) == []


@pytest.mark.parametrize(
    ("mass", "place"), [(0, (0.1, 0.1)), (4, (0.1, 0.1)), (-1, (0.1, 0.1)), (2, (math.nan, 0.1)), (2, (0.1, math.inf))]
)
def test_what_cannot_be_held_is_not(lab: Lab, mass: int, place: tuple[float, float]) -> None:
    """A mass that is fixed, or is not there; a place that is none."""
    lab.grab(mass, np.array(place))
    assert lab.timeline.grabbed is None
    lab.grab(2, np.array([0.3, 0.1]))
    assert lab.timeline.grabbed == 2
    lab.release()
    assert lab.timeline.grabbed is None


def test_a_mass_that_is_there_is_pinned_and_its_limit_is_asked_for(lab: Lab, monkeypatch: pytest.MonkeyPatch) -> None:
    """The last, too; of another nothing happens."""
    asked: list[tuple[Any, ...]] = []
    monkeypatch.setattr(lab._predictor, "ask", lambda *question: asked.append(question))
    for mass in (-1, 4):
        lab.toggle_pin(mass)
    assert asked == []
    lab.toggle_pin(3)
    lab.toggle_pin(0)
    assert lab.timeline.system.fixed.tolist() == [False, False, False, True]
    assert asked[-1] == (("heun", "rk4"), lab.timeline.system, lab.timeline.dt)
    assert len(asked) == 2


def test_at_the_start_another_dt_or_stepper_begins_anew_and_later_goes_on(labs: list[Lab]) -> None:
    """What was moved is kept in both."""
    lab = open_lab(labs, "string", ["heun"], masses="3")
    lab.set_parameter("stiffness", 150.0)
    first = lab.timeline
    lab.set_dt(2e-3)
    assert lab.timeline is not first
    lab.set_steppers(["rk4"])
    assert (lab.timeline.dt, lab.timeline.steppers, lab.timeline.time) == (2e-3, ("rk4",), 0.0)
    assert lab.timeline.segment.at_start
    assert lab.timeline.system.stiffness.tolist() == [150.0] * 3
    lab.advance(10)
    under_way = lab.timeline
    lab.set_dt(2e-3)
    lab.set_steppers(["rk4"])
    assert lab.timeline.segment.settings is not None
    lab.set_dt(1e-3)
    lab.set_steppers(["heun", "rk4"])
    assert lab.timeline is under_way
    assert lab.timeline.time == pytest.approx(0.02)
    lab.reset()
    assert (lab.timeline.steppers, lab.timeline.dt, lab.timeline.time) == (("heun", "rk4"), 1e-3, 0.0)
    assert lab.timeline.system.stiffness.tolist() == [150.0] * 3
    lab.open("string", {"masses": "4"}, barrier=True, dt=3e-3)
    assert (lab.numbers, lab.timeline.dt, len(lab.timeline.system.obstacles)) == ({}, 3e-3, 1)
    assert lab.timeline.system.stiffness.tolist() == [200.0] * 4


def test_a_new_lane_begins_where_the_first_one_is(lab: Lab) -> None:
    """However many there are; the others go on from where they were."""
    lab.set_dt(5e-3)
    lab.advance(20)
    heun, rk4 = (lane.state for lane in lab.timeline.lanes)
    assert apart(heun, rk4) > 1e-6
    lab.set_steppers(["heun", "rk4", "kick_drift", "euler"])
    assert [apart(lane.state, heun) == 0 for lane in lab.timeline.lanes] == [True, False, True, True]
    assert apart(lab.timeline.lanes[1].state, rk4) == 0


def test_going_back_pauses_and_asks_for_the_limit_of_then(lab: Lab, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the steppers of then; a notice is of the present only."""
    lab.advance(10)
    lab.set_steppers(["kick_drift"])
    lab.advance(10)
    lab.timeline.lanes[0].notice = "it blew up"
    assert lab.notice == "it blew up"
    asked: list[tuple[Any, ...]] = []
    monkeypatch.setattr(lab._predictor, "ask", lambda *question: asked.append(question))
    lab.rewind(0.015)
    assert (lab.playing, lab.notice, lab.timeline.steppers) == (False, "", ("heun", "rk4"))
    assert asked == [(("heun", "rk4"), lab.timeline.system, 1e-3)]
    lab.set_steppers(["heun", "rk4"])
    assert lab.timeline.time == pytest.approx(0.0)


def test_notices_of_all_lanes_are_one_text(lab: Lab) -> None:
    """In their order; of those without one nothing."""
    first, second = lab.timeline.lanes
    second.notice = "rk4 stopped."
    assert lab.notice == "rk4 stopped."
    first.notice = "heun blew up."
    assert lab.notice == "heun blew up. rk4 stopped."


@pytest.mark.parametrize(
    ("asked", "least", "most", "says"),
    [
        (Lab.set_dt, 1e-12, 1e3, r"dt = .*: expected a number from 1e-12 to 1000 \[s\]"),
        (Lab.set_speed, 1e-6, 1e6, r"speed = .*: expected a number from 1e-06 to 1e\+06 \[s of the scene in 1 s\]"),
        (Lab.set_most_steps, 1, 2000, r"steps a frame = .*: expected a number from 1 to 2000 \[1\]"),
        (Lab.rewind, 0.0, 1e9, r"back = .*: expected a number from 0 to inf \[s\]"),
    ],
)
def test_numbers_have_their_ranges(
    lab: Lab, asked: Callable[[Lab, float], None], least: float, most: float, says: str
) -> None:
    """To both ends, which belong to them; nothing that is no number."""
    for value in (least, most):
        asked(lab, value)
    for value in (least - 1, math.nan, math.inf, *([2 * most] if most < 1e9 else [])):
        with pytest.raises(InputError, match=f"^{says}$"):
            asked(lab, value)


def test_speed_and_steps_are_kept(lab: Lab) -> None:
    """As they were set last."""
    assert (lab.speed, lab.most_steps) == (1.0, 1000)
    lab.set_speed(0.25)
    lab.set_most_steps(3)
    assert (lab.speed, lab.most_steps) == (0.25, 3)


def test_play_lets_go_in_the_past_and_begins_anew_after_a_stop(lab: Lab, monkeypatch: pytest.MonkeyPatch) -> None:
    """One lane that has stopped is enough; in the past nothing begins anew."""
    monkeypatch.setattr(Timeline, "rewind", lambda self, seconds: setattr(self, "in_past", True))
    lab.advance(10)
    lab.grab(2, np.array([0.3, 0.1]))
    lab.play()
    assert lab.timeline.grabbed == 2
    lab.rewind(0.0)
    lab.timeline.lanes[0].stopped = "it is over"
    lab.play()
    assert (lab.playing, lab.timeline.grabbed) == (True, None)
    assert lab.timeline.time == pytest.approx(0.01)
    lab.playing, lab.timeline.lanes[1].stopped = False, "this one"
    lab.play()
    assert (lab.playing, lab.timeline.time) == (True, 0.0)
