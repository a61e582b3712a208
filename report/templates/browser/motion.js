// The equations of motion as a scheme of whole states sees them (reference/forces.py), and the same of small moves about a
// rest (reference/theory/linear_motion.py).

// A system's numbers as arrays that a scheme reads, in its memory. Args: size: as `sizeOf` has it of the start [m].
function systemOf(memory, size) {
  const {F, I, at} = memory, {n, s, d} = at, numbers = (name, ...shape) => new Nd(shape, F.subarray(at[name], at[name] + shape.reduce((all, one) => all * one, 1)));
  return {
    memory, size, dimension: d, masses: numbers("masses", n), stiffness: numbers("stiffness", s), damping: numbers("damping", s), rest_lengths: numbers("rest_lengths", s),
    springs: new Nd([s, 2], I.subarray(at.springs, at.springs + 2 * s)), fixed: new Nd([n], I.subarray(at.fixed, at.fixed + n), true),
    nonlinear: at.nonlinear || null, angular: memory.angular || null, positions: {shape: [n, d]},
    get drag() { return F[at.drag]; },
  };
}

class SpringMotion {
  constructor(system) {
    const {n, d, s} = system.memory.at;
    Object.assign(this, {system, none: {...system.memory.at, damping: system.memory.at.none}, shape: [n, d], s});
  }

  // Positions and velocities in the memory's rooms, for loops to read; how their begins are called.
  lay(state) {
    const {F, at} = this.system.memory, [x, v] = [at.room, at.room + at.n * at.d];
    F.set(state.positions.data, x); F.set(state.velocities.data, v);
    return [x, v];
  }

  acceleration(state, {damping = true} = {}) {
    const {memory} = this.system, {F, I, at} = memory, [x, v] = this.lay(state), {out} = at;
    const forces = at.nonlinear ? accelerations_of_any : accelerations_of_all, slowed = damping ? at : this.none;
    forces(F, I, slowed, x, v, at.springs, at.rest_lengths, at.stiffness, slowed.damping, at.masses, F[at.drag], at.gravity, at.fixed, at.first, at.spring, at.sign, at.forces, out);
    const made = new Nd(this.shape, F.slice(out, out + at.n * at.d));
    if (memory.angular) bend(memory, state.positions.data, made.data);
    return made;
  }

  acceleration_of(i, state) {
    return nd.at(this.acceleration(state), i).copy();
  }

  slope(state) { return new Slope(1, state.velocities, this.acceleration(state)); }

  placed(state) { return state; }

  jacobians(state) {
    const {memory, angular} = this.system, {F, I, at} = memory, {n, s, d} = at, [x, v] = this.lay(state);
    const [position, velocity] = [0, 1].map(() => new Float64Array(s * d * d)), blocks = spring_blocks[at.nonlinear ? "any" : "linear"][d];
    for (let j = 0; j < s; j++) {
      const a = d * I[at.springs + 2 * j], b = d * I[at.springs + 2 * j + 1];
      blocks(F, x + a, x + b, v + a, v + b, F[at.rest_lengths + j], F[at.stiffness + j], F[at.damping + j], F[at.hardening + j], F[at.largest_force + j], F[at.tension_only + j], F[at.compression_only + j], position, velocity, d * d * j);
    }
    const made = new Blocks(new Nd([s, d, d], position), nd.zeros([n])), angles = angular ? bendingDerivatives(angular, d, state.positions.data) : made.angles;
    return [new Blocks(made.springs, made.masses, angles), new Blocks(new Nd([s, d, d], velocity), nd.full([n], F[at.drag]), angles === made.angles ? angles : nd.zeros(angles.shape))];
  }
}

// Small moves about a rest; states are perturbations of it.
class LinearMotion {
  constructor(motion, rest) {
    const {system} = motion, {at} = system.memory;
    const still = new State(0, new Nd([at.n, at.d], Float64Array.from(rest)), nd.zeros([at.n, at.d]));
    Object.assign(this, {system, still, blocks: motion.jacobians(still)});
  }

  acceleration(state, {damping = true} = {}) {
    const {system, blocks: [byPosition, byVelocity]} = this, d = system.dimension, made = nd.zeros(state.positions.shape);
    const pull = (blocks, q) => {
      const {data} = blocks.springs, {angular} = system;
      for (let i = 0; i < system.masses.data.length; i++) for (let e = d * i; e < d * (i + 1); e++) made.data[e] -= blocks.masses.data[i] * q[e];
      for (let j = 0; j < system.springs.shape[0]; j++) {
        const [a, b] = [system.springs.data[2 * j], system.springs.data[2 * j + 1]];
        for (let axis = 0; axis < d; axis++) {
          let force = 0;
          for (let other = 0; other < d; other++) force += data[d * d * j + d * axis + other] * (q[d * b + other] - q[d * a + other]);
          made.data[d * a + axis] += force; made.data[d * b + axis] -= force;
        }
      }
      if (angular && blocks.angles.data.length > 1) addBending(angular, blocks.angles.data, d, q, (i, axis, force) => { made.data[d * i + axis] += force; });
    };
    pull(byPosition, state.positions.data);
    pull(damping ? byVelocity : Blocks.of_masses(system, system.drag), state.velocities.data);
    for (let e = 0; e < made.data.length; e++) { const i = Math.floor(e / d); made.data[e] = system.fixed.data[i] ? 0 : made.data[e] / system.masses.data[i]; }
    return made;
  }

  acceleration_of(i, state) { return nd.at(this.acceleration(state), i).copy(); }

  slope(state) { return new Slope(1, state.velocities, this.acceleration(state)); }

