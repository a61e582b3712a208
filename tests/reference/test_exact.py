"""Exact solutions, each against another that knows nothing of it: closed forms, DOP853, equilibria, frequencies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from reference.catalogue import find
from reference.changes import Change
from reference.errors import InputError, SolverError
from reference.exact import (
    damped_oscillator,
    equilibrium,
    exact,
    hanging_string,
    laguerre_frequencies,
    squared_frequencies,
)
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.simulate import simulate
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import label, moving_string, property_test, random_mesh, seeds, with_fields

# --- The damped oscillator ---

#: Solves a system at 0, dt, 2 dt, ...: the exact solution, or a wrong one.
Solver = Callable[[MassSpringSystem, float, int], Trajectory]


def check_oscillator(solve: Solver, mass: float, frequency: float, ratio: float, stretch: float, speed: float) -> None:
    """The closed form of m y'' + (c + Cd) y' + k (y - rest) = 0 against the scene `spring` solved, to 1e-10 m.

    Three periods; the solver's tolerance of 1e-12 of 0.1 m grows to some 1e-12 m over its few hundred steps.

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
    assert np.abs(found.positions[:, 1, 1] - rest - y).max() < 1e-10
    assert np.abs(found.velocities[:, 1, 1] - v).max() < 1e-10 * max(1.0, frequency)


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
    """Under-damped, critically damped and over-damped, within 1e-10 m of DOP853."""
    check_oscillator(exact, mass, frequency, ratio, stretch, speed)


def solved_by(name: str) -> Solver:
    """A catalogued scheme in place of the exact solution."""
    return lambda system, dt, steps: simulate(system, find(name), dt, steps * dt)


def under(law: wrong.Law) -> Solver:
    """The exact solution under a wrong force law."""
    return lambda system, dt, steps: exact(system, dt, steps, equations=wrong.under(law))


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
    """Equations of motion that are not numbers after 5 ms."""

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """NaN, later."""
        return super().acceleration(state, damping) + (np.nan if state.time > 0.005 else 0.0)


def test_exact_says_when_the_solver_gives_up() -> None:
    """No step is small enough for what is not a number."""
    with pytest.raises(SolverError, match="no exact solution"):
        exact(moving_string(2), 0.01, 2, equations=NoNumbers)


# --- Equilibrium ---


def check_balanced(system: MassSpringSystem, rest: State, law: wrong.Law = SpringMotion.acceleration) -> None:
    """All forces on free masses balance: to 1e-11 of the whole weight.

    The stiffest spring's force rounds by k eps L = 1e-14 N times some; the weight is at least 0.1 N.
    """
    weight = float(system.masses.sum() * np.linalg.norm(system.gravity))
    assert np.abs(law(SpringMotion(system), rest) * system.masses[:, None]).max() < 1e-11 * weight
    assert not rest.velocities.any()


@property_test
@given(seed=seeds, masses=st.integers(1, 8))
def test_a_hanging_string_is_in_balance(seed: int, masses: int) -> None:
    """Each spring carries all that is below it: L_j = L0_j + (m_{j+1} + ... + m_n) g / k_j."""
    rng = np.random.default_rng(seed)
    per_item = {
        "mass": rng.uniform(0.01, 0.1, masses).tolist(),
        "rest_length": rng.uniform(0.05, 0.2, masses).tolist(),
        "stiffness": rng.uniform(50, 500, masses).tolist(),
    }
    system = find_scene("string").system({"masses": masses, "x0": 0.3, "y0": -0.2, **per_item})
    check_balanced(system, hanging_string(system))


def test_forces_all_too_strong_balance_at_the_same_place() -> None:
    """What is zero stays zero: this check sees where a string hangs, not how hard it pulls."""
    system = find_scene("string").system({})
    check_balanced(system, hanging_string(system), wrong.slightly_stronger)


@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.one_sided], ids=label)
def test_balance_fails_on_wrong_forces(law: wrong.Law) -> None:
    """Under other forces it would hang elsewhere."""
    system = find_scene("string").system({})
    with pytest.raises(AssertionError):
        check_balanced(system, hanging_string(system), law)


def test_balance_fails_on_an_unstretched_string() -> None:
    """Hanging straight down at its rest lengths, it does not carry its weight."""
    system = find_scene("string").system({"angle": 90.0})
    with pytest.raises(AssertionError):
        check_balanced(system, system.start)


