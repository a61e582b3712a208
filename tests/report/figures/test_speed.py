"""Ratios of times to tuned C: a row for each mesh, a look for each number of threads."""

from __future__ import annotations

import pytest

from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, legend, line, tick_labels, verticals, words
from tests.report.figures.shown import result, shown


def test_marks_are_the_ratios_of_the_table() -> None:
    """Of one thread and of two, in the row of their mesh; NumPy's, too."""
    axes = shown("speed").figure.axes[0]
    table = [row for row in records(result("speed")) if row["time / tuned C"] is not None]
    names = list(dict.fromkeys(row["what"] for row in table))
    assert [*tick_labels(axes.yaxis).values()] == names
    for threads, label in ((1, "1 thread"), (2, "2 threads")):
        rows = [row for row in table if row["threads"] == threads]
        found = line(axes, label)
        assert data(found) == ([row["time / tuned C"] for row in rows], [names.index(row["what"]) for row in rows])
        assert found.get_linestyle() == "None"
    handles = legend(axes)
    assert len({(handle.get_color(), handle.get_marker()) for handle in handles.values()}) == len(handles) == 2


def test_the_line_is_where_both_are_equally_fast() -> None:
    """At one, on a logarithm of time over time."""
    axes = shown("speed").figure.axes[0]
    assert verticals(axes) == [1]
    assert axes.get_xscale() == "log"
    assert axes.get_xlabel() == "time of our kernel / time of tuned C on one thread [1]"


def test_the_words_for_it_have_the_worst_on_one_thread() -> None:
    """NumPy's is the worst of all: a hundred times."""
    assert shown("speed").alt == "Ratios of times to tuned C for 5 meshes, on one thread at most 100.00."


@pytest.mark.filterwarnings("error")
def test_without_a_compiler_it_says_so() -> None:
    """No axes of nothing, no warning."""
    picture = shown("speed", "no compiler")
    assert words(picture.figure.axes[0]) == ["no ratios: there is no C compiler here"]
    assert not picture.figure.axes[0].axison
