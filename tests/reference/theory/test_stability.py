"""Stability limits: predicted ones against closed forms, and against what runs do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import Array
from reference.theory.equilibria import Equilibrium, pendulum_equilibrium, spring_equilibrium
from reference.theory.equilibrium import hanging_string
from reference.theory.limits import (
    explicit_damping_limit,
    fastest_rate,
    growth,
    implicit_damping_limit,
    stability_limit,
)
from reference.theory.linear_motion import LinearMotion
from reference.theory.modes import squared_frequencies, string_mode
from reference.theory.step_coefficients import solves_for_positions
from reference.theory.step_map import step_jacobian
from tests import wrong
from tests.reference.systems import label, random_mesh, with_fields
from tests.reference.theory.test_step_matrices import STEP_MATRICES

#: Limits are found to 1e-7 of themselves; where two eigenvalues meet on the unit circle, a margin of 1e-9 in their
#: modulus makes some 1e-9 in dt. Where they cross it flatly it makes more.
PRECISION = 1e-6


def spring_rest(**parameters: float) -> Equilibrium:
    """One mass hanging at rest: along the spring w = sqrt(k/m) = 100/s, across it sqrt(g/L) = 8.8/s."""
    return string_rest(1, **parameters)


def test_the_string_hanging_at_rest_is_found() -> None:
    """As an equilibrium, from where the scene lets it go: positions in balance, free masses, a length."""
    found, made = spring_equilibrium(find_scene("string").system({})), string_rest()
    assert np.abs(found.state.positions - made.state.positions).max() < 1e-11
    assert found.free.tolist() == made.free.tolist()
    assert found.scale == made.scale


def string_rest(masses: int = 10, **parameters: float) -> Equilibrium:
    """The string hanging at rest. Along itself it is the line of springs of the closed forms; across, it is slower."""
    system = find_scene("string").system({"masses": masses, "angle": 90.0, **parameters})
    return Equilibrium(SpringMotion(system), hanging_string(system), ~system.fixed, 0.125)


# --- One spring ---


def check_limit(scheme: Scheme, rest: Equilibrium, expected: float, precision: float = PRECISION) -> None:
    """The limit is the closed form's."""
    limit = stability_limit(scheme, rest)
    assert limit.dt == pytest.approx(expected, rel=precision)
    assert limit.reason == ""


@pytest.mark.parametrize(
    ("name", "factor"), [("kick_drift", 2.0), ("drift_kick", 2.0), ("velocity_verlet", 2.0), ("rk4", np.sqrt(8.0))]
)
@pytest.mark.parametrize("stiffness", [2.0, 200.0, 2e6])
def test_limits_of_one_undamped_spring(name: str, factor: float, stiffness: float) -> None:
    """Symplectic Euler and Verlet: dt w < 2. rk4: |R(iz)|^2 = 1 - z^6/72 + z^8/576 < 1, so dt w < sqrt(8)."""
    check_limit(find(name), spring_rest(stiffness=stiffness), factor / np.sqrt(stiffness / 0.02))


@pytest.mark.parametrize(
    ("scheme", "factor"),
    [
        (wrong.kick_drift_kicked_twice, 2.0),
        (wrong.heun_without_half, 2.0),
        (wrong.verlet_with_one_force, 2.0),
        (wrong.rk4_equally_weighted, np.sqrt(8.0)),
        (wrong.explicit_in_place_of_backward, 2.0),
        (wrong.kick_drift_gaining_energy, 2.0),
        (wrong.last_mass_forgotten, 2.0),
        (find("rk4"), 2.0),
    ],
    ids=label,
)
def test_limits_fail_on_wrong_schemes(scheme: Scheme, factor: float) -> None:
    """Each has another limit, or none."""
    with pytest.raises(AssertionError):
        check_limit(scheme, spring_rest(), factor / 100.0)


@pytest.mark.parametrize("drag", [0.01, 0.1, 0.5])
def test_eulers_limit_with_drag(drag: float) -> None:
    """|1 + dt lambda|^2 = 1 - dt Cd/m + dt^2 k/m < 1: dt < Cd/k, whatever the mass.

    The modulus may be 1 + 1e-9 before it counts as growth: its square rises by Cd/m per dt there.
    """
    limit = drag / 200.0
    check_limit(find("euler"), spring_rest(drag=drag), limit, PRECISION + 2e-9 / (limit * drag / 0.02))


def test_eulers_limit_fails_on_drag_turned_round() -> None:
    """There is none then."""
    with pytest.raises(AssertionError):
        check_limit(wrong.stepped(wrong.damping_turned, find("euler")), spring_rest(drag=0.1), 0.1 / 200.0)


