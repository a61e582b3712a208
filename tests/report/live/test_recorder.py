"""What is recorded of lanes, how lanes come and go in it, and how it is plotted."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import numpy as np
import pytest

from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.colours import LANE_COLOURS
from report.live.deferred_removal import DeferredRemoval
from report.live.plots import Plots
from report.live.recorder import Recorder

#: Masses of 1, 2 and 3 kg.
SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
    springs=np.array([[0, 1], [1, 2]]),
    masses=np.array([1.0, 2.0, 3.0]),
    rest_lengths=np.array(1.0),
    stiffness=np.array(100.0),
)


def lane(energy: float, moved: Array | float = 0.0, speed: Array | float = 0.0, cursor: bool = False) -> Any:
    """One whose masses are moved by so much [m] and have speeds [m/s], each shape (3, 2)."""
    x, v = SYSTEM.positions + moved, np.zeros((3, 2)) + speed
    if cursor:
        x, v = np.vstack([x, [[9.0, 9.0]]]), np.vstack([v, [[9.0, 9.0]]])
    return SimpleNamespace(energy=energy, state=State(0.0, x, v))


def test_each_lane_has_its_energy_momentum_and_distance() -> None:
    """Against the true motion: momentum is of all masses, distance that of the farthest; not of the cursor's mass."""
    moved = np.array([[0.0, 0.1], [0.3, 0.4], [0.0, 0.0]])
    speed = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    made = Recorder(["euler", "heun"])
    made.record(0.5, 0.25, [lane(1.0), lane(2.0, moved, speed, cursor=True)], SYSTEM.start, SYSTEM)
    times, numbers = made.last(10.0, 10)
    assert times.tolist() == [0.25]
    assert numbers[0].tolist() == [[1, 0, 0], [2, pytest.approx(np.hypot(2.0, 3.0)), pytest.approx(0.5)]]
    assert made.begin.tolist() == numbers[0].tolist()


def test_without_the_true_motion_lanes_are_held_against_the_first() -> None:
    """Of which nothing is known then."""
    made = Recorder(["euler", "heun"])
    made.record(0.0, 0.0, [lane(1.0, 0.5), lane(2.0, 0.5 + np.array([3.0, 4.0]))], None, SYSTEM)
    _, numbers = made.last(10.0, 10)
    first, second = numbers[0].tolist()
    assert first == [1, pytest.approx(np.nan, nan_ok=True), pytest.approx(np.nan, nan_ok=True)]
    assert second == [2, 0, pytest.approx(5)]


def recorder(clocks: list[float], names: tuple[str, ...] = ("heun",), energy: float = 1.0) -> Recorder:
    """Frames at times of the clock; energies are those and grow with it."""
    made = Recorder(names)
    for clock in clocks:
        lanes = [lane(energy * (1 + i + clock), moved=1e-3 * clock) for i in range(len(names))]
        made.record(clock, 2 * clock, lanes, SYSTEM.start, SYSTEM)
    return made


def test_the_last_seconds_are_those_of_the_clock_and_no_more_points_than_asked_for() -> None:
    """Evenly, the first of these seconds among them; times are the scene's."""
    made = recorder([0.0, 1.0, 2.0, 3.0, 4.0])
    assert made.last(2.0, 10)[0].tolist() == [4, 6, 8]
    assert made.last(1.9, 10)[0].tolist() == [6, 8]
    assert made.last(9.0, 5)[0].tolist() == [0, 2, 4, 6, 8]
    assert made.last(9.0, 4)[0].tolist() == [0, 4, 8]
    assert made.last(9.0, 2)[0].tolist() == [0, 6]
    assert Recorder(["a", "b"]).last(9.0, 4)[1].shape == (0, 2, 3)
    made.forget_after(2.0)
    assert (len(made), made.last(9.0, 9)[0].tolist()) == (3, [0, 2, 4])


def test_lanes_come_and_go() -> None:
    """Of one that comes nothing is known before, and it begins as the first did; those that stay keep their numbers."""
    made = recorder([0.0, 1.0], ("heun", "rk4"))
    made.take(["heun", "rk4", "euler", "leapfrog"])
    numbers = made.last(9.0, 9)[1]
    assert numbers.shape == (2, 4, 3)
    assert numbers[:, :2, 0].tolist() == [[1, 2], [2, 3]]
    assert np.isnan(numbers[:, 2:]).all()
    assert made.begin[:, 0].tolist() == [1, 2, 1, 1]
    made.take(["rk4"])
    assert made.last(9.0, 9)[1][:, :, 0].tolist() == [[1], [2]]
    assert (made.begin.shape, made.names) == ((1, 3), ("rk4",))


