"""Public cases of springs that are not linear, each by one command: a rope that snatches, a chain that breaks."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.report.commands.terminal import springlab


def run_of(*words: str) -> list[dict[str, Any]]:
    """The runs that a command tells of, as JSON."""
    said = springlab("simulate", *words, "--json")
    assert said.code == 0, said.err
    runs: list[dict[str, Any]] = json.loads(said.out)["runs"]
    return runs


@pytest.mark.rotating(3, in_turn=True)
def test_a_rope_that_is_slack_snatches_the_mass_that_falls_into_it() -> None:
    """M 80 kg falls h = 4 m and is caught by k = 2 kN/m: F = m g + sqrt((m g)^2 + 2 k m g h), of its energy.

    The textbook's fall factor formula, with h / L = 0.4. In an engine of another order it is the same to the steps'
    error; shown to fail without the rope's slack, where the start is 4 m of compression and the fall a swing.
    """
    words = ["mass=80", "stiffness=2000", "rest_length=10", "stretch=-4", "gravity=9.81"]
    scene = ["oscillator", "--dt=5e-4", "--duration=2.5", *(f"--set={word}" for word in words)]
    weight = 80 * 9.81
    force = weight + np.sqrt(weight**2 + 2 * 2000 * weight * 4)
    runs = run_of(
        *scene, "--set=tension_only=1", "--stepper=rk4", "--stepper=pymunk_springs", "--stepper=mujoco_tendons"
    )
    for run in runs:
        assert run["largest_tension_n"] == pytest.approx(force, rel=2e-4)
        assert run["largest_compression_n"] is None
    # slack while it falls: free fall for sqrt(2 h / g) = 0.903 s
    (before,) = run_of(*scene[:1], "--duration=0.9", *scene[3:], "--set=tension_only=1", "--stepper=rk4")
    assert before["velocities_m_s"][1] == pytest.approx([-9.81 * 0.9], rel=1e-9)
    assert before["spring_forces_n"] == [0.0]
    (wrong,) = run_of(*scene, "--stepper=rk4")
    assert wrong["largest_tension_n"] != pytest.approx(force, rel=0.1)


@pytest.mark.rotating(3, in_turn=True)
def test_a_chain_breaks_where_its_tension_is_largest_and_is_told(tmp_path: Path) -> None:
    """Let go unstretched, at its top, at the same step in the reference's scheme and the engine of it; files have it.

    A table of springs has no stretch and no force of what is gone, from the step after on.
    """
    runs = run_of("chain", "--set=masses=5", "--set=breaking_force=1.5", *("--out", str(tmp_path)),
                  "--stepper=drift_kick", "--stepper=pymunk_springs")  # fmt: skip
    for run in runs:
        (broke,) = run["breaks"]
        assert broke["spring"] == 0
        assert broke["tension_n"] == run["largest_tension_n"] > 1.5
        assert (run["stretch"][0], run["spring_forces_n"][0]) == (None, 0.0)
        assert broke == runs[0]["breaks"][0]
    with (tmp_path / "drift_kick-springs.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["spring"] == "0"]
    gone = [row for row in rows if float(row["time"]) > runs[0]["breaks"][0]["time_s"]]
    assert gone
    assert all(np.isnan(float(row["stretch"])) and float(row["force"]) == 0 for row in gone)
    assert not any(np.isnan(float(row["stretch"])) for row in rows[: -len(gone)])


def test_the_lower_end_of_a_falling_slinky_waits_for_the_wave() -> None:
    """Let go at its top, M 1 kg and K 10 N/m: for sqrt(M/K) = 0.316 s, here between 0.3 and 0.335 s.

    What disperses of the wave on 100 masses comes by 5 % early and late. At 0.3 s it has not come down by a thousandth
    of the 0.49 m that the slinky hangs, which in free fall takes 0.01 s; 0.035 s later by a tenth.
    """
    scene = ["slinky", "--set=masses=100", "--stepper=kick_drift", "--dt=5e-4"]
    (early,), (late,) = (run_of(*scene, f"--duration={end}") for end in (0.3, 0.335))
    length = 9.81 / (2 * 10)
    lowest = [run["positions_m"][-1][0] for run in (early, late)]
    hung = -length * (1 - 1 / 100) * 100 / 99
    assert lowest[0] == pytest.approx(hung, abs=1e-3 * length)
    assert lowest[1] < hung - 0.1 * length


def test_a_stiffness_that_is_set_later_brings_back_no_spring() -> None:
    """In the reference and in engines: spring 0 is gone, and carries nothing at the end."""
    scene = ["chain", "--set=masses=5", "--set=breaking_force=1.5", "--change=0.15:stiffness=210", "--duration=0.3"]
    runs = run_of(*scene, "--stepper=drift_kick", "--stepper=pymunk_springs")
    for run in runs:
        assert run["breaks"][0]["spring"] == 0
        assert run["breaks"][0]["time_s"] < 0.15
        assert run["spring_forces_n"][0] == 0.0
        assert np.array(run["positions_m"]) == pytest.approx(np.array(runs[0]["positions_m"]), abs=1e-12)


def test_the_summary_names_what_broke() -> None:
    """And says none where nothing did."""
    said = springlab("simulate", "chain", "--set", "masses=3", "--set", "breaking_force=0.7", "--duration", "0.3")
    assert "springs that broke" in said.out
    assert " 0 at t = " in said.out


def test_what_a_change_breaks_is_told_with_what_breaks_by_itself() -> None:
    """Spring 0 too weak, then spring 3 cut: each once, with its step; a spring that is gone breaks no more."""
    scene = ["chain", "--set=masses=5", "--set=breaking_force=1.5", "--change=0.2:break=0,3", "--duration=0.3"]
    (run,) = run_of(*scene, "--stepper=drift_kick")
    told = [(b["spring"], b["by_change"]) for b in run["breaks"]]
    assert told == [(0, False), (3, True)]
    assert run["breaks"][1]["time_s"] == pytest.approx(0.2, abs=1e-12)
