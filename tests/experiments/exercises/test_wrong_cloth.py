"""Springs of a cloth, right ones and wrong ones, counted by who is joined to whom."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest

from experiments.exercises.e09_cloth.exercise import counted
from experiments.exercises.exercise import Question, find

CLOTH = find("cloth")
ROWS, COLUMNS = 4, 5

#: Row and column.
Place = tuple[int, int]
Pairs = Counter[tuple[int, int]]

ALONG, DOWN, FALLING, RISING = (0, 1), (1, 0), (1, 1), (1, -1)
BEND = ((0, 2), (2, 0))
ALL = (ALONG, DOWN, FALLING, RISING, *BEND)


def number(place: Place) -> int:
    """As the text counts."""
    return place[0] * COLUMNS + place[1]


def joined(
    offsets: Iterable[Place], begins: Callable[[Place], bool] = lambda place: True, of: Callable[[Place], int] = number
) -> Pairs:
    """Every mass with those at these offsets that there are."""
    places = [(r, c) for r in range(ROWS) for c in range(COLUMNS)]
    pairs: Pairs = Counter()
    for r, c in places:
        for dr, dc in offsets:
            if (r + dr, c + dc) in places and begins((r, c)):
                pairs[tuple(sorted((of((r, c)), of((r + dr, c + dc)))))] += 1  # type: ignore[index]
    return pairs


RIGHT = joined(ALL)


def without(*offsets: Place) -> Pairs:
    """All but these."""
    return joined([offset for offset in ALL if offset not in offsets])


def ends(skip: int, rows: int = ROWS - 1) -> Pairs:
    """The last masses of each row, each with the one so many numbers on, in the next row."""
    pairs = [(r * COLUMNS + COLUMNS - 1 - i, skip) for r in range(rows) for i in range(skip)]
    return Counter((a, a + by) for a, by in pairs)


#: In place of a row's right neighbour below on the left, one two columns off: at its left edge that is in another row.
ONE_OFF = Counter((r * COLUMNS + c, (r + 1) * COLUMNS + c + 1 - 2) for r in range(ROWS - 1) for c in range(COLUMNS - 1))

WRONG: dict[str, tuple[dict[str, Any], Pairs]] = {
    "right": ({}, RIGHT),
    "no shear": ({"shear": "none"}, without(FALLING, RISING)),
    "falling": ({"shear": "falling"}, without(RISING)),
    "rising": ({"shear": "rising"}, without(FALLING)),
    "one off": ({"shear": "falling, and one off"}, without(RISING) + ONE_OFF),
    "no bend": ({"bend": "none"}, without(*BEND)),
    "bend rows": ({"bend": "rows"}, without((2, 0))),
    "bend columns": ({"bend": "columns"}, without((0, 2))),
    "aslant": ({"bend": "aslant"}, without(*BEND) + joined([(2, 2), (2, -2)])),
    "aslant too": ({"bend": "all"}, RIGHT + joined([(2, 2), (2, -2)])),
    "too far": ({"far": 3}, without(*BEND) + joined([(0, 3), (3, 0)])),
    "rows only": ({"along": "rows"}, without(DOWN)),
    "columns only": ({"along": "columns"}, without(ALONG)),
    "not at the edge": (
        {"along": "not at the edge"},
        without(ALONG, DOWN)
        + joined([ALONG], lambda place: place[0] < ROWS - 1)
        + joined([DOWN], lambda place: place[1] < COLUMNS - 1),
    ),
    "by columns": ({"numbering": "columns"}, joined(ALL, of=lambda place: place[1] * ROWS + place[0])),
    "too few": ({"numbering": "too few"}, joined(ALL, of=lambda place: place[0] * ROWS + place[1])),
    "from one": ({"first": 1}, joined(ALL, of=lambda place: number(place) + 1)),
    "next row": ({"ends": "next row"}, RIGHT + ends(1)),
    "bend to it": ({"ends": "bend to the next row"}, RIGHT + ends(2)),
    "bend to it, where it is": ({"ends": "bend, where there is a next row"}, RIGHT + ends(2)),
    "both": ({"ends": "both to the next row"}, RIGHT + ends(1) + ends(2)),
    "rings": ({"ends": "closed"}, RIGHT + Counter((r * COLUMNS, r * COLUMNS + COLUMNS - 1) for r in range(ROWS))),
    "twice": ({"double": "turned"}, RIGHT + RIGHT),
    "itself": ({"double": "itself"}, RIGHT + Counter((i, i) for i in range(ROWS * COLUMNS))),
    "last missing": (
        {"less": 1},
        Counter(
            {
                (a, b): n
                for (a, b), n in RIGHT.items()
                if all(i // COLUMNS < ROWS - 1 and i % COLUMNS < COLUMNS - 1 for i in (a, b))
            }
        ),
    ),
    "first row": ({"begun": "first row"}, joined(ALL, lambda place: place[0] == 0)),
    "not the last": ({"begun": "not in the last"}, joined(ALL, lambda place: place[0] < ROWS - 1)),
}


@pytest.mark.parametrize("name", WRONG)
def test_who_is_joined(name: str) -> None:
    """In a cloth of 4 x 5; also that every mistake of the exercise is among them."""
    wrong, wanted = WRONG[name]
    pairs = CLOTH.solutions["springs"](ROWS, COLUMNS, **wrong)
    assert Counter(tuple(sorted(pair)) for pair in pairs.tolist()) == wanted
    assert {tuple(m.parameters.items()) for m in CLOTH.mistakes} == {tuple(w.items()) for w, _ in WRONG.values() if w}


@pytest.mark.parametrize(
    ("rows", "columns", "count"),
    [(1, 1, 0), (1, 2, 1), (1, 5, 7), (5, 1, 7), (2, 2, 6), (3, 3, 26), (2, 4, 10 + 6 + 4)],
)
def test_how_many_springs_a_cloth_has(rows: int, columns: int, count: int) -> None:
    """By hand: with one row or column only, and of one mass none; their answers have two columns, or are empty."""
    pairs = CLOTH.solutions["springs"](rows, columns)
    assert len(pairs) == count
    counted = CLOTH.comparable(Question("springs", (rows, columns), ("springs",), ""), [[pairs]])[0][0]
    assert (counted.shape, counted.sum()) == ((rows * columns + 1, rows * columns + 1), count)


def compared(pairs: Any, rows: int = 2, columns: int = 2) -> Any:
    """In the form in which answers are compared."""
    question = Question("springs", (rows, columns), ("springs",), "")
    return CLOTH.comparable(question, [[np.asarray(pairs)]])[0][0]


def test_neither_order_nor_form_count() -> None:
    """Which mass comes first, which pair; pairs, or all first masses and all second ones; 1.0 for 1."""
    one = compared([[0, 1], [2, 1], [3, 2]])
    assert {tuple(place) for place in np.argwhere(one).tolist()} == {(0, 1), (1, 2), (2, 3)}
    for same in ([[3, 2], [0, 1], [1, 2]], [[0, 2, 3], [1, 1, 2]], [[0.0, 1.0], [2.0, 1.0], [3.0, 2.0]]):
        assert compared(same).tolist() == one.tolist()
    # two pairs, and no pairs of two
    assert {tuple(place) for place in np.argwhere(compared([[0, 1], [2, 3]])).tolist()} == {(0, 1), (2, 3)}
    assert compared([[0, 1], [1, 0], [0, 1]])[0, 1] == 3
    assert compared(np.zeros((0, 2), int)).shape == compared([]).shape == (5, 5)


def test_a_number_that_no_mass_has_counts_as_the_one_after_the_last() -> None:
    """Too large, less than nothing, or none of the whole ones; what are no pairs of numbers is left as it is."""
    for wrong in (4, 7, -1, 1.5):
        assert np.argwhere(compared([[0, wrong]])).tolist() == [[0, 4]]
    assert np.argwhere(compared([[0, 3]])).tolist() == [[0, 3]]
    for odd in ([[0, 1, 2]], [0, 1], [["a", "b"]], [[0, 1, 2], [0, 1, 2], [3, 4, 5]], [[[0, 1]]]):
        assert compared(odd).tolist() == np.asarray(odd).tolist()


@pytest.mark.parametrize("hidden", [False, True])
def test_cloths_are_wide_tall_square_and_threads(hidden: bool) -> None:
    """And a single mass; what is asked hidden is not what is asked before."""
    asked = [q.arguments for q in CLOTH.questions(np.random.default_rng(0), hidden, "ada")]
    kinds = {
        "wide": lambda r, c: 1 < r < c,
        "tall": lambda r, c: 1 < c < r,
        "square": lambda r, c: 1 < r == c,
        "row": lambda r, c: r == 1 < c,
        "column": lambda r, c: c == 1 < r,
        "mass": lambda r, c: r == c == 1,
    }
    for name, is_kind in kinds.items():
        assert any(is_kind(*size) for size in asked), name
    assert len(asked) == (12 if hidden else 10)
    assert {q.about for q in CLOTH.questions(np.random.default_rng(0), hidden, "")} == {
        f"cloth of {r} x {c}" for r, c in asked
    }


def test_numbers_that_no_mass_has_count_as_the_one_after_the_last() -> None:
    """Of 4 rows and 5 columns: 20 masses, whichever way round; -1, 20 and 2.5 are none."""
    question = Question("springs", (ROWS, COLUMNS), ("springs",), "", item="")
    count = counted(question, np.array([[19.0, 0.0], [20.0, 3.0], [-1.0, 4.0], [2.5, 5.0]]))
    assert count.shape == (21, 21)
    assert [(int(a), int(b)) for a, b in np.argwhere(count)] == [(0, 19), (3, 20), (4, 20), (5, 20)]
