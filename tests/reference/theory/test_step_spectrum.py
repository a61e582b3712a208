"""The search for the first dt at which perturbations grow, on growths that are known."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory import step_spectrum
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.step_spectrum import Search


def search(excess: Callable[[float], float], rounding: float = 0.0, decays: bool = False) -> Search:
    """Of a growth that is known, to 1e-6."""
    return Search(excess, lambda dt: rounding * max(1.0, dt / 0.1), 1e-6, decays)


@pytest.mark.parametrize("start", [1e-3, 0.7, 5.0, 400.0])
def test_the_first_unstable_dt_is_found_from_either_side(start: float) -> None:
    """Growth dt - 1: unstable beyond 1 s, to the precision asked for, wherever the search begins."""
    limit = step_spectrum._scan(search(lambda dt: dt - 1.0), start, 1.0, 1e4)
    assert limit.dt == pytest.approx(1.0, rel=1e-6)


def test_what_is_unstable_at_any_dt_or_stable_at_any_has_no_limit_and_says_how_far_it_was_looked() -> None:
    """No search goes on for ever."""
    unstable = step_spectrum._scan(search(lambda dt: 1.0), 1.0, 1.0, 1e4)
    stable = step_spectrum._scan(search(lambda dt: -1.0), 1.0, 1.0, 1e4)
    assert unstable.dt is None
    assert "no stable step was found" in unstable.reason
    assert stable.dt is None
    assert "stable at any dt" in stable.reason


def test_rounding_at_long_steps_is_no_growth() -> None:
    """Beyond the fastest mode's 1/w, dt x velocities are larger than positions, and so is their rounding."""
    margin = 1e-9
    rounding = step_spectrum._scan(search(lambda dt: 0.9 * margin * max(1.0, dt / 0.1), margin), 1e-2, 0.1, 1e3)
    growing = step_spectrum._scan(search(lambda dt: 2 * margin if dt > 0.05 else 0.0, margin), 1e-2, 0.1, 1e3)
    assert rounding.dt is None
    assert growing.dt is not None
    assert math.isclose(growing.dt, 0.05, rel_tol=1e-5)


@pytest.mark.parametrize(
    ("rounding", "low", "high"),
    [(1e-12, 1e-3, 1e-3), (1e-10, 1e-3, 1e-3), (1e-7, 9e-4, 1.0916e-3), (1e-6, None, None)],
)
def test_a_limit_is_one_value_only_where_decay_and_growth_are_more_than_rounding(
    rounding: float, low: float | None, high: float | None
) -> None:
    """Of what decays by g dt and grows by dt^2, g = 0.001: at dt = g they are equal, and each is 1e-6.

    Rounding by r leaves sqrt(g^2 / 4 - r) about g / 2 on one side, sqrt(g^2 / 4 + r) on the other, and none at all if r
    is more than g^2 / 4 = 2.5e-7.
    """
    g = 1e-3
    found = step_spectrum._scan(search(lambda dt: dt**2 - g * dt, rounding, decays=True), 1e-2, 1.0, 1e4)
    if low is None:
        assert found.dt is None
        assert found.reason.startswith("not computed: ")
        return
    expected = [g / 2 + math.sqrt(g**2 / 4 + sign * rounding) for sign in (-1, 1)]
    if low == high:
        assert found.dt == pytest.approx(g, rel=1e-6)
        assert found.certainty == "computed"
    else:
        assert found.certainty == "between"
        assert [found.dt, found.at_most] == pytest.approx(expected, rel=1e-5)
        assert expected == pytest.approx([low, high], rel=0.02)


@pytest.mark.parametrize("damping", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize(
    ("name", "power", "part"),
    [("euler_in_place", 1, 0.5), ("heun_link_by_link", 3, 0.125), ("adams_bashforth_2", 3, 0.25)],
)
def test_an_oscillator_hardly_damped_has_the_limit_that_growth_by_a_power_of_dt_gives(
    name: str, power: int, part: float, damping: float
) -> None:
    """A mode w decays by g h in a step and grows by `part` (w h)^(power + 1): h w = (g / w / part)^(1 / power).

    Euler |1 + i w h| = 1 + (w h)^2 / 2; Heun 1 + (w h)^4 / 8; Adams-Bashforth of two steps 1 + (w h)^4 / 4, by their
    characteristic polynomials. What is left out is smaller by (w h)^2 and g / w: at most 2 in a hundred.
    Here w = 100 1/s and g is 25 times the damping. Were growth seen from 1e-11 on only, this were wrong a hundredfold.
    """
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": damping}))
    limit = stability_limit(find(name), rest).dt
    g, w = 25 * damping, 100.0
    expected = (g / w / part) ** (1 / power) / w
    assert limit == pytest.approx(expected, rel=2 * (expected * w) ** 2 + 1e-6)


@pytest.mark.parametrize("name", ["euler_in_place", "heun_aliased"])
def test_in_place_limits_are_in_proportion_to_damping_however_little_it_is(name: str) -> None:
    """On a chain, where they lose an order: growth by dt^2 against decay by g dt, down to g / w = 3e-11."""
    limits = [
        stability_limit(
            find(name), spring_equilibrium(find_scene("chain").system({"masses": 3, "damping": damping}))
        ).dt
        for damping in (1e-5, 1e-6, 1e-7)
    ]
    assert None not in limits
    assert limits == pytest.approx([limits[0], 0.1 * limits[0], 0.01 * limits[0]], rel=1e-6)  # type: ignore[operator, arg-type]


def test_in_place_euler_of_one_mass_is_euler_where_nothing_resists_a_motion() -> None:
    """One mass amid a string without tension: along it h < g/w^2, across it nothing pulls, and nothing grows.

    Growth beyond the limit is a ten-millionth in a step: that is no rounding of the motion across.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        damping=np.array(0.05),
        drag=0.0,
        gravity=np.array(0.0),
        fixed=np.array([True, False, True]),
    )
    limit = stability_limit(find("euler_in_place"), spring_equilibrium(system))
    assert limit.dt == pytest.approx(0.1 / 200, rel=1e-5)


@pytest.mark.parametrize("damping", [1e-3, 1e-7, 1e-9])
def test_rounding_of_what_is_remembered_is_no_growth(damping: float) -> None:
    """Verlet by positions on 100 1/s, hardly damped: 2/w, be the damping ever so small."""
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": damping}))
    assert stability_limit(find("stormer_verlet"), rest).dt == pytest.approx(0.02, rel=1e-6)
