"""The fastest mode alone, as one mass of 1 kg: its stiffness, damping and drag are those of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.scenes import find
from reference.schemes.catalogue import find as find_scheme
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.modes import fastest_mode, string_mode

MASS, STIFFNESS, DAMPING, DRAG = 0.03, 300.0, 0.2, 0.9


def string(masses: int = 12) -> MassSpringSystem:
    """A string of equal masses with damping of both kinds, hanging."""
    settings = {"mass": MASS, "stiffness": STIFFNESS, "damping": DAMPING, "drag": DRAG, "angle": 90}
    return find("string").system({"masses": masses, **settings})


def check_mode(alone: MassSpringSystem, masses: int = 12) -> None:
    """With K phi = w^2 M phi, phi M phi = 1, and lambda = 4 sin^2((2n - 1) pi / (4n + 2)).

    w^2 = (k/m) lambda; phi C phi = (c/m) lambda as C = (c/k) K; Cd phi phi = Cd/m as all masses are m. The string hangs
    at its rest lengths, not stretched by its weight: springs turn no mode. To 1e-8 of the eigenvalue.
    """
    mode = string_mode(masses)
    assert alone.masses[-1] == 1.0
    assert alone.stiffness[0] == pytest.approx(STIFFNESS / MASS * mode, rel=1e-8)
    assert alone.damping[0] == pytest.approx(DAMPING / MASS * mode, rel=1e-8)
    assert alone.drag == pytest.approx(DRAG / MASS, rel=1e-8)


def test_the_mode_of_a_string_is_the_closed_form() -> None:
    """Each of the three per kilogram."""
    check_mode(fastest_mode(string()))


@pytest.mark.parametrize("wrong", ["stiffness", "damping", "drag"])
def test_a_mode_that_is_not_divided_by_its_mass_is_caught(wrong: str) -> None:
    """Shown to fail: the whole's drag, say, in place of drag over mass."""
    alone = fastest_mode(string())
    whole = {"stiffness": np.array(STIFFNESS), "damping": np.array(DAMPING), "drag": DRAG}
    with pytest.raises(AssertionError):
        check_mode(replace(alone, **{wrong: whole[wrong]}))


@pytest.mark.parametrize("name", ["heun", "kick_drift", "rk4"])
def test_with_drag_it_has_the_limit_of_the_whole(name: str) -> None:
    """Drag on equal masses is spread as they are: no approximation; limits are found to 1e-7.

    With the drag not divided by the mass Heun's limit is off by more than a tenth.
    """
    system = string(masses=4).with_parameter("damping", 0.0)
    scheme, alone = find_scheme(name), fastest_mode(system)
    # about where the mode is taken: at the start, whose springs are at their rest lengths
    weightless = replace(system, gravity=0 * system.gravity)
    whole = stability_limit(scheme, spring_equilibrium(weightless)).dt
    assert whole is not None
    assert stability_limit(scheme, spring_equilibrium(alone)).dt == pytest.approx(whole, rel=1e-6)
    undivided = stability_limit(scheme, spring_equilibrium(replace(alone, drag=DRAG))).dt
    assert undivided is None or abs(undivided / whole - 1) > 1e-2
