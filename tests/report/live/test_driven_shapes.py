"""What drives a scene, drawn with it: where the truck is, how long arrows are, what stands under fixed masses."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.driven_shapes import DrivenShapes, truck_place
from tests.report.live.viewer import Drawn, viewer

#: 4 m wide; the two at the ends are held, one higher than the other.
SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 1.0], [1.0, 0.0], [3.0, -0.5], [4.0, 0.5]]),
    springs=np.array([[0, 1], [1, 2], [2, 3]]),
    masses=np.array(2.0),
    rest_lengths=np.array(1.0),
    stiffness=np.array(100.0),
    fixed=np.array([True, False, False, True]),
)
SHIFT = np.array([10.0, 20.0, 0.5])


def shapes(
    *driven: str, ground: bool = False, system: MassSpringSystem = SYSTEM
) -> tuple[DrivenShapes, dict[str, Drawn]]:
    """Of a scene that changes these parameters itself."""
    client = viewer()

    def box(name: str, colour: Any, dimensions: Any, visible: bool) -> Drawn:
        client.nodes[name] = Drawn(name, dimensions=dimensions, visible=visible)
        return client.nodes[name]

    client.scene.add_box.side_effect = box
    opened: Any = SimpleNamespace(system=system, driven=frozenset(driven), ground_moves=ground)
    made = DrivenShapes(client, "/lane0", opened, SHIFT)
    nodes: dict[str, Drawn] = client.nodes
    assert {id(node) for node in made.nodes} == {id(node) for node in nodes.values()}
    return made, nodes


def at(*places: tuple[float, ...]) -> State:
    """Masses at rest there."""
    x = np.array(places)
    return State(0.0, x, np.zeros_like(x))


def heavier(*more: float) -> MassSpringSystem:
    """With so much more of mass on each [kg]."""
    return replace(SYSTEM, masses=SYSTEM.masses + np.array(more))


def test_nothing_is_drawn_of_a_scene_that_nothing_drives() -> None:
    """Nor of a parameter that cannot be seen."""
    made, nodes = shapes("stiffness")
    assert nodes == {}
    made.show(SYSTEM, SYSTEM.start)


def test_the_truck_stands_on_what_carries_it() -> None:
    """In the middle of the masses that have come on, above by half its height; it is there only then."""
    made, nodes = shapes("mass")
    (truck,) = nodes.values()
    long, high, wide = truck.dimensions
    assert long > high > wide > 0
    assert long == pytest.approx(0.06 * 4)
    assert not truck.visible
    made.show(SYSTEM, SYSTEM.start)
    assert not truck.visible
    state = at((0.0, 1.0), (1.0, -0.2), (3.0, -0.6), (4.0, 0.5), (99.0, 99.0))
    made.show(heavier(0.0, 3.0, 1.0, 0.0), state)
    assert truck.visible
    assert truck.position == pytest.approx((10 + 1.5, 20 - 0.3 + high / 2, 0.5))
    made.show(SYSTEM, state)
    assert not truck.visible


@pytest.mark.parametrize(("more", "seen"), [(1e-10, False), (1e-7, True)])
def test_rounding_is_no_truck(more: float, seen: bool) -> None:
    """A thousand-millionth of all masses."""
    assert (truck_place(SYSTEM, heavier(0.0, more, 0.0, 0.0), SYSTEM.start) is not None) == seen


def arrow(points: Array) -> tuple[Array, Array]:
    """Where an arrow begins and ends; its head is symmetric, and behind its end."""
    (begin, end), (tip, left), (other, right) = points
    along = end - begin
    assert np.array_equal(tip, end)
    assert np.array_equal(other, end)
    middle = (left + right) / 2
    assert middle == pytest.approx(end - 0.3 * along, abs=1e-5)
    assert (left - right) @ along == pytest.approx(0, abs=1e-5)
    assert np.linalg.norm(left - right) == pytest.approx(0.4 * np.linalg.norm(along), rel=1e-4)
    return begin, end


def test_ground_that_moves_has_a_bar_under_each_held_mass_and_its_acceleration_as_an_arrow() -> None:
    """Below the lowest bar; as long as 15 % of the size at 1 m/s^2; named below."""
    made, nodes = shapes("gravity", ground=True)
    line, label = nodes["/lane0/drive"], nodes["/lane0/says"]
    assert np.array_equal(line.position, SHIFT)
    made.show(replace(SYSTEM, gravity=np.array([-2.0, -9.81 - 1.0])), SYSTEM.start)
    bars, points = line.points[:2], line.points[2:]
    assert bars[:, :, 0] == pytest.approx(np.array([[-0.2, 0.2], [3.8, 4.2]]))
    assert bars[:, :, 1] == pytest.approx(np.array([[0.92, 0.92], [0.42, 0.42]]))
    assert not bars[:, :, 2].any()
    begin, end = arrow(points)
    assert begin == pytest.approx([2.0, 0.42 - 0.4, 0.0])
    assert end - begin == pytest.approx([0.6 * 2.0, 0.6 * 1.0, 0.0])
    assert label.shape == ("acceleration of the ground, which this is seen from",)
    assert label.anchor == "top-center"
    assert label.position == pytest.approx(SHIFT + begin + np.array([0.0, -0.12, 0.0]))


@pytest.mark.parametrize("ground", [False, True])
def test_gravity_that_swings_is_an_arrow_without_ground(ground: bool) -> None:
    """Below the lowest mass; as long as 15 % of the size at 9.81 m/s^2; and so where nothing is held."""
    system = replace(SYSTEM, fixed=np.zeros(4, bool)) if ground else SYSTEM
    made, nodes = shapes("gravity", ground=ground, system=system)
    line, label = nodes["/lane0/drive"], nodes["/lane0/says"]
    start, end = arrow(line.shape[0])
    assert end[1] < start[1]
    made.show(replace(system, gravity=np.array([9.81, -9.81 / 2])), system.start)
    begin, end = arrow(line.points)
    assert begin == pytest.approx([2.0, -0.5 - 0.4, 0.0])
    assert end - begin == pytest.approx([0.6, -0.3, 0.0])
    assert (label.shape, label.anchor) == (("gravity",), "bottom-center")
    assert label.position == pytest.approx(SHIFT + begin + np.array([0.0, 0.12, 0.0]))


def test_along_a_line_all_is_upwards() -> None:
    """The arrow of a chain's gravity."""
    chain = MassSpringSystem(
        positions=np.array([[0.0], [-1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        fixed=np.array([True, False]),
    )
    made, nodes = shapes("gravity", system=chain)
    made.show(replace(chain, gravity=np.array([-9.81])), chain.start)
    begin, end = arrow(nodes["/lane0/drive"].points)
    assert begin == pytest.approx([0.0, -1.1, 0.0])
    assert end - begin == pytest.approx([0.0, -0.15, 0.0])
