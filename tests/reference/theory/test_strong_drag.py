"""Steps in which drag or damping is strong for light masses amid heavy ones: limits far from those of gentle steps."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.critical_mode import critical_mode
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.step_map import step_jacobian


def chain(masses: list[float], drag: float) -> Equilibrium:
    """Masses [kg] that hang below one another, each with a drag [N s/m]."""
    return spring_equilibrium(find_scene("chain").system({"masses": len(masses), "mass": masses, "drag": drag}))


def growth(name: str, rest: Equilibrium, dt: float) -> float:
    """The largest |eigenvalue| of all of a step, less 1."""
    return float(np.abs(np.linalg.eigvals(step_jacobian(find(name), rest, dt))).max() - 1)


@pytest.mark.parametrize(
    ("masses", "drag"), [([0.00366, 14.4, 0.765, 12.3], 0.558), ([2.85, 0.0326, 0.13, 0.00687], 1.04)]
)
def test_drag_afterwards_turns_the_velocity_of_the_lightest_mass_round(masses: list[float], drag: float) -> None:
    """Velocities times 1 - h Cd/m: beyond h = m/Cd they are turned round, and what a spring adds to them with them.

    So a spring pushes the mass away there: a real eigenvalue above 1, whatever the other masses. S is positive still.
    """
    rest, limit = chain(masses, drag), min(masses) / drag
    found = stability_limit(find("kick_drift_drag_afterwards"), rest)
    assert (found.dt, found.windows) == (pytest.approx(limit, rel=1e-8), ())
    assert growth("kick_drift_drag_afterwards", rest, (1 - 1e-6) * limit) < 0
    assert growth("kick_drift_drag_afterwards", rest, (1 + 1e-6) * limit) > 0
    assert rest.linear is not None
    moves = critical_mode(find("kick_drift_drag_afterwards"), rest.linear, limit).shape
    assert np.abs(moves).argmax() == 1 + np.argmin(masses)
    assert np.sort(np.abs(moves).ravel())[-2] < 1e-3


def light_mass(drag: float, mass: float = 1e-8) -> Equilibrium:
    """A mass on a spring of 1 N/m along a line, whose drag decays it within m/Cd."""
    values = {"masses": 1, "mass": [mass], "stiffness": 1.0, "drag": drag}
    return spring_equilibrium(find_scene("chain").system(values))


def check_strong_drag(drag: float, mass: float) -> None:
    """Of one mass m on a spring k: implicit drag is stable while h^2 k < 4 m + 2 h Cd, drag afterwards up to m/Cd.

    However long beside m/Cd the first is, which is the fastest motion: certified to 1e-9, as S and damping change sign.
    """
    rest = light_mass(drag, mass)
    for name in ("kick_drift_implicit_drag", "kick_drift_implicit_damping_and_drag"):
        found = stability_limit(find(name), rest)
        assert (found.dt, found.certainty) == (pytest.approx(drag + np.sqrt(drag**2 + 4e-8), rel=1e-8), "certified")
    found = stability_limit(find("kick_drift_drag_afterwards"), rest)
    assert (found.dt, found.certainty) == (pytest.approx(1e-8 / drag, rel=1e-8), "certified")


@pytest.mark.parametrize("drag", [1e-3, 0.05, 0.5, 20.0])
def test_however_strong_drag_is_implicit_drag_has_a_limit(drag: float) -> None:
    """Of 2 Cd/k, up to 4e12 times the fastest decay."""
    check_strong_drag(drag, 1e-8)


def test_the_limit_of_another_mass_is_told_from_it() -> None:
    """Of two per cent more."""
    with pytest.raises(AssertionError):
        check_strong_drag(0.05, 1.02e-8)


def test_strong_drag_of_light_masses_is_in_proportion_to_dt() -> None:
    """Newmark's step takes drag as h Cd, and is stable at any dt: with a spring held at both ends, too.

    The masses have 6e-5 kg. Rounding of what that spring's step makes of no damping was taken for damping that grows
    faster than dt.
    """
    rest = spring_equilibrium(find_scene("strip").system({"masses": 4, "drag": 0.42867010382582243}))
    found = stability_limit(find("newmark"), rest)
    assert (found.reason, found.certainty) == ("stable at any dt", "certified")


def test_rounding_of_what_a_step_damps_is_no_negative_damping() -> None:
    """Newmark of beta 0.2 and gamma 0.6 takes drag as drag at any dt: the limit is its fastest mode's, not 1e-7 s.

    The largest eigenvalue passes 1 there.
    """
    rest, name = (
        spring_equilibrium(find_scene("strip").system({"masses": 4, "drag": 0.43})),
        "newmark(beta=0.2,gamma=0.6)",
    )
    limit = stability_limit(find(name), rest).dt
    assert limit is not None
    assert limit > 1e-4
    assert growth(name, rest, (1 - 1e-6) * limit) < 0 < growth(name, rest, (1 + 1e-6) * limit)


@pytest.mark.parametrize("light", [0.00844, 0.0063, 0.0052])
def test_a_heavy_mass_beside_one_that_exponential_drag_all_but_holds_has_its_limit(light: float) -> None:
    """Velocities times e^(-h Cd/m), here e^-11 to e^-17: S(h) = 2 M (1 + e^(h Cd/M)) - h^2 K, with all its digits.

    The light mass is at the end of a spring and moves but little: what is left of its coupling is in the formula. Of
    S whose damping is rounded as e^(2 h Cd/M) there were 2.6e-4 of the limit wrong, and it was called certified.
    """
    masses, drag, k = np.array([1.10, light]), 0.848, 200.0
    rest = chain(masses.tolist(), drag)

    def lowest(h: float) -> float:
        s = np.diag(2 * masses * (1 + np.exp(h * drag / masses))) - h**2 * k * np.array([[2.0, -1.0], [-1.0, 1.0]])
        return float(np.linalg.det(s))

    found = stability_limit(find("kick_drift_exponential_drag"), rest).dt
    assert found is not None
    assert lowest(found * (1 - 1e-7)) > 0 > lowest(found * (1 + 1e-7))
    assert growth("kick_drift_exponential_drag", rest, (1 - 1e-5) * found) < 0
    assert growth("kick_drift_exponential_drag", rest, (1 + 1e-5) * found) > 0


def test_a_scheme_that_stops_iterating_early_may_be_unstable_far_below_what_it_would_come_to() -> None:
    """Springs damped one after another, strongly: 75 ms, where the damping of all at once has 245 ms.

    Dense eigenvalues of whole steps on either side; and they grow on from there.
    """
    system = find_scene("chain").system({"masses": 3, "mass": [0.0716, 6.93, 3.63], "damping": 3.57})
    rest, name = spring_equilibrium(system), "drift_kick_sequential_damping"
    found = stability_limit(find(name), rest).dt
    assert found == pytest.approx(0.075, rel=0.01)
    assert found < stability_limit(find("drift_kick_exponential_damping"), rest).dt / 3  # type: ignore[operator]
    steps = np.linspace(0.01, 0.999, 60) * found  # type: ignore[operator]
    assert max(growth(name, rest, float(dt)) for dt in steps) < 0
    assert min(growth(name, rest, part * found) for part in (1.001, 1.05, 1.2)) > 0  # type: ignore[operator]


def test_a_narrow_range_of_growth_is_not_stepped_over() -> None:
    """Yoshida's composition with drag lets the light mass grow between 4.21 and 4.7 ms, and no more up to 5.35 ms.

    The first limit is the first dt at which the largest eigenvalue passes 1, looked at here every hundredth.
    """
    rest = chain([0.00366, 14.4, 0.765, 12.3], 0.558)
    steps = np.linspace(3e-3, 6e-3, 301)
    grows = [growth("yoshida_4", rest, float(dt)) > 1e-9 for dt in steps]
    first = steps[grows.index(True)]
    assert first < 0.0043 < steps[grows.index(False, grows.index(True))] < 0.005
    assert stability_limit(find("yoshida_4"), rest).dt == pytest.approx(first, abs=1e-5)
