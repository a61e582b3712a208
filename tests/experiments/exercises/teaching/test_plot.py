"""The small plots of answers beside the right ones: what is drawn where."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from experiments.exercises.teaching.plot import HEIGHT, WIDTH, as_png, in_terminal, magnified
from experiments.exercises.verdict.first_difference import Lines


def lines(right: list[float], given: list[float], over: str = "step") -> Lines:
    """Numbers to be drawn."""
    return Lines(over, "x [m]", np.array(right), np.array(given))


def marks(text: str) -> dict[tuple[int, int], str]:
    """By row from above and column, what is drawn in the terminal."""
    rows = text.splitlines()[1 : 1 + HEIGHT]
    assert all(row[11] == "|" for row in rows)
    return {(i, j): mark for i, row in enumerate(rows) for j, mark in enumerate(row[12:]) if mark != " "}


def test_in_the_terminal_the_largest_is_at_the_top_and_the_last_at_the_right() -> None:
    """Right ones go from 0 to 8, given ones stay at 0: at first both are in one place."""
    text = in_terminal(lines([0.0, 4.0, 8.0], [0.0, 0.0, 0.0]))
    bottom, right = HEIGHT - 1, WIDTH - 1
    middle = round(right / 2)
    assert marks(text) == {
        (bottom, 0): "*",
        (bottom // 2, middle): "o",
        (0, right): "o",
        (bottom, middle): "x",
        (bottom, right): "x",
    }
    first, *_, last = text.splitlines()
    assert first == "x [m]   o expected  x yours  * both"
    assert last.split() == ["1", "3", "step"]
    assert last.index("3") == 12 + right
    values = [text.splitlines()[i][:10].strip() for i in (1, HEIGHT)]
    assert values == ["8", "0"]
    assert in_terminal(lines([0.0, 8.0], [0.0, 0.0], "mass")).splitlines()[-1].split() == ["0", "1", "mass"]
    # what ends sooner has its places all the same, whichever it is
    assert marks(in_terminal(lines([0.0, 4.0, 8.0], [4.0]))) == {
        (bottom, 0): "o",
        (bottom // 2, 0): "x",
        (bottom // 2, middle): "o",
        (0, right): "o",
    }
    assert marks(in_terminal(lines([0.0, 8.0], [4.0, 4.0, 0.0]))) == {
        (bottom, 0): "o",
        (bottom // 2, 0): "x",
        (bottom // 2, middle): "x",
        (0, middle): "o",
        (bottom, right): "x",
    }


def test_what_is_no_number_or_far_off_is_not_drawn() -> None:
    """Ten times the range is far; what is less is drawn, in a larger range."""
    assert len(marks(in_terminal(lines([0.0, 4.0, 8.0], [0.0, np.nan, np.inf])))) == 3
    far = in_terminal(lines([0.0, 4.0, 8.0], [0.0, 100.0, 0.0]))
    assert far.splitlines()[1][:10].strip() == "8"
    near = in_terminal(lines([0.0, 4.0, 8.0], [0.0, 80.0, 0.0]))
    assert near.splitlines()[1][:10].strip() == "80"
    below = in_terminal(lines([0.0, 4.0, 8.0], [0.0, -70.0, 0.0]))
    assert below.splitlines()[HEIGHT][:10].strip() == "-70"


@pytest.mark.parametrize(
    ("right", "given", "low", "high"),
    [
        ([5.0, 5.0], [5.0, 5.0], -1e-12, 1e-12),
        ([0.0, 0.0], [0.0, 3.0], 0.0, 3.0),
        ([0.0], [3.0], 0.0, 3.0),
        ([5.0, 5.0], [5.0, 5.02], 5.0, 5.02),
        ([5.0, 5.0], [5.0, 5.1], 4.995, 5.005),
    ],
)
def test_where_all_right_numbers_are_one(right: list[float], given: list[float], low: float, high: float) -> None:
    """A thousandth of it counts as the range; of zeros all that was given is shown."""
    text = in_terminal(lines(right, given)).splitlines()
    assert (float(text[HEIGHT][:10]), float(text[1][:10])) == pytest.approx((low, high), rel=1e-2, abs=1e-13)


def test_what_lies_less_than_a_row_apart_is_magnified() -> None:
    """Then what is left is drawn, beside zeros, as far as both go; a row is an eighth of the range."""
    small = lines([0.0, 4.0, 8.0, 8.0], [0.0, 4.9, 8.0])
    shown = magnified(small)
    assert shown.what == "yours less expected, of x [m]"
    assert (shown.over, shown.right.tolist()) == ("step", [0.0, 0.0, 0.0])
    assert shown.given == pytest.approx([0.0, 0.9, 0.0])
    for other in (lines([0.0, 4.0, 8.0], [0.0, 5.1, 8.0]), lines([0.0, 4.0, 8.0], [0.0, 4.1, np.nan])):
        assert magnified(other) is other


def test_the_picture_has_both_lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each with its mark and colour; over steps from 1; a twentieth of room above and below; no frame."""
    figures: list[Any] = []
    figure = pytest.importorskip("matplotlib.figure").Figure
    monkeypatch.setattr(
        figure, "savefig", lambda self, file, format: figures.append(self) or file.write(format.encode())
    )
    for over, first in (("step", 1), ("mass", 0)):
        as_png(lines([0.0, 4.0, 8.0], [0.0, 2.0], over), tmp_path / "own.png", "A title")
        assert (tmp_path / "own.png").read_bytes() == b"png"
        (axes,) = figures.pop().axes
        expected, yours = axes.get_lines()
        assert expected.get_xdata().tolist() == [first, first + 1, first + 2]
        assert yours.get_xdata().tolist() == [first, first + 1]
        assert (expected.get_ydata().tolist(), yours.get_ydata().tolist()) == ([0.0, 4.0, 8.0], [0.0, 2.0])
        assert [line.get_label() for line in (expected, yours)] == ["expected", "yours"]
        for name in ("get_color", "get_marker", "get_linestyle"):
            assert getattr(expected, name)() != getattr(yours, name)()
        assert (expected.get_marker(), yours.get_marker()) == ("o", "s")
        assert axes.get_ylim() == pytest.approx((-0.4, 8.4))
        assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == (over, "x [m]", "A title")
        assert [axes.spines[side].get_visible() for side in ("top", "right", "left")] == [False, False, True]
        assert axes.get_legend() is not None
        assert not axes.get_legend().get_frame_on()
        assert all(float(tick).is_integer() for tick in axes.get_xticks())
