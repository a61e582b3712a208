// A soft body of Jolt, and what can be done with it. It runs where the package does: in Node (`host.mjs`), and in the lab's
// page in a browser.
const LAYER = 0;

/** Of a loaded package. One body at a time: to `make` another ends the one before. */
export function softBody(Jolt) {
  let world, physics, vertices, edges;

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

  // {substeps, positions, velocities, springs, ...what `write` takes}
  function make(given) {
    begin();
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

  // Vertex i somewhere else, at another velocity.
  function put(i, position, velocity) {
    for (const [name, value] of [['mPosition', position], ['mVelocity', velocity]]) {
      const vector = new Jolt.Vec3(...value);
      vertices[i][name] = vector;
      Jolt.destroy(vector);
    }
  }

  function flat(read) {
    return vertices.flatMap((vertex) => { const q = read(vertex); return [q.GetX(), q.GetY(), q.GetZ()]; });
  }

  // Positions and velocities, [x, y, z, x, y, z, ...] each.
  const state = () => [flat((vertex) => vertex.mPosition), flat((vertex) => vertex.mVelocity)];

  return { make, write, put, state, step: (dt) => world.Step(dt, 1) };
}
