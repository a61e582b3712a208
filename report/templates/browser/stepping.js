// A system under way by one scheme: steps, what changes on the way, and when it has left physics behind.

// How many times its length a spring is, or as far as it could have come a mass, when a run has blown up, as
// reference/outcome.py has it; of the energy it is the square.
const RATIO = 100;

function startWorld(system, scheme, dt, changes = [], drives = []) {
  const memory = memoryOf(system);
  const world = {system, memory, scheme, dt, drives, steps: 0, origin: {time: 0, steps: 0}, blownUp: null, done: 0, size: sizeOf(system, memory)};
  const {F, at} = memory, named = changes.filter(change => change.parameter === "break").flatMap(change => change.value);
  // what breaks, now or later, may then be of any length, and so may what only pushes
  world.breaks = Uint8Array.from({length: system.s}, (_, j) => mayBreak(memory, j) || named.includes(j) ? 1 : 0);
  const scale = Math.max(world.size, ...Array.from(F.subarray(at.x, at.x + at.n * at.d), Math.abs)) || 1;
  const naturalOf = (length, j) => Math.max(F[at.rest_lengths + j], length, F[at.rest_lengths + j] > 0 ? 0 : scale);
  world.natural = lengthsOf(memory).map((length, j) => world.breaks[j] || F[at.compression_only + j] ? Infinity : naturalOf(length, j));
  world.reach = sizeOf(system, memory) + world.natural.reduce((sum, length) => length < Infinity ? sum + length : sum, 0) || 1;
  world.fastest = 0; world.pull = 0;
  for (let i = 0; i < system.n; i++) world.fastest = Math.max(world.fastest, Math.hypot(...F.subarray(at.v + at.d * i, at.v + at.d * (i + 1))));
  world.start = memory.F.slice(memory.at.x, memory.at.x + system.n * system.d);
  const {kinetic, elastic} = energies(world);
  world.given = kinetic + elastic;
  for (let j = 0; j < system.s; j++) world.given += energyOf(memory, j, world.natural[j] < Infinity ? world.natural[j] : F[at.rest_lengths + j]);
  if (memory.angular) for (const stiffness of memory.angular.stiffness) world.given += stiffness / 2;  // bent by 1 rad
  world.changes = changes.slice().sort((a, b) => a.time - b.time);
  return world;
}

// The widest extent, or the longest spring's rest length [m].
function sizeOf({n, s, d}, {F, at}) {
  let size = 0;
  for (let j = 0; j < s; j++) size = Math.max(size, F[at.rest_lengths + j]);
  for (let axis = 0; axis < d; axis++) {
    let low = Infinity, high = -Infinity;
    for (let e = axis; e < n * d; e += d) { low = Math.min(low, F[at.x + e]); high = Math.max(high, F[at.x + e]); }
    size = Math.max(size, high - low);
  }
  return size;
}

// How far a mass may have come from its start [m]: as it flies and falls, and as all springs end to end allow.
function allowedDistance(world) {
  const {F, at} = world.memory, time = timeOf(world);
  world.pull = Math.max(world.pull, Math.hypot(...F.subarray(at.gravity, at.gravity + at.d)));
  return world.reach + world.fastest * time + world.pull * time * time / 2;
}

const timeOf = ({origin, steps, dt}) => origin.time + (steps - origin.steps) * dt;

// What changes at the step that begins now or has changed before: a time within 1e-9 of a step's start is that start.
function applyChanges(world) {
  for (; world.done < world.changes.length; world.done++) {
    const {time, parameter, value} = world.changes[world.done], {origin} = world;
    if (Math.ceil((time - origin.time) / world.dt - 1e-9) > world.steps - origin.steps) return;
    if (parameter === "dt") Object.assign(world, {origin: {time: timeOf(world), steps: world.steps}, dt: value});
    else applyChange(world.memory, parameter, value);
  }
}

function applyChange(memory, parameter, value) {
  const which = [value].flat();
  if (parameter === "hold" || parameter === "release") hold(memory, which, parameter === "hold");
  else if (parameter === "break") breakSprings(memory, which);
  else setParameter(memory, parameter, value);
}

// What is driven, as it is in the middle of the step that begins now: a row of its table for each step of the scene's dt,
// straight lines between their middles at another, and the last row after the end.
function applyDrives({memory, drives, dt}, time) {
  for (const drive of drives) {
    const {parameter, columns} = drive, width = columns.length, {F, at} = memory, [begin] = PARAMETERS[parameter](at);
    drive.table = drive.table || new Float64Array(Uint8Array.from(atob(drive.rows), c => c.charCodeAt(0)).buffer);
    const last = drive.table.length / width - 1, place = Math.min(Math.max((time + dt / 2) / drive.dt - 0.5, 0), last);
    const whole = Math.abs(place - Math.round(place)) < 1e-6, row = whole ? Math.round(place) : Math.floor(place);
    for (let k = 0; k < width; k++) {
      const value = drive.table[row * width + k];
      F[begin + columns[k]] = whole ? value : value + (place - row) * (drive.table[(row + 1) * width + k] - value);
    }
    breakSprings(memory, []);
    memory.most = null;
    derive(memory);
  }
}

// A scheme's loops, for springs that are linear or need not be; of what bends there are none, nor of equations to solve.
const loopsOf = ({advance, nonlinear}, {at, angular}) => advance && !angular ? (at.nonlinear && nonlinear || advance)[at.d] : null;

// A step by a scheme in a memory, again and again from what stands there; what is not to be solved ends far away.
function onceBy(scheme, memory, h) {
  const run = loopsOf(scheme, memory), c = run && scheme.coefficients(h), world = {memory, size: sizeOf(memory.at, memory)};
  return () => {
    world.remembered = [];
    if (run) run(memory.F, memory.I, memory.at, c, 1);
    else if (!stepWhole(world, scheme.step, h)) memory.F.fill(Infinity, memory.at.x, memory.at.x + 2 * memory.at.n * memory.at.d);
  };
}

