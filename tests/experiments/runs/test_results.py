"""`springlab results`: what is in the store, exactly, and as much of it as a terminal has room for."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from experiments.runs.results import MORE_COLUMNS, parse_filters, rows
from experiments.runs.store import Store
from experiments.runs.task import Task
from reference.errors import InputError
from reference.limit import Limit
from reference.outcome import Outcome
from report.commands.results import SHOWN
from tests.experiments.runs.tasks import STRING, kept, stepped, task
from tests.report.commands.terminal import Said, springlab

#: What no three figures can say.
ERROR, DT = 0.1 + 2**-54, 1e-3 / 3

LONG = "spring 2 is over 100 times its length at t = 0.015 s, and so are all others of the string"


def stepped_task(stiffness: float, dt: float = DT) -> Task:
    """A task with all that labels are made of, but an engine."""
    arguments = (None, STRING.with_parameter("stiffness", stiffness), dt, 10, ())
    return Task(stepped, arguments, {"scene": "string", "stiffness": stiffness})


@pytest.fixture
def filled(store: Store) -> Path:
    """The file of a store with runs of several kinds, one of them started over."""
    store.keep(stepped_task(100.0), {"outcome": Outcome("done"), "error_m": ERROR, "identified_as": "heun"}, 0.5)
    store.keep(stepped_task(200.0), {"outcome": Outcome("diverged", LONG), "error_m": None, "identified_as": None}, 0.5)
    store.keep(task(1), Outcome("crashed", 'killed, "by" SIGSEGV'), 0.1)
    store.keep(task(2), {"dt": 0.25, "reason": "found", "number": 7, "sound": True}, 0.1)
    store.retire([task(1).key])
    store.keep(task(1), Outcome("done"), 0.1)
    return store.file


def results(file: Path, *words: str) -> Said:
    """What `springlab results WORDS` says of a store."""
    said = springlab("results", *words, "--store", str(file))
    assert (said.code, said.err) == (0, "")
    return said


def as_json(file: Path, *words: str) -> list[dict[str, Any]]:
    """The rows it prints."""
    found: list[dict[str, Any]] = json.loads(results(file, *words, "--json").out)
    return found


# --- Export ---


def test_json_has_every_row_with_exact_numbers(filled: Path) -> None:
    """The oldest first, those that were started over left out."""
    found = as_json(filled)
    assert [(row["task"], row["outcome"]) for row in found] == [
        *(("stepped", "done"), ("stepped", "diverged")),
        *(("numbered", "done"), ("numbered", "done")),
    ]
    first = found[0]
    assert (first["stiffness"], first["dt"], first["steps"], first["error_m"]) == (100.0, DT, 10, ERROR)
    assert (first["scene"], first["identified_as"], first["reason"], first["arrays"]) == ("string", "heun", "", None)
    assert found == rows(filled, {})


def test_all_has_those_that_were_started_over_too(filled: Path) -> None:
    """Each with its own outcome."""
    assert [row["outcome"] for row in as_json(filled, "number=1")] == ["done"]
    assert sorted(row["outcome"] for row in as_json(filled, "number=1", "--all")) == ["crashed", "done"]


def test_csv_has_the_same_rows(filled: Path) -> None:
    """Numbers to the last bit, words with commas and quotes, and nothing where there is nothing."""
    found = [*csv.DictReader(io.StringIO(results(filled, "--csv", "--all").out))]
    wanted = as_json(filled, "--all")
    assert len(found) == len(wanted) == 5
    for row, exact in zip(found, wanted, strict=True):
        for name, value in row.items():
            due = exact.get(name)
            assert value == ("" if due is None else str(due))
            if isinstance(due, float):
                assert float(value) == due


def test_columns_of_csv_say_first_what_was_run_and_then_what_came_of_it(filled: Path) -> None:
    """Whichever row they come from; digests come last."""
    (header,) = [*csv.reader(io.StringIO(results(filled, "--csv").out))][:1]
    assert len({*header}) == len(header)
    end = header.index("outcome")
    assert {"task", "stepper", "version", "scene", "stiffness", "number", "dt", "steps"} == {*header[:end]}
    assert {"reason", "error_m", "identified_as"} <= {*header[end:]}
    assert {*MORE_COLUMNS} <= {*header[end:]}


def test_what_an_answer_calls_like_a_column_does_not_take_its_place(filled: Path) -> None:
    """It is found under another name."""
    (row,) = as_json(filled, "number=2")
    assert (row["dt"], row["reason"], row["number"]) == (None, "", 2)
    assert (row["found_dt"], row["found_reason"], row["found_number"]) == (0.25, "found", 7)


def test_a_store_with_nothing_in_it_has_no_rows(store: Store) -> None:
    """And CSV has a header all the same."""
    assert as_json(store.file) == []
    assert results(store.file).out == f"0 runs in {store.file}\n"
    (header,) = csv.reader(io.StringIO(results(store.file, "--csv").out))
    assert header[:2] == ["task", "stepper"]


# --- Filters ---


@pytest.mark.parametrize(
    ("words", "count"),
    [
        ((), 4),
        (("stiffness=100",), 1),
        (("stiffness=1e2",), 1),
        (("stiffness=100.0",), 1),
        (("stiffness=101",), 0),
        (("stiffness=hard",), 0),
        ((f"dt={DT!r}",), 2),
        (("dt=3.33e-4",), 0),
        (("steps=10.0", "outcome=diverged"), 1),
        (("outcome=don",), 0),
        (("outcome=Done",), 0),
        (("task=stepped", "stiffness=200", "outcome=done"), 0),
        ((f"error_m={ERROR!r}",), 1),
        (("error_m=0.1",), 0),
        (("error_m=",), 3),
        (("error_m=-",), 3),
        (("sound=True",), 1),
        (("sound=1",), 0),
        ((f"reason={LONG}",), 1),
    ],
)
def test_a_filter_asks_for_equality(filled: Path, words: Sequence[str], count: int) -> None:
    """Of numbers as numbers, however they are written; all filters at once; nothing is what has no value."""
    assert len(as_json(filled, *words)) == count


@pytest.mark.parametrize(
    ("word", "line"),
    [
        ("outcom=done", "unknown column 'outcom': did you mean 'outcome'?"),
        ("stifness=1", "unknown column 'stifness': did you mean 'stiffness'?"),
        ("xyz=1", "unknown column 'xyz': expected one of arrays, dt, "),
        ("outcome", "filter 'outcome': expected COLUMN=VALUE"),
        ("=done", "filter '=done': expected COLUMN=VALUE"),
    ],
)
def test_a_filter_that_makes_no_sense_is_refused_in_a_line(filled: Path, word: str, line: str) -> None:
    """With a suggestion."""
    said = springlab("results", word, "--store", str(filled))
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    assert said.err.startswith(f"springlab: {line}")


def test_a_value_may_have_an_equals_sign_in_it() -> None:
    """Only the first one counts."""
    assert parse_filters(["reason=t = 0.1 s", "a="]) == {"reason": "t = 0.1 s", "a": ""}
    with pytest.raises(InputError):
        parse_filters(["reason"])


def test_where_there_is_no_store_a_line_says_what_makes_one(tmp_path: Path) -> None:
    """And none is made."""
    file = tmp_path / "store.sqlite"
    said = springlab("results", "--store", str(file))
    line = f"springlab: store {file}: there is none; `springlab run` and `springlab sweep` make one\n"
    assert (said.code, said.out, said.err) == (2, "", line)
    assert not file.exists()


# --- In a terminal ---


def test_what_is_the_same_in_every_row_is_said_once(filled: Path) -> None:
    """In the words that would filter for it; what differs is a column, with its unit."""
    lines = [" ".join(line.split()) for line in results(filled, "task=stepped").out.splitlines()]
    assert lines[1] == "stiffness [N/m] outcome error [m] identified as reason"
    assert "100 done 0.1 heun" in lines
    assert "In every row: task=stepped, scene=string, dt=0.000333, steps=10" in lines
    assert lines[-1] == f"2 runs in {filled}"


def test_the_last_runs_are_shown_where_there_are_many(store: Store) -> None:
    """With how to see the others."""
    for number in range(SHOWN + 5):
        store.keep(task(number), {"value": f"answer {number}."}, 0.0)
    out = results(store.file).out
    assert "answer 4." not in out
    assert all(f"answer {number}." in out for number in range(5, SHOWN + 5))
    assert f"{SHOWN + 5} runs in {store.file}; these are the last {SHOWN}: " in out


def test_in_80_characters_no_line_is_longer_and_no_cell_is_cut(filled: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a terminal of that width shows it: long reasons are folded."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("FORCE_COLOR", "1")
    out = re.sub(r"\x1b\[[0-9;]*m", "", results(filled, "task=stepped").out)
    table = out[: out.index("In every row")]
    assert "…" not in table
    assert max(map(len, table.splitlines())) <= 80
    assert all(word in table for word in LONG.split())


def test_of_a_limit_there_is_what_it_has(store: Store) -> None:
    """Its dt in any case, its two growth factors under their names; what is nothing is no column."""
    store.keep(task(1), Limit(0.25, factors=(0.5, 1.5)), 0.1)
    store.keep(task(2), Limit(None, "unstable at any dt", growth=0.125), 0.1)
    some, none = rows(store.file, {}, tell=pytest.fail)
    assert (some["found_dt"], some["growth_factor_below"], some["growth_factor_above"]) == (0.25, 0.5, 1.5)
    assert "growth" not in some
    assert (none["found_dt"], none["growth"], none["found_reason"]) == (None, 0.125, "unstable at any dt")
    assert "growth_factor_below" not in none
    assert kept(store, 2) == Limit(None, "unstable at any dt", growth=0.125)
    assert not store.remarks


def test_what_was_started_over_is_told_where_it_is_asked_for(filled: Path) -> None:
    """Else not."""
    assert [row["outcome"] for row in rows(filled, {"number": "1"})] == ["done"]
    assert [row["outcome"] for row in rows(filled, {"number": "1"}, retired=True)] == ["crashed", "done"]
