// Predicted: up to which dt perturbations of a rest do not grow under a scheme. As reference/theory/limits.py has it:
// a Runge-Kutta method by its stability polynomial on the eigenvalues of the motion, any other by its step.

// Up to this many positions and velocities all eigenvalues are had; of more, those of the fastest moves.
const ALL_UP_TO = 420, STEP_UP_TO = 90;

// Of steps that see masses inside obstacles `springlab stability` looks at the rest there up to this many.
const ON_OBSTACLES_UP_TO = 260;

// By what one step multiplies the worst state of a mode q'' + (g + drag) q' + w2 q = 0, of a step's length. Damping of
// springs and drag are told apart where a scheme does.
function growthOfMode(scheme, w2, g, drag = 0) {
  if (!scheme.linear) return growthOfWholeMode(scheme, w2, g, drag);
  return h => {
    const c = scheme.coefficients(h), columns = [];
    for (const [x0, v0] of [[1, 0], [0, 1 / h]]) {
      const x = Float64Array.of(x0), v = Float64Array.of(v0);
      scheme.linear(x, v, c, (X, V, out) => { out[0] = -w2 * X[0] - (g + drag) * V[0]; });
      columns.push([x[0], h * v[0]]);
    }
    const [[p, q], [r, s]] = columns;
    return largestOfTwo(p + s, p * s - r * q);
  };
}

function largestOfTwo(trace, determinant) {
  const inside = trace * trace / 4 - determinant;
  return inside < 0 ? Math.sqrt(determinant) : Math.abs(trace / 2) + Math.sqrt(inside);
}

// The same by a scheme of whole states, which may remember: in units of 1 / w.
function growthOfWholeMode(scheme, w2, g, drag) {
  const w = Math.sqrt(w2) || 1, motion = modeMotion(w2 / (w * w), g / w, drag / w), vector = value => new Nd([2, 1], Float64Array.of(0, value));
  let remembered = 0;
  if (scheme.memory) remembered = scheme.step(motion, new State(0, vector(0), vector(0), []), 1).memory.length;
  const size = 2 + remembered;
  return step => {
    const h = w * step, matrix = new Float64Array(size * size);
    for (let column = 0; column < size; column++) {
      const unit = Array.from({length: size}, (_, k) => k === column ? 1 : 0);
      const end = scheme.step(motion, new State(0, vector(unit[0]), vector(unit[1] / h), unit.slice(2).map(vector)), h);
      [end.positions.data[1], h * end.velocities.data[1], ...end.memory.map(({data}) => data[1])].forEach((value, row) => { matrix[row * size + column] = value; });
    }
    if (!matrix.every(Number.isFinite)) return Infinity;
    if (size === 2) return largestOfTwo(matrix[0] + matrix[3], matrix[0] * matrix[3] - matrix[1] * matrix[2]);
    return Math.max(...eigenvalues(matrix, size).map(value => Math.hypot(...value)));
  };
}

// Decay slower than this part of the fastest rate has few digits, or none.
const WEAK = 1e-8;

// More of a growth factor is no rounding; what is less by that decays.
const SEEN = 1e-11;

// The first h beyond which a number that is at most 1 below is more, on a scale of 1 / fastest, up to the last to look at.
function firstBeyond(grows, fastest, from = 1e-6, ratio = 1.01, last = 60 / fastest) {
  let low = 0;
  for (let h = from / fastest; h < last; h *= h * fastest < 0.5 ? 1.3 : ratio) {
    if (grows(h) > 1 + SEEN) {
      let high = h;
      if (low === 0) return 0;
      // of what decays below, where it is neither
      const most = grows(low) < 1 - SEEN ? 1 : 1 + SEEN;
      for (let k = 0; k < 60; k++) { const middle = (low + high) / 2; if (grows(middle) > most) high = middle; else low = middle; }
      return low;
    }
    low = h;
  }
  return Infinity;
}