def test_the_csv_has_a_row_for_each_frame() -> None:
    """Lanes of one name are told apart by their numbers."""
    head, *rows = recorder([0.5, 1.0], ("heun", "rk4", "heun")).csv().splitlines()
    kinds = ("energy [J]", "momentum off [kg m/s]", "distance [m]")
    assert head.split(",") == ["time [s]", *(f"{who} {kind}" for who in ("heun 1", "rk4", "heun 3") for kind in kinds)]
    assert [[float(cell) for cell in row.split(",")][:3] for row in rows] == [[1.0, 1.5, 0.0], [2.0, 2.0, 0.0]]
    assert all(len(row.split(",")) == 10 for row in rows)


class Panel:
    """Where plots go, in place of a viewer's: all that were asked for, in order."""

    def __init__(self) -> None:
        self.plots: list[Any] = []
        self.inside = False
        self.gui = MagicMock()
        self.gui.add_uplot.side_effect = self._plot

    def _plot(self, **how: Any) -> Any:
        assert self.inside
        self.plots.append(SimpleNamespace(visible=True, **how))
        return self.plots[-1]

    @contextmanager
    def room(self) -> Iterator[None]:
        """Entered while a plot is made."""
        self.inside = True
        yield
        self.inside = False

    def shown(self) -> list[Any]:
        """Those that can be seen, from above."""
        return sorted((plot for plot in self.plots if plot.visible), key=lambda plot: plot.order)


def test_plots_show_what_is_known_of_each_lane() -> None:
    """Energy gained since the start, in the unit that suits; logarithms of the rest; a line for each lane, by name."""
    panel = Panel()
    plots = Plots(panel, panel.room, DeferredRemoval())  # type: ignore[arg-type]
    made = recorder([0.0, 1.0, 2.0], ("heun", "rk4"), energy=0.04)
    plots.show(made)
    energy, momentum, distance = panel.shown()
    assert energy.title == "energy gained since the start [mJ]"
    assert [plot.title.partition(":")[2] for plot in (momentum, distance)] == [" log10 of kg m/s", " log10 of m"]
    times, heun, rk4 = energy.data
    assert times.tolist() == [0, 2, 4]
    assert np.stack([heun, rk4]) == pytest.approx(np.array([[0, 40, 80]] * 2))
    away = 1e-3 * np.sqrt(2) * np.array([1.0, 1.0, 2.0])
    assert distance.data[1] == pytest.approx(np.log10(away))
    x, first, second = energy.series
    assert x["label"] == "t [s]" == energy.axes[0]["label"]
    assert [line["label"] for line in (first, second)] == ["heun", "rk4"]
    assert [line["stroke"] for line in (first, second)] == [f"rgb{colour}" for colour in LANE_COLOURS[:2]]
    assert first["dash"] != second["dash"]
    assert not first["points"]["show"]
    assert not energy.legend["live"]
    assert not energy.scales["x"]["time"]
    assert ["y" in plot.scales for plot in (energy, momentum, distance)] == [True, False, False]


def test_plots_go_on_where_they_consist_of_the_same() -> None:
    """And are made anew where a lane comes, or the unit changes; after a reset there is none."""
    panel = Panel()
    plots = Plots(panel, panel.room, DeferredRemoval())  # type: ignore[arg-type]
    plots.show(recorder([0.0, 1.0]))
    before = panel.shown()
    plots.show(recorder([0.0, 1.0, 2.0]))
    assert panel.shown() == before
    assert [len(plot.data[0]) for plot in before] == [3, 3, 3]
    plots.show(recorder([0.0, 1.0], energy=1e4))
    assert panel.shown()[0].title == "energy gained since the start [kJ]"
    assert panel.shown()[1:] == before[1:]
    plots.show(recorder([0.0, 1.0], ("heun", "rk4")))
    assert [len(plot.series) for plot in panel.shown()] == [3, 3, 3]
    made = recorder([0.0, 1.0])
    made.take(["heun", "euler"])
    made.record(2.0, 4.0, [lane(1.0), lane(2.0)], SYSTEM.start, SYSTEM)
    plots.show(made)  # of the one that came nothing is known before
    assert [[line["label"] for line in plot.series] for plot in panel.shown()] == [["t [s]", "heun", "euler"]] * 3
    plots.show(recorder([0.0]))
    assert panel.shown() == []
    made = Recorder(["heun"])
    for clock in (0.0, 1.0):
        made.record(clock, clock, [lane(1.0)], None, SYSTEM)
    plots.show(made)
    assert [plot.title.partition(" ")[0] for plot in panel.shown()] == ["energy"]
