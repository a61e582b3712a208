"""First limits of steps that have no structure to tell them by, where hardly anything is damped."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory import step_spectrum
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit


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


@pytest.mark.parametrize(
    ("powers", "expected"),
    [((2.0, 2.0), True), ((1.1, 1.0), True), ((1.5, 0.7), False), ((0.7, 1.5), False), ((3.0, 1.5), False)],
)
def test_growth_falls_as_a_power_of_dt_where_each_halving_says_the_same_power(
    powers: tuple[float, float], expected: bool
) -> None:
    """From 1 on, at steps each half the last: a power of 1 or more in both, the same one; and none of rounding."""
    grown = [1.0, 2.0 ** -powers[0], 2.0 ** -(powers[0] + powers[1])]
    assert step_spectrum._falls_as_a_power(grown, 0.0) == expected
    assert not step_spectrum._falls_as_a_power(grown, grown[-1])
