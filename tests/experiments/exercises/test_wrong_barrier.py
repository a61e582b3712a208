"""Wrong answers about masses in a circle, each worked out by hand, and whom the questions are about."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import find
from reference.state import Array

push_out = find("barrier").solutions["push_out"]

#: A circle of radius 5 m, and half-way out of it towards (0.6, 0.8) a mass; clockwise there is (0.8, -0.6).
CIRCLE = SimpleNamespace(centre=np.array([1.0, 2.0]), radius=5.0)
PLACE, OUT, CLOCKWISE = np.array([2.5, 4.0]), np.array([0.6, 0.8]), np.array([0.8, -0.6])

#: Velocities, outwards and clockwise [m/s]: coming in either way about, leaving, and coming in fast.
VELOCITIES = np.array([[-2.0, 3.0], [-2.0, -3.0], [2.0, -3.0], [-4.0, 1.0]])

#: What becomes of them, outwards and clockwise.
KEPT = [2.0, -3.0]
AFTER = {
    "inwards off": [[0, 3], [0, -3], KEPT, [0, 1]],
    "tangential": [[0, 3], [0, -3], [0, -3], [0, 1]],
    "stopped": [[0, 0]] * 4,
    "stopped, inwards": [[0, 0], [0, 0], KEPT, [0, 0]],
    "mirrored": [[2, 3], [2, -3], KEPT, [4, 1]],
    "kept": VELOCITIES.tolist(),
    "normal": [[-2, 0], [-2, 0], [2, 0], [-4, 0]],
    "normal, inwards": [[-2, 0], [-2, 0], KEPT, [-4, 0]],
    "turned": [[0, -3], [0, 3], [0, 3], [0, -1]],
    "outwards off": [[-2, 3], [-2, -3], [0, -3], [-4, 1]],
    "clockwise": [[0, 3], [0, 3], KEPT, [0, 1]],
    "anticlockwise": [[0, -3], [0, -3], KEPT, [0, -1]],
    "whole": [[0, 13**0.5], [0, -(13**0.5)], KEPT, [0, 17**0.5]],
}


def pushed(coming: Any, x: Array = PLACE, **wrong: Any) -> tuple[list[float], list[float]]:
    """A mass, outwards and clockwise as fast as that, after a wrong answer."""
    v = np.array([coming[0] * OUT + coming[1] * CLOCKWISE])
    after_x, after_v = push_out(np.array([x]), v, CIRCLE, **wrong)
    return after_x[0].tolist(), [float(after_v[0] @ OUT), float(after_v[0] @ CLOCKWISE)]


@pytest.mark.parametrize("velocity", AFTER)
def test_what_becomes_of_a_velocity(velocity: str) -> None:
    """Of masses inside; those outside keep theirs."""
    for before, after in zip(VELOCITIES, AFTER[velocity], strict=True):
        place, found = pushed(before, velocity=velocity)
        assert found == pytest.approx(after, abs=1e-13)
        assert place == pytest.approx([4.0, 6.0])
        far = CIRCLE.centre + 6 * OUT
        assert pushed(before, far, velocity=velocity) == (pytest.approx(far), pytest.approx(before))
        everybodys = pushed(before, far, velocity=velocity, whose="everybody's")
        assert everybodys == (pytest.approx(far), pytest.approx(after, abs=1e-13))


def test_a_product_of_components_is_none_of_vectors() -> None:
    """(1.2, -3.4) by (0.8, -0.6), number by number; a mass that comes along an axis has a velocity of 0 inwards."""
    _, v = push_out(PLACE[None], np.array([[1.2, -3.4]]), CIRCLE, velocity="printed")
    assert v[0] == pytest.approx([0.96, 2.04])
    for velocity in ("stopped, inwards", "normal, inwards", "clockwise", "anticlockwise", "whole"):
        beside = CIRCLE.centre[None] + np.array([[2.0, 0.0]])
        for before in ([0.0, 3.0], [0.0, -3.0]):
            _, v = push_out(beside, np.array([before]), CIRCLE, velocity=velocity)
            assert v[0].tolist() == before


@pytest.mark.parametrize(
    ("wrong", "where"),
    [
        ({"place": "surface"}, [4.0, 6.0]),
        ({"place": "kept"}, [2.5, 4.0]),
        ({"place": "origin"}, [3.0, 4.0]),
        ({"place": "added"}, [5.5, 8.0]),
        ({"place": "other side"}, [-2.0, -2.0]),
        ({"place": "up"}, [2.5, 2 + 22.75**0.5]),
        ({"centre": "origin"}, [5 * 2.5 / 22.25**0.5, 5 * 4 / 22.25**0.5]),
        ({"normal": "offset"}, [1 + 5 * 1.5, 2 + 5 * 2.0]),
        ({"normal": "offset, along"}, [1 + 5 * 1.5, 2 + 5 * 2.0]),
    ],
    ids=str,
)
def test_where_a_mass_comes_to_be(wrong: dict[str, str], where: list[float]) -> None:
    """From (2.5, 4), half-way out of the circle about (1, 2)."""
    assert pushed([-2.0, 3.0], **wrong)[0] == pytest.approx(where)


def test_a_normal_of_another_length_counts_squared() -> None:
    """It is 2.5 m long: of -2 m/s inwards 6.25 times as much is taken, or 6.25 times the velocity along is left."""
    assert pushed([-2.0, 3.0], normal="offset")[1] == pytest.approx([-2 + 6.25 * 2, 3])
    assert pushed([2.0, 3.0], normal="offset")[1] == pytest.approx([2, 3])
    assert pushed([-2.0, 3.0], normal="offset, along")[1] == pytest.approx([0, 6.25 * 3], abs=1e-13)
    assert pushed([2.0, 3.0], normal="offset, along")[1] == pytest.approx([2, 3])


def test_straight_up_is_onto_the_upper_half_and_the_box_has_corners() -> None:
    """Beyond the circle's sides there is no such place: as high as its centre. (4, 4) from it is in the square only."""
    offsets = np.array([[3.0, -1.0], [4.0, 4.0], [4.0, 6.0], [6.0, 4.0]])
    x = CIRCLE.centre + offsets
    up, _ = push_out(x, 0 * x, CIRCLE, place="up", where="everywhere")
    assert up - CIRCLE.centre == pytest.approx(np.array([[3.0, 4.0], [4.0, 3.0], [4.0, 3.0], [6.0, 0.0]]))
    boxed, _ = push_out(x, 0 * x, CIRCLE, where="box")
    moved = (np.abs(boxed - x) > 1e-9).any(axis=1)
    assert moved.tolist() == [True, True, False, False]
    first, _ = push_out(x[::-1], 0 * x, CIRCLE, where="first")
    assert first.tolist() == x[::-1].tolist()  # it is outside


