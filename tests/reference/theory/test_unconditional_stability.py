"""Schemes that are stable at any dt, told from their definition: against textbooks, and whole steps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.assembly import solve_velocities
from reference.motion import MotionOfSprings
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.state import State
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.rates import rates
from reference.theory.step_map import resisted, step_jacobian
from reference.theory.unconditional_stability import (
    characteristic_polynomial,
    has_roots_in_left_half,
    is_positive,
    stable_at_any_dt,
)

#: Newmark's method is if and only if 2 beta >= gamma >= 1/2 (Hughes 1987, 9.1); HHT for alpha from -1/3 to 0 and the
#: generalised alpha method for 0 <= radius <= 1 by their construction; BDF2 and Radau IIA are A-stable (Hairer and
#: Wanner 1996, IV.5 and V.1).
STABLE = [
    "backward_euler",
    "implicit_midpoint",
    "newmark",
    "newmark(beta=0.31, gamma=0.6)",
    "hht",
    "hht(alpha=-0.3)",
    "generalised_alpha",
    "generalised_alpha(radius=0.0)",
    "generalised_alpha(radius=1.0)",
    "bdf2",
    "radau_iia",
]
NOT_STABLE = ["newmark(beta=0.24)", "newmark(beta=0.29, gamma=0.6)", "newmark(gamma=0.49)", "kick_drift", "heun"]


def _adams_moulton_3(motion: MotionOfSprings, state: State, dt: float) -> State:
    """The Adams-Moulton method of two steps and third order; begun as if it had always been here."""
    here = motion.acceleration(state)
    before = state.memory or (state.velocities, here)
    x = state.positions + dt / 12 * (8 * state.velocities - before[0])
    v = state.velocities + dt / 12 * (8 * here - before[1])
    return _solved(motion, state, dt, x, v, 5 / 12).remembering(state.velocities, here)


def _bdf3(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Backward differentiation of three steps and third order."""
    x1, v1, x2, v2 = state.memory or (state.positions, state.velocities) * 2
    x = (18 * state.positions - 9 * x1 + 2 * x2) / 11
    v = (18 * state.velocities - 9 * v1 + 2 * v2) / 11
    return _solved(motion, state, dt, x, v, 6 / 11).remembering(state.positions, state.velocities, x1, v1)


def _solved(motion: MotionOfSprings, state: State, dt: float, x: np.ndarray, v: np.ndarray, part: float) -> State:
    """X1 = x + part dt v1, v1 = v + part dt a(x1, v1), by one round of Newton, which is all of linear motion."""
    h = part * dt
    by_position, by_velocity = motion.jacobians(state)
    start = State(state.time + dt, x + h * v, v)
    change = solve_velocities(motion.system, h * by_velocity + h**2 * by_position, h * motion.acceleration(start))
    return State(state.time + dt, x + h * (v + change), v + change)


@pytest.mark.parametrize("name", STABLE)
def test_what_textbooks_call_stable_at_any_dt_is(name: str) -> None:
    """With damping, with drag, with both and with none."""
    assert all(stable_at_any_dt(find(name), damped, dragged) for damped in (False, True) for dragged in (False, True))


@pytest.mark.parametrize("name", NOT_STABLE)
def test_what_they_do_not_is_not(name: str) -> None:
    """Also next to the border."""
    assert not stable_at_any_dt(find(name), True, False)


@pytest.mark.parametrize("step", [_adams_moulton_3, _bdf3])
def test_beyond_dahlquists_barrier_nothing_is(step: object) -> None:
    """No multistep method of an order above 2 is (Dahlquist 1963): two that are right, but of third order.

    On the undamped string Adams-Moulton has a root outside the unit circle in every step.
    """
    third = Scheme(step, 3, implicit=True, one_step=False)  # type: ignore[arg-type]
    assert characteristic_polynomial(third) is not None
    assert not stable_at_any_dt(third, False, False)


def test_the_characteristic_polynomial_is_that_of_the_definition() -> None:
    """BDF2 of x' = v, v' = -a x - b v: r^2 + b l^2 r + a l^4 with r = 3/2 l^2 - 2 l + 1/2, from its three numbers."""
    found = characteristic_polynomial(find("bdf2"))
    assert found is not None
    r = np.array([0.5, -2.0, 1.5])
    expected = np.zeros((5, 2, 2))
    expected[:, 0, 0], expected[2:, 0, 1], expected[4, 1, 0] = np.convolve(r, r), r, 1.0
    assert found[..., :2, :2] / found[4, 1, 0] == pytest.approx(expected, abs=1e-11)


@given(st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=6))
def test_the_routh_array_tells_where_roots_lie(coefficients: list[float]) -> None:
    """Of polynomials with numbers only, against their roots; those next to the border are left out."""
    roots = np.roots(coefficients[::-1]) if abs(coefficients[-1]) > 1e-3 else np.array([0.0])
    if np.abs(roots.real).min() < 1e-3:
        return
    polynomial = np.array(coefficients)[:, None, None] * np.sign(coefficients[-1])
    assert has_roots_in_left_half(polynomial) == bool((roots.real < 0).all())


def test_a_polynomial_of_two_unknowns_is_positive_where_its_parts_are() -> None:
    """4 - a + a^2 / 8 has no root, 4 - a + a^2 / 17 has two; 4 - b is negative beyond 4."""
    assert is_positive(np.array([[4.0, 0.0], [-1.0, 1.0], [1 / 8, 0.0]]))
    assert not is_positive(np.array([[4.0, 0.0], [-1.0, 1.0], [1 / 17, 0.0]]))
    assert not is_positive(np.array([[4.0, -1.0]]))
    assert not is_positive(np.zeros((2, 2)))


@pytest.mark.parametrize("parameters", [{}, {"damping": 0.5}, {"drag": 0.1}, {"damping": 2.0, "drag": 0.3}])
@pytest.mark.parametrize("name", ["hht", "generalised_alpha", "bdf2", "radau_iia"])
def test_on_a_string_they_are_certified_and_their_steps_do_not_grow(name: str, parameters: dict[str, float]) -> None:
    """Against all eigenvalues of the step itself from 1e-2 to 1e3 of the fastest motion's 1/w: 1e-8 is rounding."""
    scheme = find(name)
    rest = spring_equilibrium(find_scene("string").system({"masses": 4, **parameters}))
    limit, found = stability_limit(scheme, rest), rates(rest)
    assert (limit.dt, limit.reason, limit.certainty) == (None, "stable at any dt", "certified")
    for part in np.geomspace(1e-2, 1e3, 11):
        values = np.linalg.eigvals(step_jacobian(scheme, rest, part / found.fastest)).astype(complex)
        assert np.abs(resisted(values, found.unresisted, part)).max() < 1 + 1e-8


def test_the_limit_of_one_that_has_one_is_newmarks() -> None:
    """Without damping, gamma = 1/2: h w = 1 / sqrt(1/4 - beta) (Hughes 1987, 9.1), of the string's fastest mode."""
    rest = spring_equilibrium(find_scene("string").system({"masses": 4}))
    limit = stability_limit(find("newmark(beta=0.1)"), rest)
    assert limit.dt == pytest.approx(1 / np.sqrt(0.25 - 0.1) / rates(rest).fastest, rel=1e-8)
