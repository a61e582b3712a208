"""What experiments say is made from their numbers: other numbers, other sentences."""

from __future__ import annotations

import csv
import importlib
import math
from contextlib import chdir
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from engines.process.isolation import EngineStepper
from experiments import divergence, stiff_limit
from experiments.experiment import NAMES, Result, Table, experiments, find, write_tables
from experiments.runs.comparison import Comparison, compare
from reference.pendulum import PendulumMotion
from reference.scenes import Setup
from reference.scenes import find as find_scene
from reference.state import Trajectory
from reference.stepper import Stepper, catalogued
from reference.system import MassSpringSystem
from tests.conformance import doctored
from tests.conformance.doctored import Doctored
from tests.engines.process import misbehaving
from tests.engines.process.misbehaving import Misbehaving
from tests.report.commands.terminal import springlab

SETUP = Setup("string", find_scene("string").system({"masses": 3}), 1e-3, 0.05)

HONEST, STRANGER = (EngineStepper(Doctored(c)) for c in (doctored.KickDrift, doctored.StifferByAMillionth))
CRASHING, LOST = (EngineStepper(Misbehaving(c)) for c in (misbehaving.Segfaults, misbehaving.GoesToNan))


@pytest.fixture(scope="module")
def mixed() -> Comparison:
    """Two schemes, an honest engine, one that is no scheme, one that crashes, one that goes to NaN."""
    steppers: list[Stepper] = [catalogued()["euler"], HONEST, STRANGER, CRASHING, LOST, catalogued()["rk4"]]
    return compare(SETUP, steppers)


def only(comparison: Comparison, *names: str) -> Result:
    """The divergence experiment's answer to some of the runs of a comparison."""
    return divergence.result_of(replace(comparison, runs=tuple(r for r in comparison.runs if r.stepper.name in names)))


def text(result: Result) -> str:
    """Its findings as one text."""
    return " ".join(result.findings)


def test_divergence_counts_the_identified_engines(mixed: Comparison) -> None:
    """One of one; one of two, and the other is named as not identified; none, and that is said."""
    assert "1 of 1 engine settings are identified" in text(only(mixed, "KickDrift"))
    assert "Not identified" not in text(only(mixed, "KickDrift"))
    both = text(only(mixed, "KickDrift", "StifferByAMillionth"))
    assert "1 of 2 engine settings are identified" in both
    assert "Not identified: StifferByAMillionth (nearest kick_drift at " in both
    assert text(only(mixed, "StifferByAMillionth")) == "No engine ran that could be identified."


def test_divergence_quotes_the_numbers_of_its_runs(mixed: Comparison) -> None:
    """The honest engine's largest error and its deviation, and the largest of two that are identified."""
    honest = next(run for run in mixed.runs if run.stepper is HONEST)
    assert honest.error is not None
    said = text(only(mixed, "KickDrift"))
    assert f"{honest.error.max():.1e} m from the true motion" in said
    assert f"{honest.identification.error:.1e} m" in said
    louder = replace(honest, error=10 * honest.error)
    assert f"{10 * honest.error.max():.1e} m" in text(divergence.result_of(replace(mixed, runs=(louder,))))


def test_divergence_names_what_did_not_come_to_its_end(mixed: Comparison) -> None:
    """A crash and a NaN are failures with their reasons, rows of the table, and no part of the findings' count."""
    result = divergence.result_of(mixed)
    assert [failure.split(";")[0][:35] for failure in result.failures] == [
        "Segfaults: crashed, killed by SIGSE",
        "GoesToNan: diverged, the position o",
    ]
    assert [row[0] for row in result.tables[0].rows] == [run.stepper.name for run in mixed.runs]
    assert "1 of 2 engine settings" in text(result)


def test_divergence_writes_the_distances_over_time(mixed: Comparison) -> None:
    """One row per run and time; empty where there is no number."""
    table = divergence.result_of(mixed).tables[1]
    assert len(table.rows) == len(mixed.runs) * len(mixed.true.times)
    lost = [row for row in table.rows if row[0] == "GoesToNan"]
    assert lost[0][2] == 0.0
    assert lost[-1][2:] == [None, None]


@pytest.mark.rotating(5, in_turn=True)
def test_the_stiff_limit_is_approached_as_one_over_the_stiffness(monkeypatch: pytest.MonkeyPatch) -> None:
    """The distance from the pendulum falls as stiffness to the power -1 (predicted), to 0.1 over these three.

    The next term is of relative order 1/k: at 2e4 N/m some percent, hence the tolerance.
    """
    monkeypatch.setattr(stiff_limit, "STIFFNESSES", (2e2, 2e3, 2e4, 1e5, 4e5))
    result = stiff_limit.run(lambda _: None)
    assert result.data["slope"] == pytest.approx(-1, abs=0.1)
    assert f"to the power {result.data['slope']:.2f}" in text(result)


