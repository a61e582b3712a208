"""Exact solutions, each against another that knows nothing of it: closed forms, and DOP853."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from reference.changes import Change
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.state import Array, State, Trajectory
from reference.theory.exact import damped_oscillator, exact
from tests import wrong
from tests.reference.schemes.solvers import Solver, solved_by, under
from tests.reference.systems import moving_string, property_test

# --- The damped oscillator ---


def check_oscillator(solve: Solver, mass: float, frequency: float, ratio: float, stretch: float, speed: float) -> None:
    """The closed form of m y'' + (c + Cd) y' + k (y - rest) = 0 against the scene `spring` solved, to 2e-12 m.

    Three periods; the solver's tolerance of 1e-12 of 0.1 m grows over its few hundred steps to 6e-13 m at most, in
    positions and in velocities over the frequency.

    Args:
        solve: what is checked.
        mass: [kg].
        frequency: sqrt(k/m) [1/s].
        ratio: damping over critical damping; half is the spring's, half is drag.
        stretch: the amplitude [m].
        speed: the starting velocity over frequency x 0.02 m.
    """
    stiffness, velocity = mass * frequency**2, speed * frequency * 0.02
    critical = 2 * np.sqrt(stiffness * mass)
    parameters = {
        "mass": mass,
        "stiffness": stiffness,
        "damping": ratio / 2 * critical,
        "drag": ratio / 2 * critical,
        "stretch": stretch,
        "velocity": velocity,
        "gravity": 0.01 * frequency**2,
    }
    system = find_scene("spring").system(parameters)
    dt = 0.5 / frequency
    found = solve(system, dt, 38)
    rest = -(0.125 + 0.01)
    y, v = damped_oscillator(mass, stiffness, ratio * critical, 0.01 - stretch, velocity, found.times)
    assert len(found) == 39
    assert np.abs(found.positions[:, 1, 1] - rest - y).max() < 2e-12
    assert np.abs(found.velocities[:, 1, 1] - v).max() < 2e-12 * frequency


@pytest.mark.rotating(2)
@property_test
@given(
    mass=st.floats(0.01, 10.0),
    frequency=st.floats(0.5, 200.0),
    ratio=st.floats(0.0, 5.0) | st.just(1.0),
    stretch=st.floats(-0.03, 0.03),
    speed=st.floats(-1.0, 1.0),
)
@example(mass=0.02, frequency=100.0, ratio=0.0, stretch=0.01, speed=0.0)
@example(mass=0.02, frequency=100.0, ratio=0.3, stretch=0.01, speed=1.0)
@example(mass=0.02, frequency=100.0, ratio=1.0, stretch=0.01, speed=1.0)
@example(mass=0.02, frequency=100.0, ratio=4.0, stretch=0.01, speed=1.0)
def test_damped_oscillator_is_the_exact_solution(
    mass: float, frequency: float, ratio: float, stretch: float, speed: float
) -> None:
    """Under-damped, critically damped and over-damped, within 2e-12 m of DOP853."""
    check_oscillator(exact, mass, frequency, ratio, stretch, speed)


@pytest.mark.parametrize(
    "solve",
    [
        solved_by("rk4"),
        under(wrong.gravity_turned),
        under(wrong.damping_turned),
        under(wrong.one_sided),
        under(wrong.slightly_stronger),
    ],
)
def test_oscillator_fails_on_what_is_not_exact(solve: Solver) -> None:
    """A scheme's error is seen, and forces wrong by a part in 1e9: they turn the phase by 1e-8 in three periods."""
    with pytest.raises(AssertionError):
        check_oscillator(solve, 0.02, 100.0, 0.01, 0.03, 1.0)


#: m, k, c of an oscillator with m = 1 kg, k = 1 N/m; c = 2 N s/m is critical.
damping_values = st.floats(0.0, 20.0) | st.just(2.0) | st.floats(2 - 1e-6, 2 + 1e-6)
starts = st.floats(-1.0, 1.0)


@property_test
@given(c=damping_values, y0=starts, v0=starts, t=st.floats(0.1, 20.0))
def test_damped_oscillator_solves_its_equation(c: float, y0: float, v0: float, t: float) -> None:
    """That y' = v and v' = -c v - y, by differences over h = 1e-4 s of order 4: h^4 c^5/30 = 1e-11 at c = 20 N s/m."""
    h = 1e-4
    y, v = damped_oscillator(1.0, 1.0, c, y0, v0, t + h * np.array([-2, -1, 0, 1, 2]))
    slope = np.array([1, -8, 0, 8, -1]) / (12 * h)
    assert slope @ y == pytest.approx(v[2], abs=2e-11)
    assert slope @ v == pytest.approx(-c * v[2] - y[2], abs=5e-10)


@property_test
@given(c=damping_values, y0=starts, v0=starts, t=st.floats(0.0, 10.0), s=st.floats(0.0, 10.0))
def test_damped_oscillator_goes_on_from_where_it_is(c: float, y0: float, v0: float, t: float, s: float) -> None:
    """Phi(t + s) = Phi(s) Phi(t), to rounding: exponents up to 20 lose two digits."""
    y, v = damped_oscillator(1.0, 1.0, c, y0, v0, [t, t + s])
    later = damped_oscillator(1.0, 1.0, c, y[0], v[0], [s])
    assert later[0][0] == pytest.approx(y[1], abs=1e-13)
    assert later[1][0] == pytest.approx(v[1], abs=1e-13)