// |R(s e^(i angle))|^2 - 1 by its coefficients in s; those that are rounding are zero.
function modulusAlong(polynomial, [re, im]) {
  const size = Math.hypot(re, im), powers = [[1, 0]];
  const [c, s] = [re / size, im / size];
  for (let k = 1; k < 2 * polynomial.length; k++) {
    const [a, b] = powers[k - 1];
    powers.push([a * c - b * s, a * s + b * c]);
  }
  const square = new Float64Array(2 * polynomial.length - 1);
  polynomial.forEach((one, j) => polynomial.forEach((other, k) => { square[j + k] += one * other * powers[Math.abs(j - k)][0]; }));
  square[0] -= 1;
  return square.map(value => Math.abs(value) < 1e-13 ? 0 : value);
}

// The s up to which |R| <= 1 in a direction: 0 where it is not at once.
function stableAlong(polynomial, rate) {
  const square = modulusAlong(polynomial, rate), order = square.findIndex(value => value !== 0);
  if (order < 0) return Infinity;
  if (square[order] > 0) return 0;
  const value = s => { let sum = 0; for (let k = square.length - 1; k >= order; k--) sum = sum * s + square[k]; return sum; };
  let low = 0;
  for (let s = 1e-9; s < 1e4; s *= 1.01) {
    if (value(s) > 0) {
      let high = s;
      for (let k = 0; k < 70; k++) { const middle = (low + high) / 2; if (value(middle) > 0) high = middle; else low = middle; }
      return low;
    }
    low = s;
  }
  return Infinity;
}

// Of all modes of a rest: the limit [s] of a scheme, 0 where every step lets something grow, Infinity where none does.
// `about` is true where only the fastest moves were looked at; `mode` is the fastest move.
function limitOf(name, linear, known = {}, system = null) {
  try { return limitWhereSolved(name, linear, known, system); } catch (error) {
    // beside damping that is very strong the equations of a step have no numbers
    if (error instanceof SolverError) return {omega: Math.sqrt(known.top.value), about: false, limit: null, reason: "unsolved"};
    throw error;
  }
}

