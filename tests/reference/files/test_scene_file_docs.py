"""The scene files that the documentation shows are read."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from reference.errors import InputError
from reference.files.mesh_file import EDGES
from reference.files.scene_file import GroundMotionTable, load
from reference.files.system_tables import MeshTable, SystemTable
from reference.scenes import Setup

DOCS = Path(__file__).parents[3] / "report" / "docs" / "scene-files.md"
TEXT = DOCS.read_text(encoding="utf-8")
NAMED, WRITTEN_OUT, NONLINEAR, ON_A_LINE, OF_A_MESH, BESIDES = re.findall(r"```toml\n(.*?)```", TEXT, flags=re.S)

#: Three by three vertices.
BLANKET = "".join(f"v {i % 3} {i // 3} 0\n" for i in range(9)) + "".join(
    f"f {a} {a + 1} {a + 4}\nf {a} {a + 4} {a + 3}\n" for a in (1, 2, 4, 5)
)


def loaded(folder: Path, text: str) -> Setup:
    """The setup of a file with that text, a blanket beside it."""
    (folder / "blanket.obj").write_text(BLANKET)
    (folder / "bed.toml").write_text(text)
    return load(folder / "bed.toml", {})


@pytest.mark.parametrize(
    "form",
    [NAMED, WRITTEN_OUT, NONLINEAR, ON_A_LINE, OF_A_MESH],
    ids=["named", "written out", "not linear", "on a line", "of a mesh"],
)
def test_every_form_is_read(tmp_path: Path, form: str) -> None:
    """As it stands there."""
    assert len(loaded(tmp_path, form).system.springs) > 1


def test_what_stands_besides_is_read(tmp_path: Path) -> None:
    """With either form in the plane."""
    for form in (NAMED, WRITTEN_OUT):
        setup = loaded(tmp_path, form + BESIDES)
        assert len(setup.system.obstacles) == 1
        assert setup.system.pulls[2].tolist() == [0.0, -2.0]
        assert setup.system.to_dict()["angular_springs"]["rest_angles"] == [3.14159]
        assert [change.parameter for change in setup.changes].count("stiffness") == 1
        assert [change.parameter for change in setup.changes].count("gravity") > 100


def test_the_record_that_is_shown_is_read(tmp_path: Path) -> None:
    """In place of the sweep."""
    (tmp_path / "record.csv").write_text(*re.findall(r"```csv\n(.*?)```", TEXT, flags=re.S))
    setup = loaded(tmp_path, NAMED + '[ground_motion]\nfile = "record.csv"\nscale = 9.81\n')
    assert 30 < len(setup.changes) < 45


def test_a_typing_mistake_there_would_be_seen(tmp_path: Path) -> None:
    """Shown to fail: another key is no key."""
    with pytest.raises(InputError, match="stiffnes"):
        loaded(tmp_path, OF_A_MESH.replace("stiffness", "stiffnes"))


def test_what_is_left_out_is_as_it_says(tmp_path: Path) -> None:
    """Scale 1, no damping, no drag, no fixed masses, gravity 9.81 m/s^2 downwards."""
    system = loaded(tmp_path, '[mesh]\nfile = "blanket.obj"\nmasses = 0.1\nstiffness = 1\n').system
    assert system.positions[8].tolist() == [2.0, 2.0, 0.0]
    assert not np.any([system.damping.any(), system.drag, system.fixed.any()])
    assert system.gravity.tolist() == [0.0, -9.81, 0.0]


def test_every_key_and_every_kind_of_element_is_told() -> None:
    """None is left out of the documentation."""
    for key in (f for table in (MeshTable, SystemTable, GroundMotionTable) for f in table.__struct_fields__):
        assert re.search(rf"^(# )?{key} = ", TEXT, flags=re.M), key
    names = {"line": "lines", "quad": "quadrilaterals", "tetra": "tetrahedra", "hexahedron": "hexahedra"}
    for kind in (*EDGES, "polygon"):
        assert names.get(kind, f"{kind}s") in TEXT
