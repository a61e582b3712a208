"""Bounds of limits from the numerical range: every mode's point lies in the polygon, and no limit below the bound."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory import limits
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.linearisation import Linearisation
from reference.theory.numerical_range import DIRECTIONS, _clipped, _limits, limit_from_below, polygon
from reference.theory.rates import Rates
from reference.theory.runge_kutta import stability_polynomial


def linear(system: MassSpringSystem) -> Linearisation:
    """About its rest."""
    found = spring_equilibrium(system).linear
    assert found is not None
    return found


def net(**more: Any) -> MassSpringSystem:
    """A cloth of unequal masses, with unequal damping and drag."""
    cloth = find_scene("cloth").system({"rows": 4, "columns": 3, "drag": 0.03})
    rng = np.random.default_rng(2)
    n, s = len(cloth.masses), len(cloth.stiffness)
    fields = {"masses": cloth.masses * rng.uniform(0.5, 2, n), "damping": rng.uniform(0.0, 0.2, s), **more}
    return replace(cloth, **fields)


@pytest.mark.parametrize("more", [{}, {"damping": np.zeros(1)}, {"drag": 0.0}], ids=["both", "drag", "damping"])
def test_every_move_has_its_point_in_the_polygon(more: dict[str, Any]) -> None:
    """(q* K q, q* (C + D) q) of a thousand moves, q*q = 1, and of those that are outermost: left of each edge."""
    found = linear(net(**more))
    corners = polygon(found)
    slowed = found.scaled(found.damping) + found.scaled(found.on_masses(np.full(len(net().masses), net(**more).drag)))
    stiff = found.scaled_stiffness
    moves = np.random.default_rng(0).normal(size=(len(found.mass), 1000))
    moves = np.concatenate([moves, np.linalg.eigh(stiff.toarray())[1], np.linalg.eigh(slowed.toarray())[1]], axis=1)
    moves = moves / np.linalg.norm(moves, axis=0)
    points = np.stack([(moves * (matrix @ moves)).sum(axis=0) for matrix in (stiff, slowed)], axis=1)
    scale = np.maximum(corners.max(axis=0), 1e-9)
    for a, b in zip(corners / scale, np.roll(corners, -1, axis=0) / scale, strict=True):
        (x, y), (px, py) = b - a, (points / scale - a).T
        assert (x * py - y * px >= -1e-9).all()
    # and it is not much larger: its widest and its highest point are a mode's
    assert corners.max(axis=0) == pytest.approx(points.max(axis=0), rel=1e-5)
    assert 4 <= len(corners) <= 4 + DIRECTIONS - 2 or not found.damped


@pytest.mark.parametrize("name", ["euler", "heun", "rk4"])
@pytest.mark.parametrize("more", [{}, {"drag": 0.0, "damping": np.full(1, 0.3)}], ids=["both", "damping"])
def test_no_limit_is_below_the_bound(name: str, more: dict[str, Any]) -> None:
    """And RK4's is no trifle, a fifth of the limit at least; the others need damping, which may be none."""
    system, polynomial = net(**more), stability_polynomial(find(name))
    assert polynomial is not None
    bound, limit = (
        limit_from_below(polynomial, linear(system)),
        stability_limit(find(name), spring_equilibrium(system)).dt,
    )
    assert limit is not None
    assert bound <= limit * (1 + 1e-9)
    assert bound > 0.2 * limit or name != "rk4"


def test_limits_of_oscillators_by_hand() -> None:
    """Euler: g/w^2 where it swings, 2 over the faster rate where not: (g + sqrt(g^2 - 4 w^2))/2; undamped 0."""
    euler = (1.0, 1.0)
    assert _limits(euler, np.array([[100.0, 4.0]])).min() == pytest.approx(0.04, rel=1e-12)
    assert _limits(euler, np.array([[16.0, 10.0]])).min() == pytest.approx(2 / 8, rel=1e-12)
    assert _limits(euler, np.array([[0.0, 10.0]])).min() == pytest.approx(2 / 10, rel=1e-12)
    assert _limits(euler, np.array([[9.0, 0.0]])).min() == 0.0
    assert _limits(euler, np.array([[9.0, -1e-9]])).min() == 0.0


@pytest.mark.parametrize(
    ("normal", "most", "kept"),
    [
        ((1.0, 1.0), 2.0, [(0, 0), (2, 0), (0, 2)]),
        ((1.0, 0.0), 1.5, [(0, 0), (1.5, 0), (1.5, 2), (0, 2)]),
        ((1.0, 1.0), 3.0, [(0, 0), (2, 0), (2, 1), (1, 2), (0, 2)]),
        ((1.0, 1.0), 5.0, [(0, 0), (2, 0), (2, 2), (0, 2)]),
        ((1.0, 1.0), -1.0, [(0, 0), (2, 0), (2, 2), (0, 2)]),
    ],
)
def test_a_square_is_cut_along_a_line(
    normal: tuple[float, float], most: float, kept: list[tuple[float, float]]
) -> None:
    """What is on the line stays; of what would be nothing all is kept."""
    square: Array = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    assert _clipped(square, np.array(normal), most) == pytest.approx(np.array(kept))


def test_a_polynomials_limit_of_large_systems_is_one_value_where_all_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    """All rates, or nothing but swings; else it lies between what the range and what the outermost rates tell."""
    heun, rest = (1.0, 1.0, 0.5), spring_equilibrium(find_scene("string").system({"masses": 2}))
    monkeypatch.setattr(limits, "limit_from_below", lambda *_: below)
    rk4, below = (1.0, 1.0, 0.5, 1 / 6, 1 / 24), 0.9
    swings, mixed, decays = (np.array(v, dtype=complex) for v in ([10j, -10j], [10j, -10j, -1 + 2j], [-2.0, -1.0]))
    assert limits._by_polynomial(rk4, rest, Rates(swings, 0, False)).dt == pytest.approx(np.sqrt(8) / 10)
    for rates, whole in ((decays, True), (decays, False), (mixed, False)):
        limit = limits._by_polynomial(heun if rates is decays else rk4, rest, Rates(rates, 0, whole))
        first = 1.0 if rates is decays else np.sqrt(8) / 10
        if whole:
            assert (limit.dt, limit.certainty, limit.at_most) == (pytest.approx(first), "computed", None)
        else:
            below = 0.5 * first
            limit = limits._by_polynomial(heun if rates is decays else rk4, rest, Rates(rates, 0, whole))
            assert (limit.dt, limit.certainty, limit.at_most) == (below, "between", pytest.approx(first))
            below = first
            assert limits._by_polynomial(heun if rates is decays else rk4, rest, Rates(rates, 0, whole)).at_most is None
    low, high = 2 - np.sqrt(2 / 3), 2 + np.sqrt(2 / 3)
    windows = limits._by_polynomial((1.0, 2.4, 0.6), rest, Rates(np.array([-1.0 + 0j]), 0, True))
    assert windows.dt == pytest.approx(low)
    assert np.array(windows.windows) == pytest.approx(np.array([[high, 4.0]]))
