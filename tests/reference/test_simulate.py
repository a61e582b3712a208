"""Runs: their times, their end, and parameters that change on the fly (slide 12)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.changes import Change, changes_by_step, whole_steps
from reference.errors import InputError
from reference.motion import MotionOfSprings
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import State, Trajectory
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import label, moving_string, property_test, with_fields

ALL = list(schemes().values())

# --- Steps and times ---


def test_a_run_is_its_steps() -> None:
    """The start, then every step after the one before, at times that are multiples of dt to the bit."""
    system = moving_string(3)
    run = simulate(system, find("heun"), 1e-3, 0.007)
    assert simulate(system, find("heun"), 1e-3, 0.1).times.tolist() == [i * 1e-3 for i in range(101)]
    assert run.positions[0].tolist() == system.positions.tolist()
    again = simulate(
        replace(system, positions=run.positions[3], velocities=run.velocities[3]), find("heun"), 1e-3, 0.004
    )
    assert again.positions.tolist() == run.positions[3:].tolist()
    assert again.velocities.tolist() == run.velocities[3:].tolist()


@pytest.mark.parametrize(
    ("dt", "duration", "steps"),
    [
        (1e-3, 0.5, 500),
        (0.1, 0.3, 3),
        (0.1, 0.349, 3),
        (0.1, 0.351, 4),
        (0.1, 0.06, 1),
        (1 / 3, 1.0, 3),
        (1e-7, 1.0, 10_000_000),
        (1e-100, 1e-99, 10),
        (1e99, 1e100, 10),
    ],
)
def test_the_nearest_whole_number_of_steps_is_taken(dt: float, duration: float, steps: int) -> None:
    """0.3/0.1 is 2.9999999999999996 on a computer."""
    assert whole_steps(dt, duration) == steps


@pytest.mark.parametrize(
    ("dt", "duration", "message"),
    [
        (0.0, 1.0, "dt = 0: expected a finite number > 0 [s]"),
        (-1e-3, 1.0, "dt = -0.001: expected a finite number > 0 [s]"),
        (float("nan"), 1.0, "dt = nan: expected a finite number > 0 [s]"),
        (float("inf"), 1.0, "dt = inf: expected a finite number > 0 [s]"),
        (1e-3, 0.0, "duration = 0: expected a finite number > 0 [s]"),
        (1e-3, float("nan"), "duration = nan: expected a finite number > 0 [s]"),
        (1e-3, -2.0, "duration = -2: expected a finite number > 0 [s]"),
        (1.0, 0.4, "duration = 0.4: expected at least one step of dt = 1 s"),
        (1e-7, 1.0000001, "duration = 1: expected at most 10,000,000 steps of dt = 1e-07 s"),
        (0.99e-100, 1.0, "dt = 9.9e-101: expected a number from 1e-100 to 1e+100 [s]"),
        (1.0, 1.01e100, "duration = 1.01e+100: expected a number from 1e-100 to 1e+100 [s]"),
    ],
)
def test_steps_that_make_no_sense_are_refused(dt: float, duration: float, message: str) -> None:
    """One line that names the value, from `whole_steps` and from a run."""
    with pytest.raises(InputError) as refused:
        whole_steps(dt, duration)
    assert str(refused.value) == message
    with pytest.raises(InputError):
        simulate(moving_string(1), find("heun"), dt, duration)


def test_a_run_ends_at_the_first_state_that_is_not_finite() -> None:
    """That state is kept, so that the end can be seen, and no warning is given."""
    run = simulate(find_scene("string").system({}), find("rk4"), 1.0, 100.0)
    assert len(run) < 101
    assert np.isfinite(run.positions[:-1]).all()
    assert not (np.isfinite(run.positions[-1]).all() and np.isfinite(run.velocities[-1]).all())


def test_a_run_through_a_spring_of_no_length_ends_and_raises_nothing() -> None:
    """In-place Euler at dt = 0.3 s overflows until two masses meet in floating-point numbers."""
    run = simulate(find_scene("string").system({}), find("euler_in_place"), 0.3, 120.0)
    assert len(run) < 401


# --- Changes on the fly ---


def test_a_change_acts_from_the_first_step_that_begins_then_or_later() -> None:
    """Within 1e-9 of a step's start it is that start; in order of time; at a time beyond all runs in none of them."""
    times = {0.0: 0, 0.2: 2, 0.2 + 0.9e-10: 2, 0.2 + 1.1e-10: 3, 0.21: 3, 1e300: 20_000_000}
    assert {time: Change(time, "drag", 0.0).step(0.1) for time in times} == times
    late, early, same = Change(0.29, "mass", 1.0), Change(0.1, "drag", 2.0), Change(0.3, "drag", 3.0)
    assert changes_by_step([same, late, early], 0.1) == {1: [early], 3: [late, same]}


