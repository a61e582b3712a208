"""A table of what changed: a column for each version, a change marked and coloured where it happened."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from report.figures.versions import COLUMN, MARK, NAMES
from tests.experiments.canned.reading import records
from tests.report.figures.artists import horizontals, words
from tests.report.figures.shown import result, shown


def test_cells_are_the_table_in_the_columns_of_their_versions() -> None:
    """A number to seven figures, a word as it is; what was not asked is said."""
    axes = shown("versions").figure.axes[0]
    versions = ["1.9.0", "1.10.0", "2.0.0"]
    by_column = {
        version: [
            t.get_text().removeprefix(MARK)
            for t in axes.texts
            if t.get_position()[0] == pytest.approx(NAMES + COLUMN * i + 0.08)
        ]
        for i, version in enumerate(versions)
    }
    heads = [t for t in axes.texts if t.get_text() in (*versions, "spring")]
    assert {t.get_position()[1] for t in heads} == {1}
    assert {t.get_fontweight() for t in heads} == {"bold"}
    for version in versions:
        cells = [row[version] for row in records(result("versions"))]
        expected = ["not asked" if c is None else f"{c:.7g}" if isinstance(c, float) else c for c in cells]
        assert by_column[version] == [version, *expected]


def test_what_changed_is_marked_and_coloured() -> None:
    """In the version that changed it: limit and crash in the second, the engine in the third."""
    axes = shown("versions").figure.axes[0]
    marked = [t for t in axes.texts if t.get_text().startswith(MARK)]
    assert [t.get_text() for t in marked] == [f"{MARK}unsupported: it is gone", f"{MARK}0.011", f"{MARK}fine"]
    assert {t.get_fontweight() for t in marked} == {"bold"}
    for cell, box in zip(marked, axes.patches, strict=True):
        (x, y), width, height = box.get_xy(), box.get_width(), box.get_height()
        assert x < cell.get_position()[0] < x + width
        assert y < cell.get_position()[1] < y + height


def test_the_package_is_named_and_rows_are_engine_and_measure() -> None:
    """At the left."""
    said = words(shown("versions").figure.axes[0])
    assert said[0] == "spring"
    assert "springs\nlargest stable dt [s], undamped" in said


def test_every_row_is_between_its_lines() -> None:
    """Words in the middle of their height, each beside the left border of its column; a coloured cell fills it."""
    axes = shown("versions").figure.axes[0]
    borders = [*horizontals(axes), axes.get_ylim()[0]]
    table = records(result("versions"))
    assert len(borders) == len(table) + 1
    columns = [0.0, *(NAMES + COLUMN * i for i in range(3)), NAMES + 3 * COLUMN]
    assert axes.get_xlim() == (0, pytest.approx(columns[-1]))
    cells = [t for t in axes.texts if t.get_position()[1] > borders[0]]
    assert len(cells) == 4 * len(table)
    heights = []
    for i, (top, bottom) in enumerate(pairwise(borders)):
        row = cells[4 * i : 4 * i + 4]
        (middle,) = {t.get_position()[1] for t in row}
        heights.append(2 * (middle - top))
        assert top < middle < bottom
        assert [t.get_position()[0] for t in row] == sorted(t.get_position()[0] for t in row)
        for cell, left in zip(row, columns, strict=False):
            assert left < cell.get_position()[0] < left + 0.1
        lines_of_text = max(t.get_text().count("\n") + 1 for t in row)
        assert lines_of_text + 0.5 < heights[-1] < lines_of_text + 1
    assert np.diff(borders[:-1]) == pytest.approx(heights[:-1])
    assert 1 < borders[0] <= 2 < axes.get_ylim()[0] - sum(heights)
    assert axes.get_ylim()[1] == 0
    for box in axes.patches:
        (x, y), width, height = box.get_xy(), box.get_width(), box.get_height()
        assert (y, height) in [(top, pytest.approx(high)) for top, high in zip(borders, heights, strict=False)]
        (column,) = [left for left in columns if left == pytest.approx(x)]
        assert 0.9 * COLUMN < width < COLUMN
        assert column >= NAMES
    inches = shown("versions").figure.get_size_inches()
    assert inches[0] == pytest.approx(columns[-1])
    assert 0.15 < inches[1] / axes.get_ylim()[0] < 0.25  # of a line of words
