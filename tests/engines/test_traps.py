"""What engines of games and robots do unless told otherwise: each trap set off, in the engine's environment."""

from __future__ import annotations

import subprocess

import pytest

from engines.jolt.soft_body import PACKAGE
from engines.process.available import available_version, how_to_install, interpreter
from engines.process.isolation import isolated
from engines.translation.program import run
from reference.outcome import Outcome

BOX2D_2 = """
import Box2D
world = Box2D.b2World(gravity=(0, 0), doSleep=False)
body = world.CreateDynamicBody(linearVelocity=(1000, 0))
body.massData = Box2D.b2MassData(mass=1.0, center=(0, 0), I=0)
world.Step(1 / 60, 8, 3)
elongations = [body.linearVelocity.x, body.position.x]
"""

BOX2D_3 = """
from box2d._box2d import ffi, lib
world = lib.b2CreateWorld(ffi.new("b2WorldDef *", lib.b2DefaultWorldDef()))
def body(kind, x):
    made = lib.b2DefaultBodyDef()
    made.type, made.position.x, made.linearVelocity.x = kind, x, 1000.0
    made.fixedRotation = True
    made = lib.b2CreateBody(world, ffi.new("b2BodyDef *", made))
    lib.b2Body_SetMassData(made, ffi.new("b2MassData *", {"mass": 1.0})[0])
    return made
first, second = body(lib.b2_dynamicBody, 0.0), body(lib.b2_dynamicBody, 1.0)
joint_def = lib.b2DefaultDistanceJointDef()
joint_def.bodyIdA, joint_def.bodyIdB, joint_def.length, joint_def.enableSpring = first, second, 0.001, True
joint_def.hertz = 1.0
joint = lib.b2CreateDistanceJoint(world, ffi.new("b2DistanceJointDef *", joint_def))
lib.b2World_SetGravity(world, ffi.new("b2Vec2 *", [0.0, 0.0])[0])
lib.b2World_Step(world, 1 / 60, 4)
elongations = [lib.b2Body_GetLinearVelocity(first).x, lib.b2DistanceJoint_GetLength(joint)]
"""

RAPIER = """
import rapier3d
world = rapier3d.PhysicsWorld(gravity=(0, 0, 0))
body = world.add_body(rapier3d.RigidBody.dynamic().additional_mass(1.0).linvel((1000, 0, 0)).build())
world.step()
elongations = [tuple(world.rigid_bodies.get(body).linvel)[0]]
"""

NEWTON = """
import newton
import numpy as np
def run(radius, steps, clear=True, speed=0.0):
    builder = newton.ModelBuilder(up_axis=newton.Axis.Y, gravity=(0, 0, 0))
    for i in range(5):
        options = {} if radius is None else {"radius": radius}
        builder.add_particle(pos=(0.125 * i, 0, 0), vel=(0, speed * (i == 4), 0), mass=0.02 if i else 0.0, **options)
    for i in range(4):
        builder.add_spring(i, i + 1, 200.0, 0.0, 0.0)
    builder.spring_rest_length = [0.125] * 4
    model = builder.finalize(device="cpu")
    solver = newton.solvers.SolverSemiImplicit(model)
    now, then = model.state(), model.state()
    for _ in range(steps):
        if clear:
            now.clear_forces()
        solver.step(now, then, None, None, 1e-3)
        now, then = then, now
    return now.particle_q.numpy().astype(float), now.particle_qd.numpy().astype(float)
apart = np.abs(run(None, 100)[0] - run(0.06, 100)[0]).max()
right = run(1e-3, 20, speed=1.0)[0]
piled = np.abs(run(1e-3, 20, clear=False, speed=1.0)[0] - right).max()
elongations = [apart, piled, np.abs(run(1e-3, 1, speed=2e5)[1]).max()]
"""

PHYSX = """
import warnings
warnings.simplefilter("ignore")
import sapien
import sapien.physx as physx
def falls(added):
    config = physx.PhysxSceneConfig()
    config.gravity = [0, -9.81, 0]
    physx.set_scene_config(config)
    world = physx.PhysxCpuSystem()
    world.timestep = 1e-2
    scene, first, second = sapien.Scene([world]), sapien.Entity(), sapien.Entity()
    fixed, body = physx.PhysxRigidStaticComponent(), physx.PhysxRigidDynamicComponent()
    body.mass, body.inertia, body.linear_damping = 1.0, [1, 1, 1], 0.0
    first.add_component(fixed)
    second.add_component(body)
    second.set_pose(sapien.Pose([0, -1, 0]))
    first.add_to_scene(scene)
    second.add_to_scene(scene)
    joint = physx.PhysxDistanceJointComponent(body)
    joint.parent = fixed
    joint.pose_in_parent = joint.pose_in_child = sapien.Pose()
    joint.set_limit(1.0, 1.0, 1e4, 0.0)
    if added:
        second.add_component(joint)
    for _ in range(100):
        world.step()
    return -1 - float(second.pose.p[1])
elongations = [falls(False), falls(True)]
"""