function limitWhereSolved(name, linear, known, system) {
  const scheme = schemes[schemes[name].solved];
  known.top = known.top || largestEigenpair(scaled(linear, "stiffness"), linear.size, alongStart(linear));
  const w2 = known.top.value, fastest = Math.sqrt(Math.max(w2, 0));
  if (!(fastest > 0)) return {limit: Infinity, reason: "nothing moves", omega: 0};
  const moving = linear.free.length * linear.memory.at.d, told = {omega: fastest, about: linear.contacts.length > 0 && !scheme.keeps};
  const curved = linear.contacts.some(contact => contact.curved);
  if (linear.contacts.length && system && (curved || !scheme.keeps) && 2 * moving <= STEP_UP_TO) {
    return {omega: fastest, about: false, reason: "", ...limitOnObstacles(system, linear, scheme, fastest)};
  }
  told.about = told.about || curved;
  if (scheme.kind === "in_place") {
    if (2 * moving > STEP_UP_TO) return {...told, limit: null, reason: "too large"};
    // what such a step does to motion that no spring resists is lost beside 1
    if (unresistedOf(linear)) return {...told, limit: null, reason: "unheld"};
    return {...told, ...firstOrSlow(h => growthOfStep(linear, h, stepInPlace(scheme, linear, h)), linear, fastest, known, 1e-6, true)};
  }
  if (!linear.damped && !linear.drag) {
    if (scheme.polynomial) return {...told, limit: stableAlong(scheme.polynomial, [0, 1]) / fastest};
    return {...told, limit: firstBeyond(growthOfMode(scheme, w2, 0), fastest, shortestOf(scheme))};
  }
  if (scheme.polynomial && 2 * moving <= ALL_UP_TO) {
    known.rates = known.rates || ratesOf(linear);
    const limits = rates => Math.min(...rates.map(rate => stableAlong(scheme.polynomial, rate) / Math.hypot(...rate)));
    const limit = limits(known.rates), strongest = Math.max(...known.rates.map(([re]) => Math.abs(re)));
    // where all decay is so slow that rounding leaves few of its digits, it may be none, or as much as this
    const most = WEAK * Math.max(...known.rates.map(rate => Math.hypot(...rate)));
    const unsure = strongest < most && limits(known.rates.map(([re, im]) => [-most, im])) > (1 + 1e-6) * limits(known.rates.map(([re, im]) => [0, im]));
    return unsure ? {...told, limit: null, reason: "slow"} : {...told, limit};
  }
  const whole = 2 * moving <= STEP_UP_TO && (scheme.linear || !linear.contacts.length);
  const proportional = scheme.proportional && (scheme.proportional_drag || !linear.drag);
  if (!proportional && !scheme.linear && !scheme.implicit && !whole) return {...told, limit: null, reason: "too large"};
  if (scheme.memory && !scheme.implicit) {
    return {...told, ...firstOrSlow(growthOfRemembering(scheme, linear, fastest), linear, fastest, known, shortestOf(scheme), false)};
  }
  const shortest = shortestLimit(scheme, linear, known);
  if (!scheme.polynomial && !scheme.solves && !scheme.memory && whole && (scheme.linear || !proportional)) {
    const step = scheme.linear ? stepLinear : stepWholeLinear;
    const grows = h => growthOfStep(linear, h, step(scheme, linear, h), unresistedOf(linear));
    // one that stops iterating early may let motion grow far below
    return {...told, limit: scheme.iterated ? firstBeyond(grows, fastest, 1e-2, 1.04) : nearby(grows, shortest, fastest)};
  }
  return {...told, limit: shortest, about: Boolean(scheme.polynomial) || told.about};
}

// The first limit of a step looked at as a whole. Where all motion decays there is one; if what damping takes in a step
// there is less than rounding, it is not told. `never` is true of a step that lets all motion grow that nothing damps.
function firstOrSlow(grows, linear, fastest, known, from, never) {
  known.rates = known.rates || ratesOf(linear);
  // drag damps all motion, however little is left of it
  const decays = known.rates.every(([re]) => re < 0), damped = decays || linear.drag > 0;
  if (!decays && never) return damped ? {limit: null, reason: "slow"} : {limit: 0};
  const limit = firstBeyond(grows, fastest, from);
  return damped && !(limit > 0 && grows(limit / 2) < 1 - SEEN) ? {limit: null, reason: "slow"} : {limit};
}

// As `springlab stability` has it: about a rest on obstacles, where a scheme's steps have one there that can be looked at,
// else of the scene without them, which `alone` true says. Args: without: where that rests, as `linearise` has it, or null.
function limitBesideObstacles(name, linear, without, known, system) {
  const scheme = schemes[name], there = linear.contacts.length ? staysOnObstacles(scheme, linear, known, system) : true;
  const told = there ? limitOf(name, linear, known, system) : null;
  if (told && !(linear.contacts.length && told.reason === "no rest")) return told;
  const other = without();
  return other ? {...limitOf(name, other, other.known = other.known || {}), alone: true} : {limit: null, reason: "no rest"};
}

function staysOnObstacles(scheme, linear, known, system) {
  if (scheme.keeps && !linear.contacts.some(contact => contact.curved)) return true;
  known.top = known.top || largestEigenpair(scaled(linear, "stiffness"), linear.size, alongStart(linear));
  if (2 * linear.free.length * linear.memory.at.d > ON_OBSTACLES_UP_TO) return false;
  return isPressed(system, linear, scheme, 1 / Math.sqrt(known.top.value));
}

