"""Ways to break Pymunk."""

from __future__ import annotations

from typing import Any

from engines.crash_cases import crash_case, numbers


def _pymunk_spring() -> tuple[Any, Any]:
    """A space with a mass on a spring, and the mass."""
    import pymunk

    space = pymunk.Space()
    space.gravity = (0, -9.81)
    anchor, body = pymunk.Body(body_type=pymunk.Body.STATIC), pymunk.Body(0.02, float("inf"))
    body.position = (0.125, 0)
    space.add(anchor, body, pymunk.DampedSpring(anchor, body, (0, 0), (0, 0), 0.125, 200, 0.1))
    return space, body


def _pymunk_steps(space: Any, body: Any) -> str:
    for _ in range(10):
        space.step(1e-3)
    return numbers(body.position)


@crash_case("pymunk")
def no_iterations() -> str:
    """Let the solver go round no times."""
    space, body = _pymunk_spring()
    space.iterations = 0
    return _pymunk_steps(space, body)


@crash_case("pymunk")
def a_negative_mass() -> str:
    """Give a mass that is already in a space -1 kg."""
    space, body = _pymunk_spring()
    body.mass = -1
    return _pymunk_steps(space, body)


@crash_case("pymunk")
def a_mass_of_zero() -> str:
    """Give a mass that is already in a space 0 kg."""
    space, body = _pymunk_spring()
    body.mass = 0
    return _pymunk_steps(space, body)


@crash_case("pymunk")
def a_body_without_mass() -> str:
    """Add a body that was never given a mass."""
    import pymunk

    space, body = _pymunk_spring()
    space.add(pymunk.Body())
    return _pymunk_steps(space, body)


@crash_case("pymunk")
def a_body_twice() -> str:
    """Add a body to the space it is in."""
    space, body = _pymunk_spring()
    space.add(body)
    return _pymunk_steps(space, body)


@crash_case("pymunk")
def a_huge_velocity() -> str:
    """Let a mass move at 1e300 m/s."""
    space, body = _pymunk_spring()
    body.velocity = (1e300, 1e300)
    return _pymunk_steps(space, body)
