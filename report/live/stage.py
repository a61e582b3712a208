"""The scene in the browser: springs and masses in their lane's colour, obstacles, and what drives the scene."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.line import in_plane, obstacle_in_plane, on_line
from reference.obstacles import Obstacle
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem
from report.film.drawing import nice, strain
from report.live.colours import FIXED_COLOUR, LANE_COLOURS, TRUE_COLOUR, as_light, of_strain
from report.live.driven_shapes import DrivenShapes
from report.live.framing import Window, box, camera, side_by_side

if TYPE_CHECKING:
    from viser import ClientHandle

    from report.live.timeline import Timeline

#: Masses of more than these are dots too small to grab: they are drawn smaller.
FEW = 200

#: What the panels on both sides take of the width [px]; on screens narrower than that they cover a part of the height.
PANELS, NARROW, COVERED = 720, 576, 0.6

#: How far what nothing holds moves before the camera goes along, as a part of its size.
FOLLOWED = 0.05

#: They leave at least this [px].
LEAST = 200


class Stage:
    """What one viewer sees of a lab's lanes.

    Args:
        client: the viewer.
        on_drag: told of a drag: which mass, where to [m], shape (d,); None when it is let go.
        on_click: told of a click on a mass.

    Attributes:
        beside: whether lanes are side by side, and not one over the other.
        strain_shown: the strain at which a spring has the full colour of its lane.
        show_true: whether the true motion is shown, where it is known.
    """

    def __init__(
        self, client: ClientHandle, on_drag: Callable[[int, Array | None], None], on_click: Callable[[int], None]
    ) -> None:
        self._client, self._on_drag, self._on_click = client, on_drag, on_click
        self.beside, self.show_true = False, True
        self._key: object = None
        self._nodes: list[tuple[Any, Any]] = []
        self._others: list[Any] = []
        self._true: Any = None
        self._driven: list[DrivenShapes] = []
        self._followed: Array | None = None
        self._first = self._looked_at = np.zeros(3)
        self.strain_shown = 0.1
        self._wide: bool | None = None

    def show(self, timeline: Timeline) -> None:
        """The present state."""
        system, lanes = timeline.system, timeline.lanes
        shapes = system.springs.shape, system.positions.shape
        key = (timeline.opened, *shapes, system.obstacles, timeline.steppers, self.beside)
        with self._client.atomic():
            if self._key != key:
                self._build(timeline, [lane.state for lane in lanes])
                self._key = key
            for i, (lane, (lines, balls)) in enumerate(zip(lanes, self._nodes, strict=True)):
                places = _places(system, lane.state)
                lines.points = places[system.springs]
                lines.colors = self._colours(system, lane.state, i)
                balls.batched_positions = places
            for lane, driven in zip(lanes, self._driven, strict=True):
                driven.show(system, lane.state)
            self._show_true(system, timeline.reference.state)
            if not system.fixed.any():
                self._follow(np.mean([_places(system, lane.state).mean(axis=0) for lane in lanes], axis=0))

    def repaint(self, timeline: Timeline) -> None:
        """Masses may have been pinned or let go."""
        for i, (_, balls) in enumerate(self._nodes):
            balls.batched_colors = _ball_colours(timeline.system, i)

    def _window(self) -> Window:
        """What is left between the panels, which are there in a moment; on narrow screens, above them."""
        seen = self._client.camera
        width, height = seen.image_width, max(seen.image_height, 1)
        if self._wide is None:
            self._wide = width >= NARROW
            width -= PANELS * (width > PANELS + LEAST)
        return Window(seen.fov, width / height, 0.0 if self._wide else COVERED)

    def _follow(self, centre: Array) -> None:
        """What nothing holds falls out of the picture: the camera goes along, once it is some way off."""
        if self._followed is None:
            self._followed = self._first = centre
        if FOLLOWED * self._size < np.linalg.norm(centre - self._followed) < 1e3 * self._size:
            self._followed, seen = centre, self._client.camera
            # what the viewer's page says of its camera comes late: kept of it is only from where it looks
            from_where = np.array(seen.position) - np.array(seen.look_at)
            with suppress(ValueError):  # as in `_build`
                seen.look_at = self._looked_at + centre - self._first
                seen.position = seen.look_at + from_where
                seen.look_at = self._looked_at + centre - self._first

    def _build(self, timeline: Timeline, states: Sequence[State]) -> None:
        """All that is seen, anew, and the camera before it."""
        system, self._followed = timeline.system, None
        for node in [*(node for pair in self._nodes for node in pair), *self._others]:
            node.remove()
        self._nodes, self._others, self._true, self._driven = [], [], None, []
        self.strain_shown, self._size = _strains_to_show(system), system.size
        window, count = self._window(), len(states)
        shifts = side_by_side(system, count, window) if self.beside else np.zeros((count, 3))
        for i, (state, shift) in enumerate(zip(states, shifts, strict=True)):
            self._build_lane(system, state, i, shift)
            self._add_name(system, timeline.steppers[i], i, shift)
            self._driven.append(DrivenShapes(self._client, f"/lane{i}", timeline.opened, shift))
            self._others += self._driven[-1].nodes
        seen = self._client.camera
        with suppress(ValueError):  # from where a viewer looks at nothing, as their page has said, it is left there
            seen.up_direction = (0.0, 1.0, 0.0)
            place, self._looked_at = camera(system, shifts, window)
            seen.position, seen.look_at = place, self._looked_at

    def _build_lane(self, system: MassSpringSystem, state: State, i: int, shift: Array) -> None:
        """Springs, masses and obstacles of lane i, moved by a shift (3,) [m]."""
        scene, points, few = self._client.scene, _places(system, state), len(system.masses) <= FEW
        lines = scene.add_line_segments(
            f"/lane{i}/springs",
            points=points[system.springs],
            colors=self._colours(system, state, i),
            thickness=3.0 if few and i == 0 else 1.5,
            thickness_units="screen",
            position=shift,
        )
        balls = scene.add_batched_meshes_simple(
            f"/lane{i}/masses",
            *_ball(system.size * (0.022 if few else 0.006)),
            batched_wxyzs=np.tile(np.array([1.0, 0, 0, 0]), (len(points), 1)),
            batched_positions=points,
            batched_colors=_ball_colours(system, i),
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
            opacity=None if i == 0 or self.beside else 0.6,
            position=shift,
        )
        self._listen(balls, shift, system.dimension)
        self._nodes.append((lines, balls))
        obstacles = map(obstacle_in_plane, system.obstacles)
        drawn = (self._obstacle(f"/lane{i}/obstacle{k}", o, shift) for k, o in enumerate(obstacles))
        self._others += [node for node in drawn if node is not None]

    def _add_name(self, system: MassSpringSystem, name: str, i: int, shift: Array) -> None:
        """Above a lane side by side; of lanes over one another the legend has the names."""
        if not self.beside:
            return
        low, high = box(system)
        place = shift + np.array([(low[0] + high[0]) / 2, high[1], 0.0])
        self._others.append(
            self._client.scene.add_label(f"/lane{i}/name", name, position=place, anchor="bottom-center")
        )

    def _listen(self, balls: Any, shift: Array, dimension: int) -> None:
        # Coroutines, so that they are told in the order in which it was done: see `events`.
        async def drag(event: Any) -> None:
            if event.instance_index is not None:
                place = (np.array(event.end_position) - shift)[: max(dimension, 2)]
                place = on_line(place) if dimension == 1 else place
                self._on_drag(event.instance_index, None if event.phase == "end" else place)

        async def click(event: Any) -> None:
            if event.instance_index is not None:
                self._on_click(event.instance_index)

        balls.on_drag("left")(drag)
        balls.on_click(click)

    def _show_true(self, system: MassSpringSystem, state: State | None) -> None:
        """The true motion, just behind the lanes where there is a behind; nothing without a state of it."""
        if state is None or not self.show_true:
            if self._true is not None:
                self._true.visible = False
            return
        flat = system.dimension < 3
        points = (_places(system, state) - [0, 0, 0.02 * system.size * flat])[system.springs]
        if self._true is None:
            self._true = self._client.scene.add_line_segments(
                "/true",
                points=points,
                colors=as_light(TRUE_COLOUR),
                thickness=5.0 if flat else 1.5,
                thickness_units="screen",
            )
            self._others.append(self._true)
        self._true.visible, self._true.points = True, points

    def _colours(self, system: MassSpringSystem, state: State, i: int) -> Any:
        """Of the springs' ends: the lane's, by strain."""
        strains = strain(system, state.positions[: len(system.masses)])
        return np.repeat(as_light(of_strain(strains, self.strain_shown, i))[:, None], 2, axis=1)

    def _obstacle(self, name: str, obstacle: Obstacle, shift: Array) -> Any:
        """As what can be seen of it; None for a kind that has no shape here."""
        numbers = obstacle.to_dict()
        scene, grey = self._client.scene, (190, 190, 190)
        if numbers["kind"] in ("circle", "sphere"):
            place = np.pad(np.array(numbers["centre"]), (0, 3 - obstacle.dimension)) + shift
            if obstacle.dimension == 2:
                return scene.add_mesh_simple(name, *_disc(numbers["radius"]), color=grey, side="double", position=place)
            return scene.add_icosphere(name, radius=numbers["radius"], color=grey, position=place)
        if numbers["kind"] == "box":
            sizes = np.pad(2 * np.array(numbers["half_sizes"]), (0, 3 - obstacle.dimension), constant_values=0.001)
            place = np.pad(np.array(numbers["centre"]), (0, 3 - obstacle.dimension)) + shift
            return scene.add_box(name, color=grey, dimensions=tuple(sizes), position=place)
        if numbers["kind"] == "plane":
            place = np.pad(np.array(numbers["point"]), (0, 3 - obstacle.dimension)) + shift
            return scene.add_grid(name, width=4, height=4, cell_size=0.1, plane="xz", position=place, fade_distance=1.5)
        return None


def _places(system: MassSpringSystem, state: State) -> Any:
    """In three dimensions, near enough to be drawn, in single precision."""
    reach = 1e4 * system.size
    places = np.clip(in_plane(state.positions[: len(system.masses)]), -reach, reach)
    return np.pad(places, ((0, 0), (0, 3 - places.shape[1]))).astype(np.float32)


def _strains_to_show(system: MassSpringSystem) -> float:
    """The strain at the ends of the colours: what the weight below a typical spring makes of it, rounded."""
    weight = float(system.masses[~system.fixed].sum() * np.linalg.norm(system.gravity))
    stretch = weight / (system.stiffness * np.maximum(system.rest_lengths, system.shortest)).clip(1e-12)
    typical = float(np.median(stretch)) if len(stretch) else 0.0
    share = max(1.0, len(system.springs) / 10)
    return float(np.clip(nice(max(typical / share, 1e-6)), 1e-5, 1.0))


def _ball_colours(system: MassSpringSystem, i: int) -> Any:
    return as_light(np.where(system.fixed[:, None], FIXED_COLOUR, LANE_COLOURS[i]))


def _ball(radius: float) -> tuple[Array, IntArray]:
    """An octahedron with its edges cut once: corners (18, 3) [m], faces (32, 3)."""
    corners = [*np.eye(3), *-np.eye(3)]
    faces = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    cut: dict[tuple[int, int], int] = {}
    smaller = []
    for face in faces:
        middles = []
        for a, b in zip(face, (*face[1:], face[0]), strict=True):
            key = (min(a, b), max(a, b))
            if key not in cut:
                cut[key] = len(corners)
                corners.append((corners[a] + corners[b]) / np.sqrt(2.0))
            middles.append(cut[key])
        a, b, c = face
        ab, bc, ca = middles
        smaller += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return radius * np.array(corners), np.array(smaller)


def _disc(radius: float) -> tuple[Array, IntArray]:
    """A flat circle: corners [m], faces."""
    angles = np.linspace(0, 2 * np.pi, 65)[:-1]
    rim = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    corners = np.vstack([np.zeros(3), radius * rim])
    around = np.arange(64)
    return corners, np.stack([np.zeros(64, dtype=int), around + 1, (around + 1) % 64 + 1], axis=1)