def asked(hidden: bool, seed: int) -> list[Any]:
    """Of each question, by mass: offsets as shares of the radius, and velocities outwards and anticlockwise."""
    found = []
    for question in find("barrier").questions(np.random.default_rng(seed), hidden, "ada"):
        x, v, circle = question.arguments
        offset = (x - circle["centre"]) / circle["radius"]
        out = offset / np.linalg.norm(offset, axis=1)[:, None]
        along = np.stack([-out[:, 1], out[:, 0]], axis=1)
        found.append((question, offset, (v * out).sum(axis=1), (v * along).sum(axis=1)))
    return found


@pytest.mark.parametrize("hidden", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_masses_are_inside_and_outside_come_and_go(hidden: bool, seed: int) -> None:
    """Of each five: two inside, the second going; one in a corner of the square about it, one beside it, one far."""
    *few, _ = asked(hidden, seed)
    assert [len(offset) for _, offset, *_ in few] == ([1, 9, 12] if hidden else [8, 6, 1])
    for question, offset, leads, slides in few:
        assert question.about == f"{len(offset)} masses about a circle"
        assert (question.parts, question.units) == (("x", "v"), ("m", "m/s"))
        assert 0.3 <= question.arguments[2]["radius"] <= 0.6
        assert (np.abs(question.arguments[2]["centre"]) <= 1).all()
        far, widest = np.linalg.norm(offset, axis=1), np.abs(offset).max(axis=1)
        for i in range(len(offset)):
            fives, kind = divmod(i, 5)
            assert (0.6 <= far[i] <= 0.8) if kind < 2 else far[i] == pytest.approx([1.2, 1.2, 4.0][kind - 2])
            if kind in (2, 3):
                assert widest[i] == pytest.approx(1.2 * 0.5**0.5 if kind == 2 else 1.2)
            assert (0.2 <= leads[i] <= 1) if kind == 1 else (-1 <= leads[i] <= -0.2)
            assert (0.2 <= slides[i] <= 1) if fives % 2 else (-1 <= slides[i] <= -0.2)


@pytest.mark.parametrize("hidden", [False, True])
def test_of_all_kinds_each_depth_comes_in_and_slides_each_way(hidden: bool) -> None:
    """At every depth four speeds inwards with four along: fast, slow, and the other way; each to a tenth, by itself."""
    *_, (question, offset, leads, slides) = asked(hidden, 1)
    far = np.linalg.norm(offset, axis=1)
    assert (question.parts, question.units, question.function) == (("x", "v"), ("m", "m/s"), "push_out")
    assert question.about == "224 masses of all kinds about a circle"
    assert 1.2 <= question.arguments[2]["radius"] <= 1.6
    inwards, along = np.array([1.0, -1.0, 1e-4, 20.0]), np.array([1.0, -1.0, 20.0, -1e-4])
    kinds = set()
    for depth, lead, slide in zip(far, leads, slides, strict=True):
        near = [(i, j) for i, a in enumerate(inwards) for j, b in enumerate(along) if is_near(-lead, a, slide, b)]
        assert len(near) == 1
        kinds.add((round(float(depth), 6), *near[0]))
    assert len(kinds) == 14 * 4 * 4
    assert (min(far) < 2e-3, sum(0.99 < d < 1 for d in far), sum(1 < d < 1.01 for d in far)) == (True, 16, 16)
    # neither speed is drawn with the other, nor by its place
    first, second = np.abs(leads) / 10.0 ** np.round(np.log10(np.abs(leads))), np.abs(slides)
    ordinary = (np.abs(np.abs(leads) - 1) < 0.2) & (np.abs(second - 1) < 0.2)
    assert abs(np.corrcoef(first[ordinary], second[ordinary])[0, 1]) < 0.5
    assert np.any(np.diff(far) > 0)
    assert np.any(np.diff(far) < 0)


def is_near(lead: float, inwards: float, slide: float, along: float) -> bool:
    """Whether both speeds are these, to a tenth."""
    return bool(abs(lead / inwards - 1) <= 0.1 + 1e-9 and abs(slide / along - 1) <= 0.1 + 1e-9)


def test_masses_are_on_all_sides() -> None:
    """Of every kind some are in each quarter."""
    quarters: dict[int, set[tuple[bool, bool]]] = {kind: set() for kind in range(5)}
    for seed in range(20):
        for _, offset, *_ in asked(True, seed)[:-1]:
            for i, (x, y) in enumerate(offset.round(12).tolist()):
                quarters[i % 5].add((x > 0, y > 0))
    assert [len(quarters[kind]) for kind in (0, 1, 2, 4)] == [4, 4, 4, 4]
    beside = {tuple(np.sign(o[3].round(12)).tolist()) for s in range(20) for _, o, *_ in asked(True, s)[1:-1]}
    assert beside == {(1, 0), (0, 1), (-1, 0), (0, -1)}


@pytest.mark.parametrize("seed", range(3))
def test_one_question_has_all_depths_ways_and_speeds(seed: int) -> None:
    """Each depth with each velocity once, to a tenth; every depth on all sides; in any order, from next to nothing.

    Of the depths the nearest to the surface are within a thousandth of it, on either side.
    """
    *_, (question, offset, leads, slides) = asked(False, seed)
    far = np.linalg.norm(offset, axis=1)
    depths = np.unique(far.round(9))
    assert question.about == f"{len(far)} masses of all kinds about a circle"
    assert 1.2 <= question.arguments[2]["radius"] <= 1.6
    assert (np.abs(question.arguments[2]["centre"]) <= 1).all()
    assert (depths[0], depths[-1]) == (pytest.approx(1e-3), pytest.approx(6.0))
    assert np.abs(depths - 1).min() == pytest.approx(1e-3)
    assert depths[depths > 1].min() - 1 == pytest.approx(1 - depths[depths < 1].max())
    assert (np.diff(depths[depths < 1]) < 0.21).all()
    assert len(far) == 16 * len(depths)
    assert not (np.diff(far) >= 0).all()

    def kinds(speeds: Array, wanted: list[float]) -> list[int]:
        near = np.abs(speeds[:, None] / np.array(wanted) - 1) <= 0.1 + 1e-9
        assert (near.sum(axis=1) == 1).all()
        return [int(i) for i in near.argmax(axis=1)]

    ways = list(zip(kinds(-leads, [1, -1, 1e-4, 20]), kinds(slides, [1, -1, 1e-4 * -1, 20]), strict=True))
    for depth in depths:
        here = np.abs(far - depth) < 1e-8
        assert len({way for way, is_here in zip(ways, here, strict=True) if is_here}) == 16
        angles = np.sort(np.arctan2(offset[here, 1], offset[here, 0]))
        assert np.diff(angles, append=angles[0] + 2 * np.pi).max() <= np.pi / 2 + 0.3
