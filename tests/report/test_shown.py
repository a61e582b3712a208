"""Answers as tables, by their columns, from answers that are made up."""

from __future__ import annotations

from math import nan, pi
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from report import shown

SETUP = SimpleNamespace(name="string", dt=0.001, run_duration=2.0, duration=2.0, steps=2000)


def columns(table: shown.Shown) -> dict[str, list[Any]]:
    """The cells under each heading."""
    return {name: [row[i] for row in table.rows] for i, name in enumerate(table.columns)}


def of_natural(**fields: Any) -> Any:
    """Two modes: 4 Hz, of which the damping is known, and one of what nothing holds."""
    natural = SimpleNamespace(frequencies=np.array([0.0, 4.0]), damping_ratios=np.array([nan, 0.25]), coupled=0.0)
    return SimpleNamespace(setup=SETUP, natural=natural, about="", **fields)


def test_modes_have_their_frequencies_periods_and_damping() -> None:
    """Angular frequency 2 pi f, period 1/f; what is not there is no number."""
    table = shown.of_modes(of_natural())
    assert columns(table) == {
        "mode": ["1", "2"],
        "frequency [Hz]": [0.0, 4.0],
        "angular [rad/s]": [0.0, 8 * pi],
        "period [s]": [None, 0.25],
        "damping ratio": [None, 0.25],
    }
    assert not table.notes


def test_modes_that_damping_couples_are_told() -> None:
    """And what rest they are about."""
    modes = of_natural()
    modes.natural.coupled, modes.about = 0.123, "modes on the ground"
    first, second = shown.of_modes(modes).notes
    assert "12.3%" in first
    assert "modes on the ground" in second


def test_springs_at_rest_pull_push_or_do_neither() -> None:
    """By the sign of their force."""
    system = SimpleNamespace(springs=np.array([[0, 1], [1, 2], [2, 5]]))
    setup = SimpleNamespace(system=system)
    table = shown.of_springs_at_rest(SimpleNamespace(setup=setup, forces=np.array([2.5, -1.5, 0.0])))  # type: ignore[arg-type]
    assert columns(table) == {
        "spring": ["0", "1", "2"],
        "masses": ["0 - 1", "1 - 2", "2 - 5"],
        "force [N]": [2.5, -1.5, 0.0],
        "": ["tension", "compression", "none"],
    }


def test_angular_springs_have_their_bend_and_torque() -> None:
    """One that is gone has none."""
    system: Any = SimpleNamespace(angular_springs=SimpleNamespace(masses=np.array([[0, 1, 2], [1, 2, 3]])))
    table = shown.of_bends(system, np.array([0.5, nan]), np.array([-2.0, 0.0]), "at rest")
    assert columns(table) == {
        "spring": ["0", "1"],
        "masses": ["0 - 1 - 2", "1 - 2 - 3"],
        "bend [rad]": [0.5, "gone"],
        "torque [N m]": [-2.0, 0.0],
    }
    straight: Any = SimpleNamespace(angular_springs=None)
    assert not shown.of_bends(straight, np.empty(0), np.empty(0), "at rest").rows


@pytest.mark.parametrize(("asked", "said"), [(2.0, False), (2.0004, True)])
def test_a_duration_that_is_no_whole_number_of_steps_is_told(asked: float, said: bool) -> None:
    """With how many steps it is."""
    title = shown.title_of(SimpleNamespace(**{**vars(SETUP), "duration": asked}))  # type: ignore[arg-type]
    assert title.startswith("string: dt = 0.001 s, 2 s")
    assert ("2000 whole steps" in title) == said


@pytest.mark.parametrize(("single_steps", "heading"), [(False, "deviation [m]"), (True, "deviation in a step [m]")])
def test_an_identification_lists_the_catalogue(single_steps: bool, heading: str) -> None:
    """Nearest first, as it comes; an error that is no number is none."""
    matches = [
        SimpleNamespace(scheme="heun", error=1e-16, steps=100),
        SimpleNamespace(scheme="rk4", error=nan, steps=7),
    ]
    found: Any = SimpleNamespace(ranking=matches, by_single_steps=single_steps, remark="a tie")
    table = shown.of_identification(found)
    assert columns(table) == {"scheme": ["heun", "rk4"], heading: [1e-16, None], "over [steps]": [100, 7]}
    assert list(table.notes) == ["a tie"]


def of_run(**fields: Any) -> Any:
    """A run of a simulation, done, in which nothing went or broke but what is said."""
    parts = {"sag": None, "stretched": None, "tension": None, "compression": None, "forces": np.zeros(1), "breaks": []}
    motion = SimpleNamespace(
        energy_at_start={"total": 1.25},
        energy={"total": -3.5, "kinetic": 0.5, "elastic": 1.0, "gravitational": -5.0},
        momentum=np.array([0.25, -1.5]),
        **{**parts, **fields},
    )
    outcome = SimpleNamespace(ending="done", reason="")
    return SimpleNamespace(stepper=SimpleNamespace(name="heun"), outcome=outcome, motion=motion, blew_up_at=None)


