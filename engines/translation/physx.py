"""PhysX 5, as SAPIEN has it in Python: distance joints whose equal limits are soft."""

from __future__ import annotations

from engines.translation.program import ELONGATION, written
from engines.translation.translation import Settings, Stepping, Translation, newtons
from reference.system import MassSpringSystem


def physx(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A scene with a body for each mass, by the package sapien; in C++ the calls have the same names."""
    return (
        "import sapien\nimport sapien.physx as physx\n\n"
        + written(system, stepping.dt, steps, settings)
        + f"""
config = physx.PhysxSceneConfig()
config.gravity, config.enable_tgs = gravity, False  # PxSolverType::ePGS
physx.set_scene_config(config)
world = physx.PhysxCpuSystem()
world.timestep = dt
scene = sapien.Scene([world])
bodies, entities = [], []
for place, mass in zip(positions, masses):
    body = physx.PhysxRigidStaticComponent() if mass is None else physx.PhysxRigidDynamicComponent()
    entity = sapien.Entity()
    entity.add_component(body)
    entity.set_pose(sapien.Pose(place))
    entity.add_to_scene(scene)
    if mass is not None:
        body.mass, body.inertia, body.linear_damping, body.sleep_threshold = mass, [1, 1, 1], 0.0, 0.0
        body.solver_position_iterations = {stepping.iterations or 10}
        body.set_locked_motion_axes([False] * 3 + [True] * 3)
    bodies.append(body)
    entities.append(entity)
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    a, b = (a, b) if masses[b] is not None else (b, a)  # a joint is of a body that moves
    joint = physx.PhysxDistanceJointComponent(bodies[b])
    joint.parent = bodies[a]
    joint.pose_in_parent = joint.pose_in_child = sapien.Pose()
    joint.set_limit(rest, rest, k, c)
    entities[b].add_component(joint)  # without this it does nothing


def place(i):
    return entities[i].pose.p.astype(float)

"""
        + ELONGATION
        + """

elongations = [elongation(place)]
for _ in range(steps):
    world.step()
    elongations.append(elongation(place))
"""
    )


TRANSLATIONS = (
    Translation(
        "physx",
        "PhysX 5: distance joint, PGS",
        {"stiffness": None, "damping": 0.0},
        scheme=lambda s: f"soft_constraints_cold(order=newest_first, substeps=1, sweeps={s.iterations or 10})",
        snippet=physx,
        package="sapien",
        iterations=True,
        **newtons(),  # type: ignore[arg-type]
    ),
)
