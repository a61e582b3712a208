"""What a stage shows of scenes made by hand: which shapes, where, how large, and what a viewer does to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.colours import FIXED_COLOUR, LANE_COLOURS, as_light, of_strain
from report.live.framing import Window, box, camera, side_by_side
from report.live.stage import PANELS, Stage
from tests.report.live.viewer import Drawn, viewer


def row(masses: int = 3, dimension: int = 2, obstacles: Sequence[Obstacle] = ()) -> MassSpringSystem:
    """Masses 1 m apart to the right, the first of which is held."""
    places = np.zeros((masses, dimension))
    places[:, 0] = np.arange(masses)
    return MassSpringSystem(
        positions=places,
        springs=np.column_stack([np.arange(masses - 1), np.arange(1, masses)]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        fixed=np.arange(masses) == 0,
        obstacles=tuple(obstacles),
    )


def at(places: Array) -> State:
    """At rest, shape (n, d) [m]."""
    return State(0.0, places, np.zeros_like(places))


def timeline(system: MassSpringSystem, *places: Array, true: State | None = None) -> Any:
    """Lanes whose masses are at these places, shape (n, d) [m]; one at the start where none are given."""
    states = [at(x) for x in places] or [system.start]
    return SimpleNamespace(
        system=system,
        lanes=[SimpleNamespace(state=state) for state in states],
        steppers=("euler", "heun", "rk4", "kick_drift")[: len(states)],
        opened=SimpleNamespace(system=system, driven=(), ground_moves=False),
        reference=SimpleNamespace(state=true),
    )


def stage(client: Any, on_drag: Any = None, on_click: Any = None) -> Stage:
    """Told of nothing, if not asked for."""
    return Stage(client, on_drag or (lambda i, place: None), on_click or (lambda i: None))


def nodes(shown: Any, client: Any = None, beside: bool = False) -> dict[str, Drawn]:
    """All that is drawn of a timeline."""
    client = client or viewer()
    made = stage(client)
    made.beside = beside
    made.show(shown)
    return dict(client.nodes)


def test_masses_are_balls_and_springs_lines_in_the_lanes_colours() -> None:
    """What is held has its own colour; both ends of a spring that of its strain, here 5 % of 10 and none."""
    system = row()
    moved = np.array([[0.0, 0.0], [1.05, 0.0], [2.05, 0.0]])
    drawn = nodes(timeline(system, system.positions, moved))
    for i, places in enumerate((system.positions, moved)):
        balls, lines = drawn[f"/lane{i}/masses"], drawn[f"/lane{i}/springs"]
        in_space = np.pad(places, ((0, 0), (0, 1))).astype(np.float32)
        assert np.array_equal(balls.batched_positions, in_space)
        assert np.array_equal(lines.points, in_space[system.springs])
        wanted = as_light(np.array([FIXED_COLOUR, LANE_COLOURS[i], LANE_COLOURS[i]]))
        assert np.array_equal(balls.batched_colors, wanted)
        assert balls.batched_wxyzs.tolist() == [[1, 0, 0, 0]] * 3
    made = stage(viewer())
    made.show(timeline(system))
    strains = np.array([0.05, 0.0])
    colours = as_light(of_strain(strains, made.strain_shown, 1))
    assert np.array_equal(lines.colors, np.stack([colours, colours], axis=1))


def test_the_lane_in_front_is_thick_and_the_others_are_seen_through() -> None:
    """Side by side all are as clear. Of more than 200 masses all lines are thin, and balls small."""
    for beside in (False, True):
        drawn = nodes(timeline(row(), *[row().positions] * 2), beside=beside)
        assert drawn["/lane0/springs"].thickness > drawn["/lane1/springs"].thickness
        assert drawn["/lane0/masses"].opacity is None
        assert (drawn["/lane1/masses"].opacity is None) == beside
        assert beside or 0.3 < drawn["/lane1/masses"].opacity < 0.9
    few, many = (nodes(timeline(row(n))) for n in (200, 201))
    thin = nodes(timeline(row(), *[row().positions] * 2))["/lane1/springs"].thickness
    assert few["/lane0/springs"].thickness > many["/lane0/springs"].thickness == thin > 0
    few_radius, radius = (drawn["/lane0/masses"].shape[0].max() / (n - 1) for drawn, n in ((few, 200), (many, 201)))
    assert 0.03 > few_radius > 2 * radius > 0


def test_a_ball_is_round_and_its_faces_look_outwards() -> None:
    """32 triangles without a hole: every edge is that of two faces, once in each direction."""
    corners, faces = nodes(timeline(row()))["/lane0/masses"].shape
    radius = np.linalg.norm(corners, axis=1)
    assert radius == pytest.approx(np.full(18, radius[0]))
    assert len(np.unique(np.round(corners / radius[0], 6), axis=0)) == 18
    edges = {(a, b) for face in faces.tolist() for a, b in zip(face, [*face[1:], face[0]], strict=True)}
    assert len(edges) == 3 * len(faces) == 96
    assert {(b, a) for a, b in edges} == edges
    a, b, c = (corners[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    assert ((normals * (a + b + c)).sum(axis=1) > 0).all()
    lengths = np.linalg.norm(np.concatenate([b - a, c - b, a - c]), axis=1)
    assert lengths.max() < 1.5 * lengths.min()


def test_lanes_side_by_side_have_their_names_above_them() -> None:
    """In the middle of what there is to see; over one another they have none, and no shift."""
    system = replace(row(), positions=np.array([[0.5, 0.0], [1.5, 0.0], [1.5, 1.0]]))
    client = viewer()
    made = stage(client)
    shown = timeline(system, *[system.positions] * 3)
    made.show(shown)
    assert not [name for name in client.nodes if name.endswith("/name")]
    assert not client.nodes["/lane2/springs"].position.any()
    made.beside = True
    made.show(shown)
    low, high = box(system)
    shifts = side_by_side(system, 3, made._window())
    for i, name in enumerate(shown.steppers):
        label = client.nodes[f"/lane{i}/name"]
        assert label.shape == (name,)
        assert label.position == pytest.approx(shifts[i] + [(low[0] + high[0]) / 2, high[1], 0.0])
        for part in ("springs", "masses"):
            assert np.array_equal(client.nodes[f"/lane{i}/{part}"].position, shifts[i])
    assert np.ptp(shifts, axis=0).any()


def test_what_is_shown_is_built_anew_only_where_it_is_another_scene() -> None:
    """Or other lanes or another number of springs: what stood there is taken away, and nothing else."""
    client, system = viewer(), row()
    made, shown = stage(client), timeline(system, system.positions)
    made.show(shown)
    first = dict(client.nodes)
    shown.lanes[0].state = at(system.positions + 0.1)
    made.show(shown)
    assert dict(client.nodes) == first
    assert first["/lane0/springs"].points[0, 1, :2] == pytest.approx([1.1, 0.1])
    assert first["/lane0/masses"].batched_positions[2, :2] == pytest.approx([2.1, 0.1])
    shown.steppers = ("rk4",)
    made.show(shown)
    assert all(node.removed for node in first.values())
    assert not any(node.removed for node in client.nodes.values())


def test_masses_that_are_held_by_hand_are_painted_so() -> None:
    """In every lane."""
    client, system = viewer(), row()
    made, shown = stage(client), timeline(system, *[system.positions] * 2)
    made.show(shown)
    shown.system = replace(system, fixed=np.array([False, False, True]))
    made.repaint(shown)
    for i in (0, 1):
        wanted = as_light(np.array([LANE_COLOURS[i], LANE_COLOURS[i], FIXED_COLOUR]))
        assert np.array_equal(client.nodes[f"/lane{i}/masses"].batched_colors, wanted)


@pytest.mark.parametrize(
    ("obstacle", "kind", "place"),
    [
        (Circle((0.5, -1.0), 0.25), "disc", (0.5, -1.0, 0.0)),
        (Sphere((0.5, -1.0, 0.2), 0.25), "sphere", (0.5, -1.0, 0.2)),
        (Box((0.5, -1.0), (0.3, 0.2)), (0.6, 0.4, 0.001), (0.5, -1.0, 0.0)),
        (Box((0.5, -1.0, 0.2), (0.3, 0.2, 0.1)), (0.6, 0.4, 0.2), (0.5, -1.0, 0.2)),
        (Plane((0.5, -1.0), (0.0, 1.0)), "grid", (0.5, -1.0, 0.0)),
        (Plane((0.5, -1.0, 0.2), (0.0, 1.0, 0.0)), "grid", (0.5, -1.0, 0.2)),
    ],
    ids=lambda value: type(value).__name__,
)
def test_obstacles_are_where_they_are_and_as_large(obstacle: Obstacle, kind: Any, place: Array) -> None:
    """In every lane, moved with it; flat ones at no depth. A bar without ends has no shape."""
    bar = [Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.1)] if obstacle.dimension == 3 else []
    system = row(dimension=obstacle.dimension, obstacles=[*bar, obstacle])
    drawn = nodes(timeline(system, *[system.positions] * 2), beside=True)
    for i in (0, 1):
        node = drawn[f"/lane{i}/obstacle{len(bar)}"]
        assert node.position == pytest.approx(np.array(place) + drawn[f"/lane{i}/springs"].position)
        if kind == "disc":
            corners, faces = node.shape
            areas = 0.5 * np.cross(
                corners[faces[:, 1]] - corners[faces[:, 0]], corners[faces[:, 2]] - corners[faces[:, 0]]
            )
            assert areas[:, 2].min() > 0
            assert areas.sum(axis=0) == pytest.approx([0, 0, np.pi * 0.25**2], rel=2e-3)
        elif kind == "sphere":
            assert node.radius == 0.25
        elif kind == "grid":
            assert node.plane == "xz"
            assert 0 < node.cell_size < node.fade_distance < node.width == node.height
        else:
            assert node.dimensions == pytest.approx(kind)
    assert "/lane0/obstacle0" in drawn or bar


def test_the_true_motion_comes_and_goes() -> None:
    """Where it is known and wanted; it is drawn once, and moved."""
    client, system = viewer(), row()
    made, shown = stage(client), timeline(system)
    made.show(shown)
    assert "/true" not in client.nodes
    shown.reference.state = system.start
    made.show(shown)
    node = client.nodes["/true"]
    assert node.visible
    assert node.thickness > client.nodes["/lane0/springs"].thickness
    shown.reference.state = at(system.positions + 1.0)
    made.show(shown)
    assert client.nodes["/true"] is node
    assert node.points[0, 0, :2].tolist() == [1, 1]
    made.show_true = False
    made.show(shown)
    assert not node.visible
    made.show_true = True
    made.show(shown)
    assert node.visible
    solid = row(dimension=3)
    drawn = nodes(timeline(solid, true=solid.start))
    assert drawn["/true"].thickness == drawn["/lane0/springs"].thickness / 2


def test_a_mass_is_dragged_where_the_cursor_is_and_let_go() -> None:
    """In its lane's own place; in two dimensions or three; on a line, upwards alone. Beside masses nothing."""
    for dimension, wanted in ((1, [0.5]), (2, [0.25, 0.5]), (3, [0.25, 0.5, -1.0])):
        told: list[Any] = []
        clicked: list[int] = []
        client, system = viewer(), row(dimension=dimension)
        made = stage(client, lambda i, place: told.append((i, place)), clicked.append)  # noqa: B023
        made.beside = True
        made.show(timeline(system, *[system.positions] * 2))
        for i in (0, 1):
            balls = client.nodes[f"/lane{i}/masses"]
            end = tuple(np.array([0.25, 0.5, -1.0]) + balls.position)
            balls.does("drag", instance_index=2, phase="update", end_position=end)
            balls.does("drag", instance_index=2, phase="end", end_position=end)
            balls.does("drag", instance_index=None, phase="update", end_position=end)
            balls.does("click", instance_index=1)
            balls.does("click", instance_index=None)
            assert balls.button == "left"
            (mass, place), let_go = told
            assert (mass, place.tolist(), let_go) == (2, pytest.approx(wanted), (2, None))
            assert clicked == [1]
            told.clear()
            clicked.clear()


