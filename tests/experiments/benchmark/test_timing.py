"""Wall times, by a clock that the tests wind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import cycle

import numpy as np
import pytest

from experiments.benchmark import timing
from experiments.benchmark.timing import Speeds, Timing
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.scenes import find
from reference.system import MassSpringSystem
from tests.conformance.doctored import Doctored, KickDrift


class Clock:
    """A clock that only goes on when it is told to."""

    now = 0.0

    def __call__(self) -> float:
        """The time [s]."""
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """The clock by which everything is timed."""
    made = Clock()
    monkeypatch.setattr(timing, "perf_counter", made)
    return made


@dataclass(frozen=True)
class Clocked(Doctored):
    """Kick-drift whose start and steps take a time that grows with the masses: start [s], step [s] times n^power."""

    clock: Clock = field(default_factory=Clock)
    start_takes: float = 1e-3
    step_takes: float = 1e-4
    power: float = 1.0

    def start(self, system: MassSpringSystem, dt: float) -> KickDrift:
        """Take the time to start; hand out what takes its time to step."""
        self.clock.now += self.start_takes
        takes = self.step_takes * (len(system.masses) - 1) ** self.power
        clock, simulation = self.clock, KickDrift(system, dt)
        step = simulation.step

        def slow() -> None:
            clock.now += takes
            step()

        simulation.step = slow  # type: ignore[method-assign]
        return simulation


STRINGS = [find("string").system({"masses": n}) for n in (2, 4, 8, 16)]


def costs_of(engine: Clocked) -> tuple[list[Timing], Speeds]:
    """Two runs of the string of two, and the speeds of all strings."""
    answer = timing.engine_cost(engine, STRINGS[0], [(1e-3, 5), (5e-4, 10)], STRINGS, 1e-3)
    assert not isinstance(answer, Outcome)
    return answer


def check_times(engine: Clocked, clock: Clock) -> None:
    """A run of 5 and of 10 steps of two masses, and a step of 2, 4, 8, 16: what the steps took, and only that."""
    timings, speeds = costs_of(replace(engine, clock=clock))
    assert [t.seconds for t in timings] == pytest.approx([5 * 2e-4, 10 * 2e-4], rel=1e-9)
    assert list(speeds.seconds) == pytest.approx([2e-4, 4e-4, 8e-4, 16e-4], rel=1e-9)
    assert speeds.reason == ""


def test_only_the_steps_are_timed(clock: Clock) -> None:
    """However long a start takes, up to what is too long."""
    check_times(Clocked(), clock)
    check_times(Clocked(start_takes=0.4), clock)


def test_timing_fails_where_the_start_is_timed_too(clock: Clock, monkeypatch: pytest.MonkeyPatch) -> None:
    """As it would be if steps were started lazily: the first of them takes the start's time."""

    def lazily(engine: Clocked, system: MassSpringSystem, dt: float, steps: int) -> Timing:
        def start_and_step() -> None:
            for _ in range(steps):
                engine.start(system, dt).step()

        return Timing(timing.seconds_of(start_and_step), system.positions)

    monkeypatch.setattr(timing, "_engine_run", lazily)
    with pytest.raises(AssertionError):
        check_times(Clocked(), clock)


def test_a_time_is_the_least_of_what_a_busy_machine_gives(clock: Clock) -> None:
    """Every second call is interrupted for 3 ms: the others are what counts."""
    calls = 0

    def advance_steps(steps: int) -> None:
        nonlocal calls
        calls += 1
        clock.now += 1e-4 * steps + 3e-3 * (calls % 2)

    assert timing.seconds_per_step(advance_steps) == pytest.approx(1e-4, rel=1e-9)


def test_a_step_through_the_adapter_and_the_engines_own_are_told_in_this_order(clock: Clock) -> None:
    """One takes 3 ms and the other 2 ms: what the adapter adds is half of the engine's own step."""

    class Covered(KickDrift):
        def step(self) -> None:
            clock.now += 3e-3

        def bare_step(self) -> Callable[[], object]:
            return lambda: clock.__setattr__("now", clock.now + 2e-3)

    class Adapter(Doctored):
        def start(self, system: MassSpringSystem, dt: float) -> KickDrift:
            return Covered(system, dt)

    assert timing.adapter_overhead(Adapter(), STRINGS[0], 1e-3) == pytest.approx((3e-3, 2e-3), rel=1e-9)


