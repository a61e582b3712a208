"""The schemes: order of accuracy, implicit equations solved, and what no scheme may touch."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from reference.errors import InputError, SolverError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium, hanging_string
from reference.theory.exact import exact
from tests import wrong
from tests.reference.systems import IN_PLACE, label, moving_string, random_mesh, with_fields

ALL = list(schemes().values())
UNDAMPED = {"damping": 0.0, "drag": 0.0}
DAMPED = {"damping": 0.05, "drag": 0.02}

# --- Order of accuracy ---

#: How long [s], and at how many times the error is looked at.
DURATION, TIMES = 0.064, 8

#: Steps within DURATION of the coarsest run, by order: far inside the stability limit, its error far above rounding.
COARSEST = {1: 320, 2: 160, 4: 32}


@cache
def string_and_truth(damping: float, drag: float) -> tuple[MassSpringSystem, Array]:
    """A string in full motion, and where its masses truly are at TIMES."""
    system = moving_string(4, damping=damping, drag=drag)
    return system, exact(system, DURATION / TIMES, TIMES).positions


def measured_order(scheme: Scheme, damping: float, drag: float) -> float:
    """The slope of log(error) over log(dt) through three runs, each of half the dt of the one before."""
    system, true = string_and_truth(damping, drag)
    counts = [COARSEST[scheme.order] * f for f in (1, 2, 4)]
    runs = [simulate(system, scheme, DURATION / n, DURATION).positions[:: n // TIMES] for n in counts]
    errors = [np.abs(x - true).max() if len(x) == len(true) else np.inf for x in runs]
    return float(np.polyfit(-np.log(counts), np.log(errors), 1)[0]) if np.isfinite(errors).all() else -np.inf


def check_order(scheme: Scheme, damping: float, drag: float) -> None:
    """Error = C dt^p (1 + O(dt w)): the slope over these dt is within 0.05 of p.

    The coarsest dt w is 0.04, 0.08 and 0.4 for orders 1, 2 and 4 (w <= 2 sqrt(k/m) = 200/s), and the next term in the
    error bends the slope by up to half that; the finest error, 4e-9 m, is 4000 times that of the exact solution.
    """
    assert measured_order(scheme, damping, drag) == pytest.approx(scheme.order, abs=0.05)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("parameters", [UNDAMPED, DAMPED], ids=["undamped", "damped"])
@pytest.mark.parametrize("scheme", ALL, ids=label)
def test_order_is_as_theory_says(scheme: Scheme, parameters: dict[str, float]) -> None:
    """Every catalogued scheme has the order it is entered with; the in-place ones have order 1."""
    check_order(scheme, **parameters)


@pytest.mark.rotating(2, in_turn=True)
@pytest.mark.parametrize(
    "scheme",
    [
        wrong.heun_without_half,
        wrong.heun_of_the_wrong_pair,
        wrong.heun_back_in_time,
        wrong.verlet_with_one_force,
        wrong.rk4_equally_weighted,
        wrong.kick_drift_kicked_twice,
        wrong.kick_drift_gaining_energy,
        wrong.last_mass_forgotten,
        wrong.stepped(wrong.gravity_turned, find("rk4")),
        wrong.stepped(wrong.one_sided, find("heun")),
    ],
    ids=label,
)
def test_order_fails_on_wrong_schemes(scheme: Scheme) -> None:
    """A mistake costs an order, or convergence altogether."""
    with pytest.raises(AssertionError):
        check_order(scheme, **UNDAMPED)


@pytest.mark.rotating(2, in_turn=True)
def test_order_fails_on_damping_with_the_wrong_sign() -> None:
    """The undamped string cannot see that; the damped one does."""
    turned = wrong.stepped(wrong.damping_turned, find("heun"))
    check_order(turned, **UNDAMPED)
    with pytest.raises(AssertionError):
        check_order(turned, **DAMPED)


@pytest.mark.parametrize("in_place", IN_PLACE, ids=label)
def test_writing_in_place_costs_heun_its_second_order(in_place: Scheme) -> None:
    """What passes for Heun in place is caught by Heun's own check."""
    with pytest.raises(AssertionError):
        check_order(replace(in_place, order=2), **UNDAMPED)


# --- What holds for every scheme ---


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("scheme", ALL, ids=label)
def test_a_step_reads_and_never_writes_its_state(scheme: Scheme, dimension: int) -> None:
    """Every array it is given is read-only, what it returns is new, fixed masses stay, and time goes on by dt."""
    system = random_mesh(5, 6, dimension, anchors=2)
    start = State(0.25, system.positions, system.velocities)
    assert not start.positions.flags.writeable
    end = scheme.step(SpringMotion(system), start, 1e-3)
    assert end.time == pytest.approx(0.251, rel=1e-15)
    assert end.positions[:2].tolist() == system.positions[:2].tolist()
    assert not end.velocities[:2].any()
    assert (end.positions[2:] != system.positions[2:]).all()
    assert np.isfinite(end.velocities).all()


