"""Scenes as they are built, with parameters that differ from one another: places, sizes and obstacles by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.changes import Change
from reference.errors import InputError
from reference.forces import SpringMotion
from reference.obstacles import Box, Circle, Sphere
from reference.scenes import Setup, find
from reference.state import State


def test_a_slinky_hangs_at_rest() -> None:
    """4 coils of 0.5 kg on 3 springs of 36 N/m without length: they carry 15, 10 and 5 N. Nothing is fixed."""
    slinky = find("slinky").system(
        {"masses": 4, "mass": 2.0, "stiffness": 12.0, "gravity": 10.0, "damping": 0.3, "drag": 0.1}
    )
    lengths = np.array([15, 10, 5]) / 36
    assert slinky.positions[:, 0] == pytest.approx(-np.concatenate([[0.0], np.cumsum(lengths)]), rel=1e-14)
    assert slinky.springs.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert (slinky.masses.tolist(), slinky.stiffness.tolist()) == ([0.5] * 4, [36.0] * 3)
    assert (slinky.damping.tolist(), slinky.drag, slinky.gravity.tolist()) == ([0.3] * 3, 0.1, [-10.0])
    assert not slinky.rest_lengths.any()
    assert not slinky.fixed.any()
    pulled = SpringMotion(slinky).acceleration(slinky.start)
    assert pulled[:, 0] == pytest.approx([-40.0, 0.0, 0.0, 0.0], abs=1e-12)
    assert len(find("slinky").system({"masses": 2}).masses) == 2
    with pytest.raises(InputError, match="masses = 1: expected a whole number from 2"):
        find("slinky").system({"masses": 1})


def test_what_hangs_along_a_line() -> None:
    """Below an anchor at 0, upwards positive; each mass, spring and damper as it is listed."""
    chain = find("chain").system(
        {"masses": 3, "mass": "1,2,3", "rest_length": "0.1,0.2,0.4", "stiffness": "10,20,30", "damping": "1,0,2",
         "drag": 0.5, "gravity": 2.0}
    )  # fmt: skip
    assert chain.positions[:, 0] == pytest.approx([0.0, -0.1, -0.3, -0.7], rel=1e-14)
    assert (chain.masses[1:].tolist(), chain.rest_lengths.tolist()) == ([1.0, 2.0, 3.0], [0.1, 0.2, 0.4])
    assert (chain.stiffness.tolist(), chain.damping.tolist()) == ([10.0, 20.0, 30.0], [1.0, 0.0, 2.0])
    assert (chain.drag, chain.gravity.tolist(), chain.fixed.tolist()) == (0.5, [-2.0], [True, False, False, False])
    oscillator = find("oscillator").system({"rest_length": 0.5, "stretch": 0.25, "velocity": 3.0, "mass": 0.7})
    assert oscillator.positions.tolist() == [[0.0], [-0.75]]
    assert oscillator.velocities.tolist() == [[0.0], [3.0]]
    assert oscillator.masses[1] == 0.7


@pytest.mark.parametrize("angle", [0.0, 30.0, 90.0, 180.0])
def test_a_string_at_an_angle(angle: float) -> None:
    """Below the horizontal, from where it is hung, with springs of one length or of several; exact at right angles."""
    across, down = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    for words, reach in (("0.2,0.3,0.1", [0.0, 0.2, 0.5, 0.6]), ("0.1,0.1,0.1", 0.1 * np.arange(4))):
        string = find("string").system({"masses": 3, "rest_length": words, "angle": angle, "x0": 1.0, "y0": 2.0})
        expected = np.array([[1.0 + across * r, 2.0 - down * r] for r in reach])
        np.testing.assert_allclose(string.positions, expected, atol=2e-16 * 4)
        if angle == 90.0:
            assert set(string.positions[:, 0]) == {1.0}


def test_a_barrier_stands_where_it_is_put() -> None:
    """Under the string of the same parameters."""
    settings = {"masses": 4, "angle": 20.0, "drag": 0.1, "damping": 0.3}
    barrier = find("barrier").system({**settings, "circle_x": 0.25, "circle_y": -0.75, "radius": 0.125})
    assert barrier.obstacles == (Circle((0.25, -0.75), 0.125),)
    string = find("string").system(settings).to_dict()
    assert {**barrier.to_dict(), "obstacles": None} == {**string, "obstacles": None}


#: Of 4 rows and 3 columns at 0.6 m; threads, diagonals and springs over one mass by their stiffness.
LEVEL = {"rows": 4, "columns": 3, "rest_length": 0.6, "mass": 0.25, "stiffness": 9.0, "shear": 5.0, "bend": 2.0,
         "damping": 0.7, "drag": 0.3, "gravity": 4.0}  # fmt: skip


@pytest.mark.parametrize("name", ["falling_cloth", "tablecloth"])
def test_cloths_that_fall_lie_level_and_nothing_holds_them(name: str) -> None:
    """17 threads, 12 diagonals and 10 springs over one mass: of their lengths, and each as stiff as it says."""
    cloth = find(name).system(LEVEL)
    lengths = cloth.rest_lengths / 0.6
    assert sorted(zip(cloth.stiffness.tolist(), lengths.round(9).tolist(), strict=True)) == sorted(
        [(9.0, 1.0)] * 17 + [(5.0, round(np.sqrt(2), 9))] * 12 + [(2.0, 2.0)] * 10
    )
    assert (set(cloth.damping.tolist()), cloth.drag, set(cloth.masses.tolist())) == ({0.7}, 0.3, {0.25})
    assert cloth.gravity.tolist() == [0.0, -4.0, 0.0]
    assert not cloth.fixed.any()
    assert np.ptp(cloth.positions, axis=0) == pytest.approx([1.2, 0.0, 1.8])
    for wrong in ("shear", "bend"):
        with pytest.raises(InputError, match=f"{wrong} = -1"):
            find(name).system({**LEVEL, wrong: -1.0})


def test_what_cloths_fall_onto() -> None:
    """A sphere, its top 2 cm below the middle; a table, beyond whose edge a part of the columns hangs."""
    falling = find("falling_cloth").system({**LEVEL, "radius": 0.2})
    middle = falling.positions.mean(axis=0)
    (sphere,) = falling.obstacles
    assert isinstance(sphere, Sphere)
    assert sphere.radius == 0.2
    assert sphere.centre == pytest.approx(middle - [0.0, 0.22, 0.0], rel=1e-14)
    lying = find("tablecloth").system({**LEVEL, "overhang": 0.25})
    (table,) = lying.obstacles
    assert isinstance(table, Box)
    low, high = np.array(table.centre) - table.half_sizes, np.array(table.centre) + table.half_sizes
    # 1.2 m by 1.8 m of cloth at the height 0, the first corner at 0; the table three times as wide each way
    assert high[0] == pytest.approx(0.9)
    assert (high[1], low[1]) == pytest.approx((lying.positions[0, 1], lying.positions[0, 1] - 0.2), abs=1e-15)
    assert high - low == pytest.approx([3.6, 0.2, 5.4])
    assert (low[2] + high[2]) / 2 == pytest.approx(lying.positions[:, 2].mean())


def test_a_bridge_is_as_heavy_as_its_members_its_deck_and_its_truck() -> None:
    """7 kg/m of every member, 3 kg/m of deck over 6 m; and a truck of 40 kg, with its centre where it stands."""
    settings = {"panels": 2, "panel": 3.0, "height": 2.0, "mass_per_length": 7.0, "deck": 3.0}
    empty, laden = (
        find("bridge").system({**settings, "truck": truck, "truck_position": at})
        for truck, at in ((0.0, 0.0), (40.0, 5.0))
    )
    # the last spring and the last mass are of the rocker
    assert empty.masses[:-1].sum() == pytest.approx(7 * empty.rest_lengths[:-1].sum() + 3 * 6, rel=1e-12)
    more, along = (laden.masses - empty.masses)[:-1], empty.positions[:-1, 0]
    assert more.sum() == pytest.approx(40.0)
    assert (more * along).sum() == pytest.approx(40 * 5, rel=1e-12)
    at_the_end = find("bridge").system({**settings, "truck": 40.0, "truck_position": 6.0}).masses - empty.masses
    assert (at_the_end[:-1] * along).sum() == pytest.approx(40 * 6, rel=1e-12)


def test_a_bridge_before_a_truck_comes() -> None:
    """It is as heavy as without one; and the truck goes over the joints of its lower chord, at its speed."""
    settings: dict[str, Any] = {"panels": 3, "panel": 2.0, "height": 1.5, "damping": 7.0, "drag": 3.0, "gravity": 5.0}
    driven = find("crossing").driven({**settings, "truck": 40.0, "speed": 6.0})
    bridge = find("bridge").system({**settings, "truck": 0.0, "truck_position": 0.0})
    assert driven.system.masses.tolist() == bridge.masses.tolist()
    assert (driven.system.damping.tolist(), driven.system.drag) == (bridge.damping.tolist(), 3.0)
    (crossing,) = driven.drives
    # two seconds in at 6 m/s it has gone 12 m, the bridge is 6 m long: it was on it in the first second
    heaviest = [change.time for change in crossing.changes(driven.system, 0.01, 2.0)]
    assert 0.9 < max(heaviest) <= 1.01


def test_the_ground_shakes_under_a_bridge_with_a_truck_in_its_middle() -> None:
    """Along the axis that is asked for, with its amplitude, while it shakes; on rock or on soil."""
    settings: dict[str, Any] = {"panels": 4, "panel": 2.0, "height": 1.5, "truck": 40.0, "damping": 7.0, "gravity": 5.0}
    for ground, scene in (("rock", "bridge"), ("soil", "soil")):
        driven = find("earthquake").driven({**settings, "on": ground, "shaking": 0.5})
        standing = find(scene).system({**settings, "truck_position": 4.0})
        assert driven.system.masses.tolist() == standing.masses.tolist()
        assert driven.system.damping.tolist() == standing.damping.tolist()
    for axis, at in (("x", 0), ("y", 1)):
        driven = find("earthquake").driven({**settings, "axis": axis, "amplitude": 3.0, "shaking": 0.5})
        changes = driven.changes(1e-3, 2.0)
        values = np.array([change.value for change in changes]) - [0.0, -5.0]
        # ground that is accelerated upwards makes all heavier
        assert np.abs(values[:, at]).max() == pytest.approx(3.0, rel=1e-3)
        assert not values[:, 1 - at].any()
        assert values[0, at] < 0
        assert 0.49 < changes[-1].time < 0.51
    for wrong in (0.0, -1.0, np.inf):
        with pytest.raises(InputError, match="shaking"):
            find("earthquake").driven({"shaking": wrong})


def test_what_every_scene_takes_besides() -> None:
    """Kinds of springs, bending, radii and restitution: one number or a list; none of it where it is not asked for."""
    string = find("string").system(
        {"masses": 3, "hardening": "1,2,3", "radii": "0.01,0.02,0.03,0.01", "restitution": 0.5, "angular_stiffness": 7}
    )
    assert string.nonlinear is not None
    assert string.collisions is not None
    assert string.angular_springs is not None
    assert string.nonlinear.hardening.tolist() == [1.0, 2.0, 3.0]
    assert (string.collisions.radii.tolist(), string.collisions.restitution) == ([0.01, 0.02, 0.03, 0.01], 0.5)
    assert string.angular_springs.stiffness.tolist() == [7.0, 7.0]
    plain = find("string").system({"masses": 3})
    assert (plain.nonlinear, plain.collisions, plain.angular_springs) == (None, None, None)
    ropes = find("string").system({"masses": 3, "tension_only": True}).nonlinear
    assert ropes is not None
    assert ropes.tension_only.all()
    assert not ropes.hardening.any()
    assert find("string").system({"masses": 3, "tension_only": True}).angular_springs is None
    with pytest.raises(InputError, match="restitution"):
        find("string").system({"masses": 3, "radii": 0.01, "restitution": "0.1,0.2"})


def test_a_setup_knows_its_system_at_every_step() -> None:
    """A change acts from its step on: seen after it, and not before; and it has to be in the run."""
    changes = (Change(0.2, "drag", 2.0), Change(0.1, "drag", 1.0), Change(0.2, "mass", 5.0))
    setup = Setup("mine", find("string").system({"masses": 2}), 0.1, 0.5, changes)
    assert (setup.steps, setup.run_duration) == (5, 0.5)
    seen = setup.systems_at([0, 1, 2, 2, 3, 5])
    assert [system.drag for system in seen] == [0.0, 0.0, 1.0, 1.0, 2.0, 2.0]
    assert [system.masses[1] for system in seen] == [0.02] * 4 + [5.0] * 2
    Setup("mine", setup.system, 0.1, 0.5, (Change(0.4, "drag", 1.0),)).check()
    with pytest.raises(InputError, match=r"change of drag at 0.5 s: expected at most 0.4 s, when the last step begins"):
        Setup("mine", setup.system, 0.1, 0.5, (Change(0.5, "drag", 1.0),)).check()
    assert isinstance(setup.system.start, State)
