"""The dt for a wanted accuracy, by hand: from errors and orders that are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.advice import own_scene
from experiments.advice.accuracy import PART, Accurate, accurate_steps, sentences, table
from experiments.advice.advice import ADVISED, rounded_down
from experiments.runs.comparison import Comparison, Run
from reference.scenes import Setup, find
from reference.system import MassSpringSystem
from tests.experiments.canned import advice, divergence
from tests.experiments.canned.divergence import ran

SETUP = Setup("mine", find("string").system({"masses": 3}), 1e-3, 0.02)
SIZE = SETUP.system.size


def found(*runs: Run, safe: float | None = None) -> list[Accurate]:
    """Of runs on the string; the first is advised not to go beyond a limit [s]."""
    known = [advice.advised(runs[0].stepper.name, "heun", None, safe, advice.DONE, None)] if safe else []
    return accurate_steps(Comparison(SETUP, None, runs), known)


@pytest.mark.parametrize(("scheme", "order"), [("euler", 1), ("velocity_verlet", 2), ("rk4", 4)])
@pytest.mark.parametrize("part", [16.0, 1 / 16])
def test_the_step_follows_from_the_error_by_the_order(scheme: str, order: int, part: float) -> None:
    """An error 16 times what is asked for is that in a step 16^(1/p) times as short; likewise longer."""
    (one,) = found(ran("an_engine", scheme, part * PART * SIZE))
    assert one == Accurate("an_engine", pytest.approx(part * PART), order, one.dt, False)  # type: ignore[arg-type]
    assert one.dt == rounded_down(SETUP.dt * part ** (-1 / order))


def test_stability_bounds_it() -> None:
    """Where the step that is safe is shorter, and not where it is longer; of others' limits nothing is known."""
    runs = ran("quick", "euler", PART * SIZE / 100), ran("other", "euler", PART * SIZE / 100)
    first, second = found(*runs, safe=0.01)
    assert (first.dt, first.bound) == (rounded_down(ADVISED * 0.01), True)
    assert (second.dt, second.bound) == (pytest.approx(0.1), False)
    (longer,) = found(runs[0], safe=1.0)
    assert (longer.dt, longer.bound) == (pytest.approx(0.1), False)


def test_nothing_is_said_of_who_has_no_error_no_scheme_or_other_equations() -> None:
    """Of no error at all no step follows."""
    none = ran("exact", "heun", 0.0), ran("stranger", None), ran("cable", "pendulum_rk4")
    assert found(*none) == []
    lost = replace(ran("lost", "heun", 1e-3), error=None)
    assert [one.engine for one in found(*none, lost, ran("euler", "euler", 1e-3))] == ["euler"]


def test_a_scene_without_a_size_counts_in_metres() -> None:
    """As of one mass alone."""
    none = np.zeros(0)
    point = MassSpringSystem(
        positions=np.zeros((1, 2)),
        springs=np.zeros((0, 2), int),
        masses=np.ones(1),
        rest_lengths=none,
        stiffness=none,
        damping=none,
        fixed=np.zeros(1, bool),
    )
    compared = Comparison(replace(SETUP, system=point), None, (ran("an_engine", "euler", 0.02),))
    assert [one.error for one in accurate_steps(compared, [])] == [0.02]


def test_what_bounds_the_longest_is_said_and_steps_are_in_seconds() -> None:
    """Only where it is stability."""
    one, other = Accurate("slow", 0.02, 1, 5e-4, True), Accurate("quick", 1e-6, 4, 0.01, False)
    assert "where its stability bounds it" not in sentences([one, other], 1e-3)[0]
    assert sentences([one, replace(other, bound=True)], 1e-3)[0].endswith("0.01 s, where its stability bounds it.")
    assert [*table([one]).columns] == [
        "engine",
        "measured error at the compared dt [of the size]",
        "order",
        "predicted dt for 1% [s]",
        "bounded by",
    ]


@pytest.mark.parametrize("known", [True, False])
def test_a_report_has_the_table_where_there_is_a_step(known: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """And none without a row."""
    runs = [ran("an_engine", "euler" if known else None, 1e-3)]
    monkeypatch.setattr(own_scene, "compare", lambda *_: divergence.of(*runs).data["comparison"])
    result = own_scene.moved(advice.SETUP, advice.only(advice.STABLE), lambda _: None)
    assert ("accuracy" in [table.name for table in result.tables]) == known