@pytest.mark.parametrize("time", [-1e-9, np.inf, np.nan, -np.inf])
def test_a_change_at_no_time_is_refused(time: float) -> None:
    """In a line."""
    with pytest.raises(InputError, match=f"change time = {time:g}: expected a finite number >= 0"):
        changes_by_step([Change(0.0, "mass", 1.0), Change(time, "drag", 1.0)], 0.1)


#: Runs a system with changes: the right way, or wrong ones.
Runner = Callable[[MassSpringSystem, Scheme, float, float, list[Change]], Trajectory]

VALUES = {"mass": 0.05, "rest_length": 0.2, "stiffness": 80.0, "damping": 0.3, "drag": 0.2, "gravity": 1.6}


def check_glued(run: Runner, scheme: Scheme, parameter: str, value: float, step: int) -> None:
    """A change at step k gives, to the bit, the run until then, and a run from there of the changed system."""
    system, dt, steps = moving_string(3, damping=0.05), 1e-3, 12
    changed = run(system, scheme, dt, steps * dt, [Change(step * dt, parameter, value)])
    before = simulate(system, scheme, dt, steps * dt).positions[: step + 1]
    positions, velocities = (
        getattr(simulate(system, scheme, dt, steps * dt), n)[step] for n in ("positions", "velocities")
    )
    later = replace(system, positions=positions, velocities=velocities).with_parameter(parameter, value)
    after = simulate(later, scheme, dt, (steps - step) * dt).positions[1:]
    assert changed.positions.tolist() == np.concatenate([before, after]).tolist()


@pytest.mark.parametrize("scheme", [s for s in ALL if s.one_step], ids=label)
def test_a_change_is_two_runs_glued_together(scheme: Scheme) -> None:
    """Whatever the scheme: stiffness falls after five steps."""
    check_glued(simulate, scheme, "stiffness", 80.0, 5)


@property_test
@given(parameter=st.sampled_from(sorted(VALUES)), step=st.integers(0, 11))
def test_every_parameter_can_change_at_every_step(parameter: str, step: int) -> None:
    """From the first step on to the last one."""
    check_glued(simulate, find("heun"), parameter, VALUES[parameter], step)


def shifted(steps: int) -> Runner:
    """A runner whose changes come so many steps late."""

    def run(system: MassSpringSystem, scheme: Scheme, dt: float, duration: float, changes: list[Change]) -> Trajectory:
        late = [replace(c, time=c.time + steps * dt) for c in changes]
        return simulate(system, scheme, dt, duration, late)

    return run


def deaf(system: MassSpringSystem, scheme: Scheme, dt: float, duration: float, changes: list[Change]) -> Trajectory:
    """Ignores changes."""
    return simulate(system, scheme, dt, duration)


def from_the_start(
    system: MassSpringSystem, scheme: Scheme, dt: float, duration: float, changes: list[Change]
) -> Trajectory:
    """Makes changes before the first step."""
    for change in changes:
        system = system.with_parameter(change.parameter, change.value)
    return simulate(system, scheme, dt, duration)