def test_strings_that_would_take_too_long_are_not_tried(clock: Clock) -> None:
    """A step takes 2e-3 n^3 s: 16 ms, 128 ms, and of 8 masses it would be 1 s."""
    speeds = costs_of(Clocked(clock=clock, step_takes=2e-3, power=3.0))[1]
    assert list(speeds.seconds) == pytest.approx([0.016, 0.128], rel=1e-9)
    assert speeds.reason == "the next start or step, of 8 masses, would take some 1 s"


def test_what_an_engine_cannot_do_is_an_outcome_with_its_reason() -> None:
    """Unsupported, not crashed."""

    class Refuses(Doctored):
        def start(self, system: MassSpringSystem, dt: float) -> KickDrift:
            raise Unsupported("no strings today")

    assert timing.engine_cost(Refuses(), STRINGS[0], [(1e-3, 5)], STRINGS, 1e-3) == Outcome(
        "unsupported", "no strings today"
    )


def taking(clock: Clock, *seconds: float) -> Callable[[], Timing]:
    """A run whose tries take so long [s], each, and then again from the first; its masses end where its number says."""
    tries = cycle(enumerate(seconds))

    def run() -> Timing:
        which, takes = next(tries)
        clock.now += takes
        return Timing(takes, np.full((1, 2), float(which)))

    return run


def test_the_quickest_try_of_each_run_is_kept_with_its_end(clock: Clock) -> None:
    """The third of one, the second of the other."""
    one, other = timing.least([taking(clock, 3e-4, 2e-4, 1e-4, 4e-4), taking(clock, 8e-4, 6e-4, 7e-4)])
    assert (one.seconds, other.seconds) == (1e-4, 6e-4)
    assert (one.positions[0, 0], other.positions[0, 0]) == (2.0, 1.0)


def test_a_run_that_has_had_its_time_is_not_tried_again(clock: Clock) -> None:
    """Others are: the first takes all of it, the second a third, the last is tried as often as any may be."""
    calls = [0, 0, 0]

    def counted(i: int, takes: float) -> Callable[[], Timing]:
        def run() -> Timing:
            calls[i] += 1
            return Timing(takes, np.zeros((1, 2)))

        return run

    timing.least([counted(i, takes) for i, takes in enumerate((timing.BUDGET, 0.34 * timing.BUDGET, 1e-9))])
    assert calls == [1, 3, timing.TRIES]


@pytest.mark.parametrize(("takes", "tries"), [(0.2, 1), (4e-3, 4), (1.1e-3, timing.TRIES)])
def test_a_step_is_timed_some_times_and_not_for_ever(takes: float, tries: int, clock: Clock) -> None:
    """One step alone is long enough here: after two calls that do not count, until TRIES or the BUDGET is used up."""
    calls = 0

    def advance(steps: int) -> None:
        nonlocal calls
        calls += 1
        clock.now += takes * steps

    assert timing.seconds_per_step(advance) == pytest.approx(takes)
    assert calls == 2 + tries


def test_a_run_ends_where_its_masses_are(clock: Clock) -> None:
    """Not with their velocities; after as many steps as are asked for."""
    found = timing._engine_run(Clocked(clock=clock), STRINGS[0], 1e-3, 5)
    simulation = KickDrift(STRINGS[0], 1e-3)
    for _ in range(5):
        simulation.step()
    assert np.array_equal(found.positions, simulation.state()[0])


@pytest.mark.parametrize(("takes", "steps"), [(2e-4, 100), (8e-3, 10)])
def test_what_interrupts_a_step_is_no_part_of_it(takes: float, steps: int, clock: Clock) -> None:
    """Every third try is interrupted; a try is of 20 ms of the engine's own steps, ten of them at least."""
    calls = 0

    class Interrupted(KickDrift):
        def step(self) -> None:
            nonlocal calls
            calls += 1
            clock.now += 3e-3 + (1e-3 if calls % (3 * steps) == 0 else 0.0)

        def bare_step(self) -> Callable[[], object]:
            return lambda: clock.__setattr__("now", clock.now + takes)

    class Adapter(Doctored):
        def start(self, system: MassSpringSystem, dt: float) -> KickDrift:
            return Interrupted(system, dt)

    assert timing.adapter_overhead(Adapter(), STRINGS[0], 1e-3) == pytest.approx((3e-3, takes), rel=1e-9)
    assert calls == 25 * steps
