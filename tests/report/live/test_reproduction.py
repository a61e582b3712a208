"""The commands that the lab gives: they come to the state that is seen, in schemes and engines, whatever was done."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from reference.changes import Change
from reference.files.scene_file import load
from reference.scenes import find as find_scene
from reference.state import Array
from report.live.lab import Lab
from report.live.reproduction import reproduction, written_out
from report.live.segment import Segment
from tests.report.live.commands import ends, run
from tests.report.live.labs import ROUNDING, apart, move_at_random, open_lab


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("name", ["pymunk_springs", "mujoco_tendons", "mujoco_tendons_rk4"])
def test_an_engine_does_what_its_run_by_command_does(labs: list[Lab], tmp_path: Path, name: str) -> None:
    """Changed on the fly, in a process of its own, beside a scheme."""
    lab = open_lab(labs, "string", [name, "heun"])
    move_at_random(lab, 2)
    last = ends(lab.reproduction(), tmp_path)
    for lane in lab.timeline.lanes:
        assert apart(lane.state, last[lane.name]) <= ROUNDING


def disturb_with_dt(lab: Lab) -> None:
    """Another step, midway."""
    lab.set_dt(0.7e-3)


def disturb_by_drag(lab: Lab) -> None:
    """A mass dragged about and let go."""
    for place in ((0.9, 0.1), (1.0, 0.2), (0.8, 0.3)):
        lab.grab(6, np.array(place))
        lab.advance(7)
    lab.release()


def hold(lab: Lab) -> None:
    """A mass on the cursor, which is not let go."""
    lab.grab(3, np.array([0.3, 0.1]))


def disturb_by_pin(lab: Lab) -> None:
    """A mass pinned, the anchor let go."""
    lab.toggle_pin(4)
    lab.advance(5)
    lab.toggle_pin(0)


def disturb_by_stepper(lab: Lab) -> None:
    """Other steppers take over, and one comes in besides."""
    lab.set_steppers(["rk4", "pymunk_springs", "euler"])


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize(
    "disturb", [disturb_with_dt, disturb_by_drag, hold, disturb_by_pin, disturb_by_stepper], ids=lambda f: f.__name__
)
def test_the_command_comes_to_the_present_state(labs: list[Lab], tmp_path: Path, disturb: object) -> None:
    """After what a command cannot say it is given a file; every stepper ends where it is seen, to rounding."""
    lab = open_lab(labs, "string", ["heun", "mujoco_tendons"])
    lab.advance(40)
    before = [lane.state for lane in lab.timeline.lanes]
    disturb(lab)  # type: ignore[operator]
    assert np.abs(without_cursor(lab, 0) - before[0].positions).max() < 0.4
    lab.advance(25)
    lab.set_parameter("stiffness", 180.0)
    lab.advance(10)
    last = ends(lab.reproduction(), tmp_path)
    for lane in lab.timeline.lanes:
        assert apart(lane.state, last[lane.name]) <= ROUNDING, lane.name


def without_cursor(lab: Lab, i: int) -> Array:
    """Positions of a lane's own masses [m]."""
    return lab.timeline.lanes[i].state.positions[: len(lab.timeline.system.masses)]


