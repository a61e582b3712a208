"""What MuJoCo makes of contacts, by measurement: the facts that the adapter's settings rest on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import find, version
from engines.mujoco import obstacles as mujoco_obstacles
from engines.process.isolation import EngineStepper, isolated
from reference.collisions.round_masses import Collisions
from reference.obstacles import Box, Circle, Obstacle, Plane
from reference.scenes import find as find_scene
from reference.springs.kinds import NonlinearSprings
from reference.system import MassSpringSystem
from tests.conformance.test_obstacles import KINDS, STEPS, falling

pytestmark = pytest.mark.skipif(version(find("mujoco_tendons")) is None, reason="mujoco is not installed")


def rebound(damping: float) -> float:
    """The part of the speed it came with that a mass leaves a plane with, at a damping ratio."""
    mujoco_obstacles.DAMPING = damping
    case = falling(KINDS["plane"], 0.0)
    simulation = find("mujoco_tendons").start(case.system, case.dt)
    up = 0.0
    for _ in range(STEPS):
        simulation.step()
        up = max(up, float(simulation.state()[1][-1, 1]))
    return up / float(np.sqrt(2 * 9.81 * 0.2))


def test_a_mass_is_thrown_back_less_the_more_it_is_damped() -> None:
    """A mass comes at most v dt deep and is moved out at r/(4 z^2 dt): at most v/(4 z^2), z the damping ratio."""
    found = [float(isolated(rebound, z)) for z in (1.0, 2.0, 4.0)]  # type: ignore[arg-type]
    for back, z in zip(found, (1.0, 2.0, 4.0), strict=True):
        assert 0.1 / (4 * z**2) <= back <= 1.02 / (4 * z**2)
    assert mujoco_obstacles.DAMPING == 2.0


def depth_in_a_thin_box() -> float:
    """How deep a mass is in a table 2 m wide and 1 mm high, 0.2 s after it was let go 1 mm above it [m]."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0015]]),
        springs=np.zeros((0, 2), dtype=int),
        masses=1.0,
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        obstacles=(Box((0.0, 0.0), (1.0, 0.0005)),),
    )
    simulation = find("mujoco_tendons").start(system, 1e-3)
    for _ in range(200):
        simulation.step()
    return 0.0005 - float(simulation.state()[0][0, 1])


def test_beads_are_small_beside_the_thinnest_side_of_a_box() -> None:
    """The box is smaller by their radius: it must be left. At rest a mass is less than a tenth of the height deep."""
    assert abs(float(isolated(depth_in_a_thin_box))) < 1e-4  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "normal", [(0.6, 0.0, 0.8), (0.6, 0.8, 0.0), (-0.48, 0.6, 0.64), (0.0, 0.0, 1.0), (0, 0, -1.0)]
)
def test_a_plane_is_turned_to_its_normal(normal: tuple[float, float, float]) -> None:
    """(w, r) of length 1 turns e_z to e_z + 2 r x (r x e_z + w e_z), which is the normal: to rounding."""
    w, *r = mujoco_obstacles._turn(np.array(normal))
    up = np.array([0.0, 0.0, 1.0])
    assert np.hypot(w, np.linalg.norm(r)) == pytest.approx(1.0, rel=1e-14)
    assert up + 2 * np.cross(r, np.cross(r, up) + w * up) == pytest.approx(np.array(normal), abs=1e-14)


@pytest.mark.parametrize(
    ("obstacle", "smallest"),
    [
        (Box((0.0, 0.0), (1.0, 0.3)), 0.3),
        (Box((0.0, 0.0, 0.0), (0.2, 0.5, 0.4)), 0.2),
        (Circle((0.0, 0.0), 0.7), 0.7),
        (Plane((0.0, 0.0), (0.0, 1.0)), np.inf),
    ],
)
def test_how_small_an_obstacle_is(obstacle: Obstacle, smallest: float) -> None:
    """By its narrowest side, or its radius; a plane is endless."""
    assert mujoco_obstacles._smallest(obstacle) == smallest


def test_what_is_switched_off_where_nothing_meets_and_where_something_does() -> None:
    """Contacts are needed by obstacles and by masses that collide, and by nothing else; the rest is always off."""
    plain = find_scene("string").system({})
    meeting = (
        replace(plain, obstacles=(Plane((0.0, -9.0), (0.0, 1.0)),)),
        replace(plain, collisions=Collisions(np.array(0.01))),
    )
    parts = ("AUTORESET", "CONTACT", "CONSTRAINT", "SENSOR")
    assert mujoco_obstacles.off(plain, parts) == parts
    for system in meeting:
        assert mujoco_obstacles.off(system, parts) == ("AUTORESET", "SENSOR")


# --- What MuJoCo cannot do ---


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("mujoco_tendons", "mass = 1e-15 kg: MuJoCo needs 1e-14 kg or more"),
        ("mujoco_flex", "mass = 1e-15 kg: MuJoCo needs 1e-14 kg or more"),
        ("mujoco_cable", "mass times length squared = 1e-17 kg m^2: MuJoCo needs 1e-14 kg m^2 or more"),
    ],
)
def test_a_mass_too_small_is_refused_with_its_unit(name: str, said: str) -> None:
    """The smallest of all, or its moment of inertia."""
    system = find_scene("string").system({"masses": 2, "mass": "1e-15,0.02", "rest_length": 0.1})
    outcome = EngineStepper(find(name)).run(system, 1e-3, 1)
    assert (outcome.ending, outcome.reason) == ("unsupported", said)


def test_the_first_segment_that_would_stretch_is_named() -> None:
    """With how fast: of two the first, though the second is faster."""
    string = find_scene("string").system({"masses": 3})
    velocities = np.array([[0.0, 0.0], [0.0, 0.0], [0.25, 0.0], [-2.0, 0.0]])
    outcome = EngineStepper(find("mujoco_cable")).run(replace(string, velocities=velocities), 1e-3, 1)
    assert outcome.reason == "a cable does not stretch, but at the start spring 1 does, by 0.25 m/s"


@pytest.mark.parametrize("name", ["mujoco_tendons", "pymunk_springs"])
def test_one_damped_spring_that_goes_slack_is_refused(name: str) -> None:
    """Among ropes without damping and springs with damping, which are taken."""
    if version(find(name)) is None:
        pytest.skip(f"{name} is not installed")
    ropes, damping = np.array([True, True, False]), np.array([0.0, 0.0, 0.1])
    string = replace(find_scene("string").system({"masses": 3}), nonlinear=NonlinearSprings(tension_only=ropes))
    stepper = EngineStepper(find(name))
    assert stepper.run(replace(string, damping=damping), 1e-3, 1).ending == "done"
    refused = stepper.run(replace(string, damping=damping[::-1].copy()), 1e-3, 1)
    assert refused.ending == "unsupported"
    assert "expected none that go slack with damping" in refused.reason
