"""Scenes as the live lab opens them: what is in the way, and whether a command can name them."""

from __future__ import annotations

import numpy as np
import pytest

from reference.changes import Change
from reference.errors import InputError
from reference.obstacles import Circle, Plane, Sphere
from reference.scenes import find
from reference.system import MassSpringSystem
from report.live.scenes import MOST_MASSES, OFTEN, OpenedScene, counts, in_the_way, names, open_scene, words


@pytest.mark.parametrize(("scene", "barrier"), [("string", True), ("barrier", False)])
def test_a_scene_with_something_put_in_the_way_or_taken_out_is_named_no_more(scene: str, barrier: bool) -> None:
    """A command with its name would run another one: it is written to a file."""
    opened = open_scene(scene, barrier=barrier)
    assert bool(opened.system.obstacles) == barrier
    assert not opened.as_named


@pytest.mark.parametrize(
    ("scene", "barrier"), [("string", None), ("string", False), ("barrier", None), ("barrier", True)]
)
def test_a_scene_as_it_is_is_named(scene: str, barrier: bool | None) -> None:
    """With what is in its way, or is not."""
    opened = open_scene(scene, barrier=barrier)
    assert opened.system.obstacles == find(scene).system({}).obstacles
    assert opened.as_named


def test_what_is_driven_is_no_name_alone() -> None:
    """Its ground moves by many changes, which a file has."""
    assert not open_scene("earthquake").as_named


def test_a_scene_that_nobody_could_watch_is_refused() -> None:
    """With how large it may be."""
    with pytest.raises(InputError, match=f"expected at most {MOST_MASSES:,} "):
        open_scene("string", {"masses": str(MOST_MASSES + 1)})


@pytest.mark.parametrize(("count", "driven"), [(OFTEN, False), (OFTEN + 1, True)])
def test_what_changes_often_is_driven(count: int, driven: bool) -> None:
    """Nobody else can change it then; a parameter that changes now and then is free."""
    changes = [Change(0.1 * i, "stiffness", 100.0 + i) for i in range(count)]
    changes.append(Change(0.0, "drag", 0.1))
    opened = OpenedScene("string", find("string").system({}), 0.01, {}, tuple(changes), False, False)
    assert opened.driven == (frozenset({"stiffness"}) if driven else frozenset())


@pytest.mark.parametrize(
    ("low", "high", "wanted"),
    [
        ((1.0,), (4.0,), Plane((1.0 - 0.6,), (1.0,))),
        ((2.0, 1.0), (4.0, 5.0), Circle((3.0, 1.0 - 0.8 - 0.96), 0.96)),
        ((2.0, 1.0, 2.0), (4.0, 5.0, 9.0), Sphere((3.0, 1.0 - 1.4 - 1.68, 5.5), 1.68)),
    ],
)
def test_what_is_put_in_the_way_is_below_the_masses(
    low: tuple[float, ...], high: tuple[float, ...], wanted: Plane | Circle | Sphere
) -> None:
    """By a fifth of their size, in their middle; its radius is 0.24 of that. Along a line it is a floor."""
    system = MassSpringSystem(
        positions=np.array([low, high]),
        springs=np.array([[0, 1]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    found = in_the_way(system)
    assert type(found) is type(wanted)
    for key, value in wanted.to_dict().items():
        assert found.to_dict()[key] == (value if key == "kind" else pytest.approx(value))


def test_what_of_a_scene_is_a_count_and_what_is_a_word() -> None:
    """The word that it has comes first; of a file's own none is known."""
    for name in names():
        parameters = find(name).parameters
        whole = [key for key, value in parameters.items() if isinstance(value, int) and not isinstance(value, bool)]
        assert counts(name) == {key: parameters[key] for key in whole if parameters[key] > 0}
        for key, choices in words(name).items():
            assert choices[0] == parameters[key]
            assert sorted(choices) == sorted(find(name).choices[key])
        assert [*words(name)] == [*find(name).choices]
    assert counts("string") == {"masses": 10}
    assert counts("own.toml") == words("own.toml") == {}
    assert len(words("bridge")["kind"]) > 1


def test_a_file_is_called_by_its_own_name() -> None:
    """Without its folder and its ending."""
    system = find("string").system({})
    stems = [OpenedScene(name, system, 0.01, {}, (), True, False).stem for name in ("string", "my/own.toml", "a.b")]
    assert stems == ["string", "own", "a.b"]