@pytest.mark.parametrize("scheme", ALL, ids=label)
def test_a_system_at_rest_stays_at_rest(scheme: Scheme) -> None:
    """At the hanging string's equilibrium nothing moves, at large steps either: rounding does not stop a solver."""
    system = find_scene("string").system({"angle": 90.0, "damping": 0.2, "drag": 0.1, "masses": 5})
    hanging = replace(system, positions=hanging_string(system).positions)
    run = simulate(hanging, scheme, 1e-3, 0.1)
    assert len(run) == 101
    assert np.abs(run.positions - hanging.positions).max() < 1e-13 * hanging.size


@pytest.mark.parametrize("scheme", [find("backward_euler"), find("implicit_midpoint")], ids=label)
def test_implicit_schemes_reach_rest_and_stay_there(scheme: Scheme) -> None:
    """Where the explicit limit is 0.02 s, steps of 0.05 s bring a spring to rest, and go on.

    After 20 s the motion has decayed by exp(-c t/2m) = exp(-250); what is left is rounding.
    """
    system = find_scene("spring").system({"damping": 0.5})
    run = simulate(system, scheme, 0.05, 20.0)
    assert len(run) == 401
    assert np.abs(run.positions[-1] - equilibrium(system).positions).max() < 1e-13 * system.size


def equation_error(motion: SpringMotion, start: State, end: State, dt: float, part: float) -> float:
    """How far a step is from z1 - z0 = dt f(z0 + part (z1 - z0)), in units of length and of length per dt [m]."""
    change = State(0.0, end.positions - start.positions, end.velocities - start.velocities)
    between = State(0.0, start.positions + part * change.positions, start.velocities + part * change.velocities)
    slope = motion.slope(between)
    of_positions = change.positions - dt * slope.positions
    of_velocities = dt * (change.velocities - dt * slope.velocities)
    return float(max(np.abs(of_positions).max(), np.abs(of_velocities).max()))


def check_equation(scheme: Scheme, part: float) -> None:
    """An implicit step solves its equation, not nearly: to 1e-13 of the size.

    dt k/m dt = 100 at dt = 0.1 s: rounding of positions, 1e-16 m, comes back 100 times as large through the forces.
    Many dt, as what the last round of a solver leaves depends on how far the one before it had come.
    """
    for seed in range(4):
        system = moving_string(5, seed, damping=0.05, drag=0.02)
        motion = SpringMotion(system)
        for dt in np.geomspace(1e-4, 0.1, 25):
            end = scheme.step(motion, system.start, dt)
            assert equation_error(motion, system.start, end, dt, part) < 1e-13 * system.size


@pytest.mark.parametrize(("name", "part"), [("backward_euler", 1.0), ("implicit_midpoint", 0.5)])
def test_implicit_schemes_solve_their_equations(name: str, part: float) -> None:
    """Backward Euler takes the slope at the end, the midpoint rule half-way there."""
    check_equation(find(name), part)


@pytest.mark.parametrize(
    ("scheme", "part"),
    [
        (wrong.explicit_in_place_of_backward, 1.0),
        (wrong.backward_euler_stopped_early, 1.0),
        (find("euler"), 1.0),
        (find("backward_euler"), 0.5),
        (find("heun"), 0.5),
    ],
    ids=label,
)
def test_implicit_equations_fail_on_others(scheme: Scheme, part: float) -> None:
    """A single guess at the end does not solve them, nor does Newton's method that stops a round too early."""
    with pytest.raises(AssertionError):
        check_equation(scheme, part)


def test_backward_euler_says_when_it_finds_no_solution() -> None:
    """At a dt of 1e80 s there is none in doubles."""
    system = moving_string(3)
    with pytest.raises(SolverError, match=r"backward Euler found no solution at t = 0 s with dt = 1e\+80 s"):
        simulate(system, find("backward_euler"), 1e80, 1e80)


@pytest.mark.parametrize("scheme", ALL, ids=label)
def test_every_scheme_says_in_a_sentence_what_it_does(scheme: Scheme) -> None:
    """The first line of its docstring is its summary."""
    assert len(scheme.summary) > 20
    assert "\n" not in scheme.summary


def test_unknown_scheme_is_refused_with_a_suggestion() -> None:
    """One letter off."""
    with pytest.raises(InputError, match=r"^unknown scheme 'huen': did you mean 'heun'\?$"):
        find("huen")


@pytest.mark.parametrize("name", ["backward_euler", "implicit_midpoint", "kick_drift_implicit_damping", "radau_iia"])
def test_where_all_is_held_there_is_nothing_to_solve_for(name: str) -> None:
    """Every mass stays, until one is released."""
    string = find_scene("string").system({"masses": 2, "damping": 0.1})
    held = with_fields(string, fixed=True)
    run = simulate(held, find(name), 1e-3, 2e-3)
    np.testing.assert_array_equal(run.positions[-1], string.positions)
