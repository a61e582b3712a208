"""What Bullet makes of contacts, by measurement: the facts that the adapter's settings rest on."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from engines.capability_cases import for_each_capability
from engines.engine import find, version
from engines.process.isolation import EngineStepper, isolated
from reference.obstacles import Circle, Plane, Sphere
from reference.scenes import find as find_scene
from reference.system import MassSpringSystem
from tests.conformance.test_obstacles import falling

DT = 1e-3

BULLET = find("bullet_softbody")

pytestmark = pytest.mark.skipif(version(BULLET) is None, reason="pybullet is not installed")


def through(anchor: float) -> Any:
    """How deep [m] a mass gets that slides on a circle of 1 m, a spring without force leading to an anchor."""
    place = np.array([np.sin(0.2), np.cos(0.2)])
    system = MassSpringSystem(
        positions=np.array([[0.0, anchor], place]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.02),
        rest_lengths=np.array(np.linalg.norm(place - [0.0, anchor])),
        stiffness=np.array(1e-9),
        fixed=np.array([True, False]),
        obstacles=(Circle((0.0, 0.0), 1.0),),
    )
    simulation = BULLET.start(system, DT)
    deepest = 0.0
    for _ in range(300):
        simulation.step()
        deepest = max(deepest, 1.0 - float(np.linalg.norm(simulation.state()[0][1])))
    return deepest


def test_contact_is_exact_on_a_sphere_but_for_springs_that_cut_it() -> None:
    """From above to 1e-12 m. A spring through the sphere is in contact too, and its masses are thrown about."""
    assert isolated(through, 4.0) <= 1e-12
    assert isolated(through, -3.0) >= 0.1


def test_a_circle_within_the_margin_is_refused() -> None:
    """With the reason."""
    case = falling(Circle((0.0, -0.01), 0.01), 0.0)
    outcome = EngineStepper(BULLET).run(case.system, case.dt, 1)
    assert (outcome.ending, "margin" in outcome.reason) == ("unsupported", True)


def test_a_sphere_is_taken_beside_other_obstacles_where_the_mesh_has_no_apex() -> None:
    """By a cloth of triangles, with a plane or without; a string in space needs the apex, and is refused the sphere."""
    sphere, plane = Sphere((0.0, 0.0, -5.0), 1.0), Plane((0.0, 0.0, -9.0), (0.0, 0.0, 1.0))
    cloth = find_scene("cloth").system({"rows": 3, "columns": 3})
    string = replace(for_each_capability()["3d"], obstacles=(sphere,))
    for obstacles in ((sphere,), (sphere, plane), (plane, sphere)):
        system = replace(cloth, obstacles=obstacles)
        assert EngineStepper(BULLET).run(system, DT, 1).ending == "done"
    refused = EngineStepper(BULLET).run(string, DT, 1)
    assert (refused.ending, "a sphere" in refused.reason) == ("unsupported", True)
