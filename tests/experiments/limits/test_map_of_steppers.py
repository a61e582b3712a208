"""How a map is made for each kind of stepper: at how many points, by whose runs, with whose prediction."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.process.isolation import EngineStepper
from experiments.limits import measured_growth, stability_map
from experiments.limits.plane import Axis, Plane, Point
from experiments.limits.stability_map import StabilityMap
from reference.errors import SolverError
from reference.scenes import find
from reference.stepper import Stepper, stepper_named
from reference.system import MassSpringSystem
from tests.conformance.doctored import Doctored

#: Of three whole numbers of masses there are three columns, however many points are asked for.
MASSES, DRAG, DT = Axis("masses", 1.0, 3.0), Axis("drag", 0.0, 1.0), Axis("dt", 1e-3, 2e-3)


def system_at(values: Point) -> MassSpringSystem:
    """A string."""
    return find("string").system({"masses": 2})


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is run: growth is who measures it, then the number of the point; 5 points if swept, 4 of an engine."""
    for i, name in enumerate(("swept_growth", "stepped_growth", "engine_growth")):
        monkeypatch.setattr(
            stability_map, name, lambda stepper, plane, points, *_, i=i: 100.0 * i + np.arange(len(points))
        )
    monkeypatch.setattr(stability_map, "SWEPT", 5)
    monkeypatch.setattr(stability_map, "ENGINE", 4)
    monkeypatch.setattr(stability_map, "predicted_boundary", lambda scheme, plane: np.ones((2, 2)))
    monkeypatch.setattr(stability_map, "predicted_field", lambda scheme, plane: "a field")
    monkeypatch.setattr(stability_map, "identify", lambda *_: SimpleNamespace(identified_as="rk4"))
    monkeypatch.setattr(
        stability_map, "why_not_compiled", lambda scheme: None if scheme.name != "backward_euler" else "it is not"
    )


def made(stepper: Stepper, x: Axis = MASSES, resolution: int | None = None) -> StabilityMap:
    """Over masses, or dt, and drag."""
    return stability_map.stability_map(stepper, system_at, 1e-3, x, DRAG, resolution=resolution)


ENGINE = EngineStepper(Doctored())


@pytest.mark.parametrize(
    ("stepper", "who", "rows", "by"),
    [
        (stepper_named("heun"), 0.0, 5, "heun"),
        (stepper_named("backward_euler"), 100.0, 4, "backward_euler"),
        (stepper_named("pendulum_rk4"), 100.0, 4, "pendulum_rk4"),
        (ENGINE, 200.0, 4, "rk4"),
    ],
    ids=["compiled", "not compiled", "on rods", "engine"],
)
def test_a_map_is_measured_as_its_stepper_can(stepper: Stepper, who: float, rows: int, by: str) -> None:
    """Row by row from the first point on; an engine's prediction is of the scheme it is identified with."""
    found = made(stepper)
    assert found.growth.shape == (rows, 3)
    assert found.growth[0].tolist() == [who, who + 1, who + 2]
    assert (found.x_values.tolist(), len(found.y_values)) == ([1.0, 2.0, 3.0], rows)
    assert (found.stepper, found.predicted_by) == (stepper.name, by)
    assert made(stepper, resolution=2).growth.shape == (2, 2)


def test_a_plane_with_dt_has_a_boundary_and_another_a_field(monkeypatch: pytest.MonkeyPatch) -> None:
    """Who is no scheme has neither."""
    with_dt, without = made(ENGINE, DT), made(ENGINE)
    assert (len(with_dt.boundary), with_dt.predicted_limit) == (2, None)
    assert (len(without.boundary), without.predicted_limit) == (0, "a field")
    monkeypatch.setattr(stability_map, "identify", lambda *_: SimpleNamespace(identified_as=None))
    for nobody in (made(ENGINE, DT), made(ENGINE)):
        assert (len(nobody.boundary), nobody.predicted_limit) == (0, None)
        assert nobody.predicted_by == "no scheme it is identified with"


def test_a_scheme_s_own_steps_tell_growth_at_each_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of how far the masses are from rest; infinite where a step has no solution."""
    asked: list[tuple[float, float]] = []

    def simulate(start: Any, scheme: object, dt: float, duration: float, equations: object) -> Any:
        asked.append((dt, duration))
        if dt > 1.5e-3:
            raise SolverError("no solution")
        return SimpleNamespace(positions=np.array([5.0, 6.0]))

    monkeypatch.setattr(measured_growth, "simulate", simulate)
    monkeypatch.setattr(measured_growth, "perturbed", lambda system, rest: (np.array([1.0, 1.0]), "start"))
    monkeypatch.setattr(measured_growth, "random_growth", lambda offsets: float(offsets.sum()))
    plane = Plane(DT, DRAG, system_at, 1e-3)
    points = plane.points(np.array([1e-3, 2e-3]), np.array([0.0, 1.0]))
    told: list[str] = []
    stepper = stepper_named("heun")
    found = measured_growth.stepped_growth(stepper, plane, points, told.append)
    assert found.tolist() == [9.0, np.inf, 9.0, np.inf]
    assert asked[0] == (1e-3, pytest.approx(measured_growth.ENGINE_STEPS * 1e-3))
    assert told == [f"{i} of 4 runs" for i in range(4)]
