"""Springs that break: which, when, and that what is left moves as if they had never been."""

from __future__ import annotations

import numpy as np
import pytest

from reference.changes import Change
from reference.drives import Ramp
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.springs.breaking import breaks_of, tensions
from reference.state import Trajectory
from reference.stepper import stepper_named
from reference.system import BREAK, MassSpringSystem
from reference.theory.exact import exact


def test_a_mass_falls_from_the_step_on_at_whose_end_its_spring_broke() -> None:
    """Let go at rest length it pulls with m g (1 - cos w t), breaks at acos(1 - F/mg)/w, and then falls freely.

    The exact motion to 1e-11 before; afterwards by x + v t - g t^2/2 from the state it had then. RK4 breaks it at the
    same step, which is 0.4 of a step beyond that time, and so is told the same time.
    """
    system = find_scene("oscillator").system({"stretch": 0.0, "breaking_force": 0.3})
    w, dt = np.sqrt(200.0 / 0.02), 1e-3
    at = np.arccos(1 - 0.3 / (0.02 * 9.81)) / w
    step = int(np.ceil(at / dt))
    for run in (exact(system, dt, 200), simulate(system, find("rk4"), dt, 0.2)):
        assert breaks_of(system, run, dt) == [Change(step * dt, BREAK, (0.0,))]
        u = -0.125 - run.positions[: step + 1, 1, 0]
        assert u == pytest.approx(0.02 * 9.81 / 200 * (1 - np.cos(w * run.times[: step + 1])), abs=1e-8)
        x, v = run.positions[step, 1, 0], run.velocities[step, 1, 0]
        t = run.times[step:] - run.times[step]
        assert run.positions[step:, 1, 0] == pytest.approx(x + v * t - 9.81 / 2 * t**2, abs=1e-12)
    # shown to fail: one that never breaks comes back
    whole = simulate(find_scene("oscillator").system({"stretch": 0.0}), find("rk4"), dt, 0.2)
    assert whole.positions[-1, 1, 0] > x - 0.01
    assert breaks_of(find_scene("oscillator").system({}), whole, dt) == []


def slowly_loaded(system: MassSpringSystem, dt: float, duration: float) -> tuple[Trajectory, list[Change]]:
    """A run in which gravity grows evenly, and its changes."""
    changes = Ramp("gravity", 0.0, duration, 20.0).changes(system, dt, duration)
    return simulate(system, find("kick_drift"), dt, duration, changes), changes


@pytest.mark.rotating(3)
def test_a_chain_breaks_where_its_tension_is_largest() -> None:
    """At the top, which carries all: where gravity grows slowly, once it is F / (n m), and all that is below falls.

    Damped and over 4 s the chain is at rest all but the 0.3 % that its swing of 0.15 s leaves (measured: 0.25 %).
    """
    system = find_scene("chain").system({"masses": 5, "damping": 1.0, "gravity": 0.0, "breaking_force": 1.0})
    dt, duration = 2e-3, 4.0
    run, changes = slowly_loaded(system, dt, duration)
    (broke,) = breaks_of(system, run, dt, changes)
    assert broke.value == (0.0,)
    assert broke.time == pytest.approx(1.0 / (5 * 0.02) / (20.0 / duration), rel=3e-3)
    step = broke.step(dt)
    forces = tensions(system, run.positions[step], run.velocities[step])
    assert np.argmax(forces) == 0
    assert (np.diff(forces) < 0).all()
    after = broke.step(dt) + 100
    fell = run.positions[step, 1:, 0].mean() - run.positions[after, 1:, 0].mean()
    assert fell == pytest.approx(0.5 * 20.0 * broke.time / duration * 0.2**2, rel=0.1)


def test_a_weaker_spring_breaks_first_wherever_it_is() -> None:
    """Of one that breaks at a stretch of 3 mm, and others at 1 N: the weak one, and then no other."""
    stretches = [9.0, 9.0, 3e-3, 9.0, 9.0]
    system = find_scene("chain").system({"masses": 5, "damping": 1.0, "breaking_stretch": stretches})
    run = simulate(system, find("kick_drift"), 1e-3, 0.3)
    (broke,) = breaks_of(system, run, 1e-3)
    assert broke.value == (2.0,)
    step = broke.step(1e-3)
    stretch = run.positions[step, 2, 0] - run.positions[step, 3, 0] - 0.125
    assert stretch > 3e-3
    before = run.positions[step - 1, 2, 0] - run.positions[step - 1, 3, 0] - 0.125
    assert before <= 3e-3


def test_springs_are_broken_on_purpose_and_may_then_be_of_any_length() -> None:
    """A chain cut at 0.1 s: the lower part falls with g, by two ways to say it; and that is no blow-up."""
    system = find_scene("chain").system({"masses": 4})
    cut = [Change(0.1, BREAK, 2.0)]
    outcome = stepper_named("rk4").run(system, 1e-3, 4_000, cut)
    assert (outcome.ending, outcome.reason) == ("done", "")
    assert outcome.trajectory is not None
    lower = outcome.trajectory.positions[:, 3:, 0].mean(axis=1)
    assert np.diff(lower[101:], 2)[:1000] == pytest.approx(np.full(1000, -9.81e-6), rel=1e-6)
    gone = [
        Change(0.1, "stiffness", (200.0, 200.0, 0.0, 200.0)),
        Change(0.1, "damping", 0.0),
    ]
    same = simulate(system, find("rk4"), 1e-3, 0.5, gone)
    assert (outcome.trajectory.positions[:501] == same.positions).all()


def test_what_is_gone_is_gone_whatever_is_set_later() -> None:
    """A change, or a ramp, of all springs' stiffness and damping brings back none: what is below falls on freely.

    The springs that are left have the new values.
    """
    system = find_scene("chain").system({"masses": 5, "breaking_force": 0.8})
    dt, later = 1e-3, (Change(0.15, "stiffness", 250.0), Change(0.16, "damping", 0.1))
    run = simulate(system, find("drift_kick"), dt, 0.3, later)
    broke = breaks_of(system, run, dt, later)
    assert broke[0].time < 0.15
    assert broke[0].value == (0.0,)
    centre = run.positions[:, 1:, 0].mean(axis=1)
    assert np.diff(centre, 2)[160:] == pytest.approx(np.full(139, -9.81 * dt**2), rel=1e-6)
    left = system.with_parameter(BREAK, [0]).with_parameter("stiffness", 250.0).with_parameter("damping", 0.1)
    assert left.stiffness.tolist() == [0.0, 250.0, 250.0, 250.0, 250.0]
    assert left.damping.tolist() == [0.0, 0.1, 0.1, 0.1, 0.1]
