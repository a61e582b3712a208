"""Pymunk, MuJoCo, Exudyn and Bullet: engines whose springs are told in N/m and N s/m, and step in double precision."""

from __future__ import annotations

from dataclasses import replace

from engines.translation.program import ELONGATION, written
from engines.translation.translation import Settings, Spring, Stepping, Translation, newtons
from reference.errors import InputError, Unsupported
from reference.system import MassSpringSystem


def pymunk(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A space with a body for each mass."""
    return (
        "import pymunk\n\n"
        + written(system, stepping.dt, steps, settings)
        + f"""
space = pymunk.Space()
space.gravity, space.iterations = tuple(gravity[:2]), {stepping.iterations or 10}
bodies = []
for place, mass in zip(positions, masses):
    fixed = pymunk.Body(body_type=pymunk.Body.STATIC)
    bodies.append(fixed if mass is None else pymunk.Body(mass, float("inf")))
    bodies[-1].position = tuple(place[:2])
space.add(*bodies)
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    space.add(pymunk.DampedSpring(bodies[a], bodies[b], (0, 0), (0, 0), rest, k, c))
"""
        + ELONGATION
        + """

elongations = [elongation(lambda i: bodies[i].position)]
for _ in range(steps):
    space.step(dt)
    elongations.append(elongation(lambda i: bodies[i].position))
"""
    )


def mujoco(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """Bodies on slide joints, joined by tendons."""
    return (
        "import mujoco\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
spec = mujoco.MjSpec()
spec.option.timestep, spec.option.gravity = dt, gravity
spec.option.integrator = mujoco.mjtIntegrator.mjINT_EULER
for i, (place, mass) in enumerate(zip(positions, masses)):
    body = spec.worldbody.add_body(name=f"mass {i}", pos=place)
    body.add_site(name=f"end {i}")
    if mass is not None:
        body.mass, body.inertia, body.explicitinertial = mass, [1, 1, 1], True
        for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1]):
            body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    tendon = spec.add_tendon(stiffness=k, damping=c, springlength=[rest, rest])
    tendon.wrap_site(f"end {a}")
    tendon.wrap_site(f"end {b}")
model = spec.compile()
data = mujoco.MjData(model)
"""
        + ELONGATION
        + """

mujoco.mj_forward(model, data)
elongations = [elongation(lambda i: data.site(f"end {i}").xpos)]
for _ in range(steps):
    mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    elongations.append(elongation(lambda i: data.site(f"end {i}").xpos))
"""
    )


#: Of a constraint: how much of its own motion it is given, whatever its violation.
IMPEDANCE = 0.95


