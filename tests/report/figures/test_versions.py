"""A table of what changed: a column for each version, a change marked and coloured where it happened."""

from __future__ import annotations

import pytest

from report.figures.versions import COLUMN, MARK, NAMES
from tests.experiments.canned.reading import records
from tests.report.figures.artists import words
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