def test_the_camera_looks_at_all_lanes_from_where_they_fill_the_window() -> None:
    """Upright."""
    system = row()
    for beside in (False, True):
        client = viewer()
        made = stage(client)
        made.beside = beside
        made.show(timeline(system, *[system.positions] * 3))
        between = Window(0.9, (1280 - PANELS) / 720)
        shifts = side_by_side(system, 3, between) if beside else np.zeros((3, 3))
        place, target = camera(system, shifts, between)
        assert client.camera.up_direction == (0, 1, 0)
        assert np.array_equal(client.camera.position, place)
        assert np.array_equal(client.camera.look_at, target)


@pytest.mark.parametrize(
    ("width", "height", "aspect", "covered"),
    [
        pytest.param(1920, 1000, (1920 - PANELS) / 1000, False, id="between the panels"),
        pytest.param(921, 1000, 201 / 1000, False, id="where they leave more than 200 px"),
        pytest.param(920, 1000, 920 / 1000, False, id="or else behind them"),
        pytest.param(576, 1000, 576 / 1000, False, id="from 576 px on"),
        pytest.param(575, 1000, 575 / 1000, True, id="above them on a narrow screen"),
        pytest.param(400, 0, 400, True, id="of no height yet"),
    ],
)
def test_what_panels_leave_of_the_window(width: int, height: int, aspect: float, covered: bool) -> None:
    """When a viewer comes. Later the page itself says how large the picture is; whether panels cover it stays."""
    client = viewer(width, height)
    made = stage(client)
    window = made._window()
    assert (window.field_of_view, window.aspect) == (0.9, aspect)
    assert (window.covered > 0.5) == covered
    assert window.covered < 0.8
    client.camera.image_width = 1000
    assert made._window().aspect == 1000 / max(height, 1)
    assert made._window().covered == window.covered


