"""The colours of the live page: a colour is a lane, in the scene, in the plots and in the legend."""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.state import Array
from report.figures import COLOURS

#: Of the lanes, told apart by everyone, as in figures; and of the true motion.
LANE_COLOURS = tuple(tuple(bytes.fromhex(colour[1:])) for colour in COLOURS)
TRUE_COLOUR = (150, 150, 150)

#: A fixed mass.
FIXED_COLOUR = (40, 40, 40)

#: How deep the colour of a spring is that is not strained, against white.
LEAST_DEPTH = 0.35


def as_light(colours: Any) -> Any:
    """Colours as parts of light, 0 to 255, as viser takes them of lines and of many bodies at once (IEC 61966-2-1)."""
    part = np.asarray(colours, dtype=np.float64) / 255
    light = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    return np.rint(255 * light).astype(np.uint8)


def of_strain(strain: Array, most: float, lane: int) -> Any:
    """A lane's colour for springs strained by so much, the deeper the more; strained by `most` it is the lane's own."""
    part = np.clip(np.nan_to_num(np.abs(strain), nan=most) / most, 0, 1)
    depth = (LEAST_DEPTH + (1 - LEAST_DEPTH) * part)[:, None]
    return (255 + depth * (np.array(LANE_COLOURS[lane]) - 255)).astype(np.uint8)
