"""Where one looks at a system from: places of masses in a picture, and how near they are to the eye."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np

from reference.line import in_plane
from reference.state import Array

#: Three dimensions are looked at from so far to the right of straight on, and from so far above [degrees].
AZIMUTH, ELEVATION = 28.0, 17.0

#: How far away the eye is, in sizes of what moves: near enough to see what is in front.
AWAY = 3.0

#: Left, right, bottom, top of a picture [m].
Window = tuple[float, float, float, float]

#: How much more room there is around what moves, and below it, as parts of it.
MARGIN, BELOW = 0.06, 0.13

#: A picture is at least this part as narrow as it is high, and the other way round.
NARROWEST = 0.45


@dataclass(frozen=True, eq=False)
class View:
    """Straight on in two dimensions; in three from a place at the right, above, in perspective. A line goes upwards.

    Attributes:
        middle: what is looked at [m], shape (2,) or (3,).
        axes: unit vectors to the right, upwards, and in three dimensions towards the eye, shape (2, 2) or (3, 3).
        distance: of the eye from the middle [m].
    """

    middle: Array
    axes: Array
    distance: float

    def project(self, positions: Array) -> tuple[Array, Array]:
        """Places in the picture [m], shape (..., 2), and how much nearer than the middle [m], shape (...).

        Args:
            positions: shape (..., d) [m]. What is behind the eye, or not finite, has no place: NaN.
        """
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            seen = (in_plane(positions) - self.middle) @ self.axes.T
            if len(self.middle) == 2:
                return seen + self.middle, np.zeros(seen.shape[:-1])
            left = self.distance - seen[..., 2]
            factor = np.where(left > 0, self.distance / left, np.nan)
            return seen[..., :2] * factor[..., None], seen[..., 2]

    def rays(self, places: Array) -> tuple[Array, Array]:
        """The eye [m], shape (3,), and unit vectors from it through places of the picture, shape (..., 3)."""
        right, up, towards = self.axes
        eye = self.middle + self.distance * towards
        through = self.middle + places[..., :1] * right + places[..., 1:] * up - eye
        return eye, through / np.linalg.norm(through, axis=-1, keepdims=True)


def view_of(positions: Array) -> View:
    """The view in which all of these can be seen, shape (..., d) [m]."""
    places = in_plane(positions.reshape(-1, positions.shape[-1]))
    low, high = places.min(axis=0), places.max(axis=0)
    if len(low) == 2:
        return View(np.zeros(2), np.eye(2), np.inf)
    a, e = radians(AZIMUTH), radians(ELEVATION)
    right = (cos(a), 0.0, -sin(a))
    towards = (sin(a) * cos(e), sin(e), cos(a) * cos(e))
    up = tuple(np.cross(towards, right).tolist())
    return View((low + high) / 2, np.array([right, up, towards]), AWAY * float(np.linalg.norm(high - low)))


def window_around(boxes: Sequence[Window], most: float = 0.3) -> Window:
    """The first box with the others as far as they reach out of it by no more than a part of it, and some room."""
    left, right, bottom, top = boxes[0]
    wide, high = most * (right - left), most * (top - bottom)
    slack = (left - wide, right + wide, bottom - high, top + high)
    for box in boxes[1:]:
        left, bottom = min(left, max(box[0], slack[0])), min(bottom, max(box[2], slack[2]))
        right, top = max(right, min(box[1], slack[1])), max(top, min(box[3], slack[3]))
    width, height = right - left, top - bottom
    across = max(width * (1 + 2 * MARGIN), NARROWEST * height)
    upwards = max(height * (1 + MARGIN + BELOW), NARROWEST * across)
    x, y = (left + right) / 2, (bottom + top - (BELOW - MARGIN) * height) / 2
    return x - across / 2, x + across / 2, y - upwards / 2, y + upwards / 2


def box_of(places: Array) -> Window:
    """The smallest window with all places in it that are finite, shape (..., 2) [m]."""
    x, y = (places[..., i][np.isfinite(places[..., i])] for i in (0, 1))
    return float(x.min()), float(x.max()), float(y.min()), float(y.max())


def outside(places: Array, window: Window) -> Array:
    """Which places are not in a window, shape (...): those that are not finite are not."""
    x, y = places[..., 0], places[..., 1]
    left, right, bottom, top = window
    with np.errstate(invalid="ignore"):
        return np.asarray(~((x >= left) & (x <= right) & (y >= bottom) & (y <= top)))
