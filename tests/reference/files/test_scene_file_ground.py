"""The table [ground_motion] of scene files."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.errors import InputError
from reference.files.scene_file import load
from reference.scenes import Setup

STRING = 'scene = "string"\ndt = 1e-2\nduration = 0.1\n'
SWEEP = "[ground_motion]\nfrom_frequency = 2\nto_frequency = 4\namplitude = 1\nduration = 0.05\n"
WRITTEN_OUT = "[system]\npositions = [[0, 0], [1, 0]]\nsprings = [[0, 1]]\nmasses = 1\nstiffness = 10\nfixed = [0]\n"


def loaded(folder: Path, text: str, dt: float | None = None) -> Setup:
    """The setup of a file with that text, a record beside it."""
    (folder / "record.csv").write_text("t, x\n0, 1\n1, 1\n")
    (folder / "hill.toml").write_text(text)
    return load(folder / "hill.toml", {}, dt)


@pytest.mark.parametrize("form", [STRING, WRITTEN_OUT])
def test_a_sweep_or_a_record_goes_with_any_form(tmp_path: Path, form: str) -> None:
    """As changes of gravity: one a step; of a constant acceleration one in all."""
    swept = loaded(tmp_path, form + SWEEP, dt=1e-2).changes
    assert [change.parameter for change in swept] == ["gravity"] * 6
    (change,) = loaded(tmp_path, form + '[ground_motion]\nfile = "record.csv"\nscale = 2\n').changes
    assert change.value == (-2.0, -9.81)


def test_steps_of_ones_own_make_changes_of_their_own(tmp_path: Path) -> None:
    """Twice as many for half the step."""
    assert len(loaded(tmp_path, STRING + SWEEP, dt=5e-3).changes) == 11


@pytest.mark.parametrize(
    ("table", "place", "message"),
    [
        (SWEEP + 'file = "record.csv"\n', "", "ground_motion.from_frequency: expected a record or a sweep, not both"),
        ("[ground_motion]\nscale = 2\n", ", line 5", "ground_motion.scale: expected a file with it"),
        (
            "[ground_motion]\nfrom_frequency = 1\n",
            "",
            "ground_motion.to_frequency is missing: expected a sweep's numbers or a file",
        ),
        (
            SWEEP.replace("amplitude = 1", "amplitude = -1"),
            ", line 7",
            "ground_motion.amplitude = -1: expected a finite number >= 0 [m/s^2]",
        ),
        (
            SWEEP + "direction = [1, 0, 0]\n",
            "",
            "the ground moves along 3 axes: expected at most the system's 2",
        ),
        (SWEEP + "frequency = 1\n", ", line 9", "unknown key 'frequency'"),
    ],
)
def test_a_table_that_makes_no_sense_is_refused(tmp_path: Path, table: str, place: str, message: str) -> None:
    """With the key, and the line where it is known."""
    with pytest.raises(InputError) as refused:
        loaded(tmp_path, STRING + table)
    said = str(refused.value).removeprefix(f"scene file {tmp_path / 'hill.toml'}")
    assert message.split(" - ")[0] in said
    assert said.startswith(place + ": " if place else "")


def test_a_record_that_is_missing_is_named(tmp_path: Path) -> None:
    """And the scene file too."""
    with pytest.raises(InputError, match=r"scene file .*hill\.toml.*: record .*other\.csv: No such file"):
        loaded(tmp_path, STRING + '[ground_motion]\nfile = "other.csv"\n')


def test_a_scene_whose_ground_moves_takes_no_other_motion(tmp_path: Path) -> None:
    """One of them would be lost."""
    with pytest.raises(InputError, match="gravity is driven 2 times"):
        loaded(tmp_path, 'scene = "earthquake"\n' + SWEEP)
