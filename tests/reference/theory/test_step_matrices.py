"""One step of every scheme on one spring, in closed form; and so what becomes of energies: they grow, or are kept."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes import implicit_damping, in_place, textbook
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import Array, State
from reference.theory.equilibrium import hanging_string
from tests import wrong
from tests.reference.systems import SOLVED_TO, label, property_test

#: The files of schemes whose step matrices are known.
FILES = (textbook, implicit_damping, in_place)


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


@pytest.mark.rotating(5)
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.name in STEP_MATRICES], ids=label)
@property_test
@given(dt=step_sizes, damping=dampings, drag=dampings, y=displacements)
def test_one_step_on_one_spring_is_its_closed_form(
    scheme: Scheme, dt: float, damping: float, drag: float, y: float
) -> None:
    """Amplitude and phase of every step are the scheme's stability function, for any dt, damping and drag."""
    check_step_matrix(scheme, STEP_MATRICES[scheme.name], dt, damping, drag, y)


def test_every_catalogued_scheme_has_a_closed_form_here() -> None:
    """A scheme that enters one of these files brings its step matrix with it."""
    names = {file.__name__ for file in FILES}
    assert {s.name for s in schemes().values() if s.step.__module__ in names} <= set(STEP_MATRICES)


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
