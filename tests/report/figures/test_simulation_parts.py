"""Plots of a run along a line, of many masses, of many times; what is asked for in words."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.runs.steppers import find_steppers
from experiments.simulation.simulation import Simulation, simulate_all
from reference.errors import InputError
from reference.files.setup import setup_for
from report.figures import look
from report.figures.simulation import FEW, TIMES, Wanted, draw, wanted
from tests.report.figures.artists import cut_off, data, laid_out, overlaps


def simulation(scene: str, *names: str, steps: int = 5, **settings: str) -> Simulation:
    """A scene for some steps of a millisecond, by Heun where nobody is named."""
    setup = setup_for(scene, dt=1e-3, duration=steps * 1e-3, settings=settings)
    return simulate_all(setup, find_steppers(names or ["heun"]))


@pytest.mark.parametrize(
    ("word", "found", "name"),
    [
        ("paths", Wanted("paths"), "paths"),
        ("energy", Wanted("energy"), "energy"),
        ("forces", Wanted("forces"), "forces"),
        ("0:x", Wanted("coordinate", 0, 0), "mass-0-x"),
        ("9:z", Wanted("coordinate", 9, 2), "mass-9-z"),
    ],
)
def test_words_ask_for_plots(word: str, found: Wanted, name: str) -> None:
    """In three dimensions, of ten masses; each has a name for its file."""
    assert wanted(word, 10, 3) == found
    assert found.name == name


@pytest.mark.parametrize(
    ("word", "says"),
    [
        ("path", "paths, energy, forces, or MASS:AXIS with AXIS one of x, y"),
        ("1:z", "AXIS one of x, y"),
        ("1:", "AXIS one of x, y"),
        ("1:xy", "AXIS one of x, y"),
        (":x", "AXIS one of x, y"),
        ("-1:x", "AXIS one of x, y"),
        ("1x", "AXIS one of x, y"),
        ("10:x", "a mass from 0 to 9"),
    ],
)
def test_other_words_are_refused(word: str, says: str) -> None:
    """With what there is, of ten masses in the plane."""
    with pytest.raises(InputError, match=f"--plot '{word}': expected .*{says}"):
        wanted(word, 10, 2)


def test_paths_along_a_line_are_heights_over_time() -> None:
    """Of a chain; what is held does not move and is not drawn."""
    made = simulation("chain", masses="2")
    motion = made.runs[0].motion
    assert motion is not None
    (panel,) = draw(made, Wanted("paths")).figure.axes
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("time [s]", "x [m]")
    times, x = motion.trajectory.times.tolist(), motion.trajectory.positions[..., 0]
    first, end, second, last = (data(line) for line in panel.get_lines())
    assert (first, second) == ((times, x[:, 1].tolist()), (times, x[:, 2].tolist()))
    assert (end, last) == ((times[-1:], x[-1:, 1].tolist()), (times[-1:], x[-1:, 2].tolist()))
    assert first[1] != second[1]


def test_paths_have_their_mass_s_look_and_squares_where_masses_are_held() -> None:
    """The same lengths across and up; the axis that panels share is named once."""
    made = simulation("string", "heun", "euler", masses="2")
    figure = draw(made, Wanted("paths")).figure
    for panel in figure.axes:
        *free, held = panel.get_lines()
        assert [line.get_color() for line in free] == [look(i)["color"] for i in (0, 0, 1, 1)]
        assert [line.get_marker() for line in free[1::2]] == [look(i)["marker"] for i in (0, 1)]
        assert (held.get_marker(), data(held)) == ("s", ([0.0], [0.0]))
        assert panel.get_aspect() == 1
    assert [panel.get_ylabel() for panel in figure.axes] == ["y [m]", ""]
    assert figure.get_suptitle() == "string: paths, a marker at the end"


@pytest.mark.parametrize(("masses", "few"), [(FEW, False), (FEW + 8, True)])
def test_of_many_masses_and_springs_a_dozen_is_drawn(masses: int, few: bool) -> None:
    """Evenly chosen, the last among them; it is told how many of how many."""
    made = simulation("string", masses=str(masses))
    motion = made.runs[0].motion
    assert motion is not None
    paths = draw(made, Wanted("paths")).figure
    ends = [data(line)[0][0] for line in paths.axes[0].get_lines()[1:-1:2]]
    assert len(ends) == FEW
    assert ends[-1] == motion.end.positions[-1, 0]
    assert ends[0] == motion.end.positions[1, 0]
    assert paths.get_suptitle() == f"string: paths{f' of {FEW} of its masses' if few else ''}, a marker at the end"
    forces = draw(made, Wanted("forces")).figure
    numbers = [int(text.get_text()) for text in forces.axes[0].texts]
    assert (len(numbers), numbers[0], numbers[-1]) == (FEW, 0, masses - 1)
    assert {1, 2} >= set(np.diff(numbers).tolist())
    assert (f"{FEW} of {masses}" in forces.get_suptitle()) == few


def test_of_many_times_a_thousand_is_drawn() -> None:
    """The first and the last among them; in a coordinate's plot all are."""
    made = simulation("spring", steps=2 * TIMES)
    motion = made.runs[0].motion
    assert motion is not None
    for kind in ("paths", "energy", "forces"):
        times = data(draw(made, Wanted(kind)).figure.axes[0].get_lines()[0])[0]
        assert len(times) == TIMES
        if kind != "paths":
            assert (times[0], times[-1]) == (0, pytest.approx(2.0))
    axes = draw(made, wanted("1:x", 2, 2)).figure.axes[0]
    assert data(axes.get_lines()[0])[0] == motion.trajectory.times.tolist()