// A number of steps, as many as there are until it blows up. That is looked at after each: when and where it did does not
// hang on how many steps are asked for at once.
function advance(world, steps) {
  const {memory: {F, I, at}, system, scheme} = world, {coefficients, step} = schemes[scheme], run = loopsOf(schemes[scheme], world.memory);
  for (let k = 1; k <= steps && !world.blownUp; k++) {
    applyChanges(world);
    if (world.drives.length) applyDrives(world, timeOf(world));
    if (world.step) { if (!world.step()) { world.blownUp = {what: "refused", which: 0}; break; } }  // an engine takes them
    else if (run) run(F, I, at, coefficients(world.dt), 1);
    else if (!stepWhole(world, step, world.dt)) { world.blownUp = {what: "unsolved", which: 0}; break; }
    for (const {kind, values} of system.obstacles) {
      const project = obstacles[kind];
      for (let i = 0; i < at.n; i++) project(F, at.x, at.v, i, !I[at.fixed + i], values);
    }
    world.steps++;
    if (at.nonlinear && world.breaks.includes(1)) breakNow(world);
    world.blownUp = blowUp(world);
  }
  return world;
}

// Springs that break at the end of a step are gone from the next one on.
function breakNow({memory}) {
  const found = breaking(memory);
  if (!found.length) return;
  breakSprings(memory, found);
  memory.most = null;
}

// When and how a run has left physics behind, or null: {what, which}. Looked at in every step.
function blowUp(world) {
  const {memory, natural, breaks, given, start} = world, {F, at} = memory, {n, s, d, x, v, masses, rest_lengths} = at;
  const furthest = (RATIO * allowedDistance(world)) ** 2;
  let kinetic = 0, flown = null;
  for (let i = 0; i < n; i++) {
    let away = 0, squares = 0, speed = 0;
    for (let e = d * i; e < d * (i + 1); e++) {
      const moved = F[x + e] - start[e];
      away += Math.abs(moved); squares += moved * moved; speed += F[v + e] * F[v + e];
    }
    if (!(away < Infinity)) return {what: "position", which: i};
    if (!(speed < Infinity)) return {what: "velocity", which: i};
    if (squares > furthest && !flown) flown = {what: "distance", which: i};
    kinetic += 0.5 * F[masses + i] * speed;
  }
  if (isNear(world, kinetic)) return flown;
  const lengths = lengthsOf(memory);
  let energy = kinetic + bentEnergy(memory, F.subarray(x, x + n * d));
  for (let j = 0; j < s; j++) {
    if (lengths[j] > RATIO * natural[j]) return {what: "spring", which: j};
    if (!breaks[j]) energy += energyOf(memory, j, lengths[j] - F[rest_lengths + j]);
  }
  if (flown) return flown;
  const allowed = given + givenByGravity(world);
  return energy > RATIO * RATIO * allowed && allowed > 0 ? {what: "energy", which: 0} : null;
}

// Up to how many times its natural length a spring is no matter, if all of them at that length have not too much energy.
const NEAR = 40;

// Whether all springs are that short: it takes no square roots.
function isNear({memory, natural, breaks, given}, kinetic) {
  const {F, I, at} = memory, {s, d, x, springs, rest_lengths} = at;
  if (!memory.most) {
    memory.most = {squares: natural.map(length => (NEAR * length) ** 2), energy: 0};
    for (let j = 0; j < s; j++) {
      const rest = F[rest_lengths + j], most = natural[j] < Infinity ? Math.max(NEAR * natural[j], rest) : rest;
      if (!breaks[j]) memory.most.energy += Math.max(energyOf(memory, j, most), energyOf(memory, j, -rest));
    }
  }
  const bent = memory.angular ? memory.angular.stiffness.reduce((sum, value) => sum + value, 0) * Math.PI ** 2 / 2 : 0;  // at most by half a turn
  const {squares, energy: most} = memory.most, energy = most + bent;
  if (!(2 * (kinetic + energy) < RATIO * RATIO * given)) return false;
  for (let j = 0; j < s; j++) {
    const a = x + d * I[springs + 2 * j], b = x + d * I[springs + 2 * j + 1];
    const along = F[b] - F[a], up = d > 1 ? F[b + 1] - F[a + 1] : 0, near = d > 2 ? F[b + 2] - F[a + 2] : 0;
    if (!(along * along + up * up + near * near < squares[j])) return false;
  }
  return true;
}

// What gravity does at most on the way from the start [J].
function givenByGravity({memory: {F, at: {n, d, x, masses, gravity}}, start}) {
  let pull = 0, sum = 0;
  for (let axis = 0; axis < d; axis++) pull += F[gravity + axis] * F[gravity + axis];
  for (let i = 0; i < n; i++) {
    let away = 0;
    for (let e = d * i; e < d * (i + 1); e++) away += (F[x + e] - start[e]) * (F[x + e] - start[e]);
    sum += F[masses + i] * Math.sqrt(pull * away);
  }
  return sum;
}

// The mean distance of the masses of two worlds of one system [m].
function apart(one, other) {
  const {at} = one.memory, {n, d} = at;
  let sum = 0;
  for (let i = 0; i < n; i++) {
    let squares = 0;
    for (let axis = 0; axis < d; axis++) {
      squares += (one.memory.F[at.x + d * i + axis] - other.memory.F[other.memory.at.x + d * i + axis]) ** 2;
    }
    sum += Math.sqrt(squares);
  }
  return sum / n;
}
