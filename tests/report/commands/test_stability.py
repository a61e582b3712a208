"""`springlab stability`: its rows, its maps, and bad words."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from tests.report.commands.terminal import springlab


def test_json_rows_have_the_promised_keys(tmp_path: Path) -> None:
    """`springlab stability --json`."""
    done = springlab("stability", "string", "--stepper", "heun", "--set", "drag=0.1", "--json", "--out", str(tmp_path))
    assert done.code == 0
    (row,) = json.loads(done.out)
    keys = ["stepper", "damping", "drag", "predicted_dt_s", "measured_dt_s", "relative_difference", "outcome", "reason"]
    assert list(row) == [*keys, "predicted_certainty", "predicted_at_most_s", "windows_s"]
    assert (tmp_path / "stability.csv").exists()


def test_a_listing_is_a_row_that_says_why_not(tmp_path: Path) -> None:
    """The lecture's listings are neither schemes nor engines: unsupported, with the reason, and nothing breaks."""
    words = ("--stepper", "lecture_heun_loops", "--set", "drag=0.1", "--json", "--out", str(tmp_path))
    done = springlab("stability", "string", *words)
    assert done.code == 0
    (row,) = json.loads(done.out)
    assert row["outcome"] == "unsupported"
    assert "schemes and engines" in row["reason"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--map", "dt", "dt"], "two different axes"),
        (["--map", "dt", "dampin"], "did you mean 'damping'"),
        (["--map", "dt", "drag", "--range", "drag=1"], "KEY=LOW:HIGH"),
        (["--map", "dt", "drag", "--range", "mass=1:2"], "one of the map's axes"),
        (["--stepper", "hein"], "did you mean 'heun'"),
    ],
)
def test_bad_words_are_one_line(words: list[str], said: str) -> None:
    """Exit code 2, and what was expected."""
    done = springlab("stability", "string", *words)
    assert done.code == 2
    assert said in done.err
    assert done.err.count("\n") == 1


def test_a_map_is_a_figure_and_a_table_of_growth(tmp_path: Path) -> None:
    """A point for each pair of values, from one end of each range to the other: Pymunk's on 16 x 16."""
    words = ("--stepper", "pymunk_springs", "--range", "dt=1e-3:4e-3", "--range", "damping=0:0.1")
    done = springlab("stability", "spring", "--map", "dt", "damping", *words, "--out", str(tmp_path))
    assert done.code == 0, done.err
    assert (tmp_path / "pymunk_springs-dt-damping.svg").read_text(encoding="utf-8").startswith("<svg")
    with (tmp_path / "pymunk_springs-dt-damping.csv").open(newline="", encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    assert len(rows) == 16 * 16
    assert (rows[0]["dt"], rows[-1]["dt"]) == (1e-3, 4e-3)
    assert (rows[0]["damping"], rows[-1]["damping"]) == (0.0, 0.1)
