"""Small animations for pages: an SVG that shows the end of a motion, and with a script all of it, to be paused.

No picture is a file of its own, nothing is asked for from anywhere. Without the script, on paper, and for those who
want less motion, the still stays; a reader starts and stops it with a button, or drags a slider.
"""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from experiments.scenes import shown
from reference.errors import SolverError
from reference.scenes import find
from reference.state import Array, Trajectory
from reference.system import IntArray, MassSpringSystem
from report.film.drawing import FEW, colour_map, strain
from report.film.film import look_at

#: Moves the lines of every animation on a page: to be put there once, in a script element after them.
SCRIPT = (Path(__file__).parents[1] / "templates" / "motion.js").read_text(encoding="utf-8")

#: What the page shows.
SHOWN = ("string", "cloth", "jello", "bridge")

#: Pixels across, and the parts of one that places are rounded to.
ACROSS, PARTS = 420, 8

#: How many times longer than the motion it takes to watch.
SLOW = 8

#: The number of colours that tell strain.
COLOURS = 61


@dataclass(frozen=True, eq=False)
class Animation:
    """A motion to be put into a page.

    Attributes:
        name: of the scene.
        alt: the words that stand for it.
        still: an SVG element that shows its end.
        data: what the script of `SCRIPT` moves the SVG by, as JSON.
    """

    name: str
    alt: str
    still: str
    data: str

    def html(self) -> str:
        """The element to be put in. The page has SCRIPT once, after all of them."""
        data = f'<script type="application/json">{self.data}</script>'
        return f'<figure class="motion" data-name="{escape(self.name)}">{self.still}{data}</figure>'


def animation(name: str) -> Animation:
    """The default scene of a name, by the reference, from a run that is done.

    Raises:
        SolverError: where no step that was tried is short enough.
    """
    found = shown(find(name))
    if found.motion is None:
        raise SolverError(f"{name} is not shown: {'; '.join(found.failures)}")
    return animated(name, found.system, found.motion)


def animated(name: str, system: MassSpringSystem, moved: Trajectory) -> Animation:
    """A motion of a system."""
    drawn = _drawn(system, moved)
    width, height = drawn.size
    found = 100 * strain(system, moved.positions)
    alt = (
        f"{name}: {len(system.masses)} masses and {len(system.springs)} springs move for {moved.times[-1]:g} s, shown "
        f"{SLOW} times slower; strain from {found.min():.2g} to {found.max():.2g} %, coloured from blue, pushed "
        f"together by {100 * drawn.most:.3g} %, over grey to orange and brown, pulled apart by as much."
    )
    lines = "".join(_line(drawn, system, i) for i in drawn.order[-1].tolist())
    dots = "".join(_dot(drawn.places[-1, i], bool(system.fixed[i])) for i in _dotted(system))
    label = f'role="img" aria-label="{escape(alt)}"'
    still = f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" {label}>{lines}{dots}</svg>'
    data = {
        "duration": SLOW * float(moved.times[-1]),
        "frames": len(moved),
        "parts": PARTS,
        "springs": system.springs.ravel().tolist(),
        "dotted": _dotted(system),
        "palette": _palette(),
        "places": _packed(np.rint(drawn.places * PARTS).astype("<i2")),
        "colours": _packed(drawn.colours.astype("u1")),
        "order": _packed(drawn.order.astype("<u2")),
    }
    return Animation(name, alt, still, json.dumps(data, separators=(",", ":")))


@dataclass(frozen=True, eq=False)
class _Drawn:
    """A motion in pixels.

    Attributes:
        places: of masses, shape (m, n, 2) [pixels].
        order: the springs, from the farthest to the nearest, shape (m, s).
        colours: each spring's number in the palette, shape (m, s).
        size: width and height [pixels].
        most: strain at both ends of the palette.
    """

    places: Array
    order: IntArray
    colours: IntArray
    size: tuple[int, int]
    most: float


def _drawn(system: MassSpringSystem, moved: Trajectory) -> _Drawn:
    look = look_at(system, [moved])
    left, right, bottom, top = look.window
    scale = ACROSS / max(right - left, top - bottom)
    seen, near = look.view.project(moved.positions)
    places = (seen - np.array([left, top])) * np.array([scale, -scale])
    order = np.argsort(near[:, system.springs].mean(axis=2), axis=1, kind="stable")
    part = 0.5 + strain(system, moved.positions) / (2 * look.most)
    colours = np.clip(np.rint(part * (COLOURS - 1)), 0, COLOURS - 1).astype(np.int64)
    size = (round((right - left) * scale), round((top - bottom) * scale))
    return _Drawn(places, order, colours, size, look.most)


@cache
def _palette() -> list[str]:
    """The colours of strain, from pushed together to pulled apart."""
    from matplotlib.colors import to_hex

    return [to_hex(colour) for colour in colour_map()(np.linspace(0, 1, COLOURS))]


def _line(drawn: _Drawn, system: MassSpringSystem, spring: int) -> str:
    """A spring at the end."""
    (x1, y1), (x2, y2) = np.rint(drawn.places[-1, system.springs[spring]] * PARTS) / PARTS
    shortest = system.shortest / max(float(system.rest_lengths[spring]), system.shortest)
    width = 2.5 if len(system.masses) <= FEW else 1.6 * max(0.4, shortest)
    shade = _palette()[drawn.colours[-1, spring]]
    return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" stroke="{shade}" stroke-width="{width:.2g}"/>'


def _dotted(system: MassSpringSystem) -> list[int]:
    """The masses that are seen: all where there are few, else those that are fixed."""
    chosen = np.ones(len(system.masses), bool) if len(system.masses) <= FEW else system.fixed
    return np.flatnonzero(chosen).tolist()


def _dot(place: Array, fixed: bool) -> str:
    x, y = np.rint(place * PARTS) / PARTS
    return f'<circle cx="{x:g}" cy="{y:g}" r="{4.5 if fixed else 3}" fill="currentColor"/>'


def _packed(values: npt.NDArray[Any]) -> str:
    """As text that the script unpacks."""
    return base64.b64encode(values.tobytes()).decode()