// Where the scene without its obstacles rests, linearised, or null; looked for when it is asked for.
function restWithout(memory, guess) {
  let found;
  return () => {
    if (found !== undefined || !guess) return found || null;
    const rest = equilibrium(memory, guess), linear = rest.off < 1e-6 ? linearise(memory, rest.x) : null;
    return found = linear && linear.corner === undefined ? linear : null;
  };
}

// A start that is along surfaces and free masses only.
const alongStart = linear => alongSurfaces(linear, pseudoRandom(linear.size));

// Of a step whose matrices are symmetric, the limit is the least over all moves y of the limit of a mode with the
// stiffness and damping that y meets; from the stiffest on, each next y is where both together are largest.
function shortestLimit(scheme, linear, known) {
  const forms = (scheme.linear ? ["stiffness", "damping"] : ["stiffness", "springs", "drag"]).map(which => scaled(linear, which)), out = new Float64Array(linear.size);
  const met = y => forms.map(form => dot(y, form(y, out)));
  // beside strong damping the slower motion of a mode, w2 / fastest, may be what limits: it is looked at in its own steps
  const limit = ([w2, ...slowed]) => {
    const fastest = Math.sqrt(w2) + slowed.reduce((sum, value) => sum + value, 0);
    return firstBeyond(growthOfMode(scheme, w2, ...slowed), fastest, shortestOf(scheme), 1.01, 60 * fastest / w2);
  };
  let y = known.top.vector, best = Infinity;
  for (let round = 0; round < 6; round++) {
    const values = met(y), now = limit(values), [w2] = values;
    if (!(now < best * (1 - 1e-12))) break;
    best = now;
    const step = 1e-4, changed = (k, change) => limit(values.map((value, q) => q === k ? Math.max(value + change, 0) : value));
    const answers = values.map((value, k) => {
      const less = value * step || w2 * step * now;
      return (changed(k, -less) - changed(k, less)) / less;
    });
    const other = new Float64Array(linear.size);
    const together = (q, to) => {
      to.fill(0);
      forms.forEach((form, k) => { if (answers[k]) { form(q, other); for (let e = 0; e < q.length; e++) to[e] += answers[k] * other[e]; } });
    };
    y = largestEigenpair(together, linear.size, y.map((value, e) => value + 1e-3 * alongStart(linear)[e])).vector;
  }
  return best;
}

// From which part of the fastest 1 / w on: in shorter steps, and sooner where a scheme remembers, rounding tears a pair
// of eigenvalues at 1 apart.
const shortestOf = ({memory}) => memory ? 0.05 : 1e-3;

// By halving about a first guess, which is near.
function nearby(grows, guess, fastest) {
  if (!(guess > 0 && guess < Infinity)) return firstBeyond(grows, fastest);
  let low = guess * 0.98, high = guess * 1.02;
  if (grows(low) > 1 + SEEN || grows(high) <= 1 + SEEN) return firstBeyond(grows, fastest);
  for (let k = 0; k < 34; k++) { const middle = (low + high) / 2; if (grows(middle) > 1 + SEEN) high = middle; else low = middle; }
  return low;
}

// The coordinates of free masses, of vectors of all.
const coordinates = ({free, memory: {at}}) => free.flatMap(i => Array.from({length: at.d}, (_, axis) => at.d * i + axis));

// All eigenvalues of the motion, one of each pair, without those of motion that nothing resists.
function ratesOf(linear) {
  const places = coordinates(linear), m = places.length, matrix = new Float64Array(4 * m * m);
  const stiffness = scaled(linear, "stiffness"), damping = scaled(linear, "damping");
  const y = new Float64Array(linear.size), out = new Float64Array(linear.size);
  places.forEach((place, column) => {
    matrix[column * 2 * m + m + column] = 1;
    for (const [apply, shift] of [[stiffness, 0], [damping, m]]) {
      y.fill(0); y[place] = 1; apply(y, out);
      places.forEach((other, row) => { matrix[(m + row) * 2 * m + shift + column] = -out[other]; });
    }
  });
  const values = eigenvalues(matrix, 2 * m), fastest = Math.max(...values.map(value => Math.hypot(...value)));
  return values.filter(([re, im]) => im >= 0 && Math.hypot(re, im) > 1e-6 * fastest)
    .map(([re, im]) => [Math.abs(re) < 1e-12 * fastest ? 0 : re, im]);
}

