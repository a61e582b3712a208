"""The limit beside the slider: the one of `stability`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium
from reference.theory.limits import explicit_damping_limit, stability_limit
from reference.theory.modes import string_mode
from report.live.prediction import Predictor, predict


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("scene", ["string", "cloth", "jello"])
def test_the_page_predicts_what_stability_predicts(scene: str) -> None:
    """One limit, about the rest, on every page and in every command: the same number to the bit."""
    system = find_scene(scene).system({})
    alone = replace(system, obstacles=(), velocities=np.zeros_like(system.velocities))
    assert (
        predict("kick_drift", system, 1e-3).limit == stability_limit(find("kick_drift"), spring_equilibrium(alone)).dt
    )


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


@pytest.mark.rotating(3, in_turn=True)
def test_a_scheme_is_predicted_on_obstacles_and_an_engine_without() -> None:
    """On a string that lies on a circle: an engine's contacts are its own, and its limit is that of its springs."""
    system = find_scene("barrier").system({})
    still = replace(system, velocities=np.zeros_like(system.velocities))
    resting = stability_limit(find("kick_drift"), equilibrium_on_obstacles(still)[0]).dt
    hanging = stability_limit(find("kick_drift"), spring_equilibrium(replace(still, obstacles=()))).dt
    assert predict("kick_drift", system, 1e-3).limit == resting
    assert predict("mujoco_tendons", system, 1e-3).limit == pytest.approx(hanging, rel=0.01)
    assert resting != pytest.approx(hanging, rel=0.01)


@pytest.mark.rotating(3, in_turn=True)
def test_what_is_not_known_is_said() -> None:
    """Of a large mesh in place, which depends on numbering, and of Heun without damping."""
    cloth = find_scene("cloth").system({})
    damped = cloth.with_parameter("drag", 0.01)
    assert "not computed" in predict("heun_aliased", damped, 1e-3).reason
    assert "unstable at any dt" in predict("heun", cloth, 1e-3).reason


def test_the_last_question_is_answered() -> None:
    """However many were asked before it."""
    predictor = Predictor()
    system = find_scene("string").system({})
    for stiffness in range(100, 200, 5):
        predictor.ask(["kick_drift"], system.with_parameter("stiffness", stiffness), 1e-3)
    predictor.wait(600)
    wanted = predict("kick_drift", system.with_parameter("stiffness", 195), 1e-3)
    assert predictor.found["kick_drift"].limit == pytest.approx(wanted.limit, rel=1e-12)
    predictor.end()
