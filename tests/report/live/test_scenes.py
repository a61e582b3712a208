"""Scenes as the live lab opens them: what is in the way, and whether a command can name them."""

from __future__ import annotations

import pytest

from reference.changes import Change
from reference.errors import InputError
from reference.scenes import find
from report.live.scenes import MOST_MASSES, OFTEN, OpenedScene, open_scene


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
    opened = OpenedScene("string", find("string").system({}), 0.01, changes=(*changes, Change(0.0, "drag", 0.1)))
    assert opened.driven == (frozenset({"stiffness"}) if driven else frozenset())
