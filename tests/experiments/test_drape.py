"""The drape test: its shadow, its folds, its sentences, and that stiffer cloth drapes less."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from experiments import drape
from experiments.drape import DIRECTIONS, able, cloth, covered, flat_area, folds, hung, hung_in, shadow
from reference.scenes.drape import disc
from reference.state import Array
from reference.system import IntArray

TURN = np.linspace(-np.pi, np.pi, DIRECTIONS, endpoint=False)


def folded() -> tuple[Array, IntArray]:
    """A square of 1 m of two triangles; and a third, over one of them. All of y is seen from above."""
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [1.0, 0.1, 1.0], [0.0, 0.2, 1.0], [0.1, -1.0, 0.2]])
    return corners, np.array([[0, 1, 2], [0, 2, 3], [4, 1, 2]])


def check_area(area: Any) -> None:
    """A place under two triangles is in shadow once: 1 m^2, to the grid of 1e-7 m that points are put on."""
    assert area(*folded()) == pytest.approx(1.0, abs=1e-6)


def test_a_shadow_counts_each_place_once() -> None:
    """A sum over triangles counts folds twice."""

    def sum_of_triangles(x: Array, triangles: IntArray) -> float:
        a, b = (x[triangles[:, i]][:, [0, 2]] - x[triangles[:, 0]][:, [0, 2]] for i in (1, 2))
        return float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)

    check_area(lambda x, triangles: covered(x, triangles).area)
    with pytest.raises(AssertionError):
        check_area(sum_of_triangles)


@pytest.mark.rotating(3, in_turn=True)
def test_a_flat_cloth_has_coefficient_one_and_one_hung_straight_down_none() -> None:
    """The limits: DC = 1; and of masses pulled in to the disc's edge, 0 to the raggedness of that edge."""
    system, _ = cloth(0.017, 0.006, 0)
    triangles = disc(drape.RADIUS, 0.006, 0).triangles
    assert shadow(system.positions, triangles, flat_area(0.006, 0))["coefficient"] == 1.0
    r = np.hypot(*system.positions[:, [0, 2]].T)
    pulled = system.positions * np.minimum(1.0, drape.SUPPORT / np.maximum(r, 1e-9))[:, None]
    assert shadow(pulled, triangles, flat_area(0.006, 0))["coefficient"] == pytest.approx(0.0, abs=0.02)


def test_the_outline_is_how_far_the_shadow_reaches_in_each_direction() -> None:
    """From -pi on round about, of x towards z: twice as far along x, half along -z; to the breadth of a triangle."""
    system, _ = cloth(0.017, 0.006, 0)
    triangles = disc(drape.RADIUS, 0.006, 0).triangles
    x, _, z = system.positions.T
    moved = system.positions * np.column_stack([np.where(x > 0, 2.0, 1.0), np.ones(len(x)), np.where(z < 0, 0.5, 1.0)])
    outline = shadow(moved, triangles, flat_area(0.006, 0))["outline"]
    backwards, down, along, up = outline[[0, DIRECTIONS // 4, DIRECTIONS // 2, 3 * DIRECTIONS // 4]] / drape.RADIUS
    assert (backwards, down, along, up) == pytest.approx((1.0, 0.5, 2.0, 1.0), rel=0.05)


@pytest.mark.parametrize("waves", [3, 6, 11])
def test_folds_are_counted(waves: int) -> None:
    """Of an outline of so many waves of 10 mm; of one that is nearly round, none."""
    count, amplitude = folds(0.12 + 0.01 * np.cos(waves * TURN + 0.3) + 0.003 * np.cos(2 * TURN))
    assert (count, amplitude) == (waves, pytest.approx(0.01))
    assert folds(0.12 + 0.0005 * np.cos(waves * TURN))[0] == 0


def check_stiffer_drapes_less(coefficients: list[float]) -> None:
    """By more than pieces of one cloth differ, 0.07."""
    assert (np.diff(coefficients) > 0.07).all()
    assert 0 < coefficients[0] < coefficients[-1] < 1


@pytest.mark.rotating(3, in_turn=True)
def test_stiffer_cloth_drapes_less_and_has_folds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over three bending lengths; and not if rigidity is left out of all."""
    found = [hung(c, 0.012, 0) for c in (0.008, 0.017, 0.03)]
    check_stiffer_drapes_less([one["coefficient"] for one in found])
    assert folds(found[1]["outline"])[0] >= 4
    assert folds(found[1]["outline"])[1] > 0.004
    limp = [hung(1e-5, 0.012, i)["coefficient"] for i in range(3)]
    with pytest.raises(AssertionError):
        check_stiffer_drapes_less(limp)


def test_an_engine_hangs_the_same_cloth() -> None:
    """The first that can; the same drape coefficient to 1e-3: both are at rest, at 1 mm/s and below for a second."""
    engines = able(cloth(0.017, 0.02, 0)[0])
    if not engines:
        pytest.skip("no engine is installed that can take it")
    assert len({engine.package for engine in engines}) == len(engines)
    found = hung_in(engines[-1], 0.017, 0.02, 0)
    assert found["coefficient"] == pytest.approx(hung(0.017, 0.02, 0)["coefficient"], abs=1e-3)


@pytest.mark.parametrize(("still_after", "looks"), [(3, 3), (1, 1), (10**6, round(drape.PATIENCE / drape.LOOK))])
def test_a_cloth_is_looked_at_until_it_is_at_rest(
    still_after: int, looks: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Or PATIENCE is over. Its speed is the root of the mean square of its masses': of v and 7 v, 5 v."""
    seen, shape = 0, (np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]), np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 7.0]]))
    fast, slow = drape.AT_REST / 5, 0.99 * drape.AT_REST / 5

    def advance() -> None:
        nonlocal seen
        seen += 1

    monkeypatch.setattr(drape, "flat_area", lambda *_: 1.0)
    monkeypatch.setattr(drape, "shadow", lambda positions, *_: {"of": positions})
    found = drape._at_rest(advance, lambda: (shape[0], (slow if seen >= still_after else fast) * shape[1]), 0.02, 0)
    assert (seen, found["time"]) == (looks, pytest.approx(looks * drape.LOOK))
    assert found["speed"] == pytest.approx(5 * (slow if looks == still_after else fast))
    assert np.array_equal(found["positions"], shape[0])
    assert np.array_equal(found["of"], shape[0])
