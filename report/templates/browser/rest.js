// Where a system comes to rest, and its equations of motion there, linearised: M q'' + C q' + K q = 0.

// What springs and masses do to small moves of the free masses about positions x (in F): each spring's direction, its
// stiffness along and across. Of contacts, moves along the normal are none.
function linearise(memory, rest, contacts = []) {
  const {F, I, at} = memory, {n, s, d} = at, size = n * d;
  const unit = new Float64Array(s * d), along = new Float64Array(s), across = new Float64Array(s), slowed = new Float64Array(s);
  const linear = {memory, rest, unit, along, across, slowed, contacts, size};
  for (let j = 0; j < s; j++) {
    const a = I[at.springs + 2 * j], b = I[at.springs + 2 * j + 1];
    let squares = 0;
    for (let axis = 0; axis < d; axis++) {
      unit[d * j + axis] = rest[d * b + axis] - rest[d * a + axis];
      squares += unit[d * j + axis] ** 2;
    }
    const length = Math.sqrt(squares), stretch = length - F[at.rest_lengths + j], k = F[at.stiffness + j];
    if (at.nonlinear && atCorner(memory, j, stretch)) linear.corner = j;
    const divisor = length === 0 && F[at.rest_lengths + j] === 0 ? 1 : length;
    for (let axis = 0; axis < d; axis++) unit[d * j + axis] /= divisor;
    along[j] = at.nonlinear ? ofSpring(tangent_stiffness, memory, j, stretch) : law.force_by_stretch(k, stretch);
    const secant = at.nonlinear ? ofSpring(secant_stiffness, memory, j, stretch) : k;
    across[j] = divisor === length ? law.spring_force(secant, stretch, 0, 0) / length : secant;
    slowed[j] = law.force_by_rate(at.nonlinear ? ofSpring(damping_at, memory, j, stretch) : F[at.damping + j]);
  }
  const root = new Float64Array(size), free = [];
  for (let i = 0; i < n; i++) {
    if (!I[at.fixed + i]) free.push(i);
    root.fill(I[at.fixed + i] ? 0 : 1 / Math.sqrt(F[at.masses + i]), d * i, d * (i + 1));
  }
  Object.assign(linear, {root, free});
  linear.damped = slowed.some(value => value > 0);
  linear.drag = F[at.drag];
  if (memory.angular) linear.angles = bendingDerivatives(memory.angular, d, Float64Array.from(rest)).data;
  return linear;
}

// Whether no linear spring does the same near a stretch, as in reference/springs/nonlinear_law.py (`tangent_system`): it is
// where the spring goes slack or yields, or beyond that.
function atCorner(memory, j, stretch) {
  const {F, at} = memory, near = 1e-9 * F[at.rest_lengths + j], k = F[at.stiffness + j], most = F[at.largest_force + j];
  const oneSided = (F[at.tension_only + j] || F[at.compression_only + j]) && k > 0;
  const [tangent, secant] = [tangent_stiffness, secant_stiffness].map(part => ofSpring(part, memory, j, stretch));
  return (oneSided && Math.abs(stretch) <= near) || (most < Infinity && Math.abs(k * Math.abs(stretch) - most) <= k * near) || (tangent === 0 && secant !== 0);
}

// Moves without their parts along the normals of contacts; of fixed masses none.
function alongSurfaces({memory: {I, at}, contacts}, moves) {
  const {d} = at;
  for (let i = 0; i < at.n; i++) if (I[at.fixed + i]) moves.fill(0, d * i, d * (i + 1));
  for (const {mass, normal} of contacts) {
    let part = 0;
    for (let axis = 0; axis < d; axis++) part += normal[axis] * moves[d * mass + axis];
    for (let axis = 0; axis < d; axis++) moves[d * mass + axis] -= part * normal[axis];
  }
  return moves;
}

// The force against small moves: K q (along, across) or C q (slowed along, the drag besides), written to `out`.
function resist({memory: {I, F, at, angular}, unit, angles}, along, across, drag, q, out) {
  const {s, d} = at;
  for (let e = 0; e < out.length; e++) out[e] = drag * q[e];
  for (let j = 0; j < s; j++) {
    const a = I[at.springs + 2 * j], b = I[at.springs + 2 * j + 1];
    let stretch = 0;
    for (let axis = 0; axis < d; axis++) stretch += unit[d * j + axis] * (q[d * b + axis] - q[d * a + axis]);
    const aside = across ? across[j] : 0;
    for (let axis = 0; axis < d; axis++) {
      const force = (along[j] - aside) * stretch * unit[d * j + axis] + aside * (q[d * b + axis] - q[d * a + axis]);
      out[d * a + axis] -= force; out[d * b + axis] += force;
    }
  }
  if (angles && across) addBending(angular, angles, d, q, (i, axis, force) => { out[d * i + axis] -= force; });
  return out;
}

// K or C between roots of masses, of vectors of all masses; zero where nothing moves.
function scaled(linear, which) {
  const q = new Float64Array(linear.size);
  return (y, out) => {
    for (let e = 0; e < linear.size; e++) q[e] = linear.root[e] * y[e];
    alongSurfaces(linear, q);
    if (which === "stiffness") resist(linear, linear.along, linear.across, 0, q, out);
    else if (which === "drag") for (let e = 0; e < linear.size; e++) out[e] = linear.drag * q[e];
    else resist(linear, linear.slowed, null, which === "springs" ? 0 : linear.drag, q, out);
    alongSurfaces(linear, out);
    for (let e = 0; e < linear.size; e++) out[e] *= linear.root[e];
    return out;
  };
}

