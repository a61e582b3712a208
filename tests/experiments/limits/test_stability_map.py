"""Maps of stability: growth that is measured changes where theory says, on planes with dt and without."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.process.isolation import EngineStepper
from experiments.limits import predicted_limits
from experiments.limits.map_axes import axes_for, system_maker
from experiments.limits.plane import Axis, Plane
from experiments.limits.predicted_limits import predicted_field
from experiments.limits.stability_map import stability_map
from reference.errors import InputError
from reference.lecture.listings import listings
from reference.scenes import find as find_scene
from reference.schemes import catalogue
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit


def test_a_swept_map_changes_colour_at_the_predicted_boundary() -> None:
    """Growth per step is over 1 % beyond 1.02 of the predicted limit and none below 0.98 of it."""
    system_at, dt = system_maker("string", {"masses": "2"})
    x, y = axes_for(("dt", "drag"), {"drag": (0.05, 0.2)}, system_at({}))
    found = stability_map(SchemeStepper(catalogue.find("kick_drift")), system_at, dt, x, y, resolution=20)
    limit = np.interp(found.y_values, found.boundary[:, 1], found.boundary[:, 0])[:, None]
    assert (found.growth[found.x_values > 1.02 * limit] > 0.01).all()
    assert (found.growth[(found.x_values < 0.98 * limit)] < 1e-3).all()


def test_an_engine_has_a_map_too() -> None:
    """Coarser, with the boundary of the scheme it is identified with in the middle of the plane."""
    engine = find_engine("mujoco_tendons")
    system_at, dt = system_maker("string", {"masses": "2"})
    x, y = axes_for(("dt", "damping"), {"damping": (0.1, 0.5)}, system_at({}))
    found = stability_map(EngineStepper(engine), system_at, dt, x, y, resolution=6)
    limit = np.interp(found.y_values, found.boundary[:, 1], found.boundary[:, 0])[:, None]
    assert not np.isfinite(found.growth[found.x_values > 1.1 * limit]).any()
    assert (found.growth[(found.x_values < 0.9 * limit)] < 3e-3).all()


def one_mass(stiffness: Axis, mass: Axis, dt: float) -> Plane:
    """A mass on a spring over its own parameters."""

    def system_at(point: predicted_limits.Point) -> MassSpringSystem:
        return find_scene("string").system({"masses": 1, **point})

    return Plane(stiffness, mass, system_at, dt)


def check_field(plane: Plane, dt: float) -> None:
    """Kick-drift of one mass is stable for dt < 2/w, w^2 = k/m: over dt, 2 (m/k)^(1/2) / dt, to the search's 1e-6."""
    k, m, field = predicted_field(SchemeStepper(catalogue.find("kick_drift")), plane)
    assert field == pytest.approx(2 * np.sqrt(m[:, None] / k) / dt, rel=1e-6)


