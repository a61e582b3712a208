"""MuJoCo's flexes: springs alike are one flex, and a rope is the scheme it claims to be with its own numbers only."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from engines.engine import Engine, find, version
from engines.mujoco.flex import groups_of
from engines.mujoco.rope import MujocoRope
from engines.process.isolation import run_engine
from reference.scenes import find as find_scene
from reference.system import MassSpringSystem
from tests.conformance.case import Case
from tests.conformance.checks import check_follows
from tests.conformance.children import result_of
from tests.conformance.runs import outcomes

NAMES = ("mujoco_flex", "mujoco_flex_rk4", "mujoco_rope")

pytestmark = pytest.mark.skipif(version(find(NAMES[0])) is None, reason="mujoco is not installed")


def cloth(side: int = 6) -> MassSpringSystem:
    """A square of threads with a diagonal in each cell, held at two corners.

    Level at the start, where it has more springs than coordinates.
    """
    at = np.arange(side**2).reshape(side, side)
    pairs = [(at[1:], at[:-1]), (at[:, 1:], at[:, :-1]), (at[1:, 1:], at[:-1, :-1])]
    springs = np.concatenate([np.column_stack([a.ravel(), b.ravel()]) for a, b in pairs])
    positions = 0.1 * np.column_stack(
        [np.divmod(np.arange(side**2), side)[0], np.arange(side**2) % side, 0 * at.ravel()]
    )
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=np.array(0.01),
        rest_lengths=np.linalg.norm(positions[springs[:, 0]] - positions[springs[:, 1]], axis=1),
        stiffness=np.array(50.0),
        damping=np.array(0.02),
        drag=0.01,
        gravity=np.array([0.0, 0.0, -9.81]),
        fixed=np.isin(np.arange(side**2), [0, side - 1]),
    )


def doubled(system: MassSpringSystem) -> MassSpringSystem:
    """The same with every second spring there once more, some as stiff, some named from the other end."""
    again = np.arange(0, len(system.springs), 2)
    fields = {name: getattr(system, name) for name in ("rest_lengths", "stiffness", "damping")}
    more = {name: np.append(values, values[again]) for name, values in fields.items()}
    more["stiffness"][-1] *= 2
    springs = system.springs[again].copy()
    springs[::2] = springs[::2, ::-1]
    return replace(system, springs=np.vstack([system.springs, springs]), **more)


def begun_later(system: MassSpringSystem) -> MassSpringSystem:
    """The same with its first three masses fixed."""
    return replace(system, fixed=np.arange(len(system.masses)) < 3)


CASES = [
    Case("a cloth", cloth(), 1e-3, 200),
    Case("springs beside springs", doubled(find_scene("string").system({"damping": 0.05})), 1e-3, 200),
    Case("springs between fixed masses", begun_later(find_scene("string").system({})), 1e-3, 200),
]


@pytest.mark.parametrize("name", NAMES)
def test_meshes_beyond_the_suites_are_stepped_as_claimed(name: str) -> None:
    """A cloth whose threads hold one another; two springs between two masses; springs that hold nothing."""
    for case, outcome in zip(CASES, outcomes(find(name), CASES), strict=True):
        check_follows(find(name), case, outcome)


def check_groups(system: MassSpringSystem, groups: list[np.ndarray[tuple[int, ...], np.dtype[np.int64]]]) -> None:
    """Every spring is in one group, with its like only, and in none are two between the same masses."""
    assert sorted(np.concatenate(groups).tolist()) == list(range(len(system.springs)))
    for group in groups:
        assert np.ptp(system.stiffness[group]) == np.ptp(system.damping[group]) == 0
        pairs = np.sort(system.springs[group], axis=1)
        assert len(np.unique(pairs, axis=0)) == len(pairs)


def test_springs_alike_are_one_flex() -> None:
    """A string is one, and as many as it has kinds of springs; springs between the same masses need one each."""
    string = find_scene("string").system
    for system, count in (
        (string({}), 1),
        (string({"masses": 4, "stiffness": "200,150,200,150"}), 2),
        (string({"masses": 4, "stiffness": "200,150,200,150", "damping": "0,0,1,0"}), 3),
        (doubled(string({})), 3),
    ):
        groups = groups_of(system, system.stiffness, system.damping)
        assert len(groups) == count
        check_groups(system, groups)
    with pytest.raises(AssertionError):
        check_groups(doubled(string({})), groups_of(string({})))
    with pytest.raises(AssertionError):
        check_groups(string({"masses": 2, "stiffness": "200,150"}), [np.arange(2)])


@pytest.mark.parametrize(
    "other",
    [MujocoRope(impedance=0.95), MujocoRope(impedance=0.9998), MujocoRope(weight=1.0)],
    ids=lambda e: f"{e.impedance:g} {e.weight:g}",
)
def test_a_rope_with_another_number_is_not_its_scheme(other: MujocoRope) -> None:
    """Shown to fail: MuJoCo's own impedance, the next to the largest, and edges with all of their weight."""
    case = Case("default", find_scene("string").system({}), 1e-3, 200)
    check_follows(MujocoRope(), case, *outcomes(MujocoRope(), [case]))
    with pytest.raises(AssertionError):
        check_follows(other, case, *outcomes(other, [case]))


def files_left(engine: Engine, folder: str) -> list[str]:
    """What a run that blows up leaves in the folder it is run in. Runs in the engine's process, and goes back."""
    before = os.getcwd()
    os.chdir(folder)
    try:
        run_engine(engine, find_scene("string").system({}), 1e80, 20)
        return os.listdir(folder)
    finally:
        os.chdir(before)


@pytest.mark.parametrize("name", NAMES)
def test_a_blow_up_is_told_and_leaves_no_file(name: str, tmp_path: Path) -> None:
    """MuJoCo, unless told otherwise, starts anew and writes MUJOCO_LOG.TXT."""
    case = Case("far too large a step", find_scene("string").system({}), 1e80, 20)
    assert [outcome.ending for outcome in outcomes(find(name), [case])] == ["diverged"]
    assert result_of(files_left, find(name), str(tmp_path)) == []
