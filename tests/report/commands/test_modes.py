"""`springlab modes`: what it prints, what it writes, and each of its options."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from math import nan
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.simulation.modes_of_scene import StepperSwing, Swing
from report.commands.modes import _show_swings
from tests.report.commands.terminal import springlab
from tests.report.commands.test_simulate import table


def modes(masses: int, *words: str, scene: str = "chain") -> str:
    """What is printed of a chain of masses."""
    said = springlab("modes", scene, "--set", f"masses={masses}", *words)
    assert said.code == 0
    return said.out


def hanging(masses: int, stiffness: float, mass: float) -> np.ndarray:
    """Frequencies of a chain that is held at one end: 2 sqrt(k/m) sin((2 i - 1) pi / (4 n + 2)) / (2 pi) [Hz]."""
    i = np.arange(1, masses + 1)
    return np.sqrt(stiffness / mass) * np.sin((2 * i - 1) * np.pi / (4 * masses + 2)) / np.pi


def test_frequencies_are_those_of_a_chain() -> None:
    """In Hz, with angular frequency and period, the slowest first."""
    heading, *rows = table(
        modes(3, "--set", "stiffness=100", "--set", "mass=0.5"), "chain: natural modes about its rest"
    )
    assert " ".join(heading) == "mode frequency [Hz] angular [rad/s] period [s] damping ratio"
    numbers = np.array(rows, dtype=float)
    found = hanging(3, 100.0, 0.5)
    assert numbers[:, 1] == pytest.approx(found, rel=5e-3)
    assert numbers[:, 2] == pytest.approx(2 * np.pi * found, rel=5e-3)
    assert numbers[:, 3] == pytest.approx(1 / found, rel=5e-3)


@pytest.mark.parametrize(
    ("masses", "words", "wanted"),
    [
        (20, (), []),
        (21, (), ["20 of 21 modes are shown; --json has 21.", "20 of 21 springs are shown; --json has all."]),
        (4, ("--lowest", "3"), ["3 of 4 modes are shown; --json has 3."]),
        (22, ("--lowest", "21"), ["20 of 22 modes are shown; --json has 21."]),
    ],
)
def test_twenty_are_shown_and_how_many_there_are_is_told(
    masses: int, words: tuple[str, ...], wanted: list[str]
) -> None:
    """Of modes and of springs; nothing is said where all are."""
    said = modes(masses, *words)
    assert [line for line in said.splitlines() if "shown" in line][: len(wanted)] == wanted
    assert bool(wanted) == ("shown" in said)
    assert len(table(said, "chain: natural modes about its rest")) == 1 + min(20, int(words[1]) if words else masses)
    assert len(table(said, "Springs at rest")) == 1 + min(20, masses)
    assert "Angular springs" not in said


def test_what_a_stepper_makes_of_the_modes_stands_beside_them() -> None:
    """Explicit Euler: undamped it drives each mode by its own step; predicted and measured, at the dt of the scene."""
    out = modes(2, "--stepper", "euler", "--set", "stiffness=100", "--set", "mass=0.5", "--dt", "0.01")
    heading, *rows = table(out, "What steppers make of the modes at dt = 0.01 s")
    assert " ".join(heading).startswith(
        "stepper mode natural [Hz] predicted [Hz] measured [Hz] predicted damping ratio"
    )
    natural = hanging(2, 100.0, 0.5)
    rates = np.log(1 + 2j * np.pi * natural * 0.01) / 0.01
    assert [row[:2] for row in rows] == [["euler", "1"], ["euler", "2"]]
    numbers = np.array([row[2:7] for row in rows], dtype=float)
    assert numbers[:, 0] == pytest.approx(natural, rel=5e-3)
    for column, wanted in ((1, rates.imag / (2 * np.pi)), (3, -rates.real / np.abs(rates))):
        assert numbers[:, column] == pytest.approx(wanted, rel=1e-2)
        assert numbers[:, column + 1] == pytest.approx(wanted, rel=1e-2)


def test_as_what_an_engine_is_predicted_is_told_where_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    """Of each stepper once; of a scheme, and of what is not predicted, nothing. Of modes beyond those shown no row."""
    natural = SimpleNamespace(frequencies=np.array([2.0, 8.0, 16.0]))
    made: Any = [
        StepperSwing("engine", 0, Swing(2.5, 0.25), Swing(2.25, nan), "odd", "heun"),
        StepperSwing("engine", 1, Swing(7.5, 0.125), None, "", "heun"),
        StepperSwing("lost", 1, None, Swing(7.0, 0.5), "no step", "rk4"),
        StepperSwing("euler", 2, Swing(15.0, -0.5), None),
    ]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("report.commands.modes.SHOWN", 2)
        _show_swings(SimpleNamespace(setup=SimpleNamespace(dt=0.5), natural=natural), made)  # type: ignore[arg-type]
    said = capsys.readouterr().out
    _, *rows = table(said, "What steppers make of the modes at dt = 0.5 s")
    assert rows == [
        ["engine", "1", "2", "2.5", "2.25", "0.25", "-", "odd"],
        ["engine", "2", "8", "7.5", "-", "0.125", "-"],
        ["lost", "2", "8", "-", "7", "-", "0.5", "no", "step"],
    ]
    assert [line for line in said.splitlines() if "predicted as" in line] == [
        "engine is predicted as heun, as which it is identified here."
    ]


def test_angular_springs_are_told_where_there_are_some(monkeypatch: pytest.MonkeyPatch) -> None:
    """One at every mass where two springs meet; where not all of them are shown, how many there are."""
    bent = ("--set", "angular_stiffness=0.2")
    said = modes(3, *bent, scene="string")
    assert len(table(said, "Angular springs at rest")) == 1 + 2
    assert "angular springs are shown" not in said
    monkeypatch.setattr("report.commands.modes.SHOWN", 1)
    said = modes(3, *bent, scene="string")
    assert len(table(said, "Angular springs at rest")) == 1 + 1
    assert "1 of 2 angular springs are shown; --json has all." in said


def test_json_has_each_stepper_and_each_mode() -> None:
    """Only where a stepper is named."""
    assert "steppers" not in json.loads(modes(2, "--json"))
    told = json.loads(modes(2, "--json", "--stepper", "euler", "--stepper", "rk4"))["steppers"]
    assert [(one["stepper"], one["mode"]) for one in told] == [("euler", 0), ("euler", 1), ("rk4", 0), ("rk4", 1)]
    for one in told:
        assert {"predicted", "measured", "identified_as", "reason"} <= one.keys()
        assert one["measured"]["frequency_hz"] == pytest.approx(one["predicted"]["frequency_hz"], rel=1e-3)


def test_a_picture_and_a_table_are_written(tmp_path: Path) -> None:
    """Into a folder that is made; the table has what is printed, with all its figures."""
    out = tmp_path / "new" / "out"
    said = springlab("modes", "chain", "--set", "masses=3", "--set", "drag=0.1", "--out", str(out))
    assert said.err.splitlines() == [f"written: {out / name}" for name in ("chain-modes.svg", "chain-modes.csv")]
    assert (out / "chain-modes.svg").read_text().startswith("<svg")
    with (out / "chain-modes.csv").open() as file:
        heading, *rows = csv.reader(file)
    assert heading == ["mode", "frequency [Hz]", "damping ratio"]
    document = json.loads(springlab("modes", "chain", "--set", "masses=3", "--set", "drag=0.1", "--json").out)
    assert [int(row[0]) for row in rows] == [1, 2, 3]
    assert [float(row[1]) for row in rows] == document["frequencies_hz"]
    assert [float(row[2]) for row in rows] == document["damping_ratios"]
    assert all(float(row[2]) > 0 for row in rows)


def test_a_film_is_written_beside_the_picture_and_the_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of one swing in a second: as many pictures as it has in one."""
    made: list[tuple[Path, float]] = []

    def write_film(part: Path, path: Path, frames: Iterator[object], rate: float) -> None:
        part.write_bytes(b"GIF8")
        made.append((path, rate))

    monkeypatch.setattr("report.film.film_file.write_film", write_film)
    said = springlab("modes", "chain", "--set", "masses=2", "--animate", "--out", str(tmp_path))
    files = [tmp_path / f"chain-modes.{ending}" for ending in ("svg", "csv", "gif")]
    assert said.err.splitlines() == [f"written: {file}" for file in files]
    assert [file.read_bytes()[:4] for file in files] == [b"<svg", b"mode", b"GIF8"]
    assert made == [(files[-1], 25)]
