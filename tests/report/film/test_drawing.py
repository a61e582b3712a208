"""A system on axes: strains, colours, widths, and what is where; by hand, on what is not symmetric."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from reference.scenes import find
from reference.state import Array
from reference.system import MassSpringSystem
from report.film.drawing import (
    FAR,
    Drawing,
    Look,
    add_length,
    add_strain_bar,
    colour_map,
    lines,
    nice,
    scale_of,
    strain,
)
from report.film.obstacle_image import ObstacleImage
from report.film.view import View, Window

FLAT = View(np.zeros(2), np.eye(2), np.inf)

#: Three springs of 1, 2 and 4 m, in a row; the last mass is held.
ROW = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [7.0, 0.0]]),
    springs=np.array([[0, 1], [1, 2], [2, 3]]),
    masses=np.array(1.0),
    rest_lengths=np.array([1.0, 2.0, 4.0]),
    stiffness=np.array([5.0, 5.0, 5.0]),
    fixed=np.array([False, False, False, True]),
)


def look(view: View = FLAT, **others: object) -> Look:
    """Of the whole row, at strains up to 20 %."""
    parts = {"window": (-1.0, 8.0, -1.0, 1.0), "most": 0.2, "depths": (0.0, 0.0), "obstacles": None}
    return Look(view, **{**parts, **others})  # type: ignore[arg-type]


def in_space(places: Array) -> MassSpringSystem:
    """The row with its masses at other places (4, 3) [m]."""
    return replace(ROW, positions=places, velocities=np.zeros((4, 3)), gravity=np.zeros(3))


def large(masses: int) -> MassSpringSystem:
    """Strings of so many masses, the springs of which are 1, 2 and 4 m long by turns."""
    lengths = np.resize([1.0, 2.0, 4.0], masses - 1)
    places = np.concatenate([[0.0], np.cumsum(lengths)])
    return MassSpringSystem(
        positions=np.column_stack([places, 0 * places]),
        springs=np.column_stack([np.arange(masses - 1), np.arange(1, masses)]),
        masses=np.array(1.0),
        rest_lengths=lengths,
        stiffness=np.array(5.0),
    )


def test_where_there_is_no_rest_length_strain_is_measured_by_the_start_or_the_size() -> None:
    """0.5 m at rest; none, 2 m at the start; none, of no length at the start, in a scene 3 m wide. Twice as far apart.

    At several times at once.
    """
    system = replace(
        ROW,
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [3.0, 0.0]]),
        rest_lengths=np.array([0.5, 0.0, 0.0]),
    )
    later = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 4.0], [2.0, 4.6]])
    assert strain(system, np.stack([system.positions, later])) == pytest.approx(
        np.array([[1.0, 0.0, -1.0], [3.0, 1.0, 0.6 / 3 - 1]])
    )


def test_colours_are_blue_below_and_orange_above() -> None:
    """Grey between; the middle of the colours is no strain, their ends are what is shown at most."""
    places = ROW.positions * [[1.0, 1.0]]
    places[1:, 0] = [0.8, 2.8, 7.6]  # springs of 0.8, 2 and 4.8 m: -20, 0 and 20 %
    drawn = lines(ROW, places, look(), colour_map())
    pushed, still, pulled = drawn.colours[:, :3]
    assert [to_hex(colour) for colour in (pushed, pulled)] == ["#00429d", "#a32a00"]
    assert np.ptp(still) < 0.02
    assert drawn.colours[:, 3].tolist() == [1, 1, 1]
    beyond = lines(ROW, 3 * places, look(), colour_map()).colours[:, :3]
    assert beyond.tolist() == [pulled.tolist()] * 3
    quarter = colour_map()([0.38, 0.62])
    assert quarter[0, 2] > quarter[0, 0] + 0.3
    assert quarter[1, 0] > quarter[1, 2] + 0.3


def test_springs_without_force_are_not_drawn() -> None:
    """Those that are left keep their places, in their order."""
    drawn = lines(replace(ROW, stiffness=np.array([5.0, 0.0, 5.0])), ROW.positions, look(), colour_map())
    assert drawn.segments.tolist() == ROW.positions[ROW.springs[[0, 2]]].tolist()


@pytest.mark.parametrize(
    ("masses", "shares"),
    [
        pytest.param(4, (1, 1, 1), id="few: all alike"),
        pytest.param(30, (1, 1, 1), id="30 are few"),
        pytest.param(31, (1, 0.3, 0.3), id="of more, longer ones are thinner, no less than 30 %"),
        pytest.param(1000, (1, 0.3, 0.3), id="999 springs"),
        pytest.param(1001, (1, 0.3, 0.3), id="1000 springs"),
    ],
)
def test_large_systems_have_thinner_lines_and_long_springs_the_thinnest(masses: int, shares: list[float]) -> None:
    """By the square of the lengths; widths fall from few masses to many springs."""
    system = large(masses)
    widths = lines(system, system.positions, look(), colour_map()).widths
    assert widths[:3] / widths[0] == pytest.approx(shares)
    most = [2.2, 1.6, 0.9]
    assert widths[0] == most[(masses > 30) + (masses > 1000)]


def test_a_spring_somewhat_longer_is_somewhat_thinner() -> None:
    """By the square: 1.5 times as long, in width 1 / 2.25."""
    system = large(40)
    system = replace(system, rest_lengths=np.where(system.rest_lengths > 1, 1.5, 1.0))
    widths = lines(system, system.positions, look(), colour_map()).widths
    assert widths[:2] / widths[0] == pytest.approx([1, 1 / 2.25])


def test_what_is_farther_is_fainter_and_thinner() -> None:
    """As far as it is between the farthest and the nearest, whatever is beyond them; not where all are as far."""
    view = View(np.zeros(3), np.eye(3), 100.0)
    places = np.array([[0.0, 0.0, -1.0], [1.0, 0.0, 3.0], [3.0, 0.0, 5.0], [7.0, 0.0, 1.0]])  # at 1, 4 and 3 m
    system = in_space(places)
    drawn = lines(system, places, look(view, depths=(1.0, 3.0)), colour_map())
    assert drawn.segments[:, 0, 0] == pytest.approx(view.project(places)[0][[0, 2, 1], 0])
    assert drawn.colours[:, 3] == pytest.approx([FAR, 1, 1])
    assert drawn.widths == pytest.approx([2.2 * FAR, 2.2, 2.2])
    between = lines(system, places, look(view, depths=(0.0, 4.0)), colour_map()).colours[:, 3]
    assert between == pytest.approx(FAR + (1 - FAR) * np.array([0.25, 0.75, 1.0]))
    assert 0.3 < FAR < 0.6
    alike = lines(system, places, look(view, depths=(3.0, 3.0)), colour_map())
    assert (alike.colours[:, 3].tolist(), alike.widths.tolist()) == ([1] * 3, [2.2] * 3)


def test_an_obstacle_hides_what_is_behind_by_more_than_a_hundredth_of_the_eyes_distance() -> None:
    """By the middle of a spring: the first two in front of its left half, the third beside it."""
    view = View(np.zeros(3), np.eye(3), 100.0)
    deep = np.array([[3.0, -np.inf]])
    obstacles = ObstacleImage((-1.0, 3.0, -1.0, 1.0), np.zeros((1, 2, 4)), deep)
    for depth, hidden in ((1.9, True), (2.1, False)):
        places = np.column_stack([[-1.0, 0.0, 1.0, 2.5], np.zeros(4), np.full(4, depth)])
        drawn = lines(in_space(places), places, look(view, obstacles=obstacles), colour_map())
        assert drawn.hidden.tolist() == [hidden, hidden, False]


def test_the_scale_leaves_the_two_percent_with_most_strain_at_its_ends() -> None:
    """In 1,000 states of a spring: 15 of 40 % are left out, 25 are not; pushing counts as pulling."""
    spring = find("spring").system({})
    moved = np.repeat(spring.positions[None], 1000, axis=0)
    direction = (spring.positions[1] - spring.positions[0]) / np.linalg.norm(spring.positions[1] - spring.positions[0])
    rest = float(spring.rest_lengths[0])

    def scale(many: int, seen: Array | None = None) -> float:
        strains = np.where(np.arange(1000) < many, -0.4, 0.015)
        moved[:, 1] = moved[:, 0] + rest * (1 + strains)[:, None] * direction
        return scale_of(spring, moved, seen)

    assert (scale(15), scale(25)) == (0.02, 0.5)
    assert scale(25, (np.arange(1000) >= 20)[:, None]) == 0.02
    assert scale(25, np.zeros((1000, 1), bool)) == 1e-6


@pytest.mark.parametrize(
    ("value", "wanted"),
    [(1, 1), (1.001, 2), (2, 2), (2.001, 5), (5, 5), (5.001, 10), (0.02 * (1 + 1e-12), 0.02), (3e-7, 5e-7)],
)
def test_nice_numbers_are_1_2_and_5_times_a_power_of_ten(value: float, wanted: float) -> None:
    """The nearest that is not below, but for rounding."""
    assert nice(value) == pytest.approx(wanted, rel=1e-12)


def drawn(system: MassSpringSystem, how: Look, positions: Array | None = None) -> tuple[Axes, Drawing]:
    """A system on axes, at its start if not elsewhere."""
    axes = Figure().subplots()
    made = Drawing(axes, system, how)
    made.show(system.positions if positions is None else positions, system)
    return axes, made


def test_masses_are_dots_and_those_that_are_held_are_squares() -> None:
    """At their places; squares are larger where four are held at most; of more than thirty masses no dots are seen."""
    axes, made = drawn(ROW, look())
    assert np.column_stack(made.masses.get_data()).tolist() == ROW.positions[:3].tolist()
    assert np.column_stack(made.held.get_data()).tolist() == ROW.positions[3:].tolist()
    assert (made.masses.get_marker(), made.held.get_marker()) == ("o", "s")
    assert (axes.get_xlim(), axes.get_ylim()) == ((-1, 8), (-1, 1))
    assert axes.get_aspect() == 1
    assert not [*axes.get_xticks(), *axes.get_yticks()]
    assert all(spine.get_visible() for spine in axes.spines.values())
    for masses, seen in ((30, True), (31, False)):
        assert drawn(large(masses), look())[1].masses.get_visible() == seen
    sizes = [drawn(replace(large(6), fixed=np.arange(6) < n), look())[1].held.get_markersize() for n in (4, 5)]
    assert sizes[0] > sizes[1] == made.masses.get_markersize()


def test_what_is_hidden_is_drawn_under_the_obstacle_and_the_rest_over_it() -> None:
    """With its colour and width; the true motion is under all."""
    view = View(np.zeros(3), np.eye(3), 100.0)
    places = np.column_stack([[-1.0, 0.0, 1.0, 2.5], np.zeros(4), np.zeros(4)])
    system = in_space(places)
    obstacles = ObstacleImage((-1.0, 3.0, -1.0, 1.0), np.ones((1, 2, 4)), np.array([[3.0, -np.inf]]))
    how = look(view, obstacles=obstacles)
    axes, made = drawn(system, how)
    (image,) = axes.images
    assert image.get_extent() == [-1, 3, -1, 1]
    assert image.origin == "lower"
    assert (len(made.behind.get_segments()), len(made.front.get_segments())) == (2, 1)
    parts = lines(system, places, how, colour_map())
    assert made.front.get_color().tolist() == parts.colours[~parts.hidden].tolist()
    assert list(made.behind.get_linewidths()) == parts.widths[parts.hidden].tolist()
    broken = replace(system, stiffness=np.array([0.0, 5.0, 5.0]))
    made.show(places, system, (places + np.array([0.0, 0.5, 0.0]), broken))
    true = next(c for c in axes.collections if c not in (made.behind, made.front))
    assert np.array(true.get_segments())[:, :, 1].tolist() == [[0.5, 0.5]] * 2
    layers = [true, made.behind, image, made.front, made.masses]
    assert [layer.get_zorder() for layer in layers] == sorted({layer.get_zorder() for layer in layers})
    assert true.get_linewidths()[0] > made.front.get_linewidths()[0]


@pytest.mark.parametrize(
    ("window", "wanted"),
    [
        ((1.0, 5.0, -2.0, -1.0), [[4005, 3], [-3999, 3999], [2, -4002]]),
        ((0, 1, 0, 2), [[2001, 3], [-2000, 2002], [2, -2000]]),
    ],
)
def test_places_far_beyond_the_window_are_brought_nearer(window: Window, wanted: list[list[float]]) -> None:
    """To a thousand times its longer side, beyond each of its sides: what draws them reckons in small numbers."""
    places = np.array([[0.0, 0.0], [1e9, 3.0], [-1e9, 1e9], [2.0, -1e9]])
    assert lines(ROW, places, look(window=window), colour_map()).segments[:, 1].tolist() == wanted


@pytest.mark.parametrize(("width", "length"), [(10.0, 1.0), (10.5, 2.0), (6.0, 1.0)])
def test_a_bar_in_the_lower_left_says_how_long_it_is(width: float, length: float) -> None:
    """Four percent from the corner, and a tenth of what is seen, or the next 1, 2 or 5."""
    axes = Figure().subplots()
    add_length(axes, (-2.0, -2.0 + width, 10.0, 10.5))
    (bar,) = axes.lines
    left = -2.0 + 0.04 * width
    assert np.asarray(bar.get_data()) == pytest.approx(np.array([[left, left + length], [10.02, 10.02]]))
    (words,) = axes.texts
    assert words.get_text() == f"{length:g} m"
    assert words.xy == (pytest.approx(left + length), pytest.approx(10.02))  # type: ignore[attr-defined]


def test_the_bar_of_colours_goes_both_ways() -> None:
    """In percent; with the colours of the springs."""
    figure = Figure()
    axes = figure.subplots()
    add_strain_bar(figure, axes, 0.02)
    assert axes.get_ylim() == pytest.approx((-2, 2))
    assert axes.get_ylabel() == "strain [%]: pushed together (-), pulled apart (+)"
