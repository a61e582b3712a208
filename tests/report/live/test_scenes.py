"""Scenes as the live lab opens them: what is in the way, and whether a command can name them."""

from __future__ import annotations

import pytest

from reference.errors import InputError
from reference.scenes import find
from report.live.scenes import MOST_MASSES, open_scene


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
