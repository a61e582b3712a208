"""Solvers of constraints: one mass in closed form, converged limits, momentum, order, and true single precision."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.conserved import momentum
from reference.errors import InputError, SolverError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.block_descent import inverted
from reference.schemes.catalogue import Scheme, constraint_schemes, find, schemes
from reference.state import Array, State
from reference.stepper import SchemeStepper, stepper_named
from reference.system import MassSpringSystem
from tests.reference.systems import label
from tests.wrong import kick_drift_kicked_twice

STRING = find_scene("string").system({"masses": 4, "damping": 0.02})

#: On one mass each of them is backward Euler: (h [s], w^2 [1/s^2], c/m [1/s]).
ONE_MASS = (0.02, 900.0, 3.0)

AS_BACKWARD_EULER = [
    "soft_constraints_warm",
    "soft_constraints_cold(substeps=1)",
    "soft_constraints_cold(substeps=1, sweeps=10)",
    "xpbd_jacobi",
    "xpbd_gauss_seidel(substeps=1)",
    "vertex_block_descent",
    "temporal_gauss_seidel(substeps=1, sweeps_after=0)",
]


def one_step(name: str, x: float, v: float, h: float, square: float, rate: float) -> Array:
    """A step of one mass of 1 kg on a line, x from where its spring is at rest: its x and v afterwards."""
    system = MassSpringSystem(
        positions=np.array([[0.0], [1.0 + x]]),
        springs=np.array([[0, 1]]),
        masses=np.array([1.0, 1.0]),
        rest_lengths=np.array(1.0),
        stiffness=np.array(square),
        damping=np.array(rate),
        gravity=np.zeros(1),
        fixed=np.array([True, False]),
    )
    state = State(0.0, system.positions, np.array([[0.0], [v]]))
    end = find(name).on(SpringMotion(system))(state, h)
    return np.array([end.positions[1, 0] - 1.0, end.velocities[1, 0]])


def backward_euler(x: float, v: float, h: float, square: float, rate: float) -> Array:
    """V' = (v - h w^2 x)/(1 + h c/m + h^2 w^2), x' = x + h v'."""
    end = (v - h * square * x) / (1 + h * rate + h * h * square)
    return np.array([x + h * end, end])


@pytest.mark.parametrize("name", AS_BACKWARD_EULER)
def test_one_mass_is_stepped_by_backward_euler(name: str) -> None:
    """To rounding, some 1e-16 of 1 m; shown to fail by semi-implicit Euler, which differs by 1 in the first digit."""
    for x, v in ((0.1, 0.0), (-0.05, 2.0)):
        assert np.abs(one_step(name, x, v, *ONE_MASS) - backward_euler(x, v, *ONE_MASS)).max() < 1e-14
        assert np.abs(one_step("kick_drift", x, v, *ONE_MASS) - backward_euler(x, v, *ONE_MASS)).max() > 1e-3


def test_one_mass_of_box2d_3_is_damped_twice() -> None:
    """Its step: u = (v - h w^2 x)/(1 + h^2 w^2), x' = x + h u, v' = (v - h w^2 x')/(1 + h^2 w^2), from no impulse.

    With s = h w its determinant is 1/(1 + s^2)^2; backward Euler's is 1/(1 + s^2).
    """
    h, square, _ = ONE_MASS
    part = 1 / (1 + h * h * square)
    for x, v in ((0.1, 0.0), (-0.05, 2.0)):
        u = (v - h * square * x) * part
        after = x + h * u
        expected = np.array([after, (v - h * square * after) * part])
        found = one_step("soft_constraints_relaxed(substeps=1)", x, v, h, square, 0.0)
        assert np.abs(found - expected).max() < 1e-14
        assert np.abs(found - backward_euler(x, v, h, square, 0.0)).max() > 1e-3


