"""The limit beside the slider: the one of `stability`."""

from __future__ import annotations

import threading
from dataclasses import replace
from threading import Event

import numpy as np
import pytest

from reference.errors import SolverError
from reference.obstacles import Plane
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium
from reference.theory.limits import explicit_damping_limit, stability_limit
from reference.theory.modes import string_mode
from report.live import prediction
from report.live.prediction import GROWTH_UP_TO, MOST, ON_OBSTACLES_UP_TO, Predictor, predict


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


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, int]]:
    """Which rest was looked for, of how many coordinates; what is said of it is not."""
    found: list[tuple[str, int]] = []
    monkeypatch.setattr(prediction, "spring_equilibrium", lambda system: ("springs", len(system.obstacles)))
    monkeypatch.setattr(prediction, "equilibrium_on_obstacles", lambda system: [("obstacles", len(system.obstacles))])
    monkeypatch.setattr(
        prediction, "_about", lambda rest, scheme, dt, coordinates: found.append((rest[0], coordinates)) or rest
    )
    return found


@pytest.mark.parametrize(
    ("masses", "obstacle", "stepper", "rest"),
    [
        (ON_OBSTACLES_UP_TO // 2, True, "heun", "obstacles"),
        (ON_OBSTACLES_UP_TO // 2 + 1, True, "heun", "springs"),
        (10, True, "mujoco_tendons", "springs"),
        (10, False, "heun", "springs"),
        (MOST // 2, True, "heun", "springs"),
    ],
)
def test_rest_is_looked_for_on_obstacles_where_masses_are_few(
    asked: list[tuple[str, int]], masses: int, obstacle: bool, stepper: str, rest: str
) -> None:
    """By those that can move, each with two coordinates; of schemes, where there are obstacles."""
    system = find_scene("string").system({"masses": masses})
    system = replace(system, obstacles=(Plane((0.0, -9.0), (0.0, 1.0)),) * obstacle)
    assert predict(stepper, system, 1e-3) == (rest, int(rest == "obstacles"))
    assert asked == [(rest, 2 * masses)]


def test_of_very_large_systems_no_limit_is_looked_for(asked: list[tuple[str, int]]) -> None:
    """They are told how many coordinates there are, and where it is."""
    found = predict("semi_implicit_euler", find_scene("string").system({"masses": MOST // 2 + 1}), 1e-3)
    assert (found.limit, found.scheme, asked) == (None, "kick_drift", [])
    assert found.reason == f"not looked for, of {MOST + 2} coordinates; `stability` does"
    assert np.isnan(found.growth)


def test_where_no_rest_is_found_on_obstacles_that_of_the_springs_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """And where there is none of these, why is said."""

    def none(system: object) -> None:
        raise SolverError("no rest")

    system = replace(find_scene("string").system({"masses": 3}), obstacles=(Plane((0.0, -9.0), (0.0, 1.0)),))
    monkeypatch.setattr(prediction, "equilibrium_on_obstacles", none)
    assert predict("kick_drift", system, 1e-3) == predict("kick_drift", replace(system, obstacles=()), 1e-3)
    monkeypatch.setattr(prediction, "spring_equilibrium", none)
    assert predict("kick_drift", system, 1e-3).reason == "no rest"


def test_growth_is_told_where_the_jacobian_is_small() -> None:
    """Just beyond the limit more than one; of more coordinates it is not a number. The fastest rate is 2 over it."""
    few, many = (find_scene("string").system({"masses": n, "drag": 0.0}) for n in (2, GROWTH_UP_TO // 2 + 1))
    found = predict("kick_drift", few, 1e-3)
    assert found.limit is not None
    assert found.fastest * found.limit == pytest.approx(2.0, rel=1e-6)
    assert predict("kick_drift", few, 1.1 * found.limit).growth > 1.5
    assert np.isnan(predict("kick_drift", many, 1e-3).growth)


def test_a_question_about_another_system_is_not_answered_with_that_of_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is known at once; what is just being found out of the one before is not kept. In the end it ends."""
    begun, go_on = Event(), Event()

    def slow(name: str, system: object, dt: float) -> str:
        begun.set()
        assert go_on.wait(600)
        return f"{name} {dt:g}"

    monkeypatch.setattr(prediction, "predict", slow)
    others = {*threading.enumerate()}
    predictor, system = Predictor(), find_scene("string").system({})
    (thread,) = {*threading.enumerate()} - others
    assert thread.daemon
    predictor.ask(["heun", "rk4", "heun"], system, 1.0)
    assert begun.wait(600)
    predictor.forget()
    go_on.set()
    predictor.wait(600)
    assert predictor.found == {}
    predictor.ask(["heun", "rk4", "heun"], system, 2.0)
    predictor.wait(600)
    assert predictor.found == {"heun": "heun 2", "rk4": "rk4 2"}
    predictor.forget()
    assert predictor.found == {}
    predictor.ask(["euler"], system, 3.0)
    predictor.wait(600)
    assert predictor.found == {"euler": "euler 3"}
    predictor.end()
    thread.join(600)
    assert not thread.is_alive()
