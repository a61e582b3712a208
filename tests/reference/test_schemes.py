"""The schemes: order of accuracy, one step in closed form, reversibility, and what a scheme may not touch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.catalogue import Scheme, find, schemes
from reference.errors import InputError, SolverError
from reference.exact import equilibrium, exact, hanging_string
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.simulate import simulate
from reference.state import Array, State
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import IN_PLACE, SOLVED_TO, WHOLE_STATE, label, moving_string, property_test, random_mesh

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


@pytest.mark.parametrize("parameters", [UNDAMPED, DAMPED], ids=["undamped", "damped"])
@pytest.mark.parametrize("scheme", ALL, ids=label)
def test_order_is_as_theory_says(scheme: Scheme, parameters: dict[str, float]) -> None:
    """Every catalogued scheme has the order it is entered with; the in-place ones have order 1."""
    check_order(scheme, **parameters)


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


# --- One step on one spring, in closed form ---

EYE = np.eye(2)

#: The step matrix on (y, v) of m y'' = -k y - c y' - Cd y', given dt, w^2 = k/m, c/m, Cd/m.
StepMatrix = Callable[[float, float, float, float], Array]


def rate_matrix(w2: float, c: float, d: float) -> Array:
    """A in z' = A z."""
    return np.array([[0.0, 1.0], [-w2, -(c + d)]])


def of_the_exponential(terms: int) -> StepMatrix:
    """The first terms of exp(dt A): what an explicit Runge-Kutta method of that order makes of a linear equation."""

    def matrix(h: float, w2: float, c: float, d: float) -> Array:
        step, term = EYE.copy(), EYE.copy()
        for i in range(1, terms + 1):
            term = term @ (h * rate_matrix(w2, c, d)) / i
            step = step + term
        return step

    return matrix


def kick_then_drift(keep: Callable[[float, float, float, float], tuple[float, float]]) -> StepMatrix:
    """Kick and then drift, where the kick leaves p v - q dt w^2 y of the velocity, (p, q) given by `keep`."""

    def matrix(h: float, w2: float, c: float, d: float) -> Array:
        p, q = keep(h, w2, c, d)
        drift, kick = np.array([[1.0, h], [0.0, 1.0]]), np.array([[1.0, 0.0], [-q * h * w2, p]])
        return np.asarray(drift @ kick)

    return matrix


def drift_then_kick(keep: Callable[[float, float, float, float], tuple[float, float]]) -> StepMatrix:
    """Drift and then kick, likewise."""

    def matrix(h: float, w2: float, c: float, d: float) -> Array:
        p, q = keep(h, w2, c, d)
        drift, kick = np.array([[1.0, h], [0.0, 1.0]]), np.array([[1.0, 0.0], [-q * h * w2, p]])
        return np.asarray(kick @ drift)

    return matrix


def backward(h: float, w2: float, c: float, d: float) -> Array:
    """1/(1 - z)."""
    return np.asarray(np.linalg.inv(EYE - h * rate_matrix(w2, c, d)), dtype=np.float64)


def midpoint(h: float, w2: float, c: float, d: float) -> Array:
    """(1 + z/2)/(1 - z/2)."""
    half = h / 2 * rate_matrix(w2, c, d)
    return np.linalg.inv(EYE - half) @ (EYE + half)


def verlet(h: float, w2: float, c: float, d: float) -> Array:
    """y1 = y + h v + h^2 a/2; v1 = v + h (a + a(y1, v + h a))/2."""
    a = rate_matrix(w2, c, d)[1]
    y1 = np.array([1.0, h]) + h**2 / 2 * a
    guess = np.stack([y1, np.array([0.0, 1.0]) + h * a])
    return np.stack([y1, np.array([0.0, 1.0]) + h / 2 * (a + a @ guess)])


def all_explicit(h: float, w2: float, c: float, d: float) -> tuple[float, float]:
    """Everything taken from before."""
    return 1 - h * (c + d), 1.0


def spring_implicit(h: float, w2: float, c: float, d: float) -> tuple[float, float]:
    """The spring's damping taken from after: (1 + h c/m) v1 = v*."""
    return (1 - h * d) / (1 + h * c), 1 / (1 + h * c)


def drag_implicit(h: float, w2: float, c: float, d: float) -> tuple[float, float]:
    """The drag taken from after, the spring's damping from before."""
    return (1 + h * d - h * (c + d)) / (1 + h * d), 1 / (1 + h * d)


def both_implicit(h: float, w2: float, c: float, d: float) -> tuple[float, float]:
    """Spring's damping and drag taken from after."""
    return 1 / (1 + h * (c + d)), 1 / (1 + h * (c + d))


