"""Costs: times by a clock that the tests wind, errors by the true motion."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.engine import version
from engines.process.isolation import EngineStepper
from experiments import cost
from experiments.cost import ANCHOR, DTS, MASSES, Cost, Point
from experiments.runs import timing
from experiments.runs.environment import processor
from experiments.runs.timing import Speeds, Timing
from reference.compiled.kernels import advance, arrays_of
from reference.compiled.loops import Loops
from reference.errors import Unsupported
from reference.forces import SpringMotion
from reference.outcome import Outcome
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from report.figures import draw
from tests import wrong
from tests.conformance.doctored import Doctored, KickDrift
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.reference.systems import label


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


STRINGS = [find_scene("string").system({"masses": n}) for n in (2, 4, 8, 16)]


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


def points_of(scheme: Scheme) -> list[Point]:
    """Its runs with all of DTS, in no time."""
    ends = [advance(cost.string(), scheme, dt, round(cost.DURATION / dt)).positions for dt in DTS]
    return cost.points([Timing(0.0, end) for end in ends], SpringMotion)


def check_order(scheme: Scheme) -> None:
    """Between the two smallest steps the error falls as dt to the order.

    The next term of the error is of relative size dt w, w = 4 1/s for the swings that matter: 0.05 is ample.
    """
    *_, larger, smaller = points_of(scheme)
    assert np.log2(larger.error / smaller.error) == pytest.approx(scheme.order, abs=0.05)


@pytest.mark.parametrize("name", ["kick_drift", "drift_kick", "heun", "velocity_verlet", "rk4"])
def test_errors_fall_with_dt_as_the_order_says(name: str) -> None:
    """E(dt) / E(dt/2) = 2^order. Explicit Euler is left out: at these steps it grows, as it should."""
    check_order(find(name))


@pytest.mark.parametrize(
    "scheme",
    [
        wrong.heun_without_half,
        wrong.heun_of_the_wrong_pair,
        wrong.verlet_with_one_force,
        wrong.rk4_equally_weighted,
        wrong.kick_drift_kicked_twice,
    ],
    ids=label,
)
def test_the_order_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """They lose an order, or converge to nothing."""
    with pytest.raises(AssertionError):
        check_order(scheme)


def test_who_has_blown_up_has_no_error() -> None:
    """Euler at dt = 8 ms is beyond all bounds; at 0.5 ms it is not."""
    first, *_, last = points_of(find("euler"))
    assert first.error == np.inf
    assert last.error < 1e-2


def test_rigid_segments_are_compared_with_rods() -> None:
    """The pendulum's own end has no error; taken for a string of springs it is over a centimetre off."""
    end = cost.truth(PendulumMotion)
    timings = [Timing(0.0, end)] * len(DTS)
    assert {p.error for p in cost.points(timings, PendulumMotion)} == {0.0}
    assert min(p.error for p in cost.points(timings, SpringMotion)) > 1e-2


def test_the_kernel_that_is_timed_takes_the_steps_it_is_told_to(monkeypatch: pytest.MonkeyPatch) -> None:
    """In 3 and 4 steps it leaves the bits of `kernels.advance` in 7; in 6 it does not."""
    arrays: dict[str, Any] = {}

    def keep(system: MassSpringSystem, loops: Loops) -> dict[str, Any]:
        arrays.update(arrays_of(system, loops))
        return arrays

    monkeypatch.setattr(cost, "arrays_of", keep)
    run = cost.kernel(cost.string(), find("heun"), 1e-3)
    run(3)
    run(4)
    seven, six = (advance(cost.string(), find("heun"), 1e-3, n, threads=1).positions[:, 0] for n in (7, 6))
    assert arrays["x0"].tolist() == seven.tolist()
    assert arrays["x0"].tolist() != six.tolist()


def made_up(name: str, seconds: float, error: float, runs_as: str = "kernel", identified_as: str | None = None) -> Cost:
    """A stepper whose steps all take so long [s], and whose runs all have that error [m]."""
    found = [Point(dt, round(cost.DURATION / dt) * seconds, error) for dt in DTS]
    return Cost(catalogued()[name], runs_as, identified_as or name, found, Speeds([seconds] * len(MASSES)))


def test_findings_are_made_from_the_costs() -> None:
    """An engine 30 times as slow as the anchor, off its scheme by 1 %; without it, that is what is said."""
    costs = [made_up(ANCHOR, 1e-7, 1e-2), made_up("heun", 2e-7, 1e-4)]
    alone = " ".join(cost.result_of(costs).findings)
    assert "takes the kick_drift kernel 100 ns" in alone
    assert "No engine ran." in alone
    assert "The cheapest scheme that ends within 0.001 m of the truth is heun, with dt = 0.008 s: 0.012 ms" in alone
    assert "cheapest engine" not in alone
    slow = made_up("drift_kick", 3e-6, 1.01e-2, "engine", ANCHOR)
    result = cost.result_of([*costs, slow])
    both = " ".join(result.findings)
    assert "With 1000 masses engines take 30 (drift_kick) to 30 (drift_kick) times as long" in both
    assert "to 1e-02 of them over 5 runs" in both
    assert result.tables[0].rows[2][4] == pytest.approx(30)
    assert processor() in result.tables[0].rows[0]


def test_an_engine_that_crashes_or_is_not_there_is_a_failure_and_not_drawn() -> None:
    """With its reason; the figure shows the others."""
    crashed = cost.engine(EngineStepper(Misbehaving(Segfaults)))
    absent = cost.engine(EngineStepper(Misbehaving(Segfaults, package="no-such-engine")))
    result = cost.result_of([made_up(ANCHOR, 1e-7, 1e-2), crashed, absent])
    assert "SIGSEGV" in result.failures[0]
    assert result.failures[1] == "Segfaults: unsupported, no-such-engine is not installed"
    picture = draw("cost", result)
    assert "kick_drift" in picture.alt
    assert "Segfaults" not in picture.alt


@pytest.mark.parametrize(("name", "scheme"), [("pymunk_springs", "drift_kick"), ("mujoco_tendons_rk4", "rk4")])
def test_an_engine_ends_where_its_scheme_does(name: str, scheme: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error is the scheme's to 1e-4 of it (rounding, against errors down to 1e-9 m), and no other scheme's."""
    engine = find_engine(name)
    if version(engine) is None:
        pytest.skip(f"{engine.package} is not installed")
    monkeypatch.setattr(cost, "MASSES", (10,))
    errors = [p.error for p in cost.engine(EngineStepper(engine)).points]
    assert errors == pytest.approx([p.error for p in points_of(find(scheme))], rel=1e-4)
    assert errors != pytest.approx([p.error for p in points_of(find("kick_drift"))], rel=1e-4)