def solref(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """One spring, as a soft equality constraint of a tendon."""
    _one_spring("mujoco_solref", system)
    return (
        "import mujoco\n\n"
        + written(system, stepping.dt, steps, settings)
        + f"""
spec = mujoco.MjSpec()
spec.option.timestep, spec.option.gravity = dt, gravity
spec.option.integrator = mujoco.mjtIntegrator.mjINT_EULER
(a, b), rest = springs[0], rest_lengths[0]
start = [positions[a], [positions[a][0] + rest, 0.0, 0.0]]
for i, mass in enumerate(masses):
    body = spec.worldbody.add_body(pos=start[i])
    body.add_site(name=f"end {{i}}")
    if mass is not None:
        body.mass, body.inertia, body.explicitinertial = mass, [1, 1, 1], True
        body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0])
tendon = spec.add_tendon(name="spring")
tendon.wrap_site("end 0")
tendon.wrap_site("end 1")
equality = spec.add_equality(type=mujoco.mjtEq.mjEQ_TENDON, name1="spring")
equality.solref = [solref_0[0], solref_1[0]]
equality.solimp = [{IMPEDANCE}, {IMPEDANCE}, 0.001, 0.5, 2]
model = spec.compile()
data = mujoco.MjData(model)
data.qpos[-1] = positions[b][0] - positions[a][0] - rest
"""
        + ELONGATION
        + """

mujoco.mj_forward(model, data)
elongations = [elongation(lambda i: data.site(f"end {i}").xpos)]
for _ in range(steps):
    mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    elongations.append(elongation(lambda i: data.site(f"end {i}").xpos))
"""
    )


def solref_settings(spring: Spring, stepping: Stepping) -> Settings:
    """The direct form, -stiffness and -damping: by mass, and by the impedance that MuJoCo divides them by."""
    return {
        "solref_0": -spring.stiffness / spring.effective_mass,
        "solref_1": -spring.damping / spring.effective_mass,
    }


def solref_meaning(typed: Settings, masses: Spring, stepping: Stepping) -> Spring:
    """Of (time constant, damping ratio), or of (-stiffness, -damping), at a constant impedance.

    A violation r is answered by r'' = -d (b r' + k r), with the impedance d: b = 2/(d T) and k = 1/(d T^2 z^2) for
    solref (T, z); b = t/d and k = s/d for solref (-s, -t). (MuJoCo's manual, "Solver parameters", where d does not
    depend on r.) MuJoCo takes 2 dt for a shorter T.
    """
    first, second = typed["solref_0"], typed["solref_1"]
    mass = masses.effective_mass
    if first <= 0 and second <= 0:
        return replace(masses, stiffness=-first * mass, damping=-second * mass)
    if first <= 0 or second <= 0:
        raise InputError(
            f"solref = {first:g},{second:g}: expected a time constant and a damping ratio > 0, or minus a stiffness "
            "and minus a damping, both <= 0; of other numbers MuJoCo takes its own"
        )
    constant = max(first, 2 * stepping.dt)
    return replace(masses, stiffness=mass / (constant * second) ** 2, damping=2 * mass / constant)


def exudyn(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """Mass points on nodes, joined by spring-dampers, under the explicit Runge-Kutta solver."""
    return (
        "import exudyn\nfrom exudyn import itemInterface as item\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
container = exudyn.SystemContainer()
mbs = container.AddSystem()
exudyn.config.printToConsole = False
nodes, ends = [], []
for place, mass in zip(positions, masses):
    if mass is None:
        nodes.append(mbs.AddNode(item.NodePointGround(referenceCoordinates=place)))
    else:
        nodes.append(mbs.AddNode(item.NodePoint(referenceCoordinates=place)))
        body = mbs.AddObject(item.MassPoint(nodeNumber=nodes[-1], physicsMass=mass))
        marker = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=body))
        mbs.AddLoad(item.LoadMassProportional(markerNumber=marker, loadVector=gravity))
    ends.append(mbs.AddMarker(item.MarkerNodePosition(nodeNumber=nodes[-1])))
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    ab = [ends[a], ends[b]]
    mbs.AddObject(item.SpringDamper(markerNumbers=ab, referenceLength=rest, stiffness=k, damping=c))
mbs.Assemble()
settings = exudyn.SimulationSettings()
settings.solution.file.write = False
settings.timeIntegration.verboseMode = 0
settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = dt, 1
solver = exudyn.MainSolverExplicit()
settings.timeIntegration.solverType = exudyn.DynamicSolverType.RK44
solver.InitializeSolver(mbs, settings)
solver.it.currentStepSize = dt


def place(i):
    return mbs.GetNodeOutput(nodes[i], exudyn.OutputVariableType.Position)

"""
        + ELONGATION
        + """

elongations = [elongation(place)]
for _ in range(steps):
    solver.DiscontinuousIteration(mbs, settings)
    elongations.append(elongation(place))
"""
    )


def bullet(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """One spring, as an edge of a triangle whose third corner is pinned far away, where its springs pull across."""
    _one_spring("bullet", system)
    if not system.fixed.any() and system.masses[0] != system.masses[1]:
        raise Unsupported("bullet has one mass for all nodes of a soft body: expected mass-b = mass")
    return (
        "import os\nimport tempfile\n\nimport pybullet\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
(a, b), rest = springs[0], rest_lengths[0]
mass = next(m for m in masses if m is not None)
client = pybullet.connect(pybullet.DIRECT)
pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD)
pybullet.setPhysicsEngineParameter(fixedTimeStep=dt, enableFileCaching=0)
pybullet.setGravity(0, 0, 0)
with tempfile.TemporaryDirectory() as folder:
    mesh = os.path.join(folder, "spring.obj")
    with open(mesh, "w") as file:
        file.write("v 0 0 0\\nv 1 0 0\\nv 0 0 67108864\\nf 1 2 3\\n")  # the third corner: 2^26 rest lengths away
    body = pybullet.loadSoftBody(
        mesh, scale=rest, mass=3 * mass, useMassSpring=1, useBendingSprings=0, springBendingStiffness=0.0,
        springElasticStiffness=springElasticStiffness[0], springDampingStiffness=springDampingStiffness[0],
        springDampingAllDirections=0, useSelfCollision=0,
    )
pybullet.changeDynamics(body, -1, activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING)
for node in [i for i, m in enumerate(masses) if m is None] + [2]:
    pybullet.createSoftBodyAnchor(body, node, -1, -1)


def nodes():
    return pybullet.getMeshData(body, -1, flags=pybullet.MESH_DATA_SIMULATION_MESH)[1]


pybullet.stepSimulation()  # the rest lengths are those of this step
stretched = [list(place) for place in nodes()]
stretched[1][0] += positions[b][0] - positions[a][0] - rest
pybullet.resetMeshData(body, stretched)
"""
        + ELONGATION
        + """

elongations = [elongation(lambda i: nodes()[i])]
for _ in range(steps):
    pybullet.stepSimulation()
    elongations.append(elongation(lambda i: nodes()[i]))
pybullet.disconnect(client)
"""
    )


