"""Obstacles within the loops of large systems: traced from the same definition, they do the same to the bit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from reference.axes import Axes
from reference.compiled.kernels import advance, loops_for
from reference.compiled.sweep import sweep
from reference.compiled.tracing import numbers_of, trace_obstacles
from reference.lecture.slide_17 import CircleAsMeant, CircleAsPrinted
from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.scenes import find
from reference.schemes import catalogue
from reference.simulate import simulate
from reference.state import State
from reference.system import MassSpringSystem

DT, STEPS = 1e-3, 300

BARRIER = find("barrier").system({})
CIRCLE = BARRIER.obstacles[0]
assert isinstance(CIRCLE, Circle)

CLOTH = find("cloth").system({"rows": 5, "columns": 4})
BELOW = CLOTH.positions.mean(axis=0) - [0.0, 0.6, 0.0]

#: Every kind, each met within STEPS, two of them in one system, slide 17's two circles, and a fixed mass inside one.
SYSTEMS: dict[str, MassSpringSystem] = {
    "circle": BARRIER,
    "circle, on a mesh": BARRIER.renumbered(np.roll(np.arange(len(BARRIER.masses)), 3)),
    "circle as meant": replace(BARRIER, obstacles=(CircleAsMeant(CIRCLE.centre, CIRCLE.radius),)),
    "circle as printed": replace(BARRIER, obstacles=(CircleAsPrinted(CIRCLE.centre, CIRCLE.radius),)),
    "plane": replace(BARRIER, obstacles=(Plane((0.0, -0.25), (0.1, 1.0)),)),
    "sphere and plane": replace(
        CLOTH, obstacles=(Sphere(tuple(BELOW), 0.5), Plane(tuple(BELOW + np.array([0.0, 0.45, 0.0])), (0.1, 1.0, 0.2)))
    ),
    "rectangle": replace(BARRIER, obstacles=(Box((0.5, -0.5), (0.3, 0.2)),)),
    "box": replace(CLOTH, obstacles=(Box(tuple(BELOW), (0.1, 0.4, 0.1)),)),
    "cylinder": replace(CLOTH, obstacles=(Cylinder(tuple(BELOW), (1.0, 0.2, 2.0), 0.5),)),
    "fixed inside": replace(BARRIER, obstacles=(Circle(tuple(BARRIER.positions[0]), 0.01), CIRCLE)),
}


def check_same_bits(system: MassSpringSystem, state: State, scheme: str) -> None:
    """A state is where STEPS calls of a scheme's function end, each of which an obstacle ends; some mass has met it."""
    end = simulate(system, catalogue.find(scheme), DT, STEPS * DT).states()[-1]
    assert state.positions.tolist() == end.positions.tolist()
    assert state.velocities.tolist() == end.velocities.tolist()
    unhindered = simulate(replace(system, obstacles=()), catalogue.find(scheme), DT, STEPS * DT).states()[-1]
    assert end.positions.tolist() != unhindered.positions.tolist()


#: Each by one thread; and by two, on springs that are no string.
THREADS = [*((name, 1) for name in SYSTEMS), ("circle, on a mesh", 2)]


@pytest.mark.rotating(4)
@pytest.mark.parametrize(("name", "threads"), THREADS)
def test_the_loops_do_what_the_function_does_to_the_bit(name: str, threads: int) -> None:
    """Under kick-drift, of one stage; and fixed masses stay where they are, inside an obstacle too."""
    system = SYSTEMS[name]
    end = advance(system, catalogue.find("kick_drift"), DT, STEPS, threads)
    check_same_bits(system, end, "kick_drift")
    assert end.positions[system.fixed].tolist() == system.positions[system.fixed].tolist()
    assert not end.velocities[system.fixed].any()


@pytest.mark.rotating(2)
@pytest.mark.parametrize("scheme", ["heun", "rk4"])
def test_under_other_schemes_too(scheme: str) -> None:
    """The last stage is another."""
    check_same_bits(BARRIER, advance(BARRIER, catalogue.find(scheme), DT, STEPS), scheme)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("name", ["circle", "sphere and plane", "fixed inside"])
def test_a_sweep_does_the_same_to_the_bit(name: str) -> None:
    """More than a block of systems, of which the fourth and the last are looked at.

    By one thread: loops for more are compiled for seconds, and `test_kernels` has them give the same bits.
    """
    scheme = "heun" if name == "circle" else "kick_drift"
    many = sweep(SYSTEMS[name], catalogue.find(scheme), np.full(18, DT), STEPS, threads=1)
    for i in (3, 17):
        check_same_bits(SYSTEMS[name], State(STEPS * DT, many.positions[i], many.velocities[i]), scheme)


def test_same_bits_fail_on_another_rule() -> None:
    """Slide 17's as it is printed, on which loops agree with themselves, but not with ours."""
    other = advance(SYSTEMS["circle as printed"], catalogue.find("kick_drift"), DT, STEPS)
    with pytest.raises(AssertionError):
        check_same_bits(BARRIER, other, "kick_drift")


def test_the_numbers_of_an_obstacle_are_not_in_the_text() -> None:
    """A kernel is compiled for a row of kinds, once."""
    heun = catalogue.find("heun")
    moved = replace(BARRIER, obstacles=(Circle((0.6, -0.7), 0.2),))
    assert loops_for(heun, moved) == loops_for(heun, BARRIER)
    assert numbers_of(moved.obstacles) == [0.6, -0.7, 0.2]
    for other in ("plane", "circle as meant"):
        assert loops_for(heun, SYSTEMS[other]) != loops_for(heun, BARRIER)


@dataclass(frozen=True)
class Corner(Obstacle):
    """What is below the one and left of the other of two axes' planes: a kind as a contributor would add one."""

    point: tuple[float, ...] = (0.9, -0.1)

    @property
    def dimension(self) -> int:
        """2."""
        return 2

    def signed_distance(self, place: Axes) -> tuple[float, Sequence[float]]:
        """See Obstacle."""
        right, up = place[0] - self.point[0], place[1] - self.point[1]
        level = up > right
        return np.maximum(right, up), [np.where(level, 0.0, 1.0), np.where(level, 1.0, 0.0)]


def test_a_kind_is_added_by_its_surface_alone() -> None:
    """It then is in the loops too."""
    system = replace(BARRIER, obstacles=(Corner(),), positions=BARRIER.positions + np.array([0.35, 0.0]))
    check_same_bits(system, advance(system, catalogue.find("kick_drift"), DT, STEPS), "kick_drift")


def test_a_plane_by_hand() -> None:
    """Its gap is (place - point) . normal, and the rule has it in every line that follows."""
    traced = trace_obstacles((Plane((0.0, 0.0), (0.0, 1.0)),), 2)
    assert traced.numbers == 4
    assert traced.lines[:6] == (
        "t0 = place0 - o0",
        "t1 = place1 - o1",
        "t2 = t0 * o2",
        "t3 = t1 * o3",
        "t4 = t2 + t3",
        "t5 = t4 < 0",
    )
    assert traced.lines[6] == "t6 = free & t5"
