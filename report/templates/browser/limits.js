// Predicted: up to which dt perturbations of a rest do not grow under a scheme. As reference/theory/limits.py has it:
// a Runge-Kutta method by its stability polynomial on the eigenvalues of the motion, any other by its step.

// Up to this many positions and velocities all eigenvalues are had; of more, those of the fastest moves.
const ALL_UP_TO = 420, STEP_UP_TO = 90;

// Of steps that see masses inside obstacles `springlab stability` looks at the rest there up to this many.
const ON_OBSTACLES_UP_TO = 260;

// By what one step multiplies the worst state of a mode q'' + g q' + w2 q = 0.
function growthOfMode(scheme, h, w2, g) {
  const c = scheme.coefficients(h), columns = [];
  for (const [x0, v0] of [[1, 0], [0, 1 / h]]) {
    const x = Float64Array.of(x0), v = Float64Array.of(v0);
    scheme.linear(x, v, c, (X, V, out) => { out[0] = -w2 * X[0] - g * V[0]; });
    columns.push([x[0], h * v[0]]);
  }
  const [[p, q], [r, s]] = columns, trace = p + s, determinant = p * s - r * q;
  const inside = trace * trace / 4 - determinant;
  return inside < 0 ? Math.sqrt(determinant) : Math.abs(trace / 2) + Math.sqrt(inside);
}

// The first h beyond which a number that is at most 1 below is more, on a scale of 1 / fastest.
function firstBeyond(grows, fastest) {
  let low = 0;
  for (let h = 1e-6 / fastest; h < 60 / fastest; h *= h * fastest < 0.5 ? 1.3 : 1.01) {
    if (grows(h) > 1 + 1e-11) {
      let high = h;
      if (low === 0) return 0;
      for (let k = 0; k < 60; k++) { const middle = (low + high) / 2; if (grows(middle) > 1 + 1e-11) high = middle; else low = middle; }
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
  const scheme = schemes[name];
  known.top = known.top || largestEigenpair(scaled(linear, "stiffness"), linear.size, alongStart(linear));
  const w2 = known.top.value, fastest = Math.sqrt(Math.max(w2, 0));
  if (!(fastest > 0)) return {limit: Infinity, reason: "nothing moves", omega: 0};
  const moving = linear.free.length * linear.memory.at.d, told = {omega: fastest, about: linear.contacts.length > 0 && !scheme.keeps};
  const curved = linear.contacts.some(contact => contact.curved);
  if (linear.contacts.length && system && (curved || !scheme.keeps) && 2 * moving <= STEP_UP_TO) {
    const limit = limitOnObstacles(system, linear, scheme, fastest);
    return {omega: fastest, about: false, limit, reason: limit === null ? "no rest" : ""};
  }
  told.about = told.about || curved;
  if (!scheme.linear) {
    if (2 * moving > STEP_UP_TO) return {...told, limit: null, reason: "too large"};
    const grows = h => growthOfStep(linear, h, stepInPlace(scheme, linear, h)), first = firstBeyond(grows, fastest);
    // where nothing decays in shorter steps either, growth there is only too slow to be seen
    return {...told, limit: first > 0 && grows(first / 2) < 1 - 1e-9 ? first : 0};
  }
  if (!linear.damped && !linear.drag) {
    if (scheme.polynomial) return {...told, limit: stableAlong(scheme.polynomial, [0, 1]) / fastest};
    return {...told, limit: firstBeyond(h => growthOfMode(scheme, h, w2, 0), fastest)};
  }
  if (scheme.polynomial && 2 * moving <= ALL_UP_TO) {
    known.rates = known.rates || ratesOf(linear);
    return {...told, limit: Math.min(...known.rates.map(rate => stableAlong(scheme.polynomial, rate) / Math.hypot(...rate)))};
  }
  const shortest = shortestLimit(scheme, linear, known);
  if (!scheme.polynomial && 2 * moving <= STEP_UP_TO) {
    return {...told, limit: nearby(h => growthOfStep(linear, h, stepLinear(scheme, linear, h)), shortest, fastest)};
  }
  return {...told, limit: shortest, about: Boolean(scheme.polynomial) || told.about};
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
  const stiffness = scaled(linear, "stiffness"), damping = scaled(linear, "damping"), out = new Float64Array(linear.size);
  const meets = (apply, y) => dot(y, apply(y, out));
  const limit = (w2, g) => firstBeyond(h => growthOfMode(scheme, h, w2, g), Math.sqrt(w2) + g);
  let y = known.top.vector, best = Infinity;
  for (let round = 0; round < 6; round++) {
    const w2 = meets(stiffness, y), g = meets(damping, y), now = limit(w2, g);
    if (!(now < best * (1 - 1e-12))) break;
    best = now;
    const step = 1e-4, byStiffness = (limit(w2 * (1 - step), g) - limit(w2 * (1 + step), g)) / (w2 * step);
    const less = g * step || w2 * step * now, byDamping = (limit(w2, Math.max(g - less, 0)) - limit(w2, g + less)) / less;
    const other = new Float64Array(linear.size);
    const together = (q, to) => {
      stiffness(q, to); damping(q, other);
      for (let e = 0; e < q.length; e++) to[e] = byStiffness * to[e] + byDamping * other[e];
    };
    y = largestEigenpair(together, linear.size, y.map((value, e) => value + 1e-3 * alongStart(linear)[e])).vector;
  }
  return best;
}

// By halving about a first guess, which is near.
function nearby(grows, guess, fastest) {
  if (!(guess > 0 && guess < Infinity)) return firstBeyond(grows, fastest);
  let low = guess * 0.98, high = guess * 1.02;
  if (grows(low) > 1 + 1e-9 || grows(high) <= 1 + 1e-9) return firstBeyond(grows, fastest);
  for (let k = 0; k < 34; k++) { const middle = (low + high) / 2; if (grows(middle) > 1 + 1e-9) high = middle; else low = middle; }
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
  const c = scheme.coefficients(h), run = runOf(scheme, linear.memory.at);
  return (x, v) => {
    F.set(x, 0); F.set(v, size);
    run(F, linear.memory.I, at, c, 1, accelerate);
    x.set(F.subarray(0, size)); v.set(F.subarray(size, 2 * size));
  };
}

// The largest modulus of a step's eigenvalues, those of motion that nothing resists left out, which are 1.
function growthOfStep(linear, h, step) {
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
  const kept = eigenvalues(matrix, 2 * m).filter(([re, im]) => Math.hypot(re - 1, im) > 1e-6);
  return Math.max(1 - 1e-6, ...kept.map(value => Math.hypot(...value)));
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
  const g = dot(y, scaled(linear, "damping")(y, out)), whole = share.reduce((sum, value) => sum + value, 0);
  const order = Array.from(share.keys()).sort((a, b) => share[b] - share[a]).slice(0, 3);
  return {id, limits, mode: {w2: known.top.value, g, springs: order, part: whole ? share[order[0]] / whole : 0}};
}
