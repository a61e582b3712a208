"""The experiment on ground that shakes and trucks that cross: its predictions, and what is said of the numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import ground_motion
from experiments.ground_motion import (
    SPEEDS,
    SWEEP,
    Ran,
    influence_line,
    late,
    middle,
    peak,
    predicted_sway,
    shaken_bridge,
)
from reference.catalogue import find
from reference.changes import Driven
from reference.ground_motion import GroundMotion, Sweep
from reference.scenes import find as find_scene
from reference.simulate import simulate
from report.figures import draw
from tests.reference.direct_stiffness import deflection

NATURAL = np.array([1.2])
LINE = (np.array([0.0, 12.0, 24.0]), np.array([0.0, 0.08, 0.0]))


def ran(frequency: float, sag: float, distance: float | None = None) -> Ran:
    """Runs with the largest sway at a frequency, and a sag at every speed."""
    times = np.arange(5001) * ground_motion.DT
    sway = 0.01 * np.exp(-((SWEEP.frequency(times) - frequency) ** 2) / 1e-3)
    return Ran(sway, {speed: np.full(50, sag) for speed in SPEEDS}, distance)


def test_the_predicted_sway_is_where_a_steady_shaking_leads() -> None:
    """Off resonance, at 0.9 Hz, shaken for 30 s: the transients die as exp(-0.2 t), and 1 % of the sway is left to see.

    And not of the sway at 0.95 Hz.
    """
    _, (frequencies, sways) = predicted_sway()
    shaking = Sweep(0.9, 0.9, SWEEP.amplitude, 40.0, direction=SWEEP.direction)
    driven = Driven(shaken_bridge().system, (GroundMotion(shaking),))
    motion = simulate(driven.system, find("rk4"), 5e-3, 30.0, driven.changes(5e-3, 30.0))
    i = middle(driven.system)
    swayed = np.abs(motion.positions[-400:, i, 1] - driven.system.positions[i, 1]).max()
    assert swayed == pytest.approx(np.interp(0.9, frequencies, sways), rel=0.03)
    assert swayed != pytest.approx(np.interp(0.95, frequencies, sways), rel=0.03)


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


def test_findings_are_made_from_the_numbers() -> None:
    """With other numbers, other sentences."""
    right, wrong = ran(1.3, 0.08, 1e-13), ran(1.8, 0.08, 2e-9)
    said = " ".join(ground_motion._findings({"a": right}, NATURAL, LINE))
    assert "shakes at 1.30 Hz, measured in 1 runs" in said
    assert "sinks it by 80 mm" in said
    assert "not what was measured" not in said
    assert "a goes furthest, 1.0e-13 m" in said
    other = " ".join(ground_motion._findings({"a": right, "b": wrong}, NATURAL, LINE))
    assert "at 1.30 to 1.80 Hz, measured in 2 runs" in other
    assert "which is not what was measured" in other
    assert "b goes furthest, 2.0e-09 m" in other
    assert not ground_motion._findings({}, NATURAL, LINE)


def test_a_sweep_is_the_later_the_faster() -> None:
    """The peak is read off the sweep's frequency then; 2.157 sqrt(2 pi 0.06)/(2 pi) and half a swing."""
    assert peak(ran(1.5, 0.0))[0] == pytest.approx(1.5, abs=1e-3)
    assert late(1.2) == pytest.approx(2.157 * np.sqrt(2 * np.pi * 0.06) / (2 * np.pi) + 0.06 / 2.4)


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """No engines, a short sweep, one fast truck."""
    monkeypatch.setattr(ground_motion, "ENGINES", ("mujoco_tendons",))
    for module in ("experiments", "report.figures"):
        monkeypatch.setattr(f"{module}.ground_motion.SWEEP", replace(SWEEP, duration=2.0))
        monkeypatch.setattr(f"{module}.ground_motion.SPEEDS", (40.0,))


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
