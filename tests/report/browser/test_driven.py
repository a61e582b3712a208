"""Changes and what is driven, as the page reads them; a preset's words; what is kept of a recording."""

from __future__ import annotations

import base64
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from experiments.runs import steppers
from reference.changes import Change
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from report.browser import changes, recordings
from report.browser.changes import changes_data, drives_data, often
from report.browser.presets import Preset
from report.browser.recordings import Recording, recording_data


def test_what_changes_all_the_time_is_a_table_and_other_things_are_changes() -> None:
    """More than fifty times; a table has a row for each step, and those of its numbers that change."""
    times = [i * 0.01 for i in range(1, 52)]
    driven = [Change(t, "stiffness", [100.0, 100.0 + i, 100.0]) for i, t in enumerate(times, 1)]
    rare = [Change(t, "damping", 0.5) for t in times[:50]]
    assert often([*driven, *rare]) == {"stiffness"}
    alone = [Change(0.25, "gravity", (0.0, -1.0)), Change(0.5, "release", 0.0)]
    assert changes_data([*driven, *alone]) == [
        {"time": 0.25, "parameter": "gravity", "value": [0.0, -1.0]},
        {"time": 0.5, "parameter": "release", "value": 0.0},
    ]
    setup = replace(find("string").setup({"masses": 3, "stiffness": 100.0}, 0.01, 0.52), changes=(*driven, *alone))
    (table,) = drives_data(setup)
    assert (table["parameter"], table["dt"], table["ground"], table["columns"]) == ("stiffness", 0.01, False, [1])
    rows = np.frombuffer(base64.b64decode(table["rows"]), "<f8")
    assert len(rows) == 52
    assert rows[-1] == 151.0
    assert set(np.diff(rows)) <= {0.0, 1.0, 2.0}


def test_a_table_may_be_so_large_and_no_larger(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of all its numbers; what the page does not know is refused by name, also where it is driven."""
    driven = tuple(Change(i * 0.01, "stiffness", 100.0 + i) for i in range(1, 52))
    setup = replace(find("string").setup({"masses": 3}, 0.01, 0.51), changes=driven)
    monkeypatch.setattr(changes, "MOST_NUMBERS", 3 * 51)
    assert len(drives_data(setup)) == 1
    monkeypatch.setattr(changes, "MOST_NUMBERS", 3 * 51 - 1)
    with pytest.raises(Unsupported, match="stiffness changes at 51 steps, 3 numbers each: the page takes at most 152 "):
        drives_data(setup)
    unknown = replace(setup, changes=tuple(replace(one, parameter="radii") for one in driven))
    with pytest.raises(Unsupported, match="changes of radii: the page does not know them"):
        drives_data(unknown)
    with pytest.raises(Unsupported, match="changes of radii"):
        changes_data([Change(0.1, "radii", 0.5)])


def test_a_preset_has_the_scenes_words_and_its_own(tmp_path: Path) -> None:
    """Its name, or the scene's; what is set of it in the title. A file has no summary."""
    own = Preset("string", {"masses": "3", "mass": "0.5"}, name="heavy", magnified=2.0).data()
    assert (own["name"], own["scene"], own["title"]) == ("heavy", "string", "string (masses = 3, mass = 0.5)")
    assert (own["settings"], own["magnified"], own["command"]) == ({"masses": "3", "mass": "0.5"}, 2.0, "string")
    assert (own["summary"], own["slides"]) == (find("string").summary, find("string").slides)
    assert (own["system"]["n"], own["system"]["masses"]) == (4, 0.5)
    plain = Preset("spring").data()
    assert (plain["name"], plain["title"], plain["recordings"]) == ("spring", "spring", [])
    file = tmp_path / "mine.toml"
    file.write_text('scene = "spring"\n', encoding="utf-8")
    filed = Preset(str(file)).data()
    assert (filed["name"], filed["title"], filed["command"]) == ("mine", "mine", str(file))
    assert (filed["summary"], filed["slides"]) == ("", "")


def test_a_recording_is_of_what_was_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its step, time and parameters, or the scene's; so many frames that they are no more numbers than there may be."""
    setup = find("string").setup({"masses": 2}, 0.01, 8.0)
    asked: list[Any] = []

    class Stepper:
        """Masses on their way along a parabola, in x only."""

        ending = "done"

        def run(self, system: Any, dt: float, steps: int, changed: Any) -> Outcome:
            asked.append((system.drag, dt, steps, changed))
            t = dt * np.arange(steps + 1)
            places = np.zeros((len(t), 3, 2))
            places[:, 1, 0] = t**2
            return Outcome(self.ending, "because", Trajectory(t, places, 0 * places))  # type: ignore[arg-type]

    stepper = Stepper()
    monkeypatch.setattr(steppers, "find_steppers", lambda names: [stepper])
    monkeypatch.setattr(recordings, "NUMBERS", 6 * 11)
    data = recording_data(Recording("heun", "mine", {"drag": 0.5}, 0.02, 2.0), setup)
    assert asked == [(0.5, 0.02, 100, setup.changes)]
    assert (data["name"], data["stepper"], data["dt"], data["every"]) == ("mine", "heun", 0.02, 0.2)
    frames = np.frombuffer(base64.b64decode(data["frames"]), "<i2").reshape(11, 3, 2)
    assert data["offset"] == [2.0, 0.0]
    assert frames[:, 1, 0] * data["quantum"] + 2.0 == pytest.approx((0.2 * np.arange(11)) ** 2, abs=data["quantum"])
    # between frames a parabola of a = 2 m/s^2 is off by a (T/2)^2 / 2
    assert data["error"] == pytest.approx(0.1**2, abs=data["quantum"])
    plain = recording_data(Recording("heun"), setup)
    assert asked[1] == (setup.system.drag, 0.01, 400, setup.changes)  # no longer than four seconds
    assert plain["name"] == "heun"
    stepper.ending = "diverged"
    with pytest.raises(Unsupported, match="heun is not recorded: diverged, because"):
        recording_data(Recording("heun"), setup)
