"""Files of the user's own in lanes: stepped in their own process, predicted by what they are, and no others run."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from report.live import own_files
from report.live.lab import Lab
from report.live.own_files import admit
from report.live.status import status
from report.live.stepping import checked, choices
from tests.report.live.labs import apart, open_lab

KICK_DRIFT = """
def step(a, x, v, dt):
    v = v + dt * a(x, v)
    return x + dt * v, v
"""


@pytest.fixture
def file(tmp_path: Path) -> str:
    """Kick-drift, as a file that was named when the lab was opened."""
    path = tmp_path / "mine.py"
    path.write_text(KICK_DRIFT, encoding="utf-8")
    return admit(str(path))


def test_a_lane_does_what_the_file_does_and_has_the_limit_of_what_it_is(labs: list[Lab], file: str) -> None:
    """To the rounding of fifty steps; the limit is that of its scheme; it is in the menus."""
    lab = open_lab(labs, "string", [file, "kick_drift"])
    assert file in choices()
    lab.advance(50)
    run = simulate(find_scene("string").system({}), find("kick_drift"), lab.timeline.dt, 0.05)
    assert apart(lab.timeline.lanes[0].state, run.states()[-1]) < 1e-11
    lab.wait_for_predictions()
    assert lab.predictions[file].scheme == "kick_drift"
    assert lab.predictions[file].limit == lab.predictions["kick_drift"].limit
    assert f"{file}, identified as kick_drift on a string" in status(lab, "")
    assert f"--stepper={file}" in lab.reproduction().commands[0]


def test_a_file_that_fails_is_a_lane_less_until_it_is_mended(labs: list[Lab], file: str) -> None:
    """With its line; the lane beside it goes on; what was written meanwhile is read with a reset."""
    Path(file).write_text(KICK_DRIFT.replace("dt * v, v", "dt * v, w"), encoding="utf-8")
    lab = open_lab(labs, "string", [file, "heun"])
    lab.advance(5)
    lane, other = lab.timeline.lanes
    assert lane.stopped == "crashed: mine.py, line 4: NameError: name 'w' is not defined"
    assert other.stopped is None
    Path(file).write_text(KICK_DRIFT, encoding="utf-8")
    lab.reset()
    lab.advance(5)
    assert lab.timeline.lanes[0].stopped is None
    Path(file).unlink()
    lab.reset()
    assert "expected a file that can be read" in (lab.timeline.lanes[0].stopped or "")


def test_a_file_that_was_not_named_at_the_start_is_not_run(tmp_path: Path, labs: list[Lab]) -> None:
    """Whoever looks at the page may ask for any name."""
    path = tmp_path / "other.py"
    path.write_text("raise SystemExit", encoding="utf-8")
    for call in (lambda: checked([str(path)]), lambda: open_lab(labs).set_steppers([str(path)])):
        with pytest.raises(InputError, match="was started with"):
            call()
    assert admit("heun") == "heun"
    with pytest.raises(InputError, match="expected a file that can be read"):
        admit(str(tmp_path / "nothing.py"))


@pytest.mark.parametrize(("damping", "drag"), [((0.1, 0.0, 0.0), 0.0), ((0.0, 0.0, 0.0), 0.2), ((0.0, 0.0, 0.3), 0.2)])
def test_what_a_file_is_is_found_out_once_for_each_text_and_damping(
    file: str, damping: tuple[float, ...], drag: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One damped spring is enough; what was written meanwhile is another text."""
    asked: list[tuple[bool, bool]] = []

    def find_out(stepper: object, damped: bool, dragged: bool) -> str:
        asked.append((damped, dragged))
        return f"{damped} {dragged}"

    monkeypatch.setattr(own_files, "identified_on_a_string", find_out)
    monkeypatch.setattr(own_files, "_FOUND", {})
    system = find_scene("string").system({"masses": 3}).with_parameter("damping", damping).with_parameter("drag", drag)
    wanted = any(damping), drag > 0
    assert [own_files.identified(file, system) for _ in range(2)] == [f"{wanted[0]} {wanted[1]}"] * 2
    assert asked == [wanted]
    Path(file).write_text(KICK_DRIFT + "# mended", encoding="utf-8")
    own_files.identified(file, system)
    assert asked == [wanted] * 2
