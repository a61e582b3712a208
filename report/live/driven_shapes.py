"""What drives a scene, drawn with it: a truck in the middle of masses that it adds, ground or gravity by an arrow.

Seen from ground that moves the fixed masses are at rest, as they are computed: the arrow is the ground's acceleration.
Where gravity swings by itself the arrow is gravity, and there is no ground.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from reference.line import in_plane
from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.colours import as_light

if TYPE_CHECKING:
    from viser import ClientHandle

    from report.live.scenes import OpenedScene

#: The size of a truck, the width of what stands for ground under a fixed mass, and an arrow's length at LARGE, as parts
#: of the system's size; and an acceleration that is large [m/s^2]: of the ground, and of gravity.
TRUCK, GROUND, ARROW, LARGE = 0.06, 0.05, 0.15, 1.0
LARGE_GRAVITY = 9.81

#: Of trucks, ground and arrows.
COLOUR = (90, 90, 90)


def truck_place(opened: MassSpringSystem, now: MassSpringSystem, state: State) -> Array | None:
    """Where the masses that have come on have their centre [m], shape (d,); None where none have."""
    more = now.masses - opened.masses
    if not more.sum() > 1e-9 * opened.masses.sum():
        return None
    return np.asarray(more @ state.positions[: len(more)] / more.sum())


def ground_acceleration(opened: MassSpringSystem, now: MassSpringSystem) -> Array:
    """Of the ground [m/s^2], shape (d,): seen from it, gravity is less by so much."""
    return np.asarray(opened.gravity - now.gravity)


class DrivenShapes:
    """The truck of a lane, the ground under it, or the gravity that swings, at the lane's place in the picture.

    Args:
        client: the viewer.
        name: of the lane's nodes.
        opened: the scene.
        shift: of the lane, shape (3,) [m].
    """

    def __init__(self, client: ClientHandle, name: str, opened: OpenedScene, shift: Array) -> None:
        self._opened, self._shift = opened.system, shift
        self._size = opened.system.size
        self.nodes: list[Any] = []
        self._truck: Any = None
        self._arrow: Any = None
        scene = client.scene
        if "mass" in opened.driven:
            dimensions = tuple(self._size * TRUCK * np.array([1.0, 0.5, 0.4]))
            self._truck = scene.add_box(f"{name}/truck", COLOUR, dimensions, visible=False)
            self.nodes.append(self._truck)
        if "gravity" in opened.driven:
            self._on_ground = opened.ground_moves and bool(opened.system.fixed.any())
            points = self._bars()
            self._low = self._below(points)
            self._ground = points if self._on_ground else points[:0]
            self._arrow = scene.add_line_segments(
                f"{name}/drive",
                np.concatenate([self._ground, self._arrow_of(opened.system)]).astype(np.float32),
                as_light(COLOUR),
                thickness=4.0,
                thickness_units="screen",
                position=shift,
            )
            words = "acceleration of the ground, which this is seen from" if self._on_ground else "gravity"
            at = shift + self._low + [0.0, (-0.03 if self._on_ground else 0.03) * self._size, 0.0]
            self.nodes += [
                self._arrow,
                scene.add_label(
                    f"{name}/says",
                    words,
                    position=at,
                    anchor="top-center" if self._on_ground else "bottom-center",
                    font_screen_scale=0.8,
                ),
            ]

    def show(self, now: MassSpringSystem, state: State) -> None:
        """As it is at a moment."""
        if self._truck is not None:
            place = truck_place(self._opened, now, state)
            self._truck.visible = place is not None
            if place is not None:
                above = np.array([0.0, 0.25 * TRUCK * self._size, 0.0])
                self._truck.position = tuple(self._shift + _in_space(place) + above)
        if self._arrow is not None:
            self._arrow.points = np.concatenate([self._ground, self._arrow_of(now)]).astype(np.float32)

    def _bars(self) -> Array:
        """A bar under every fixed mass, ends of shape (k, 2, 3) [m]."""
        fixed = self._opened.positions[self._opened.fixed]
        places = np.array([_in_space(place) for place in fixed]).reshape(-1, 3)
        half = np.array([GROUND * self._size, 0.0, 0.0])
        return np.asarray(np.stack([places - half, places + half], axis=1) - [0.0, 0.02 * self._size, 0.0])

    def _below(self, bars: Array) -> Array:
        """Where an arrow begins: below the ground, or the masses where there is none."""
        masses = np.array([_in_space(place) for place in self._opened.positions])[:, None]
        low = bars if self._on_ground else masses
        return np.array([low[..., 0].mean(), low[..., 1].min() - 0.1 * self._size, 0.0])

    def _arrow_of(self, now: MassSpringSystem) -> Array:
        """Along the ground's acceleration or along gravity, with a head: ends of shape (3, 2, 3) [m]."""
        if self._on_ground:
            part, acceleration = 1 / LARGE, ground_acceleration(self._opened, now)
        else:
            part, acceleration = 1 / LARGE_GRAVITY, now.gravity
        along = ARROW * self._size * part * _in_space(acceleration)
        end = self._low + along
        aside = 0.2 * np.array([-along[1], along[0], 0.0])
        back = end - 0.3 * along
        return np.array([[self._low, end], [end, back + aside], [end, back - aside]])


def _in_space(place: Array) -> Array:
    flat = np.asarray(in_plane(place[None])[0])
    return np.pad(flat, (0, 3 - len(flat)))