def free(by: Sequence[float]) -> Any:
    """A row that nothing holds, shifted by so much [m]; its size is 2 m."""
    system = replace(row(), fixed=np.zeros(3, bool))
    return timeline(system, system.positions, system.positions + 2 * np.array(by))


def test_the_camera_goes_along_with_what_falls() -> None:
    """By what all lanes have moved on average, once that is more than 5 % of the size; not with what blows up."""
    client = viewer()
    made = stage(client)
    shown = free((0.0, 0.0))
    made.show(shown)
    begin, target = np.array(client.camera.position), np.array(client.camera.look_at)

    def go(by: Sequence[float]) -> None:
        for lane, state in zip(shown.lanes, (lane.state for lane in free(by).lanes), strict=True):
            lane.state = state
        made.show(shown)

    go((0.0, -0.09))
    assert np.array_equal(client.camera.position, begin)
    go((0.3, -0.5))
    assert client.camera.look_at == pytest.approx(target + np.array([0.3, -0.5, 0.0]))
    assert client.camera.position == pytest.approx(begin + np.array([0.3, -0.5, 0.0]))
    client.camera.position = client.camera.look_at + np.array([1.0, 2.0, 3.0])  # the viewer turns it
    go((0.3, -1.5))
    assert client.camera.look_at == pytest.approx(target + np.array([0.3, -1.5, 0.0]))
    assert client.camera.position == pytest.approx(client.camera.look_at + np.array([1.0, 2.0, 3.0]))
    go((0.3, -3e3))
    assert client.camera.look_at == pytest.approx(target + np.array([0.3, -1.5, 0.0]))


