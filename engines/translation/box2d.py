"""Box2D 2.3 and 3: springs are told by a frequency and a damping ratio of the two bodies they join."""

from __future__ import annotations

from engines.translation.program import ELONGATION, written
from engines.translation.translation import Settings, Spring, Stepping, Translation
from reference.system import MassSpringSystem


def as_frequency(spring: Spring, stepping: Stepping) -> Settings:
    """F = (k/m)^(1/2) / (2 pi) and c / (2 m w), m the effective mass of both bodies."""
    return {"hertz": spring.hertz, "damping_ratio": spring.damping_ratio}


def of_frequency(typed: Settings, masses: Spring, stepping: Stepping) -> Spring:
    """K = m (2 pi f)^2, c = 2 z m 2 pi f: another spring for other masses."""
    return masses.with_oscillation(typed["hertz"], typed["damping_ratio"])


def version_3(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A world by Box2D's own C interface, as the package box2d-python has it."""
    return (
        "from box2d._box2d import ffi, lib\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
world_def = lib.b2DefaultWorldDef()
world_def.gravity.x, world_def.gravity.y = gravity[:2]
world_def.enableSleep = False
world = lib.b2CreateWorld(ffi.new("b2WorldDef *", world_def))
bodies = []
for place, mass in zip(positions, masses):
    body_def = lib.b2DefaultBodyDef()
    body_def.type = lib.b2_staticBody if mass is None else lib.b2_dynamicBody
    body_def.position.x, body_def.position.y = place[:2]
    body_def.fixedRotation = True
    bodies.append(lib.b2CreateBody(world, ffi.new("b2BodyDef *", body_def)))
    if mass is not None:
        lib.b2Body_SetMassData(bodies[-1], ffi.new("b2MassData *", {"mass": mass})[0])
for (a, b), rest, f, z in zip(springs, rest_lengths, hertz, damping_ratio):
    joint_def = lib.b2DefaultDistanceJointDef()
    joint_def.bodyIdA, joint_def.bodyIdB, joint_def.length = bodies[a], bodies[b], rest
    joint_def.enableSpring, joint_def.hertz, joint_def.dampingRatio = True, f, z
    lib.b2CreateDistanceJoint(world, ffi.new("b2DistanceJointDef *", joint_def))


def place(i):
    at = lib.b2Body_GetPosition(bodies[i])
    return at.x, at.y

"""
        + ELONGATION
        + f"""

elongations = [elongation(place)]
for _ in range(steps):
    lib.b2World_Step(world, dt, {stepping.substeps or 4})
    elongations.append(elongation(place))
lib.b2DestroyWorld(world)
"""
    )


def version_2(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A world with a body for each mass."""
    return (
        "import Box2D\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
world = Box2D.b2World(gravity=tuple(gravity[:2]), doSleep=False)
bodies = []
for place, mass in zip(positions, masses):
    if mass is None:
        bodies.append(world.CreateStaticBody(position=tuple(place[:2])))
    else:
        bodies.append(world.CreateDynamicBody(position=tuple(place[:2]), fixedRotation=True))
        bodies[-1].massData = Box2D.b2MassData(mass=mass, center=(0, 0), I=0)
for (a, b), rest, f, z in zip(springs, rest_lengths, hertz, damping_ratio):
    world.CreateDistanceJoint(
        bodyA=bodies[a], bodyB=bodies[b], localAnchorA=(0, 0), localAnchorB=(0, 0), length=rest, frequencyHz=f,
        dampingRatio=z, collideConnected=False,
    )
"""
        + ELONGATION
        + f"""

elongations = [elongation(lambda i: bodies[i].position)]
for _ in range(steps):
    world.Step(dt, {stepping.iterations or 8}, 3)
    elongations.append(elongation(lambda i: bodies[i].position))
"""
    )


FIELDS = {"hertz": None, "damping_ratio": 0.0}

TRANSLATIONS = (
    Translation(
        "box2d",
        "Box2D 3: distance joint with a spring",
        FIELDS,
        as_frequency,
        of_frequency,
        scheme=lambda stepping: f"soft_constraints_relaxed(substeps={stepping.substeps or 4})",
        snippet=version_3,
        package="box2d-python",
        substeps=True,
        dimensions=frozenset({2}),
        note="the sweep after the move acts on springs too: twice the numerical damping of backward Euler; rest "
        "lengths are 0.005 m at least",
    ),
    Translation(
        "box2d_2.3",
        "Box2D 2.3: distance joint with a frequency",
        FIELDS,
        as_frequency,
        of_frequency,
        scheme=lambda stepping: f"soft_constraints_warm(sweeps={stepping.iterations or 8})",
        snippet=version_2,
        package="box2d",
        iterations=True,
        dimensions=frozenset({2}),
        note="no body moves more than 2 m in a step",
    ),
)