def spring_exponential(h: float, w2: float, c: float, d: float) -> tuple[float, float]:
    """The spring's damping solved alone: v1 = exp(-h c/m) v*. One spring has no neighbour to put anything back."""
    return (1 - h * d) * np.exp(-h * c), np.exp(-h * c)


STEP_MATRICES: dict[str, StepMatrix] = {
    "euler": of_the_exponential(1),
    "heun": of_the_exponential(2),
    "rk4": of_the_exponential(4),
    "kick_drift": kick_then_drift(all_explicit),
    "drift_kick": drift_then_kick(all_explicit),
    "velocity_verlet": verlet,
    "backward_euler": backward,
    "implicit_midpoint": midpoint,
    "kick_drift_implicit_damping": kick_then_drift(spring_implicit),
    "kick_drift_truncated_damping": kick_then_drift(spring_implicit),
    "kick_drift_implicit_drag": kick_then_drift(drag_implicit),
    "kick_drift_implicit_damping_and_drag": kick_then_drift(both_implicit),
    "drift_kick_implicit_damping": drift_then_kick(spring_implicit),
    "drift_kick_sequential_damping": drift_then_kick(spring_exponential),
    "drift_kick_exponential_damping": drift_then_kick(spring_exponential),
    # One mass has no neighbour that could see it half-way: in place is right.
    "euler_in_place": of_the_exponential(1),
    "heun_link_by_link": of_the_exponential(2),
    "heun_aliased": of_the_exponential(2),
}


def check_step_matrix(scheme: Scheme, expected: StepMatrix, dt: float, damping: float, drag: float, y: float) -> None:
    """One spring moves by z1 = S z0 with S in closed form; z = (y, dt v), y from where the spring hangs at rest.

    Positions of 0.2 m round by 3e-17 m, forces by k eps L: some eps of the 0.13 m, far below 1e-12 of y >= 1e-3 m.
    """
    parameters = {"damping": damping, "drag": drag, "stretch": 0.02, "velocity": 0.3}
    system = find_scene("spring").system(parameters)
    k, m = float(system.stiffness[0]), float(system.masses[1])
    rest = hanging_string(system).positions[1, 1]
    before = np.array([y, 0.3])
    positions = np.array([[0.0, 0.0], [0.0, rest + y]])
    end = scheme.step(SpringMotion(system), State(0.0, positions, system.velocities), dt)
    after = np.array([end.positions[1, 1] - rest, end.velocities[1, 1]])
    predicted = expected(dt, k / m, damping / m, drag / m) @ before
    # A solver that stops at 1e-8 m/s leaves about as much in v, and dt times that in y.
    tolerance = 1e-12 + 2 * SOLVED_TO.get(scheme, 0.0) * dt / 0.03
    size = np.array([0.03, 0.03 / dt])
    assert np.abs((after - predicted) / size).max() < tolerance
    assert not end.positions[:, 0].any()


step_sizes = st.floats(1e-4, 1.5e-2)
dampings = st.sampled_from([0.0, 0.01, 0.5]) | st.floats(0.0, 1.0)
displacements = st.floats(-0.03, 0.03)


@pytest.mark.parametrize("scheme", ALL, ids=label)
@property_test
@given(dt=step_sizes, damping=dampings, drag=dampings, y=displacements)
def test_one_step_on_one_spring_is_its_closed_form(
    scheme: Scheme, dt: float, damping: float, drag: float, y: float
) -> None:
    """Amplitude and phase of every step are the scheme's stability function, for any dt, damping and drag."""
    check_step_matrix(scheme, STEP_MATRICES[scheme.name], dt, damping, drag, y)


def test_every_catalogued_scheme_has_a_closed_form_here() -> None:
    """A scheme that enters the catalogue brings its step matrix with it."""
    assert set(schemes()) <= set(STEP_MATRICES)


