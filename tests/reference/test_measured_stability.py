"""Stability measured: growth told from offsets whose growth is known, and limits found where theory has them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from reference.measured_stability import (
    LONGER,
    PERTURBATION,
    SEEN,
    STEPS,
    measured_limit,
    mode_growth,
    random_growth,
)
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array
from reference.theory.equilibria import spring_equilibrium
from reference.theory.equilibrium import hanging_string
from reference.theory.limits import stability_limit
from reference.theory.step_map import step_jacobian
from tests import wrong
from tests.reference.systems import label


def oscillation(per_step: float, steps: int = 1200) -> Array:
    """Offsets of two masses that swing, growing by a factor in each step."""
    i = np.arange(steps)[:, None]
    return np.asarray(per_step**i * 1e-6 * np.sin(0.7 * i + np.array([0.3, 1.0])))


@pytest.mark.parametrize("rate", [-3e-3, 0.0, 1e-3, 3e-3])
def test_growth_in_a_step_is_told_from_a_run(rate: float) -> None:
    """Mean squares of quarters of the run: right to 1e-4, a tenth of the growth that counts as seen."""
    assert random_growth(oscillation(1 + rate)) == pytest.approx(rate, abs=1e-4)
    assert SEEN > 5e-4


@pytest.mark.parametrize(
    "offsets",
    [oscillation(1.1), np.where(np.arange(1200)[:, None] == 700, np.nan, oscillation(1.0)), np.full((40, 2), np.inf)],
    ids=["hundredfold", "no number", "infinite"],
)
def test_what_has_grown_beyond_measure_has_grown_infinitely(offsets: Array) -> None:
    """Whatever stops it then."""
    assert random_growth(offsets) == np.inf


def test_what_has_come_to_rest_has_not_grown() -> None:
    """Nothing is left of the perturbation."""
    offsets = np.zeros((1200, 2))
    offsets[0] = 1e-6
    assert random_growth(offsets) < 0


@pytest.mark.parametrize("rate", [1e-6, 1e-3, -1e-3])
def test_a_modes_growth_is_told_to_parts_of_a_millionth(rate: float) -> None:
    """One mode of two: z -> (1 + rate) exp(0.7 i) z in a plane, seen by its left eigenvector."""
    steps = np.arange(300)
    z = ((1 + rate) * np.exp(0.7j)) ** steps
    offsets = 1e-6 * np.column_stack([z.real, z.imag])
    # Left eigenvector of the rotation: (1, -i)/sqrt(2), or its conjugate for the other one.
    assert mode_growth(offsets, np.array([1.0, -1.0j])) == pytest.approx(rate, abs=1e-10)


def test_a_mode_of_which_nothing_is_left_has_decayed() -> None:
    """By half a step, until it is lost: what rounding makes of it afterwards is no part of it; or all of it at once."""
    offsets = np.array([[1.0], [0.5], [0.25], [0.0], [1e-9], [0.0]])
    assert mode_growth(offsets, np.ones(1)) == pytest.approx(-0.5, rel=1e-12)
    assert mode_growth(offsets[2:], np.ones(1)) == -1.0


@pytest.mark.parametrize("what", [np.nan, np.inf])
def test_a_modes_growth_that_cannot_be_told_is_infinite(what: float) -> None:
    """Where one offset of many is no number."""
    offsets = np.ones((20, 2))
    offsets[7] = what
    assert mode_growth(offsets, np.array([1.0, 2.0])) == np.inf


def growth_of(scheme: Scheme, dt: float, steps: int, drag: float = 0.1) -> float:
    """How a random perturbation of a spring's mass, along the spring only, grows in a run: measured, no theory."""
    system = find_scene("spring").system({"drag": drag})
    rest = hanging_string(system).positions
    perturbed = rest + np.array([[0.0, 0.0], [0.0, PERTURBATION * 0.125]])
    run = simulate(replace(system, positions=perturbed), scheme, dt, steps * dt)
    return random_growth(run.positions[:, 1] - rest[1])


def check_measured(scheme: Scheme, limit: float) -> None:
    """The measured limit is the predicted one to 1 %.

    Bisection stops within 1e-3; growth is seen from 8e-4 in a step, which kick-drift has just above its limit.
    """
    found = measured_limit(lambda dt, steps: growth_of(scheme, dt, steps), 0.01, 1e-3)
    assert found.reason == ""
    assert found.dt == pytest.approx(limit, rel=1e-2)


def test_kick_drifts_limit_is_measured_where_it_is_predicted() -> None:
    """Explicit drag: dt^2 w^2 + 2 dt Cd/m < 4 with w = 100/s, Cd/m = 5/s."""
    check_measured(find("kick_drift"), (np.sqrt(25 + 4e4) - 5) / 1e4)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("scheme", [wrong.kick_drift_kicked_twice, wrong.heun_without_half, find("rk4")], ids=label)
