"""Systems and recordings as the page reads them, and what it refuses."""

from __future__ import annotations

import base64
from dataclasses import replace

import numpy as np
import pytest

from reference.errors import Unsupported
from reference.scenes import find, scenes
from report.browser.changes import drives_data
from report.browser.presets import PRESETS, Preset
from report.browser.recordings import MOST, Recording, largest_error, quantised, recording_data
from report.browser.system_data import _compact, refuse_beyond, scene_data, system_data


def test_a_number_that_all_have_is_written_once() -> None:
    """And others one by one, fixed masses by their numbers."""
    data = system_data(find("cloth").system({"mass": 0.5, "rows": 3, "columns": 3}))
    assert (data["masses"], data["stiffness"], data["velocities"]) == (0.5, 40.0, 0.0)
    assert len(data["rest_lengths"]) == data["s"]
    assert len(data["positions"]) == data["n"] * data["d"]


@pytest.mark.parametrize(
    ("values", "written"),
    [([2.0, 2.0], 2.0), ([2.0, 2.0, 3.0], [2.0, 2.0, 3.0]), ([-0.0], -0.0), ([0.0, -0.0], [0.0, -0.0]), ([], [])],
)
def test_the_same_is_the_same_to_the_bit(values: list[float], written: object) -> None:
    """The sign of zero too, which is seen in what it is divided by; a table is written row by row."""
    assert repr(_compact(np.array(values))) == repr(written)
    assert _compact(np.array([[1.0, 2.0], [3.0, 1.0]])) == [1.0, 2.0, 3.0, 1.0]


def test_a_scene_has_the_command_lines_words_for_it() -> None:
    """Its name, where no others are given."""
    setup = find("spring").setup({}, 1e-3, 0.5)
    assert scene_data(setup)["command"] == "spring"
    assert scene_data(setup, command="spring --set mass=2")["command"] == "spring --set mass=2"
    assert (scene_data(setup)["dt"], scene_data(setup)["duration"]) == (1e-3, 0.5)


def test_what_the_page_does_not_know_and_what_is_too_large_is_refused() -> None:
    """With the reason: other springs, a table of a truck in too short steps, more masses than a browser steps."""
    with pytest.raises(Unsupported, match="shorter duration"):
        drives_data(find("crossing").setup({}, 1e-5, 0.6))
    with pytest.raises(Unsupported, match="collide"):
        refuse_beyond(find("string").system({"radii": 0.01}))
    with pytest.raises(Unsupported, match="pull"):
        refuse_beyond(replace(find("string").system({}), pulls=np.eye(11, 2)))
    refuse_beyond(find("slinky").system({}))  # of rest length 0
    with pytest.raises(Unsupported, match="2,500"):
        refuse_beyond(find("cloth").system({"rows": 60, "columns": 60}))


def test_every_scene_is_a_preset_or_refused() -> None:
    """The page leaves out what it cannot do, and nothing else."""
    for name in set(scenes()) - {preset.scene for preset in PRESETS}:
        with pytest.raises(Unsupported):
            Preset(name).data()


def test_a_recording_is_off_by_half_a_quantum_at_most() -> None:
    """Places are rounded to a quantum, in whole numbers of 16 bits; the end of the run is the reference's."""
    places = np.random.default_rng(0).normal(size=(7, 5, 3))
    offset, quantum, whole = quantised(places)
    assert np.abs(whole).max() == MOST < 2**15
    # as far on one side of the middle as on the other, along each axis
    assert whole.max(axis=(0, 1)) == pytest.approx(-whole.min(axis=(0, 1)), abs=1)
    assert np.abs(whole * quantum + offset - places).max() <= quantum / 2 * (1 + 1e-9)

    setup = find("oscillator").setup({})
    data = recording_data(Recording("kick_drift", dt=1e-3, duration=0.5), setup)
    frames = np.frombuffer(base64.b64decode(data["frames"]), "<i2").reshape(-1, 2, 1) * data["quantum"]
    t = data["every"] * np.arange(len(frames))
    # x = x_rest + (x_0 - x_rest) cos(w t) with w = sqrt(k/m) = 100 1/s; kick-drift at dt w = 0.1 is off by 5 % of it
    sag, start = 0.02 * 9.81 / 200, 0.01
    expected = -(0.125 + sag) + (sag - start) * np.cos(100 * t)
    assert np.abs(frames[:, 1, 0] + data["offset"][0] - expected).max() < 0.1 * start


def test_what_a_recording_is_off_by_is_measured() -> None:
    """Between frames 10 steps apart a parabola of a^2 = 2 is off by (T / 2)^2 in the middle; rounding comes on top."""
    t = np.arange(101) / 100
    places = (t**2)[:, None, None]
    assert largest_error(places, places[::10], 10) == pytest.approx(0.05**2)
    assert largest_error(places, places[::1] + 1e-3, 1) == pytest.approx(1e-3)

    data = recording_data(Recording("kick_drift"), find("oscillator").setup({}))
    assert data["every"] == 1e-3
    assert 0 < data["error"] <= data["quantum"]


def test_a_recording_that_does_not_come_to_its_end_is_refused() -> None:
    """With how it ended."""
    with pytest.raises(Unsupported, match="diverged"):
        recording_data(Recording("euler", dt=0.1, duration=4.0), find("oscillator").setup({}))
