"""Scenes: engine by engine what it was there, counted by whether it is a scheme and whether it met an obstacle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.scenes import STEPS, result_of
from reference.identification import Match
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from tests.experiments.canned import scenes
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_each_number_in_its_column() -> None:
    """Masses are not springs; a scheme is named where it is near enough, with its distance in any case."""
    rows = {row["stepper"]: row for row in records(scenes.usual("cloth"))}
    system = find("cloth").system({})
    near, stepwise, far, crashed = (
        rows[name] for name in ("pymunk_springs", "mujoco_flex", "bullet_softbody", "Segfaults")
    )
    assert (near["scene"], near["masses"], near["springs"]) == ("cloth", len(system.masses), len(system.springs))
    assert (near["identified as"], near["deviation [m]"], near["compared by"]) == ("drift_kick", 1e-15, "trajectories")
    assert (stepwise["identified as"], stepwise["compared by"]) == ("kick_drift", "single steps")
    assert (far["identified as"], far["deviation [m]"]) == (None, 5e-4)
    assert far["reason"] == "not identified; nearest rk4 at 0.0005 m"
    assert (crashed["outcome"], crashed["deviation [m]"], crashed["compared by"]) == ("crashed", None, None)


def test_the_first_sentences_count_and_name_the_worst_that_is_a_scheme() -> None:
    """Four of six, two of them by single steps, whose errors are of one step."""
    result = scenes.usual("string", "cloth")
    assert numbers(finding(result, "meet no obstacle")) == [6, STEPS, 4]
    said = finding(result, "whole trajectory")
    assert numbers(said) == pytest.approx([2, 1e-15])
    assert in_order(said, "pymunk_springs on string", "1.0e-15 m from drift_kick")
    assert numbers(finding(result, "single steps")) == pytest.approx([2, 3e-14])


def test_how_many_tie_is_said() -> None:
    """Two schemes within the tolerance: the first is named, and it is no secret that there is another."""
    tied = scenes.run(find("string"), "a", "kick_drift", 1e-15)
    both = replace(
        tied.identification, ranking=(*tied.identification.ranking[:1], Match("kick_drift_implicit_drag", 0))
    )
    result = result_of([replace(tied, identification=both), scenes.run(find("string"), "b", "heun", 1e-15)], {})
    assert numbers(finding(result, "other schemes do the same")) == [1]
    assert records(result)[0]["ties with"] == "kick_drift_implicit_drag"


def test_who_meets_an_obstacle_is_counted_apart() -> None:
    """Of three on the barrier one is a scheme to the end, one in its steps away from the circle."""
    scene = find("barrier")
    inside = np.broadcast_to(scene.system({}).obstacles[0].centre, (2, 11, 2)).copy()  # type: ignore[attr-defined]
    met = Outcome("done", "", Trajectory(np.array([0.0, 1e-3]), inside, np.zeros_like(inside)))
    away = "single steps away from obstacles"
    runs = [scenes.run(scene, *ran) for ran in (("a", "heun", 1e-15), ("b", "heun", 1e-15, away), ("c", "heun", 1e-3))]
    free = scenes.run(find("string"), "d", "heun", 1e-15)
    result = result_of([free, *(replace(run, outcome=met) for run in runs)], {})
    assert numbers(finding(result, "that meet an obstacle")) == [3, 1, 1]
    assert numbers(finding(result, "that meet no obstacle")) == [1, STEPS, 1]


def test_strangers_are_named_with_their_nearest_scheme() -> None:
    """And their distance from it."""
    said = finding(scenes.usual("string"), "Not identified")
    assert in_order(said, "bullet_softbody on string", "5.0e-04 m from rk4")


def test_what_is_unsupported_is_counted_by_its_reason_and_no_failure() -> None:
    """A crash is one."""
    said = finding(scenes.usual(), "unsupported")
    assert numbers(said) == [3, 15, 3]
    assert "for mesh (3)" in said
    assert len(scenes.usual().failures) == 3
    assert all(failure.startswith("Segfaults on ") for failure in scenes.usual().failures)


def test_without_engines_there_is_a_sentence() -> None:
    """Nothing ran."""
    assert len(scenes.nothing().findings) == 1


def test_the_worst_is_told_wherever_it_stands() -> None:
    """Between better ones, of those with a whole trajectory and of those with single steps."""
    scene = find("string")
    whole = [scenes.run(scene, *ran) for ran in (("a", "heun", 3e-15), ("b", "rk4", 2e-14), ("c", "euler", 1e-14))]
    single = [scenes.run(scene, "d", "heun", error, "single steps") for error in (1e-13, 4e-13, 2e-13)]
    said = finding(result_of([*whole, *single], {}), "whole trajectory")
    assert numbers(said) == pytest.approx([3, 2e-14])
    assert in_order(said, "b on string", "from rk4")
    assert numbers(finding(result_of([*whole, *single], {}), "single steps")) == pytest.approx([3, 4e-13])
