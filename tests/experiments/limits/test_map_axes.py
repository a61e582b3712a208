"""The axes of maps: their units, their usual ranges, their points, and the system at each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from experiments.limits.map_axes import axes_for, system_maker
from experiments.limits.plane import AXES, Axis, Plane
from reference.errors import InputError
from reference.system import MassSpringSystem

#: A mass of 0.5 kg on 200 N/m: its fastest mode has w = 20/s.
W = 20.0


def spring(**fields: Any) -> MassSpringSystem:
    """That, hanging; some of it otherwise."""
    parts: dict[str, Any] = {
        "positions": np.array([[0.0, 0.0], [0.0, -1.0]]),
        "springs": np.array([[0, 1]]),
        "masses": np.array([3.0, 0.5]),
        "rest_lengths": np.array(1.0),
        "stiffness": np.array(200.0),
        "fixed": np.array([True, False]),
    }
    return MassSpringSystem(**{**parts, **fields})


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("dt", 0.05 / W, 3.5 / W),
        ("masses", 1, 40),
        ("mass", 0.025, 1.0),
        ("rest_length", 0.05, 2.0),
        ("stiffness", 10.0, 400.0),
        ("gravity", 0.05 * 9.81, 2 * 9.81),
        ("damping", 0, 0.5 * 0.5 * W),
        ("drag", 0, 0.5 * 0.5 * W),
    ],
)
def test_usual_ranges_are_about_what_there_is(name: str, low: float, high: float) -> None:
    """From a twentieth to twice of it; dt up to 3.5 over the fastest rate; damping to half of what creeps."""
    other = "dt" if name != "dt" else "mass"
    first, second = axes_for((name, other), {}, spring())
    assert (first.name, second.name) == (name, other)
    assert (first.low, first.high) == (pytest.approx(low), pytest.approx(high))


def test_without_gravity_its_range_is_that_of_the_earth() -> None:
    """Nothing times two would be nothing."""
    first, _ = axes_for(("gravity", "dt"), {}, spring(gravity=np.zeros(2)))
    assert (first.low, first.high) == (pytest.approx(0.05 * 9.81), pytest.approx(2 * 9.81))


def test_a_range_that_is_given_is_taken() -> None:
    """Of one of both axes; the other has its own."""
    first, second = axes_for(("stiffness", "dt"), {"dt": (0.1, 0.2)}, spring())
    assert (second.low, second.high) == (0.1, 0.2)
    assert first.high == pytest.approx(400)


@pytest.mark.parametrize(
    ("names", "ranges", "says"),
    [
        (("dt", "dt"), {}, "--map dt dt: expected two different axes"),
        (("dt", "stifness"), {}, "unknown map axis 'stifness': did you mean 'stiffness'?"),
        (("dt", "mass"), {"drag": (0.0, 1.0)}, "--range drag: expected one of the map's axes, dt or mass"),
    ],
)
def test_what_are_no_axes_is_refused(names: tuple[str, str], ranges: dict[str, tuple[float, float]], says: str) -> None:
    """In one line."""
    with pytest.raises(InputError) as refusal:
        axes_for(names, ranges, spring())
    assert str(refusal.value).startswith(says)


def test_systems_have_the_values_of_their_point() -> None:
    """As many masses as are asked for, of the scene as it was set; other parameters set besides."""
    system_at, dt = system_maker("string", {"masses": "3", "stiffness": "50"})
    plain, many = system_at({}), system_at({"masses": 5.0, "drag": 0.25})
    assert (len(plain.masses), len(many.masses)) == (4, 6)
    assert (plain.drag, many.drag) == (0, 0.25)
    assert plain.stiffness[0] == many.stiffness[0] == 50
    assert system_at({"stiffness": 70.0}).stiffness.tolist() == [70] * 3
    assert dt == 1e-3
    assert system_maker("string", {}, 0.25)[1] == 0.25


@pytest.mark.parametrize("name", AXES)
def test_every_axis_has_its_unit(name: str) -> None:
    """In its heading; masses are counted."""
    units = {"dt": "s", "masses": "1", "mass": "kg", "rest_length": "m", "stiffness": "N/m", "gravity": "m/s^2"}
    assert Axis(name, 0.0, 1.0).heading == f"{name} [{units.get(name, 'N s/m')}]"


def test_values_are_evenly_spaced_and_whole_for_masses() -> None:
    """Each number of masses once."""
    assert Axis("dt", 0.1, 0.3).values(5) == pytest.approx([0.1, 0.15, 0.2, 0.25, 0.3])
    assert Axis("masses", 1, 4).values(9).tolist() == [1, 2, 3, 4]


def plane(x: str = "mass", y: str = "drag", low: float = 1.0, high: float = 3.0) -> Plane:
    """Of two axes, with 0.5 s where none is dt; of what a system is made is noted in its place."""
    return Plane(Axis(x, low, high), Axis(y, 10.0, 30.0), lambda values: dict(values), 0.5)  # type: ignore[arg-type, return-value]


def test_points_go_row_by_row() -> None:
    """From left to right, then upwards; a step is the plane's, or that of the point."""
    points = plane().points(np.array([1.0, 2.0]), np.array([10.0, 20.0]))
    assert points == [{"mass": x, "drag": y} for y in (10, 20) for x in (1, 2)]
    assert plane().middle == {"mass": 2, "drag": 20}
    assert plane().step(points[0]) == 0.5
    for made in (plane(x="dt"), plane(y="dt")):
        assert made.has_dt
        point = made.middle
        assert made.step(point) == point["dt"] != 0.5
        assert "dt" not in made.system(point) == made.parameters(point)  # type: ignore[operator]
    assert not plane().has_dt


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"x": "length"}, "map axis 'length': expected one of dt, masses"),
        ({"low": 3.0}, "map axis mass from 3 to 3: expected a rising range"),
        ({"low": 4.0}, "expected a rising range"),
        ({"low": np.nan}, "expected a rising range"),
        ({"high": np.inf}, "expected a rising range"),
    ],
)
def test_ranges_rise(fields: dict[str, Any], says: str) -> None:
    """And are of parameters."""
    with pytest.raises(InputError, match=says):
        plane(**fields)
