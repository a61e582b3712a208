"""Scene files: good ones make setups; bad ones are told file, key and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reference.changes import Change
from reference.errors import InputError
from reference.files.scene_file import load
from reference.obstacles import Plane
from reference.scenes import Setup, find

NAMED = """\
scene = "string"            # a named scene
dt = 5e-4
duration = 0.25

[parameters]
masses = 20
stiffness = 500             # a whole number is a number
mass = [0.01, 0.02, 0.01, 0.02, 0.01, 0.02, 0.01, 0.02, 0.01, 0.02,
        0.01, 0.02, 0.01, 0.02, 0.01, 0.02, 0.01, 0.02, 0.01, 0.02]

[[changes]]
time = 0.2
parameter = "stiffness"
value = 100

[[changes]]
time = 0.1
parameter = "drag"
value = 0.05
"""

WRITTEN_OUT = """\
dt = 2e-3

[system]
positions = [[0.0, 0.0], [3.0, 4.0], [6, 0]]
springs = [[0, 1], [1, 2]]
masses = [0.1, 0.2, 0.3]
stiffness = 50.0
rest_lengths = [4.0, 6.0]
damping = [0.1, 0.0]
drag = 0.02
gravity = [0.0, -1.6]
velocities = [[0.0, 0.0], [1.0, 2.0], [0.0, 0.0]]
fixed = [0, 2]
"""


def written(folder: Path, text: str) -> Path:
    """A file with that text."""
    file = folder / "hill.toml"
    file.write_text(text, encoding="utf-8")
    return file


def loaded(folder: Path, text: str, **parameters: str) -> Setup:
    """The setup of a file with that text."""
    return load(written(folder, text), parameters)


# --- Good ones ---


def test_a_named_scene_with_parameters_and_changes(tmp_path: Path) -> None:
    """All that is in the file, named after it."""
    setup = loaded(tmp_path, NAMED)
    expected = find("string").system({"masses": 20, "stiffness": 500.0, "mass": [0.01, 0.02] * 10})
    assert setup.name == "hill"
    assert (setup.dt, setup.duration) == (5e-4, 0.25)
    assert setup.system.to_dict() == expected.to_dict()
    assert setup.changes == (Change(0.2, "stiffness", 100.0), Change(0.1, "drag", 0.05))


def test_what_is_left_out_is_the_scenes_own(tmp_path: Path) -> None:
    """Step, duration, parameters."""
    setup, scene = loaded(tmp_path, 'scene = "spring"\n'), find("spring")
    assert (setup.dt, setup.duration, setup.changes) == (scene.dt, scene.duration, ())
    assert setup.system.to_dict() == scene.system({}).to_dict()


def test_settings_come_before_the_files_parameters(tmp_path: Path) -> None:
    """As given on the command line, in text; the file's others stay."""
    system = loaded(tmp_path, NAMED, stiffness="7.5", drag="0.1").system
    assert system.stiffness.tolist() == [7.5] * 20
    assert system.drag == 0.1
    assert system.masses[:3].tolist() == [0.01, 0.01, 0.02]


def test_a_system_written_out(tmp_path: Path) -> None:
    """Field by field; `fixed` lists the fixed masses."""
    setup = loaded(tmp_path, WRITTEN_OUT)
    system = setup.system
    assert (setup.dt, setup.duration) == (2e-3, 0.5)
    assert system.positions.tolist() == [[0.0, 0.0], [3.0, 4.0], [6.0, 0.0]]
    assert system.springs.tolist() == [[0, 1], [1, 2]]
    assert system.masses.tolist() == [0.1, 0.2, 0.3]
    assert system.stiffness.tolist() == [50.0, 50.0]
    assert system.rest_lengths.tolist() == [4.0, 6.0]
    assert system.damping.tolist() == [0.1, 0.0]
    assert system.drag == 0.02
    assert system.gravity.tolist() == [0.0, -1.6]
    assert system.velocities.tolist() == [[0.0, 0.0], [1.0, 2.0], [0.0, 0.0]]
    assert system.fixed.tolist() == [True, False, True]


ALONG_A_LINE = """\
[system]
positions = [0, -0.5, -1.25]
springs = [[0, 1], [1, 2]]
masses = 0.1
stiffness = 50.0
velocities = [0.0, 0.0, 1.0]
fixed = [0]

[[obstacles]]
kind = "plane"
point = [-2.0]
normal = [3.0]
"""


