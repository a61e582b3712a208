"""The deliberately incorrect schemes: where they are right after all, and what they cost and give.

Their orders, momentum and dependence on numbering are with the same checks for all schemes, in test_schemes.py and
test_conserved.py.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from tests import wrong
from tests.reference.systems import IN_PLACE, label, moving_string

#: What each in-place variant is meant to be.
MEANT = {"euler_in_place": "euler", "heun_link_by_link": "heun", "heun_aliased": "heun"}


def test_every_in_place_scheme_is_meant_to_be_a_right_one() -> None:
    """The table here is complete."""
    assert set(MEANT) == {scheme.name for scheme in IN_PLACE}


@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_one_mass_has_no_neighbour_to_be_wrong_with(scheme: Scheme) -> None:
    """On a single mass the in-place variants are the right schemes by theory, and here they are to the bit."""
    system = moving_string(1, damping=0.05, drag=0.02)
    meant = simulate(system, find(MEANT[scheme.name]), 1e-3, 0.1)
    assert simulate(system, scheme, 1e-3, 0.1).positions.tolist() == meant.positions.tolist()


@pytest.mark.parametrize("masses", [2, 3, 10])
@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_two_masses_are_enough_to_be_wrong(scheme: Scheme, masses: int) -> None:
    """From two masses on, the difference to what is meant shows after 100 steps, by over 1e-6 of the size."""
    system = moving_string(masses, damping=0.05)
    meant = simulate(system, find(MEANT[scheme.name]), 1e-3, 0.1)
    assert simulate(system, scheme, 1e-3, 0.1).distance(meant).max() > 1e-6 * system.size


def test_first_mass_is_right_and_the_second_sees_it_moved() -> None:
    """Euler in place: mass 1 takes Euler's step; mass 2 feels the spring to where mass 1 has gone, by hand.

    On a horizontal string at its rest lengths, mass 1 thrown along it at v has moved dt v towards mass 2 when that
    looks: the spring pushes it with k dt v.
    """
    string = find_scene("string").system({"masses": 2, "gravity": 0.0})
    start = string.start.kick(np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.0]]))
    end = find("euler_in_place").step(SpringMotion(string), start, 1e-3)
    right = find("euler").step(SpringMotion(string), start, 1e-3)
    assert end.velocities[1].tolist() == right.velocities[1].tolist()
    assert right.velocities[2].tolist() == [0.0, 0.0]
    # k/m dt (dt v); the difference of the two positions rounds by eps 0.125 m, 3e-14 of 5e-4 m.
    assert end.velocities[2, 0] == pytest.approx(1e-3 * 200.0 / 0.02 * (1e-3 * 0.5), rel=1e-12)


N, K, M, DRAG = 10, 50.0, 0.02, 0.2


def pull(u: Array, v: Array, i: int) -> float:
    """The acceleration of mass i of a hanging string along itself, u and v measured from rest: a line of springs."""
    above = u[i - 1] if i > 0 else 0.0
    below = u[i + 1] - u[i] if i + 1 < N else 0.0
    return float((K * (above - u[i]) + K * below - DRAG * v[i]) / M)


def euler_in_place(u: Array, v: Array, dt: float) -> None:
    """One line of masses, in place."""
    for i in range(N):
        a = pull(u, v, i)
        u[i], v[i] = u[i] + dt * v[i], v[i] + dt * a


def heun_link_by_link(u: Array, v: Array, dt: float) -> None:
    """Predictor and corrector of one mass before the next."""
    for i in range(N):
        u0, v0, a0 = u[i], v[i], pull(u, v, i)
        u[i], v[i] = u0 + dt * v0, v0 + dt * a0
        v1, a1 = v[i], pull(u, v, i)
        u[i], v[i] = u0 + dt / 2 * (v0 + v1), v0 + dt / 2 * (a0 + a1)


def heun_aliased(u: Array, v: Array, dt: float) -> None:
    """All predicted in place, then all corrected in place."""
    before = [(u[i], v[i]) for i in range(N)]
    slopes = []
    for i in range(N):
        slopes.append((v[i], pull(u, v, i)))
        u[i], v[i] = u[i] + dt * slopes[i][0], v[i] + dt * slopes[i][1]
    for i in range(N):
        (u0, v0), (v_first, a_first), v1, a1 = before[i], slopes[i], v[i], pull(u, v, i)
        u[i], v[i] = u0 + dt / 2 * (v_first + v1), v0 + dt / 2 * (a_first + a1)


def euler(u: Array, v: Array, dt: float) -> None:
    """All at once."""
    a = np.array([pull(u, v, i) for i in range(N)])
    u[:], v[:] = u + dt * v, v + dt * a


def heun(u: Array, v: Array, dt: float) -> None:
    """All at once."""
    a = np.array([pull(u, v, i) for i in range(N)])
    u1, v1 = u + dt * v, v + dt * a
    a1 = np.array([pull(u1, v1, i) for i in range(N)])
    u[:], v[:] = u + dt / 2 * (v + v1), v + dt / 2 * (a + a1)


def limit(advance: Callable[[Array, Array, float], None]) -> float:
    """The dt [s] from which on the spectral radius of a step along the line exceeds 1, by bisection."""

    def radius(dt: float) -> float:
        columns = []
        for push in np.eye(2 * N):
            u, v = push[:N].copy(), push[N:].copy()
            advance(u, v, dt)
            columns.append(np.concatenate([u, v]))
        return float(np.abs(np.linalg.eigvals(np.array(columns).T)).max())

    low, high = 1e-4, 1e-1
    while high / low > 1 + 1e-5:
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if radius(middle) <= 1 + 1e-12 else (low, middle)
    return low


#: Each scheme's twin on a line of masses, where a string hanging at rest is least stable: its swings are slower.
ON_A_LINE = {f.__name__: f for f in (euler, heun, euler_in_place, heun_link_by_link, heun_aliased)}


def stable_dt(scheme: Scheme) -> float | None:
    """The largest stable dt [s], or None, of the lecture's string: n = 10, k = 50 N/m, Cd = 0.2 N s/m, at rest."""
    system = find_scene("string").system({"masses": N, "stiffness": K, "mass": M, "drag": DRAG})
    return stability_limit(scheme, spring_equilibrium(system)).dt


