"""Every kind of obstacle: what the rule promises, how it ends a step, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from reference.axes import Axes
from reference.distance_constraints import RopeMotion
from reference.errors import InputError, SolverError
from reference.lecture.slide_17 import CircleAsPrinted
from reference.obstacles import KINDS, Box, Circle, Cylinder, Obstacle, Plane, Sphere, obstacle_of, project_out
from reference.pendulum import PendulumMotion
from reference.scenes import find
from reference.schemes import catalogue
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.exact import exact
from tests.reference.systems import property_test, seeds

OBSTACLES: list[Obstacle] = [
    Circle((0.3, -0.2), 0.5),
    Sphere((0.3, -0.2, 0.1), 0.5),
    Cylinder((0.3, -0.2, 0.1), (1.0, 2.0, -2.0), 0.5),
    Plane((0.3,), (-2.0,)),
    Plane((0.3, -0.2), (0.6, 0.8)),
    Plane((0.3, -0.2, 0.1), (1.0, 2.0, -2.0)),
    Box((0.3, -0.2), (0.4, 0.5)),
    Box((0.3, -0.2, 0.1), (0.4, 0.5, 0.6)),
]

Rule = Callable[[Array, Array], tuple[Array, Array]]

BARRIER = find("barrier").system({})


def label(made: Obstacle) -> str:
    """Kind and dimension."""
    return f"{made.kind} {made.dimension}D"


def check_rule(made: Obstacle, rule: Rule, seed: int) -> None:
    """Nobody inside; along the surface v is kept, across it what leads outwards; no speed gained; twice is as once.

    To rounding: positions are of 1 m and speeds of 5 m/s, which a normal off by 1e-15 leaves 1e-14 of.
    """
    rng = np.random.default_rng(seed)
    x = np.array([0.3, -0.2, 0.1])[: made.dimension] + rng.uniform(-0.7, 0.7, (40, made.dimension))
    v = rng.uniform(-5, 5, x.shape)
    gap, normal = made.signed_distances(x)
    pushed, kept = rule(x, v)
    inside = gap[:, 0] < 0
    assert made.signed_distances(pushed)[0].min() >= -1e-14
    assert pushed[~inside].tolist() == x[~inside].tolist()
    assert kept[~inside].tolist() == v[~inside].tolist()
    before, across = (v * normal).sum(axis=1), (kept * normal).sum(axis=1)
    assert across[inside] == pytest.approx(np.maximum(before, 0.0)[inside], abs=1e-13)
    along = [q - (q * normal).sum(axis=1, keepdims=True) * normal for q in (v, kept)]
    assert along[1][inside] == pytest.approx(along[0][inside], abs=1e-13)
    # straight out: no other point of the surface is nearer
    assert np.linalg.norm(pushed - x, axis=1)[inside] == pytest.approx(-gap[inside, 0], abs=1e-14)
    assert ((kept**2).sum(axis=1) <= (v**2).sum(axis=1) * (1 + 1e-14)).all()
    again = rule(pushed, kept)
    assert again[0] == pytest.approx(pushed, abs=1e-14)
    assert again[1] == pytest.approx(kept, abs=1e-13)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("made", OBSTACLES, ids=label)
@property_test
@given(seed=seeds)
def test_the_rule_keeps_its_promises(made: Obstacle, seed: int) -> None:
    """Wherever masses are, however they move."""
    check_rule(made, made.projected, seed)


def reflecting(made: Obstacle) -> Rule:
    """Throws back."""

    def rule(x: Array, v: Array) -> tuple[Array, Array]:
        pushed, kept = made.projected(x, v)
        return pushed, 2 * kept - v

    return rule


def halfway(made: Obstacle) -> Rule:
    """Moves half of the way out."""

    def rule(x: Array, v: Array) -> tuple[Array, Array]:
        pushed, kept = made.projected(x, v)
        return (x + pushed) / 2, kept

    return rule


def stopping(made: Obstacle) -> Rule:
    """Takes all the velocity."""

    def rule(x: Array, v: Array) -> tuple[Array, Array]:
        pushed, kept = made.projected(x, v)
        return pushed, np.where((pushed != x).any(axis=1, keepdims=True), 0 * v, kept)

    return rule


def pulling(made: Obstacle) -> Rule:
    """Takes what leads outwards of the velocity too."""

    def rule(x: Array, v: Array) -> tuple[Array, Array]:
        gap, normal = made.signed_distances(x)
        return made.projected(x, v)[0], np.where(gap < 0, v - (v * normal).sum(axis=1, keepdims=True) * normal, v)

    return rule


@pytest.mark.parametrize("wrong", [reflecting, halfway, stopping, pulling])
@pytest.mark.parametrize("made", OBSTACLES, ids=label)
def test_the_promises_fail_on_wrong_rules(made: Obstacle, wrong: Callable[[Obstacle], Rule]) -> None:
    """And on the circle's as it is printed."""
    with pytest.raises(AssertionError):
        check_rule(made, wrong(made), 1)
    if isinstance(made, Circle):
        with pytest.raises(AssertionError):
            check_rule(made, CircleAsPrinted(made.centre, made.radius).projected, 1)


