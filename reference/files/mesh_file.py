"""Mesh files: vertices become masses, and the edges of elements become springs, each once.

Read by meshio: OBJ, with its lines too; VTK's unstructured grids, older format (.vtk) and newer (.vtu), and polydata of
the older one (`vtk_polydata`); Gmsh (.msh); MEDIT (.mesh); PLY. Of lines, triangles, quadrilaterals, polygons,
tetrahedra, pyramids, wedges and hexahedra.
"""

from __future__ import annotations

import io
import os
import re
import warnings
from collections.abc import Mapping
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError
from reference.files.regular_file import check_file
from reference.files.vtk_counts import check_counts, check_vtk_counts
from reference.state import Array
from reference.system import IntArray

#: By the end of a file's name, the number of its first vertex.
FORMATS = {".obj": 1, ".vtk": 0, ".vtu": 0, ".msh": 1, ".mesh": 1, ".ply": 0}

#: Elements that join nothing: meshes of surfaces mark corners with them. They have no edges.
PASSED_OVER = ("vertex",)

#: A file may be so large [bytes].
LARGEST_FILE = 256 * 2**20

#: A triangle with less area than this part of its longest side squared is refused; so are tetrahedra, volume and cube.
FLAT = 1e-12

#: Edges of elements by the kinds' names in meshio, as corners of the element.
EDGES: Mapping[str, list[tuple[int, int]]] = {
    "line": [(0, 1)],
    "triangle": [(0, 1), (1, 2), (2, 0)],
    "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "pyramid": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "hexahedron": [(i, (i + 1) % 4) for i in range(4)]
    + [(4 + i, 4 + (i + 1) % 4) for i in range(4)]
    + [(i, 4 + i) for i in range(4)],
}


@dataclass(frozen=True, eq=False)
class Mesh:
    """What a mesh file has.

    Attributes:
        positions: of the vertices in the file's order and its own unit of length, shape (n, 3).
        edges: the two vertices of each, from 0, shape (s, 2): each edge once, in the order of the elements.
        origins: how many of the edges are of which kind of element; what two have in common is the first one's.
        passed_over: how many elements join nothing.
    """

    positions: Array
    edges: IntArray
    origins: Mapping[str, int]
    passed_over: int = 0

    @property
    def told(self) -> str:
        """That in words."""
        parts = ", ".join(f"{count:,} of {kind}" for kind, count in self.origins.items() if count)
        points = f"; {self.passed_over:,} single points passed over" if self.passed_over else ""
        return f"{len(self.positions):,} masses, {len(self.edges):,} springs: {parts}{points}"


@dataclass(frozen=True, eq=False)
class _Block:
    """Elements of one kind that follow one another: corners (m, c), and the number of the first in the file, from 1."""

    kind: str
    corners: IntArray
    first: int

    @property
    def edges(self) -> list[tuple[int, int]]:
        c = self.corners.shape[1]
        return [(i, (i + 1) % c) for i in range(c)] if self.kind == "polygon" else EDGES[self.kind]


def read_mesh(path: Path, diagonals: bool = False) -> Mesh:
    """The mesh in a file.

    Args:
        diagonals: whether quadrilaterals have both of theirs, too.

    Raises:
        InputError: naming the file, the vertex or element (counted from 1) and what was expected.
    """
    try:
        return _mesh(path, diagonals)
    except InputError as error:
        raise InputError(f"mesh file {path}: {error}") from None


def _mesh(path: Path, diagonals: bool) -> Mesh:
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"expected a name that ends in {' or '.join(FORMATS)}")
    first_vertex = FORMATS[path.suffix.lower()]
    found = _read(path)
    positions, blocks = _positions(found.points, first_vertex), _blocks(found.cells)
    for block in blocks:
        _check(block, positions, first_vertex)
    edges, origins = _edges(blocks, diagonals)
    unused = np.setdiff1d(np.arange(len(positions)), edges)
    if len(unused):
        raise InputError(f"vertex {unused[0] + first_vertex} is in no element: expected every vertex to be in one")
    passed_over = sum(len(block.data) for block in found.cells if block.type in PASSED_OVER)
    return Mesh(positions, edges, origins, passed_over)