@pytest.mark.parametrize("masses", [1, 2, 5, 10])
def test_equilibrium_of_a_string_is_the_hanging_one(masses: int) -> None:
    """Found by least energy and Newton's method from a slanted start, to 1e-11 of the size.

    The softest swing resists with m g/l x_1/... ~ 0.05 N/m; forces balance to 1e-14 N.
    """
    system = find_scene("string").system({"masses": masses, "angle": 60.0})
    found, straight = equilibrium(system), hanging_string(system)
    assert np.abs(found.positions - straight.positions).max() < 1e-11 * system.size


@pytest.mark.parametrize("seed", range(8))
def test_equilibrium_of_any_held_mesh_is_in_balance(seed: int) -> None:
    """Random meshes in 2D and 3D with two fixed masses."""
    system = random_mesh(seed, 6, 2 + seed % 2, anchors=2)
    check_balanced(system, equilibrium(system))


def test_equilibrium_between_two_anchors_by_hand() -> None:
    """A mass between two anchors: by symmetry in the middle, 2 k (L - L0) sin = m g.

    With L = 0.5 m, anchors 0.8 m apart and so 0.3 m above it: sin = 0.6; m = 2 * 100 * (0.5 - 0.4) * 0.6 / 10.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.35, -0.1], [0.8, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(1.2),
        rest_lengths=np.array(0.4),
        stiffness=np.array(100.0),
        gravity=np.array(10.0),
        fixed=np.array([True, False, True]),
    )
    assert equilibrium(system).positions[1] == pytest.approx([0.4, -0.3], abs=1e-12)


def test_a_falling_system_has_no_equilibrium() -> None:
    """Nothing holds it."""
    with pytest.raises(SolverError, match="no equilibrium: nothing holds the system"):
        equilibrium(with_fields(find_scene("string").system({"masses": 2}), fixed=False))


def test_a_free_system_without_gravity_relaxes() -> None:
    """Every spring at its rest length: no forces."""
    stretched = with_fields(moving_string(3), fixed=False, gravity=0.0)
    relaxed = equilibrium(stretched)
    lengths = np.linalg.norm(np.diff(relaxed.positions, axis=0), axis=1)
    assert lengths == pytest.approx(stretched.rest_lengths, abs=1e-12)


@pytest.mark.parametrize(
    "system",
    [
        random_mesh(1, 5, 2),
        find_scene("string").system({"stiffness": 0.0}),
        replace(find_scene("string").system({"masses": 2}), fixed=np.array([True, False, True])),
        replace(find_scene("string").system({"masses": 2}), gravity=np.array([1.0, -9.81])),
    ],
    ids=["mesh", "no stiffness", "held at both ends", "tilted gravity"],
)
def test_only_strings_hang_straight(system: MassSpringSystem) -> None:
    """Any other system is refused."""
    with pytest.raises(InputError, match="system is no string"):
        hanging_string(system)


# --- Small oscillations ---


def test_frequencies_of_one_hanging_mass() -> None:
    """Along the spring w^2 = k/m; across, the tension m g over the length L it then has: w^2 = g/L."""
    system = find_scene("spring").system({})
    length = 0.125 + 0.02 * 9.81 / 200.0
    squares = squared_frequencies(system, hanging_string(system))
    assert squares == pytest.approx([9.81 / length, 200.0 / 0.02], rel=1e-12)


def along_frequencies(masses: int, stiffness: float, mass: float) -> Array:
    """w^2 = 4 k/m sin^2((2j - 1) pi / (2 (2n + 1))), j = 1..n: a chain fixed at one end (Goldstein, ch. 12)."""
    j = np.arange(1, masses + 1)
    squares: Array = 4 * stiffness / mass * np.sin((2 * j - 1) * np.pi / (2 * (2 * masses + 1))) ** 2
    return squares


@pytest.mark.parametrize("masses", [1, 2, 5, 10, 30])
def test_frequencies_along_a_hanging_string(masses: int) -> None:
    """A straight chain of linear springs keeps the frequencies along itself, however it is stretched, to rounding.

    The matrix holds k/m (1 + rounding); its eigenvalues are within some eps of the largest.
    """
    system = find_scene("string").system({"masses": masses, "stiffness": 1e4})
    squares = squared_frequencies(system, hanging_string(system))
    expected = along_frequencies(masses, 1e4, 0.02)
    nearest = np.abs(squares[:, None] - expected).min(axis=0)
    assert nearest.max() < 1e-12 * expected.max()


def across_frequencies(masses: int, stiffness: float) -> Array:
    """w^2 of a hanging string across itself: the lowest n, when it is stiff."""
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness})
    return squared_frequencies(system, hanging_string(system))[:masses]


def check_laguerre(frequencies: Callable[[int, float], Array], masses: int) -> None:
    """Across, w^2 -> (g/l) x_i with x_i the zeros of the Laguerre polynomial L_n, with an error of O(1/k).

    With f(k) = f + a/k + b/k^2, the differences fall tenfold from k = 1e5 to 1e6 N/m, to within b/a k ~ 1 %, and
    (10 f(1e6) - f(1e5)) / 9 has the error b/1e11 left, and rounding of eps k/m = 1e-8 /s^2.
    """
    limit = laguerre_frequencies(masses, 0.125, 9.81)
    at = {k: frequencies(masses, k) for k in (1e5, 1e6)}
    assert (at[1e5] - limit) / (at[1e6] - limit) == pytest.approx(np.full(masses, 10.0), rel=0.01)
    assert (10 * at[1e6] - at[1e5]) / 9 == pytest.approx(limit, rel=1e-8)


@pytest.mark.parametrize("masses", [1, 2, 5, 10])
def test_frequencies_across_a_stiff_string_are_laguerres(masses: int) -> None:
    """The hanging string's eigenvalues go to Lagrange's loaded string as 1/k."""
    check_laguerre(across_frequencies, masses)


def lightest_at_the_tip(masses: int, stiffness: float) -> Array:
    """The same string with its last mass halved."""
    mass = [0.02] * (masses - 1) + [0.01]
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness, "mass": mass})
    return squared_frequencies(system, hanging_string(system))[:masses]


def unstretched(masses: int, stiffness: float) -> Array:
    """Frequencies about a string that does not carry its weight."""
    system = find_scene("string").system({"masses": masses, "stiffness": stiffness, "angle": 90.0})
    return squared_frequencies(system, system.start)[:masses]


@pytest.mark.parametrize("frequencies", [lightest_at_the_tip, unstretched])
def test_laguerre_fails_on_other_strings(frequencies: Callable[[int, float], Array]) -> None:
    """Another mass, or another place to oscillate about, has other frequencies."""
    with pytest.raises(AssertionError):
        check_laguerre(frequencies, 5)


def test_laguerre_zeros_by_hand() -> None:
    """L_1 = 1 - x and L_2 = (x^2 - 4 x + 2)/2 have the zeros 1 and 2 -+ sqrt(2)."""
    assert laguerre_frequencies(1, 0.5, 9.81) == pytest.approx([19.62], rel=1e-14)
    assert laguerre_frequencies(2, 1.0, 1.0) == pytest.approx([2 - np.sqrt(2), 2 + np.sqrt(2)], rel=1e-14)


def check_small_swing(solve: Solver) -> None:
    """Pushed across by 1e-6 m, a hanging mass swings as x0 cos(w t) with w^2 = g/L.

    Terms of the third order in x0/L are 1e-15 m; the solver's tolerance is 1e-13 m: 1e-11 m is 1e-5 of the swing.
    """
    system = find_scene("spring").system({})
    rest = hanging_string(system)
    pushed = replace(system, positions=rest.positions + np.array([[0.0, 0.0], [1e-6, 0.0]]))
    w = np.sqrt(squared_frequencies(system, rest)[0])
    found = solve(pushed, 0.05, 20)
    assert np.abs(found.positions[:, 1, 0] - 1e-6 * np.cos(w * found.times)).max() < 1e-11


def test_small_swings_have_the_eigenfrequency() -> None:
    """The eigenvalue is what is seen to move."""
    check_small_swing(exact)


@pytest.mark.parametrize("solve", [under(wrong.sideways), under(wrong.gravity_turned), solved_by("backward_euler")])
def test_small_swings_fail_on_wrong_motions(solve: Solver) -> None:
    """Other forces swing otherwise; backward Euler dies away."""
    with pytest.raises(AssertionError):
        check_small_swing(solve)
