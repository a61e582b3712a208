"""Mesh files: edges become springs, each once; a bad file is told in a line, with the vertex or element."""

from __future__ import annotations

import io
import struct
from contextlib import redirect_stdout
from pathlib import Path

import meshio
import numpy as np
import pytest

from reference.errors import InputError
from reference.files import mesh_file
from reference.files.mesh_file import Mesh, read_mesh
from tests.reference.files.mesh_files import BINARY_BLOCK, BLANKET, BLOCK, BLOCK_EDGES, NEXT_BLOCK, block


def mesh(folder: Path, text: str | bytes, name: str = "blanket.obj") -> Mesh:
    """The mesh in a file with that text."""
    (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_mesh(folder / name)


def edges(found: Mesh) -> list[tuple[int, ...]]:
    """In order, smaller numbers first."""
    return sorted(tuple(sorted(pair)) for pair in found.edges.tolist())


# --- Good ones ---


def test_a_surface(tmp_path: Path) -> None:
    """Vertices in the file's order; the edge that both triangles have is one; groups and normals change nothing."""
    found = mesh(tmp_path, BLANKET)
    assert found.positions.tolist() == [[0, 0, 0], [3, 0, 0], [0, 4, 0], [3, 4, 0]]
    assert edges(found) == [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)]


@pytest.mark.parametrize("text", [BLOCK, NEXT_BLOCK, BINARY_BLOCK], ids=["text", "next version", "binary"])
def test_a_solid(tmp_path: Path, text: str | bytes) -> None:
    """Two tetrahedra with a face in common: nine edges, whatever form the file has."""
    found = mesh(tmp_path, text, "block.vtk")
    assert found.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    assert edges(found) == BLOCK_EDGES


