"""Scene files whose system is a mesh in another file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reference.errors import InputError
from reference.files.scene_file import load
from tests.reference.files.mesh_files import BLANKET

SCENE = """\
dt = 2e-4

[mesh]
file = "meshes/blanket.obj"
scale = 0.1
total_mass = 0.2
stiffness = 50.0
damping = 0.02
drag = 0.01
gravity = [0.0, 0.0, -9.81]
fixed = [0, 2]
"""


def scene(folder: Path, text: str = SCENE) -> Path:
    """A scene file with that text, and its mesh in a folder beside it."""
    (folder / "meshes").mkdir()
    (folder / "meshes" / "blanket.obj").write_text(BLANKET)
    (folder / "bed.toml").write_text(text)
    return folder / "bed.toml"


def test_a_scene_of_a_mesh(tmp_path: Path) -> None:
    """All that is in the file; springs are unstretched: 0.3, 0.4 and, across, 0.5 m."""
    setup = load(scene(tmp_path), {})
    system = setup.system
    assert (setup.name, setup.dt, setup.duration) == ("bed", 2e-4, 0.5)
    assert system.positions == pytest.approx(0.1 * np.array([[0, 0, 0], [3, 0, 0], [0, 4, 0], [3, 4, 0]]), abs=1e-15)
    assert sorted(system.rest_lengths) == pytest.approx([0.3, 0.3, 0.4, 0.4, 0.5])
    assert system.masses.tolist() == [0.05] * 4
    assert system.stiffness.tolist() == [50.0] * 5
    assert system.damping.tolist() == [0.02] * 5
    assert (system.drag, system.gravity.tolist()) == (0.01, [0.0, 0.0, -9.81])
    assert system.fixed.tolist() == [True, False, True, False]


def test_masses_one_by_one(tmp_path: Path) -> None:
    """In place of the whole mass; the scale left out is 1."""
    text = SCENE.replace("total_mass = 0.2", "masses = [0.1, 0.2, 0.3, 0.4]").replace("scale = 0.1\n", "")
    system = load(scene(tmp_path, text), {}).system
    assert system.masses.tolist() == [0.1, 0.2, 0.3, 0.4]
    assert system.positions[3].tolist() == [3.0, 4.0, 0.0]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("scale = 0.1", "scale = 0", "bed.toml, line 5: mesh.scale = 0: expected a number > 0 [m]"),
        ("total_mass = 0.2", "total_mass = -1.0", "mesh.total_mass = -1: expected a number > 0 [kg]"),
        ("total_mass = 0.2", "", "mesh: expected either masses or total_mass"),
        ("total_mass = 0.2", "total_mass = 0.2\nmasses = 1.0", "mesh: expected either masses or total_mass"),
        ("total_mass = 0.2", "masses = [1.0, 2.0]", "masses has shape"),
        ("fixed = [0, 2]", "fixed = [4]", "fixed[0] = 4: expected a mass from 0 to 3"),
        ("stiffness = 50.0", "", "mesh.stiffness is missing"),
        ("stiffness = 50.0", "stiffnes = 50.0", "unknown key 'stiffnes'"),
        ("blanket.obj", "sheet.obj", "sheet.obj: no such file"),
        ("[mesh]", "[system]\n[mesh]", "system.positions is missing"),
        ("dt = 2e-4", 'scene = "string"', 'expected either scene = "..." or a table [system] or a table [mesh]'),
        ("dt = 2e-4", "parameters = {mass = 1.0}", "mass: expected no parameters, the system is written out"),
    ],
)
def test_a_bad_scene_of_a_mesh_is_told(tmp_path: Path, old: str, new: str, message: str) -> None:
    """With the key or the mesh file, in a line."""
    text = SCENE.replace(old, new)
    assert text != SCENE
    with pytest.raises(InputError) as refusal:
        load(scene(tmp_path, text), {})
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)
