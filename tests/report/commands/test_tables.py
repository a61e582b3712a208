"""Tables in the terminal: whatever its width, every cell is there, and every reason can be read."""

from __future__ import annotations

import re

import pytest

from report.commands.terminal import show_table, with_notes

COLUMNS = ["stepper", "damping [N s/m]", "drag [N s/m]", "predicted dt [s]", "measured dt [s]"]
COLUMNS += ["relative difference", "outcome", "reason", "engine's own growth factor at 0.99 of it", "at 1.01"]

UNSTABLE, STABLE = (f"predicted and measured: {word} at any dt, however small or large it may be" for word in "ab")

ROWS = [
    ["euler", 0.0, 0.125, None, None, None, "done", UNSTABLE, None, None],
    ["backward_euler", 0.0, 0.125, None, None, None, "done", STABLE, None, None],
    ["mujoco_tendons_implicit", 0.5, 0.25, 0.01234, 0.0123, -1.23e-6, "done", "", 0.99998, 1.00002],
]


def shown(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, width: int) -> str:
    """The table on a terminal of a width [characters]."""
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setenv("TTY_COMPATIBLE", "1")  # Rich takes this for a terminal
    show_table("", COLUMNS, ROWS)
    return re.sub(r"\x1b\[\d*m", "", capsys.readouterr().out)


@pytest.mark.parametrize("width", [60, 80, 120, 160, 300])
def test_nothing_is_left_out_at_any_width(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    """Names and numbers whole, reasons word by word, no ellipsis, no line beyond the width."""
    said = shown(capsys, monkeypatch, width)
    words = " ".join(said.split())
    for name in (
        "euler",
        "backward_euler",
        "mujoco_tendons_implicit",
        "0.0123",
        "-1.23e-06",
        "1.01",
        "outcome",
        "reason",
    ):
        assert name in words
    assert "…" not in said
    assert max(map(len, said.splitlines())) <= width
    for reason in (UNSTABLE, STABLE):
        assert all(word in words for word in reason.split())
    assert len([line for line in said.splitlines() if line.split()[:1] == ["euler"]]) >= 1


@pytest.mark.parametrize("width", [60, 80, 120])
def test_where_there_is_no_room_reasons_are_notes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    """Two rows that are alike but for their reasons do not print the same: each has the number of its own note."""
    said = " ".join(shown(capsys, monkeypatch, width).split())
    assert f"(1) {UNSTABLE}" in said
    assert f"(2) {STABLE}" in said


def test_a_title_is_not_folded_at_the_width_of_its_table(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It stays on a line where the terminal has room for it, though the table is narrower."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    title = "meant [s]: k = 631.655 N/m, c = 35.1858 N s/m"
    show_table(title, ["a", "b"], [["c", 1.0]])
    assert title in re.sub(r"\x1b\[\d*m", "", capsys.readouterr().out).splitlines()


def test_the_same_sentence_is_one_note() -> None:
    """Short texts stay where they are."""
    cells = [["a", UNSTABLE], ["b", STABLE], ["c", UNSTABLE], ["d", "short"]]
    short, notes = with_notes(cells)
    assert short == [["a", "(1)"], ["b", "(2)"], ["c", "(1)"], ["d", "short"]]
    assert notes == [f"(1) {UNSTABLE}", f"(2) {STABLE}"]


def test_numbers_are_to_the_right_and_words_to_the_left(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By column: one of numbers may have gaps, and words may stand before it."""
    monkeypatch.setenv("COLUMNS", "160")
    show_table("", ["scheme", "error of it [m]", "outcome of it"], [["heun", None, "done"], ["rk4", 0.5, "none"]])
    lines = capsys.readouterr().out.splitlines()
    (heads,), (row,) = ([line for line in lines if word in line] for word in ("scheme", "rk4"))
    assert row.index("rk4") == heads.index("scheme")
    assert row.index("0.5") + len("0.5") == heads.index("[m]") + len("[m]")
    assert row.index("none") == heads.index("outcome")
