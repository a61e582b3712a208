"""Long lists, checked in parts: another one every day; and which files come first."""

from __future__ import annotations

from datetime import date

#: All parts come round in less than two weeks. No multiple of 3, as students' mistakes are there in three styles.
PARTS = 13

#: The files that take longest: begun last, they would have one process at work and the others with nothing to do.
LONGEST = (
    "tests/test_project.py",
    "tests/report/live/test_live_page.py",
    "tests/report/browser/test_lab_page.py",
    "tests/test_wheel.py",
    "tests/soak/test_cluster.py",
    "tests/experiments/engine_versions/test_versions.py",
    "tests/experiments/exercises/test_grading.py",
    "tests/test_recipes.py",
)


def todays() -> int:
    """The number of today's part."""
    return date.today().toordinal() % PARTS


def kept(index: int, every: int, number: int) -> bool:
    """Whether a case of a test that runs every n-th of its cases is in a part; one after the other comes round."""
    return index % every == number % every


def part(number: int) -> slice:
    """A part of a list, by its number."""
    return slice(number, None, PARTS)