@pytest.mark.parametrize(
    ("kind", "corners", "count"),
    [(3, 2, 1), (5, 3, 3), (7, 5, 5), (9, 4, 4), (10, 4, 6), (12, 8, 12), (13, 6, 9), (14, 5, 8)],
    ids=["line", "triangle", "polygon", "quad", "tetra", "hexahedron", "wedge", "pyramid"],
)
def test_every_kind_of_element_has_its_edges(tmp_path: Path, kind: int, corners: int, count: int) -> None:
    """Euler: corners - edges + faces = 2 for solids; all corners have as many, a pyramid's top aside."""
    found = mesh(tmp_path, block(kind, corners), "block.vtk")
    assert len(found.edges) == len(set(edges(found))) == count
    of_corner = np.bincount(found.edges.ravel())
    assert sorted(of_corner) == ([3, 3, 3, 3, 4] if kind == 14 else [2 * count // corners] * corners)


def test_an_edge_may_be_in_three_triangles(tmp_path: Path) -> None:
    """It is one spring all the same: what is no surface of anything is a mesh of springs as good as any."""
    found = mesh(tmp_path, BLANKET + "v 0 0 5\nf 2 3 5\n")
    assert edges(found) == [(0, 1), (0, 2), (1, 2), (1, 3), (1, 4), (2, 3), (2, 4)]


def test_numbers_are_kept_to_the_last_bit(tmp_path: Path) -> None:
    """And a colour behind a vertex is no coordinate."""
    text = "v 0.1 1e-300 -0.3 1 0 0\nv 0.30000000000000004 2 3 1 0 0\nv 1 1 1 1 0 0\nf 1 2 3\n"
    assert mesh(tmp_path, text).positions[:2].tolist() == [[0.1, 1e-300, -0.3], [0.30000000000000004, 2, 3]]


def test_edges_are_listed_in_the_order_of_the_elements(tmp_path: Path) -> None:
    """And within an element from corner to corner: whoever gives springs numbers one by one counts on it."""
    text = "".join(f"v {i} {i * i} 0\n" for i in range(5)) + "f 4 5 3\nf 2 1 3\nf 1 4 3\n"
    pairs = [tuple(sorted(pair)) for pair in mesh(tmp_path, text).edges.tolist()]
    assert pairs == [(3, 4), (2, 4), (2, 3), (0, 1), (0, 2), (1, 2), (0, 3)]


def test_lines_of_an_obj_file_are_springs(tmp_path: Path) -> None:
    """Two-vertex faces, as course meshes write springs; lines of several vertices; beside faces, none twice."""
    found = mesh(tmp_path, BLANKET + "l 1/1 4\nf 1 2\nl 3 1 2\n")
    assert edges(found) == [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    only = mesh(tmp_path, "v 0 0\nv 1 0\nv 2 1\nl 1 2 3\n")
    assert edges(only) == [(0, 1), (1, 2)]
    assert only.positions.tolist() == [[0, 0, 0], [1, 0, 0], [2, 1, 0]]


@pytest.mark.parametrize("ending", [".vtu", ".msh", ".mesh", ".ply", ".vtk", ".obj"])
def test_files_of_other_programs_formats(tmp_path: Path, ending: str) -> None:
    """The same two triangles as meshio writes them: the same vertices, to the bit where a format keeps all digits."""
    points = np.array([[0, 0, 0], [1, 0, 0.1], [0, 1, 0], [1.1, 1, 0]], dtype=float)
    cells = [("triangle", np.array([[0, 1, 2], [2, 1, 3]]))]
    file = tmp_path / f"two{ending}"
    with redirect_stdout(io.StringIO()):
        meshio.write(file, meshio.Mesh(points, cells))
    found = read_mesh(file)
    np.testing.assert_allclose(found.positions, points, rtol=1e-12)
    assert edges(found) == [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)]


def test_a_ply_file_without_the_end_of_its_header_is_told(tmp_path: Path) -> None:
    """Its reader would go on for ever (found by `tests.fuzz`)."""
    text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
    check_told(tmp_path, text, "cut.ply", "expected a mesh in the format .ply: its header has no end")


def test_what_is_no_face_and_no_edge_of_another_is_a_spring_too(tmp_path: Path) -> None:
    """A face of two vertices alone; and the sides of a polygon, in its order, the one that closes it last."""
    assert edges(mesh(tmp_path, "v 0 0\nv 1 0\nv 2 1\nf 1 2\nl 2 3\n")) == [(0, 1), (1, 2)]
    points = "".join(f"v {x} {y} 0\n" for x, y in ((0, 0), (2, 0), (3, 1), (1, 2), (-1, 1)))
    assert mesh(tmp_path, points + "f 1 2 3 4 5\n").edges.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4], [0, 4]]


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_flat_is_told_by_its_shape_and_not_by_its_size(tmp_path: Path, size: float) -> None:
    """A triangle whose height is 1e-11 of its longest side is one, at 1e-13 it is flat: also where it is a needle."""
    corners = "v 0 0 0\nv {0} 0 0\nv {1} {2} 0\nf 1 2 3\n"
    for along in (size, size / 2):
        assert len(mesh(tmp_path, corners.format(size, along, 1e-11 * size)).edges) == 3
        check_told(tmp_path, corners.format(size, along, 1e-13 * size), "thin.obj", "element 1 is flat")


def test_numbers_of_corners_may_be_written_with_a_point(tmp_path: Path) -> None:
    """If they are whole, as the next version of VTK's files may have them."""
    text = NEXT_BLOCK.replace("CONNECTIVITY vtktypeint64", "CONNECTIVITY double")
    assert edges(mesh(tmp_path, text, "block.vtk")) == BLOCK_EDGES


def test_an_element_of_too_few_vertices_is_told(tmp_path: Path) -> None:
    """As a damaged file may have them (found by `tests.fuzz`)."""
    file = tmp_path / "few.mesh"
    file.write_text(
        "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 1\n1 0 0 1\n0 1 0 1\nTriangles\n1\n1 2\nEnd\n"
    )
    with pytest.raises(InputError):
        read_mesh(file)


