"""Numbers from 5e-324 to 1e308, counts without end, names with control characters: each ends in a line or a result."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from experiments.runs.steppers import find_steppers
from experiments.runs.sweeps import MOST_RUNS, ParameterSweep
from reference.errors import InputError
from reference.printable import printable
from report.commands.terminal import show_table
from report.plain import plain, shortened
from tests.report.commands.terminal import Said, springlab
from tests.report.commands.test_bad_input import check_one_clear_line

#: What is said to a command of so wild numbers, besides `compare string --stepper heun`.
LINES = [
    ("--dt 1e300 --duration 1e300", "dt = 1e+300: expected a number from 1e-100 to 1e+100 [s]"),
    ("--dt 5e-324 --duration 1e-323", "dt = 4.94066e-324: expected a number from 1e-100 to 1e+100 [s]"),
    ("--duration 1e308", "duration = 1e+308: expected a number from 1e-100 to 1e+100 [s]"),
    ("--change 1e308:stiffness=1", "change of stiffness at 1e+308 s: expected at most 0.499 s"),
    ("--change 5e-324:stiffness=1e308", "stiffness = 1e+308: expected a number of at most 1e+50"),
    ("--change 0:mass=5e-324", "mass = 4.94066e-324: expected a number of at least 1e-50"),
    ("--set mass=5e-324", "mass = 4.94066e-324: expected a number of at least 1e-50 [kg]"),
    ("--set stiffness=1e308", "stiffness = 1e+308: expected a number of at most 1e+50 [N/m]"),
    ("--set masses=1e300", "masses = 1e+300: expected a number of at most 1e+50"),
    ("--set masses=99999999999", "masses = 1e+11: expected a whole number from 1 to 10,000,000"),
]


@pytest.mark.parametrize(("words", "text"), LINES)
def test_wild_numbers_are_one_clear_line(words: str, text: str) -> None:
    """With both numbers in it: what was asked for, and what can be."""
    check_one_clear_line(springlab("compare", "string", "--stepper", "heun", *words.split()), text)


@pytest.mark.parametrize(
    "words",
    ["--set stiffness=1e40", "--set mass=1e-40", "--dt 1e80 --duration 1e80", "--set stiffness=1e12"],
)
def test_where_nobody_can_follow_the_true_motion_the_runs_are_shown_without(words: str) -> None:
    """Its solver sees after some hundred steps that it will not come to the end."""
    said = springlab("compare", "string", "--stepper", "heun", *words.split())
    assert (said.code, said.err) == (0, "")
    assert "No error is known: no exact solution: " in said.out


def test_a_sweep_s_runs_are_counted_before_they_are_made() -> None:
    """Of one axis, and of all together."""
    many = springlab("sweep", "string", "--stepper", "heun", "--over", "stiffness=1:2:1000000000")
    check_one_clear_line(many, "--over 'stiffness=1:2:1000000000': 1,000,000,000 values: expected at most 1,000,000")
    axes = ["--over", "stiffness=1:2:100000", "--over", "mass=1:2:100000"]
    both = springlab("sweep", "string", "--stepper", "heun", *axes)
    check_one_clear_line(both, f"--over makes 10,000,000,000 runs: expected at most {MOST_RUNS:,}")


def test_as_many_runs_as_there_may_be_are_taken() -> None:
    """And one more is not."""
    (heun,) = find_steppers(["heun"])
    most = {"stiffness": [1.0] * 1000, "mass": [1.0] * 1000, "drag": [0.0] * 10}
    assert len(ParameterSweep("string", [heun], most, {})) == MOST_RUNS
    with pytest.raises(InputError, match="--over makes 11,000,000 runs: expected at most 10,000,000"):
        ParameterSweep("string", [heun], {**most, "drag": [0.0] * 11}, {})


def test_more_jobs_than_processes_can_be_are_refused() -> None:
    """Each is one."""
    said = springlab("sweep", "--stepper", "heun", "--over", "mass=1,2", "--jobs", "1000000")
    check_one_clear_line(said, "1000000 is not in the range 1<=x<=1024")


def test_control_characters_in_a_name_do_not_reach_the_terminal(tmp_path: Path) -> None:
    """Of a file that is not there, of a scene, of an option."""
    wild = "\x1b]0;owned\x07\r"
    for words in (["compare", f"{tmp_path}/{wild}.toml"], ["compare", wild], ["compare", f"--{wild}"], [wild]):
        said = springlab(*words)
        assert said.code == 2
        assert "\\x1b]0;owned\\x07\\r" in said.err
        assert printable(said.err.rstrip("\n")) == said.err.rstrip("\n")


def test_a_name_in_a_table_is_shown_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    """In title, heading and cell; numbers and words stay."""
    show_table("title\x07", ["column\x1b[2J"], [["cell\x9b31m"], ["é 漢"]])
    shown = capsys.readouterr().out
    for escaped in ("title\\x07", "column\\x1b[2J", "cell\\x9b31m", "é 漢"):
        assert escaped in shown
    assert plain("\n") == "\\n"


def test_a_long_name_is_shortened_in_its_middle() -> None:
    """As long as it may be, and both ends are seen."""
    text = "".join(chr(97 + i % 26) for i in range(300))
    short = shortened(text)
    assert len(short) == 60
    assert short[:20] == text[:20]
    assert short[-20:] == text[-20:]
    assert shortened(text[:60]) == text[:60]


@pytest.mark.parametrize("name", ["scene.toml", "mesh.obj", "record.csv"])
def test_what_has_no_end_is_not_read(name: str, tmp_path: Path) -> None:
    """A pipe that nobody writes to, as scene, mesh or record: it would be waited for without end."""
    os.mkfifo(tmp_path / name)
    tables = {
        "scene.toml": "",
        "mesh.obj": '[mesh]\nfile = "mesh.obj"\nmasses = 1.0\nstiffness = 1.0\n',
        "record.csv": 'scene = "bridge"\n[ground_motion]\nfile = "record.csv"\n',
    }
    file = tmp_path / "scene.toml"
    if tables[name]:
        file.write_text(tables[name])
    check_one_clear_line(springlab("compare", str(file)), "is a pipe or a device: expected a file")


@pytest.mark.parametrize("name", ["scene.toml", "mesh.obj", "record.csv"])
def test_a_file_larger_than_any_that_is_meant_is_not_read(name: str, tmp_path: Path) -> None:
    """A sparse one of 1 TB: both sizes are said."""
    tables = {
        "mesh.obj": '[mesh]\nfile = "mesh.obj"\nmasses = 1.0\nstiffness = 1.0\n',
        "record.csv": 'scene = "bridge"\n[ground_motion]\nfile = "record.csv"\n',
    }
    (tmp_path / "scene.toml").write_text(tables.get(name, ""))
    with (tmp_path / name).open("ab") as file:
        file.truncate(10**12)
    said: Said = springlab("compare", str(tmp_path / "scene.toml"))
    check_one_clear_line(said, "has 953,674 MiB: expected at most ")
