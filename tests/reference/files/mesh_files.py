"""Mesh files to read: a blanket of triangles, a block of tetrahedra, in every form that is read."""

from __future__ import annotations

import struct

#: Four vertices, two triangles: five edges. What a line has after its vertices' numbers is not used.
BLANKET = """\
# a blanket
v 0 0 0
v 3 0 0
v 0 4 0
v 3 4 0
vn 0 0 1
g one
f 1 2 3
g two
f 2/1/1 4/2/1 3/3/1
"""

HEADER = "# vtk DataFile Version {}\na block\n{}\nDATASET UNSTRUCTURED_GRID\n"

#: Five vertices, two tetrahedra: nine edges.
BLOCK = (
    HEADER.format("4.2", "ASCII")
    + """\
POINTS 5 double
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 2 10
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 2
10
10
"""
)

#: The same in the file format's next version.
NEXT_BLOCK = (
    HEADER.format("5.1", "ASCII")
    + """\
POINTS 5 double
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1
CELLS 3 8
OFFSETS vtktypeint64
0 4 8
CONNECTIVITY vtktypeint64
0 1 2 3 1 2 3 4
CELL_TYPES 2
10
10
"""
)

#: The same in binary.
BINARY_BLOCK = b"".join(
    [
        HEADER.format("4.2", "BINARY").encode(),
        b"POINTS 5 double\n",
        struct.pack(">15d", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1),
        b"\nCELLS 2 10\n",
        struct.pack(">10i", 4, 0, 1, 2, 3, 4, 1, 2, 3, 4),
        b"\nCELL_TYPES 2\n",
        struct.pack(">2i", 10, 10),
        b"\n",
    ]
)

BLOCK_EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (1, 4), (2, 3), (2, 4), (3, 4)]


def block(kind: int, corners: int) -> str:
    """A VTK file with one element of that kind, its corners on a curve no four of whose points are in a plane."""
    points = "\n".join(f"{t} {t * t} {t**3}" for t in range(corners))
    numbers = " ".join(map(str, range(corners)))
    return (
        HEADER.format("4.2", "ASCII")
        + f"POINTS {corners} double\n{points}\nCELLS 1 {corners + 1}\n{corners} {numbers}\nCELL_TYPES 1\n{kind}\n"
    )
