"""VTK's older format with a DATASET POLYDATA, which meshio does not read: points, lines and polygons.

A file is lines of text and, after each line that announces some, numbers: as text, or in binary with the highest byte
first. Cells are [count, corners...] up to version 4.2, and from 5.1 on OFFSETS and CONNECTIVITY. (VTK File Formats,
Kitware, "Simple Legacy Formats".)
"""

from __future__ import annotations

import re
from itertools import groupby, pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError

#: NumPy's names of VTK's types.
TYPES = {
    "float": "f4",
    "double": "f8",
    "int": "i4",
    "long": "i8",
    "vtktypeint32": "i4",
    "vtktypeint64": "i8",
    "vtkidtype": "i8",
}

#: What ends the geometry, and what has no springs.
ENDS, PASSED_OVER = (b"POINT_DATA", b"CELL_DATA"), b"VERTICES"


class _File:
    """A file's bytes, and `at`: how far they are read."""

    def __init__(self, content: bytes) -> None:
        self._content, self.at = content, 0
        header = [self.line() for _ in range(3)]
        self._binary = header[2].strip().upper() == b"BINARY"

    def line(self) -> bytes:
        """The next line that is not empty; empty at the end."""
        while self.at < len(self._content):
            end = self._content.find(b"\n", self.at)
            end = len(self._content) if end < 0 else end
            found, self.at = self._content[self.at : end].strip(), end + 1
            if found:
                return found
        return b""

    def numbers(self, count: int, kind: str) -> npt.NDArray[Any]:
        """The next so many numbers. Raises InputError where there are fewer, or of an unknown type."""
        if kind.lower() not in TYPES:
            raise InputError(f"numbers of type {kind!r}: expected one of {', '.join(TYPES)}")
        dtype = np.dtype(f">{TYPES[kind.lower()]}")
        if not 0 <= count <= len(self._content):
            raise InputError(f"{count:,} numbers are announced, and there are not as many")
        if self._binary:
            taken = self._content[self.at : self.at + count * dtype.itemsize]
            self.at += len(taken)
            found = np.frombuffer(taken[: len(taken) // dtype.itemsize * dtype.itemsize], dtype)
        else:
            words = re.compile(rb"\S+").finditer(self._content, self.at)
            taken_words = [word for word, _ in zip(words, range(count), strict=False)]
            self.at = taken_words[-1].end() if taken_words else self.at
            found = np.array([word.group() for word in taken_words]).astype(dtype)
        if len(found) < count:
            raise InputError(f"{count:,} numbers are announced, and there are {len(found):,}")
        return found.astype(dtype.newbyteorder("="))


def read_polydata(content: bytes) -> Any:
    """The mesh in a file: lines as pairs, polygons by their number of corners, in their order.

    Raises:
        InputError: for what is announced and not there, and for triangle strips.
    """
    import meshio

    file = _File(content)
    points: npt.NDArray[Any] = np.zeros((0, 3))
    cells: list[tuple[str, npt.NDArray[Any]]] = []
    while (line := file.line()) and not line.upper().startswith(ENDS):
        words = line.split()
        name = words[0].upper()
        if name == b"POINTS":
            points = file.numbers(3 * _count(words, 1), words[2].decode(errors="replace")).reshape(-1, 3)
        elif name in (b"LINES", b"POLYGONS", PASSED_OVER):
            found = _cells(file, _count(words, 1), _count(words, 2))
            cells += _elements(name, found)
        elif name == b"TRIANGLE_STRIPS":
            raise InputError("TRIANGLE_STRIPS: expected LINES and POLYGONS; ParaView can save triangles as such")
    return meshio.Mesh(points, cells)


def _count(words: list[bytes], which: int) -> int:
    try:
        return int(words[which])
    except (IndexError, ValueError):
        said = b" ".join(words).decode(errors="replace")
        raise InputError(f"line {said!r}: expected numbers of what follows") from None


def _cells(file: _File, first: int, second: int) -> list[npt.NDArray[Any]]:
    """The corners of cells, of either version."""
    start = file.at
    words = file.line().split()
    if words[:1] == [b"OFFSETS"]:
        offsets = file.numbers(first, words[1].decode(errors="replace"))
        kind = file.line().split()[-1:]
        corners = file.numbers(second, kind[0].decode(errors="replace") if kind else "")
        if len(offsets) == 0 or (np.diff(offsets) < 0).any() or offsets[0] != 0 or offsets[-1] > second:
            raise InputError("OFFSETS: expected numbers that rise from 0 to how many corners there are")
        return [corners[a:b] for a, b in pairwise(offsets.tolist())]
    file.at = start
    numbers, found, at = file.numbers(second, "int"), [], 0
    for _ in range(first):
        if at >= len(numbers) or not 0 <= int(numbers[at]) < len(numbers) - at:
            raise InputError("cells: expected for each its number of corners, and these")
        found.append(numbers[at + 1 : at + 1 + int(numbers[at])])
        at += 1 + int(numbers[at])
    return found


def _elements(name: bytes, cells: list[npt.NDArray[Any]]) -> list[tuple[str, npt.NDArray[Any]]]:
    """As meshio has them: those of one kind that follow one another together."""
    if name == PASSED_OVER:
        return [("vertex", np.concatenate(cells)[:, None])] if cells else []
    if name == b"LINES":
        pairs = [pair for cell in cells for pair in pairwise(cell.tolist())]
        return [("line", np.array(pairs))] if pairs else []
    kinds = {3: "triangle", 4: "quad"}
    return [(kinds.get(n, "polygon"), np.stack(list(some))) for n, some in groupby(cells, len) if n]