@pytest.mark.parametrize("made", OBSTACLES, ids=label)
def test_a_mass_at_a_centre_comes_out_somewhere(made: Obstacle) -> None:
    """There is no way straight out: one is chosen."""
    middle = np.array([[0.3, -0.2, 0.1][: made.dimension]])
    x, v = made.projected(middle, np.ones_like(middle))
    assert abs(float(made.signed_distances(x)[0][0, 0])) <= 1e-15
    assert np.isfinite(v).all()


@pytest.mark.parametrize("made", OBSTACLES, ids=label)
def test_an_obstacle_in_plain_values_makes_the_same(made: Obstacle) -> None:
    """Through JSON and back, to the bit."""
    assert obstacle_of(**json.loads(json.dumps(made.to_dict()))) == made
    assert KINDS[made.kind] is type(made)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("made", [*BARRIER.obstacles, Plane((0.0, -0.6), (0.1, 1.0))], ids=label)
@pytest.mark.parametrize("scheme", ["euler", "heun", "rk4", "kick_drift", "implicit_midpoint"])
def test_no_mass_is_ever_inside(scheme: str, made: Obstacle) -> None:
    """Of the scene's string, after any step of any scheme; the fixed one may be."""
    system = replace(BARRIER, obstacles=(made, Circle((0.0, 0.0), 0.05)))
    motion = simulate(system, catalogue.find(scheme), 1e-3, 0.6)
    gaps = made.signed_distances(motion.positions[:, 1:])[0]
    assert gaps.min() >= -1e-14
    assert gaps.min() <= 1e-14, "it was never met"
    assert (motion.positions[:, 0] == 0).all(), "a fixed mass has moved"


def check_rests(made: Plane, scheme: str) -> None:
    """A mass let go on a floor stays: never higher, at most as deep as rounding, at most as fast as two steps' fall.

    Of 1 m and 10 m/s^2: after a step by gravity alone it is inside by up to g dt^2, and moves inwards.
    """
    away, dt = np.array([[0.0, 4.0], [0.0, 0.0]]), 1e-3
    system = MassSpringSystem(
        positions=away,
        springs=np.array([[0, 1]]),
        masses=np.array(1.0),
        rest_lengths=np.array(4.0),
        stiffness=np.array(1e-12),
        gravity=np.array([0.0, -10.0]),
        fixed=np.array([True, False]),
        obstacles=(made,),
    )
    motion = simulate(system, catalogue.find(scheme), dt, 0.5)
    assert np.abs(motion.positions[:, 1]).max() <= 1e-14
    assert np.linalg.norm(motion.velocities[:, 1], axis=1).max() <= 2 * 10.0 * dt * (1 + 1e-9)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("scheme", ["euler", "heun", "kick_drift", "drift_kick", "rk4", "implicit_midpoint"])
def test_a_mass_at_rest_on_a_floor_stays_there(scheme: str) -> None:
    """No push lifts it off."""
    check_rests(Plane((0.0, 0.0), (0.0, 1.0)), scheme)


class Soft(Plane):
    """Takes velocity and leaves masses where they are, which sink."""

    def project(self, place: Axes, velocity: Axes, free: Any) -> tuple[Axes, Axes]:
        """See Obstacle."""
        return place, super().project(place, velocity, free)[1]


class Indifferent(Plane):
    """Pushes out and leaves the velocity as it is, which grows ever on."""

    def contact_response(self, velocity: Axes, normal: Axes) -> Axes:
        """See Obstacle."""
        return velocity


@pytest.mark.parametrize("wrong", [Soft, Indifferent])
def test_the_check_of_rest_fails_on_wrong_floors(wrong: type[Plane]) -> None:
    """Under kick-drift."""
    with pytest.raises(AssertionError):
        check_rests(wrong((0.0, 0.0), (0.0, 1.0)), "kick_drift")


