"""The obstacle image: obstacles of any kind behind the masses. All that is asked of them is their signed distance.

In three dimensions a ray goes from the eye through every pixel, each time as far as the nearest obstacle is away, until
it touches one (sphere tracing: Hart, The Visual Computer 1996). How far it came also tells what an obstacle hides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.obstacles import Obstacle
from reference.state import Array
from reference.system import BoolArray
from report.film.view import View, Window

#: Pixels along the longer side of the picture, and how many times a ray is moved on.
PIXELS, MOVES = 560, 300

#: A ray has arrived within this part of the eye's distance; a mass so little behind a surface lies on it.
TOUCH, HIDDEN = 1e-4, 0.01

#: What an obstacle is painted in where light falls straight on it, and how much of that is left in the shade.
LIGHT, SHADE = 0.93, 0.62

#: Where light comes from: to the right, upwards, towards the eye; a unit vector.
LIGHT_FROM = (-0.48, 0.8, 0.36)

#: Floors fade away between these distances from the middle, in distances of the eye.
FADE = (0.45, 0.9)


@dataclass(frozen=True, eq=False)
class ObstacleImage:
    """What is painted where no spring is in front.

    Attributes:
        window: what of the picture it covers.
        image: red, green, blue and how much of the rest it covers, from bottom to top, shape (h, w, 4), 0 to 1.
        depth: how much nearer than the view's middle the surface is [m], shape (h, w); minus infinity where none is.
    """

    window: Window
    image: Array
    depth: Array

    def hides(self, places: Array, depth: Array, slack: float) -> BoolArray:
        """Which places, shape (s, 2), of what depth [m], shape (s,), are behind a surface by more than `slack` [m]."""
        left, right, bottom, top = self.window
        high, wide = self.depth.shape
        with np.errstate(invalid="ignore"):
            column = np.nan_to_num((places[:, 0] - left) / (right - left) * wide, nan=-1.0)
            row = np.nan_to_num((places[:, 1] - bottom) / (top - bottom) * high, nan=-1.0)
        inside = (column >= 0) & (column < wide) & (row >= 0) & (row < high)
        surface = np.full(len(places), -np.inf)
        surface[inside] = self.depth[row[inside].astype(int), column[inside].astype(int)]
        return np.asarray(depth < surface - slack)


def obstacle_image(obstacles: Sequence[Obstacle], view: View, window: Window) -> ObstacleImage | None:
    """The obstacles in a window of a view; None where there are none."""
    if not obstacles:
        return None
    left, right, bottom, top = window
    step = max(right - left, top - bottom) / PIXELS
    wide, high = round((right - left) / step), round((top - bottom) / step)
    x = left + (np.arange(wide) + 0.5) * (right - left) / wide
    y = bottom + (np.arange(high) + 0.5) * (top - bottom) / high
    places = np.stack(np.meshgrid(x, y), axis=-1)
    return (_flat if len(view.middle) == 2 else _traced)(obstacles, view, window, places)


def _nearest(obstacles: Sequence[Obstacle], points: Array) -> tuple[Array, Array]:
    """Signed distance from points (..., d) to the nearest obstacle [m], shape (...), and its normal there, (..., d)."""
    distances, normals = zip(*(o.signed_distances(points) for o in obstacles), strict=True)
    if len(obstacles) == 1:
        return distances[0][..., 0], normals[0]
    which = np.argmin(np.stack(distances), axis=0)
    nearest = np.take_along_axis(np.stack(distances), which[None], axis=0)[0, ..., 0]
    return nearest, np.take_along_axis(np.stack(normals), which[None], axis=0)[0]


def _touched(obstacles: Sequence[Obstacle], eye: Array, rays: Array, distance: float) -> Array:
    """Where rays (h, w, 3) come to from the eye [m]: to an obstacle, or far beyond anything that is drawn."""
    towards = rays.reshape(-1, 3)
    points = np.tile(eye, (len(towards), 1))
    moving, ends = np.arange(len(towards)), points
    for _ in range(MOVES):
        signed_distance, _ = _nearest(obstacles, ends)
        ends = ends + np.maximum(signed_distance, 0)[:, None] * towards
        near = np.linalg.norm(ends - eye, axis=1) < 3 * distance
        goes_on = (signed_distance > TOUCH / 10 * distance) & near
        points[moving[~goes_on]] = ends[~goes_on]
        moving, ends, towards = moving[goes_on], ends[goes_on], towards[goes_on]
        if not len(moving):
            break
    points[moving] = ends
    return points.reshape(rays.shape)


def _flat(obstacles: Sequence[Obstacle], view: View, window: Window, places: Array) -> ObstacleImage:
    """The inside in one grey, with an edge as soft as a pixel."""
    signed_distance, _ = _nearest(obstacles, places)
    pixel = (window[1] - window[0]) / places.shape[1]
    image = np.empty((*signed_distance.shape, 4))
    image[..., :3] = 0.85
    image[..., 3] = np.clip(0.5 - signed_distance / pixel, 0, 1)
    return ObstacleImage(window, image, np.full(signed_distance.shape, -np.inf))


def _traced(obstacles: Sequence[Obstacle], view: View, window: Window, places: Array) -> ObstacleImage:
    """Shaded by a light above the eye's left shoulder."""
    eye, rays = view.rays(places)
    points = _touched(obstacles, eye, rays, view.distance)
    signed_distance, normal = _nearest(obstacles, points)
    towards = view.axes[2]
    lit = np.clip((normal * (np.array(LIGHT_FROM) @ view.axes)).sum(axis=-1), 0, 1)
    away = np.linalg.norm(points - view.middle, axis=-1) / view.distance
    faded = np.clip((FADE[1] - away) / (FADE[1] - FADE[0]), 0, 1)
    touched = signed_distance < TOUCH * view.distance
    image = np.empty((*signed_distance.shape, 4))
    image[..., :3] = (SHADE + (LIGHT - SHADE) * lit)[..., None]
    image[..., 3] = np.where(touched, 0.92 * faded, 0)
    depth = np.where(touched & (faded > 0), (points - view.middle) @ towards, -np.inf)
    return ObstacleImage(window, image, depth)
