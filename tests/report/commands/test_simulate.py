"""`springlab simulate`: what it prints, what it writes, and each of its options."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from reference.scenes import find
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate
from tests.report.commands.terminal import springlab

#: Three masses for twenty steps; the first is held.
WORDS = ("simulate", "string", "--set", "masses=3", "--dt", "1e-3", "--duration", "0.02")


def table(text: str, title: str) -> list[list[str]]:
    """The cells of the table below a title, with its headings."""
    _, _, below = text.partition(f"{title}\n")
    lines = below.splitlines()[1:]
    rows = [line.split() for line in lines[: next(i for i, line in enumerate(lines) if not line.strip())]]
    return [row for row in rows if not set("".join(row)) <= set("─")]


def test_where_masses_are_in_the_end_is_shown() -> None:
    """Each with its place and velocity, as the scheme has them; Heun steps where nobody else is named."""
    said = springlab(*WORDS)
    motion = simulate(find("string").system({"masses": 3}), find_scheme("heun"), 1e-3, 0.02)
    heading, *rows = table(said.out, "heun, t = 0.02 s")
    assert heading == ["mass", "x", "[m]", "y", "[m]", "vx", "[m/s]", "vy", "[m/s]"]
    numbers = np.array(rows, dtype=float)
    assert numbers[:, 0].tolist() == [0, 1, 2, 3]
    assert numbers[:, 1:3] == pytest.approx(motion.positions[-1], rel=1e-2)
    assert numbers[:, 3:] == pytest.approx(motion.velocities[-1], rel=1e-2, abs=1e-5)
    assert (said.code, said.err) == (0, "")
    assert "Angular springs" not in said.out
    bent = springlab(*WORDS, "--set", "angular_stiffness=0.2").out
    assert len(table(bent, "Angular springs under heun then")) == 1 + 2


@pytest.mark.parametrize(("masses", "listed"), [(29, True), (30, False)])
def test_no_more_than_thirty_masses_are_listed(masses: int, listed: bool) -> None:
    """And one is held besides those that are asked for."""
    said = springlab("simulate", "string", "--set", f"masses={masses}", "--dt", "1e-3", "--duration", "1e-3")
    assert "string: dt = 0.001 s, 0.001 s" in said.out
    assert ("vx [m/s]" in said.out) == listed


def test_a_stepper_that_is_named_twice_runs_once() -> None:
    """In the order they are named first; JSON has each."""
    said = springlab(*WORDS, *(f"--stepper={name}" for name in ("rk4", "euler", "rk4")), "--json")
    assert [run["stepper"] for run in json.loads(said.out)["runs"]] == ["rk4", "euler"]


def test_files_are_written_where_they_are_asked_for(tmp_path: Path) -> None:
    """Each is said on standard error, and is there; of every so many steps only, and of the last."""
    out = tmp_path / "new" / "out"
    words = ("--out", str(out), "--every", "8", "--plot", "paths", "--plot", "2:y", "--animate", "--json")
    said = springlab(*WORDS, "--stepper", "heun", "--stepper", "euler", *words)
    written = [Path(line.removeprefix("written: ")) for line in said.err.splitlines()]
    kinds = ("masses.csv", "springs.csv", "arrays.npz", "frames.pvd")
    assert [file.name for file in written] == [
        "simulate.json",
        *(f"{name}-{kind}" for name in ("heun", "euler") for kind in kinds),
        "string-paths.svg",
        "string-mass-2-y.svg",
        "string.gif",
    ]
    assert all(file.parent == out and file.stat().st_size > 0 for file in written)
    assert json.loads((out / "simulate.json").read_text()) == json.loads(said.out)
    times = {line.split(",")[0] for line in (out / "heun-masses.csv").read_text().splitlines()[1:]}
    assert sorted(map(float, times)) == pytest.approx([0.0, 0.008, 0.016, 0.02])


def test_pictures_go_into_results_where_no_folder_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And nothing else does: no tables, no film."""
    monkeypatch.chdir(tmp_path)
    said = springlab(*WORDS, "--plot", "energy")
    assert said.code == 0
    assert [file.name for file in tmp_path.rglob("*") if file.is_file()] == ["string-energy.svg"]
    assert said.err == "written: results/simulate/string-energy.svg\n"
    assert (tmp_path / "results" / "simulate" / "string-energy.svg").read_text().startswith("<svg")


def test_much_memory_and_many_rows_are_told_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With how many masses and steps, and rows: of four masses and three springs at 21 times; no word of fewer."""
    monkeypatch.setattr("report.commands.simulate.TOLD_FROM", 1000)
    monkeypatch.setattr("report.commands.simulate.MANY_ROWS", 50)
    said = springlab(*WORDS, "--out", str(tmp_path))
    assert said.err.startswith("springlab: 4 masses, 20 steps: ")
    assert "GiB of memory\n" in said.err
    assert "springlab: 147 rows for heun; --every N makes fewer\n" in said.err
    monkeypatch.setattr("report.commands.simulate.MANY_ROWS", 147)
    assert "rows for heun" not in springlab(*WORDS, "--out", str(tmp_path)).err


def test_a_run_that_blows_up_is_told_and_is_no_failure() -> None:
    """When, and what it was; the exit code is that of an answer."""
    said = springlab("simulate", "string", "--stepper", "euler", "--dt", "0.05", "--duration", "5")
    assert said.code == 0
    assert "euler: diverged: " in said.out
    assert "diverged" in next(line for line in said.out.splitlines() if "outcome" in line)


@pytest.mark.parametrize(("room", "told"), [(2**28, False), (2**28 + 1, True), (3 * 2**30, True)])
def test_much_memory_is_told_in_gibibytes(room: int, told: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """From a quarter of one on."""
    monkeypatch.setattr("experiments.runs.room.room_of", lambda *asked: room)
    said = springlab(*WORDS)
    words = f"springlab: 4 masses, 20 steps: {'3' if room > 2**30 else '0.25'} GiB of memory\n"
    assert said.err == (words if told else "")