def test_the_camera_stays_where_something_is_held() -> None:
    """However far the rest goes."""
    client, system = viewer(), row()
    made, shown = stage(client), timeline(system)
    made.show(shown)
    before = np.array(client.camera.look_at)
    shown.lanes[0].state = at(system.positions - 5.0)
    made.show(shown)
    assert np.array_equal(client.camera.look_at, before)


def test_places_far_away_are_brought_near_enough_to_be_drawn() -> None:
    """To ten thousand sizes; a mass on the cursor, the last, is not drawn."""
    system = row()
    far = np.array([[0.0, 1e9], [-1e9, 0.0], [1.0, 1.0]])
    shown = timeline(system, far)
    shown.lanes[0].state = at(np.vstack([far, [[7.0, 7.0]]]))
    assert nodes(shown)["/lane0/masses"].batched_positions.tolist() == [[0, 2e4, 0], [-2e4, 0, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    ("masses", "stiffness", "wanted"),
    [
        pytest.param(3, 100.0, 0.02, id="2 x 0.1 kg x 9.81 m/s^2 on 100 N/m and 1 m: 1.96 %"),
        pytest.param(21, 100.0, 0.1, id="20 springs: as for 10 masses, 9.8 %"),
        pytest.param(3, 1e-3, 1.0, id="no more than 100 %"),
        pytest.param(3, 1e9, 1e-5, id="no less than a thousandth of a percent"),
    ],
)
def test_colours_are_for_the_strain_that_the_weight_makes(masses: int, stiffness: float, wanted: float) -> None:
    """Of all that is not held, below a typical spring; the next 1, 2 or 5. A rest length of zero is the shortest."""
    made = stage(viewer())
    system = replace(row(masses), stiffness=np.array(stiffness))
    made.show(timeline(system))
    assert made.strain_shown == pytest.approx(wanted)
    made.show(timeline(replace(system, rest_lengths=np.where(np.arange(masses - 1) < 1, 1.0, 0.0))))
    assert made.strain_shown == pytest.approx(wanted)


def test_masses_without_springs_are_shown() -> None:
    """Each with its ball, and no line."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.5]]),
        springs=np.zeros((0, 2), dtype=np.int64),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    drawn = nodes(timeline(system))
    assert drawn["/lane0/springs"].points.shape == (0, 2, 3)
    assert drawn["/lane0/masses"].batched_positions.tolist() == [[0, 0, 0], [1, 0.5, 0]]