// One step of the linearised motion, of vectors of all masses.
function stepLinear(scheme, linear, h) {
  const c = scheme.coefficients(h), stiffness = scaled(linear, "stiffness"), damping = scaled(linear, "damping");
  const pull = new Float64Array(linear.size), slow = new Float64Array(linear.size);
  return (x, v) => scheme.linear(x, v, c, (X, V, out) => {
    stiffness(X, pull); damping(V, slow);
    for (let e = 0; e < out.length; e++) out[e] = -pull[e] - slow[e];
  });
}

// The same by a scheme of whole states.
function stepWholeLinear(scheme, linear, h) {
  const {at} = linear.memory, shape = [at.n, at.d];
  linear.motion = linear.motion || new LinearMotion(new SpringMotion(systemOf(linear.memory, sizeOf(at, linear.memory))), linear.rest);
  return (x, v) => {
    const end = scheme.step(linear.motion, new State(0, new Nd(shape, x.slice()), new Nd(shape, v.slice())), h);
    x.set(end.positions.data); v.set(end.velocities.data);
  };
}

// The largest modulus of a step of small moves by a scheme that remembers, what it remembers with them: in units of 1 / w.
function growthOfRemembering(scheme, linear, fastest) {
  const {at} = linear.memory, places = coordinates(linear), m = places.length, shape = [at.n, at.d];
  const motion = new LinearMotion(new SpringMotion(systemOf(linear.memory, 1)), linear.rest), [byPosition, byVelocity] = motion.blocks;
  motion.blocks = [nd.times(1 / fastest ** 2, byPosition), nd.times(1 / fastest, byVelocity)];
  const still = () => nd.zeros(shape), count = 2 + scheme.step(motion, new State(0, still(), still()), 1).memory.length, size = count * m;
  return step => {
    const h = fastest * step, matrix = new Float64Array(size * size);
    for (let column = 0; column < size; column++) {
      const parts = Array.from({length: count}, still), part = Math.floor(column / m);
      parts[part].data[places[column % m]] = part === 1 ? 1 / h : 1;
      const end = scheme.step(motion, new State(0, parts[0], parts[1], parts.slice(2)), h);
      [end.positions, end.velocities, ...end.memory].forEach(({data}, k) => places.forEach((place, row) => { matrix[(k * m + row) * size + column] = (k === 1 ? h : 1) * data[place]; }));
    }
    return largestOfStep(matrix, size);
  };
}

// Those of motion that nothing resists left out, which are 1: so many at most, where others may be as near to 1 and grow.
function largestOfStep(matrix, size, unresisted = size) {
  if (!matrix.every(Number.isFinite)) return Infinity;
  const away = ([re, im]) => Math.hypot(re - 1, im);
  const kept = eigenvalues(matrix, size).sort((a, b) => away(a) - away(b)).filter((value, k) => k >= unresisted || away(value) > 1e-6);
  return Math.max(1 - 1e-6, ...kept.map(value => Math.hypot(...value)));
}

// How many eigenvalues are 1 at most: two for each direction that no spring resists.
function unresistedOf(linear) {
  if (linear.unresisted !== undefined) return linear.unresisted;
  const places = coordinates(linear), m = places.length, matrix = new Float64Array(m * m);
  const stiffness = scaled(linear, "stiffness"), y = new Float64Array(linear.size), out = new Float64Array(linear.size);
  places.forEach((place, column) => {
    y.fill(0); y[place] = 1; stiffness(y, out);
    places.forEach((other, row) => { matrix[row * m + column] = out[other]; });
  });
  const values = eigenvalues(matrix, m).map(([re]) => re), largest = Math.max(...values);
  return linear.unresisted = 2 * values.filter(value => value <= 1e-14 * m * largest).length;
}

