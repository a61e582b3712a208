"""What of a store's rows `springlab results` shows in a terminal: as much as it has room for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from experiments.runs.results import MORE_COLUMNS
from report.commands import results, results_table
from report.commands.results_table import for_people, heading
from tests.report.commands.terminal import springlab

LONG = "spring 2 is over 100 times its length at t = 0.015 s, and so are all others of the string"

ROW = {
    "task": "judged",
    "stepper": "mujoco_tendons",
    "version": "3.17.0",
    "scene": "string",
    "stiffness": 100.0,
    "dt": 1e-3,
    "steps": 500,
    "outcome": "done",
    "reason": "",
    "error_m": 1e-3,
    "identified_as": "drift_kick_sequential_damping",
    "identification_error_m": 1e-17,
    **dict.fromkeys(MORE_COLUMNS, "x"),
}
OTHER = ROW | {
    "stepper": "pymunk_springs",
    "version": "7.3.1",
    "stiffness": 200.0,
    "dt": 2e-3,
    "steps": 250,
    "outcome": "diverged",
    "reason": LONG,
    "error_m": 2.0,
    "identified_as": "heun",
    "identification_error_m": 1e-3,
}


@pytest.mark.parametrize(
    ("width", "shown"),
    [
        (200, "stepper version stiffness dt steps outcome error_m identified_as identification_error_m reason"),
        (132, "stepper stiffness dt outcome error_m identified_as reason"),
        (80, "stepper stiffness dt outcome reason"),
        (60, "stepper stiffness dt outcome"),
        (50, "stepper stiffness outcome"),
        (10, "stepper outcome"),
    ],
)
def test_a_narrow_terminal_shows_what_matters_most(width: int, shown: str) -> None:
    """Who ran what, how it ended, and then what was found; what there is no room for is named, and nothing is cut."""
    columns, same, left_out = for_people([ROW, OTHER], width)
    assert columns == shown.split()
    assert same == {"task": "judged", "scene": "string"}
    assert {*columns} | {*left_out} | {*same} == {*ROW} - {*MORE_COLUMNS}


def test_a_single_row_is_shown_as_it_is() -> None:
    """In it everything is the same; what it has nothing of is no column."""
    columns, same, left_out = for_people([ROW], 300)
    assert (same, left_out) == ({}, [])
    assert {*columns} == {name for name in ROW if name not in MORE_COLUMNS and name != "reason"}
    assert for_people([], 80) == ([], {}, [])


def test_headings_have_units() -> None:
    """Those of `springlab compare`, and those of the scenes' parameters."""
    names = ("stiffness", "gravity", "dt", "error_m", "identified_as", "outcome")
    wanted = ["stiffness [N/m]", "gravity [m/s^2]", "dt [s]", "error [m]", "identified as", "outcome"]
    assert heading("identification_error_m") == "deviation [m]"
    assert [heading(name) for name in names] == wanted


def test_all_rows_are_printed_with_what_they_share_and_what_there_is_no_room_for(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of no rows there is nothing to print."""
    monkeypatch.setenv("COLUMNS", "80")
    results._show([])
    assert not capsys.readouterr().out
    results._show([ROW, OTHER])
    table, said = capsys.readouterr().out.split("In every row: ")
    assert all(word in table for word in ("mujoco_tendons", "pymunk_springs", "stiffness [N/m]", "dt [s]", "diverged"))
    assert "scene=string" in said
    assert "--csv" in said


def test_a_column_is_as_wide_as_its_heading_or_its_texts() -> None:
    """With the space beside it; a sentence, of forty characters and more, may be folded to sixteen."""
    assert results_table._width("error_m", [None, 0.5]) == len("error [m]") + 3
    assert results_table._width("a", ["x", "x" * 39, "xx"]) == 39 + 3
    assert results_table._width("a", ["x", "x" * 40]) == 16 + 3


@pytest.mark.parametrize(("count", "told"), [(2, ""), (3, "; these are the last 2: --csv has all, COLUMN=VALUE picks")])
def test_the_last_rows_are_shown_and_how_many_there_are(
    count: int, told: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Rows that are damaged are named on standard error, the first of them, and what takes over the others."""
    asked: list[object] = []

    def rows(store: Path, filters: object, retired: bool, tell: Callable[[str], None]) -> list[dict[str, object]]:
        asked.append((store, filters, retired))
        for i in range(count):
            tell(f"row {i} is damaged")
        return [{"stepper": f"s{i}", "outcome": "done"} for i in range(count)]

    monkeypatch.setattr("experiments.runs.results.rows", rows)
    monkeypatch.setattr(results, "SHOWN", 2)
    monkeypatch.setattr(results, "NAMED", 2)
    store = tmp_path / "store.sqlite"
    said = springlab("results", "stepper=heun", "--all", "--store", str(store))
    assert asked == [(store, {"stepper": "heun"}, True)]
    assert [f"s{i}" in said.out for i in range(count)] == [False] * (count - 2) + [True, True]
    assert said.out.endswith(f"{count} runs in {store}{told}\n")
    assert said.err.splitlines() == [
        *(f"store {store}: row {i} is damaged" for i in range(2)),
        f"store {store}: {count} rows are damaged and left out; the others are here, and "
        "`springlab results --salvage NEW` takes them over",
    ]
    assert "In every row: outcome=done\n" in said.out