def check_stable_dt(scheme: Scheme, twin: str) -> None:
    """The largest stable dt is that of the linear string, solved apart; its bisection stops within 1e-5."""
    assert stable_dt(scheme) == pytest.approx(limit(ON_A_LINE[twin]), rel=3e-5)


@pytest.mark.parametrize("name", ON_A_LINE)
def test_stable_dt_is_that_of_the_linear_string(name: str) -> None:
    """Predicted from the step map's eigenvalues, in-place variants included."""
    check_stable_dt(find(name), name)


@pytest.mark.parametrize(
    ("scheme", "twin"),
    [
        (wrong.heun_without_half, "heun"),
        (wrong.in_order_of_number, "euler_in_place"),
        (wrong.stepped(wrong.damping_turned, find("euler")), "euler"),
        (find("heun"), "heun_link_by_link"),
    ],
    ids=label,
)
def test_stable_dt_fails_on_other_integrators(scheme: Scheme, twin: str) -> None:
    """Each has a limit of its own, or none."""
    with pytest.raises(AssertionError):
        check_stable_dt(scheme, twin)


@pytest.mark.parametrize(("in_place", "meant"), [("euler_in_place", "euler"), ("heun_link_by_link", "heun")])
def test_in_place_variants_bear_larger_steps_than_what_they_are_meant_to_be(in_place: str, meant: str) -> None:
    """Stable is not accurate: over 30 % larger steps, at an order less (Heun's) or an error more (Euler's)."""
    larger, smaller = stable_dt(find(in_place)), stable_dt(find(meant))
    assert larger is not None
    assert smaller is not None
    assert larger > 1.3 * smaller