def test_obstacles_are_met_in_their_order() -> None:
    """In a corner the last one has its way."""
    floor, wall = Plane((0.0, 0.0), (0.6, 0.8)), Plane((0.0, 0.0), (1.0, 0.0))
    x, v = np.array([[-0.1, -0.1]]), np.zeros((1, 2))
    held = np.array([[False]])
    for order in ((floor, wall), (wall, floor)):
        pushed, _ = project_out(order, held, x, v)
        assert abs(float(order[-1].signed_distances(pushed)[0][0, 0])) <= 1e-16
    assert project_out((floor, wall), ~held, x, v)[0].tolist() == x.tolist()


def test_what_changes_a_system_keeps_its_obstacles() -> None:
    """Renumbering, reversing, swapping, another parameter; and they are in its dictionary."""
    for other in (
        BARRIER.renumbered(np.arange(11)[::-1]),
        BARRIER.with_springs_reversed(),
        BARRIER.with_ends_swapped(),
        BARRIER.with_parameter("drag", 0.1),
        MassSpringSystem(**json.loads(json.dumps(BARRIER.to_dict()))),
    ):
        assert other.obstacles == BARRIER.obstacles


def test_what_knows_no_obstacles_says_so() -> None:
    """True motion, equilibrium, rods, and the listings before slide 17's."""
    with pytest.raises(SolverError, match="no true motion"):
        exact(BARRIER, 1e-3, 10)
    with pytest.raises(SolverError, match="no equilibrium: with obstacles"):
        equilibrium(BARRIER)
    for motion in (PendulumMotion, RopeMotion):
        with pytest.raises(InputError, match="expected no obstacles"):
            motion(BARRIER)
    for name in ("pendulum_heun", "rope_kick_drift"):
        outcome = catalogued()[name].run(BARRIER, 1e-3, 10)
        assert (outcome.ending, "obstacles" in outcome.reason) == ("unsupported", True)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Circle((0.0, 0.0), -1.0), "radius = -1.0: expected a finite number > 0 [m]"),
        (lambda: Circle((0.0, 0.0), True), "radius = True: expected a finite number > 0 [m]"),
        (lambda: Circle((0.0, 0.0), float("nan")), "radius = nan: expected a finite number > 0 [m]"),
        (lambda: Circle((0.0, 0.0), 10**400), f"radius = {10**400}: expected a finite number > 0 [m]"),
        (lambda: Circle((0.0, float("nan")), 1.0), "centre = (0.0, nan): expected 2 finite numbers [m]"),
        (lambda: Plane((True, 0.0), (0.0, 1.0)), "point = (True, 0.0): expected 1 or 2 or 3 finite numbers [m]"),
        (lambda: Circle((0.0,), 1.0), "centre = (0.0,): expected 2 finite numbers [m]"),
        (lambda: Sphere((0.0, 0.0), 1.0), "centre = (0.0, 0.0): expected 3 finite numbers [m]"),
        (lambda: Plane((), (0.0, 1.0)), "point = (): expected 1 or 2 or 3 finite numbers [m]"),
        (lambda: Plane((0.0,), (0.0, 1.0)), "normal = (0.0, 1.0): expected 1 finite number [m]"),
        (lambda: Plane((0.0,), (0.0,)), "normal = (0.0,): expected a direction, not zero"),
        (lambda: Box((0.0,), (1.0,)), "centre = (0.0,): expected 2 or 3 finite numbers [m]"),
        (lambda: Plane((0.0, 0.0), (0.0, 0.0)), "normal = (0.0, 0.0): expected a direction, not zero"),
        (lambda: Plane((0.0, 0.0), (0.0, 0.0, 1.0)), "normal = (0.0, 0.0, 1.0): expected 2 finite numbers [m]"),
        (lambda: Box((0.0, 0.0), (1.0, 0.0)), "half_sizes = (1.0, 0.0): expected numbers > 0 [m]"),
        (lambda: Box((0.0, 0.0), (1.0,)), "half_sizes = (1.0,): expected 2 finite numbers [m]"),
        (lambda: obstacle_of("circel"), "unknown kind 'circel': did you mean 'circle'?"),
        (lambda: obstacle_of("circle", center=1), "unknown number of a circle 'center': did you mean 'centre'?"),
        (lambda: obstacle_of("circle", radius=1.0), "centre is missing: a circle has centre, radius"),
        (lambda: replace(BARRIER, obstacles=3), "obstacles = 3: expected a list of obstacles"),
        (
            lambda: replace(BARRIER, obstacles=(3,)),
            "obstacles[0] = 3: expected one of circle, sphere, cylinder, plane, box",
        ),
        (
            lambda: replace(BARRIER, obstacles=(Sphere((0, 0, 9), 1),)),
            "obstacles[0] is a sphere in 3D: expected one in 2D",
        ),
        (
            lambda: replace(BARRIER, obstacles=(Circle((0.0, 0.0), 0.25),)),
            "positions[1] = [0.125, 0.0]: expected a start outside the circle obstacles[0], it is 0.125 m inside",
        ),
        (
            lambda: replace(BARRIER, obstacles=(Circle((0.0, -9.0), 0.25), Circle((0.0, 0.0), 0.45))),
            "positions[1] = [0.125, 0.0]: expected a start outside the circle obstacles[1], it is 0.325 m inside",
        ),
    ],
)
def test_bad_obstacles_are_refused_in_one_line(make: Callable[[], Any], message: str) -> None:
    """Naming field, value, and what was expected."""
    with pytest.raises(InputError) as caught:
        make()
    assert str(caught.value) == message