@pytest.mark.parametrize(
    ("name", "squared"),
    [
        ("euler", 1 + 0.1**2),
        ("euler_in_place", 1 + 0.1**2),
        ("heun", 1 + 0.1**4 / 4),
        ("heun_link_by_link", 1 + 0.1**4 / 4),
        ("heun_aliased", 1 + 0.1**4 / 4),
    ],
)
def test_undamped_euler_and_heun_grow_at_any_dt(name: str, squared: float) -> None:
    """|R(iz)| > 1: there is no limit, and the growth in a step of z = 0.1 is told: sqrt(1 + z^2), sqrt(1 + z^4/4).

    One mass: the in-place variants are what they are meant to be.
    """
    limit = stability_limit(find(name), spring_rest())
    assert limit.dt is None
    assert limit.reason.startswith("unstable at any dt")
    assert limit.growth == pytest.approx(np.sqrt(squared) - 1, rel=1e-5)


#: The schemes that by theory are stable at any dt: |1/(1 - iz)| < 1 and |(1 + iz/2)/(1 - iz/2)| = 1.
WITHOUT_LIMIT = [find("backward_euler"), find("implicit_midpoint")]


@pytest.mark.parametrize("scheme", WITHOUT_LIMIT, ids=label)
def test_implicit_schemes_are_stable_at_any_dt(scheme: Scheme) -> None:
    """By theory, not from having tried: every term of S(h) is positive."""
    limit = stability_limit(scheme, spring_rest())
    assert (limit.dt, limit.reason, limit.certainty) == (None, "stable at any dt", "certified")


# --- The string, against the closed forms and what engines were measured at ---

K, M, W2 = 200.0, 0.02, 200.0 / 0.02 * string_mode(10)


