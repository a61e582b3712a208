// A system's numbers in two memories, F of doubles and I of whole numbers; `at` says where each array begins.

// How many arrays of vectors the schemes may keep beside the state.
const ROOMS = 8;

// One number for all, or one for each: as the file has them, and as arrays.
const spread = (value, count) => Array.isArray(value) ? value : new Array(count).fill(value);

// The parameters, with the arrays they stand in and how many numbers each has.
const PARAMETERS = {
  mass: at => [at.masses, at.n], rest_length: at => [at.rest_lengths, at.s], stiffness: at => [at.stiffness, at.s],
  damping: at => [at.damping, at.s], drag: at => [at.drag, 1], gravity: at => [at.gravity, at.d],
};

// What a parameter may be on this page: no more than this, and not below zero but for gravity, which may be upwards.
const LARGEST = 1e12, mayBe = (name, value) => Number.isFinite(value) && Math.abs(value) <= LARGEST
  && (name === "gravity" || value > 0 || (value === 0 && name !== "mass"));

// What a dt may be [s].
const SHORTEST_DT = 1e-9, LONGEST_DT = 10;

// What springs may have besides stiffness and damping, and what it is where they have not.
const KINDS = {hardening: 0, largest_force: Infinity, tension_only: 0, compression_only: 0, breaking_force: Infinity, breaking_stretch: Infinity};

function memoryOf(system) {
  const {n, s, d} = system, at = {n, s, d, nonlinear: Boolean(system.nonlinear)};
  let doubles = 0, whole = 0;
  const room = (name, count) => { at[name] = doubles; doubles += count; };
  const list = (name, count) => { at[name] = whole; whole += count; };
  for (const name of ["x", "v", "weight", "out"]) room(name, n * d);
  for (const name of ["masses", "divisor"]) room(name, n);
  for (const name of ["rest_lengths", "stiffness", "damping", "none", ...Object.keys(KINDS)]) room(name, s);
  room("sign", 2 * s); room("forces", Math.max(n, s) * d); room("gravity", d); room("drag", 1); room("room", ROOMS * n * d);
  list("springs", 2 * s); list("first", n + 1); list("spring", 2 * s); list("fixed", n); list("broken", s);
  const F = new Float64Array(doubles), I = new Int32Array(whole), memory = {F, I, at, angular: angularOf(system)};
  F.set(spread(system.positions, n * d), at.x); F.set(spread(system.velocities, n * d), at.v);
  F.set(spread(system.masses, n), at.masses);
  for (const name of ["rest_lengths", "stiffness", "damping"]) F.set(spread(system[name], s), at[name]);
  for (const [name, none] of Object.entries(KINDS)) F.set(spread((system.nonlinear || {})[name] ?? none, s).map(value => value ?? none), at[name]);
  F.set(system.gravity, at.gravity); F[at.drag] = system.drag;
  I.set(system.springs, at.springs);
  for (const i of system.fixed) I[at.fixed + i] = 1;
  springsOfMasses(memory);
  derive(memory);
  return memory;
}

// What resists bending, or null: three masses of each, stiffness [N m/rad] and rest angle [rad].
const angularOf = ({angular}) => angular ? {masses: Int32Array.from(angular.masses), stiffness: Float64Array.from(angular.stiffness), rest_angles: Float64Array.from(angular.rest_angles)} : null;

// Which springs each mass feels, in the springs' order; the sign is + where it is the spring's first mass.
function springsOfMasses({F, I, at}) {
  const {n, s} = at, next = new Int32Array(n);
  for (let e = 0; e < 2 * s; e++) next[I[at.springs + e]]++;
  let sum = 0;
  for (let i = 0; i < n; i++) { I[at.first + i] = sum; sum += next[i]; next[i] = I[at.first + i]; }
  I[at.first + n] = sum;
  for (let e = 0; e < 2 * s; e++) {
    const entry = next[I[at.springs + e]]++;
    I[at.spring + entry] = e >> 1; F[at.sign + entry] = e % 2 ? -1 : 1;
  }
}

// What loops read in place of parameters: weights, and infinity to divide by where a mass is fixed.
function derive({F, I, at}) {
  for (let i = 0; i < at.n; i++) {
    F[at.divisor + i] = I[at.fixed + i] ? Infinity : F[at.masses + i];
    for (let axis = 0; axis < at.d; axis++) {
      F[at.weight + at.d * i + axis] = F[at.masses + i] * F[at.gravity + axis];
    }
  }
}

// One of PARAMETERS, one number for all or one for each; a single number of gravity is downwards.
function setParameter(memory, name, value) {
  const {F, at} = memory, [begin, count] = PARAMETERS[name](at);
  memory.most = null;
  if (name === "gravity" && !Array.isArray(value)) {
    F.fill(0, begin, begin + count);
    F[begin + Math.min(1, at.d - 1)] = -value;
  } else if (Array.isArray(value)) F.set(value, begin);
  else F.fill(value, begin, begin + count);
  if (name === "stiffness" || name === "damping") breakSprings(memory, []);
  derive(memory);
}