def test_a_plane_without_dt_has_the_closed_form_at_every_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows are y and columns x; x and y swapped, or another dt, are not it."""
    monkeypatch.setattr(predicted_limits, "FIELD", 3)
    k, m = Axis("stiffness", 100.0, 400.0), Axis("mass", 0.01, 0.03)
    check_field(one_mass(k, m, 5e-3), 5e-3)
    with pytest.raises(AssertionError):
        check_field(one_mass(k, m, 5e-3), 4e-3)
    swapped = one_mass(m, k, 5e-3)
    with pytest.raises(AssertionError):
        check_field(swapped, 5e-3)


def test_points_go_row_by_row() -> None:
    """X varies fastest, as growth of shape (y, x) is filled; dt is no parameter of a system."""
    plane = Plane(Axis("dt", 1.0, 2.0), Axis("drag", 0.0, 1.0), lambda _: find_scene("string").system({}), 5.0)
    points = plane.points(np.array([1.0, 2.0]), np.array([0.0, 1.0]))
    assert [(p["dt"], p["drag"]) for p in points] == [(1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 1.0)]
    assert [plane.step(p) for p in points] == [1.0, 2.0, 1.0, 2.0]
    assert [plane.parameters(p) for p in points] == [{"drag": 0.0}, {"drag": 0.0}, {"drag": 1.0}, {"drag": 1.0}]


@pytest.mark.parametrize(
    ("x", "said"),
    [
        (Axis("drag", 2.0, 1.0), "map axis drag from 2 to 1: expected a rising range"),
        (Axis("drag", 0.0, np.inf), "map axis drag from 0 to inf: expected a rising range"),
        (Axis("colour", 0.0, 1.0), "map axis 'colour': expected one of dt, masses, "),
    ],
    ids=["falls", "infinite", "unknown"],
)
def test_an_axis_that_makes_no_sense_is_refused(x: Axis, said: str) -> None:
    """In one line: which axis, what it had, and what was expected."""
    system_at, dt = system_maker("string", {})
    with pytest.raises(InputError) as refused:
        stability_map(SchemeStepper(catalogue.find("rk4")), system_at, dt, x, Axis("dt", 1e-3, 1e-2))
    assert str(refused.value).startswith(said)


def test_what_is_neither_swept_nor_an_engine_is_refused() -> None:
    """A listing of the lecture, by its name."""
    system_at, dt = system_maker("string", {"masses": "2"})
    x, y = Axis("dt", 1e-3, 1e-2), Axis("stiffness", 100.0, 200.0)
    with pytest.raises(InputError, match="lecture_heun_loops"):
        stability_map(listings()["lecture_heun_loops"], system_at, dt, x, y, resolution=2)


def test_the_usual_range_of_an_axis_is_about_the_systems_first_spring_and_last_mass() -> None:
    """From a twentieth to twice: of a string whose springs and masses differ."""
    system = find_scene("string").system(
        {"masses": 3, "rest_length": "0.1,0.2,0.3", "stiffness": "50,60,70", "mass": "1,2,3"}
    )
    for name, value in (("rest_length", 0.1), ("stiffness", 50.0), ("mass", 3.0)):
        x, _ = axes_for((name, "dt"), {}, system)
        assert (x.low, x.high) == pytest.approx((0.05 * value, 2 * value))


def test_the_usual_steps_are_from_short_ones_to_where_most_schemes_have_given_up() -> None:
    """With w the fastest frequency, kick-drift gives up at 2 / w and rk4 at 2.83 / w: from 0.05 to 3.5 / w."""
    system = find_scene("string").system({})
    x, _ = axes_for(("dt", "damping"), {}, system)
    limit = stability_limit(catalogue.find("kick_drift"), spring_equilibrium(system)).dt
    assert limit is not None
    assert (x.low, x.high) == pytest.approx((limit / 40, 1.75 * limit), rel=1e-6)


@pytest.mark.parametrize("dt_first", [True, False])
def test_the_boundary_is_a_list_of_points_whichever_axis_is_dt(dt_first: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Kick-drift of one mass: dt = 2 (m/k)^(1/2) at each stiffness."""
    monkeypatch.setattr(predicted_limits, "BOUNDARY", 3)
    dt, stiffness = Axis("dt", 1e-3, 1e-2), Axis("stiffness", 100.0, 400.0)
    plane = one_mass(*((dt, stiffness) if dt_first else (stiffness, dt)), 5e-3)
    boundary = predicted_limits.predicted_boundary(SchemeStepper(catalogue.find("kick_drift")), plane)
    k = np.array([100.0, 250.0, 400.0])
    limit = 2 * np.sqrt(float(plane.system({}).masses[-1]) / k)
    assert boundary == pytest.approx(np.column_stack([limit, k] if dt_first else [k, limit]), rel=1e-6)


def test_of_two_axes_that_make_no_sense_the_first_is_told() -> None:
    """That along x."""
    with pytest.raises(InputError, match="map axis drag from 2 to 1"):
        Plane(Axis("drag", 2.0, 1.0), Axis("mass", 4.0, 3.0), lambda _: find_scene("string").system({}), 1e-3)