def test_lines_have_marks_that_are_apart() -> None:
    """Eight along each; those of one line beside those of the next."""
    axes = draw(simulation("string", "heun", "euler", "rk4", steps=80, masses="2"), wanted("1:y", 3, 2)).figure.axes[0]
    every = [line.get_markevery() for line in axes.get_lines()]
    assert every == [(0, 10), (3, 10), (6, 10)]
    assert axes.get_title(loc="center") == "string, dt = 0.001 s"
    few = draw(simulation("string", masses="2"), wanted("1:y", 3, 2)).figure.axes[0]
    assert few.get_lines()[0].get_markevery() == (0, 1)


def test_labels_are_at_the_ends_of_their_lines() -> None:
    """In the colour of each, for energies, forces and coordinates alike; what panels share is said in the first."""
    made = simulation("string", "heun", "euler", masses="2")
    for what, *says in (
        (Wanted("energy"), "energy [J]", ""),
        (Wanted("forces"), "spring force [N], tension positive", ""),
        (Wanted("coordinate", 1, 1), "y of mass 1 [m]"),
    ):
        figure = draw(made, what).figure
        assert [panel.get_ylabel() for panel in figure.axes] == says
        for panel in figure.axes:
            assert panel.get_xlabel() == "time [s]"
            for line, text in zip(panel.get_lines(), panel.texts, strict=True):
                times, values = data(line)
                assert text.xy == (times[-1], values[-1])  # type: ignore[attr-defined]
                assert text.arrowprops["color"] == line.get_color()  # type: ignore[attr-defined]


def test_a_dozen_labels_that_end_together_are_beside_one_another() -> None:
    """After one step all springs still have nearly the force that they had."""
    figure = laid_out(draw(simulation("string", steps=1, masses="12"), Wanted("forces")).figure)
    assert len(figure.axes[0].texts) == 12
    assert overlaps(figure) == cut_off(figure) == []


def test_where_nothing_is_known_that_is_said() -> None:
    """Nobody has left a motion; or rods stand for the springs, whose forces are not known."""
    made = simulation("string", "pendulum_heun", masses="2")
    with pytest.raises(InputError, match="no forces to plot of string: rods stand for the springs"):
        draw(made, Wanted("forces"))
    both = simulation("string", "pendulum_heun", "heun", masses="2")
    assert [panel.get_title() for panel in draw(both, Wanted("forces")).figure.axes] == ["heun"]
    with pytest.raises(InputError, match="nothing to plot of string"):
        draw(Simulation(made.setup, []), Wanted("paths"))