// Springs that are gone for good, and those that were before: no parameter brings one back.
function breakSprings({F, I, at, angular}, springs) {
  for (const j of springs) I[at.broken + j] = 1;
  for (let j = 0; j < at.s; j++) {
    if (!I[at.broken + j]) continue;
    F[at.stiffness + j] = F[at.damping + j] = 0;
    for (const [name, none] of Object.entries(KINDS)) F[at[name] + j] = none;
  }
  if (angular && springs.length) partArms({I, at, angular});
}

// What bends between springs has no stiffness once all that joined the masses of an arm are broken.
function partArms({I, at, angular}) {
  const left = new Set(), gone = new Set(), key = (i, j) => at.n * Math.min(i, j) + Math.max(i, j);
  for (let j = 0; j < at.s; j++) (I[at.broken + j] ? gone : left).add(key(I[at.springs + 2 * j], I[at.springs + 2 * j + 1]));
  const parted = (i, j) => gone.has(key(i, j)) && !left.has(key(i, j));
  angular.stiffness.forEach((_, k) => {
    const [a, b, c] = angular.masses.subarray(3 * k, 3 * k + 3);
    if (parted(a, b) || parted(b, c)) angular.stiffness[k] = 0;
  });
}

// The springs that break as they are: stretched too far, or pulling with too much force, their dampers' part included.
function breaking(memory) {
  const {F, I, at} = memory, {s, d, x, v, springs, breaking_force, breaking_stretch} = at, found = [], lengths = lengthsOf(memory);
  for (let j = 0; j < s; j++) {
    if (F[breaking_force + j] === Infinity && F[breaking_stretch + j] === Infinity) continue;
    const a = d * I[springs + 2 * j], b = d * I[springs + 2 * j + 1], stretch = lengths[j] - F[at.rest_lengths + j];
    let rate = 0;
    if (F[at.damping + j] > 0 && lengths[j] > 0) {
      for (let axis = 0; axis < d; axis++) rate += (F[x + b + axis] - F[x + a + axis]) * (F[v + b + axis] - F[v + a + axis]);
      rate /= lengths[j];
    }
    const [k, c] = [secant_stiffness, damping_at].map(part => ofSpring(part, memory, j, stretch));
    if (stretch > F[breaking_stretch + j] || law.spring_force(k, stretch, c, rate) > F[breaking_force + j]) found.push(j);
  }
  return found;
}

const mayBreak = ({F, at}, j) => F[at.breaking_force + j] < Infinity || F[at.breaking_stretch + j] < Infinity;

// One of the law's functions, of a spring at a stretch.
const ofSpring = (part, {F, at}, j, stretch) => part(F[at.stiffness + j], F[at.damping + j], F[at.hardening + j], F[at.largest_force + j], F[at.tension_only + j], F[at.compression_only + j], stretch);

// Masses held where they are, or let go from rest.
function hold(memory, masses, held) {
  const {F, I, at} = memory;
  for (const i of masses) {
    I[at.fixed + i] = held ? 1 : 0;
    if (held) F.fill(0, at.v + at.d * i, at.v + at.d * (i + 1));
  }
  derive(memory);
}

// Kinetic, elastic and potential energy [J], the last by gravity from where the masses start.
function energies({memory, start}) {
  const {F, I, at} = memory, {n, s, d, x, v, masses, weight, fixed, rest_lengths} = at;
  let kinetic = 0, elastic = 0, potential = 0;
  for (let i = 0; i < n; i++) {
    if (I[fixed + i]) continue;
    for (let e = d * i; e < d * (i + 1); e++) {
      kinetic += 0.5 * F[masses + i] * F[v + e] * F[v + e];
      potential -= F[weight + e] * (F[x + e] - start[e]);
    }
  }
  const lengths = lengthsOf(memory);
  for (let j = 0; j < s; j++) elastic += energyOf(memory, j, lengths[j] - F[rest_lengths + j]);
  elastic += bentEnergy(memory, F.subarray(x, x + n * d));
  return {kinetic, elastic, potential, total: kinetic + elastic + potential};
}

// The energy of a spring [J] at a stretch.
const energyOf = (memory, j, stretch) => memory.at.nonlinear ? ofSpring(energy_of_spring, memory, j, stretch) : law.elastic_energy(memory.F[memory.at.stiffness + j], stretch);

// How long all springs are [m], in an array that the next call writes anew.
function lengthsOf(memory) {
  const {F, I, at} = memory, {s, d, x, springs} = at, lengths = memory.lengths = memory.lengths || new Float64Array(s);
  for (let j = 0; j < s; j++) {
    const a = x + d * I[springs + 2 * j], b = x + d * I[springs + 2 * j + 1];
    const along = F[b] - F[a], up = d > 1 ? F[b + 1] - F[a + 1] : 0, near = d > 2 ? F[b + 2] - F[a + 2] : 0;
    lengths[j] = Math.sqrt(along * along + up * up + near * near);
  }
  return lengths;
}