// The same of a scheme that writes what it still reads: its own loops, with accelerations of the linearised motion.
function stepInPlace(scheme, linear, h) {
  const {at: {n, s, d}} = linear.memory, size = n * d, F = new Float64Array((3 + ROOMS) * size);
  const at = {...linear.memory.at, x: 0, v: size, out: 2 * size, room: 3 * size};
  const stiffness = scaled(linear, "stiffness"), damping = scaled(linear, "damping");
  const pull = new Float64Array(size), slow = new Float64Array(size);
  const accelerate = (F, I, at, i, x, v) => {
    stiffness(F.subarray(x, x + size), pull); damping(F.subarray(v, v + size), slow);
    for (let axis = 0; axis < d; axis++) F[at.out + d * i + axis] = -pull[d * i + axis] - slow[d * i + axis];
  };
  const c = scheme.coefficients(h), run = loopsOf({...scheme}, {at: {...linear.memory.at, nonlinear: false}});
  return (x, v) => {
    F.set(x, 0); F.set(v, size);
    run(F, linear.memory.I, at, c, 1, accelerate);
    x.set(F.subarray(0, size)); v.set(F.subarray(size, 2 * size));
  };
}

// The largest modulus of a step's eigenvalues.
function growthOfStep(linear, h, step, unresisted) {
  const places = coordinates(linear), m = places.length, matrix = new Float64Array(4 * m * m);
  for (let column = 0; column < 2 * m; column++) {
    const x = new Float64Array(linear.size), v = new Float64Array(linear.size);
    if (column < m) x[places[column]] = 1; else v[places[column - m]] = 1 / h;
    step(x, v);
    places.forEach((place, row) => {
      matrix[row * 2 * m + column] = x[place];
      matrix[(m + row) * 2 * m + column] = h * v[place];
    });
  }
  return largestOfStep(matrix, 2 * m, unresisted);
}

// The limits of some schemes for a system as it is set, and which springs the fastest move strains most.
function answerLimits({id, memory, system, rest, contacts, alone, names}) {
  const {F, at} = memory, known = {};
  const found = equilibrium(memory, rest, contacts);
  if (!(found.off < 1e-6)) return {id, limits: Object.fromEntries(names.map(name => [name, {limit: null, reason: "no rest"}])), mode: null};
  const linear = linearise(memory, found.x, contacts);
  if (linear.corner !== undefined) return {id, limits: Object.fromEntries(names.map(name => [name, {limit: null, reason: "corner"}])), mode: null};
  const without = restWithout(memory, alone);
  const limits = Object.fromEntries(names.map(name => [name, limitBesideObstacles(name, linear, without, known, system)]));
  if (!known.top || !(known.top.value > 0)) return {id, limits, mode: null};
  const y = known.top.vector, out = new Float64Array(linear.size), share = new Float64Array(at.s);
  const move = y.map((value, e) => value * linear.root[e]);
  for (let j = 0; j < at.s; j++) {
    const a = memory.I[at.springs + 2 * j], b = memory.I[at.springs + 2 * j + 1];
    let stretch = 0;
    for (let axis = 0; axis < at.d; axis++) stretch += linear.unit[at.d * j + axis] * (move[at.d * b + axis] - move[at.d * a + axis]);
    share[j] = linear.along[j] * stretch * stretch;
  }
  const [g, drag] = ["damping", "drag"].map(which => dot(y, scaled(linear, which)(y, out))), whole = share.reduce((sum, value) => sum + value, 0);
  const order = Array.from(share.keys()).sort((a, b) => share[b] - share[a]).slice(0, 3);
  return {id, limits, mode: {w2: known.top.value, g, drag, springs: order, part: whole ? share[order[0]] / whole : 0}};
}
