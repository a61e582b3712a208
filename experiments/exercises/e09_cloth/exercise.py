"""The springs of a cloth (slides 18-22)."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question, mistake, mistakes
from reference.system import IntArray


def springs(
    rows: int,
    columns: int,
    *,
    along: str = "both",
    shear: str = "both",
    bend: str = "both",
    far: int = 2,
    numbering: str = "rows",
    first: int = 0,
    ends: str = "open",
    double: str = "",
    less: int = 0,
    begun: str = "everywhere",
) -> IntArray:
    """Pairs of masses: mass (r, c) has number r * columns + c.

    Args:
        begun: in which rows springs begin, downwards and to the right.
    """
    by_row, by_column = {"rows": (columns, 1), "columns": (1, rows), "too few": (rows, 1)}[numbering]
    number = first + np.add.outer(by_row * np.arange(rows), by_column * np.arange(columns))
    grid = number[: rows - less, : columns - less]
    pairs = []
    for dr, dc, kind in ((0, 1, along != "columns"), (1, 0, along != "rows")):
        within = (grid[:-1] if dc else grid[:, :-1]) if along == "not at the edge" else grid
        pairs += _offset(within, dr, dc) if kind else []
    pairs += _offset(grid, 1, 1) if shear in ("both", "falling", "falling, and one off") else []
    pairs += _offset(grid[:, ::-1], 1, 1) if shear in ("both", "rising") else []
    if shear == "falling, and one off":
        pairs += [(a, b - 2) for a, b in _offset(grid, 1, 1)]
    for dr, dc, kind in ((0, far, bend in ("both", "rows", "all")), (far, 0, bend in ("both", "columns", "all"))):
        pairs += _offset(grid, dr, dc) if kind else []
    pairs += _offset(grid, 2, 2) + _offset(grid[:, ::-1], 2, 2) if bend in ("aslant", "all") else []
    line = grid.ravel().tolist()
    over = {"next row": (1,), "bend to the next row": (2,), "both to the next row": (1, 2)}.get(ends, ())
    for skip in over:
        pairs += [
            (a, b) for i, (a, b) in enumerate(zip(line, line[skip:], strict=False)) if i % columns >= columns - skip
        ]
    if ends == "bend, where there is a next row":
        pairs += [(i, i + 2) for i in range((rows - 1) * columns) if i % columns >= columns - 2]
    if ends == "closed":
        pairs += [(int(row[-1]), int(row[0])) for row in grid]
    if begun != "everywhere":
        begins = {"first row": 1, "not in the last": rows - 1}[begun]
        pairs = [pair for pair in pairs if min(pair) < begins * columns]
    pairs += {"": [], "turned": [(b, a) for a, b in pairs], "itself": [(a, a) for a in line]}[double]
    return np.array(pairs)


def _offset(grid: IntArray, dr: int, dc: int) -> list[tuple[int, int]]:
    one, other = grid[: max(len(grid) - dr, 0), : max(grid.shape[1] - dc, 0)], grid[dr:, dc:]
    return list(zip(one.ravel().tolist(), other.ravel().tolist(), strict=True))


def counted(question: Question, pairs: Any) -> Any:
    """How many springs there are between any two masses: no matter in which order they are named.

    A number that no mass has counts as the one after the last.
    """
    if pairs.size == 0:
        pairs = np.zeros((0, 2), dtype=int)
    if pairs.ndim == 2 and pairs.shape[0] == 2 != pairs.shape[1]:
        pairs = pairs.T  # all first masses, then all second ones: the same pairs
    if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iuf":
        return pairs
    n = question.arguments[0] * question.arguments[1]
    valid = (pairs >= 0) & (pairs < n) & (pairs == np.round(pairs))
    ends = np.sort(np.where(valid, pairs, n).astype(int), axis=1)
    count = np.zeros((n + 1, n + 1), dtype=int)
    np.add.at(count, (ends[:, 0], ends[:, 1]), 1)
    return count


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """Cloths of different numbers of rows and columns: wide, tall and square, large ones, threads, a single mass."""
    sizes: tuple[tuple[int, int], ...] = ((2, 2), (3, 6), (7, 4), (1, 4)) if hidden else ((4, 5), (6, 3))
    sizes += ((9, 11), (12, 8), (5, 5), (2, 4), (4, 2), (1, 5), (6, 1), (1, 1))
    return [Question("springs", s, ("springs",), f"cloth of {s[0]} x {s[1]}", item="between mass") for s in sizes]


EXERCISE = Exercise(
    title="The springs of a cloth",
    minutes=45,
    goals="From a picture to indices: structural, shear and bend springs of a grid, edges and corners.",
    solutions={"springs": springs},
    questions=questions,
    canonical=counted,
    mistakes=[
        mistake(
            "no_shear", "There are no shear springs.", "What keeps a square from becoming a rhombus?", shear="none"
        ),
        mistake(
            "one_diagonal",
            "Your squares have one diagonal, the falling one.",
            "How many diagonals has a square?",
            shear="falling",
        ),
        mistake(
            "other_diagonal",
            "Your squares have one diagonal, the rising one.",
            "How many diagonals has a square?",
            shear="rising",
        ),
        mistake(
            "no_bend", "There are no bend springs.", "What keeps the cloth from folding along a line?", bend="none"
        ),
        mistake(
            "bend_along_rows_only",
            "Your bend springs go along rows only.",
            "The cloth can fold along both directions.",
            bend="rows",
        ),
        mistake(
            "bend_along_columns_only",
            "Your bend springs go along columns only.",
            "The cloth can fold along both directions.",
            bend="columns",
        ),
        mistake(
            "bend_aslant",
            "Your bend springs go along the diagonals.",
            "Which two masses does a bend spring join?",
            bend="aslant",
        ),
        mistake(
            "bend_aslant_too",
            "There are bend springs along the diagonals too.",
            "Along what do bend springs go?",
            bend="all",
        ),
        mistake(
            "diagonal_off_by_one",
            "Your second diagonal begins one column too far to the left: at the left edge it ends in another row.",
            "Which masses have a neighbour below on the left? The condition is not that of the one on the right.",
            shear="falling, and one off",
        ),
        mistake(
            "bend_too_far", "Your bend springs skip two masses.", "How many masses does a bend spring skip?", far=3
        ),
        mistake(
            "rows_only",
            "There are no structural springs along the columns.",
            "Which neighbours has a mass?",
            along="rows",
        ),
        mistake(
            "columns_only",
            "There are no structural springs along the rows.",
            "Which neighbours has a mass?",
            along="columns",
        ),
        mistake(
            "numbered_by_columns",
            "Your numbers run down the columns.",
            "Which number has mass (0, 1)?",
            numbering="columns",
        ),
        mistake(
            "rows_for_columns",
            "You count r * rows + c: several masses have one number.",
            "How many masses are before row 1?",
            numbering="too few",
        ),
        mistake("counted_from_one", "You count masses from 1.", "Which number has the first mass?", first=1),
        *mistakes(
            "joined_to_the_next_row",
            "The last mass of each row is joined to the first of the next.",
            "Which masses have no neighbour on the right?",
            {"ends": "next row"},
            {"ends": "both to the next row"},
        ),
        *mistakes(
            "bend_to_the_next_row",
            "The last two masses of each row have bend springs to the first two of the next.",
            "Which masses have no next but one on the right?",
            {"ends": "bend to the next row"},
            {"ends": "bend, where there is a next row"},
        ),
        mistake(
            "rows_are_rings",
            "The last mass of each row is joined to its first.",
            "What does % do at the edge?",
            ends="closed",
        ),
        mistake(
            "every_spring_twice",
            "Every spring is there twice, once from either end.",
            "How many springs join two masses?",
            double="turned",
        ),
        mistake(
            "joined_to_itself",
            "Every mass is also joined to itself.",
            "Which offsets do your loops run over?",
            double="itself",
        ),
        mistake(
            "last_row_and_column_missing",
            "The last row and the last column have no springs.",
            "Up to which number do your loops run, and for which springs?",
            less=1,
        ),
        mistake(
            "no_structural_springs_at_the_edge",
            "Along the last row and the last column there are no structural springs.",
            "Which of your conditions belong to the neighbour on the right, and which to the one below?",
            along="not at the edge",
        ),
        mistake(
            "first_row_only",
            "Springs begin in the first row only.",
            "How far is your return indented? What ends a loop?",
            begun="first row",
        ),
        mistake(
            "last_row_skipped",
            "No spring begins in the last row.",
            "Up to which number does your loop over rows run? Has the last row no springs along it?",
            begun="not in the last",
        ),
    ],
)
