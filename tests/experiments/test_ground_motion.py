"""The experiment on ground that shakes and trucks that cross: its predictions, and what is said of the numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import ground_motion
from experiments.ground_motion import (
    DT,
    SWEEP,
    influence_line,
    middle,
    predicted_sway,
    shaken_bridge,
)
from reference.changes import Driven
from reference.scenes import find as find_scene
from reference.scenes.ground_motion import FrequencySweep, GroundMotion
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from report.figures import draw
from tests.reference.scenes.direct_stiffness import deflection


def sways_as_predicted(bridge: Driven, linear: Array) -> bool:
    """Whether the middle of a bridge, by RK4, is never further from the linear bridge's than 2 % of the largest sway.

    What is linear no longer at 20 mm of sway: links turn by 20 mm/3 m, whose square is 5e-5, and are strained by 0.4 %.
    """
    motion = simulate(bridge.system, find("rk4"), DT, SWEEP.duration, bridge.changes(DT, SWEEP.duration))
    i = middle(bridge.system)
    swayed = motion.positions[:, i, 1] - bridge.system.positions[i, 1]
    return bool(np.abs(swayed - linear).max() < 0.02 * np.abs(linear).max())


@pytest.mark.rotating(3, in_turn=True)
def test_the_bridge_sways_as_the_linear_bridge() -> None:
    """With a hundredth of the shaking, so that little is not linear; and not one with beams stiffer by a hundredth."""
    weak = FrequencySweep(**{**vars(SWEEP), "amplitude": SWEEP.amplitude / 100})
    linear = predicted_sway() / 100
    system = shaken_bridge().system
    assert sways_as_predicted(Driven(system, (GroundMotion(weak),)), linear)
    stiffer = replace(system, stiffness=1.01 * system.stiffness)
    assert not sways_as_predicted(Driven(stiffer, (GroundMotion(weak),)), linear)


def test_the_influence_line_is_that_of_direct_stiffness() -> None:
    """With the truck in the middle and over the first joint.

    To 3 %: members of the cambered bridge are strained by up to 1 %, and its matrix has their tensions in it.
    """
    positions, down = influence_line()
    for place in (3.0, 12.0):
        loaded = find_scene("bridge").system({"truck_position": place})
        light = find_scene("bridge").system({"truck": 0.0})
        alone = replace(loaded, masses=np.maximum(loaded.masses - light.masses, 1e-12))
        expected = -deflection(alone)[4, 1]
        assert np.interp(place, positions, down) == pytest.approx(expected, rel=0.03)
        assert np.interp(place + 2, positions, down) != pytest.approx(expected, rel=0.03)


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """No engines, a short sweep, one fast truck."""
    monkeypatch.setattr(ground_motion, "ENGINES", ("mujoco_tendons",))
    for module in ("experiments", "report.figures"):
        monkeypatch.setattr(f"{module}.ground_motion.SWEEP", replace(SWEEP, duration=2.0))
        monkeypatch.setattr(f"{module}.ground_motion.SPEEDS", (40.0,))


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.usefixtures("short")
def test_the_experiment_runs_and_is_drawn() -> None:
    """An engine and its scheme: they go together to 1e-9 m; the same figure twice."""
    result = ground_motion.run(lambda _: None)
    assert not result.failures
    rows = result.data["rows"]
    assert list(rows) == ["kick_drift", "mujoco_tendons"]
    assert rows["mujoco_tendons"].distance < 1e-9
    picture = draw("ground_motion", result)
    assert "kick_drift at 40 m/s" in picture.alt
    assert picture.svg() == draw("ground_motion", result).svg()


@pytest.mark.usefixtures("short")
def test_it_is_drawn_where_nothing_ran(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only what is predicted."""
    monkeypatch.setattr(ground_motion, "ENGINES", ())
    result = ground_motion.run(lambda _: None)
    assert not result.findings
    assert draw("ground_motion", result).svg().startswith("<svg")