def polynomial_limit(name: str, damping: float) -> float:
    """The dt [s] at which the fastest mode's step matrix, in closed form, leaves the unit circle, by bisection."""
    gamma = damping * string_mode(10) / M

    def stable(dt: float) -> bool:
        return bool(np.abs(np.linalg.eigvals(STEP_MATRICES[name](dt, W2, gamma, 0.0))).max() <= 1 + 1e-12)

    low, high = 1e-3, 1e-1
    while high / low > 1 + 1e-9:
        middle = np.sqrt(low * high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


@pytest.mark.parametrize(
    ("name", "damping", "measured"),
    [
        ("kick_drift", 0.0, 0.01011295),
        ("kick_drift", 0.1, 0.00962531),
        ("kick_drift", 0.5, 0.00791738),
        ("kick_drift_implicit_damping", 0.1, 0.01062531),
        ("kick_drift_implicit_damping", 0.5, 0.01291738),
        ("drift_kick_implicit_damping", 0.5, 0.01291738),
        ("drift_kick_exponential_damping", 0.1, 0.01065425),
        ("drift_kick_exponential_damping", 0.5, 0.01441410),
        ("rk4", 0.0, 0.01430188),
        ("rk4", 0.1, 0.01470997),
        ("rk4", 0.5, 0.01466209),
    ],
)
def test_limits_of_the_default_string(name: str, damping: float, measured: float) -> None:
    """Where eigenvalues of engines' own steps leave the unit circle on this string, to seven digits.

    Steps differenced as in tests/conformance/test_jacobian.py; the closed forms and step matrices below agree.
    """
    check_limit(find(name), string_rest(damping=damping), measured, 2e-6)


@pytest.mark.parametrize("damping", [0.0, 0.02, 0.1, 0.5, 2.0])
def test_explicit_and_implicit_damping_have_their_closed_forms(damping: float) -> None:
    """Explicit: dt^2 w^2 + 2 gamma dt < 4; implicit: dt^2 w^2 < 4 + 2 gamma dt, where gamma = (c/m) lambda.

    The two roots of each are the closed forms; predicted about the hanging string, whose springs are stretched.
    """
    gamma = damping / M * string_mode(10)
    explicit, implicit = explicit_damping_limit(np.sqrt(W2), gamma), implicit_damping_limit(np.sqrt(W2), gamma)
    assert explicit**2 * W2 + 2 * gamma * explicit == pytest.approx(4.0, rel=1e-12)
    assert implicit**2 * W2 == pytest.approx(4.0 + 2 * gamma * implicit, rel=1e-12)
    check_limit(find("kick_drift"), string_rest(damping=damping), explicit)
    check_limit(find("kick_drift_implicit_damping"), string_rest(damping=damping), implicit)


@pytest.mark.parametrize("damping", [0.02, 0.1, 0.5])
@pytest.mark.parametrize("name", ["rk4", "velocity_verlet", "kick_drift", "kick_drift_implicit_damping"])
def test_limits_are_where_the_step_matrix_leaves_the_unit_circle(name: str, damping: float) -> None:
    """That of the fastest mode, bisected apart."""
    check_limit(find(name), string_rest(damping=damping), polynomial_limit(name, damping))


def test_drags_limit_on_the_default_string() -> None:
    """Explicit drag: dt^2 w^2 + 2 dt Cd/m < 4 for every mode: with Cd = 0.1 N s/m, 0.0099859 s."""
    expected = explicit_damping_limit(np.sqrt(W2), 0.1 / M)
    assert expected == pytest.approx(0.0099859, rel=1e-5)
    check_limit(find("kick_drift"), string_rest(drag=0.1), expected)


@pytest.mark.parametrize(
    ("scheme", "expected"),
    [
        (find("kick_drift"), implicit_damping_limit(np.sqrt(W2), 0.5 / M * string_mode(10))),
        (find("kick_drift_implicit_damping"), explicit_damping_limit(np.sqrt(W2), 0.5 / M * string_mode(10))),
        (wrong.kick_drift_kicked_twice, explicit_damping_limit(np.sqrt(W2), 0.5 / M * string_mode(10))),
        (wrong.in_order_of_number, explicit_damping_limit(np.sqrt(W2), 0.5 / M * string_mode(10))),
    ],
    ids=label,
)
def test_damped_limits_fail_on_other_schemes(scheme: Scheme, expected: float) -> None:
    """Explicit is not implicit, and wrong is neither."""
    with pytest.raises(AssertionError):
        check_limit(scheme, string_rest(damping=0.5), expected)


@pytest.mark.parametrize(("seed", "dimension"), [(1, 2), (3, 2), (4, 3), (5, 3)])
def test_kick_drifts_limit_on_any_undamped_mesh(seed: int, dimension: int) -> None:
    """The limit is 2/w for the fastest mode of K q = w^2 M q, whatever the mesh; none of these has a mode of w = 0."""
    mesh = random_mesh(seed, 5, dimension, anchors=2)
    undamped = with_fields(mesh, damping=0.0, drag=0.0)
    rest = spring_equilibrium(undamped)
    check_limit(find("kick_drift"), rest, 2 / np.sqrt(squared_frequencies(undamped, rest.state).max()))


def test_a_pendulums_limit() -> None:
    """Kick-drift in the angles: dt < 2/w with w^2 = (g/l) x_n, the largest zero of L_3, 6.2899."""
    rest = pendulum_equilibrium(find_scene("string").system({"masses": 3}))
    largest = np.roots([-1, 9, -18, 6]).max()
    check_limit(find("kick_drift"), rest, 2 / np.sqrt(9.81 / 0.125 * largest))


# --- The Jacobian ---


@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.name in STEP_MATRICES], ids=label)
def test_jacobian_of_one_spring_is_its_step_matrix(scheme: Scheme) -> None:
    """Along the spring, with velocities in lengths per step; by differences it is right to some 1e-11."""
    dt, damping, drag = 5e-3, 0.1, 0.05
    jacobian = step_jacobian(scheme, spring_rest(damping=damping, drag=drag), dt)
    along = jacobian[np.ix_([1, 3], [1, 3])]
    scale = np.array([[1.0, 1 / dt], [dt, 1.0]])
    expected = STEP_MATRICES[scheme.name](dt, K / M, damping / M, drag / M) * scale
    # A solver that stops at 1e-8 m/s leaves as much of a push of 7e-4 of 0.125 m over 5 ms.
    assert along == pytest.approx(expected, abs=1e-10)
    across = jacobian[np.ix_([0, 2], [1, 3])]
    assert np.abs(across).max() < 1e-10


LINEARISED = [s for s in schemes().values() if s.linear]


def check_linearised(scheme: Scheme) -> None:
    """On a string, in all directions; differences are right to some 1e-11 of a push that becomes a push."""
    rest = string_rest(4, damping=0.1, drag=0.05)
    exactly = step_jacobian(scheme, rest, 3e-3)
    differenced = step_jacobian(replace(scheme, linear=False), rest, 3e-3)
    assert np.abs(exactly - differenced).max() < 1e-9


@pytest.mark.parametrize("scheme", LINEARISED, ids=label)
def test_exact_jacobians_are_what_differences_say(scheme: Scheme) -> None:
    """Schemes that need accelerations only, or solve linear equations, are linearised exactly; told not to be, not."""
    check_linearised(scheme)