@property_test
@given(off=st.floats(-1e-6, 1e-6), y0=starts, v0=starts)
@example(off=4e-16, y0=0.0, v0=1.0)
@example(off=1e-14, y0=0.0, v0=1.0)
def test_damped_oscillator_is_continuous_at_critical_damping(off: float, y0: float, v0: float) -> None:
    """|dy/dc| <= t^2/2 (|y0| + |v0|) e^-t t <= 1, so y at c = 2 (1 + off) is within 4 |off| of critical, and rounding.

    Formulas that divide sinh(st) by s lose all digits there: st is about sqrt(off).
    """
    t = np.linspace(0.0, 10.0, 21)
    near, at = (damped_oscillator(1.0, 1.0, c, y0, v0, t) for c in (2 * (1 + off), 2.0))
    assert np.abs(near[0] - at[0]).max() <= 4 * abs(off) + 1e-15
    assert np.abs(near[1] - at[1]).max() <= 8 * abs(off) + 2e-15


def test_strong_damping_neither_overflows_nor_stops() -> None:
    """With c = 1e6 N s/m, y = y0 exp(-k t/c) to k m/c^2 = 1e-12, for hours."""
    t = np.array([0.0, 1.0, 1e4, 1e7])
    y, _ = damped_oscillator(1.0, 1.0, 1e6, 1.0, 0.0, t)
    assert y == pytest.approx(np.exp(-t / 1e6), rel=2e-11)


def test_without_a_spring_it_coasts() -> None:
    """With k = 0, y = y0 + v0 t without damping; y0 + v0 m/c (1 - exp(-c t/m)) with it."""
    t = np.linspace(0.0, 3.0, 7)
    assert damped_oscillator(2.0, 0.0, 0.0, 1.0, 0.5, t)[0] == pytest.approx(1.0 + 0.5 * t, rel=1e-15)
    y, v = damped_oscillator(2.0, 0.0, 3.0, 1.0, 0.5, t)
    assert y == pytest.approx(1.0 + 0.5 * 2 / 3 * (1 - np.exp(-1.5 * t)), rel=1e-14)
    assert v == pytest.approx(0.5 * np.exp(-1.5 * t), rel=1e-14)


# --- The most accurate numbers ---


def test_exact_does_not_depend_on_where_it_is_looked_at() -> None:
    """At 8 times 10 ms apart and at 80 times 1 ms apart it is the same motion, to 1e-11 m."""
    system = moving_string(5, damping=0.05)
    coarse, fine = exact(system, 0.01, 8), exact(system, 0.001, 80)
    assert np.abs(coarse.positions - fine.positions[::10]).max() < 1e-11
    assert coarse.times.tolist() == [0.01 * i for i in range(9)]
    assert coarse.velocities[0].tolist() == system.velocities.tolist()


def check_glued(solve: Callable[..., Trajectory]) -> None:
    """A change at step 5 is a second run from there with the other parameter, to 1e-11 m."""
    system = moving_string(3)
    changed = solve(system, 0.01, 10, [Change(0.05, "drag", 0.1)])
    first = exact(system, 0.01, 5)
    later = replace(system.with_parameter("drag", 0.1), positions=first.positions[-1], velocities=first.velocities[-1])
    glued = np.concatenate([first.positions, exact(later, 0.01, 5).positions[1:]])
    assert np.abs(changed.positions - glued).max() < 1e-11


def test_exact_changes_parameters_on_the_fly() -> None:
    """Drag switched on half-way."""
    check_glued(exact)


def test_glued_runs_fail_where_the_change_is_late_or_lost() -> None:
    """One step late, or not at all, is seen."""
    with pytest.raises(AssertionError):
        check_glued(lambda system, dt, steps, _: exact(system, dt, steps))
    with pytest.raises(AssertionError):
        check_glued(lambda system, dt, steps, _: exact(system, dt, steps, [Change(0.06, "drag", 0.1)]))


def test_a_change_after_the_end_changes_nothing() -> None:
    """Nor does it add states."""
    system = moving_string(2)
    late = exact(system, 0.01, 3, [Change(0.03, "drag", 0.1)])
    assert late.positions.tolist() == exact(system, 0.01, 3).positions.tolist()


class NoNumbers(SpringMotion):
    """EquationsOf of motion that are not numbers after 5 ms."""

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """NaN, later."""
        return super().acceleration(state, damping) + (np.nan if state.time > 0.005 else 0.0)


def test_exact_says_when_the_solver_gives_up() -> None:
    """No step is small enough for what is not a number."""
    with pytest.raises(SolverError, match="no exact solution"):
        exact(moving_string(2), 0.01, 2, equations=NoNumbers)


def test_exact_takes_no_more_steps_than_it_may() -> None:
    """Besides one for every time; two hundred periods in two steps take some hundreds, and ten of them nothing like it.

    With a rate omega and a tolerance of 1e-12 an eighth-order step is about a radian.
    """
    system = moving_string(2)
    with pytest.raises(SolverError, match=r"no exact solution: 5\d steps of the solver come to .* at most 52$"):
        exact(system, 10.0, 2, most_steps=50)
    assert len(exact(system, 0.001, 60, most_steps=5)) == 61


def test_exact_gives_up_early_what_it_would_not_come_to() -> None:
    """After 500 steps, where it would take a thousand times as many as it may."""
    system = replace(moving_string(2), stiffness=1e14)
    with pytest.raises(SolverError, match=r"no exact solution: 50\d steps of the solver come to"):
        exact(system, 1.0, 1)
