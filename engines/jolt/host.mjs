// node host.mjs FILE_OF_JOLT: a soft body of Jolt, told what to do line by line of JSON on the standard input, and answering each line with one.
//
//   {"make": {...}}    the system, see `make`; answers true
//   {"write": {...}}   numbers of masses and edges that change; answers true
//   {"steps": n}       answers true
//   {"state": true}    answers [[x, y, z, ...], [vx, vy, vz, ...]] of all masses
import { createInterface } from 'node:readline';

const LAYER = 0;
const Jolt = await (await import(process.argv[2])).default();
let world, physics, vertices, edges, dt, made;

function begin() {
  const settings = new Jolt.JoltSettings();
  const filter = new Jolt.ObjectLayerPairFilterTable(1); // the only layer collides with nothing
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  broad.MapObjectToBroadPhaseLayer(LAYER, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = filter;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, filter, 1);
  if (world) Jolt.destroy(world);
  world = new Jolt.JoltInterface(settings);
  physics = world.GetPhysicsSystem();
}

// {dt, substeps, positions, velocities, springs, ...what `write` takes}
function make(given) {
  begin();
  dt = given.dt;
  const shared = new Jolt.SoftBodySharedSettings();
  const vertex = new Jolt.SoftBodySharedSettingsVertex();
  for (let i = 0; i < given.positions.length; i++) {
    vertex.mPosition = new Jolt.Float3(...given.positions[i]);
    vertex.mVelocity = new Jolt.Float3(...given.velocities[i]);
    vertex.mInvMass = given.inverse[i];
    shared.mVertices.push_back(vertex);
  }
  // Optimize() puts the edges into another order: until then each has its number for a compliance
  given.springs.forEach(([a, b], j) => shared.mEdgeConstraints.push_back(new Jolt.SoftBodySharedSettingsEdge(a, b, j)));
  shared.CalculateEdgeLengths();
  shared.Optimize();
  edges = given.springs.map(() => undefined);
  for (let j = 0; j < shared.mEdgeConstraints.size(); j++) {
    const edge = shared.mEdgeConstraints.at(j);
    edges[edge.mCompliance] = edge;
  }
  const creation = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1), LAYER);
  creation.mNumIterations = given.substeps;
  creation.mLinearDamping = 0; // 0.1/s by default
  creation.mMaxLinearVelocity = 1e15; // 500 m/s by default
  creation.mUpdatePosition = false; // positions stay those of the world
  creation.mAllowSleeping = false;
  const body = physics.GetBodyInterface().CreateSoftBody(creation);
  physics.GetBodyInterface().AddBody(body.GetID(), Jolt.EActivation_Activate);
  const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
  vertices = given.positions.map((_, i) => motion.GetVertex(i));
  write(given);
}

// {inverse: 1/m of the masses, compliance and rest of the springs, gravity}
function write(given) {
  vertices.forEach((vertex, i) => { vertex.mInvMass = given.inverse[i]; });
  edges.forEach((edge, j) => {
    edge.mCompliance = given.compliance[j];
    edge.mRestLength = given.rest[j];
  });
  physics.SetGravity(new Jolt.Vec3(...given.gravity));
}

function flat(read) {
  return vertices.flatMap((vertex) => { const q = read(vertex); return [q.GetX(), q.GetY(), q.GetZ()]; });
}

// JSON has no infinity and no NaN
const plain = (_, value) => (typeof value === 'number' && !Number.isFinite(value) ? String(value) : value);

for await (const line of createInterface({ input: process.stdin })) {
  const told = JSON.parse(line);
  let answer = true;
  if (told.make) make(told.make);
  else if (told.write) write(told.write);
  else if (told.steps) for (let i = 0; i < told.steps; i++) world.Step(dt, 1);
  else answer = [flat((vertex) => vertex.mPosition), flat((vertex) => vertex.mVelocity)];
  process.stdout.write(JSON.stringify(answer, plain) + '\n');
}
