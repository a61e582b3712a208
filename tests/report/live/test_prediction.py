"""The limit beside the slider: the fastest mode alone has the limit of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import explicit_damping_limit, stability_limit
from reference.theory.modes import string_mode
from report.live.prediction import Predictor, fastest_mode, predict


@pytest.mark.parametrize("damping", [0.0, 0.1])
@pytest.mark.parametrize("name", ["kick_drift", "rk4", "velocity_verlet"])
def test_the_fastest_mode_alone_has_the_limit_of_the_whole_string(name: str, damping: float) -> None:
    """Damping spread as stiffness is: no approximation; limits are found to 1e-7. Shown to fail: one mass doubled."""
    system = find_scene("string").system({"masses": 20, "damping": damping})
    whole = stability_limit(find(name), spring_equilibrium(system)).dt
    alone = stability_limit(find(name), spring_equilibrium(fastest_mode(system))).dt
    assert alone == pytest.approx(whole, rel=1e-6)
    heavier = replace(system, masses=system.masses * np.where(np.arange(21) == 10, 2.0, 1.0))
    other = stability_limit(find(name), spring_equilibrium(fastest_mode(heavier))).dt
    assert abs(other / whole - 1) > 1e-4


def test_a_long_string_has_the_closed_forms_limit() -> None:
    """Kick-drift with h^2 w^2 + 2 gamma h < 4, w^2 = (k/m) lambda, gamma = (c/m) lambda; found to 1e-7."""
    system = find_scene("string").system({"masses": 200, "damping": 0.05})
    mode = string_mode(200)
    predicted = predict("kick_drift", system, 1e-3)
    wanted = explicit_damping_limit(np.sqrt(200 / 0.02 * mode), 0.05 / 0.02 * mode)
    assert predicted.limit == pytest.approx(wanted, rel=1e-6)


def test_an_engine_is_predicted_by_its_scheme() -> None:
    """Pymunk with damping is drift-kick with sequential damping; at dt past the limit the growth is over one."""
    system = find_scene("string").system({"damping": 0.02})
    predicted = predict("pymunk_springs", system, 0.02)
    assert predicted.scheme == "drift_kick_sequential_damping"
    assert predicted.limit is not None
    assert predicted.growth > 1
    assert predict("pymunk_springs", system, 0.9 * predicted.limit).growth <= 1 + 1e-9


def test_what_is_not_known_is_said() -> None:
    """Of a large mesh in place, which depends on numbering, and of Heun without damping."""
    cloth = find_scene("cloth").system({})
    assert "not predicted" in predict("heun_aliased", cloth, 1e-3).reason
    assert "unstable at any dt" in predict("heun", cloth, 1e-3).reason


def test_the_last_question_is_answered() -> None:
    """However many were asked before it."""
    predictor = Predictor()
    system = find_scene("string").system({})
    for stiffness in range(100, 200, 5):
        predictor.ask(["kick_drift"], system.with_parameter("stiffness", stiffness), 1e-3)
    predictor.wait(10)
    wanted = predict("kick_drift", system.with_parameter("stiffness", 195), 1e-3)
    assert predictor.found["kick_drift"].limit == pytest.approx(wanted.limit, rel=1e-12)
    predictor.end()
