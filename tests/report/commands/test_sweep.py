"""`springlab sweep`: every combination is run once, judged as `compare` would, and told."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from experiments.runs.results import rows
from experiments.runs.steppers import find_steppers
from experiments.runs.store import read_arrays
from experiments.runs.sweeps import ParameterSweep, parse_axes
from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from tests.report.commands.terminal import springlab

#: Masses joined in a triangle: no string.
MESH = """
[system]
positions = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]
springs = [[0, 1], [1, 2], [0, 2]]
masses = 0.02
stiffness = 100.0
fixed = [0]
"""

#: A small sweep: two schemes on four systems.
SMALL = (
    *("sweep", "--stepper", "heun", "--stepper", "euler", "--over", "masses=2,3", "--over", "stiffness=100:200:2"),
    *("--duration", "0.02"),
)


def swept(store: Path, *words: str) -> dict[str, Any]:
    """What `springlab sweep WORDS --json` prints."""
    said = springlab(*words, "--json", "--store", str(store))
    assert (said.code, said.err) == (0, "")
    document: dict[str, Any] = json.loads(said.out)
    return document


def contents(store: Path) -> list[tuple[Any, ...]]:
    """Every answer and every file of arrays, byte for byte."""
    with closing(sqlite3.connect(store)) as sql:
        answers = sql.execute("SELECT key, generation, answer, arrays FROM runs ORDER BY key, generation").fetchall()
    files = sorted(path for path in (store.parent / "arrays").rglob("*.npz"))
    return [*answers, *((str(path), path.read_bytes()) for path in files)]


# --- Axes ---


@pytest.mark.parametrize(
    ("word", "values"),
    [
        ("mass=1:3:3", [1.0, 2.0, 3.0]),
        ("mass=3:1:3", [3.0, 2.0, 1.0]),
        ("mass=1:3:1", [1.0]),
        ("mass=-1:1:3", [-1.0, 0.0, 1.0]),
        ("dt=1e-4:1e-2:3:log", [1e-4, 1e-3, 1e-2]),
        ("mass=0.1,0.3,0.2", [0.1, 0.3, 0.2]),
        ("mass=7", [7.0]),
    ],
)
def test_an_axis_is_spaced_evenly_or_by_equal_factors_or_listed(word: str, values: list[float]) -> None:
    """Its ends, and numbers that are listed, are exactly what was written."""
    ((name, found),) = parse_axes([word]).items()
    assert name == word.partition("=")[0]
    assert found == pytest.approx(values, rel=1e-15)
    assert (found[0], found[-1]) == (values[0], values[-1])


def test_axes_are_in_the_order_they_are_given() -> None:
    """And so are the runs."""
    assert [*parse_axes(["b=1,2", "a=3"])] == ["b", "a"]


FORM = "expected KEY=LOW:HIGH:COUNT, KEY=LOW:HIGH:COUNT:log or KEY=A,B,C"
BAD_AXES = ["mass", "=1", "mass=", "mass=a,b", "mass=1,,2", "mass=1:2", "mass=1:2:2.5"]
BAD_AXES += ["mass=1:2:3:lin", "mass=1:2:3:log:x", "mass=nan", "mass=0:inf:3"]


@pytest.mark.parametrize("word", BAD_AXES)
def test_an_axis_of_another_form_is_refused(word: str) -> None:
    """With the forms there are."""
    with pytest.raises(InputError) as refused:
        parse_axes([word])
    assert str(refused.value) == f"--over {word!r}: {FORM}"


@pytest.mark.parametrize(
    ("word", "why"),
    [
        ("mass=1:2:0", "COUNT = 0: expected at least 1"),
        ("mass=1:2:-3", "COUNT = -3: expected at least 1"),
        ("mass=0:1:3:log", "from 0 to 1 by equal factors: expected both ends > 0 with :log"),
        ("mass=1:-1:3:log", "from 1 to -1 by equal factors: expected both ends > 0 with :log"),
    ],
)
def test_an_axis_that_cannot_be_is_told_why(word: str, why: str) -> None:
    """Its form is right."""
    with pytest.raises(InputError) as refused:
        parse_axes([word])
    assert str(refused.value) == f"--over {word!r}: {why}"


LINES = [
    ("--stepper heun", "Missing option '--over'"),
    ("--over mass=1", "Missing option '--stepper'"),
    ("--stepper huen --over mass=1", "unknown stepper 'huen': did you mean 'heun'?"),
    ("--stepper heun --over mas=1", "did you mean 'mass'?"),
    ("strin --stepper heun --over mass=1", "unknown scene 'strin': did you mean 'string'?"),
    ("--stepper heun --over mass=1:2", f"--over 'mass=1:2': {FORM}"),
    ("--stepper heun --over mass=1 --over mass=2", "--over 'mass=2': mass is varied already"),
    (
        "--stepper heun --over mass=1 --set mass=2",
        "--over mass: expected a parameter that is not set to one value as well",
    ),
    ("--stepper heun --over dt=1e-3 --dt 1e-3", "--over dt: expected a parameter that is not set to one value as well"),
    ("--stepper heun --over mass=-1,1", "mass = -1: expected a number > 0 [kg]"),
    ("--stepper heun --over masses=2.5", "masses = '2.5': expected a whole number"),
    ("--stepper heun --over dt=0,1e-3", "dt = 0: expected a finite number > 0 [s]"),
    ("--stepper heun --over dt=5", "duration = 0.5: expected at least one step of dt = 5 s"),
    ("--stepper heun --over dt=1e-9", "duration = 0.5: expected at most 10,000,000 steps of dt = 1e-09 s"),
    ("--stepper heun --over mass=1 --time-limit nan", "--time-limit nan: expected a number > 0 [s]"),
    ("--stepper heun --over mass=1 --memory-limit -2", "--memory-limit -2: expected a number > 0 [GiB]"),
    ("--stepper heun --over mass=1 --jobs 0", "0 is not in the range 1<=x<=1024"),
]


@pytest.mark.parametrize(("words", "line"), LINES)
def test_a_sweep_that_makes_no_sense_is_refused_in_a_line(tmp_path: Path, words: str, line: str) -> None:
    """Exit code 2, nothing on standard output."""
    said = springlab("sweep", *words.split(), "--store", str(tmp_path / "store.sqlite"))
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    assert said.err.startswith("springlab: ")
    assert line in said.err


# --- Runs ---


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """The folder of a store with the small sweep, and what was said of it."""
    folder = tmp_path_factory.mktemp("small")
    return folder, swept(folder / "store.sqlite", *SMALL, "--keep")


@pytest.fixture
def store(first: tuple[Path, dict[str, Any]], tmp_path: Path) -> Path:
    """A copy of that store."""
    return shutil.copytree(first[0], tmp_path / "copy") / "store.sqlite"


@pytest.mark.rotating(3, in_turn=True)
def test_a_sweep_is_run_once(first: tuple[Path, dict[str, Any]], store: Path) -> None:
    """The second time nothing is run, and not a byte of what is kept changes; more points are run alone."""
    _, said = first
    assert (said["runs"], said["run_now"]) == (8, 8)
    assert said["outcomes"] == {"heun": {"done": 4}, "euler": {"done": 4}}
    before = contents(store)
    assert len(before) == 8 + 8
    again = swept(store, *SMALL, "--keep")
    assert {**again, "seconds": 0} == {**said, "run_now": 0, "seconds": 0}
    assert contents(store) == before
    assert swept(store, *SMALL, "--keep", "--stepper", "rk4")["run_now"] == 4


@pytest.mark.rotating(3, in_turn=True)
def test_fresh_starts_over_and_deletes_nothing(store: Path) -> None:
    """The older generation stays, though only the newer one is shown, which is the same byte for byte."""
    before = contents(store)
    assert swept(store, *SMALL, "--keep", "--fresh")["run_now"] == 8
    assert (len(rows(store, {})), len(rows(store, {}, retired=True))) == (8, 16)
    after = contents(store)
    assert {*before} < {*after}
    assert [(key, answer) for key, generation, answer, _ in before[:8]] == [
        (key, answer) for key, generation, answer, _ in after[:16] if generation == 1
    ]
    files = {Path(name).name: content for name, content in after[16:]}
    assert all(files[f"{key}-0.npz"] == files[f"{key}-1.npz"] for key, *_ in before[:8])
    assert swept(store, *SMALL, "--keep", "--resume")["run_now"] == 0


@pytest.mark.rotating(3, in_turn=True)
def test_what_was_stopped_at_a_limit_is_run_again_at_another(tmp_path: Path) -> None:
    """But not at the same one; the tally says what the limit was."""
    store = tmp_path / "store.sqlite"
    words = ("sweep", "--stepper", "heun", "--over", "masses=2")
    for run_now in (1, 0):
        found = swept(store, *words, "--time-limit", "1e-4")
        assert (found["run_now"], found["outcomes"]) == (run_now, {"heun": {"timed out": 1}})
    said = springlab(*words, "--time-limit", "1e-4", "--store", str(store))
    assert "no answer within 0.0001 s" in said.out
    assert swept(store, *words)["outcomes"] == {"heun": {"done": 1}}
    assert [row["outcome"] for row in rows(store, {})] == ["done"]


@pytest.mark.rotating(3, in_turn=True)
def test_dt_is_an_axis_like_others(tmp_path: Path) -> None:
    """As many steps as come nearest to the duration."""
    store = tmp_path / "store.sqlite"
    swept(store, "sweep", "--stepper", "heun", "--over", "dt=1e-4:1e-2:3:log", "--duration", "0.025")
    assert sorted((row["dt"], row["steps"]) for row in rows(store, {})) == [(1e-4, 250), (1e-3, 25), (1e-2, 2)]


@pytest.mark.parametrize(
    ("dt", "duration", "dt_and_steps"),
    [(None, None, (1e-3, 500)), (None, 0.01, (1e-3, 10)), (1e-5, 1e-4, (1e-5, 10)), (1e-3, 0.0026, (1e-3, 3))],
)
def test_a_dt_that_is_not_varied_is_the_one_given_or_the_scenes(
    dt: float | None, duration: float | None, dt_and_steps: tuple[float, int]
) -> None:
    """And so is the duration."""
    (task,) = ParameterSweep("string", find_steppers(["heun"]), {"masses": [2.0]}, {}, dt, duration).tasks()
    assert (task.labels["dt"], task.labels["steps"]) == dt_and_steps


@pytest.mark.rotating(3, in_turn=True)
def test_a_run_is_judged_as_compare_judges_it(tmp_path: Path) -> None:
    """The same distance from the true motion to the last bit, and the same scheme."""
    store = tmp_path / "store.sqlite"
    of = ("--stepper", "heun", "--stepper", "kick_drift", "--duration", "0.05", "--set", "damping=0.1")
    swept(store, "sweep", *of, "--over", "masses=3", "--identify")
    document = json.loads(springlab("compare", *of, "--set", "masses=3", "--json").out)
    wanted = {run["stepper"]: run for run in document["runs"]}
    found = {row["stepper"]: row for row in rows(store, {})}
    for key in ("outcome", "reason", "error_m", "identified_as", "identification_error_m"):
        assert {name: row[key] for name, row in found.items()} == {name: run[key] for name, run in wanted.items()}


@pytest.mark.rotating(3, in_turn=True)
def test_trajectories_are_kept_where_they_are_asked_for(tmp_path: Path) -> None:
    """As a scheme makes them here, to the last bit; otherwise none are, and these are other runs."""
    store = tmp_path / "store.sqlite"
    words = ("sweep", "--stepper", "heun", "--over", "masses=3", "--duration", "0.02")
    swept(store, *words)
    assert not (tmp_path / "arrays").exists()
    assert swept(store, *words, "--keep")["run_now"] == 1
    (row,) = [row for row in rows(store, {}) if row["arrays"]]
    found = read_arrays(tmp_path / "arrays", row["arrays"])
    assert found is not None
    own = simulate(find_scene("string").system({"masses": 3}), find("heun"), 1e-3, 0.02)
    for name in ("times", "positions", "velocities"):
        np.testing.assert_array_equal(found[f"answer.outcome.trajectory.{name}"], getattr(own, name))


@pytest.mark.rotating(3, in_turn=True)
def test_the_tally_says_how_runs_ended_and_the_most_frequent_reason(tmp_path: Path) -> None:
    """A stepper that cannot is a row that says why; the others are run."""
    scene = tmp_path / "mesh.toml"
    scene.write_text(MESH)
    words = ("--stepper", "heun", "--stepper", "lecture_heun_loops", "--over", "dt=1e-3,2e-3", "--duration", "0.01")
    said = springlab("sweep", str(scene), *words, "--store", str(tmp_path / "store.sqlite"))
    assert (said.code, said.err) == (0, "")
    lines = [" ".join(line.split()) for line in said.out.splitlines()]
    assert "heun 2 done -" in lines
    assert any(line.startswith("lecture_heun_loops 2 unsupported ") and "string" in line for line in lines)
    assert "4 runs, 4 of them now, in " in said.out


def test_a_sweep_knows_how_many_runs_it_is() -> None:
    """Without making them."""
    sweep = ParameterSweep("string", find_steppers(["heun", "rk4"]), parse_axes(["masses=2:11:10", "mass=1:2:100"]), {})
    assert len(sweep) == 2000
    assert (
        sum(1 for _ in ParameterSweep("string", find_steppers(["heun"]), parse_axes(["masses=2,3"]), {}).tasks()) == 2
    )


def test_what_is_varied_and_set_is_told_with_every_run() -> None:
    """As numbers, where it is numbers."""
    sweep = ParameterSweep(
        "string", find_steppers(["heun"]), {"stiffness": [150.0]}, {"masses": "2", "mass": "0.01,0.02"}
    )
    (task,) = sweep.tasks()
    assert task.parameters == {"scene": "string", "masses": 2.0, "mass": "0.01,0.02", "stiffness": 150.0}