def test_directions_become_unit_vectors() -> None:
    """However long they are."""
    for scale in (1e-300, 1.0, 1e300):
        assert Plane((0.0, 0.0), (3 * scale, 4 * scale)).normal == pytest.approx((0.6, 0.8), abs=1e-15)
    assert Plane((0.0, 0.0), (0.6, 0.8)).normal == (0.6, 0.8)


def nearest_of(points: Array, place: Array) -> float:
    """How far a place is from the nearest of many points [m]."""
    return float(np.linalg.norm(points - place, axis=1).min())


def check_gap(made: Box, gap: Callable[[Array], Array]) -> None:
    """The gap is the distance to the nearest point of the surface, negative inside; found by looking at them all.

    The surface is looked at on a grid of h = 1/40 of its size: a nearest point is missed by h/sqrt(2) at most, and at a
    distance of s by (h^2/4)/s, or h/sqrt(2) if that is less.
    """
    grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 81)] * made.dimension), axis=-1).reshape(-1, made.dimension)
    surface = np.array(made.centre) + grid[np.abs(grid).max(axis=1) == 1] * made.half_sizes
    h = max(made.half_sizes) / 40
    places = np.array(made.centre) + np.random.default_rng(3).uniform(-1, 1, (60, made.dimension))
    inside = (np.abs(places - made.centre) < made.half_sizes).all(axis=1)
    assert inside.any()
    for place, within, found in zip(places, inside, gap(places), strict=True):
        seen = nearest_of(surface, place)
        assert (found < 0) == within
        assert seen - min(h, h**2 / 2 / seen) <= abs(found) <= seen + 1e-15


@pytest.mark.parametrize("made", [made for made in OBSTACLES if isinstance(made, Box)], ids=label)
def test_a_box_is_as_far_as_its_nearest_point(made: Box) -> None:
    """Faces, edges and corners; not if corners count as faces do, outside, nor if the sign is lost."""

    def beyond(x: Array) -> Array:
        return np.asarray((np.abs(x - np.array(made.centre)) - made.half_sizes).max(axis=1))

    check_gap(made, lambda x: made.signed_distances(x)[0][:, 0])
    for wrong in (beyond, lambda x: np.abs(made.signed_distances(x)[0][:, 0])):
        with pytest.raises(AssertionError):
            check_gap(made, wrong)


@pytest.mark.parametrize(
    ("half_sizes", "depth", "normal"),
    [((1.0, 1.0, 1.0), 1.0, [1, 0, 0]), ((2.0, 1.0, 1.0), 1.0, [0, 1, 0]), ((2.0, 2.0, 0.5), 0.5, [0, 0, 1])],
)
def test_from_the_middle_of_a_box_the_way_out_is_along_one_axis(
    half_sizes: tuple[float, ...], depth: float, normal: list[int]
) -> None:
    """The first of those along which it is as near to a face as along any other."""
    gap, outwards = Box((1.0, 2.0, 3.0), half_sizes).signed_distances(np.array([[1.0, 2.0, 3.0]]))
    assert gap.tolist() == [[-depth]]
    assert outwards.tolist() == [normal]


def test_a_mass_beside_the_edge_of_a_box_is_pushed_to_the_nearer_face() -> None:
    """On top where it is nearer to the top, sideways where it is nearer to the side; its velocity along stays."""
    box = Box((0.0, 0.0), (1.0, 1.0))
    x, v = box.projected(np.array([[0.9, 0.95], [0.95, 0.9], [1.1, 1.1]]), np.full((3, 2), -1.0))
    assert x == pytest.approx(np.array([[0.9, 1.0], [1.0, 0.9], [1.1, 1.1]]), abs=1e-15)
    assert v.tolist() == [[-1.0, 0.0], [0.0, -1.0], [-1.0, -1.0]]