def contact_settings(spring: Spring, stepping: Stepping) -> Settings:
    """Error reduction and constraint force mixing: erp = h k/(h k + c), cfm = 1/(h k + c)."""
    resisted = stepping.dt * spring.stiffness + spring.damping
    return {"erp": stepping.dt * spring.stiffness / resisted, "cfm": 1 / resisted}


def contact_meaning(typed: Settings, masses: Spring, stepping: Stepping) -> Spring:
    """The reverse: k = erp/(h cfm), c = (1 - erp)/cfm."""
    if not (0 <= typed["erp"] <= 1 and typed["cfm"] > 0):
        raise Unsupported("expected 0 <= erp <= 1 and cfm > 0: without cfm the constraint is rigid, and has no k")
    return replace(
        masses, stiffness=typed["erp"] / (stepping.dt * typed["cfm"]), damping=(1 - typed["erp"]) / typed["cfm"]
    )


def contact(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """The calls: Bullet's Python has erp and cfm of contacts only, as stiffness and damping."""
    _one_spring("bullet_constraint", system)
    (typed,) = settings
    erp, cfm = typed["erp"], typed["cfm"]
    stiffness, damping = erp / (stepping.dt * cfm), (1 - erp) / cfm
    return (
        f"// C++, a constraint of axis i\nconstraint->setParam(BT_CONSTRAINT_STOP_ERP, {erp!r}, i);\n"
        f"constraint->setParam(BT_CONSTRAINT_STOP_CFM, {cfm!r}, i);\n"
        f"# Python, contacts of a body\npybullet.changeDynamics(body, -1, contactStiffness={stiffness!r}, "
        f"contactDamping={damping!r})\n"
    )


def _one_spring(name: str, system: MassSpringSystem) -> None:
    """Raise Unsupported for more than one spring."""
    if len(system.springs) != 1:
        raise Unsupported(f"{name} has a snippet for a single spring only")


TRANSLATIONS = (
    Translation(
        "pymunk",
        "Pymunk: DampedSpring",
        {"stiffness": None, "damping": 0.0},
        scheme=lambda stepping: f"drift_kick_sequential_damping(rounds={stepping.iterations or 10})",
        snippet=pymunk,
        package="pymunk",
        iterations=True,
        dimensions=frozenset({2}),
        note="a spring alone keeps exp(-dt c/m) of its elongation rate in a step",
        **newtons(),  # type: ignore[arg-type]
    ),
    Translation(
        "mujoco",
        "MuJoCo: spatial tendon, Euler",
        {"stiffness": None, "damping": 0.0},
        scheme=lambda stepping: "kick_drift",
        snippet=mujoco,
        package="mujoco",
        note="damping of tendons is explicit under Euler",
        **newtons(),  # type: ignore[arg-type]
    ),
    Translation(
        "mujoco_solref",
        "MuJoCo: soft equality constraint, Euler",
        {"solref_0": None, "solref_1": 1.0},
        solref_settings,
        solref_meaning,
        scheme=lambda stepping: "kick_drift",
        snippet=solref,
        package="mujoco",
        note=f"at the constant impedance {IMPEDANCE}; against a force that acts on the masses it is 1/(1 - impedance) "
        "times as stiff",
    ),
    Translation(
        "exudyn",
        "Exudyn: spring-damper, RK44",
        {"stiffness": None, "damping": 0.0},
        scheme=lambda stepping: "rk4",
        snippet=exudyn,
        package="exudyn",
        **newtons(),  # type: ignore[arg-type]
    ),
    Translation(
        "bullet",
        "Bullet: soft body of masses and springs",
        {"springElasticStiffness": None, "springDampingStiffness": 0.1},
        scheme=lambda stepping: "kick_drift_implicit_damping",
        snippet=bullet,
        package="pybullet",
        note="bending springs of 0.1 N/m are on unless springBendingStiffness=0.0; every node has the same mass",
        **newtons("springElasticStiffness", "springDampingStiffness"),  # type: ignore[arg-type]
    ),
    Translation(
        "bullet_constraint",
        "Bullet: constraint with ERP and CFM",
        {"erp": None, "cfm": None},
        contact_settings,
        contact_meaning,
        scheme=lambda stepping: "soft_constraints_cold(substeps=1, sweeps=10, sweeps_after=0)",
        snippet=contact,
        note="erp and cfm mean another spring at every dt",
    ),
)
