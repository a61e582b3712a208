"""The mode that limits a step: its frequency and the springs that it strains."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.critical_mode import CriticalMode, critical_mode
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.modes import string_mode


def mode_of(name: str, **settings: object) -> CriticalMode:
    """Of a scheme on a string, at its limit."""
    rest = spring_equilibrium(find_scene("string").system(settings))
    limit = stability_limit(find(name), rest)
    assert limit.dt is not None
    assert rest.linear is not None
    return critical_mode(find(name), rest.linear, limit.dt)


@pytest.mark.parametrize("name", ["kick_drift", "rk4", "drift_kick_implicit_damping"])
def test_the_fastest_mode_of_a_string_limits(name: str) -> None:
    """w^2 = (k/m) lambda; its springs share the energy as the mode's slopes squared, all in it."""
    mode = mode_of(name, masses=10)
    assert mode.frequency == pytest.approx(np.sqrt(200 / 0.02 * string_mode(10)) / (2 * np.pi), rel=1e-6)
    assert mode.shares.sum() == pytest.approx(1.0)
    assert mode.shares.max() < 0.3


def test_one_stiff_spring_is_named() -> None:
    """Ten thousand times as stiff as the others it has nearly all of the energy; named by its number."""
    stiffness = [200.0, 200.0, 2e6, 200.0]
    mode = mode_of("kick_drift", masses=4, stiffness=stiffness)
    assert mode.spring == 2
    assert mode.shares[2] > 0.99
    assert mode.springs == 1


def test_shares_of_another_system_are_told_apart() -> None:
    """Shown to fail: with another stiff spring it is another number."""
    assert mode_of("kick_drift", masses=4, stiffness=[2e6, 200.0, 200.0, 200.0]).spring != 2