def test_the_command_line_itself_runs_it(labs: list[Lab], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both as a scene with changes, and from a file."""
    lab = open_lab(labs, "string", ["kick_drift"], masses="4")
    lab.advance(30)
    lab.set_parameter("stiffness", 150.0)
    lab.advance(30)
    (line,) = lab.reproduction().commands
    assert line.startswith("springlab compare string --stepper=kick_drift --dt=0.001 --duration=0.06 --set=masses=4")
    assert "kick_drift" in run(line)
    lab.set_dt(2e-3)
    lab.advance(3)
    found = lab.reproduction()
    monkeypatch.chdir(tmp_path)
    for name, text in found.files.items():
        Path(name).write_text(text)
    assert "kick_drift" in run(found.commands[0])


def test_many_changes_go_into_a_file(labs: list[Lab], tmp_path: Path) -> None:
    """And those of one number for each spring, where springs differ: there a slider is a multiple."""
    lab = open_lab(labs, "bridge", ["heun"])
    lab.advance(3)
    lab.set_parameter("stiffness", 0.5)
    lab.advance(3)
    found = lab.reproduction()
    assert list(found.files) == ["bridge-live.toml"]
    assert apart(lab.timeline.lanes[0].state, ends(found, tmp_path)["heun"]) <= ROUNDING * lab.timeline.system.size
    halved = 0.5 * find_scene("bridge").system({}).stiffness
    np.testing.assert_allclose(lab.timeline.system.stiffness, halved, rtol=1e-15)
    alone = load(tmp_path / "bridge-live.toml", {})
    assert (alone.dt, alone.duration) == (lab.timeline.dt, 6 * lab.timeline.dt)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("scene", ["crossing", "earthquake"])
def test_a_scene_that_is_driven_is_a_file(labs: list[Lab], tmp_path: Path, scene: str) -> None:
    """With all that the truck or the ground has changed, and what was moved besides; also with another dt midway."""
    lab = open_lab(labs, scene, ["kick_drift", "rk4"])
    lab.advance(150)
    lab.set_parameter("damping", 2e4)
    lab.advance(50)
    for _ in range(2):
        last = ends(lab.reproduction(), tmp_path)
        for lane in lab.timeline.lanes:
            assert apart(lane.state, last[lane.name]) <= ROUNDING * lab.timeline.system.size
        lab.set_dt(0.7e-3)
        lab.advance(60)


def test_a_forgotten_change_is_seen(labs: list[Lab], tmp_path: Path) -> None:
    """Shown to fail: the command of a segment without its changes comes to another state."""
    lab = open_lab(labs)
    lab.advance(20)
    lab.set_parameter("stiffness", 150.0)
    lab.advance(40)
    forgetful: Segment = replace(lab.timeline.segment, changes=())
    assert apart(lab.timeline.lanes[0].state, ends(reproduction(forgetful), tmp_path)["kick_drift"]) > 1e-6


def test_what_was_changed_after_the_last_step_is_not_in_the_command(labs: list[Lab]) -> None:
    """It has done nothing yet, and a run that ends before a change is refused; after a step it is there."""
    lab = open_lab(labs, "string", ["heun"])
    lab.advance(5)
    lab.set_parameter("stiffness", 150.0)
    assert "--change" not in lab.reproduction().commands[0]
    lab.advance(1)
    assert "--change=0.005:stiffness=150.0" in lab.reproduction().commands[0]


def test_a_scene_with_some_of_everything_is_read_again(tmp_path: Path) -> None:
    """Springs that are not linear and masses that collide, to the bit."""
    settings = {"masses": "3", "tension_only": "1,0,0", "breaking_force": "1,2,3", "radii": "0.01"}
    system = find_scene("string").system(settings)
    (tmp_path / "out.toml").write_text(written_out(system, system.start))
    assert load(tmp_path / "out.toml", {}).system.to_dict() == system.to_dict()


def test_a_system_that_resists_bending_is_written_out_and_so_is_what_broke(tmp_path: Path) -> None:
    """Its file makes the same system; a spring that is gone is broken at once there, for good."""
    string = find_scene("string").system({"masses": 3, "angular_stiffness": "0.1,0.2"})
    (tmp_path / "bent.toml").write_text(written_out(string, string.start))
    again = load(tmp_path / "bent.toml", {})
    assert again.system.to_dict() == string.to_dict()
    torn = string.with_parameter("break", [1])
    (tmp_path / "torn.toml").write_text(written_out(torn, torn.start))
    setup = load(tmp_path / "torn.toml", {})
    assert setup.changes == (Change(0.0, "break", (1.0,)),)
    assert setup.systems_at([1])[0].to_dict() == torn.to_dict()
