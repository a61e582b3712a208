"""Animations for pages: what the script is given is the motion, and nothing is asked for from anywhere."""

from __future__ import annotations

import base64
import json

import numpy as np
import pytest

from experiments.scenes import shown
from reference.scenes import find
from reference.stepper import catalogued
from report.film.animations import ACROSS, PARTS, SCRIPT, SHOWN, SLOW, Animation, animated, animation
from report.film.view import View
from tests.report.html import Page

#: Of the whole element [bytes].
MOST = 300_000


def frames(made: Animation) -> np.ndarray:
    """The places of its masses, shape (m, n, 2) [pixels]."""
    data = json.loads(made.data)
    places = np.frombuffer(base64.b64decode(data["places"]), "<i2") / PARTS
    return places.reshape(data["frames"], -1, 2)


def check_places(made: Animation, positions: np.ndarray) -> None:
    """In the plane they are the positions (m, n, 2), enlarged, moved and upside down, to half a part of a pixel."""
    places = frames(made)
    spread = np.ptp(positions[..., 0])
    scale = np.ptp(places[..., 0]) / spread
    moved = (positions - positions[0, 0]) * np.array([scale, -scale])
    assert np.abs(places - places[0, 0] - moved).max() <= 4 / PARTS


def test_the_frames_are_the_motion() -> None:
    """Of the string; and those of a string by another step are not."""
    made = animation("string")
    found = shown(find("string")).motion
    assert found is not None
    moved = found.positions
    check_places(made, moved)
    wrong = moved.copy()
    wrong[-1, -1, 0] += 0.05
    with pytest.raises(AssertionError):
        check_places(made, wrong)


def test_every_animation_is_small_and_has_words_and_a_still() -> None:
    """A line for every spring, the ends of the last frame; a label for those who do not see it."""
    for name in SHOWN:
        made = animation(name)
        assert len(made.html()) < MOST
        system = find(name).system({})
        page = Page(made.html())
        assert len(page.of("line")) == len(system.springs)
        assert page.of("svg")[0]["aria-label"] == made.alt
        assert len(made.alt) > 80
        places = frames(made)
        data = json.loads(made.data)
        assert data["duration"] == SLOW * find(name).duration
        order = np.frombuffer(base64.b64decode(data["order"]), "<u2").reshape(data["frames"], -1)
        assert all(np.array_equal(np.sort(row), np.arange(len(system.springs))) for row in order)
        first = page.of("line")[0]
        a, b = system.springs[order[-1, 0]]
        drawn = [float(first[key]) for key in ("x1", "y1", "x2", "y2")]
        assert np.allclose(drawn, [*places[-1, a], *places[-1, b]], atol=1e-3)
        assert places.min() >= -1
        assert places.max() <= ACROSS + 1


def test_springs_that_are_as_far_stand_in_their_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """By how far away they are, those behind first; and where they are as far, by their numbers, whoever sorts."""
    setup = find("cloth").setup({"rows": 5, "columns": 5})
    moved = catalogued()["kick_drift"].run(setup.system, setup.dt, 10).trajectory
    assert moved is not None
    near = np.where(np.arange(len(setup.system.masses)) < 15, 1.0, 0.0)

    def in_two_planes(self: View, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return positions[..., :2], np.broadcast_to(near, positions.shape[:-1])

    monkeypatch.setattr(View, "project", in_two_planes)
    made = animated("cloth", setup.system, moved)
    data = json.loads(made.data)
    order = np.frombuffer(base64.b64decode(data["order"]), "<u2").reshape(data["frames"], -1)
    depths = near[setup.system.springs].mean(axis=1).tolist()
    assert order[-1].tolist() == sorted(range(len(depths)), key=depths.__getitem__)


def test_the_same_scene_is_the_same_bytes_and_asks_for_nothing() -> None:
    """No address in it, nor in the script."""
    assert animation("string").html() == animation("string").html()
    for text in (animation("string").html(), SCRIPT):
        assert not any(word in text for word in ("//www", "http", "fetch", "import ", "src=", "url("))


def test_less_motion_is_respected() -> None:
    """The script asks what the reader prefers before it starts, and has a button."""
    assert "prefers-reduced-motion: reduce" in SCRIPT
    assert '"button"' in SCRIPT