@pytest.mark.parametrize("run", [shifted(1), shifted(-1), deaf, from_the_start])
@pytest.mark.parametrize("parameter", VALUES)
def test_glued_runs_fail_where_changes_come_at_another_time(run: Runner, parameter: str) -> None:
    """A step late, a step early, never, or at once: each is seen, for each parameter."""
    with pytest.raises(AssertionError):
        check_glued(run, find("heun"), parameter, VALUES[parameter], 5)


def test_glued_runs_fail_on_a_wrong_scheme() -> None:
    """A run by another scheme than that of its parts is not their sum."""
    with pytest.raises(AssertionError):
        check_glued(
            lambda system, _, dt, duration, changes: simulate(
                system, wrong.heun_of_the_wrong_pair, dt, duration, changes
            ),
            find("heun"),
            "drag",
            0.2,
            5,
        )


def check_decay(scheme: Scheme) -> None:
    """Drag switched on at 0.1 s on free masses without forces: v = v0, then v0 (1 - dt Cd/m)^n, by Euler."""
    system = with_fields(
        moving_string(1, gravity=0.0, stiffness=0.0), fixed=False, velocities=np.array([[1.0, 2.0], [3.0, -1.0]])
    )
    run = simulate(system, scheme, 0.01, 0.2, [Change(0.1, "drag", 0.05)])
    steps_with_drag = np.maximum(0, np.arange(21) - 10)
    expected = (1 - 0.01 * 0.05 / 0.02) ** steps_with_drag[:, None, None] * system.velocities
    assert np.abs(run.velocities - expected).max() < 1e-14


def test_drag_switched_on_slows_from_then_on() -> None:
    """Slide 12 turns damping on and off while the string moves."""
    check_decay(find("euler"))


@pytest.mark.parametrize(
    "scheme",
    [
        wrong.heun_without_half,
        wrong.kick_drift_kicked_twice,
        wrong.kick_drift_gaining_energy,
        wrong.last_mass_forgotten,
        wrong.stepped(wrong.damping_turned, find("euler")),
    ],
    ids=label,
)
def test_decay_fails_on_wrong_schemes(scheme: Scheme) -> None:
    """None slows the masses so."""
    with pytest.raises(AssertionError):
        check_decay(scheme)


@pytest.mark.parametrize(
    ("time", "step"), [(0.0, 0), (0.1, 1), (0.3, 3), (0.3 + 1e-12, 3), (0.31, 4), (0.39, 4), (0.4, 4)]
)
def test_a_change_acts_on_the_first_step_that_begins_then_or_later(time: float, step: int) -> None:
    """Between two steps' starts it waits for the later; 3 * 0.1 counts as 0.3, whatever its last bit."""
    assert Change(time, "drag", 1.0).step(0.1) == step
    assert Change(3 * 0.1, "drag", 1.0).step(0.1) == 3


def test_changes_take_effect_in_order_of_time() -> None:
    """Given in any order. Of two at the same time the one given later holds, of two in one step the later one."""
    system = moving_string(2)
    late, early, later = Change(0.002, "drag", 0.5), Change(0.001, "drag", 0.1), Change(0.002, "drag", 0.9)
    assert changes_by_step((late, early, later), 1e-3) == {1: [early], 2: [late, later]}
    one = simulate(system, find("euler"), 1e-3, 0.005, [late, early, later])
    other = simulate(system, find("euler"), 1e-3, 0.005, [early, later])
    assert one.positions.tolist() == other.positions.tolist()
    second, first = Change(0.0019, "drag", 0.1), Change(0.0011, "drag", 0.5)
    assert changes_by_step((second, first), 1e-3) == {2: [first, second]}


