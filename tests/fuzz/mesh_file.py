"""Mesh files: OBJ and VTK with numbers, counts and kinds that nobody means, or sound files damaged."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import meshio
import numpy as np

from reference.errors import InputError
from reference.files.mesh_file import read_mesh
from tests.fuzz import wild
from tests.fuzz.doors import Enter
from tests.reference.files.mesh_files import BINARY_BLOCK, BLANKET, BLOCK, NEXT_BLOCK

SOUND: list[tuple[str, str | bytes]] = [
    (".obj", BLANKET),
    (".vtk", BLOCK),
    (".vtk", NEXT_BLOCK),
    (".vtk", BINARY_BLOCK),
]

#: Formats that meshio reads as they are.
OTHERS = (".vtu", ".msh", ".mesh", ".ply")


def make(random: Random) -> tuple[str, bytes]:
    """A file's ending, and what is in it."""
    kind = random.randrange(5)
    if kind >= 3:
        ending = wild.one_of(random, OTHERS)
        return ending, _other(random, written(ending))
    if kind == 0:
        ending, content = wild.one_of(random, SOUND)
        return ending, wild.damaged(random, content if isinstance(content, bytes) else content.encode())
    lines = _obj(random) if kind == 1 else _vtk(random)
    return ".obj" if kind == 1 else ".vtk", "\n".join(lines).encode(errors="surrogatepass")


def _other(random: Random, content: bytes) -> bytes:
    """A file of another format, some of its bytes others; or one of its numbers, as often as not one of its counts."""
    if random.random() < 0.4:
        return wild.damaged(random, content)
    numbers = [*re.finditer(rb"(?<![\w.])\d+(?![\w.])", content)]
    found = wild.one_of(random, numbers[: random.choice((8, 40, len(numbers)))])
    number = random.choice((b"0", b"-1", b"7", b"1000000", b"10000000000", b"9223372036854775808", b"nan", b"1e308"))
    return content[: found.start()] + number + content[found.end() :]


@cache
def written(ending: str) -> bytes:
    """The block of two tetrahedra, as meshio writes it; of surfaces two triangles."""
    kind = "triangle" if ending == ".ply" else "tetra"
    corners = [[0, 1, 2], [1, 2, 3]] if ending == ".ply" else [[0, 1, 2, 3], [1, 2, 3, 4]]
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]][: 4 if ending == ".ply" else 5]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"block{ending}"
        options = {
            ".msh": {"file_format": "gmsh", "binary": False},
            ".ply": {"binary": False},
            ".vtu": {"binary": False},
        }
        meshio.Mesh(np.array(points, dtype=float), [(kind, np.array(corners))]).write(file, **options.get(ending, {}))
        return file.read_bytes()


def _obj(random: Random) -> Iterator[str]:
    n, beside = random.choice((0, 2, 3, 4, 4, 5, 6)), random.choice(("", "", "", "/1", "//1", "/1/1", "/", "x"))
    for _ in range(n):
        count = 3 if random.random() < 0.98 else random.choice((2, 6))
        yield " ".join(["v", *(_coordinate(random) for _ in range(count))])
    corners = random.choice((3, 3, 3, 4, 5))
    for _ in range(random.randint(1, 4)):
        count = corners if random.random() < 0.97 else random.choice((1, 2, 3, 4))
        numbers = [*range(1, n + 1)]
        random.shuffle(numbers)
        kind = "f" if random.random() < 0.95 else random.choice(("l", "vt", "g"))
        yield " ".join([kind, *(f"{_corner(random, i, n)}{beside}" for i in numbers[:count])])
    if random.random() < 0.1:
        yield wild.text(random)


def _coordinate(random: Random) -> str:
    return repr(random.uniform(-1, 1)) if random.random() < 0.98 else wild.number_text(random)


def _corner(random: Random, index: int, n: int) -> int:
    return index if random.random() < 0.98 else random.choice((0, -1, n + 1, index + 1, 10**18, 10**30))


def _vtk(random: Random) -> Iterator[str]:
    n = 8
    yield wild.one_of(random, ["# vtk DataFile Version 3.0"] * 8 + ["# vtk DataFile Version 5.1", "# vtk"])
    yield wild.text(random).replace("\n", "") if random.random() < 0.2 else "a mesh"
    yield wild.one_of(random, ["ASCII"] * 8 + ["BINARY", "TEXT"])
    yield f"DATASET {wild.one_of(random, ['UNSTRUCTURED_GRID'] * 15 + ['STRUCTURED_POINTS', 'POLYDATA', ''])}"
    yield f"POINTS {_count(random, n)} {wild.one_of(random, ['float', 'double', 'int', 'vtkIdType', 'bit'])}"
    for _ in range(n):
        yield " ".join(_coordinate(random) for _ in range(3))
    kinds = [wild.one_of(random, [(3, 2), (5, 3), (9, 4), (10, 4), (12, 8), (7, 5)] * 3 + [(99, 3)]) for _ in range(3)]
    size = sum(corners + 1 for _, corners in kinds)
    yield f"CELLS {_count(random, len(kinds))} {_count(random, size)}"
    for _, corners in kinds:
        yield " ".join([str(_count(random, corners)), *(str(_count(random, i % n)) for i in range(corners))])
    yield f"CELL_TYPES {_count(random, len(kinds))}"
    for kind, _ in kinds:
        yield str(kind)


def _count(random: Random, right: int) -> int:
    """Mostly what it should be."""
    return right if random.random() < 0.985 else random.choice((0, -1, right + 1, 10**6, 10**10, 2**31, 2**63, 10**30))


@contextmanager
def opened(folder: Path) -> Iterator[Enter]:
    """Files are read."""

    def enter(made: Any) -> str:
        ending, content = made
        file = folder / f"mesh{ending}"
        file.write_bytes(content)
        try:
            read_mesh(file)
        except InputError as error:
            return "refused" if len(str(error).splitlines()) == 1 else f"more than a line: {error!r}"
        return "taken"

    yield enter