def test_what_a_reader_makes_of_too_few_vertices_is_told() -> None:
    """With the element, counted from the first kind on, and how many it needs."""
    pair, four = np.array([[0, 1]]), np.array([[0, 1, 2, 3]])
    for kind, corners, needed in (("triangle", pair, 3), ("quad", pair, 4), ("tetra", pair, 4), ("pyramid", four, 5)):
        whole = meshio.CellBlock(kind, np.arange(2 * needed).reshape(2, needed))
        assert mesh_file._blocks([whole])[0].corners.shape == (2, needed)
        said = f"element 3: expected {needed} vertices of a {kind}, not {corners.shape[1]}"
        with pytest.raises(InputError, match=said):
            mesh_file._blocks([whole, meshio.CellBlock(kind, corners)])


def test_single_points_are_passed_over(tmp_path: Path) -> None:
    """As Gmsh marks corners with them: they join nothing."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    file = tmp_path / "marked.vtu"
    meshio.write(file, meshio.Mesh(points, [("vertex", np.array([[0]])), ("triangle", np.array([[0, 1, 2]]))]))
    found = read_mesh(file)
    assert (edges(found), found.passed_over) == ([(0, 1), (0, 2), (1, 2)], 1)
    assert found.told == "3 masses, 3 springs: 3 of triangle; 1 single points passed over"


@pytest.mark.parametrize(
    ("ending", "first"), [(".obj", 1), (".vtk", 0), (".vtu", 0), (".msh", 1), (".mesh", 1), (".ply", 0)]
)
def test_vertices_are_counted_as_in_the_file(tmp_path: Path, ending: str, first: int) -> None:
    """From 0 or from 1: the fourth of them is in no triangle."""
    file = tmp_path / f"four{ending}"
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], dtype=float)
    with redirect_stdout(io.StringIO()):
        meshio.write(file, meshio.Mesh(points, [("triangle", np.array([[0, 1, 2]]))]))
    with pytest.raises(InputError, match=f"vertex {3 + first} is in no element"):
        read_mesh(file)


# --- Bad ones ---

BAD = {
    "out of range": (BLANKET.replace("f 1 2 3", "f 1 2 5"), "element 1 names vertex 5: expected one from 1 to 4"),
    "two out of range": (BLANKET.replace("f 1 2 3", "f 6 2 5"), "element 1 names vertex 6: expected one from 1 to 4"),
    "backwards": (BLANKET.replace("f 1 2 3", "f 1 2 -1"), "element 1 names vertex -1: expected one from 1 to 4"),
    "from zero": (BLANKET.replace("f 1 2 3", "f 0 1 2"), "element 1 names vertex 0: expected one from 1 to 4"),
    "a number beyond all": (BLANKET.replace("2/1/1 4", f"2/1/1 {10**30}"), "element 2 names vertex 1000000"),
    "a corner twice": (BLANKET.replace("2/1/1 4", "2/1/1 3"), "element 2 names vertex 3 twice"),
    "flat": (BLANKET.replace("v 3 4 0", "v -3 8 0"), "element 2 is flat: expected a triangle with area"),
    "in one place": (
        BLANKET.replace("v 3 4 0", "v 3 0 0"),
        "element 2: vertices 2 and 4 are in one place, expected a length > 0",
    ),
    "a line of one vertex": (BLANKET + "l 1\n", "line '1': expected two vertices or more"),
    "a line of words": (BLANKET + "l 1 a\n", "line '1 a': expected the numbers of its vertices"),
    "a line out of range": (BLANKET + "l 1 9\n", "element 3 names vertex 9: expected one from 1 to 4"),
    "no corners": (BLANKET + "f\n", "element 3: expected the numbers of its vertices"),
    "two corners twice": (
        BLANKET.replace("1 2 3", "1 2 2").replace("2/1/1 4", "2/1/1 3"),
        "element 1 names vertex 2 twice",
    ),
    "two in one place": (
        BLANKET.replace("v 3 4 0", "v 3 0 0") + "v 0 4 0\nf 5 3 1\n",
        "element 2: vertices 2 and 4 are in one place",
    ),
    "two not numbers": (
        BLANKET.replace("v 3 4 0", "v 3 nan 0").replace("v 3 0 0", "v inf 0 0"),
        "vertex 2 = [inf, 0.0, 0.0]: expected finite numbers",
    ),
    "not a number": (BLANKET.replace("v 3 4 0", "v 3 nan 0"), "vertex 4 = [3.0, nan, 0.0]: expected finite numbers"),
    "too large": (BLANKET.replace("v 3 4 0", "v 1e300 4 0"), "expected coordinates whose distances are finite"),
    "on a line": ("v 0\nv 1\nv 2\nf 1 2 3\n", "expected two or three coordinates of every vertex"),
    "a coordinate short": (
        BLANKET.replace("v 3 4 0", "v 3 4"),
        "expected a mesh in the format .obj: lines of one kind have as many numbers as one another",
    ),
    "a word": (BLANKET.replace("v 3 4 0", "v 3 x 0"), "expected a mesh in the format .obj: could not convert string"),
    "no elements": (BLANKET.partition("g one")[0], "it has no elements"),
    "a vertex too many": (BLANKET + "v 1 1 1\n", "vertex 5 is in no element: expected every vertex to be in one"),
    "nothing": ("", "it has no vertices"),
    "another text": ("Dear Sir,\n", "it has no vertices"),
    "a picture": (b"\x89PNG\r\n\x1a\n\x00\xff", "it has no vertices"),
}

BAD_BLOCKS = {
    "out of range": (BLOCK.replace("1 2 3 4\n", "1 2 3 5\n"), "element 2 names vertex 5: expected one from 0 to 4"),
    "flat": (BLOCK.replace("1 1 1\n", "-1 1 1\n"), "element 2 is flat: expected a tetra with volume"),
    "points alone": (block(1, 1), "it has no elements: expected at least one"),
    "a polygon of two": (block(7, 2), "element 1: expected three vertices or more, not 2"),
    "an unknown kind": (BLOCK.replace("\n10\n10", "\n10\n77"), "expected a mesh in the format .vtk: File contains"),
    "a kind that only warns": (
        NEXT_BLOCK.replace("\n10\n10", "\n10\n-1"),
        "expected a mesh in the format .vtk: Warning: File contains cells",
    ),
    "cut short": (BLOCK[: BLOCK.index("4 1 2")], "expected a mesh in the format .vtk: "),
    "more vertices than there are": (BLOCK.replace("POINTS 5", "POINTS 6"), "expected a mesh in the format .vtk: "),
    "more than any memory": (
        BLOCK.replace("POINTS 5", "POINTS 5000000000000"),
        "POINTS announces 5,000,000,000,000 numbers: expected at most",
    ),
    "more elements than its bytes": (BLOCK.replace("CELLS 2 10", "CELLS 2 100000"), "CELLS announces 100,000 numbers"),
    "an element of more corners": (
        BLOCK.replace("4 1 2 3 4\n", "4000000000 1 2 3 4\n").replace("\n10\n10", "\n7\n7"),
        "CELLS has the number 4000000000: expected at most",
    ),
    "an element of more corners in binary": (
        BINARY_BLOCK.replace(struct.pack(">i", 4), struct.pack(">i", 2**30), 1),
        "CELLS has the number 1073741824: expected at most",
    ),
    "a last corner beyond all in binary": (
        BINARY_BLOCK.replace(struct.pack(">2i", 3, 4), struct.pack(">2i", 3, 2**30)),
        "CELLS has the number 1073741824: expected at most",
    ),
    "a last corner beyond all in binary of the next version": (
        BINARY_BLOCK.partition(b"CELLS")[0]
        + b"CELLS 3 8\nOFFSETS vtktypeint64\n"
        + struct.pack(">3q", 0, 4, 8)
        + b"\nCONNECTIVITY vtktypeint64\n"
        + struct.pack(">8q", 0, 1, 2, 3, 1, 2, 3, 2**40)
        + b"\nCELL_TYPES 2\n"
        + struct.pack(">2i", 10, 10),
        "CELLS has the number 1099511627776: expected at most",
    ),
    "a field beyond all": (
        BLOCK + "POINT_DATA 5\nFIELD more 1\nheat 1000000 5 double\n1 2 3 4 5\n",
        "a field announces 1,000,000 numbers: expected at most",
    ),
    "corners that are no whole numbers": (
        NEXT_BLOCK.replace("CONNECTIVITY vtktypeint64\n0 1 2 3", "CONNECTIVITY double\n0 1 2 2.5"),
        "element 1: expected the numbers of its vertices",
    ),
    "a grid of numbers": (
        BLOCK.replace("UNSTRUCTURED_GRID", "STRUCTURED_POINTS"),
        "DATASET 'STRUCTURED_POINTS': expected UNSTRUCTURED_GRID",
    ),
    "a name that moves the cursor": (
        BLOCK.replace("UNSTRUCTURED", "UN\x1dSTR\x1bUC"),
        r"DATASET 'UN\x1dSTR\x1bUC_GRID': expected UNSTRUCTURED_GRID",
    ),
    "an OBJ file": (BLANKET, "expected a mesh in the format .vtk: Illegal VTK header"),
}


def check_told(folder: Path, text: str | bytes, name: str, message: str) -> None:
    """In one line that begins with the file's name."""
    with pytest.raises(InputError) as refusal:
        mesh(folder, text, name)
    told = str(refusal.value)
    assert told.startswith(f"mesh file {folder / name}: {message}")
    assert "\n" not in told
    assert len(told) < len(str(folder)) + 300