// What springs must carry at rest [N]: the weight of what is held; of what nothing holds, what drag leaves of it.
function loads({F, I, at}, contacts) {
  const {n, s, d} = at, part = Int32Array.from({length: n}, (_, i) => i);
  const first = i => { while (part[i] !== i) i = part[i] = part[part[i]]; return i; };
  const held = new Uint8Array(n), count = new Int32Array(n), sum = new Float64Array(n);
  const ends = j => [I[at.springs + 2 * j], I[at.springs + 2 * j + 1]];
  const joins = j => F[at.stiffness + j] > 0;
  for (let j = 0; j < s; j++) {
    const [a, b] = ends(j);
    if (joins(j) && !I[at.fixed + a] && !I[at.fixed + b]) part[first(a)] = first(b);
  }
  for (let j = 0; j < s; j++) {
    const [a, b] = ends(j);
    if (joins(j) && I[at.fixed + a] !== I[at.fixed + b]) held[first(I[at.fixed + a] ? b : a)] = 1;
  }
  for (const {mass} of contacts) held[first(mass)] = 1;
  for (let i = 0; i < n; i++) { count[first(i)]++; sum[first(i)] += F[at.masses + i]; }
  const carried = new Float64Array(n * d);
  for (let i = 0; i < n; i++) {
    const own = F[at.masses + i], p = first(i);
    const mass = held[p] ? own : F[at.drag] > 0 ? own - sum[p] / count[p] : 0;
    if (!I[at.fixed + i]) for (let axis = 0; axis < d; axis++) carried[d * i + axis] = mass * F[at.gravity + axis];
  }
  return carried;
}

// The rest near a first guess, by Newton's method with conjugate gradients, downhill in energy; `off` is the largest
// force that is left [N]. (Nocedal and Wright, Numerical Optimization (2006), 7.1.)
function equilibrium(memory, guess, contacts = []) {
  const {F, I, at} = memory, {n, s, d} = at, size = n * d, carried = loads(memory, contacts);
  let x = Float64Array.from(guess);
  const largest = Math.max(...carried.map(Math.abs), ...Array.from({length: s}, (_, j) => F[at.stiffness + j] * F[at.rest_lengths + j] * 1e-6), 1e-300);
  const energyAt = y => {
    let sum = bentEnergy(memory, y);
    for (let e = 0; e < size; e++) sum -= carried[e] * y[e];
    for (let j = 0; j < s; j++) {
      const a = I[at.springs + 2 * j], b = I[at.springs + 2 * j + 1];
      let squares = 0;
      for (let axis = 0; axis < d; axis++) squares += (y[d * b + axis] - y[d * a + axis]) ** 2;
      sum += energyOf(memory, j, Math.sqrt(squares) - F[at.rest_lengths + j]);
    }
    return sum;
  };
  let off = Infinity;
  for (let round = 0; round < 60; round++) {
    const linear = linearise(memory, x, contacts), force = carried.slice();
    for (let j = 0; j < s; j++) {
      const a = I[at.springs + 2 * j], b = I[at.springs + 2 * j + 1];
      let length = 0;
      for (let axis = 0; axis < d; axis++) length += linear.unit[d * j + axis] * (x[d * b + axis] - x[d * a + axis]);
      for (let axis = 0; axis < d; axis++) {
        const pull = linear.across[j] * length * linear.unit[d * j + axis];
        force[d * a + axis] += pull; force[d * b + axis] -= pull;
      }
    }
    if (memory.angular) bendingForces(memory, x).forEach((value, e) => { force[e] += value; });
    alongSurfaces(linear, force);
    off = Math.max(...force.map(Math.abs), 0);
    if (off <= 1e-11 * largest) break;
    const move = newtonMove(linear, force);
    const before = energyAt(x), slope = dot(force, move);
    let part = 1, next = x;
    for (; part > 1e-6; part /= 2) {
      next = x.map((value, e) => value + part * move[e]);
      if (energyAt(next) <= before - 1e-4 * part * slope + 1e-13 * Math.abs(before)) break;
    }
    x = next;
  }
  return {x, off: off / largest};
}

// K q = force by conjugate gradients, until they meet a direction that is not stiff.
function newtonMove(linear, force) {
  const size = linear.size, q = new Float64Array(size), out = new Float64Array(size);
  const r = force.slice(), p = force.slice(), begin = dot(r, r);
  let now = begin;
  for (let k = 0; k < 4 * size && now > 1e-26 * begin; k++) {
    resist(linear, linear.along, linear.across, 0, p, out);
    alongSurfaces(linear, out);
    const curvature = dot(p, out);
    if (curvature <= 1e-14 * dot(p, p)) return k ? q : p;
    const step = now / curvature;
    for (let e = 0; e < size; e++) { q[e] += step * p[e]; r[e] -= step * out[e]; }
    const next = dot(r, r), turn = next / now;
    for (let e = 0; e < size; e++) p[e] = r[e] + turn * p[e];
    now = next;
  }
  return q;
}