def test_one_mass_of_temporal_gauss_seidel_is_a_row_of_backward_eulers() -> None:
    """As many of h = dt/n as there are sub-steps; then v/(1 + h c/m + h^2 w^2) in every sweep after them.

    To rounding; shown to fail by one sub-step fewer, and without the sweep.
    """
    dt, square, rate = ONE_MASS
    for n, after in ((4, 1), (10, 2), (3, 0)):
        state, h = np.array([0.1, -2.0]), dt / n
        for _ in range(n):
            state = backward_euler(state[0], state[1], h, square, rate)
        state[1] /= (1 + h * rate + h * h * square) ** after
        words = (f"substeps={n}, sweeps_after={after}", f"substeps={n - 1}, sweeps_after={after}")
        right, fewer = (one_step(f"temporal_gauss_seidel({w})", 0.1, -2.0, *ONE_MASS) for w in words)
        assert np.abs(right - state).max() < 1e-14
        assert np.abs(fewer - state).max() > 1e-4
        other = one_step(f"temporal_gauss_seidel(substeps={n}, sweeps_after={after + 1})", 0.1, -2.0, *ONE_MASS)
        assert abs(other[1] - state[1]) > 1e-2


def test_damping_that_is_a_stiffness_too_is_sapiens() -> None:
    """What SAPIEN 3.0.3 makes of (x, h v) in a step of 1/16 s with h^2 k/m = 1/2, h c/m = 0.3, two sub-steps, no sweep.

    Within 2e-7, its rounding; as damping should be, it is 4e-4 off. In a single sub-step there is no difference, as
    the elongation has gained nothing, and without damping none.
    """
    dt = 1 / 16
    seen = np.array([[0.73704672, 0.659657], [-0.32982844, 0.53500009]])

    def matrix(words: str) -> Array:
        columns = [one_step(f"temporal_gauss_seidel({words})", *begun, dt, 128.0, 4.8) for begun in ((1e-3, 0), (0, 1))]
        return np.array([columns[0] / 1e-3, columns[1] / dt]).T * [[1], [dt]]

    assert np.abs(matrix("damping_as_stiffness=True, substeps=2, sweeps_after=0") - seen).max() < 2e-7
    assert 3e-4 < np.abs(matrix("substeps=2, sweeps_after=0") - seen).max() < 1e-2
    same = [matrix(f"damping_as_stiffness={word}, substeps=1") for word in (True, False)]
    assert np.array_equal(*same)


@pytest.mark.rotating(5)
def test_vertex_block_descent_converges_to_backward_euler_and_xpbd_nearly() -> None:
    """With enough sweeps, one mass after the other: within 1e-9 m after 20 steps of 5 ms.

    XPBD's sums converge, too, but each correction was along the direction that its spring had then: what they add up
    to is not quite along the last. That is 6e-6 m here.
    """
    undamped = replace(STRING, damping=np.zeros(4))
    right = stepper_named("backward_euler").run(undamped, 5e-3, 20).trajectory
    assert right is not None

    def off(name: str) -> float:
        found = stepper_named(name).run(undamped, 5e-3, 20).trajectory
        assert found is not None
        return float(np.abs(found.positions - right.positions).max())

    assert off("vertex_block_descent(iterations=400, jacobi=False)") < 1e-9
    assert off("xpbd_gauss_seidel(substeps=1, sweeps=400)") == pytest.approx(6.3e-6, rel=0.02)
    assert off("xpbd_gauss_seidel(substeps=1, sweeps=1)") > 1e-4


def test_soft_constraints_converge_to_backward_euler_linearised() -> None:
    """(M + sum of h (c + h k) e e^T) v' = M (v + h g) - h sum of k C e, e and C of the start; x' = x + h v'.

    Within 1e-12 m/s, after 400 sweeps.
    """
    h, system = 5e-3, STRING
    x, v = system.positions + 0.01 * np.sin(np.arange(10)).reshape(5, 2), np.cos(np.arange(10)).reshape(5, 2)
    x[0], v[0] = system.positions[0], 0.0
    matrix, right = (
        np.eye(8) * np.repeat(system.masses[1:], 2),
        (system.masses[1:, None] * (v[1:] + h * system.gravity)).ravel(),
    )
    for j, (a, b) in enumerate(system.springs):
        gap = x[b] - x[a]
        length = np.linalg.norm(gap)
        row = np.zeros((5, 2))
        row[b], row[a] = gap / length, -gap / length
        e = row[1:].ravel()
        matrix += h * (system.damping[j] + h * system.stiffness[j]) * np.outer(e, e)
        right -= h * system.stiffness[j] * (length - system.rest_lengths[j]) * e
    velocities = np.linalg.solve(matrix, right).reshape(4, 2)
    for name in ("soft_constraints_warm(sweeps=400)", "soft_constraints_cold(substeps=1, sweeps=400, sweeps_after=0)"):
        end = find(name).on(SpringMotion(system))(State(0.0, x, v), h)
        assert np.abs(end.velocities[1:] - velocities).max() < 1e-12
        assert np.abs(end.positions[1:] - (x[1:] + h * velocities)).max() < 1e-12