@pytest.mark.parametrize("case", BAD)
def test_a_bad_surface_is_told(tmp_path: Path, case: str) -> None:
    """With the vertex or element, as the file counts them."""
    check_told(tmp_path, BAD[case][0], "blanket.obj", BAD[case][1])


@pytest.mark.parametrize("case", BAD_BLOCKS)
def test_a_bad_solid_is_told(tmp_path: Path, case: str) -> None:
    """With the vertex or element; elements are counted from 1, vertices as in the file from 0."""
    check_told(tmp_path, BAD_BLOCKS[case][0], "block.vtk", BAD_BLOCKS[case][1])


@pytest.mark.parametrize("name", ["blanket.stl", "blanket", "obj"])
def test_another_ending_is_told(tmp_path: Path, name: str) -> None:
    """Whatever is in the file."""
    check_told(tmp_path, BLANKET, name, "expected a name that ends in .obj or .vtk or .vtu or .msh or .mesh or .ply")


@pytest.mark.parametrize("name", ["there is none.obj", "a\0b.obj", 300 * "long" + ".obj", ".", "folder.obj"])
def test_no_file_is_told(tmp_path: Path, name: str) -> None:
    """Nor a name that can be none, nor a folder."""
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(InputError, match=r"mesh file .*: (no such file|expected )"):
        read_mesh(tmp_path / name)


@pytest.mark.parametrize(
    ("ending", "text", "said"),
    [
        (".ply", "plx\n", "expected a mesh in the format .ply: "),
        (".ply", "ply\nformat ascii 1.0\nelement vertex 10000000000\n", "it announces 10,000,000,000 numbers"),
        (
            ".mesh",
            "MeshVersionFormatted 2\nDimension\n3\nVertices\n10000000000\n",
            "it announces 10,000,000,000 numbers",
        ),
        (".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10000000000\n", "it announces 10,000,000,000 numbers"),
        (".vtu", '<VTKFile><Piece NumberOfPoints="10000000000"/></VTKFile>', "it announces 10,000,000,000 numbers"),
    ],
)
def test_a_bad_file_of_another_format_neither_ends_the_program_nor_fills_the_memory(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], ending: str, text: str, said: str
) -> None:
    """As meshio would do with it; nothing is printed."""
    check_told(tmp_path, text, f"bad{ending}", said)
    assert capsys.readouterr() == ("", "")