def test_a_system_along_a_line(tmp_path: Path) -> None:
    """A number for each mass, with brackets of its own or without; gravity downwards, or along the line as a list."""
    system = loaded(tmp_path, ALONG_A_LINE).system
    assert system.positions.tolist() == [[0.0], [-0.5], [-1.25]]
    assert system.velocities.tolist() == [[0.0], [0.0], [1.0]]
    assert system.rest_lengths.tolist() == [0.5, 0.75]
    assert system.gravity.tolist() == [-9.81]
    assert system.obstacles == (Plane((-2.0,), (1.0,)),)
    bracketed = ALONG_A_LINE.replace("[0, -0.5, -1.25]", "[[0], [-0.5], [-1.25]]").replace(
        "fixed", "gravity = 9.81\nfixed"
    )
    assert loaded(tmp_path, bracketed).system.to_dict() == system.to_dict()
    upwards = ALONG_A_LINE.replace("fixed", "gravity = [2.0]\nfixed")
    assert loaded(tmp_path, upwards).system.gravity.tolist() == [2.0]


def test_the_ground_moves_along_a_line(tmp_path: Path) -> None:
    """Along the one axis: gravity is -9.81 m/s^2 less the ground's, and never turned."""
    sweep = "from_frequency = 1.0\nto_frequency = 1.0\namplitude = 2.0\nduration = 1.0\n"
    setup = loaded(tmp_path, f"dt = 0.01\nduration = 1.0\n{ALONG_A_LINE}\n[ground_motion]\n{sweep}")
    for change in setup.changes:
        ground = 2.0 * np.sin(2 * np.pi * (change.time + 0.005))
        assert setup.system.with_parameter("gravity", change.value).gravity == pytest.approx(
            [-9.81 - ground], abs=1e-12
        )
    assert len(setup.changes) > 90  # at an extreme two steps have the same
    with pytest.raises(InputError, match="the ground moves along 2 axes: expected at most the system's 1"):
        loaded(tmp_path, f"{ALONG_A_LINE}\n[ground_motion]\n{sweep}direction = [1.0, 0.0]\n")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "[0, -0.5, -1.25]",
            "[0, [-0.5], [-1.0, 2.0]]",
            "positions[2] = [-1.0, 2.0]: expected 1 numbers, as positions[0] has",
        ),
        ("[0.0, 0.0, 1.0]", "[[0.0, 0.0]]", "velocities has shape (1, 2): expected (3, 1)"),
        ("[3.0]", "[0.0, 1.0]", "normal = [0.0, 1.0]: expected 1 finite number [m]"),
        ('"plane"\npoint', '"circle"\nradius = 1.0\ncentre', "unknown number of a circle 'normal'"),
        ("[-2.0]", "[-1.0]", "positions[2] = [-1.25]: expected a start outside the plane obstacles[0], it is 0.25 m"),
    ],
)
def test_what_is_wrong_along_a_line_is_said(tmp_path: Path, old: str, new: str, said: str) -> None:
    """In one line, with the file."""
    assert old in ALONG_A_LINE
    with pytest.raises(InputError) as caught:
        loaded(tmp_path, ALONG_A_LINE.replace(old, new))
    assert said in str(caught.value)
    assert "hill.toml" in str(caught.value)


def test_rest_lengths_left_out_are_the_lengths_at_the_start(tmp_path: Path) -> None:
    """Unstretched: 5 m and 5 m; in 3D too."""
    text = "\n".join(line for line in WRITTEN_OUT.splitlines() if not line.startswith("rest_lengths"))
    assert loaded(tmp_path, text).system.rest_lengths.tolist() == [5.0, 5.0]
    solid = "[system]\npositions = [[0, 0, 0], [1, 2, 2]]\nsprings = [[0, 1]]\nmasses = 1\nstiffness = 1\n"
    assert loaded(tmp_path, solid).system.rest_lengths.tolist() == [3.0]


def test_an_empty_list_of_springs_is_a_heap_of_masses(tmp_path: Path) -> None:
    """They fall."""
    text = "[system]\npositions = [[0, 0], [1, 1]]\nsprings = []\nmasses = 1\nstiffness = 1\n"
    assert len(loaded(tmp_path, text).system.springs) == 0


