"""Steps that can be worked out by hand: of one mass on a line, in space, on a rod; and equations that are kept."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from reference.distance_constraints import RopeMotion
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, constraint_schemes, find
from reference.schemes.constrained import ROPE_KICK_DRIFT
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.equilibrium import hanging_string
from tests.reference.schemes.test_constraint_solvers import AS_BACKWARD_EULER, backward_euler
from tests.reference.systems import label, moving_string, random_mesh

#: h [s], k/m [1/s^2], (c + Cd)/m [1/s]; how far from rest the mass begins [m], and how fast [m/s].
H, SQUARE, RATE = 0.05, 200.0, 2.5
BEGIN = (0.3, -1.2)


def one_mass(drag: float) -> MassSpringSystem:
    """2 kg on a line; its spring's damping and drag together are RATE."""
    return MassSpringSystem(
        positions=np.array([[0.0], [3.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(2.0),
        rest_lengths=np.array(3.0),
        stiffness=np.array(2 * SQUARE),
        damping=np.array(2 * (RATE - drag)),
        drag=2 * drag,
        gravity=np.zeros(1),
        fixed=np.array([True, False]),
    )


def steps(name: str, count: int, h: float = H, drag: float = 0.5) -> Array:
    """Of one mass: its x and v at the start and after each step, shape (count + 1, 2)."""
    system = one_mass(drag)
    advance = find(name).on(SpringMotion(system))
    states = [State(0.0, system.positions + np.array([[0.0], [BEGIN[0]]]), np.array([[0.0], [BEGIN[1]]]))]
    for _ in range(count):
        states.append(advance(states[-1], h))
    assert [state.time for state in states] == pytest.approx([i * h for i in range(count + 1)], rel=1e-14)
    return np.array([[state.positions[1, 0] - 3.0, state.velocities[1, 0]] for state in states])


def generalised_alpha(m: float, f: float, beta: float, gamma: float, count: int) -> Array:
    """(1 - m) a1 + m a0 = F((1 - f) x1 + f x0, (1 - f) v1 + f v0), with Newmark's x1 and v1, solved by hand.

    x1 = x0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1), v1 = v0 + h ((1 - gamma) a0 + gamma a1), F = -w^2 x - r v: one
    equation in a1. (Chung and Hulbert 1993, equations 3 to 7; HHT has m = 0 and f = -alpha, Newmark both zero.)
    """
    x, v = BEGIN
    a, found = -SQUARE * x - RATE * v, [BEGIN]
    for _ in range(count):
        ahead, faster = x + H * v + H**2 * (0.5 - beta) * a, v + H * (1 - gamma) * a
        force = -SQUARE * ((1 - f) * ahead + f * x) - RATE * ((1 - f) * faster + f * v)
        after = (force - m * a) / (1 - m + (1 - f) * (SQUARE * H**2 * beta + RATE * H * gamma))
        x, v, a = ahead + H**2 * beta * after, faster + H * gamma * after, after
        found.append((x, v))
    return np.array(found)


@pytest.mark.parametrize(
    ("name", "of_paper"),
    [
        ("newmark", (0.0, 0.0, 0.25, 0.5)),
        ("newmark(beta=0.1, gamma=0.8)", (0.0, 0.0, 0.1, 0.8)),
        ("hht", (0.0, 0.1, 1.1**2 / 4, 0.6)),
        ("hht(alpha=-0.25)", (0.0, 0.25, 1.25**2 / 4, 0.75)),
        ("generalised_alpha", (1 / 3, 4 / 9, (1 - 1 / 3 + 4 / 9) ** 2 / 4, 0.5 - 1 / 3 + 4 / 9)),
        ("generalised_alpha(radius=0.25)", (-0.4, 0.2, 1.6**2 / 4, 1.1)),
    ],
)
def test_schemes_of_structures_step_as_their_papers_say(name: str, of_paper: tuple[float, ...]) -> None:
    """Three steps, as they keep accelerations; to rounding."""
    m, f, beta, gamma = of_paper
    # Newmark's has no memory: its a0 is the force's, which only in the linear case is the one it solved for
    np.testing.assert_allclose(steps(name, 3), generalised_alpha(m, f, beta, gamma, 3), rtol=1e-12, atol=1e-13)


def beeman(count: int) -> Array:
    """x1 = x0 + h v0 + h^2 (4 a0 - a[-1])/6, v1 = v0 + h (2 a1 + 5 a0 - a[-1])/6, a1 with v0 + h (3 a0 - a[-1])/2."""
    (x, v), found = BEGIN, [BEGIN]
    before = -SQUARE * x - RATE * v
    for _ in range(count):
        here = -SQUARE * x - RATE * v
        after = x + H * v + H**2 * (4 * here - before) / 6
        there = -SQUARE * after - RATE * (v + H * (3 * here - before) / 2)
        x, v, before = after, v + H * (2 * there + 5 * here - before) / 6, here
        found.append((x, v))
    return np.array(found)


def stormer_verlet(count: int) -> Array:
    """x1 = x0 + h v0 + h^2 a0/2 and then 2 x0 - x[-1] + h^2 a0; v1 = (x1 - x0)/h + h a1/2, a1 with (x1 - x0)/h."""
    (x, v), found, before = BEGIN, [BEGIN], None
    for _ in range(count):
        here = -SQUARE * x - RATE * v
        after = x + H * v + H**2 * here / 2 if before is None else 2 * x - before + H**2 * here
        v = (after - x) / H
        v, before, x = v + H * (-SQUARE * after - RATE * v) / 2, x, after
        found.append((x, v))
    return np.array(found)


def adams_bashforth(count: int) -> Array:
    """Heun's step, then 3/2 of the slope here less 1/2 of the one before."""
    matrix = np.array([[0.0, 1.0], [-SQUARE, -RATE]])
    y = [np.array(BEGIN)]
    y.append(y[0] + H * matrix @ (y[0] + H / 2 * matrix @ y[0]))
    for _ in range(count - 1):
        y.append(y[-1] + H / 2 * matrix @ (3 * y[-1] - y[-2]))
    return np.array(y)


def backward_differences(count: int) -> Array:
    """Backward Euler's step, then 3/2 y1 - 2 y0 + y[-1]/2 = h A y1."""
    matrix = H * np.array([[0.0, 1.0], [-SQUARE, -RATE]])
    y = [np.array(BEGIN)]
    y.append(np.linalg.solve(np.eye(2) - matrix, y[0]))
    for _ in range(count - 1):
        y.append(np.linalg.solve(1.5 * np.eye(2) - matrix, 2 * y[-1] - y[-2] / 2))
    return np.array(y)


@pytest.mark.parametrize(
    ("name", "by_hand"),
    [
        ("beeman", beeman),
        ("stormer_verlet", stormer_verlet),
        ("adams_bashforth_2", adams_bashforth),
        ("bdf2", backward_differences),
    ],
    ids=label,
)
def test_schemes_that_look_back_step_by_hand(name: str, by_hand: object) -> None:
    """Three steps of a damped oscillator, to rounding: the first has no past."""
    assert callable(by_hand)
    np.testing.assert_allclose(steps(name, 3), by_hand(3), rtol=1e-11, atol=1e-13)


def test_backward_differences_are_solved_for_on_springs_that_turn() -> None:
    """3/2 y1 - 2 y0 + y[-1]/2 = h f(y1), to 1e-12 of 1 m/s: at this step Newton's method needs several rounds."""
    motion, h = SpringMotion(moving_string(4, damping=0.05, drag=0.02)), 0.01
    advance = find("bdf2").on(motion)
    states = [motion.start]
    for _ in range(4):
        states.append(advance(states[-1], h))
    for (before, here), after in zip(pairwise(states), states[2:], strict=False):
        for of, slope in (("positions", after.velocities), ("velocities", motion.acceleration(after))):
            one, two, three = (getattr(state, of) for state in (before, here, after))
            assert np.abs(1.5 * three - 2 * two + one / 2 - h * slope).max() < 1e-12


@pytest.mark.parametrize("name", AS_BACKWARD_EULER)
def test_solvers_of_constraints_step_two_kilograms_by_backward_euler(name: str) -> None:
    """V' = (v - h w^2 x)/(1 + h r + h^2 w^2), x' = x + h v', over two steps: to rounding, with a spring of any mass."""
    expected = [np.array(BEGIN)]
    for _ in range(2):
        expected.append(backward_euler(*expected[-1], H, SQUARE, RATE))
    np.testing.assert_allclose(steps(name, 2, drag=0.0), expected, rtol=1e-12)


def test_a_damped_mass_of_box2d_3() -> None:
    """U = (v - h w^2 x)/(1 + h r + h^2 w^2), x' = x + h u, v' = (v - h w^2 x')/(1 + h r + h^2 w^2), from no impulse."""
    (x, v), part = BEGIN, 1 / (1 + H * RATE + H**2 * SQUARE)
    after = x + H * (v - H * SQUARE * x) * part
    expected = [BEGIN, (after, (v - H * SQUARE * after) * part)]
    np.testing.assert_allclose(steps("soft_constraints_relaxed(substeps=1)", 1, drag=0.0), expected, rtol=1e-12)


def test_damping_that_is_a_stiffness_too_by_hand() -> None:
    """Of 2 kg in two sub-steps: of what C has gained since the start h c/(1 + h^2 (k + c)/m) is taken, too."""
    (x, v), h, (k, c) = BEGIN, H / 2, (2 * SQUARE, 2 * RATE)
    damped = h * (c + h * k)
    start, gained = x, h * k / (1 + damped / 2) + h * c / (1 + h * h * (k + c) / 2)
    for _ in range(2):
        v -= (damped * v + h * k * start) / (1 + damped / 2) / 2 + gained * (x - start) / 2
        x += h * v
    name = "temporal_gauss_seidel(damping_as_stiffness=True, substeps=2, sweeps_after=0)"
    np.testing.assert_allclose(steps(name, 1, drag=0.0), [BEGIN, (x, v)], rtol=1e-12)


def test_a_warm_start_holds_what_hangs() -> None:
    """A string at rest, one sweep a step: begun from the impulses of the step before it sags half as far.

    Each step's impulses are nearly those of the last; from nothing one sweep does not carry the weight of all masses.
    """
    string = find_scene("string").system({"masses": 5, "angle": 90.0, "stiffness": 2e3})
    motion = SpringMotion(replace(string, positions=hanging_string(string).positions))
    advance = find("soft_constraints_warm(sweeps=1)").on(motion)
    sagged = []
    for forgets in (False, True):
        state = motion.start
        for _ in range(40):
            state = advance(state, 5e-3)
            state = State(state.time, state.positions, state.velocities) if forgets else state
        sagged.append(np.abs(state.positions - motion.start.positions).max())
    assert sagged[0] < 0.6 * sagged[1]


# --- Drag alone ---

#: What is left of a velocity after a step of 0.1 s with Cd/m = 3/s: of one over n sub-steps each.
LEFT = {
    "kick_drift_drag_afterwards": 1 - 0.3,
    "kick_drift_exponential_drag": np.exp(-0.3),
    "soft_constraints_warm": 1 - 0.3,
    "soft_constraints_cold(drag_first=True, substeps=3)": (1 - 0.1) ** 3,
    "soft_constraints_cold(substeps=3)": 1 / (1 + 0.3),
    "soft_constraints_relaxed(substeps=3)": (1 + 0.1) ** -3,
    "xpbd_jacobi": 1 - 0.3,
    "xpbd_gauss_seidel(substeps=3)": (1 - 0.1) ** 3,
    "temporal_gauss_seidel(substeps=3)": 1 - 0.3,
}


@pytest.mark.parametrize("name", LEFT)
def test_drag_alone_takes_its_part(name: str) -> None:
    """Of a mass in space whose spring pulls a millionth of a newton; beside one of another mass that is fixed."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 2.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array([7.0, 0.5]),
        rest_lengths=np.array(3.0),
        stiffness=np.array(1e-6),
        gravity=np.zeros(3),
        drag=1.5,
        fixed=np.array([True, False]),
    )
    thrown = np.array([[0.0, 0.0, 0.0], [0.2, -0.3, 0.4]])
    end = find(name).on(SpringMotion(system))(State(0.0, system.positions, thrown), 0.1)
    np.testing.assert_allclose(end.velocities, LEFT[name] * thrown, atol=1e-6)


def test_drag_beyond_all_stops_and_does_not_turn_about() -> None:
    """1 - h Cd/m is never below zero in solvers that write it so: a mass on a spring at rest stands still."""
    for name in ("soft_constraints_cold(drag_first=True)", "xpbd_jacobi", "xpbd_gauss_seidel", "temporal_gauss_seidel"):
        end = steps(name, 1, h=2.0, drag=RATE)
        still = find(name).on(SpringMotion(one_mass(RATE)))
        state = State(0.0, one_mass(RATE).positions, np.array([[0.0], [1.0]]))
        assert np.abs(still(state, 2.0).velocities).max() < 1e-12, name
        assert np.isfinite(end).all()


# --- Solvers of constraints in space ---

TURN = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)))[0]


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("scheme", constraint_schemes().values(), ids=label)
def test_a_plane_may_lie_anywhere_in_space(scheme: Scheme, single: bool) -> None:
    """A mesh of unequal masses and springs, and the same turned in space, move alike: to rounding, in five steps."""
    plane = random_mesh(3, 6, 2, anchors=2)
    flat = np.pad(np.eye(2), ((0, 0), (0, 1))) @ TURN
    space = MassSpringSystem(
        positions=plane.positions @ flat,
        velocities=plane.velocities @ flat,
        springs=plane.springs,
        masses=plane.masses,
        rest_lengths=plane.rest_lengths,
        stiffness=plane.stiffness,
        damping=plane.damping,
        drag=plane.drag,
        gravity=plane.gravity @ flat,
        fixed=plane.fixed,
    )
    name = f"{scheme.name}(single={single})"
    ends = []
    for system in (plane, space):
        advance, state = find(name).on(SpringMotion(system)), system.start
        for _ in range(5):
            state = advance(state, 1e-3)
        ends.append(state)
    off = 1e-2 if single else 1e-10  # a position's last digit over a sub-step
    np.testing.assert_allclose(ends[1].positions, ends[0].positions @ flat, atol=off)
    np.testing.assert_allclose(ends[1].velocities, ends[0].velocities @ flat, atol=off)


# --- A mass on a rod ---


def test_a_rod_brings_its_mass_back_as_mujocos_do() -> None:
    """0.3 kg on a rod from an anchor, which is r too long, begins at v.

    With d = 0.9999 and e its direction a = g + e (s - e.g)/(1 + R), s = -(e.v)/(d h) - r/(4 d h^2), R = 1e-3 (1 - d)/d;
    then kick, then drift.
    """
    e, v, g, h, d = np.array([0.6, 0.8]), np.array([0.5, 0.7]), np.array([1.0, -9.0]), 0.02, 0.9999
    system = MassSpringSystem(
        positions=np.array([[1.0, 1.0], [1.0, 1.0] + 2.1 * e]),
        velocities=np.array([[0.0, 0.0], v]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.3),
        rest_lengths=np.array(2.0),
        stiffness=np.array(1.0),
        gravity=g,
        fixed=np.array([True, False]),
    )
    end = ROPE_KICK_DRIFT.on(RopeMotion(system))(system.start, h)
    asked = -(e @ v) / (d * h) - 0.1 / (4 * d * h**2)
    after = v + h * (g + e * (asked - e @ g) / (1 + 1e-3 * (1 - d) / d))
    np.testing.assert_allclose(end.velocities[1], after, rtol=1e-12)
    np.testing.assert_allclose(end.positions[1], system.positions[1] + h * after, rtol=1e-12)
    assert not end.velocities[0].any()
    assert not ROPE_KICK_DRIFT.linear  # it asks for rods, which columns of perturbations are not
    # what is left of r, but for d and R: three quarters, of which turning takes nothing away to first order
    assert e @ (end.positions[1] - system.positions[0]) - 2 == pytest.approx(0.75 * 0.1, rel=1e-3)
