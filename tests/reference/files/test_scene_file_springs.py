"""Springs that are not linear, in scene files of every form and among the parameters of named scenes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reference.errors import InputError
from reference.files.scene_file import load
from reference.scenes import find
from reference.springs.kinds import NonlinearSprings

#: Two springs.
WRITTEN_OUT = """\
[system]
positions = [0.0, 1.0, 2.0]
springs = [[0, 1], [1, 2]]
masses = 0.1
stiffness = 50.0
fixed = [0]
"""

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def law(folder: Path, text: str) -> NonlinearSprings:
    """What a file's springs have besides."""
    (folder / "ropes.toml").write_text(text)
    (folder / "mesh.obj").write_text(TRIANGLE)
    found = load(folder / "ropes.toml", {}).system.nonlinear
    assert found is not None
    return found


def test_of_a_system_written_out(tmp_path: Path) -> None:
    """Springs by their numbers or all; numbers, one for all or one for each; infinity where there is no limit."""
    found = law(tmp_path, WRITTEN_OUT + "tension_only = [1]\nbreaking_force = [inf, 3.0]\nhardening = 10.0\n")
    assert found.asked == ["tension_only", "hardening", "breaking_force"]
    assert found.tension_only.tolist() == [False, True]
    assert found.breaking_force.tolist() == [np.inf, 3.0]
    assert found.hardening.tolist() == [10.0, 10.0]
    assert law(tmp_path, WRITTEN_OUT + "compression_only = true\n").compression_only.all()


def test_of_a_mesh_and_of_a_named_scene(tmp_path: Path) -> None:
    """The same keys; on the command line as text."""
    mesh = '[mesh]\nfile = "mesh.obj"\nstiffness = 1.0\ntotal_mass = 1.0\n'
    assert law(tmp_path, mesh + "largest_force = 2\ntension_only = [2]\n").tension_only.tolist() == [False, False, True]
    named = law(
        tmp_path, 'scene = "string"\n[parameters]\nmasses = 3\ntension_only = true\nbreaking_stretch = [1, 2, 3]\n'
    )
    by_words = find("string").system({"masses": "3", "tension_only": "1", "breaking_stretch": "1,2,3"}).nonlinear
    assert by_words is not None
    assert named.to_dict() == by_words.to_dict()


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("tension_only = [2]", "line 7: tension_only[0] = 2: expected a spring from 0 to 1"),
        ("tension_only = 1", "line 7: system.tension_only: expected"),
        ("breaking_force = -1", "line 7: breaking_force = -1: expected a number > 0 [N]"),
        ("largest_force = [1, 2, 3]", "line 7: largest_force has shape (3,)"),
        ("tension_only = [0, 1, 0]", "line 7: tension_only[2] = 0: expected every number once"),
        ("restitution = 0.5", "line 7: restitution = 0.5: expected radii above zero with it"),
        ("hardenin = 1", "line 7: system: unknown key 'hardenin'"),
    ],
)
def test_a_mistake_is_told_with_its_line(tmp_path: Path, line: str, said: str) -> None:
    """File, line, key, value and what was expected."""
    with pytest.raises(InputError) as refused:
        law(tmp_path, WRITTEN_OUT + line + "\n")
    assert said in str(refused.value)


def test_words_for_yes_and_no_of_named_scenes() -> None:
    """1 and 0, and nothing else; a typing mistake has a suggestion."""
    assert find("string").system({"tension_only": "0"}).nonlinear is None
    for name, value, said in (("tension_only", "2", "1 for springs that do"), ("breakin_force", "1", "breaking_force")):
        with pytest.raises(InputError, match=said):
            find("string").system({name: value})


BENT = WRITTEN_OUT.replace("[0.0, 1.0, 2.0]", "[[0.0, 1.0], [0.0, 0.0], [2.0, 0.0]]")


def test_angular_springs_of_every_form(tmp_path: Path) -> None:
    """A table each, and one at every mass where two springs meet; as laid out where no rest angle is said; or both."""
    table = "[[angular_springs]]\nmasses = [2, 1, 0]\nstiffness = 0.5\n"

    def read(text: str) -> dict[str, object]:
        (tmp_path / "wire.toml").write_text(text)
        found: dict[str, object] = load(tmp_path / "wire.toml", {}).system.to_dict()["angular_springs"]
        return found

    right = pytest.approx([np.pi / 2])
    assert read(BENT + table) == {"masses": [[2, 1, 0]], "stiffness": [0.5], "rest_angles": right}
    assert read(BENT + table + "rest_angle = 2\n")["rest_angles"] == [2.0]
    both = read(BENT + "angular_stiffness = 3\n" + table)
    assert both["masses"] == [[0, 1, 2], [2, 1, 0]]
    assert both["rest_angles"] == pytest.approx([3 * np.pi / 2, np.pi / 2])
    named = read('scene = "string"\n[parameters]\nmasses = 3\nangular_stiffness = [1, 2]\n')
    assert (named["masses"], named["stiffness"]) == ([[0, 1, 2], [1, 2, 3]], [1.0, 2.0])
    for line, said in (
        (table.replace("2,", "5,"), "expected masses from 0 to 2"),
        (table[:38], "stiffness is missing"),
    ):
        with pytest.raises(InputError, match=said):
            read(BENT + line)
    with pytest.raises(InputError, match="did you mean 'rest_angle'"):
        read(BENT + table + "restangle = 2\n")


def test_a_rest_angle_that_is_no_number_is_refused(tmp_path: Path) -> None:
    """With its line: left out, not NaN, is the angle at the start."""
    table = "[[angular_springs]]\nmasses = [0, 1, 2]\nstiffness = 0.3\nrest_angle = nan\n"
    with pytest.raises(InputError) as refused:
        law(tmp_path, WRITTEN_OUT.replace("[0.0, 1.0, 2.0]", "[[0, 0], [1, 0], [2, 0]]") + table)
    assert "line 10: angular_springs[0].rest_angle = nan: expected a finite number" in str(refused.value)


@pytest.mark.parametrize(
    ("parameter", "value", "said"),
    [
        ("break", "[0, 0]", "break[1] = 0: expected every number once"),
        ("angular_stiffness", "0.1", "parameter 'angular_stiffness': it cannot change on the fly"),
    ],
)
def test_a_change_that_cannot_be_is_told_why(tmp_path: Path, parameter: str, value: str, said: str) -> None:
    """And no other name is suggested for one that scenes have."""
    with pytest.raises(InputError) as refused:
        law(tmp_path, WRITTEN_OUT + f'[[changes]]\ntime = 0.1\nparameter = "{parameter}"\nvalue = {value}\n')
    assert said in str(refused.value)