def test_changes_at_or_after_the_end_change_nothing() -> None:
    """There is no step for them to act on."""
    system = moving_string(2)
    plain = simulate(system, find("heun"), 1e-3, 0.005)
    late = simulate(system, find("heun"), 1e-3, 0.005, [Change(0.005, "drag", 0.5), Change(9.0, "mass", 1.0)])
    assert late.positions.tolist() == plain.positions.tolist()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (Change(0.001, "drgg", 0.1), "unknown parameter 'drgg': did you mean 'drag'?"),
        (Change(0.001, "masses", 0.1), "unknown parameter 'masses': did you mean 'mass'?"),
        (Change(0.001, "drag", -0.1), "drag = -0.1: expected a number >= 0 [N s/m]"),
        (Change(0.001, "mass", 0.0), "mass = 0: expected a number > 0 [kg]"),
        (Change(0.001, "stiffness", float("nan")), "stiffness = nan: expected a finite number [N/m]"),
        (Change(-0.001, "drag", 0.1), "change time = -0.001: expected a finite number >= 0 [s]"),
        (Change(float("nan"), "drag", 0.1), "change time = nan: expected a finite number >= 0 [s]"),
        (Change(float("inf"), "drag", 0.1), "change time = inf: expected a finite number >= 0 [s]"),
    ],
)
def test_changes_that_make_no_sense_are_refused(change: Change, message: str) -> None:
    """In one line."""
    with pytest.raises(InputError) as refused:
        simulate(moving_string(2), find("heun"), 1e-3, 0.005, [change])
    assert str(refused.value) == message


@pytest.mark.parametrize(("parameter", "value"), [("mass", 0.05), ("drag", 0.2), ("gravity", 1.6)])
def test_rods_change_their_masses_drag_and_gravity(parameter: str, value: float) -> None:
    """A pendulum's angles go on from where they are, under the other equations."""
    system = find_scene("string").system({"masses": 3, "drag": 0.1})
    changes = [Change(0.005, parameter, value)]
    changed = simulate(system, find("rk4"), 1e-3, 0.01, changes, PendulumMotion)
    plain = simulate(system, find("rk4"), 1e-3, 0.01, equations=PendulumMotion)
    assert changed.positions[:6].tolist() == plain.positions[:6].tolist()
    assert (changed.positions[7:, 1:] != plain.positions[7:, 1:]).any()


def test_rods_cannot_change_their_length() -> None:
    """Said as what it is."""
    system = find_scene("string").system({"masses": 3})
    with pytest.raises(InputError, match="no pendulum: expected every spring to start at its rest length"):
        simulate(system, find("rk4"), 1e-3, 0.01, [Change(0.005, "rest_length", 0.2)], PendulumMotion)


def changed_system(**parameters: Any) -> MassSpringSystem:
    """A moving string with some parameters set one after the other."""
    system = moving_string(2)
    for parameter, value in parameters.items():
        system = system.with_parameter(parameter, value)
    return system


def test_every_parameter_reaches_its_field() -> None:
    """For all masses or springs."""
    system = changed_system(**VALUES)
    assert system.masses.tolist() == [0.05] * 3
    assert system.rest_lengths.tolist() == [0.2] * 2
    assert system.stiffness.tolist() == [80.0] * 2
    assert system.damping.tolist() == [0.3] * 2
    assert system.drag == 0.2
    assert system.gravity.tolist() == [0.0, -1.6]


@pytest.mark.parametrize("lost", ["positions", "velocities"])
def test_a_run_ends_at_the_first_state_of_which_one_number_is_lost(lost: str) -> None:
    """Of one mass, in the third step, whether it is where it is or how fast that is not known."""

    def losing(motion: MotionOfSprings, state: State, dt: float) -> State:
        moved = {"positions": state.positions + 0.0, "velocities": state.velocities + 0.0}
        if state.time > 1.5 * dt:
            moved[lost][1, 0] = np.nan
        return State(state.time + dt, **moved)

    system = find_scene("string").system({"masses": 3})
    run = simulate(system, Scheme(losing, 1, "scheme"), 1e-3, 0.01)
    assert len(run) == 4
    assert np.isnan(getattr(run, lost)[3, 1, 0])
