"""Advice: limits in their columns, the shortest step for all, and what each engine does at the scene's dt."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.changes import Change
from tests.experiments.canned import advice
from tests.experiments.canned.advice import (
    CABLE,
    CANNOT,
    CRASHED,
    DIVERGED,
    DONE,
    FOUND,
    ONLY_JUST,
    SETUP,
    STABLE,
    TOO_LONG,
    UNMEASURED,
    usual,
)
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_predicted_and_measured_in_their_columns() -> None:
    """And the margin is of the measured one."""
    for row, found in zip(records(usual()), FOUND, strict=True):
        assert (row["engine"], row["identified as"]) == (found.engine, found.scheme)
        assert row["predicted limit [s]"] == found.predicted.dt
        assert row["measured limit [s]"] == found.measured.dt
        assert row["advised dt [s]"] == found.advised
        assert row["at the scene's dt"] == found.own.ending
        margin = None if found.measured.dt is None else pytest.approx(found.measured.dt / SETUP.dt)
        assert row["margin"] == margin
        assert row["the scene with it"] == (found.confirmed.ending if found.confirmed else None)


def test_the_step_for_all_is_the_shortest() -> None:
    """Of those that have one; who is stable at the scene's dt is counted by the measured limit."""
    first = advice.only(STABLE, TOO_LONG, ONLY_JUST, CABLE).findings[0]
    assert numbers(first) == [SETUP.dt, 3, 4, 0.45e-3]
    assert "all of them" in first


def test_where_one_has_no_step_the_others_are_counted() -> None:
    """With theirs."""
    hopeless = replace(TOO_LONG, engine="hopeless", advised=None, confirmed=DIVERGED)
    first = advice.only(STABLE, hopeless, CABLE).findings[0]
    assert numbers(first) == [SETUP.dt, 2, 3, 2, 3.6e-3]
    assert "no step is known to be safe" in advice.only(hopeless).findings[0]


def test_each_engine_has_its_sentence() -> None:
    """With its margin, or by how much its dt is too long; its limit; what to use."""
    stable = finding(usual(), "mujoco_tendons at")
    assert numbers(stable) == pytest.approx([SETUP.dt, 4.4, 4.4e-3, 3.6e-3])
    assert in_order(stable, "margin 4.40", "limit is 0.0044 s", "dt = 0.0036 s still works")
    beyond = finding(usual(), "pymunk_springs at")
    assert numbers(beyond) == pytest.approx([SETUP.dt, 1.82, 0.55e-3, 0.45e-3])
    assert in_order(beyond, "blows up", "1.82 times the limit", "use dt = 0.00045 s")
    just = finding(usual(), "bullet_softbody at")
    assert numbers(just) == pytest.approx([SETUP.dt, 5.0, 0.94e-3])
    assert "only just" in just


def test_a_scene_that_ends_well_beyond_the_limit_is_not_said_to_blow_up() -> None:
    """It did not, this time; perturbations grow."""
    lucky = finding(advice.only(replace(TOO_LONG, own=DONE)), "pymunk_springs at")
    assert "blows up" not in lucky
    assert numbers(lucky) == pytest.approx([SETUP.dt, 1.82, 0.55e-3, 0.45e-3])


def test_who_has_no_measured_limit_is_told_with_the_predicted_one() -> None:
    """And how the scene ended."""
    said = finding(usual(), "exudyn_springs at")
    assert numbers(said) == pytest.approx([SETUP.dt, 2e-3])
    assert in_order(said, "no limit was measured (it has its own step)", "is predicted")
    crashed = finding(usual(), "Segfaults")
    assert ("crashes (killed by SIGSEGV)" in crashed, "predicted" in crashed) == (True, False)


def test_who_cannot_take_the_scene_is_told_last() -> None:
    """With its reason, and is a failure as the others that did not come to an end."""
    assert usual().findings[-1] == "mujoco_flex cannot take this scene: mujoco_flex cannot do planes."
    assert [failure.partition(":")[0] for failure in usual().failures] == ["pymunk_springs", "Segfaults", "mujoco_flex"]


def test_a_step_that_fails_where_the_limit_would_allow_it_is_told_apart() -> None:
    """The scene asks for shorter steps than its rest does."""
    wild = replace(STABLE, own=DIVERGED, advised=0.5e-3)
    said = finding(advice.only(wild), "mujoco_tendons at")
    assert numbers(said)[:2] == pytest.approx([SETUP.dt, 4.4e-3])
    assert said.endswith("use dt = 0.0005 s or less.")
    limited = finding(advice.only(replace(STABLE, advised=1e-3)), "mujoco_tendons at")
    assert in_order(limited, "at rest with margin 4.40", "blows up with longer steps", "use dt = 0.001 s")


def test_constraints_and_changes_are_told() -> None:
    """A cable has no springs; limits are those of the start."""
    assert "mujoco_cable, which puts rods for springs," in finding(usual(), "mujoco_cable, which")
    changed = advice.only(STABLE, changes=(Change(0.1, "stiffness", 5.0),))
    assert "stiffness" in changed.findings[1]


def test_nobody_and_no_limit_are_told() -> None:
    """In the first sentence."""
    assert len(advice.only().findings) == 1
    first = advice.only(UNMEASURED, CRASHED, CANNOT).findings[0]
    assert numbers(first) == [SETUP.dt, 1, 2]
    assert in_order(first, "it has its own step", "it crashed")


def test_what_ties_with_the_scheme_stands_beside_it() -> None:
    """Never the first of several alone."""
    tied = advice.only(replace(STABLE, ties=("velocity_verlet", "drift_kick")), CABLE)
    assert [row["ties"] for row in records(tied)] == ["velocity_verlet, drift_kick", ""]
