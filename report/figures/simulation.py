"""Plots of what a scene did: paths of masses, energies, spring forces, and any mass's coordinate, over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from experiments.simulation.files import AXES
from experiments.simulation.simulation import Run, Simulation
from experiments.simulation.spring_state import energies, spring_frames
from reference.errors import InputError
from reference.state import Array
from reference.system import IntArray
from report.figures import TITLE, Picture, look, new_figure
from report.figures.labels import End, label_ends

#: Of larger scenes so many masses or springs are drawn, evenly chosen; and times.
FEW, TIMES = 12, 1_000

#: The plots there are besides MASS:AXIS.
KINDS = ("paths", "energy", "forces")

#: Energies in the order they are drawn.
ENERGIES = ("kinetic", "elastic", "gravitational", "total")


@dataclass(frozen=True)
class Wanted:
    """A plot that was asked for: one of KINDS, or the coordinate of a mass along an axis."""

    kind: str
    mass: int = 0
    axis: int = 0

    @property
    def name(self) -> str:
        """As part of a file's name."""
        return self.kind if self.kind in KINDS else f"mass-{self.mass}-{AXES[self.axis]}"


def wanted(word: str, masses: int, dimension: int) -> Wanted:
    """What a word asks for: paths, energy, forces, or MASS:AXIS such as 10:y.

    Raises:
        InputError: for another word; for a mass or an axis that is not there.
    """
    if word in KINDS:
        return Wanted(word)
    mass, colon, axis = word.partition(":")
    axes = AXES[:dimension]
    if not (colon and mass.isdigit() and axis in tuple(axes)):
        of_mass = f"MASS:AXIS with AXIS one of {', '.join(axes)}"
        raise InputError(f"--plot {word!r}: expected {', '.join(KINDS)}, or {of_mass}")
    if int(mass) >= masses:
        raise InputError(f"--plot {word!r}: expected a mass from 0 to {masses - 1}")
    return Wanted("coordinate", int(mass), axes.index(axis))


def draw(simulation: Simulation, what: Wanted) -> Picture:
    """One plot of all runs that have left a motion."""
    runs = [run for run in simulation.runs if run.motion is not None]
    if not runs:
        raise InputError(f"nothing to plot of {simulation.setup.name}: no stepper has left a motion")
    if what.kind == "coordinate":
        return _coordinate(simulation, runs, what)
    return {"paths": _paths, "energy": _energy, "forces": _forces}[what.kind](simulation, runs)


def _coordinate(simulation: Simulation, runs: Sequence[Run], what: Wanted) -> Picture:
    figure, axes = new_figure(figsize=(8, 4.2))
    axis = AXES[what.axis]
    ends = []
    for i, run in enumerate(runs):
        assert run.motion is not None
        times, values = run.motion.trajectory.times, run.motion.trajectory.positions[:, what.mass, what.axis]
        _line(axes, times, values, i, len(runs))
        ends.append(End(float(times[-1]), float(values[-1]), run.stepper.name, look(i)["color"]))
    _over_time(axes, f"{axis} of mass {what.mass} [m]", simulation)
    label_ends(axes, ends, 0.06)
    return Picture(figure, f"{axis} of mass {what.mass} over time under {_names(runs)}.")


def _paths(simulation: Simulation, runs: Sequence[Run]) -> Picture:
    """In the plane of the first two axes, one panel for each run; along a line height over time."""
    figure, panels = _panels(len(runs))
    system = simulation.setup.system
    chosen = _few(np.flatnonzero(~system.fixed))
    for panel, run in zip(panels, runs, strict=True):
        assert run.motion is not None
        x = run.motion.trajectory.positions[_times(run)]
        for i, mass in enumerate(chosen):
            across = x[:, mass, 0] if system.dimension > 1 else run.motion.trajectory.times[_times(run)]
            up = x[:, mass, min(1, system.dimension - 1)]
            panel.plot(across, up, color=look(i)["color"], linewidth=1)
            panel.plot(across[-1], up[-1], marker=look(i)["marker"], color=look(i)["color"])
        fixed = np.flatnonzero(system.fixed)
        if system.dimension > 1:
            panel.plot(x[0, fixed, 0], x[0, fixed, 1], "s", color="#333333", markersize=4)
            panel.set_aspect("equal", adjustable="datalim")
        panel.set_title(run.stepper.name, fontsize=TITLE)
        panel.set_xlabel("x [m]" if system.dimension > 1 else "time [s]")
    panels[0].set_ylabel("y [m]" if system.dimension > 1 else "x [m]")
    some = f" of {len(chosen)} of its masses" if len(chosen) < (~system.fixed).sum() else ""
    figure.suptitle(f"{simulation.setup.name}: paths{some}, a marker at the end", fontsize=TITLE)
    return Picture(figure, f"Paths of the masses of {simulation.setup.name} under {_names(runs)}.")


