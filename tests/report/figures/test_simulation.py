"""Plots of a run: every line has the numbers of the run, under its name, with units."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from experiments.runs.steppers import find_steppers
from experiments.simulation.simulation import Motion, Simulation, simulate_all
from reference.conserved import energy_parts
from reference.files.setup import setup_for
from report.figures.simulation import ENERGIES, FEW, Wanted, draw, wanted
from tests.report.figures.artists import cut_off, data, laid_out, odd_measures, overlaps, unlabelled


@cache
def simulation() -> Simulation:
    """A string of two masses under two schemes."""
    setup = setup_for("string", dt=2e-3, duration=0.1, settings={"masses": "2"})
    return simulate_all(setup, find_steppers(["heun", "euler"]))


def motions() -> list[Motion]:
    """Of both."""
    found = [run.motion for run in simulation().runs]
    assert None not in found
    return [motion for motion in found if motion is not None]


def test_a_coordinate_is_that_of_its_mass() -> None:
    """Against time, a line for each stepper with its name at the end; not that of another mass or axis."""
    (axes,) = draw(simulation(), wanted("2:y", 3, 2)).figure.axes
    for line, motion in zip(axes.get_lines(), motions(), strict=False):
        times, values = data(line)
        assert times == motion.trajectory.times.tolist()
        assert values == motion.trajectory.positions[:, 2, 1].tolist()
        assert values != motion.trajectory.positions[:, 1, 1].tolist()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "y of mass 2 [m]")
    assert {text.get_text() for text in axes.texts} == {"heun", "euler"}


def test_paths_end_where_the_masses_do() -> None:
    """One panel for each run: the way of every free mass, a marker at its end."""
    panels = draw(simulation(), Wanted("paths")).figure.axes
    for panel, motion in zip(panels, motions(), strict=True):
        x = motion.trajectory.positions
        lines = [data(line) for line in panel.get_lines()]
        assert lines[0] == (x[:, 1, 0].tolist(), x[:, 1, 1].tolist())
        assert lines[1] == ([x[-1, 1, 0]], [x[-1, 1, 1]])
        assert panel.get_xlabel() == "x [m]"
    assert [panel.get_title() for panel in panels] == ["heun", "euler"]


def test_energies_are_those_of_the_states() -> None:
    """Kinetic, elastic, gravitational, total, each with its label: the last of them is the sum."""
    panels = draw(simulation(), Wanted("energy")).figure.axes
    for panel, motion in zip(panels, motions(), strict=True):
        by_name = dict(zip(ENERGIES, (data(line)[1] for line in panel.get_lines()), strict=False))
        last = energy_parts(simulation().setup.system, motion.end)
        assert {name: values[-1] for name, values in by_name.items()} == pytest.approx(last)
        assert {text.get_text() for text in panel.texts} == {*ENERGIES}
    assert panels[0].get_ylabel() == "energy [J]"


@pytest.mark.parametrize("word", ["paths", "energy", "forces", "2:y"])
def test_all_of_it_can_be_read(word: str) -> None:
    """Axes with units, nothing over anything else, nothing cut off."""
    figure = laid_out(draw(simulation(), wanted(word, 3, 2)).figure)
    assert unlabelled(figure) == overlaps(figure) == odd_measures(figure) == cut_off(figure) == []


def test_forces_are_those_of_the_springs() -> None:
    """By their number, tension upwards; of many, a few."""
    panels = draw(simulation(), Wanted("forces")).figure.axes
    for panel, motion in zip(panels, motions(), strict=True):
        assert motion.forces is not None
        ends = [data(line)[1][-1] for line in panel.get_lines()]
        assert ends[: len(motion.forces)] == motion.forces.tolist()
        assert {text.get_text() for text in panel.texts} == {"0", "1"}
    assert "tension positive" in panels[0].get_ylabel()
    many = simulate_all(setup_for("cloth", duration=0.01), find_steppers(["heun"]))
    (panel,) = draw(many, Wanted("forces")).figure.axes
    assert len({text.get_text() for text in panel.texts}) == FEW
    assert np.isfinite(panel.get_ylim()).all()
