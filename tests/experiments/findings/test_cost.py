"""Costs: wall times, errors and ratios to the anchor, each in its column; the cheapest, the quickest, the slowest."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from experiments.cost import ANCHOR, DT, DURATION, GOAL, MASSES, result_of
from experiments.runs.environment import processor
from tests.experiments.canned import cost
from tests.experiments.canned.cost import STEP
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_each_number_in_its_column() -> None:
    """At the common step: an eighth of the first to the power of the order is what is left of its error."""
    table = {row["stepper"]: row for row in records(cost.usual())}
    slower = {ANCHOR: 1, "rk4": 4, "heun": 200, "mujoco_tendons": 30, "bullet_softbody": 90, "mujoco_flex_rk4": 50}
    assert {name: row["step / anchor's"] for name, row in table.items()} == pytest.approx(slower)
    for name, row in table.items():
        assert row["steps/s [1/s]"] == pytest.approx(1 / slower[name] / STEP)
    flex = table["mujoco_flex_rk4"]
    assert (flex["runs as"], flex["same as"]) == ("engine", "rk4")
    assert flex[f"error, dt {1e3 * DT:g} ms [m]"] == pytest.approx(4e-6 / 8**4)
    assert flex[f"time to {1e3 * GOAL:g} mm [s]"] == pytest.approx(120 * 50 * STEP)
    assert table[ANCHOR][f"time to {1e3 * GOAL:g} mm [s]"] is None


def test_the_table_of_errors_has_every_dt() -> None:
    """Who has blown up has no error."""
    rows = [row for row in records(cost.usual(), "cost_error") if row["stepper"] == "rk4"]
    assert [row["dt [s]"] for row in rows] == [8e-3, 4e-3, 2e-3, 1e-3, 5e-4]
    assert [row["steps"] for row in rows] == [60, 120, 240, 480, 960]
    assert [row["wall time [s]"] for row in rows] == pytest.approx([row["steps"] * 4 * STEP for row in rows])
    assert [row["error [m]"] for row in rows] == [None, *(pytest.approx(4e-6 / 2 ** (4 * i)) for i in range(1, 5))]


def test_the_table_of_sizes_has_ratios_to_the_anchor_at_the_same_size() -> None:
    """As far as each came."""
    rows = [row for row in records(cost.usual(), "cost_masses") if row["stepper"] == "bullet_softbody"]
    assert [row["masses"] for row in rows] == list(MASSES[:3])
    assert [row["step / anchor's"] for row in rows] == pytest.approx([90.0] * 3)
    assert [row["steps/s [1/s]"] for row in rows] == pytest.approx([1 / (90 * STEP * n / 10) for n in MASSES[:3]])


def test_the_cheapest_are_named_with_their_time() -> None:
    """Within a millimetre: rk4's 120 steps of 4 ms, ours and an engine's."""
    scheme, engine = (finding(cost.usual(), f"The cheapest {what} ") for what in ("scheme", "engine"))
    assert numbers(scheme) == pytest.approx([GOAL, 4e-3, 1e3 * 120 * 4 * STEP, DURATION])
    assert numbers(engine) == pytest.approx([GOAL, 4e-3, 1e3 * 120 * 50 * STEP, DURATION])
    assert ("is rk4," in scheme, "is mujoco_flex_rk4," in engine) == (True, True)


def test_the_anchor_s_step_is_in_nanoseconds() -> None:
    """100."""
    assert numbers(finding(cost.usual(), f"the {ANCHOR} kernel", "a step of"))[-2:] == pytest.approx([MASSES[0], 100])


def test_the_quickest_engine_comes_before_the_slowest() -> None:
    """On the smallest string and on the largest that all came to."""
    for masses in (MASSES[0], MASSES[2]):
        said = finding(cost.usual(), f"With {masses} masses")
        assert numbers(said) == pytest.approx([masses, 30, 90])
        assert in_order(said, "30 (mujoco_tendons)", "90 (bullet_softbody)")


def test_engines_errors_are_those_of_their_schemes() -> None:
    """To nothing here, over the runs of all that did not blow up: four of each."""
    assert numbers(finding(cost.usual(), "claims to step by")) == [0, 12]


def test_failures_are_who_did_not_run_and_who_did_not_come_far() -> None:
    """Each with its reason."""
    failures = cost.usual().failures
    assert failures[0] == "Segfaults: crashed, killed by SIGSEGV"
    assert "bullet_softbody: a step would take some 1 s" in failures


def test_without_engines_that_is_said() -> None:
    """And no engine is the cheapest."""
    ours = [priced for priced in cost.costs() if priced.runs_as != "engine"]
    said = result_of(ours).findings
    assert "No engine ran." in said
    assert not [sentence for sentence in said if "cheapest engine" in sentence]
    assert processor() in records(result_of(ours))[0]["processor"]


def test_the_largest_difference_from_a_scheme_is_told_as_a_part_of_its_error() -> None:
    """Half as much again with one dt, a tenth more and less with others; with one the engine alone has blown up."""
    ours = cost.priced("mujoco_tendons", "engine", 30.0, ANCHOR)
    factors = (1.0, math.inf, 1.5, 1.1, 0.9)
    points = [replace(point, error=f * point.error) for f, point in zip(factors, ours.points, strict=True)]
    result = result_of([cost.costs()[0], replace(ours, points=points)])
    assert numbers(finding(result, "claims to step by")) == [0.5, 3]


def test_an_engine_whose_scheme_could_not_run_is_compared_with_nothing() -> None:
    """Nor is one that is compared with itself, as another engine's name is no scheme's."""
    anchor, ours = cost.costs()[0], cost.priced("mujoco_tendons", "engine", 30.0, "rk4")
    failed = replace(cost.priced("rk4", "kernel", 4.0, "rk4"), points=[])
    own = replace(cost.priced("bullet_softbody", "engine", 90.0, None), identified_as="mujoco_tendons")
    assert not [said for said in result_of([anchor, failed, ours, own]).findings if "claims to step by" in said]


def test_the_smallest_string_comes_first() -> None:
    """Then the largest that all engines came to."""
    said = [numbers(sentence)[0] for sentence in cost.usual().findings if sentence.startswith("With ")]
    assert said == [MASSES[0], MASSES[2]]
