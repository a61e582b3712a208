"""The experiment on ground that shakes and trucks that cross: its predictions, and what is said of the numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest

from engines.process.isolation import EngineStepper
from experiments import ground_motion
from experiments.ground_motion import (
    DT,
    SWEEP,
    influence_line,
    middle,
    predicted_sway,
    shaken_bridge,
)
from reference.changes import Change, Driven
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.scenes.ground_motion import FrequencySweep, GroundMotion
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array, Trajectory
from reference.stepper import Stepper
from reference.system import MassSpringSystem
from report.figures import draw
from tests.conformance.doctored import Doctored
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


@pytest.mark.usefixtures("short")
def test_who_did_not_come_to_every_end_is_no_row(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that shook and did not cross has failed, with its reason; what it did before is not shown."""
    system = shaken_bridge().system
    moved = Trajectory(np.array([0.0, DT]), np.array([system.positions] * 2), np.zeros((2, *system.positions.shape)))
    ends = {"kick_drift": Outcome("done", "", moved), "mujoco_tendons": Outcome("crashed", "killed")}

    def half(steppers: Sequence[Stepper], *_: object) -> list[tuple[Stepper, list[Outcome]]]:
        return [(s, [ends["kick_drift"], ends[s.name]]) for s in steppers]

    monkeypatch.setattr(ground_motion, "side_by_side", half)
    monkeypatch.setattr(ground_motion, "natural_frequencies", lambda: np.array([1.0]))
    monkeypatch.setattr(ground_motion, "predicted_sway", lambda: np.array([0.0, 1e-3]))
    monkeypatch.setattr(ground_motion, "influence_line", lambda: (np.array([0.0, 1.0]), np.array([0.0, 1e-3])))
    result = ground_motion.run(lambda _: None)
    assert list(result.data["rows"]) == ["kick_drift"]
    assert result.failures == ["mujoco_tendons: crashed, killed"]


@pytest.mark.parametrize("speed", [10.0, 40.0])
def test_a_truck_is_watched_until_it_has_crossed(speed: float) -> None:
    """To the last whole step before it leaves."""
    _, drive, duration = ground_motion.crossed_bridge(speed)
    left = drive.places[-1] / speed - duration
    assert 0 <= left < DT
    assert duration / DT == pytest.approx(round(duration / DT))


def test_off_the_line_is_the_largest_distance_from_it() -> None:
    """As a part of its largest sag: 1 mm off at the end, and nowhere else, of 4 mm; line and sag go with the truck."""
    places, down = np.array([0.0, 2.0, 4.0]), np.array([0.0, 4e-3, 0.0])
    speed = 1.0 / DT
    sag = np.array([0.0, 2e-3, 4e-3, 2e-3, 1e-3])
    assert ground_motion.off_the_line(sag, speed, (places, down)) == pytest.approx(0.25)
    assert ground_motion.off_the_line(-sag, speed, (places, down)) == pytest.approx(2.0)


def moved(by: float, frames: int = 2) -> Outcome:
    """The bridge, whose every mass is down by so much [m] in the end, and to the side by twice as much."""
    start = shaken_bridge().system.positions
    positions = np.array([start] * (frames - 1) + [start - by * np.array([2.0, 1.0])])
    return Outcome("done", "", Trajectory(DT * np.arange(frames), positions, np.zeros_like(positions)))


def test_the_middle_goes_up_in_the_sweep_and_sags_under_a_truck(monkeypatch: pytest.MonkeyPatch) -> None:
    """A millimetre down: -1 mm of sway, 1 mm of sag; each truck by its speed."""
    monkeypatch.setattr(ground_motion, "SPEEDS", (10.0, 40.0))
    ran = ground_motion._ran([moved(1e-3), moved(2e-3), moved(3e-3)])
    assert ran.shaken == pytest.approx([0.0, -1e-3])
    assert {speed: sag.tolist() for speed, sag in ran.crossed.items()} == {
        10.0: pytest.approx([0.0, 2e-3]),
        40.0: pytest.approx([0.0, 3e-3]),
    }
    assert ran.distance is None


def test_an_engine_is_compared_with_the_scheme_of_each_bridge() -> None:
    """With damping the shaken one, without the trucks': the largest distance, where both have a motion."""

    class Claims(Doctored):
        identified_as = MappingProxyType({"plain": "rk4", "damping": "heun", "drag": "rk4"})

    engine = EngineStepper(Claims())
    assert ground_motion.claims(engine) == ("heun", "rk4")
    ran = ground_motion.Ran(np.zeros(2), {})
    ends = {
        engine.name: [moved(1e-3), moved(2e-3), moved(5e-3)],
        "heun": [moved(1e-3), moved(0.5), moved(0.5)],
        "rk4": [moved(0.5), moved(5e-3), moved(6e-3)],
    }
    assert ground_motion._with_distance(engine, ran, ends).distance == pytest.approx(3e-3 * 5**0.5)
    lost = {**ends, engine.name: [moved(2e-3), Outcome("crashed", "killed"), moved(6e-3)]}
    assert ground_motion._with_distance(engine, ran, lost).distance == pytest.approx(1e-3 * 5**0.5)


def test_every_run_is_as_long_as_what_it_is_driven_by(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sweep, then a truck at each speed until it has crossed."""
    asked: list[tuple[int, float, int]] = []

    class Asked:
        def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change]) -> Outcome:
            asked.append((len(system.masses), dt, steps))
            return Outcome("done", str(len(changes)))

    monkeypatch.setattr(ground_motion, "SPEEDS", (10.0, 40.0))
    monkeypatch.setattr(ground_motion, "SWEEP", replace(SWEEP, duration=0.4))
    ends = ground_motion.outcomes(Asked())  # type: ignore[arg-type]
    assert [steps for *_, steps in asked] == [
        round(0.4 / DT),
        *(round(ground_motion.crossed_bridge(v)[2] / DT) for v in (10.0, 40.0)),
    ]
    assert {dt for _, dt, _ in asked} == {DT}
    assert len(ends) == 3
    assert all(int(end.reason) > 0 for end in ends)
