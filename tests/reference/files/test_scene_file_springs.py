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