def told(*runs: Any) -> shown.Shown:
    """What is shown of a simulation."""
    return shown.of_simulation(SimpleNamespace(setup=SETUP, runs=runs))  # type: ignore[arg-type]


def largest(value: float, which: int, time: float) -> Any:
    """One of a simulation's largest numbers."""
    return SimpleNamespace(value=value, which=which, time=time)


def test_a_simulation_tells_what_was_largest_where_and_when() -> None:
    """With units; energies at the start and at the end, and of what they are."""
    run = of_run(
        sag=largest(0.125, 3, 0.5), stretched=largest(0.25, 2, 0.75), tension=largest(12.5, 1, 1.0), compression=None
    )
    assert dict(told(run).rows) == {
        "outcome": "done",
        "blew up at [s]": None,
        "largest sag": "0.125 m, mass 3, t = 0.5 s",
        "largest stretch": "0.25 m, spring 2, t = 0.75 s",
        "largest tension": "12.5 N, spring 1, t = 1 s",
        "largest compression": "none",
        "springs that broke": "none",
        "energy at the start [J]": "1.25",
        "energy at the end [J]": "-3.5",
        "of it kinetic, elastic, gravitational [J]": "0.5, 1, -5",
        "momentum at the end [kg m/s]": "0.25, -1.5",
    }
    pushed = dict(told(of_run(compression=largest(7.0, 0, 0.25))).rows)
    assert pushed["largest compression"] == "7 N, spring 0, t = 0.25 s"


def test_forces_that_are_not_known_are_not_told() -> None:
    """Such as those of rods."""
    rows = dict(told(of_run(forces=None, tension=largest(1.0, 0, 0.0))).rows)
    assert rows["largest tension"] is rows["largest compression"] is None


def test_the_first_three_springs_that_broke_are_named() -> None:
    """In their order; how many more there are."""
    broke = [SimpleNamespace(which=i, time=0.1 * i, value=2.0 * i, by_change=i == 2) for i in (1, 2, 3, 4, 5)]
    first = "1 at t = 0.1 s, with 2 N; 2 at t = 0.2 s, with 4 N, by a change; 3 at t = 0.3 s, with 6 N"
    for count, wanted in ((3, first), (5, f"{first}; and 2 more")):
        assert dict(told(of_run(breaks=broke[:count])).rows)["springs that broke"] == wanted


def test_what_did_not_come_to_its_end_is_told_below() -> None:
    """A column for each; one that blew up has its time, one whose step had no solution has no numbers."""
    wild, lost, well = of_run(), of_run(), of_run()
    wild.outcome, wild.blew_up_at = SimpleNamespace(ending="diverged", reason="it blew up"), 0.25
    lost.outcome, lost.motion = SimpleNamespace(ending="diverged", reason="no solution"), None
    wild.stepper, lost.stepper = SimpleNamespace(name="euler"), SimpleNamespace(name="hht")
    table = told(wild, lost, well)
    assert list(table.columns) == ["", "euler", "hht", "heun"]
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["outcome"] == ["diverged", "diverged", "done"]
    assert rows["blew up at [s]"] == [0.25, "no: see below", None]
    assert rows["largest sag"] == ["none", None, "none"]
    assert table.notes == ["euler: diverged: it blew up", "hht: diverged: no solution"]


def test_a_comparison_has_its_errors_in_metres() -> None:
    """Each number under its heading; where the true motion is not known, why."""
    keys = ["stepper", "outcome", "error_m", "identified_as", "identification_error_m"]
    row = dict(zip(keys, ["pymunk_springs", "done", 1e-3, "drift_kick", 2e-15], strict=True))
    run: Any = SimpleNamespace(row=row, why="why not")
    comparison: Any = SimpleNamespace(setup=SETUP, runs=(), why_no_true_motion="it collides")
    assert shown.of_comparison(comparison).notes == ["No error is known: it collides."]
    comparison.runs, comparison.why_no_true_motion = (run,), None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("experiments.runs.comparison.remarks", lambda runs: ["a remark"])
        table = shown.of_comparison(comparison)
    assert columns(table) == {
        "stepper": ["pymunk_springs"],
        "outcome": ["done"],
        "error [m]": [1e-3],
        "identified as": ["drift_kick"],
        "deviation [m]": [2e-15],
        "reason": ["why not"],
    }
    assert table.notes == ["a remark"]