def test_measured_limit_fails_on_others(scheme: Scheme) -> None:
    """Theirs is elsewhere."""
    with pytest.raises(AssertionError):
        check_measured(scheme, (np.sqrt(25 + 4e4) - 5) / 1e4)


@np.errstate(over="ignore", invalid="ignore")
def growth_of_map(map_matrix: Array, steps: int) -> float:
    """What `random_growth` sees of a linear map applied again and again to a random start."""
    states = [np.random.default_rng(0).normal(size=len(map_matrix))]
    for _ in range(steps):
        states.append(map_matrix @ states[-1])
    return random_growth(np.array(states))


def test_random_perturbations_find_a_limit_known_in_closed_form() -> None:
    """Z -> [[1 - h^2, h], [-h, 1]] z is kick-drift of x'' = -x, stable for h < 2."""
    limit = measured_limit(lambda h, n: growth_of_map(np.array([[1 - h * h, h], [-h, 1.0]]), n), 1.0, 1e-4)
    assert limit.reason == ""
    assert limit.dt == pytest.approx(2, rel=1e-3)


@pytest.mark.parametrize(("expected", "runs"), [(2.0, 12), (1.99, 12), (1.9, 25), (5.0, 25)])
def test_a_limit_is_found_wherever_it_is_expected_and_sooner_where_it_is(expected: float, runs: int) -> None:
    """Of that map, to 1e-3; from fewer runs where it is within a hundredth of what is expected."""
    asked = []

    def growth(h: float, steps: int) -> float:
        asked.append(steps)
        return growth_of_map(np.array([[1 - h * h, h], [-h, 1.0]]), steps)

    limit = measured_limit(growth, 1.0, 1e-4, expected)
    assert limit.dt == pytest.approx(2, rel=1e-3)
    assert limit.dt != expected
    assert len(asked) <= runs
    # what is expected and found needs no longer run; what is not expected does
    assert (max(asked) == LONGER * STEPS) == (runs > 12)


def test_random_perturbations_find_no_limit_where_there_is_none() -> None:
    """Euler of x'' = -x, z -> [[1, h], [-h, 1]] z, grows by sqrt(1 + h^2) in a step at any h."""
    limit = measured_limit(lambda h, n: growth_of_map(np.array([[1, h], [-h, 1.0]]), n), 1.0, 1e-4)
    assert limit.dt is None
    assert limit.reason.startswith("unstable")


def test_slow_growth_beside_fast_decay_is_seen_in_longer_runs() -> None:
    """Euler of a string with damped springs: fast modes decay, slow ones grow at any dt (predicted), by 1e-4 in a step.

    In a run that is long enough for the limits of others a random perturbation has not grown yet.
    """
    rest, euler = spring_equilibrium(find_scene("string").system({"damping": 0.1})), find("euler")
    assert stability_limit(euler, rest).growth is not None
    limit = measured_limit(lambda h, n: growth_of_map(step_jacobian(euler, rest, h), n), 0.005, 1e-4)
    assert (limit.dt, limit.reason.partition(":")[0]) == (None, "unstable at any dt that was tried")


def test_no_limit_is_told_with_its_reason() -> None:
    """Stable or unstable at all that was tried."""
    assert measured_limit(lambda dt, steps: -1.0, 0.01, 1e-3).dt is None
    assert measured_limit(lambda dt, steps: 1.0, 0.01, 1e-3).reason.startswith(
        "unstable at any dt that was tried, down to"
    )
    assert measured_limit(lambda dt, steps: -1.0, 0.01, 1e-3).reason.startswith(
        "stable at any dt that was tried, up to"
    )


def test_growth_that_is_seen_late_is_looked_for_in_a_longer_run() -> None:
    """Growth SEEN (dt/h)^p is seen from h on in STEPS, and at 0.9 h in LONGER runs if 0.9^p > 1/LONGER: for p < 17."""
    asked = set()

    def growing(power: int) -> Callable[[float, int], float]:
        def growth(dt: float, steps: int) -> float:
            asked.add(steps)
            return float(SEEN * (dt / 0.01) ** power)

        return growth

    for power in (2, 4, 16):
        found = measured_limit(growing(power), 0.005, 1e-4)
        assert found.dt is None
        assert "longer runs" in found.reason
    assert measured_limit(growing(18), 0.005, 1e-4).dt == pytest.approx(0.01, rel=1e-4)
    assert asked == {STEPS, 6 * STEPS}
    assert LONGER == 6


def test_a_scheme_that_is_never_stable_is_not_given_a_limit() -> None:
    """Heun without damping grows by (dt w)^4/8 in a step (HLW I.1): at any dt, but too slowly for a short run."""
    found = measured_limit(lambda dt, steps: growth_of(find("heun"), dt, steps, drag=0.0), 0.01, 1e-2)
    assert found.dt is None
    assert "longer runs" in found.reason
