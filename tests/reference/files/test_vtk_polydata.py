"""VTK's polydata, as text and in binary; diagonals of quadrilaterals; and where springs come from."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from reference.errors import InputError
from reference.files.mesh_file import Mesh, read_mesh
from tests.report.commands.terminal import springlab

#: A square with a line to a corner outside: two cells of the older form, and a point that is passed over.
POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 1, 0)]
HEAD = "# vtk DataFile Version 4.2\na square\n{}\nDATASET POLYDATA\n"
TEXT = (
    HEAD.format("ASCII")
    + "POINTS 5 float\n"
    + "".join(f"{x} {y} {z}\n" for x, y, z in POINTS)
    + "VERTICES 1 2\n1 0\nLINES 1 4\n3 2 4 1\nPOLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA 5\nSCALARS s float\n"
)

#: What it has: the line's two pairs first, as they stand first, and the sides but the one that the line has.
EDGES = [(2, 4), (1, 4), (0, 1), (1, 2), (2, 3), (0, 3)]


def read(folder: Path, content: bytes, diagonals: bool = False) -> Mesh:
    """A file with that content."""
    (folder / "square.vtk").write_bytes(content)
    return read_mesh(folder / "square.vtk", diagonals)


def binary() -> bytes:
    """The same in binary, with OFFSETS and CONNECTIVITY as ParaView has written them since version 5.1."""
    whole = HEAD.format("BINARY").replace("4.2", "5.1").encode() + b"POINTS 5 double\n"
    whole += struct.pack(">15d", *(value for point in POINTS for value in point)) + b"\n"
    for name, offsets, corners in ((b"LINES", (0, 3), (2, 4, 1)), (b"POLYGONS", (0, 4), (0, 1, 2, 3))):
        whole += name + f" {len(offsets)} {len(corners)}\n".encode()
        whole += b"OFFSETS vtktypeint64\n" + struct.pack(f">{len(offsets)}q", *offsets) + b"\n"
        whole += b"CONNECTIVITY vtktypeint64\n" + struct.pack(f">{len(corners)}q", *corners) + b"\n"
    return whole


#: The same as text, in the form of version 5.1, and without a line's end behind it.
NEXT = TEXT.partition("VERTICES")[0].replace("4.2", "5.1") + (
    "VERTICES 2 1\nOFFSETS vtktypeint64\n0 1\nCONNECTIVITY vtktypeint64\n0\n"
    "LINES 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n2 4 1\n"
    "POLYGONS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3"
)


@pytest.mark.parametrize("content", [TEXT.encode(), NEXT.encode(), binary()], ids=["text", "next version", "binary"])
def test_lines_and_polygons_are_springs(tmp_path: Path, content: bytes) -> None:
    """Each edge once, in the order of the elements, and counted by what it came of."""
    mesh = read(tmp_path, content)
    assert mesh.positions.tolist() == [list(map(float, point)) for point in POINTS]
    assert [tuple(pair) for pair in mesh.edges.tolist()] == EDGES
    assert mesh.origins == {"line": 2, "quad": 4}


def test_quadrilaterals_have_diagonals_where_that_is_said(tmp_path: Path) -> None:
    """Both, after all sides."""
    mesh = read(tmp_path, TEXT.encode(), diagonals=True)
    assert [tuple(pair) for pair in mesh.edges.tolist()] == [*EDGES, (0, 2), (1, 3)]
    assert mesh.origins == {"line": 2, "quad": 4, "quad diagonals": 2}


def test_polygons_of_one_kind_come_together_where_they_follow_one_another(tmp_path: Path) -> None:
    """A triangle, two quadrilaterals, a triangle; one without corners joins nothing: edges in that order, each once."""
    corners = "3 0 1 2  4 0 2 4 3  4 0 1 4 3  0  3 1 2 4"
    mesh = read(tmp_path, (TEXT.partition("LINES")[0] + f"POLYGONS 5 19\n{corners}\n").encode())
    sides = [(0, 1), (1, 2), (0, 2), (2, 4), (3, 4), (0, 3), (1, 4)]
    assert [tuple(pair) for pair in mesh.edges.tolist()] == sides
    assert mesh.origins == {"triangle": 3, "quad": 4}


@pytest.mark.parametrize("offsets", ["0 5", "1 4", "0 3 2 4", "0 4 3", ""])
def test_offsets_are_checked(tmp_path: Path, offsets: str) -> None:
    """They rise from 0, and none is beyond the four corners there are."""
    before, _, polygons = NEXT.partition("POLYGONS 2")
    count = len(offsets.split())
    with pytest.raises(InputError, match="OFFSETS: expected numbers that rise from 0 to how many corners there are"):
        read(tmp_path, (before + f"POLYGONS {count}" + polygons.replace("\n0 4\n", f"\n{offsets}\n")).encode())


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("POINTS 5 float", "POINTS 50 float", "expected a mesh in the format .vtk"),
        ("POINTS 5 float", "POINTS 5 half", "numbers of type 'half'"),
        ("POINTS 5 float", "POINTS five float", "expected numbers of what follows"),
        ("LINES 1 4\n3 2 4 1", "LINES 1 4\n7 2 4 1", "expected for each its number of corners"),
        ("3 2 4 1", "3 2 9 1", "names vertex 9"),
        ("POLYGONS 1 5", "TRIANGLE_STRIPS 1 5", "expected LINES and POLYGONS"),
    ],
)
def test_a_mistake_is_one_line(tmp_path: Path, old: str, new: str, said: str) -> None:
    """With what was expected."""
    assert old in TEXT
    with pytest.raises(InputError) as refused:
        read(tmp_path, TEXT.replace(old, new).encode())
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_command_tells_where_springs_come_from(tmp_path: Path) -> None:
    """On standard error; the answer is as without."""
    (tmp_path / "square.vtk").write_text(TEXT)
    mesh = '[mesh]\nfile = "square.vtk"\ndiagonals = true\ntotal_mass = 1\nstiffness = 9\nfixed = [0]\n'
    (tmp_path / "bed.toml").write_text("duration = 0.002\n" + mesh)
    said = springlab("simulate", str(tmp_path / "bed.toml"), "--json")
    assert said.code == 0
    told = "5 masses, 8 springs: 2 of line, 4 of quad, 2 of quad diagonals; 1 single points passed over"
    assert f"mesh file square.vtk: {told}" in said.err
