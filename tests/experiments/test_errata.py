"""Errata, executed: the numbers of its remarks, by hand."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from experiments import errata
from experiments.errata import DURATION, _barrier, _barrier_remarks, _derivative_listing, _next_spring
from reference.lecture.listings import listings
from reference.scenes import find
from reference.schemes import catalogue
from reference.simulate import simulate
from reference.stepper import catalogued


def test_what_the_barriers_two_rules_leave_of_a_sliding_mass() -> None:
    """Printed, (v_x t_x, v_y t_y) with t = (n_y, -n_x), of v = -t: along it, t_x^3 + t_y^3, which is -1, 0, 1.

    At 0, 45 and 90 degrees. Meant, all of it; to the rounding of sines and cosines.
    """
    angles, printed, projected = _barrier()
    t = np.column_stack([np.sin(angles), -np.cos(angles)])
    assert np.degrees(angles) == pytest.approx(np.arange(0, 361, 5))
    assert printed == pytest.approx((t**3).sum(axis=1), abs=1e-12)
    assert projected == pytest.approx(np.ones(73), abs=1e-12)
    remarks = [
        (slide, measured.rpartition("left ")[2], value, unit) for slide, _, measured, value, unit in _barrier_remarks()
    ]
    assert remarks == [
        ("17", "at the right", pytest.approx(-1.0), "m/s"),
        ("17", "half-way up", pytest.approx(0.0, abs=1e-12), "m/s"),
        ("17", "at the top", pytest.approx(1.0), "m/s"),
        ("17", "anywhere", pytest.approx(1.0), "m/s"),
    ]


def test_the_force_from_the_next_node_at_rest() -> None:
    """By hand k (-D0 - D0) as printed, and none as meant; with k = 200 N/m and D0 = 0.125 m."""
    printed, meant = ((value, unit) for *_, value, unit in _next_spring())
    assert printed == (-2 * 200.0 * 0.125, "N")
    assert meant == (0.0, "N")


def test_the_acceleration_without_the_second_spring() -> None:
    """Hanging at rest the spring above the top link carries all ten masses: 10 m g / m, less g. To 1e-9 of it."""
    cut, whole = ((value, unit) for *_, value, unit in _derivative_listing())
    g = -float(find("string").system({}).gravity[1])
    links = int((~find("string").system({}).fixed).sum())
    assert cut == (pytest.approx((links - 1) * g, rel=1e-9), "m/s^2")
    assert whole == (pytest.approx(0.0, abs=1e-8), "m/s^2")


def test_the_distance_is_that_between_the_two_listings(monkeypatch: pytest.MonkeyPatch) -> None:
    """None, as they are; and with Euler in the place of one, that of Heun and Euler after 500 steps of 1 ms."""
    apart, itself = ((value, unit) for *_, value, unit in errata._incorrect_listing())
    assert (apart, itself) == ((0.0, "m"), (0.0, "m"))
    doctored = {**listings(), "lecture_heun_loops": catalogued()["euler"]}
    monkeypatch.setattr(errata, "listings", lambda: doctored)
    apart, itself = (value for *_, value, _ in errata._incorrect_listing())
    system = find("string").system({"drag": 0.02})
    heun, euler = (simulate(system, catalogue.find(name), 1e-3, 0.5).positions for name in ("heun", "euler"))
    assert apart == pytest.approx(np.linalg.norm(heun - euler, axis=2).max(), rel=1e-9)
    assert itself == 0.0
    assert DURATION < 0.5


def test_what_is_left_is_read_off_at_its_angle(monkeypatch: pytest.MonkeyPatch) -> None:
    """At 0, 45 and 90 degrees, the first, tenth and nineteenth of those 5 degrees apart; and the least of all."""
    angles = np.arange(73.0)
    monkeypatch.setattr(errata, "_barrier", lambda: (angles, 100 + angles, 0.9 - np.sin(angles / 23)))
    left = [value for *_, value, _ in _barrier_remarks()]
    assert left == [100.0, 109.0, 118.0, (0.9 - np.sin(angles / 23)).min()]


def test_an_order_is_told_by_the_two_smallest_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of errors of (f + 1)^-3 with a step of DT/f, at all of the true times: 3 log2(9/5) from 4 to 8, by hand."""
    system = find("string").system({"drag": 0.02})
    true = SimpleNamespace(positions=np.zeros((5, len(system.masses), 2)))

    def run(_: object, scheme: object, dt: float, duration: float) -> SimpleNamespace:
        finer = round(errata.DT / dt)
        positions = np.full((4 * finer + 1, len(system.masses), 2), 9.0)
        positions[::finer] = 0.0
        positions[2 * finer, 1] = [(finer + 1) ** -3.0, 0.0]
        return SimpleNamespace(positions=positions)

    monkeypatch.setattr(errata, "simulate", run)
    monkeypatch.setattr(errata, "exact", lambda *_: true)
    orders = errata._orders(lambda _: None)
    assert list(orders) == ["euler", "euler_in_place", "heun", "heun_link_by_link", "heun_aliased"]
    for steps, errors, order in orders.values():
        assert steps == [errata.DT / f for f in (1, 2, 4, 8)]
        assert errors == pytest.approx([1 / 8, 1 / 27, 1 / 125, 1 / 729])
        assert order == pytest.approx(3 * np.log2(9 / 5))