# --- Bad ones ---


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        # Types, with the key path.
        ('scene = "string"\ndt = "fast"\n', ", line 2", "dt: expected a number, got text"),
        ("scene = 3\n", ", line 1", "scene: expected text, got a whole number"),
        (
            'scene = "string"\n[parameters]\nmasses = 4\nstiffness = "stiff"\n',
            ", line 4",
            "parameters.stiffness = 'stiff': expected a number or a list of numbers",
        ),
        (
            'scene = "string"\n[parameters]\nmass = [1.0, [2.0]]\n',
            ", line 3",
            "parameters.mass = [1.0, [2.0]]: expected a number or a list of numbers",
        ),
        (
            'scene = "string"\n[[changes]]\ntime = 0.1\nparameter = "drag"\nvalue = "much"\n',
            ", line 5",
            "changes[0].value: expected a number or a list, got text",
        ),
        (
            WRITTEN_OUT.replace("3.0, 4.0", '3.0, "far"'),
            ", line 4",
            "system.positions[1][1]: expected a number, got text",
        ),
        (
            WRITTEN_OUT.replace("[[0, 1], [1, 2]]", "7"),
            ", line 5",
            "system.springs: expected a list, got a whole number",
        ),
        (
            WRITTEN_OUT.replace("[0, 2]", "[true]"),
            ", line 13",
            "system.fixed[0]: expected a whole number, got true or false",
        ),
        # Keys.
        (WRITTEN_OUT + "dampign = 1.0\n", ", line 14", "system: unknown key 'dampign': did you mean 'damping'?"),
        ('scene = "string"\nduratoin = 1.0\n', ", line 2", "unknown key 'duratoin': did you mean 'duration'?"),
        (WRITTEN_OUT.replace("masses = [0.1, 0.2, 0.3]\n", ""), "", "system.masses is missing"),
        (
            'scene = "string"\n[[changes]]\ntime = 0.1\nparameter = "drag"\n',
            "",
            "changes[0].value is missing",
        ),
        (
            'scene = "string"\n[parameters]\nstifness = 100.0\n',
            ", line 3",
            "unknown parameter of scene 'string' 'stifness': did you mean 'stiffness'?",
        ),
        ('scene = "strng"\n', "", "unknown scene 'strng': did you mean 'string'?"),
        # Numbers that some are missing of, and that stand elsewhere.
        (
            WRITTEN_OUT.replace("masses = [0.1, 0.2, 0.3]", "masses = [0.1]"),
            ", line 6",
            "masses = [0.1]: expected a number for all, or one for each of 3 masses",
        ),
        (
            WRITTEN_OUT + "hardening = [2.0]\n",
            ", line 14",
            "hardening = [2.0]: expected a number for all, or one for each of 2 springs",
        ),
        (
            WRITTEN_OUT + '[[changes]]\ntime = 0.1\nparameter = "stiffness"\nvalue = [1.0, 2.0, 3.0]\n',
            ", line 17",
            "changes[0].value: stiffness has 3 numbers: expected one, or one for each of 2 springs",
        ),
        # What there must be one of.
        ("dt = 1e-3\n", "", 'expected either scene = "..." or a table [system] or a table [mesh]'),
        ("", "", 'expected either scene = "..." or a table [system] or a table [mesh]'),
        (
            'scene = "string"\n' + WRITTEN_OUT,
            "",
            'expected either scene = "..." or a table [system] or a table [mesh]',
        ),
        (
            WRITTEN_OUT + "[parameters]\nmass = 3.0\n",
            ", line 15",
            "mass: expected no parameters, the system is written out",
        ),
        # Values.
        (WRITTEN_OUT.replace("[0.1, 0.2, 0.3]", "nan"), ", line 6", "masses = nan: expected a finite number [kg]"),
        (WRITTEN_OUT.replace("0.2, 0.3", "-0.2, 0.3"), ", line 6", "masses[1] = -0.2: expected a number > 0 [kg]"),
        (WRITTEN_OUT.replace("50.0", "-1"), ", line 7", "stiffness = -1: expected a number >= 0 [N/m]"),
        (
            WRITTEN_OUT.replace("[1, 2]]\nm", "[1, 3]]\nm"),
            ", line 5",
            "springs[1] = [1, 3]: expected masses from 0 to 2",
        ),
        (
            WRITTEN_OUT.replace("[1, 2]]\nm", "[1]]\nm"),
            ", line 5",
            "springs = [[0, 1], [1]]: expected two masses for each spring",
        ),
        (
            WRITTEN_OUT.replace("[6, 0]", "[3, 4]"),
            ", line 5",
            "springs[1] = [1, 2]: expected a length > 0, both masses start at [3.0, 4.0]",
        ),
        (WRITTEN_OUT.replace("[0, 2]", "[0, 5]"), ", line 13", "fixed[1] = 5: expected a mass from 0 to 2"),
        (WRITTEN_OUT.replace("[0, 2]", "[-1]"), ", line 13", "fixed[0] = -1: expected a mass from 0 to 2"),
        (
            "[system]\npositions = []\nsprings = []\nmasses = 1.0\nstiffness = 1.0\nfixed = [0]\n",
            ", line 2",
            "positions has shape (0,): expected (n, 1), (n, 2) or (n, 3) with n >= 1",
        ),
        ('scene = "string"\n[parameters]\nmass = -1.0\n', ", line 3", "mass = -1: expected a number > 0 [kg]"),
        ('scene = "string"\n[parameters]\nmasses = 2.5\n', ", line 3", "masses = 2.5: expected a whole number"),
        (
            'scene = "string"\n[parameters]\n  stiffness = [1.0, 2.0]\n',
            ", line 3",
            "stiffness has 2 numbers: expected one, or one for each of 10",
        ),
        # Syntax: the parser's own words and place.
        ('scene = "string\n', "", "Illegal character '\\n' (at line 1, column 16)"),
        ("dt = 1e-3\nscene = string\n", "", "Invalid value (at line 2, column 9)"),
        ('scene = "string"\nscene = "spring"\n', "", "Cannot overwrite a value (at line 2, column 17)"),
    ],
)
def test_a_bad_file_is_told_where_and_what(tmp_path: Path, text: str, place: str, message: str) -> None:
    """File, line where it is known, key path, value, expectation: one line."""
    file = written(tmp_path, text)
    with pytest.raises(InputError) as refused:
        load(file, {})
    assert str(refused.value) == f"scene file {file}{place}: {message}"


