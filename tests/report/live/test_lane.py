"""A lane goes on until it cannot: what it keeps then, what is said, and what counts where it looks for a blow-up."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.changes import Change
from reference.conserved import energy
from reference.state import State
from reference.system import MassSpringSystem
from report.live.cursor import on_hook, with_cursor
from report.live.lane import Lane, distance, notice_of
from report.live.prediction import Prediction
from report.live.stepping import Stopped

#: Unequal masses and springs.
SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]),
    springs=np.array([[0, 1], [1, 2]]),
    masses=np.array([0.5, 2.0, 1.0]),
    rest_lengths=np.array([1.0, 2.0]),
    stiffness=np.array([400.0, 100.0]),
    gravity=np.array([0.5, -3.0]),
)


class Stepping:
    """In place of a stepper: moves all masses by `by` [m] a step, or stops."""

    def __init__(self, state: State) -> None:
        self.state, self.by, self.told = state, 0.001, []  # type: ignore[var-annotated]
        self.stops = ""

    def advance(self, steps: int) -> State:
        """All at once."""
        self.told.append(steps)
        if self.stops:
            raise Stopped(self.stops)
        time = self.state.time + 0.1 * steps
        self.state = replace(self.state, time=time, positions=self.state.positions + steps * self.by)
        return self.state

    def change(self, parameter: str, value: Any) -> None:
        """Noted."""
        self.told.append((parameter, value))
        if self.stops:
            raise Stopped(self.stops)

    def end(self) -> None:
        """Noted."""
        self.told.append("end")


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[Lane, Stepping, list[Lane]]]:
    """A lane on a stepper made by hand, and all it tells of stopping."""

    def make(stepped: MassSpringSystem = SYSTEM, state: State = SYSTEM.start) -> tuple[Lane, Stepping, list[Lane]]:
        stepper, stopped = Stepping(state), []  # type: ignore[var-annotated]
        monkeypatch.setattr("report.live.lane.stepping", lambda *given: stepper.told.append(given) or stepper)
        lane = Lane("heun", stepped, state, 0.1, SYSTEM, stopped.append)
        assert stepper.told.pop() == ("heun", stepped, state, 0.1)
        return lane, stepper, stopped

    return make


def test_it_goes_on_until_its_stepper_stops(made: Callable[..., Any]) -> None:
    """With its last state and the reason; then nothing moves it any more, and that is told once."""
    lane, stepper, stopped = made()
    lane.advance(3)
    assert (lane.state, lane.stopped, stopped) == (stepper.state, None, [])
    lane.change("mass", 3.0, SYSTEM)
    assert stepper.told == [3, ("mass", 3.0)]
    before, stepper.stops = lane.state, "crashed: SIGKILL"
    lane.advance(2)
    assert (lane.state, lane.stopped, lane.blown_up, stopped) == (before, "crashed: SIGKILL", False, [lane])
    lane.advance(2)
    lane.change("mass", 4.0, SYSTEM)
    assert stepper.told == [3, ("mass", 3.0), 2]
    assert stopped == [lane]
    lane.end()
    lane.end()
    lane.advance(1)
    assert stepper.told[3:] == ["end"]


def test_a_change_may_stop_it(made: Callable[..., Any]) -> None:
    """As where an engine cannot."""
    lane, stepper, stopped = made()
    stepper.stops = "unsupported: drag"
    lane.change("drag", 1.0, SYSTEM)
    assert (lane.stopped, lane.blown_up, stopped) == ("unsupported: drag", False, [lane])


def test_it_may_not_even_begin(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is there, where it began, and moves no further."""

    def fails(*_: object) -> Stepping:
        raise Stopped("unsupported: three dimensions")

    stopped: list[Lane] = []
    monkeypatch.setattr("report.live.lane.stepping", fails)
    state = SYSTEM.start
    lane = Lane("pymunk_springs", SYSTEM, state, 0.1, SYSTEM, stopped.append)
    lane.advance(1)
    lane.change("mass", 3.0, SYSTEM)
    assert (lane.stopped, stopped) == ("unsupported: three dimensions", [lane])
    assert lane.state is state
    assert not lane.blown_up
    lane.end()


@pytest.mark.parametrize(("by", "kept"), [(np.array([[0, 0], [1e9, 0], [0, 0]]), True), (np.inf, False)])
def test_a_blow_up_stops_it_and_what_is_no_number_is_not_shown(made: Callable[..., Any], by: Any, kept: bool) -> None:
    """The last good state is; of springs torn by far it is the torn one."""
    lane, stepper, stopped = made()
    lane.advance(1)
    before, stepper.by = lane.state, by
    lane.advance(1)
    assert (lane.blown_up, stopped) == (True, [lane])
    assert lane.state is (stepper.state if kept else before)
    assert lane.stopped


def test_one_number_that_is_none_is_enough(made: Callable[..., Any]) -> None:
    """The others may be as they were."""
    lane, stepper, _ = made()
    before, stepper.by = lane.state, np.array([[0, 0], [0, 0], [0, np.nan]])
    lane.advance(1)
    assert lane.blown_up
    assert lane.state is before


def test_its_energy_is_that_of_what_is_stepped(made: Callable[..., Any]) -> None:
    """With the cursor's spring, and weights as they are now, from the heights at which the scene's masses start."""
    hung = with_cursor(SYSTEM, 1, np.array([1.0, -0.5])).with_parameter("gravity", (0.0, -2.0))
    hook = hung.positions[-1]
    state = on_hook(replace(SYSTEM.start, positions=SYSTEM.positions + np.array([0.0, 0.25])), hook)
    lane, _, _ = made(hung, state)
    begin = np.vstack([SYSTEM.positions, [0.0, 0.0]])
    assert lane.energy == pytest.approx(energy(hung, state, begin))
    length = np.linalg.norm(hook - state.positions[1])
    elastic = 0.5 * hung.stiffness[-1] * (length - hung.rest_lengths[-1]) ** 2
    assert lane.energy == pytest.approx(elastic + 2.0 * (3.5 * 0.25 + 2.0 * hook[1]))


def test_the_largest_mass_and_stiffness_there_are_now_count(made: Callable[..., Any]) -> None:
    """Of unequal ones, and gravity as it is: each may give a system more energy than it began with."""
    lane, _, _ = made()
    assert lane._changed() == [
        Change(0.0, "mass", 2.0),
        Change(0.0, "stiffness", 400.0),
        Change(0.0, "gravity", (0.5, -3.0)),
    ]


def test_what_is_said_of_a_lane_that_has_stopped(made: Callable[..., Any]) -> None:
    """Of a blow-up also what theory makes of its dt, where that is known."""
    lane, _, _ = made()
    lane.stopped, known = "it is over", {"heun": Prediction(0.05, "", 1.0, "heun")}
    assert notice_of(lane, known) == "heun stopped: it is over."
    lane.blown_up = True
    assert notice_of(lane, {}) == "heun blew up: it is over."
    said = notice_of(lane, known)
    assert said.startswith("heun blew up: it is over. dt = 100 ms is 2 times the predicted largest stable dt, 50 ms.")


def test_the_distance_is_that_of_the_mass_that_is_farthest_off() -> None:
    """Across both axes."""
    moved = SYSTEM.positions + np.array([[0.0, 0.1], [3.0, 4.0], [4.5, 0.0]])
    assert distance(SYSTEM.start, replace(SYSTEM.start, positions=moved)) == pytest.approx(5.0)
