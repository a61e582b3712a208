"""Slide 27: springs can stand for rigid objects if they are stiff enough, and what that costs in steps.

A string of n springs, L = n l long, hangs under its own weight. Spring j carries n - j masses (Hooke), so the whole
stretches by e = (n + 1) m g / (2 k l) of its length. Kick-drift is stable up to dt = 2/w with w^2 = 4 k/m sin^2(a),
a = (2n - 1) pi / (2 (2n + 1)), the fastest of its oscillations along itself. Together, whatever the masses,

    dt = sqrt(2 e l / ((n + 1) g)) / sin(a),    about sqrt(2 e L / g) / n.

A thousand springs that together make 1 m, and give way by a thousandth, need steps of 14 us. One rigid rod of that
length swings in 1.6 s, and a hundred steps to a swing are a thousand times longer. This is why engines have rods.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi, sin, sqrt

import numpy as np
import pytest

from reference.compiled.kernels import advance
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory.equilibrium import hanging_string

GRAVITY = 9.81


def hanging(springs: int, give: float, length: float = 1.0, mass: float = 1e-3) -> MassSpringSystem:
    """A string that stretches by that part of its length under its weight, hanging at rest."""
    stiffness = (springs + 1) * mass * GRAVITY / (2 * give * length / springs)
    settings = {"masses": springs, "mass": mass, "rest_length": length / springs, "stiffness": stiffness, "angle": 90}
    system = find_scene("string").system(settings)
    return replace(system, positions=hanging_string(system).positions)


def predicted_dt(springs: int, give: float, length: float = 1.0) -> float:
    """The largest stable step of kick-drift [s]."""
    angle = (2 * springs - 1) * pi / (2 * (2 * springs + 1))
    return sqrt(2 * give * length / springs / ((springs + 1) * GRAVITY)) / sin(angle)


def grows(system: MassSpringSystem, scheme: str, dt: float, steps: int = 40_000) -> bool:
    """Whether noise of a billionth of a spring's length, along the string, becomes a hundred times as large."""
    noise = np.zeros_like(system.positions)
    noise[1:, 1] = 1e-9 * system.rest_lengths * np.random.default_rng(0).choice([-1.0, 1.0], len(noise) - 1)
    end = advance(replace(system, positions=system.positions + noise), find(scheme), dt, steps)
    return not np.abs(end.positions - system.positions).max() < 100 * np.abs(noise).max()


@pytest.mark.parametrize("give", [1e-1, 1e-3])
@pytest.mark.parametrize("springs", [1, 10, 1000])
def test_it_stretches_by_what_it_gives(springs: int, give: float) -> None:
    """The stretch of the whole, as a part of its length, to rounding."""
    system = hanging(springs, give)
    assert -system.positions[-1, 1] == pytest.approx(1 + give, rel=1e-12)


@pytest.mark.parametrize(("springs", "give"), [(10, 1e-1), (10, 1e-3), (1000, 1e-1), (1000, 1e-3)])
def test_a_string_that_looks_rigid_costs_the_steps_that_are_predicted(springs: int, give: float) -> None:
    """At 0.999 of the predicted dt noise stays noise, for any mass; at 1.001 of it, it grows.

    Past the limit by a part d, the fastest oscillation grows by 1 + 2 sqrt(2 d) = 1.09 a step; with a thousand springs
    some hundred of them are past it.
    """
    dt = predicted_dt(springs, give)
    assert grows(hanging(springs, give), "kick_drift", 1.001 * dt)
    for mass in (1e-3, 1.0):
        assert not grows(hanging(springs, give, mass=mass), "kick_drift", 0.999 * dt)


def test_the_numbers_that_are_quoted() -> None:
    """14 us for a thousand springs that give way by a thousandth; 1.6 s for the swing of a rod; a thousand to one."""
    assert predicted_dt(1000, 1e-3) == pytest.approx(14e-6, rel=0.02)
    rod = 2 * pi * sqrt(2 / 3 * 1.0 / GRAVITY)
    assert rod == pytest.approx(1.64, abs=0.01)
    assert rod / 100 / predicted_dt(1000, 1e-3) == pytest.approx(1150, rel=0.01)


def test_the_cost_fails_on_a_string_that_gives_way_otherwise() -> None:
    """A string that gives way by one per cent less is stiffer, and no longer stable there."""
    with pytest.raises(AssertionError):
        assert not grows(hanging(100, 0.99e-3), "kick_drift", 0.999 * predicted_dt(100, 1e-3))