@pytest.mark.parametrize("known", constraint_schemes().values(), ids=label)
def test_momentum_is_kept(known: Scheme) -> None:
    """Every correction is equal and opposite: of a floating string it stays to rounding, except by single masses.

    Vertex block descent moves one mass at a time, or all from the same positions, and what it has not solved for is
    momentum.
    """
    floating = replace(STRING, fixed=np.zeros(5, dtype=bool), gravity=np.zeros(2))
    velocities = np.sin(np.arange(10)).reshape(5, 2)
    name = "vertex_block_descent(iterations=1)" if known.name == "vertex_block_descent" else known.name
    trajectory = stepper_named(name).run(replace(floating, velocities=velocities), 2e-3, 30).trajectory
    assert trajectory is not None
    first, *_, last = (momentum(floating, state) for state in trajectory.states())
    lost = np.abs(last - first).max()
    assert (lost < 1e-13) == (known.name != "vertex_block_descent")


def nearer_at_half_the_step(known: Scheme) -> float:
    """How many times nearer to RK4, at a twentieth of the step, after 0.1 s."""
    system = find_scene("string").system({"masses": 2, "stiffness": 50.0, "damping": 0.05})
    right = stepper_named("rk4").run(system, 1e-4, 1000).trajectory
    assert right is not None
    off = []
    for dt in (2e-3, 1e-3):
        found = SchemeStepper(known).run(system, dt, round(0.1 / dt)).trajectory
        assert found is not None
        off.append(np.abs(found.positions[-1] - right.positions[-1]).max())
    return float(off[0] / off[1])


@pytest.mark.rotating(3)
@pytest.mark.parametrize("known", constraint_schemes().values(), ids=label)
def test_they_are_of_first_order(known: Scheme) -> None:
    """Half the step, half the distance: between 1.7 and 2.4 times less.

    One sweep is not the whole solution, but what it leaves goes as the step does, too.
    """
    assert 1.7 < nearer_at_half_the_step(known) < 2.4


def test_one_that_kicks_twice_is_not_of_first_order() -> None:
    """Shown to fail: it comes nowhere near, whatever the step."""
    assert nearer_at_half_the_step(kick_drift_kicked_twice) < 1.3


@pytest.mark.rotating(3)
@pytest.mark.parametrize("known", constraint_schemes().values(), ids=label)
def test_in_single_precision_every_number_is_single(known: Scheme) -> None:
    """Each position and velocity after a step is one of single precision, and off the double's by its rounding."""
    name = known.name
    ends = [stepper_named(f"{name}(single={single})").run(STRING, 2e-3, 3).trajectory for single in (True, False)]
    single, double = ends
    assert single is not None
    assert double is not None
    for numbers in (single.positions[1:], single.velocities[1:]):
        assert np.array_equal(numbers, numbers.astype(np.float32).astype(float))
    assert 0 < np.abs(single.positions - double.positions).max() < 1e-6


def test_they_are_run_where_they_are_named_only() -> None:
    """In no catalogue of all, and found by name."""
    assert not set(constraint_schemes()) & set(schemes())
    assert find("xpbd_jacobi(iterations=3)").parameters["iterations"] == 3
    with pytest.raises(InputError, match="did you mean 'reversed'"):
        stepper_named("soft_constraints_warm(order=reverse)").scheme.on(SpringMotion(STRING))(STRING.start, 1e-3)


