"""Natural modes as pictures: each mode's shape about the rest, with its frequency and damping ratio."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from experiments.simulation.modes_of_scene import Modes
from reference.outcome import Outcome
from reference.scenes import Setup
from reference.state import Array, Trajectory
from reference.system import IntArray
from report.figures import NOTE, TITLE, Picture, look, new_figure
from report.film.contact_sheet import Shot
from report.film.film import Film, film_of
from report.film.view import view_of

#: How many modes are drawn, in rows of so many; how far the largest move goes, as a part of the system's size.
MOST, IN_A_ROW, AMPLITUDE = 9, 3, 0.08

#: From so many springs on they are drawn thin.
MANY = 150


def draw(modes: Modes) -> Picture:
    """The slowest modes, a panel each; rest in grey."""
    count = min(MOST, len(modes.natural.frequencies))
    rows = -(-count // IN_A_ROW)
    columns = min(count, IN_A_ROW)
    figure, panels = new_figure((1.0 + 3.3 * columns, 0.8 + 2.9 * rows), nrows=rows, ncols=columns, squeeze=False)
    system, rest = modes.setup.system, modes.rest.state.positions
    project = _projection(rest)
    for i, panel in enumerate(panels.ravel()):
        if i >= count:
            panel.set_axis_off()
            continue
        moved = rest + AMPLITUDE * system.scale * modes.natural.shapes[i]
        _springs(panel, project(rest), system.springs, "#bbbbbb", 1.0)
        places = project(moved) if rest.shape[1] > 1 else _sideways(rest, moved)
        _springs(panel, places, system.springs, look(i)["color"], 1.4)
        panel.set_title(_title(modes, i), fontsize=NOTE)
        panel.set_aspect("equal", adjustable="datalim")
        if rest.shape[1] == 3:  # seen from a corner: the picture's axes are none of the scene's
            panel.set_axis_off()
        panel.set_xlabel("x [m]")
        panel.set_ylabel("y [m]")
    more = f", the slowest {count} of {modes.asked}" if count < modes.asked else ""
    figure.suptitle(f"{modes.setup.name}: natural modes about its rest (grey){more}", fontsize=TITLE)
    said = ", ".join(f"{f:.3g}" for f in modes.natural.frequencies[:count])
    return Picture(figure, f"Shapes of the slowest modes of {modes.setup.name}, at {said} Hz.")


def _title(modes: Modes, i: int) -> str:
    ratio = modes.natural.damping_ratios[i]
    damped = f", damping ratio {ratio:.3g}" if np.isfinite(ratio) and ratio > 0 else ""
    return f"{i + 1}: {modes.natural.frequencies[i]:.4g} Hz{damped}"


def _projection(rest: Array) -> Any:
    """Onto the picture: as it is in the plane, seen as films see it in space."""
    if rest.shape[1] == 1:
        return lambda x: np.pad(x, ((0, 0), (1, 0)))
    if rest.shape[1] == 2:
        return lambda x: x
    view = view_of(rest)
    return lambda x: view.project(x)[0]


def _sideways(rest: Array, moved: Array) -> Array:
    """Along a line moves are drawn across it, or nothing would be seen."""
    return np.hstack([moved - rest, rest])


def _springs(panel: Any, places: Array, springs: IntArray, colour: str, width: float) -> None:
    from matplotlib.collections import LineCollection

    width = width if len(springs) < MANY else 0.4 * width
    panel.add_collection(LineCollection(list(places[springs]), colors=colour, linewidths=width))
    panel.plot(places[:, 0], places[:, 1], ".", color=colour, markersize=4 if len(places) < 200 else 1)


def swinging(modes: Modes, most: int, frames: int) -> Film:
    """A film of the slowest modes side by side, each through one swing of its own in so many frames."""
    rest, system = modes.rest.state.positions, modes.setup.system
    phase = np.cos(np.linspace(0, 2 * np.pi, frames + 1))[:, None, None]
    times = np.arange(frames + 1) / frames
    shown = []
    for i in range(min(most, len(modes.natural.frequencies))):
        moved = rest + AMPLITUDE * system.scale * phase * modes.natural.shapes[i]
        motion = Trajectory(times, moved, np.zeros_like(moved))
        shown.append(Shot((_title(modes, i),), "", Outcome("done", "", motion)))
    setup = Setup(f"{modes.setup.name}, modes", replace(system, positions=rest), 1 / frames, 1.0)
    return film_of(setup, shown, None)