def test_the_stiff_limit_without_its_engine_and_with_other_numbers_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Strings that come as k^(-1/2) only, and an engine that crashes: the power, and no word of the cable."""

    def doctored_motion(
        system: MassSpringSystem, dt: float, steps: int, changes: object = (), equations: object = None
    ) -> Trajectory:
        apart = 0.0 if equations is PendulumMotion else 1 / math.sqrt(system.stiffness[0])
        positions = np.full((steps + 1, *system.positions.shape), apart)
        return Trajectory(np.array([dt * i for i in range(steps + 1)]), positions, np.zeros_like(positions))

    monkeypatch.setattr(stiff_limit, "exact", doctored_motion)
    monkeypatch.setattr(stiff_limit, "find_engine", lambda _: Misbehaving(misbehaving.Segfaults))
    result = stiff_limit.run(lambda _: None)
    assert "to the power -0.50" in text(result)
    assert "cable" not in text(result).lower()
    assert {row[2] for row in result.tables[0].rows} == {None}
    assert len(result.failures) == 1
    assert "SIGSEGV" in result.failures[0]


def test_tables_are_written_as_csv(tmp_path: Path) -> None:
    """Headings with units, full precision, nothing where there is nothing."""
    result = Result(["..."], [Table("numbers", ["name", "length [m]"], [["a, b", 0.1 + 0.2], ["c", None]])])
    (file,) = write_tables(result, tmp_path / "new")
    assert file.name == "numbers.csv"
    with file.open(newline="") as opened:
        assert list(csv.reader(opened)) == [["name", "length [m]"], ["a, b", repr(0.1 + 0.2)], ["c", ""]]


@pytest.mark.parametrize("name", NAMES)
def test_every_experiment_is_a_question_with_a_name(name: str) -> None:
    """The name is its module's; the question is a sentence with a question mark; slides are named."""
    experiment = find(name)
    assert experiment is experiments()[name]
    assert experiment is importlib.import_module(f"experiments.{name}").EXPERIMENT
    assert experiment.name == name
    assert experiment.question.endswith("?")
    assert experiment.title
    assert experiment.slides


@pytest.fixture(scope="module")
def errata(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, str], float]:
    """What `springlab run errata` writes into results of its working folder, by slide and measurement."""
    folder = tmp_path_factory.mktemp("errata")
    with chdir(folder):
        said = springlab("run", "errata")
    assert said.code == 0, said.err
    assert find("errata").question in " ".join(said.out.split())
    with (folder / "results" / "errata" / "errata.csv").open(newline="") as opened:
        return {(row["slide"], row["measured"]): float(row["value"]) for row in csv.DictReader(opened)}


@pytest.mark.rotating(3, in_turn=True)
def test_errata_shows_that_slide_11_is_slide_7(errata: dict[tuple[str, str], float]) -> None:
    """Deviation exactly 0, from slide 7 and from the catalogue's Heun."""
    assert errata["11", "distance from slide 7, 500 steps"] == 0
    assert errata["11", "distance from the scheme it is identified as, heun"] == 0


@pytest.mark.rotating(3, in_turn=True)
def test_errata_shows_what_overwriting_costs_and_gives(errata: dict[tuple[str, str], float]) -> None:
    """Order 1 in place of 2, within 0.05; and larger stable steps, as in tests/reference/schemes/test_in_place.py."""
    orders = {"euler": 1, "euler_in_place": 1, "heun": 2, "heun_link_by_link": 1, "heun_aliased": 1}
    for name, order in orders.items():
        assert errata["7-11", f"order of {name}"] == pytest.approx(order, abs=0.05)
    for right, wrong in (("euler", "euler_in_place"), ("heun", "heun_link_by_link")):
        assert errata["7-11", f"largest stable dt, {wrong}"] > 1.2 * errata["7-11", f"largest stable dt, {right}"]


def test_errata_shows_the_barriers_rule_and_the_two_forces(errata: dict[tuple[str, str], float]) -> None:
    """Slide 17 turns sliding motion round at the side: (v_x t_x, v_y t_y) with t = (0, -1) and v = (0, 1) is (0, -1).

    Slide 4's force at rest is -2 k D0 = -50 N where it should vanish; slide 9's function leaves the lower spring out,
    so that of a string at rest the top link accelerates by the weight below it, (n - 1) g = 88.29 m/s^2 upwards.
    """
    assert errata["17", "of 1 m/s along the circle, left at the right"] == -1
    assert errata["17", "of 1 m/s, left anywhere"] == pytest.approx(1, abs=1e-15)
    assert errata["4", "force at rest"] == pytest.approx(-2 * 200 * 0.125)
    assert errata["4", "force at rest, repaired"] == pytest.approx(0, abs=1e-12)
    assert errata["9", "acceleration of the top link, hanging at rest"] == pytest.approx(9 * 9.81)
    assert errata["9-10", "acceleration of the top link, repaired"] == pytest.approx(0, abs=1e-10)
