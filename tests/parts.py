"""Long lists, checked in parts: another one every day; and which files come first."""

from __future__ import annotations

from collections import Counter
from datetime import date
from zlib import crc32

#: All parts come round in less than two weeks. No multiple of 3, as students' mistakes are there in three styles.
PARTS = 13

#: The files that take longest: begun last, they would have one process at work and the others with nothing to do.
LONGEST = (
    "tests/test_project.py",
    "tests/report/live/test_live_page.py",
    "tests/report/browser/test_lab_page.py",
    "tests/report/page/test_browser.py",
    "tests/test_wheel.py",
    "tests/soak/test_cluster.py",
    "tests/experiments/engine_versions/test_versions.py",
    "tests/experiments/exercises/c/test_c.py",
    "tests/experiments/exercises/c/test_search.py",
    "tests/experiments/exercises/process/test_hostile.py",
    "tests/experiments/exercises/teaching/test_pages.py",
    "tests/experiments/exercises/test_blind.py",
    "tests/report/browser/test_bits.py",
    "tests/report/site/test_site.py",
    "tests/test_recipes.py",
)


def todays() -> int:
    """The number of today's part."""
    return date.today().toordinal() % PARTS


def kept(index: int, every: int, number: int) -> bool:
    """Whether a case of a test that runs every n-th of its cases is in a part; one after the other comes round."""
    return index % every == number % every


class Turns:
    """Which cases of tests that are marked `rotating` are kept in a part.

    All tests of a file begin with the same day: what they share is made on that day only, and files have other days.
    Those that take turns are counted together: every day has some of them.
    """

    def __init__(self, number: int) -> None:
        self._number = number
        self._seen: Counter[str] = Counter()

    def keep(self, case: str, every: int, in_turn: bool) -> bool:
        """Whether a case, the next one of its test, is kept. Args: case: as pytest names it."""
        test = case.partition("[")[0]
        file = test.partition("::")[0]
        counted = file if in_turn else test
        self._seen[counted] += 1
        return kept(crc32(file.encode()) + self._seen[counted] - 1, every, self._number)


def part(number: int) -> slice:
    """A part of a list, by its number."""
    return slice(number, None, PARTS)
