// A step from a rest on obstacles, as reference/theory/step_on_obstacles.py has it: masses that are pressed are led a little
// inside and projected out, so a step stays not at the rest itself but near it; there it is differenced.

// Newton's steps to where a scheme stays, and how near is near enough, as a part of the shortest rest length.
const SETTLING = 10, SETTLED = 1e-12;

// Deeper inside than this part of the shortest rest length a mass is pressed; nearer to the surface it is rounding.
const INSIDE = 1e-13;

// Above zero [m]; where all are zero, the scene's size.
function shortestRestLength({F, at}) {
  const above = Array.from(F.subarray(at.rest_lengths, at.rest_lengths + at.s)).filter(length => length > 0);
  return above.length ? Math.min(...above) : sizeOf(at, {F, at}) || 1;
}

// The largest modulus of an eigenvalue of the whole step where it stays; null where it stays nowhere.
function growthOnObstacles(system, linear, scheme, h) {
  const {step, end, depth: depthOf, m} = stepOnObstacles(system, linear, scheme, h);
  const scale = shortestRestLength(linear.memory);
  let z = new Float64Array(2 * m);
  for (let round = 0; round < SETTLING; round++) {
    const inside = step(z), out = end(inside), depth = depthOf(out, inside);
    if (!(depth > INSIDE * scale)) return null;
    const matrix = product(differences(end, inside, Math.min(7e-4 * scale, depth / 5)), differences(step, z, 7e-4 * scale), 2 * m);
    const moved = out.map((value, k) => value - z[k]);
    if (!moved.every(Number.isFinite)) return Infinity;
    if (Math.max(...moved.map(Math.abs)) <= SETTLED * scale) {
      const values = eigenvalues(matrix, 2 * m).filter(([re, im]) => Math.hypot(re - 1, im) > 1e-6);
      return Math.max(0, ...values.map(value => Math.hypot(...value)));
    }
    const change = solve(matrix.map((value, k) => (k % (2 * m + 1) === 0 ? 1 : 0) - value), moved);
    z = z.map((value, k) => value + change[k]);
  }
  return null;
}

// A step's two parts, of positions less those of the rest and h times velocities, of free masses: by the scheme, and its end;
// and the least that the end has moved a mass in contact.
function stepOnObstacles(system, linear, scheme, h) {
  const {F, I, at} = linear.memory, {n, d} = at, places = coordinates(linear), m = places.length;
  const own = {F: F.slice(), I, at, angular: linear.memory.angular}, once = onceBy(scheme, own, h);
  const put = z => {
    own.F.set(linear.rest, at.x); own.F.fill(0, at.v, at.v + n * d);
    places.forEach((place, k) => { own.F[at.x + place] += z[k]; own.F[at.v + place] = z[m + k] / h; });
  };
  const got = () => Float64Array.from({length: 2 * m}, (_, k) =>
    k < m ? own.F[at.x + places[k]] - linear.rest[places[k]] : h * own.F[at.v + places[k - m]]);
  const step = z => { put(z); once(); return got(); };
  const end = z => { put(z); for (const {kind, values} of system.obstacles) for (const {mass} of linear.contacts) obstacles[kind](own.F, at.x, at.v, mass, true, values); return got(); };
  const depth = (out, inside) => Math.min(...linear.contacts.map(({mass}) => movedBy(out, inside, places, d, mass)));
  return {step, end, depth, m};
}

// Whether a step from rest ends inside obstacles, for their rule to hold masses there.
function isPressed(system, linear, scheme, h) {
  const {step, end, depth, m} = stepOnObstacles(system, linear, scheme, h), inside = step(new Float64Array(2 * m));
  return depth(end(inside), inside) > INSIDE * shortestRestLength(linear.memory);
}

// How far the end of a step has moved a mass.
function movedBy(out, inside, places, d, mass) {
  const first = places.indexOf(d * mass);
  let squares = 0;
  for (let axis = 0; axis < d; axis++) squares += (out[first + axis] - inside[first + axis]) ** 2;
  return Math.sqrt(squares);
}

// Central differences of fourth order, a matrix row by row.
function differences(f, z, small) {
  const size = z.length, matrix = new Float64Array(size * size);
  for (let column = 0; column < size; column++) {
    const after = part => { const moved = z.slice(); moved[column] += part * small; return f(moved); };
    const [near, back, far, farBack] = [after(1), after(-1), after(2), after(-2)];
    for (let row = 0; row < size; row++) {
      matrix[row * size + column] = (8 * (near[row] - back[row]) - (far[row] - farBack[row])) / (12 * small);
    }
  }
  return matrix;
}

function product(a, b, size) {
  const c = new Float64Array(size * size);
  for (let i = 0; i < size; i++) for (let k = 0; k < size; k++) {
    const factor = a[i * size + k];
    if (factor !== 0) for (let j = 0; j < size; j++) c[i * size + j] += factor * b[k * size + j];
  }
  return c;
}

// A x = b by elimination with exchanges of rows; what has no pivot stays where it is.
function solve(a, b) {
  const size = b.length, x = Float64Array.from(b), scale = Math.max(...a.map(Math.abs));
  const free = [];
  for (let k = 0; k < size; k++) {
    let pivot = k;
    for (let i = k + 1; i < size; i++) if (Math.abs(a[i * size + k]) > Math.abs(a[pivot * size + k])) pivot = i;
    if (Math.abs(a[pivot * size + k]) < 1e-10 * scale) { free.push(k); continue; }
    for (let j = 0; j < size; j++) [a[k * size + j], a[pivot * size + j]] = [a[pivot * size + j], a[k * size + j]];
    [x[k], x[pivot]] = [x[pivot], x[k]];
    for (let i = k + 1; i < size; i++) {
      const factor = a[i * size + k] / a[k * size + k];
      for (let j = k; j < size; j++) a[i * size + j] -= factor * a[k * size + j];
      x[i] -= factor * x[k];
    }
  }
  for (let k = size - 1; k >= 0; k--) {
    if (free.includes(k)) { x[k] = 0; continue; }
    for (let j = k + 1; j < size; j++) x[k] -= a[k * size + j] * x[j];
    x[k] /= a[k * size + k];
  }
  return x;
}

// The limit of a scheme about a rest on obstacles; null, with the reason, where its steps have no rest there, or where what
// damping takes in a step is less than can be told.
function limitOnObstacles(system, linear, scheme, fastest) {
  if (growthOnObstacles(system, linear, scheme, 0.3 / fastest) === null) return {limit: null, reason: "no rest"};
  const grows = h => growthOnObstacles(system, linear, scheme, h) ?? Infinity;
  // where two eigenvalues meet differences tell half of the figures
  const seen = 1e-6, between = (low, high, most) => {
    for (let k = 0; k < 34; k++) { const middle = (low + high) / 2; if (grows(middle) > most) high = middle; else low = middle; }
    return low;
  };
  const unseen = linear.damped || linear.drag ? {limit: null, reason: "slow"} : {limit: 0};
  let low = 0;
  for (let h = 2e-3 / fastest; h < 10 / fastest; h *= h * fastest < 0.5 ? 1.4 : 1.06) {
    if (grows(h) > 1 + seen) {
      if (low === 0) return unseen;
      if (grows(low) < 1 - seen) return {limit: between(low, h, 1)};
      const limit = between(low, h, 1 + seen);
      // growth that rises slowly has begun before, unseen
      return grows(1.1 * limit) > 1 + 100 * seen ? {limit} : unseen;
    }
    low = h;
  }
  return {limit: Infinity};
}