def _read(path: Path) -> Any:
    """What meshio makes of a file. Whatever it raises, it raises because of the file."""
    try:
        if not os.path.exists(path):
            raise InputError("no such file")
        check_file(path, LARGEST_FILE)
        with warnings.catch_warnings(), redirect_stderr(io.StringIO()) as said:
            # it warns, and goes on without, where there is less than announced or what it does not know
            warnings.simplefilter("error")
            readers = {".obj": _read_obj, ".vtk": _read_vtk}
            found = readers.get(path.suffix.lower(), _read_other)(path)
        if said.getvalue():
            raise ValueError(said.getvalue())
        return found
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"expected a mesh in the format {path.suffix.lower()}: {_reason(error)}") from None


def _read_obj(path: Path) -> Any:
    """Only of its vertices, faces and lines: where there are normals, meshio wants one for every vertex.

    Lines, and faces of two vertices, which some programs write springs as, it does not know: they are read here.
    """
    import meshio

    lines = [line.split() for line in path.read_text(encoding="utf-8-sig", errors="replace").splitlines()]
    faces = [words for words in lines if words[:1] == ["v"] or (words[:1] == ["f"] and len(words) != 3)]
    found = meshio.read(io.StringIO("\n".join(map(" ".join, faces))), file_format="obj")
    paths = [words[1:] for words in lines if words[:1] == ["l"] or (words[:1] == ["f"] and len(words) == 3)]
    pairs = [pair for path_ in paths for pair in _pairs(path_)]
    cells = [(block.type, block.data) for block in found.cells]
    return meshio.Mesh(found.points, [*cells, ("line", np.array(pairs))] if pairs else cells)


def _pairs(words: list[str]) -> list[tuple[int, int]]:
    """The vertices that a line joins, from 0: each is `vertex` or `vertex/texture`."""
    if len(words) < 2:
        raise InputError(f"line {' '.join(words)!r}: expected two vertices or more")
    try:
        corners = [int(word.partition("/")[0]) - 1 for word in words]
    except ValueError:
        raise InputError(f"line {' '.join(words)!r}: expected the numbers of its vertices") from None
    return list(pairwise(corners))


def _read_other(path: Path) -> Any:
    """By the ending of its name. Where meshio cannot, it prints why and ends the program: here that is an error."""
    import meshio

    content = path.read_bytes()
    check_counts(content)
    # without it meshio would look for it for ever
    if path.suffix.lower() == ".ply" and not re.search(rb"^end_header\s*?$", content, re.MULTILINE):
        raise InputError("expected a mesh in the format .ply: its header has no end")
    said = io.StringIO()
    try:
        with redirect_stdout(said):
            return meshio.read(path)
    except SystemExit:
        raise ValueError(said.getvalue()) from None


def _read_vtk(path: Path) -> Any:
    """Polydata, or a grid with elements: one without can be larger, by a few numbers, than any memory."""
    import meshio

    from reference.files.vtk_polydata import read_polydata

    content = path.read_bytes()
    for kind in re.findall(rb"^\s*DATASET\s+(\S*)", content, re.IGNORECASE | re.MULTILINE):
        if kind.upper() == b"POLYDATA":
            return read_polydata(content)
        if kind.upper() != b"UNSTRUCTURED_GRID":
            other = kind.decode(errors="replace")
            wanted = "UNSTRUCTURED_GRID or POLYDATA"
            raise InputError(f"DATASET {other!r}: expected {wanted}; ParaView can save it as such, or as .vtu")
    check_vtk_counts(content)
    return meshio.vtk.read(path)


def _reason(error: Exception) -> str:
    if "inhomogeneous" in str(error):
        return "lines of one kind have as many numbers as one another"
    # a reader may quote the file, which may have anything in it
    printable = "".join(c if c.isprintable() else " " for c in str(error))
    return " ".join(printable.split())[:200] or "what it announces is not what follows"


def _positions(points: Any, first_vertex: int) -> Array:
    positions = np.asarray(points, dtype=np.float64)
    if positions.size == 0:
        raise InputError("it has no vertices")
    if positions.ndim != 2 or positions.shape[1] < 2:
        raise InputError("expected two or three coordinates of every vertex")
    if positions.shape[1] == 2:
        positions = np.pad(positions, ((0, 0), (0, 1)))
    # what OBJ has beyond three is a colour
    positions = np.ascontiguousarray(positions[:, :3])
    bad = np.flatnonzero(~np.isfinite(positions).all(axis=1))
    if len(bad):
        where = positions[bad[0]].tolist()
        raise InputError(f"vertex {bad[0] + first_vertex} = {where}: expected finite numbers")
    return positions