def _energy(simulation: Simulation, runs: Sequence[Run]) -> Picture:
    figure, panels = _panels(len(runs))
    for panel, run in zip(panels, runs, strict=True):
        assert run.motion is not None
        chosen = _times(run)
        found, ends = energies(run.motion.setup, run.motion.trajectory, chosen), []
        times = run.motion.trajectory.times[chosen]
        for i, name in enumerate(ENERGIES):
            _line(panel, times, found[name], i, len(ENERGIES))
            ends.append(End(float(times[-1]), float(found[name][-1]), name, look(i)["color"]))
        panel.set_title(run.stepper.name, fontsize=TITLE)
        _over_time(panel, "energy [J]" if panel is panels[0] else "", None)
        label_ends(panel, [end for end in ends if np.isfinite(end.y)], 0.06)
    figure.suptitle(f"{simulation.setup.name}: energies, gravitational from height zero", fontsize=TITLE)
    return Picture(figure, f"Kinetic, elastic, gravitational and total energy over time under {_names(runs)}.")


def _forces(simulation: Simulation, runs: Sequence[Run]) -> Picture:
    known = [run for run in runs if run.motion is not None and run.motion.forces is not None]
    if not known:
        raise InputError(f"no forces to plot of {simulation.setup.name}: rods stand for the springs")
    chosen = _few(np.arange(len(simulation.setup.system.springs)))
    figure, panels = _panels(len(known))
    for panel, run in zip(panels, known, strict=True):
        assert run.motion is not None
        steps = _times(run)
        force = np.concatenate([p.force for p in spring_frames(run.motion.setup, run.motion.trajectory, steps)])
        times, ends = run.motion.trajectory.times[steps], []
        for i, spring in enumerate(chosen):
            _line(panel, times, force[:, spring], i, len(chosen))
            ends.append(End(float(times[-1]), float(force[-1, spring]), f"{spring}", look(i)["color"]))
        panel.set_title(run.stepper.name, fontsize=TITLE)
        _over_time(panel, "spring force [N], tension positive" if panel is panels[0] else "", None)
        label_ends(panel, [end for end in ends if np.isfinite(end.y)], 0.05)
    count = len(simulation.setup.system.springs)
    some = f", {len(chosen)} of {count}" if len(chosen) < count else ""
    figure.suptitle(f"{simulation.setup.name}: forces of springs, by their number{some}", fontsize=TITLE)
    return Picture(figure, f"Forces of springs over time under {_names(known)}.")


def _panels(count: int) -> tuple[Any, Any]:
    """A figure with panels side by side, one for each run."""
    figure, panels = new_figure((2.0 + 3.8 * count, 4.2), ncols=count, squeeze=False, sharey=True)
    return figure, panels.ravel()


def _few(which: IntArray) -> list[int]:
    """At most FEW of them, evenly chosen, the last always."""
    if len(which) <= FEW:
        return [int(i) for i in which]
    return [int(i) for i in which[np.linspace(0, len(which) - 1, FEW).round().astype(int)]]


def _times(run: Run) -> list[int]:
    """At most TIMES of the steps of a run, the last always."""
    assert run.motion is not None
    count = len(run.motion.trajectory)
    return np.unique(np.linspace(0, count - 1, min(count, TIMES)).round().astype(int)).tolist()


def _line(axes: Any, times: Array, values: Array, i: int, count: int) -> None:
    every = max(1, len(times) // 8)
    axes.plot(times, values, markevery=(i * every // max(1, count), every), markersize=4, linewidth=1.2, **look(i))


def _over_time(axes: Any, what: str, simulation: Simulation | None) -> None:
    axes.set_xlabel("time [s]")
    axes.set_ylabel(what)
    axes.set_ylim(axes.get_ylim())  # for labels, which come next
    if simulation is not None:
        axes.set_title(f"{simulation.setup.name}, dt = {simulation.setup.dt:g} s", fontsize=TITLE)


def _names(runs: Sequence[Run]) -> str:
    return ", ".join(run.stepper.name for run in runs)