def test_drag_comes_first_or_last() -> None:
    """A mass of 2 kg that nothing pulls, drag 0.5 N s/m, h = 0.1 s: v (1 - h Cd/m), or v/(1 + h Cd/m)."""
    one = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(2.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(0.0),
        gravity=np.zeros(2),
        drag=0.5,
    )
    state = State(0.0, one.positions, np.array([[3.0, 0.0], [3.0, 0.0]]))
    for name, expected in (("drag_first=True, ", 3 * (1 - 0.1 * 0.25)), ("", 3 / (1 + 0.1 * 0.25))):
        end = find(f"soft_constraints_cold({name}substeps=1)").on(SpringMotion(one))(state, 0.1)
        assert end.velocities[1, 0] == pytest.approx(expected, rel=1e-14)


def test_vertex_block_descent_rounds_as_newton_does() -> None:
    """What Newton 1.8.0's SolverVBD left of the string's last mass after 60 steps of 1/60 s: every bit of it.

    Shown to fail by one iteration fewer, and by the same in double precision.
    """
    system = find_scene("string").system({"damping": 0.5})

    def last(words: str) -> list[float]:
        trajectory = stepper_named(f"vertex_block_descent({words})").run(system, 1 / 60, 60).trajectory
        assert trajectory is not None
        return [*trajectory.positions[-1, -1].tolist(), *trajectory.velocities[-1, -1].tolist()]

    newton = [-1.1204438209533691, -0.689264714717865, -1.0581278800964355, 2.17104434967041]
    assert last("single=True") == newton
    for wrong in ("iterations=9, single=True", "single=False"):
        assert last(wrong) != newton


def test_xpbd_that_forgets_gets_stiffer_with_every_iteration() -> None:
    """Each leaves a/(1/m + a) of the elongation there is, a = 1/(k h^2): of C0 that power of it, not C0/(1 + h^2 k/m).

    Shown to differ from the one that accumulates, which is backward Euler, from the second iteration on.
    """
    h, square, _ = ONE_MASS
    left = 1 / (1 + h * h * square)
    for n in (1, 2, 5):
        found = one_step(f"xpbd_jacobi(accumulated=False, iterations={n})", 0.1, 0.0, h, square, 0.0)
        assert found == pytest.approx([0.1 * left**n, 0.1 * (left**n - 1) / h], rel=1e-12)
        kept = one_step(f"xpbd_jacobi(iterations={n})", 0.1, 0.0, h, square, 0.0)
        assert (abs(found[0] - kept[0]) < 1e-14) == (n == 1)


def test_damping_that_brakes_slows_free_fall() -> None:
    """A spring of rest length that falls along itself: m (y - x)/h^2 = c k/h (x - x0), so v = h g/(1 + c k h/m).

    To rounding after 60 iterations, each of which leaves less than a third of what is missing; undamped, or damped
    along the spring, it falls as it should.
    """
    m, k, c, h, g = 0.5, 40.0, 0.3, 0.05, -9.81
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, 1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(m),
        rest_lengths=np.array(1.0),
        stiffness=np.array(k),
        damping=np.array(c),
        gravity=np.array([0.0, g]),
        fixed=np.zeros(2, dtype=bool),
    )
    for name, expected in (("braked=True, ", h * g / (1 + c * k * h / m)), ("", h * g)):
        end = find(f"vertex_block_descent({name}iterations=60)").on(SpringMotion(system))(system.start, h)
        assert end.velocities == pytest.approx(np.array([[0.0, expected]] * 2), rel=1e-12)


def test_blocks_are_inverted_by_cofactors() -> None:
    """With their determinants, sign and all, as NumPy has them; one of determinant 0 has no finite inverse."""
    matrices = np.random.default_rng(2).normal(size=(5, 3, 3))
    inverse, determinants = inverted(matrices)
    np.testing.assert_allclose(determinants, np.linalg.det(matrices), rtol=1e-12)
    np.testing.assert_allclose(inverse @ matrices, np.broadcast_to(np.eye(3), (5, 3, 3)), atol=1e-12)
    assert not np.isfinite(inverted(np.ones((1, 3, 3)))[0]).any()


def test_a_block_of_one_mass_that_is_infinite_is_no_step() -> None:
    """In single precision, where a spring is as stiff as 1e35 N/m; the block of the mass below is as it should be."""
    string = find_scene("string").system({"masses": 2, "stiffness": "1e35,200"})
    with pytest.raises(SolverError, match="infinite"), np.errstate(over="ignore", invalid="ignore"):
        find("vertex_block_descent(single=True)").on(SpringMotion(string))(string.start, 1e-3)
