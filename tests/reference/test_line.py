"""Systems along a line: the damped oscillator's closed form, the same motion in the plane, and gravity both ways."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.changes import Change
from reference.conserved import energy
from reference.lecture.listings import listings
from reference.line import (
    in_plane,
    is_vertical,
    obstacle_in_plane,
    on_line,
    parameter_in_plane,
    system_in_plane,
    system_on_line,
    value_in_plane,
)
from reference.obstacles import Circle, Plane
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import SchemeStepper, catalogued
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.exact import damped_oscillator, exact
from tests.reference.systems import WHOLE_STATE, label, random_mesh

#: How long [s], at how many times the error is looked at, and steps of the coarsest run by a scheme's order.
DURATION, TIMES, COARSEST = 0.064, 8, {1: 320, 2: 160, 4: 128}


# --- The damped oscillator ---


def oscillator() -> MassSpringSystem:
    """With damping and drag, which on one spring from a fixed mass are the same; thrown upwards."""
    return find_scene("oscillator").system({"damping": 0.05, "drag": 0.02, "velocity": 0.7})


def oscillation(system: MassSpringSystem, times: Array) -> Array:
    """Its position in closed form: m y'' + (c + Cd) y' + k y = 0 about where it hangs, m g / k below."""
    mass, k, length = float(system.masses[1]), float(system.stiffness[0]), float(system.rest_lengths[0])
    rest = -length + mass * float(system.gravity[0]) / k
    start, speed = float(system.positions[1, 0]) - rest, float(system.velocities[1, 0])
    y, _ = damped_oscillator(mass, k, float(system.damping[0]) + system.drag, start, speed, times)
    return np.asarray(rest + y)