def test_times_of_ones_own_are_those_that_changes_have_to_fit(tmp_path: Path) -> None:
    """The scene lasts 0.5 s of itself: a change at 0.83 s is the file's mistake alone, and none in a run of 1.2 s."""
    text = 'scene = "string"\n[[changes]]\ntime = 0.83\nparameter = "stiffness"\nvalue = 150\n'
    file = written(tmp_path, text)
    assert load(file, {}, duration=1.2).duration == 1.2
    with pytest.raises(InputError, match=r"^scene file .* change of stiffness at 0\.83 s: expected at most 0\.499 s"):
        load(file, {})
    late = written(tmp_path, "duration = 1.2\n" + text)
    with pytest.raises(InputError) as refused:
        load(late, {}, duration=0.6)
    assert str(refused.value).startswith("change of stiffness at 0.83 s: expected at most 0.599 s")


def test_a_byte_order_mark_is_read_over(tmp_path: Path) -> None:
    """As Windows' Notepad begins a file with one."""
    file = tmp_path / "own.toml"
    file.write_bytes(b"\xef\xbb\xbf" + b'scene = "string"\r\ndt = 2e-3\r\n')
    assert load(file, {}).dt == 2e-3


def test_the_same_key_twice_has_no_one_line(tmp_path: Path) -> None:
    """The second change's value is wrong: the path says which, a line might say the other."""
    file = written(tmp_path, NAMED.replace("value = 0.05", 'value = "0.05"'))
    with pytest.raises(InputError) as refused:
        load(file, {})
    assert str(refused.value) == f"scene file {file}: changes[1].value: expected a number or a list, got text"


def test_a_file_that_cannot_be_read_is_told_why(tmp_path: Path) -> None:
    """Missing; a folder; no text."""
    missing, picture = tmp_path / "none.toml", tmp_path / "picture.toml"
    picture.write_bytes(b"\x89PNG\xff\xfe")
    for file, why in (
        (missing, "No such file or directory"),
        (tmp_path, "Is a directory"),
        (picture, "expected UTF-8 text"),
    ):
        with pytest.raises(InputError) as refused:
            load(file, {})
        assert str(refused.value) == f"scene file {file}: {why}"


def test_settings_cannot_change_a_system_written_out(tmp_path: Path) -> None:
    """Nor be unknown to the scene."""
    with pytest.raises(InputError, match="drag: expected no parameters, the system is written out"):
        loaded(tmp_path, WRITTEN_OUT, drag="0.1")
    with pytest.raises(InputError, match="unknown parameter of scene 'string' 'drg': did you mean 'drag'"):
        loaded(tmp_path, NAMED, drg="0.1")


@pytest.mark.parametrize("text", [NAMED, WRITTEN_OUT])
def test_a_step_of_zero_is_not_taken_for_one_left_out(tmp_path: Path, text: str) -> None:
    """It is refused, with file and line."""
    lines = ["dt = 0.0" if line.startswith("dt") else line for line in text.splitlines()]
    with pytest.raises(InputError, match=r"line \d+: dt = 0: expected a finite number > 0"):
        loaded(tmp_path, "\n".join(lines))


def test_a_parameter_that_is_a_word_is_given_as_one(tmp_path: Path) -> None:
    """A truss by its name; another word, or a word where a number is expected, is refused with its line."""
    text = 'scene = "bridge"\n[parameters]\nkind = "howe"\n'
    assert loaded(tmp_path, text).system.to_dict() == find("bridge").system({"kind": "howe"}).to_dict()
    for wrong, message in (
        (text.replace("howe", "roof"), "line 3: kind = 'roof': expected one of warren, pratt, howe"),
        (text.replace('"howe"', "3"), "line 3: kind = 3: expected one of warren, pratt, howe"),
        (text.replace("kind", "deck"), "line 3: parameters.deck = 'howe': expected a number or a list of numbers"),
    ):
        with pytest.raises(InputError) as refused:
            loaded(tmp_path, wrong)
        assert str(refused.value).endswith(message)