def _whole(corners: npt.NDArray[Any]) -> bool:
    """Whether they are whole numbers; in a file of the next version they may be of any type."""
    return corners.dtype.kind != "f" or bool((np.isfinite(corners) & (corners == np.floor(corners))).all())


def _blocks(cells: Any) -> list[_Block]:
    blocks, first = [], 1
    for block in cells:
        if block.type in PASSED_OVER:
            continue
        corners = np.asarray(block.data)
        if block.type != "polygon" and block.type not in EDGES:
            known = ", ".join([*EDGES, "polygon"])
            raise InputError(f"element {first} is of the kind {block.type}: expected one of {known}")
        if corners.ndim != 2 or corners.size == 0 or not _whole(corners):
            raise InputError(f"element {first}: expected the numbers of its vertices")
        needed = 1 + max(max(pair) for pair in EDGES.get(block.type, [(-1, -1)]))
        if corners.shape[1] < needed:
            raise InputError(f"element {first}: expected {needed} vertices of a {block.type}, not {corners.shape[1]}")
        blocks.append(_Block(block.type, corners, first))
        first += len(corners)
    if first == 1:
        raise InputError("it has no elements: expected at least one, as their edges are the springs")
    return blocks


def _check(block: _Block, positions: Array, first_vertex: int) -> None:
    """Refuse the first element with a corner out of range, a corner twice, too few of them, or without extent."""
    corners, n = block.corners, len(positions)
    if block.kind == "polygon" and corners.shape[1] < 3:
        raise InputError(f"element {block.first}: expected three vertices or more, not {corners.shape[1]}")
    outside = (corners < 0) | (corners >= n)
    if outside.any():
        i, j = np.argwhere(outside)[0]
        last = n - 1 + first_vertex
        raise InputError(
            f"element {block.first + i} names vertex {int(corners[i, j]) + first_vertex}: "
            f"expected one from {first_vertex} to {last}"
        )
    in_order = np.sort(corners, axis=1)
    twice = in_order[:, 1:] == in_order[:, :-1]
    if twice.any():
        i, j = np.argwhere(twice)[0]
        raise InputError(f"element {block.first + i} names vertex {in_order[i, j] + first_vertex} twice")
    _check_extent(block, positions, first_vertex)


def _check_extent(block: _Block, positions: Array, first_vertex: int) -> None:
    corners = block.corners.astype(np.int64)
    pairs = corners[:, block.edges]
    with np.errstate(over="ignore"):
        lengths = np.linalg.norm(positions[pairs[:, :, 1]] - positions[pairs[:, :, 0]], axis=2)
    if not np.isfinite(lengths).all():
        raise InputError("expected coordinates whose distances are finite")
    if (lengths == 0).any():
        i, j = np.argwhere(lengths == 0)[0]
        a, b = pairs[i, j] + first_vertex
        raise InputError(f"element {block.first + i}: vertices {a} and {b} are in one place, expected a length > 0")
    if block.kind not in ("triangle", "tetra"):
        return
    # in the longest edge's unit: no product is too large or too small
    sides = (positions[corners[:, 1:]] - positions[corners[:, :1]]) / lengths.max(axis=1)[:, None, None]
    across = np.cross(sides[:, 0], sides[:, 1])
    what = "area" if block.kind == "triangle" else "volume"
    extent = np.linalg.norm(across, axis=1) if what == "area" else np.abs((across * sides[:, -1]).sum(axis=1))
    if (extent <= FLAT).any():
        raise InputError(
            f"element {block.first + np.argmax(extent <= FLAT)} is flat: expected a {block.kind} with {what}"
        )


def _edges(blocks: list[_Block], diagonals: bool) -> tuple[IntArray, dict[str, int]]:
    """Each edge once, and how many there are by kind of element."""
    parts = [(block.kind, block.corners[:, block.edges]) for block in blocks]
    if diagonals:
        parts += [("quad diagonals", b.corners[:, [(0, 2), (1, 3)]]) for b in blocks if b.kind == "quad"]
    pairs = np.concatenate([corners.reshape(-1, 2).astype(np.int64) for _, corners in parts])
    kinds = np.repeat([kind for kind, _ in parts], [corners.shape[0] * corners.shape[1] for _, corners in parts])
    pairs.sort(axis=1)
    _, first = np.unique(pairs, axis=0, return_index=True)
    first.sort()
    names = list(dict.fromkeys(kind for kind, _ in parts))
    return pairs[first], {name: int((kinds[first] == name).sum()) for name in names}