#: What each line of JavaScript prints: the speed after a step with Jolt's own linear damping, a speed that is cut.
JOLT = """
const Jolt = await (await import(process.argv[1])).default();
function stepped(speed, optimize) {
  const settings = new Jolt.JoltSettings(), filter = new Jolt.ObjectLayerPairFilterTable(1);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  broad.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = filter;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, filter, 1);
  const world = new Jolt.JoltInterface(settings), physics = world.GetPhysicsSystem();
  physics.SetGravity(new Jolt.Vec3(0, 0, 0));
  const shared = new Jolt.SoftBodySharedSettings(), vertex = new Jolt.SoftBodySharedSettingsVertex();
  vertex.mVelocity = new Jolt.Float3(speed, 0, 0);
  vertex.mInvMass = 1;
  for (const x of [0, 1]) { vertex.mPosition = new Jolt.Float3(x, 0, 0); shared.mVertices.push_back(vertex); }
  shared.mEdgeConstraints.push_back(new Jolt.SoftBodySharedSettingsEdge(0, 1, 1));
  shared.CalculateEdgeLengths();
  if (optimize) shared.Optimize();
  const where = [new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1)];
  const body = physics.GetBodyInterface().CreateSoftBody(new Jolt.SoftBodyCreationSettings(shared, ...where, 0));
  physics.GetBodyInterface().AddBody(body.GetID(), Jolt.EActivation_Activate);
  world.Step(0.1, 1);
  return Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties).GetVertex(0).mVelocity.GetX();
}
console.log(stepped(1, true));
console.log(stepped(1000, true));
console.log(stepped(1, false));
"""


def seen(package: str, program: str) -> list[float]:
    """What a program leaves, in the environment of its package."""
    if available_version(package) is None:
        pytest.skip(how_to_install(package))
    found = isolated(run, program, python=interpreter(package), time_limit=240.0)
    assert not isinstance(found, Outcome), f"{found.ending}: {found.reason}"
    return [float(value) for value in found]


def test_box2d_2_moves_nothing_more_than_2_m_in_a_step() -> None:
    """1000 m/s at 1/60 s become 120 m/s."""
    speed, place = seen("box2d", BOX2D_2)
    assert speed == pytest.approx(120.0, rel=1e-5)
    assert place == pytest.approx(2.0, rel=1e-5)


def test_box2d_3_cuts_speeds_and_lengthens_short_springs() -> None:
    """1000 m/s become 400, a rest length of 1 mm becomes 5 mm."""
    speed, length = seen("box2d-python", BOX2D_3)
    assert speed == pytest.approx(400.0, rel=1e-3)
    assert length == pytest.approx(0.005, rel=1e-5)


def test_rapier_cuts_speeds() -> None:
    """1000 m/s become 400."""
    assert seen("rapier3d", RAPIER) == pytest.approx([400.0], rel=1e-4)


def test_newtons_particles_collide_forces_pile_up_and_speeds_are_cut() -> None:
    """A string at rest flies apart with the default radius of 0.1 m; with a radius of 0.06 m it stays as it is.

    Without `clear_forces` springs pull with all that they have pulled before; 2e5 m/s become 1e5.
    """
    apart, piled, fastest = seen("newton", NEWTON)
    assert apart > 0.1
    assert piled > 1e-7
    assert fastest == pytest.approx(1e5, rel=1e-3)


def test_a_physx_joint_does_nothing_until_it_is_added_to_the_second_bodys_entity() -> None:
    """Without, a mass falls for a second: g t^2/2 + g t h/2 = 4.954 m; with, it stays within 2 m g/k of its place."""
    alone, added = seen("sapien", PHYSX)
    assert alone == pytest.approx(9.81 / 2 * (1 + 1e-2), rel=1e-3)
    assert 0 < added < 2 * 9.81 / 1e4


def test_jolt_damps_cuts_speeds_and_dies_without_optimize() -> None:
    """In a step of 0.1 s, of five sub-steps, 1 m/s loses a hundredth: (1 - 0.1 h)^5; of 1000 m/s 500 are left."""
    python = interpreter("jolt-physics")
    if python is None:
        pytest.skip(how_to_install("jolt-physics"))
    command = ["node", "--input-type=module", "--eval", JOLT, str(python.parents[1] / PACKAGE)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    damped, cut = map(float, done.stdout.split())
    assert damped == pytest.approx((1 - 0.1 * 0.02) ** 5, rel=1e-4)
    assert cut == pytest.approx(500.0, rel=1e-4)
    assert done.returncode != 0
    assert "memory access out of bounds" in done.stderr
