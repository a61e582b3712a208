"""What Pymunk makes of contacts, by measurement: the facts that the adapter's settings rest on."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import find, version
from engines.process.isolation import isolated
from reference.obstacles import Box, Circle, Obstacle, Plane
from reference.scenes import find as find_scene

DT = 1e-3

pytestmark = pytest.mark.skipif(version(find("pymunk_springs")) is None, reason="pymunk is not installed")


def bounce(first: float, second: float) -> float:
    """The part of its speed that a body has after a shape has thrown it back, their elasticities being these."""
    import pymunk

    space = pymunk.Space()
    space.collision_slop = space.collision_bias = 0.0
    body = pymunk.Body(0.02, float("inf"))
    body.position, body.velocity = (0.0, 1.01), (0.0, -2.0)
    point, circle = pymunk.Circle(body, 0.0), pymunk.Circle(space.static_body, 1.0)
    point.elasticity, circle.elasticity = first, second
    space.add(body, point, circle)
    for _ in range(20):
        space.step(DT)
    return float(body.velocity.y / 2.0)


def overlap(slop: float | None) -> float:
    """How deep [m] a mass that rests on a circle of 1 m is in it after 2 s."""
    import pymunk

    space = pymunk.Space()
    space.gravity = (0.0, -9.81)
    if slop is not None:
        space.collision_slop, space.collision_bias = slop, 0.0
    body = pymunk.Body(0.02, float("inf"))
    body.position = (0.0, 1.01)
    space.add(body, pymunk.Circle(body, 0.0), pymunk.Circle(space.static_body, 1.0))
    for _ in range(2000):
        space.step(DT)
    return float(1.0 - body.position.y)


def test_restitution_is_the_product_of_elasticities() -> None:
    """So it is 0 unless both are set, which the adapter does not."""
    for first, second in ((0.0, 0.0), (1.0, 0.0), (0.8, 0.5), (1.0, 1.0)):
        assert isolated(bounce, first, second) == pytest.approx(first * second, abs=1e-12)


def test_masses_are_left_inside_unless_told() -> None:
    """By its default slop a mass stays as deep as it came, up to v dt; without slop it is out, but for g dt^2."""
    left, out = isolated(overlap, None), isolated(overlap, 0.0)
    assert isinstance(left, float)
    assert isinstance(out, float)
    assert 0.1 * np.sqrt(2 * 9.81 * 0.01) * DT < left < np.sqrt(2 * 9.81 * 0.01) * DT
    assert abs(out) <= 1.01 * 9.81 * DT**2 < left


def test_a_plane_reaches_beyond_every_mass_however_far_its_point_is() -> None:
    """The strip that stands for it goes on for LONG times the distance of the mass that is farthest from its point."""
    import pymunk

    from engines.pymunk.obstacles import LONG, _shape

    system = find_scene("string").system({"masses": 3})
    for point in ((0.0, -3.0), (200.0, -3.0)):
        strip = _shape(pymunk, pymunk.Space().static_body, Plane(point, (0.0, 1.0)), system)
        farthest = float(np.abs(system.positions - np.array(point)).max())
        assert (strip.b - strip.a).length / 2 >= LONG * farthest
        assert strip.radius >= LONG * farthest


@pytest.mark.parametrize(
    "obstacle",
    [
        Circle((0.5, -0.25), 0.3),
        Box((0.5, -0.25), (0.4, 0.2)),
        Plane((0.5, -0.25), (0.6, 0.8)),
        Plane((0.5, -0.25), (-0.8, -0.6)),
    ],
    ids=lambda obstacle: obstacle.kind,
)
def test_shapes_are_as_far_away_as_their_obstacles(obstacle: Obstacle) -> None:
    """At a hundred places about it, on either side: the signed distance, to the rounding of a plane's far away bar."""
    import pymunk

    from engines.pymunk.obstacles import _shape

    system = find_scene("string").system({"masses": 3})
    shape = _shape(pymunk, pymunk.Space().static_body, obstacle, system)
    shape.cache_bb()
    places = np.array([0.5, -0.25]) + np.random.default_rng(2).uniform(-1, 1, (100, 2))
    found = [shape.point_query(tuple(place)).distance for place in places.tolist()]
    assert found == pytest.approx(obstacle.signed_distances(places)[0].ravel(), abs=1e-9)
