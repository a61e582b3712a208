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


def check_vtk_counts(content: bytes) -> None:
    """Refuse a file that announces more than it can hold, or elements of more corners. Raises InputError."""
    for line in ANNOUNCED.finditer(content):
        numbers = [int(digits) for digits in re.findall(rb"\d+", line[2] or line[3] or b"")]
        if max(numbers, default=0) > len(content):
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
        return np.frombuffer(after[: len(after) // 4 * 4], ">i4", count=min(int(line[2]), len(after) // 4)).astype(
            float
        )
    text = re.match(rb"[^A-Za-z]*", after)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what is no number is said by who reads it
        return np.fromstring((text[0] if text else b"").decode("latin-1"), sep=" ")