def measured_order(scheme: Scheme, system: MassSpringSystem) -> float:
    """The slope of log(error) over log(dt) through three runs, each of half the dt of the one before."""
    true = oscillation(oscillator(), DURATION / TIMES * np.arange(TIMES + 1))
    counts = [COARSEST[scheme.order] * f for f in (1, 2, 4)]
    runs = [simulate(system, scheme, DURATION / n, DURATION).positions[:: n // TIMES, 1, 0] for n in counts]
    return float(np.polyfit(-np.log(counts), np.log([np.abs(run - true).max() for run in runs]), 1)[0])


@pytest.mark.rotating(5)
@pytest.mark.parametrize("scheme", WHOLE_STATE, ids=label)
def test_every_scheme_tends_to_the_closed_form_with_its_order(scheme: Scheme) -> None:
    """Error = C dt^p (1 + O(dt w)): with dt w from 0.05 down (w = 100/s) the slope is within 0.05 of p."""
    assert measured_order(scheme, oscillator()) == pytest.approx(scheme.order, abs=0.05)


@pytest.mark.parametrize("changed", [{"stiffness": 200.2}, {"damping": 0.051}, {"gravity": 9.82}])
def test_the_orders_fail_on_another_oscillator(changed: dict[str, float]) -> None:
    """Shown to fail: with a parameter off by a thousandth or two the error no longer goes down with dt."""
    (parameter, value), *_ = changed.items()
    assert measured_order(find("rk4"), oscillator().with_parameter(parameter, value)) < 1


def test_the_true_motion_is_the_closed_form() -> None:
    """To 1e-11 of its size, where DOP853 works to 1e-12."""
    system = oscillator()
    true = exact(system, 1e-2, 50)
    assert np.abs(true.positions[:, 1, 0] - oscillation(system, true.times)).max() < 1e-11 * system.size


def test_energy_is_that_of_the_oscillator() -> None:
    """M v^2 / 2 + k s^2 / 2 + m g y, by hand; without damping the true motion keeps it, to 1e-11 of its parts."""
    system = find_scene("oscillator").system({"stretch": 0.02, "velocity": 0.5})
    states = exact(system, 1e-2, 50).states()
    for state in states:
        (y,), (v,) = state.positions[1], state.velocities[1]
        by_hand = 0.02 * v**2 / 2 + 200 * (-y - 0.125) ** 2 / 2 + 0.02 * 9.81 * y
        assert energy(system, state) == pytest.approx(by_hand, abs=1e-16)
    energies = np.array([energy(system, state) for state in states])
    assert np.ptp(energies) < 1e-11 * 0.02 * 9.81 * 0.125


def test_it_hangs_where_springs_carry_what_is_below() -> None:
    """Spring j of a chain is longer by (n - j) m g / k than at rest; along a line it is found as any mesh's is."""
    system = find_scene("chain").system({"masses": 6})
    stretch = -np.diff(equilibrium(system).positions[:, 0]) - 0.125
    assert stretch == pytest.approx(np.arange(6, 0, -1) * 0.02 * 9.81 / 200, rel=1e-12)


def test_masses_that_pass_one_another_have_their_spring_turned() -> None:
    """The direction from one to the other changes sign: pushed through its anchor, a mass hangs from below no more.

    Thrown fast enough it goes through and rests, by drag, where the spring stands on the anchor: at L0 - m g / k.
    """
    system = find_scene("oscillator").system({"velocity": 20.0, "drag": 0.5})
    moved = simulate(system, find("rk4"), 1e-4, 1.0).positions[:, 1, 0]
    assert moved[0] < 0 < moved[-1]
    assert moved[-1] == pytest.approx(0.125 - 0.02 * 9.81 / 200, rel=1e-6)


# --- The same in the plane ---


def meshes() -> list[MassSpringSystem]:
    """A damped chain in motion, and meshes in which springs go past masses."""
    chain = find_scene("chain").system({"masses": 6, "damping": 0.05, "drag": 0.02})
    velocities = np.random.default_rng(0).normal(size=chain.positions.shape)
    velocities[0] = 0.0
    return [replace(chain, velocities=velocities), random_mesh(3, 7, 1), random_mesh(4, 8, 1, anchors=2)]


@pytest.mark.rotating(5)
@pytest.mark.parametrize("system", meshes(), ids=["chain", "mesh", "two anchors"])
@pytest.mark.parametrize("stepper", [s for s in catalogued().values() if s.kind != "pendulum"], ids=label)
def test_the_same_motion_in_the_plane_is_the_same(stepper: SchemeStepper, system: MassSpringSystem) -> None:
    """To the bit; where systems of equations are solved, whose number is another, to 1e-14 of the size.

    In the plane nothing moves to the side, however springs are pushed together: zero times a number stays zero.
    """
    line, plane = (stepper.run(s, 1e-3, 200).trajectory for s in (system, system_in_plane(system)))
    assert line is not None
    assert plane is not None
    assert (plane.positions[..., 0] == 0).all()
    apart = np.abs(line.positions - on_line(plane.positions)).max()
    assert apart <= (1e-14 * system.size if stepper.scheme.needs == "springs" else 0.0)


@pytest.mark.parametrize("name", listings())
def test_the_lectures_listings_take_a_string_along_a_line(name: str) -> None:
    """As straight down in the plane, to the bit; gravity that changes on the fly too, in either form."""
    changes = [Change(0.05, "gravity", 1.62), Change(0.1, "gravity", [3.0]), Change(0.15, "mass", 0.03)]
    outcome = listings()[name].run(find_scene("chain").system({}), 1e-3, 200, changes)
    hung = find_scene("string").system({"angle": 90.0})
    changes[1] = Change(0.1, "gravity", [0.0, 3.0])
    plane = listings()[name].run(hung, 1e-3, 200, changes)
    assert outcome.trajectory is not None
    assert plane.trajectory is not None
    assert np.array_equal(outcome.trajectory.positions, on_line(plane.trajectory.positions))


def test_rods_along_a_line_are_refused_with_the_reason() -> None:
    """They have nothing that could move."""
    outcome = catalogued()["pendulum_rk4"].run(find_scene("chain").system({}), 1e-3, 10)
    assert outcome.ending == "unsupported"
    assert outcome.reason == "along a line rods leave nothing that could move, expected a string in 2D"


# --- Embedding ---


@pytest.mark.parametrize(("line", "plane"), [("oscillator", "spring"), ("chain", "string")])
def test_scenes_along_a_line_are_those_of_the_plane(line: str, plane: str) -> None:
    """With the same parameters, hung straight down; and back."""
    settings = {"mass": "0.03", "stiffness": "150", "damping": "0.1", "drag": "0.05", "gravity": "1.62"}
    straight = {"angle": "90"} if plane == "string" else {}
    system = find_scene(line).system(settings)
    hung = find_scene(plane).system({**settings, **straight})
    assert system_on_line(hung).to_dict() == system.to_dict()
    assert system_in_plane(system).to_dict() == hung.to_dict()


def test_all_of_a_system_is_put_into_the_plane() -> None:
    """Positions, velocities and gravity upwards, a floor across; what is not along a line is left as it is."""
    floor = Plane((-9.0,), (1.0,))
    made = replace(random_mesh(1, 5, 1), obstacles=(floor,))
    plane = system_in_plane(made)
    for name in ("positions", "velocities", "gravity"):
        assert np.array_equal(getattr(plane, name), in_plane(getattr(made, name)))
        assert np.array_equal(on_line(getattr(plane, name)), getattr(made, name))
        assert not np.shares_memory(on_line(getattr(plane, name)), getattr(plane, name))
    assert plane.obstacles == (Plane((0.0, -9.0), (0.0, 1.0)),)
    flat = random_mesh(1, 5, 2)
    assert system_in_plane(flat) is flat
    assert in_plane(flat.positions) is flat.positions
    for there in (Plane((0.0, -9.0), (0.0, 1.0)), Circle((0.0, 1.0), 0.5)):
        assert obstacle_in_plane(there) is there


HUNG = system_in_plane(replace(find_scene("chain").system({"masses": 2}), pulls=np.array([[0.0], [0.5], [0.0]])))


@pytest.mark.parametrize("name", ["positions", "velocities", "pulls"])
def test_what_leaves_the_vertical_line_in_any_way_is_of_the_plane(name: str) -> None:
    """The last mass beside it, thrown or pulled to a side; gravity to a side; an obstacle."""
    assert is_vertical(HUNG)
    assert is_vertical(replace(HUNG, positions=HUNG.positions + np.array([0.3, 0.0])))
    assert not is_vertical(replace(HUNG, **{name: getattr(HUNG, name) + np.array([[0, 0], [0, 0], [0.1, 0]])}))
    assert not is_vertical(replace(HUNG, gravity=np.array([0.1, -9.81])))
    assert not is_vertical(replace(HUNG, obstacles=(Plane((0.0, -9.0), (0.0, 1.0)),)))


def test_a_pull_along_the_line_is_one_upwards() -> None:
    """Other parameters have the same names there."""
    names = ["pull.3.x", "pull.3.z", "stiffness", "mass.x"]
    assert [parameter_in_plane(name) for name in names] == ["pull.3.y", "pull.3.z", "stiffness", "mass.x"]


@pytest.mark.parametrize("value", [3.0, [3.0], (-2.0,)])
def test_gravity_set_along_a_line_is_the_same_in_the_plane(value: float | list[float]) -> None:
    """One number is downwards, a list of one is along the axis; other parameters are as they are."""
    system = find_scene("chain").system({})
    there = system_in_plane(system).with_parameter("gravity", value_in_plane("gravity", value))
    assert np.array_equal(on_line(there.gravity), system.with_parameter("gravity", value).gravity)
    assert value_in_plane("mass", value) is value


def test_changing_a_system_along_a_line_leaves_its_gravity() -> None:
    """Shown to fail where a vector of one number is taken for a number downwards: whatever copies would turn it."""
    system = find_scene("chain").system({})
    for other in (system.renumbered(range(10, -1, -1)), system.with_springs_reversed(), replace(system, drag=0.1)):
        assert other.gravity.tolist() == [-9.81]
    assert MassSpringSystem(**system.to_dict()).gravity.tolist() == [-9.81]
