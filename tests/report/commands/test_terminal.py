"""Widths of columns, exit codes, and what is wrong in one line."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from experiments.experiment import Result, Table, find
from reference.errors import InputError, SolverError
from report.commands.terminal import (
    FOLDED,
    GAP,
    _parts,
    _widths,
    exit_if_files_failed,
    in_one_line,
    json_text,
    progress,
    show_lines,
    show_result,
    show_table,
)


def test_columns_that_are_folded_share_the_room_that_is_left() -> None:
    """In proportion to their longest texts; names and numbers are whole, and nothing is wider than it need be."""
    columns = ["stepper", "reason", "remark", "dt [s]"]
    cells = [["euler", "a " * 60, "b", "0.001"], ["backward_euler", "c", "d " * 30, "0.0125"]]
    part, room = [0, 1, 2, 3], 150
    widths = _widths(columns, cells, part, room)
    assert (widths[0], widths[3]) == (len("backward_euler"), len("0.0125"))
    assert sum(widths.values()) + GAP * len(part) == room
    assert widths[1] / 120 == pytest.approx(widths[2] / 60, abs=1 / 60)
    assert widths[2] > FOLDED
    wide = _widths(columns, cells, part, 400)
    assert [wide[i] for i in part] == [len("backward_euler"), 120, 60, len("0.0125")]
    assert _widths(columns, cells, [0, 2], 0) == {0: len("backward_euler"), 2: FOLDED}


def plain(text: str) -> str:
    """Without what a terminal obeys."""
    return re.sub(r"\x1b\[[\d;?]*[A-Za-z]", "", text)


def test_progress_is_a_line_on_standard_error_of_which_nothing_is_left(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The bar, what is done, for how long, and how long it will take; in a file nothing."""
    with progress("sweep") as tell:
        tell("3 of 4 runs")
    assert capsys.readouterr() == ("", "")
    monkeypatch.setenv("TTY_COMPATIBLE", "1")  # Rich takes this for a terminal
    monkeypatch.setenv("COLUMNS", "100")
    with progress("sweep") as tell:
        tell("3 of 4 runs")
    out, err = capsys.readouterr()
    assert out == ""
    assert re.search(r"[━╸╺]{20} sweep: 3 of 4 runs 0:00:00 left: ", plain(err))
    assert err.endswith("\x1b[2K")  # the line is erased


def test_sentences_are_folded_before_they_are_notes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where one table has room for them so; a column narrower than that makes them notes."""
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    sentence = "it blew up at once, as anybody would have told you before"
    least = 8 + FOLDED + 4 + 3 * GAP
    for width, folded in ((least, True), (least - 1, False)):
        monkeypatch.setenv("COLUMNS", str(width))
        show_table("", ["stepper", "reason", "mode"], [["backward", sentence, "1"]] * 2)
        said = plain(capsys.readouterr().out)
        assert ("(1)" in said) is not folded
        assert all(word in said for word in sentence.split())


def test_json_can_be_read_by_people_too() -> None:
    """An entry on each line, set in by two."""
    assert json_text({"a": [1, None]}) == '{\n  "a": [\n    1,\n    null\n  ]\n}'


def test_lines_are_folded_between_words(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """What goes on is set in; a path is whole; a file has lines as they are."""
    lines = ["one two-three four", "/a/path/that-is/long one"]
    show_lines(lines)
    assert capsys.readouterr().out.splitlines() == lines
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setenv("COLUMNS", "14")
    show_lines(lines)
    assert capsys.readouterr().out.splitlines() == [
        *("one two-three", "    four"),
        *("/a/path/that-is/long", "    one"),
    ]


def test_a_result_is_shown_with_its_question_findings_first_table_and_failures(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """As they are: what is in brackets is no markup."""
    experiment = replace(find("order"), title="T [s]", question="Q?")
    tables = [Table("a", ["n [m]"], [[0.5]]), Table("b", ["other"], [[2.0]])]
    show_result(experiment, Result(["one [s]", "two [bold]x[/bold]"], tables, {}, ["it [N/m] failed"]))
    lines = [line.strip() for line in capsys.readouterr().out.splitlines() if line.strip("─ ")]
    findings = ["- one [s]", "- two [bold]x[/bold]"]
    assert lines == ["T [s]", "Q?", *findings, "n [m]", "0.5", "not done: it [N/m] failed"]


def test_columns_that_do_not_fit_beside_one_another_are_several_tables() -> None:
    """As few as will do, each with the first column: here of 10 and 20, 40 and 5, 30, with GAP beside each."""
    columns, cells = ["a", "b", "c", "d", "e"], [["a" * 7, "b" * 17, "c" * 37, "d" * 2, "e" * 27]]
    assert _parts(columns, cells, 105, folded=False) == [[0, 1, 2, 3, 4]]
    assert _parts(columns, cells, 104, folded=False) == [[0, 1, 2, 3], [0, 4]]
    assert _parts(columns, cells, 55, folded=False) == [[0, 1], [0, 2, 3], [0, 4]]
    assert _parts(columns, cells, 40, folded=False) == [[0, 1], [0, 2], [0, 3], [0, 4]]
    # one that is wider than all there is stands alone beside the first; a sentence is folded to FOLDED
    assert _parts(columns, cells, 20, folded=False) == [[0, 1], [0, 2], [0, 3], [0, 4]]
    sentence = [["a" * 7, "b " * 30]]
    assert _parts(["a", "b"], sentence, 10 + FOLDED + GAP, folded=True) == [[0, 1]]
    assert _parts(["a", "b", "c"], [[*sentence[0], "c"]], 10 + FOLDED + GAP + 3, folded=True) == [[0, 1], [0, 2]]
    assert _parts(["a", "b", "c"], [[*sentence[0], "c"]], 10 + FOLDED + GAP + 4, folded=True) == [[0, 1, 2]]


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (None, 0, ""),
        (InputError("dt = 0"), 2, "springlab: dt = 0\n"),
        (SolverError("no rest"), 1, "springlab: no rest\n"),
        (OSError(28, "No space left", "a.csv"), 2, "springlab: a.csv: No space left\n"),
        (OSError(28, "No space left"), 2, "springlab: input or output: No space left\n"),
        (OSError("odd"), 2, "springlab: odd\n"),
    ],
)
def test_what_is_wrong_is_one_line_and_a_code(
    error: Exception | None, code: int, line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the file where one is known."""

    def command() -> None:
        if error is not None:
            raise error

    assert in_one_line(command) == code
    assert capsys.readouterr().err == line


def test_too_little_memory_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    """And what to do."""

    def command() -> None:
        raise MemoryError

    assert in_one_line(command) == 2
    assert "expected fewer masses" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("ended", "fails"),
    [
        ([("own", "crashed")], True),
        ([("own", "done"), ("own", "timed out")], True),
        ([("own", "diverged"), ("scheme", "done")], False),
        ([("engine", "crashed"), ("own", "done")], False),
        ([], False),
    ],
)
def test_only_a_file_of_the_users_that_raised_is_an_error(ended: list[tuple[str, str]], fails: bool) -> None:
    """An engine that does is a result."""
    if not fails:
        exit_if_files_failed(ended)
        return
    with pytest.raises(SystemExit) as ending:
        exit_if_files_failed(ended)
    assert ending.value.code == 1