  placed() { return this.still; }

  jacobians() { return this.blocks; }
}

// One mass on a spring with a damper and a drag, of mass 1: what a mode is to a scheme.
function modeMotion(w2, damping, drag) {
  const one = {n: 2, s: 1, d: 1, positions: [0, 1], velocities: 0, springs: [0, 1], masses: 1, rest_lengths: 1, stiffness: w2, damping, drag, gravity: [0], fixed: [0]};
  return new LinearMotion(new SpringMotion(systemOf(memoryOf(one), 1)), [0, 1]);
}

// How far springs are stretched, and the damping they have so.
function stretchesOf({memory: {F, I, at}}, positions) {
  const {s, d, springs, rest_lengths} = at, x = positions.data;
  return new Nd([s], Float64Array.from({length: s}, (_, j) => {
    let squares = 0;
    for (let axis = 0; axis < d; axis++) squares += (x[d * I[springs + 2 * j + 1] + axis] - x[d * I[springs + 2 * j] + axis]) ** 2;
    return Math.sqrt(squares) - F[rest_lengths + j];
  }));
}
const dampingOf = ({memory}, stretch) => new Nd(stretch.shape, stretch.data.map((value, j) => ofSpring(damping_at, memory, j, value)));

// How the damping of springs with these coefficients answers velocities.
function dampingBlocks(system, state, coefficients) {
  const {memory: {I, at}} = system, {n, s, d} = at, made = new Float64Array(s * d * d), x = state.positions.data;
  for (let j = 0; j < s; j++) {
    damping_block[d](x, d * I[at.springs + 2 * j], d * I[at.springs + 2 * j + 1], system.rest_lengths.data[j], coefficients.data[j], made, d * d * j);
  }
  return new Blocks(new Nd([s, d, d], made), nd.zeros([n]));
}

// Blocks as a matrix over the free masses' coordinates: what it makes of a vector, and its diagonal.
function assembled(system, blocks) {
  const {dimension: d, fixed, springs, masses} = system, n = masses.data.length, free = nd.invert(fixed);
  const matrix = matrixOf({...system, masses: nd.zeros_like(masses), angular: null}, blocks);
  const whole = v => { const all = nd.zeros([n, d]); nd.put(all, v.reshape(-1, d), free); return all.data; };
  return {
    times: v => nd.negative(nd.at(new Nd([n, d], multiplied(matrix, whole(v), new Float64Array(n * d))), free).ravel()),
    diagonal: () => {
      const sum = nd.zeros([n, d]);
      springs.data.forEach((i, end) => { for (let axis = 0; axis < d; axis++) sum.data[d * i + axis] -= blocks.springs.data[d * d * (end >> 1) + (d + 1) * axis]; });
      return nd.at(sum, free).ravel();
    },
  };
}

// The forces of springs that bend on all masses, with masses at x.
function bendingForces({F, at: {n, d}, angular}, x) {
  const forces = new Float64Array(n * d), one = new Float64Array(3 * d);
  for (let k = 0; k < angular.stiffness.length; k++) {
    if (!(angular.stiffness[k] > 0)) continue;
    const three = angular.masses.subarray(3 * k, 3 * k + 3);
    bending_forces[d](F, placesOf(three, d, x), angular.stiffness[k], angular.rest_angles[k], one, 0);
    three.forEach((i, which) => { for (let axis = 0; axis < d; axis++) forces[d * i + axis] += one[d * which + axis]; });
  }
  return forces;
}

// What they add to the accelerations of masses.
function bend(memory, x, out) {
  const {F, I, at} = memory, {n, d} = at, forces = bendingForces(memory, x);
  for (let i = 0; i < n; i++) for (let e = d * i; e < d * (i + 1); e++) out[e] += I[at.fixed + i] ? 0 : forces[e] / F[at.masses + i];
}

// Their energy [J].
function bentEnergy({F, at: {d}, angular}, x) {
  const one = new Float64Array(1);
  let sum = 0;
  for (let k = 0; angular && k < angular.stiffness.length; k++) {
    bending_energy[d](F, placesOf(angular.masses.subarray(3 * k, 3 * k + 3), d, x), angular.stiffness[k], angular.rest_angles[k], one, 0);
    sum += one[0];
  }
  return sum;
}

const placesOf = (masses, d, x) => Array.from(masses).flatMap(i => Array.from(x.subarray(d * i, d * (i + 1))));

function bendingDerivatives(angular, d, x) {
  const count = angular.stiffness.length, made = new Float64Array(count * 4 * d * d);
  for (let k = 0; k < count; k++) {
    if (angular.stiffness[k] > 0) bending_derivatives[d](null, placesOf(angular.masses.subarray(3 * k, 3 * k + 3), d, x), angular.stiffness[k], angular.rest_angles[k], made, 4 * d * d * k);
  }
  return new Nd([count, 2 * d, 2 * d], made);
}

// One step of a world by a scheme of whole states, in its memory. Returns false where its equations have no solution.
function stepWhole(world, step, dt) {
  const {F, at} = world.memory, size = at.n * at.d, read = begin => new Nd([at.n, at.d], F.slice(begin, begin + size));
  world.motion = world.motion || new SpringMotion(systemOf(world.memory, world.size));
  let end;
  try {
    end = step(world.motion, new State(0, read(at.x), read(at.v), world.remembered || []), dt);
  } catch (error) {
    if (error instanceof SolverError) return false;
    throw error;
  }
  F.set(end.positions.data, at.x); F.set(end.velocities.data, at.v);
  world.remembered = end.memory;
  return true;
}