@pytest.mark.parametrize(
    ("scheme", "pretends_to_be"),
    [
        (wrong.heun_without_half, "heun"),
        (wrong.heun_of_the_wrong_pair, "heun"),
        (wrong.heun_back_in_time, "heun"),
        (wrong.verlet_with_one_force, "velocity_verlet"),
        (wrong.rk4_equally_weighted, "rk4"),
        (wrong.kick_drift_kicked_twice, "kick_drift"),
        (wrong.kick_drift_gaining_energy, "kick_drift"),
        (wrong.last_mass_forgotten, "kick_drift"),
        (wrong.explicit_in_place_of_backward, "backward_euler"),
        (wrong.stepped(wrong.damping_turned, find("euler")), "euler"),
        (wrong.stepped(wrong.slightly_stronger, find("euler")), "euler"),
        (find("kick_drift"), "drift_kick"),
    ],
    ids=label,
)
def test_closed_form_fails_on_wrong_schemes(scheme: Scheme, pretends_to_be: str) -> None:
    """Forces wrong by a part in 1e9 are seen in one step; so is one right scheme passing for another."""
    with pytest.raises(AssertionError):
        check_step_matrix(scheme, STEP_MATRICES[pretends_to_be], 5e-3, 0.1, 0.1, 0.02)


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        ("euler", lambda z: 1 + z**2),
        ("backward_euler", lambda z: 1 / (1 + z**2)),
        ("heun", lambda z: 1 + z**4 / 4),
        ("implicit_midpoint", lambda z: 1.0),
        ("rk4", lambda z: 1 - z**6 / 72 + z**8 / 576),
    ],
)
def test_energy_of_the_oscillator_grows_by_the_schemes_factor(name: str, factor: Callable[[float], float]) -> None:
    """E = m v^2/2 + k y^2/2 changes by |R(i dt w)|^2 in every step; 1e-12 is rounding of y on positions of 0.13 m."""
    system = find_scene("spring").system({"stretch": 0.03})
    rest = hanging_string(system).positions[1, 1]
    dt = 2e-3
    trajectory = simulate(system, find(name), dt, 20 * dt)
    y, v = trajectory.positions[:, 1, 1] - rest, trajectory.velocities[:, 1, 1]
    energies = 0.02 * v**2 / 2 + 200.0 * y**2 / 2
    assert energies[1:] / energies[:-1] == pytest.approx(factor(dt * 100.0), rel=1e-12)


def check_invariant(scheme: Scheme, weights: tuple[float, float, float]) -> None:
    """A quadratic form p v^2 + q v w y + r (w y)^2 is constant over 2,000 steps of the undamped spring.

    Positions of 0.16 m round by 5 eps of the amplitude, 0.03 m, at each step; 2,000 steps in the same direction would
    make 4e-12 of the square, and they do not all round the same way: 1e-12.
    """
    system = find_scene("spring").system({"stretch": 0.03})
    rest = hanging_string(system).positions[1, 1]
    trajectory = simulate(system, scheme, 2e-3, 4.0)
    wy, v = 100.0 * (trajectory.positions[:, 1, 1] - rest), trajectory.velocities[:, 1, 1]
    p, q, r = weights
    invariant = p * v**2 + q * v * wy + r * wy**2
    assert np.ptp(invariant) < 1e-12 * invariant[0]


#: With z = dt w = 0.2: what HLW (I.1.2, I.3) call the modified energy, here exact as the equation is linear.
INVARIANTS = {
    "kick_drift": (1.0, -0.2, 1.0),
    "drift_kick": (1.0, 0.2, 1.0),
    "velocity_verlet": (1.0, 0.0, 1.0 - 0.2**2 / 4),
    "implicit_midpoint": (1.0, 0.0, 1.0),
}


@pytest.mark.parametrize("name", INVARIANTS)
def test_symplectic_schemes_keep_a_modified_energy(name: str) -> None:
    """Kick-drift keeps v^2 - z v w y + (w y)^2, drift-kick the same with +z, Verlet v^2 + (1 - z^2/4)(w y)^2."""
    check_invariant(find(name), INVARIANTS[name])


@pytest.mark.parametrize(
    "scheme",
    [find("euler"), find("rk4"), find("drift_kick"), wrong.kick_drift_gaining_energy, wrong.kick_drift_kicked_twice],
    ids=label,
)
def test_modified_energy_fails_on_others(scheme: Scheme) -> None:
    """None of these keeps kick-drift's."""
    with pytest.raises(AssertionError):
        check_invariant(scheme, INVARIANTS["kick_drift"])


# --- Symmetry in time ---


def check_reversible(scheme: Scheme) -> None:
    """A step of dt and one of -dt lead back: Phi(-dt) Phi(dt) = 1 (HLW V.1), to rounding, 1e-14 of size and speed."""
    system = moving_string(6)
    motion = SpringMotion(system)
    there = scheme.step(motion, system.start, 2e-3)
    back = scheme.step(motion, there, -2e-3)
    assert back.time == 0.0
    assert np.abs(back.positions - system.positions).max() < 1e-14 * system.size
    assert np.abs(back.velocities - system.velocities).max() < 1e-14 * np.abs(there.velocities).max()


@pytest.mark.parametrize("name", ["velocity_verlet", "implicit_midpoint"])
def test_symmetric_schemes_are_reversible(name: str) -> None:
    """Velocity Verlet and the midpoint rule treat start and end of a step alike."""
    check_reversible(find(name))


@pytest.mark.parametrize(
    "scheme",
    [find("euler"), find("kick_drift"), find("heun"), find("rk4"), wrong.verlet_with_one_force, *IN_PLACE],
    ids=label,
)
def test_reversibility_fails_on_others(scheme: Scheme) -> None:
    """Schemes that are not symmetric, rk4 among them, and wrong ones do not come back."""
    with pytest.raises(AssertionError):
        check_reversible(scheme)


