"""Counts in a VTK file: none can be larger than the file; what reads it believes them, and makes room at once."""

from __future__ import annotations

import re
import warnings

import numpy as np

from reference.errors import InputError
from reference.state import Array

#: Lines that announce how much follows: by a keyword; of a field, by its name, two counts and a type.
KEYWORDS = b"POINTS|CELLS|CELL_TYPES|POINT_DATA|CELL_DATA|SCALARS|VECTORS|NORMALS|TENSORS|FIELD|METADATA|LOOKUP_TABLE"
TYPES = rb"float|double|int|long|bit|char|short|unsigned_\w+"
ANNOUNCED = re.compile(
    rb"^[ \t]*(%b)[ \t]([^\n]*)|^[ \t]*\S+[ \t]+(\d+[ \t]+\d+)[ \t]+(?:%b)[ \t]*\r?$" % (KEYWORDS, TYPES),
    re.IGNORECASE | re.MULTILINE,
)

#: The elements: for each the number of its corners, then these.
CELLS = re.compile(rb"^[ \t]*CELLS[ \t]+(\d+)[ \t]+(\d+)[^\n]*\n", re.IGNORECASE | re.MULTILINE)
BINARY = re.compile(rb"[^\n]*\n[^\n]*\n\s*BINARY", re.IGNORECASE)

#: In files from version 5 on: where each element begins, then all corners, each of eight bytes in a binary file.
OFFSETS = re.compile(rb"\s*OFFSETS[ \t]+\w+[ \t]*\n", re.IGNORECASE)
CONNECTIVITY = re.compile(rb"\n?CONNECTIVITY[ \t]+\w+[ \t]*\n", re.IGNORECASE)


#: In the other formats, what announces how much follows: of PLY, Gmsh, Medit and VTU.
OTHERS = re.compile(
    rb"^element[ \t]+\w+[ \t]+(\d+)|^\$\w+\s+(\d+(?:[ \t]+\d+)?)|^[ \t]*[A-Z][A-Za-z]+\s+(\d+)[ \t]*\r?$"
    rb"|NumberOf\w+=[\"'](\d+)",
    re.MULTILINE,
)


def check_counts(content: bytes) -> None:
    """Refuse a file of another format that announces more than it can hold. Raises InputError."""
    for found in OTHERS.finditer(content):
        numbers = [int(digits) for group in found.groups() if group for digits in group.split()]
        if any(number > len(content) for number in numbers):
            raise InputError(f"it announces {max(numbers):,} numbers: expected at most {len(content):,}, its bytes")


def check_vtk_counts(content: bytes) -> None:
    """Refuse a file that announces more than it can hold, or elements of more corners. Raises InputError."""
    for line in ANNOUNCED.finditer(content):
        numbers = [int(digits) for digits in re.findall(rb"\d+", line[2] or line[3] or b"")]
        if any(number > len(content) for number in numbers):
            what = (line[1] or b"a field").decode()
            raise InputError(f"{what} announces {max(numbers):,} numbers: expected at most {len(content):,}, its bytes")
    corners = _corners(content)
    if corners.size and corners.max() > len(content):
        raise InputError(f"CELLS has the number {corners.max():.0f}: expected at most {len(content):,}, its bytes")


def _corners(content: bytes) -> Array:
    """The numbers of CELLS, as far as they can be read."""
    line = CELLS.search(content)
    if line is None:
        return np.zeros(0)
    after = content[line.end() :]
    if BINARY.match(content):
        offsets, corners = OFFSETS.match(after), CONNECTIVITY.search(after)
        if offsets and corners:
            begins = _whole(after[offsets.end() :], ">i8", int(line[1]))
            return np.concatenate([begins, _whole(after[corners.end() :], ">i8", int(line[2]))])
        return _whole(after, ">i4", int(line[2]))
    text = re.match(rb"[^A-Za-z]*", after)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what is no number is said by who reads it
        return np.fromstring((text[0] if text else b"").decode("latin-1"), sep=" ")


def _whole(content: bytes, kind: str, count: int) -> Array:
    """So many whole numbers, or as many as there are."""
    size = np.dtype(kind).itemsize
    return np.frombuffer(content[: len(content) // size * size], kind, min(count, len(content) // size)).astype(float)
