"""Who may step a lane, which scheme theory knows them as, and what becomes of a scheme that comes to no number."""

from __future__ import annotations

import threading
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.process.session import EngineStopped
from reference.errors import SolverError
from reference.obstacles import Plane
from reference.outcome import Outcome
from reference.scenes import find
from reference.schemes import catalogue
from reference.state import State
from reference.system import MassSpringSystem
from report.live import stepping
from report.live.stepping import NEEDED, EngineStepping, SchemeStepping, Stopped, choices, moved, scheme_behind

STRING = find("string").system({"masses": 3})
FALLING = replace(STRING, gravity=np.array([0.0, -2.0]), fixed=np.zeros(4, bool), drag=0.0)


def an_engine(name: str, needed: frozenset[str] = NEEDED) -> Any:
    """One that can so much, and is another scheme in each case."""
    schemes = {"plain": "drift_kick", "damping": "drift_kick_sequential_damping", "drag": "kick_drift_implicit_drag"}
    return SimpleNamespace(name=name, capabilities=needed, identified_as=schemes)


@pytest.fixture
def engines(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is able, one that can more, one that cannot begin in motion, one that is not installed."""
    known = {
        engine.name: engine
        for engine in (
            an_engine("able"),
            an_engine("more", NEEDED | {"3d"}),
            an_engine("at_rest_only", NEEDED - {"velocities"}),
            an_engine("missing"),
        )
    }
    monkeypatch.setattr(stepping, "registry", lambda: known)
    monkeypatch.setattr(stepping, "find", known.__getitem__)
    monkeypatch.setattr(stepping, "version", lambda engine: None if engine.name == "missing" else "1.0")


@pytest.mark.usefixtures("engines")
def test_lanes_are_stepped_by_schemes_and_by_engines_that_begin_in_motion() -> None:
    """Such as are installed; schemes first."""
    schemes = [*catalogue.schemes()]
    assert choices()[: len(schemes)] == schemes
    assert [name for name in choices()[len(schemes) :] if not name.endswith((".py", ".c"))] == ["able", "more"]


@pytest.mark.usefixtures("engines")
def test_an_engine_is_the_scheme_of_its_case() -> None:
    """Springs that are damped, or else drag, or neither; a scheme is itself."""
    for damping, drag, wanted in (
        (0.0, 0.0, "drift_kick"),
        (0.1, 0.0, "drift_kick_sequential_damping"),
        (0.0, 0.1, "kick_drift_implicit_drag"),
        (0.1, 0.1, "drift_kick_sequential_damping"),
    ):
        system = STRING.with_parameter("drag", drag).with_parameter("damping", (0.0, damping, 0.0))
        assert scheme_behind("able", system).name == wanted
        assert scheme_behind("heun", system).name == "heun"


def test_a_scheme_steps_as_it_is_written_and_keeps_its_time() -> None:
    """By kick-drift in free fall: v = g t at the end, x a little ahead; a change counts from the next step on."""
    made = SchemeStepping(catalogue.find("kick_drift"), FALLING, replace(FALLING.start, time=1.0), 0.1)
    made.advance(2)
    made.change("gravity", (0.0, -4.0))
    state = made.advance(1)
    assert state.time == pytest.approx(1.3)
    assert state.velocities == pytest.approx(np.tile([0.0, -0.8], (4, 1)))
    assert state.positions - FALLING.positions == pytest.approx(np.tile([0.0, -0.02 - 0.04 - 0.08], (4, 1)))
    made.end()


@pytest.mark.parametrize("error", [SolverError("no root"), np.linalg.LinAlgError("no root")])
def test_what_finds_no_solution_stops(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    """With its words."""

    def fails(*_: object) -> State:
        raise error

    monkeypatch.setattr(stepping, "step_of", lambda scheme, motion: fails)
    with pytest.raises(Stopped, match="no root"):
        SchemeStepping(catalogue.find("heun"), STRING, STRING.start, 0.1).advance(1)


def test_no_step_is_made_from_a_number_that_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """One of them is enough; the time is that which was asked for."""
    made: list[float] = []

    def step(state: State, dt: float) -> State:
        made.append(dt)
        positions = state.positions.copy()
        positions[2, 1] = np.nan if len(made) == 3 else 0.0
        return replace(state, positions=positions)

    monkeypatch.setattr(stepping, "step_of", lambda scheme, motion: step)
    state = SchemeStepping(catalogue.find("heun"), STRING, STRING.start, 0.1).advance(10)
    assert made == [0.1] * 3
    assert state.time == pytest.approx(1.0)


def test_loops_take_over_once_they_are_ready_and_are_made_anew_after_a_change(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the state there is, on one core; they are not asked for while there are some."""
    asked, made = [False, True, True], []

    class Loops:
        """Made of a system at a state; moves it by 1 m for each step."""

        def __init__(self, system: MassSpringSystem, scheme: object, threads: int) -> None:
            made.append((system, threads))
            self.x = system.positions

        def advance(self, dt: float, steps: int) -> None:
            """All at once."""
            assert dt == 0.1
            self.x = self.x + steps

        def state(self) -> tuple[Any, Any]:
            """Positions and velocities."""
            return self.x, 0 * self.x

    monkeypatch.setattr(stepping._COMPILED, "ready", lambda scheme, system: asked.pop(0))
    monkeypatch.setattr(stepping, "Kernel", Loops)
    lane = SchemeStepping(catalogue.find("kick_drift"), FALLING, FALLING.start, 0.1)
    before = lane.advance(1)
    assert made == []
    lane.advance(2)
    assert lane.advance(3).positions == pytest.approx(before.positions + 5)
    assert [(threads, np.array_equal(system.positions, before.positions)) for system, threads in made] == [(1, True)]
    lane.change("mass", 0.5)
    state = lane.advance(1)
    assert state.positions == pytest.approx(before.positions + 6)
    assert state.time == pytest.approx(0.7)
    assert made[1][0].masses.tolist() == [0.5] * 4
    assert asked == []


def test_loops_are_compiled_in_a_thread_that_keeps_nobody_from_ending(monkeypatch: pytest.MonkeyPatch) -> None:
    """Once, however often they are asked for."""
    begun: list[Any] = []

    def thread(target: Any, args: tuple[Any, ...], daemon: bool) -> Any:
        begun.append((target, args))
        assert daemon
        return SimpleNamespace(start=lambda: None)

    monkeypatch.setattr(stepping, "threading", SimpleNamespace(Thread=thread, Lock=threading.Lock))
    monkeypatch.setattr(stepping, "Kernel", lambda *_, threads: SimpleNamespace(advance=lambda dt, steps: None))
    compiled, scheme = stepping._Compiled(), catalogue.find("kick_drift")
    assert [compiled.ready(scheme, STRING) for _ in range(3)] == [False] * 3
    ((target, args),) = begun
    target(*args)
    assert compiled.ready(scheme, STRING)


class Engine:
    """In place of a session with an engine: kept as it was asked for."""

    def __init__(self, *given: Any) -> None:
        self.given, self.ended, self.fails = given, False, ""
        Engine.last = self

    last: Engine

    def advance(self, steps: int) -> tuple[Any, Any]:
        """Every mass at as many metres, at twice the speed."""
        if self.fails:
            raise EngineStopped(Outcome("crashed", self.fails))
        return np.full((4, 2), float(steps)), np.full((4, 2), 2.0 * steps)

    def change(self, parameter: str, value: Any) -> None:
        """As it was asked for."""
        if self.fails:
            raise EngineStopped(Outcome("unsupported", self.fails))
        self.changed = parameter, value

    def end(self) -> None:
        """It is."""
        self.ended = True


def test_an_engine_steps_in_its_session(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the state it is given; its endings are the lane's, in one line."""
    monkeypatch.setattr(stepping, "Session", Engine)
    begin = State(0.5, STRING.positions + 0.25, STRING.velocities + 1.0)
    made = EngineStepping(an_engine("able"), STRING, begin, 0.1)
    _, system, dt = Engine.last.given
    assert (system.positions.tolist(), dt) == (begin.positions.tolist(), 0.1)
    assert system.velocities.tolist() == [[0, 0], [1, 1], [1, 1], [1, 1]]
    state = made.advance(3)
    assert (state.time, state.positions[1, 0], state.velocities[1, 0]) == (pytest.approx(0.8), 3.0, 6.0)
    assert made.advance(1).time == pytest.approx(0.9)
    made.change("mass", 0.5)
    assert Engine.last.changed == ("mass", 0.5)
    Engine.last.fails = "SIGSEGV"
    with pytest.raises(Stopped, match=r"^crashed: SIGSEGV$"):
        made.advance(1)
    with pytest.raises(Stopped, match=r"^unsupported: SIGSEGV$"):
        made.change("mass", 0.5)
    made.end()
    assert Engine.last.ended


def test_a_state_is_pushed_out_of_obstacles_and_what_is_fixed_is_at_rest() -> None:
    """What no number is stops it."""
    floor = replace(STRING, obstacles=(Plane((0.0, -0.1), (0.0, 1.0)),))
    state = State(0.0, STRING.positions - np.array([0.0, 0.3]), STRING.velocities + np.array([1.0, -1.0]))
    pushed = moved(floor, state)
    assert pushed.positions[1:, 1] == pytest.approx([-0.1] * 3)
    assert pushed.velocities[0].tolist() == [0, 0]
    assert (pushed.velocities[1:, 1] >= 0).all()
    free = moved(STRING, state)
    assert free.positions.tolist() == state.positions.tolist()
    assert free.velocities.tolist() == [[0, 0], *state.velocities[1:].tolist()]
    with pytest.raises(Stopped, match="positions"):
        moved(STRING, replace(state, positions=np.full((4, 2), np.nan)))
