"""What of a scene is translated: each kind of its springs with the masses it joins, and what no snippet can have."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from engines.translation.translation import Spring, Stepping, find, translations
from experiments.translation import scene_rows
from experiments.translation.rows import Row, fitting
from experiments.translation.scene_rows import SOLVERS_UP_TO, rows_of_scene, springs_of
from reference.collisions.round_masses import Collisions
from reference.errors import InputError
from reference.limit import Limit
from reference.obstacles import Circle
from reference.system import MassSpringSystem

#: Masses of a triangle with a tail [kg]; the first two are fixed.
MASSES = (1.0, 2.0, 3.0, 4.0)

#: How engines are stepped, unless that matters.
MILLISECONDS = Stepping(1e-3)


def scene(**changed: Any) -> MassSpringSystem:
    """Springs between all of the first three masses, no two alike, and one to the last like the second."""
    given: dict[str, Any] = {
        "positions": np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0]]),
        "springs": np.array([[0, 1], [1, 2], [2, 0], [2, 3]]),
        "masses": np.array(MASSES),
        "rest_lengths": np.ones(4),
        "stiffness": np.array([10.0, 20.0, 30.0, 40.0]),
        "damping": np.array([0.1, 0.2, 0.3, 0.4]),
        "gravity": np.zeros(2),
        "fixed": np.array([True, True, False, False]),
    }
    return MassSpringSystem(**{**given, **changed})


def row_of(translation: Any, typed: Any, spring: Spring, *_: object) -> Row:
    """What is said of a spring alone, without looking at it: that takes seconds."""
    wanted = (spring.stiffness, spring.damping)
    return Row(translation.name, translation.title, typed, "alone", wanted, None, None, 0.5, "of the spring alone")


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Springs alone are not looked at; the limit that theory finds is always 0.25 s."""
    monkeypatch.setattr(scene_rows, "row_of", row_of)
    monkeypatch.setattr("reference.theory.limits.stability_limit", lambda *_: Limit(0.25))


def rows(system: MassSpringSystem, name: str = "xpbd", stepping: Stepping = MILLISECONDS) -> list[Row]:
    """Of one translation, with nothing run."""
    return rows_of_scene(system, stepping, [find(name)], lambda _: None, measure=False)


def test_a_spring_has_its_own_numbers_and_the_masses_it_joins() -> None:
    """The free ones, the second end first; between two fixed masses, the second end as if it were free."""
    assert springs_of(scene()) == [
        Spring(10.0, 0.1, 2.0),
        Spring(20.0, 0.2, 3.0),
        Spring(30.0, 0.3, 3.0),
        Spring(40.0, 0.4, 4.0, 3.0),
    ]


def test_the_spring_that_has_no_stiffness_is_named() -> None:
    """By its number; a scene without springs has nothing to translate."""
    with pytest.raises(InputError, match=r"^stiffness\[2\] = 0: expected > 0 to be translated$"):
        springs_of(scene(stiffness=np.array([10.0, 20.0, 0.0, 40.0])))
    none = dict.fromkeys(("rest_lengths", "stiffness", "damping"), np.zeros(0))
    with pytest.raises(InputError, match=r"^the scene has no springs to translate$"):
        springs_of(scene(springs=np.zeros((0, 2), int), **none))


def test_springs_of_one_kind_share_a_row() -> None:
    """Two of four are alike here; each row means its own spring, and has the scene's snippet and its limit."""
    alike = {"stiffness": np.array([10.0, 20.0, 20.0, 40.0]), "damping": np.array([0.1, 0.2, 0.2, 0.4])}
    found = rows(scene(**alike))
    assert [row.wanted for row in found] == [(10.0, 0.1), (20.0, 0.2), (40.0, 0.4)]
    assert [row.reason.partition(";")[0] for row in found] == [f"{n} of 4 springs" for n in (1, 2, 1)]
    assert len({row.snippet for row in found}) == 1
    assert found[0].snippet not in (None, "alone")
    assert {row.largest_stable_dt for row in found} == {0.25}
    assert all(row.reason.endswith("of the spring alone") for row in found)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"drag": 0.1}, "snippets have neither obstacles nor drag"),
        ({"collisions": Collisions(np.full(4, 0.01))}, "snippets have linear springs, and masses that do not collide"),
        ({"obstacles": (Circle((0.0, -5.0), 1.0),)}, "snippets have neither obstacles nor drag"),
        ({"pulls": np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 1.0], [0.0, 0.0]])}, "no force that pulls on a mass"),
    ],
)
def test_what_no_snippet_can_have_is_told_instead_of_one(changed: dict[str, Any], said: str) -> None:
    """In every row, and there is no snippet; what to type is there all the same."""
    for row in rows(scene(**changed)):
        assert said in row.reason
        assert row.snippet is None
        assert row.settings


def test_an_engine_of_the_plane_has_no_snippet_of_a_scene_in_space() -> None:
    """Box2D's is of the plane; a line is laid into it."""
    space = scene(positions=np.pad(scene().positions, ((0, 0), (0, 1))), gravity=np.zeros(3))
    assert all("box2d cannot do motion in 3 dimensions" in row.reason for row in rows(space, "box2d"))
    assert all(row.snippet is None for row in rows(space, "box2d"))
    line = scene(positions=np.array([[0.0], [1.0], [2.0], [3.0]]), gravity=np.zeros(1))
    assert not any("dimensions" in row.reason for row in rows(line, "box2d"))


def test_a_solvers_limit_is_looked_for_in_small_scenes_only() -> None:
    """Of as many free coordinates as that it is there; of more it is said how to ask for it."""
    small, large = ({"fixed": np.arange(4) < held} for held in (1, 0))
    assert 2 * 3 <= SOLVERS_UP_TO < 2 * 4
    assert {row.largest_stable_dt for row in rows(scene(**small))} == {0.25}
    assert {row.largest_stable_dt for row in rows(scene(**large), "mujoco")} == {0.25}
    for row in rows(scene(**large)):
        assert row.largest_stable_dt is None
        assert "takes long to predict: springlab stability SCENE --stepper 'xpbd_gauss_seidel(" in row.reason


def test_what_was_chosen_is_checked() -> None:
    """Sub-steps of an engine that has none are refused, not left out; where all are asked for they are left out."""
    with pytest.raises(InputError, match="mujoco has none to set"):
        rows(scene(), "mujoco", Stepping(1e-3, substeps=2))
    assert fitting(find("mujoco"), Stepping(1e-3, 2, 3)) == Stepping(1e-3)
    assert fitting(find("box2d"), Stepping(1e-3, 2, 3)) == Stepping(1e-3, substeps=2)
    assert fitting(find("pymunk"), Stepping(1e-3, 2, 3)) == Stepping(1e-3, iterations=3)
    of_all = rows_of_scene(scene(), Stepping(1e-3, substeps=2), [], lambda _: None, measure=False)
    assert {row.engine for row in of_all} == set(translations())