@pytest.mark.parametrize("name", ["backward_euler", "implicit_midpoint"])
def test_linearised_jacobians_fail_with_other_equations(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Newton's method with springs that are a millionth too stiff finds the same solution of a linear motion.

    With such accelerations it finds another.
    """
    right = LinearMotion.jacobians
    monkeypatch.setattr(
        LinearMotion, "jacobians", lambda motion, state: tuple(1.000001 * b for b in right(motion, state))
    )
    check_linearised(find(name))
    acceleration = LinearMotion.acceleration
    monkeypatch.setattr(LinearMotion, "acceleration", lambda motion, state: 1.000001 * acceleration(motion, state))
    with pytest.raises(AssertionError):
        check_linearised(find(name))


def check_frequencies(scheme: Scheme) -> None:
    """Kick-drift turns each mode by theta in a step, 2 sin(theta/2) = dt w: its step matrix has the trace 2 - dt^2 w^2.

    So eigenvalues of the step give back all eigenfrequencies of the hanging string, to the rounding of the fastest.
    """
    system = find_scene("string").system({"masses": 5})
    rest, dt = string_rest(5), 4e-3
    values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
    found = np.sort((2 * np.sin(np.abs(np.angle(values)) / 2) / dt) ** 2)[::2]
    expected = squared_frequencies(system, hanging_string(system))
    assert np.abs(np.abs(values) - 1).max() < 1e-9
    assert found == pytest.approx(expected, rel=1e-8)


def test_kick_drifts_step_has_the_strings_frequencies() -> None:
    """Predicted by one eigenvalue problem, found by another."""
    check_frequencies(find("kick_drift"))


@pytest.mark.parametrize(
    "scheme",
    [
        find("euler"),
        wrong.kick_drift_kicked_twice,
        wrong.kick_drift_gaining_energy,
        wrong.in_order_of_number,
        wrong.last_mass_forgotten,
        wrong.stepped(wrong.one_sided, find("kick_drift")),
    ],
    ids=label,
)
def test_frequencies_fail_on_wrong_schemes(scheme: Scheme) -> None:
    """Turned by another angle, or grown."""
    with pytest.raises(AssertionError):
        check_frequencies(scheme)


def test_fastest_rates_in_closed_form() -> None:
    """Undamped: the highest frequency. Over-damped: c/2m + sqrt((c/2m)^2 - k/m), the fast decay."""
    assert fastest_rate(string_rest()) == pytest.approx(np.sqrt(W2), rel=1e-9)
    half = 10.0 / (2 * M)
    assert fastest_rate(spring_rest(damping=10.0)) == pytest.approx(half + np.sqrt(half**2 - K / M), rel=1e-9)


# --- Runs ---


def push_after(scheme: Scheme, rest: Equilibrium, dt: float, steps: int) -> float:
    """By how much a random push of 1e-9 m of a system at rest has grown after so many steps."""
    assert isinstance(rest.motion, SpringMotion)
    still = rest.state.positions
    push = np.where(rest.free[:, None], 1e-9 * np.random.default_rng(0).normal(size=still.shape), 0.0)
    run = simulate(replace(rest.motion.system, positions=still + push), scheme, dt, steps * dt)
    left: Array = np.abs(run.positions[-1] - still)
    return float(left.max() / np.abs(push).max())


def check_limit_by_runs(scheme: Scheme, predicted: Callable[[Equilibrium], float | None]) -> None:
    """10 % below its limit a push stays small, 20 % above it grows, in as many steps as should make 1e6 of it.

    A random push has a part of the growing mode of about 1/4; a thousandfold growth is far below 1e6/4, and the most
    that a push which does not grow can swell to on its way, 1/sqrt(1 - 0.9^2) = 2.3, far below 10.
    """
    rest = string_rest(4, damping=0.05, drag=1.0)
    dt = predicted(rest)
    assert dt is not None
    per_step = growth(scheme, rest, 1.2 * dt)
    assert per_step > 1.001
    steps = int(np.log(1e6) / np.log(per_step)) + 10
    assert push_after(scheme, rest, 0.9 * dt, steps) < 10
    assert push_after(scheme, rest, 1.2 * dt, steps) > 1e3


@pytest.mark.rotating(4)
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s not in WITHOUT_LIMIT], ids=label)
def test_runs_blow_up_where_predicted(scheme: Scheme) -> None:
    """Every scheme that has a limit, the in-place ones and the engines' among them."""
    check_limit_by_runs(scheme, lambda rest: stability_limit(scheme, rest).dt)


@pytest.mark.parametrize(
    ("scheme", "other"),
    [(find("euler"), "heun"), (wrong.kick_drift_kicked_twice, "kick_drift"), (find("rk4"), "heun")],
    ids=label,
)
def test_limit_by_runs_fails_on_anothers_prediction(scheme: Scheme, other: str) -> None:
    """The limit of another scheme is not where this one blows up."""
    with pytest.raises(AssertionError):
        check_limit_by_runs(scheme, lambda rest: stability_limit(find(other), rest).dt)


def test_which_steps_solve_for_positions_is_seen_in_them() -> None:
    """Of their stiffness part, whatever they are called: those two of the catalogue that are implicit in positions."""
    named = [name for name, scheme in schemes().items() if scheme.kind == "scheme" and solves_for_positions(scheme)]
    assert named == ["backward_euler", "implicit_midpoint"]