@pytest.mark.parametrize(("name", "adjoint"), [("kick_drift", "drift_kick"), ("euler", "backward_euler")])
def test_adjoint_schemes_undo_each_other(name: str, adjoint: str) -> None:
    """Phi*(-dt) Phi(dt) = 1: drift-kick is kick-drift's adjoint, backward Euler is Euler's (HLW II.3)."""
    system = moving_string(6)
    motion = SpringMotion(system)
    there = find(name).step(motion, system.start, 1e-3)
    back = find(adjoint).step(motion, there, -1e-3)
    assert np.abs(back.positions - system.positions).max() < 1e-14 * system.size


# --- Renumbering ---


def renumbering_error(scheme: Scheme, damping: float) -> float:
    """How far a string and the same string renumbered are apart after 100 steps, as a part of the size."""
    system = moving_string(7, damping=damping, drag=0.02)
    order = np.array([3, 0, 6, 1, 7, 5, 2, 4])
    straight = simulate(system, scheme, 1e-3, 0.1).positions
    mixed = simulate(system.renumbered(order), scheme, 1e-3, 0.1).positions
    return float(np.abs(mixed - straight[:, order]).max() / system.size)


def check_renumbering(scheme: Scheme, damping: float) -> None:
    """Numbers are names, not physics: the motion is the same to rounding.

    Each of 100 steps rounds each mass by some eps; 1e-13 allows 450 eps. A solver that stops at 1e-8 m/s may leave as
    much of every velocity for 0.1 s (the size is 0.8 m).
    """
    assert renumbering_error(scheme, damping) < 1e-13 + 0.1 * SOLVED_TO.get(scheme, 0.0)


@pytest.mark.parametrize("damping", [0.0, 0.5])
@pytest.mark.parametrize("scheme", WHOLE_STATE, ids=label)
def test_renumbering_the_masses_changes_nothing(scheme: Scheme, damping: float) -> None:
    """The springs keep their order here, so that sequential impulses too only meet masses of another name."""
    check_renumbering(scheme, damping)


@pytest.mark.parametrize("scheme", [*IN_PLACE, wrong.in_order_of_number, wrong.last_mass_forgotten], ids=label)
def test_renumbering_fails_on_in_place_schemes(scheme: Scheme) -> None:
    """Who is advanced first is seen first by the others: over 1e-6 of the size in 100 steps."""
    with pytest.raises(AssertionError):
        check_renumbering(scheme, 0.0)
    assert renumbering_error(scheme, 0.0) > 1e-6


#: The one whole-state scheme that by theory depends on the order of the springs, where they are damped: it goes over
#: them one after the other, and stops after ten rounds.
ONE_SPRING_AFTER_THE_OTHER = {find("drift_kick_sequential_damping")}


def reordering_error(scheme: Scheme, damping: float) -> float:
    """How far a string and the same string with its springs listed from the tip are apart after 100 steps."""
    system = moving_string(7, damping=damping, drag=0.02)
    backwards = system.with_springs_reversed()
    one, other = (simulate(s, scheme, 1e-3, 0.1).positions for s in (system, backwards))
    return float(np.abs(one - other).max() / system.size)


@pytest.mark.parametrize("scheme", [s for s in WHOLE_STATE if s not in ONE_SPRING_AFTER_THE_OTHER], ids=label)
def test_reordering_the_springs_changes_nothing(scheme: Scheme) -> None:
    """The sum of the forces on a mass has no order, but for rounding."""
    assert reordering_error(scheme, 0.5) < 1e-13 + SOLVED_TO.get(scheme, 0.0)


def test_reordering_the_springs_shows_in_sequential_damping_only() -> None:
    """Springs that give up 1 - exp(-dt c/m) = 0.86 of their rate (c = 20 N s/m) show their order after ten rounds.

    Where they give up 0.05 (c = 0.5 N s/m) the rounds have converged.
    """
    (sequential,) = ONE_SPRING_AFTER_THE_OTHER
    assert reordering_error(sequential, 20.0) > 1e-6
    assert reordering_error(sequential, 0.5) < 1e-13


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

    dt k/m dt = 25 at dt = 0.05 s: rounding of positions, 1e-16 m, comes back 25 times as large through the forces.
    """
    system = moving_string(5, damping=0.05, drag=0.02)
    motion = SpringMotion(system)
    for dt in (1e-3, 1e-2, 5e-2):
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
        (find("euler"), 1.0),
        (find("backward_euler"), 0.5),
        (find("heun"), 0.5),
    ],
    ids=label,
)
def test_implicit_equations_fail_on_others(scheme: Scheme, part: float) -> None:
    """A single guess at the end does not solve them."""
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
