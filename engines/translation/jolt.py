"""Jolt: edges of a soft body, run by its package for Node; and its distance constraint, as calls."""

from __future__ import annotations

from engines.translation.box2d import as_frequency, of_frequency
from engines.translation.program import run_by_node, written_in_javascript
from engines.translation.solvers import of_compliance
from engines.translation.translation import Settings, Stepping, Translation
from reference.system import MassSpringSystem


def soft_body(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A soft body with a vertex for each mass, by the package jolt-physics; in C++ the calls have the same names."""
    return (
        "// node FILE.mjs, where npm has installed jolt-physics; in C++ the names are the same\n"
        "import initJolt from 'jolt-physics';\n\n"
        + written_in_javascript(system, stepping.dt, steps, settings)
        + f"""
const Jolt = await initJolt();
const filter = new Jolt.ObjectLayerPairFilterTable(1); // one layer, which collides with nothing
const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
broad.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
const worldSettings = new Jolt.JoltSettings();
worldSettings.mObjectLayerPairFilter = filter;
worldSettings.mBroadPhaseLayerInterface = broad;
worldSettings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, filter, 1);
const world = new Jolt.JoltInterface(worldSettings);
world.GetPhysicsSystem().SetGravity(new Jolt.Vec3(...gravity));

const shared = new Jolt.SoftBodySharedSettings();
positions.forEach((position, i) => {{
  const vertex = new Jolt.SoftBodySharedSettingsVertex();
  vertex.mPosition = new Jolt.Float3(...position);
  vertex.mInvMass = masses[i] === null ? 0 : 1 / masses[i];
  shared.mVertices.push_back(vertex);
}});
springs.forEach(([a, b], j) => {{
  const edge = new Jolt.SoftBodySharedSettingsEdge(a, b, compliance[j]);
  edge.mRestLength = rest_lengths[j];
  shared.mEdgeConstraints.push_back(edge);
}});
shared.Optimize(); // puts the edges in its own order; without it the first step crashes

const creation = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1), 0);
creation.mNumIterations = {stepping.substeps or 5}; // sub-steps of one sweep each
creation.mLinearDamping = 0; // 0.1/s by default
creation.mAllowSleeping = false;
creation.mUpdatePosition = false; // positions stay those of the world
const bodies = world.GetPhysicsSystem().GetBodyInterface();
const body = bodies.CreateSoftBody(creation);
bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);

function elongation() {{
  const [p, q] = springs[0].map((i) => motion.GetVertex(i).mPosition);
  return Math.hypot(q.GetX() - p.GetX(), q.GetY() - p.GetY(), q.GetZ() - p.GetZ()) - rest_lengths[0];
}}

const elongations = [elongation()];
for (let i = 0; i < steps; i++) {{
  world.Step(dt, 1);
  elongations.push(elongation());
}}
console.log(JSON.stringify(elongations));
"""
    )


def constraint(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """The calls, in C++: a distance constraint with soft limits."""
    typed, rest = settings[0], float(system.rest_lengths[0])
    return (
        "// C++; one for each spring\n"
        "DistanceConstraintSettings spring;\n"
        f"spring.mMinDistance = spring.mMaxDistance = {rest!r}f;\n"
        "spring.mLimitsSpringSettings = SpringSettings(ESpringMode::FrequencyAndDamping, "
        f"{typed['hertz']!r}f, {typed['damping_ratio']!r}f);\n"
    )


TRANSLATIONS = (
    Translation(
        "jolt",
        "Jolt: edges of a soft body",
        {"compliance": None},
        lambda spring, stepping: {"compliance": 1 / spring.stiffness},
        of_compliance,
        scheme=lambda s: f"xpbd_gauss_seidel(substeps={s.substeps or 5})",
        snippet=soft_body,
        package="jolt-physics",
        run=run_by_node,
        substeps=True,
        note="edges have no damping of their own; in single precision more sub-steps make velocities coarser",
    ),
    Translation(
        "jolt_constraint",
        "Jolt: distance constraint with soft limits",
        {"hertz": None, "damping_ratio": 0.0},
        as_frequency,
        of_frequency,
        scheme=lambda s: f"soft_constraints_warm(sweeps={s.iterations or 10})",
        snippet=constraint,
        iterations=True,
    ),
)
