// (M - B) v = M r for velocities v, as reference/assembly.py has it: from ITERATE_FROM unknowns on first by iteration, else
// and where that takes too long by elimination. Both leave rounding; the order of their sums is the page's own.

function solveVelocities(system, blocks, right) {
  const {dimension: d, fixed, masses} = system, n = masses.data.length, moved = Float64Array.from(right.data);
  let unknowns = 0;
  for (let i = 0; i < n; i++) {
    if (!fixed.data[i]) unknowns += d;
    for (let e = d * i; e < d * (i + 1); e++) moved[e] = fixed.data[i] ? 0 : moved[e] * masses.data[i];
  }
  const matrix = matrixOf(system, blocks);
  const found = (unknowns >= SOLVER.ITERATE_FROM && !matrix.bends && byIteration(matrix, moved)) || byElimination(matrix, moved);
  return new Nd(right.shape, found);
}

// M - B: blocks of springs at pairs of masses, blocks of springs that bend at threes, and what masses have each.
function matrixOf(system, blocks) {
  const {dimension: d, masses, fixed, springs, angular} = system;
  const weights = Float64Array.from(masses.data, (mass, i) => mass + blocks.masses.data[i]);
  return {d, n: weights.length, fixed: fixed.data, springs: springs.data, weights, blocks: blocks.springs.data, system, bends: angular && blocks.angles.data.length > 1, angular, angles: blocks.angles.data};
}

// A v, for fixed masses without springs.
function multiplied({d, n, fixed, springs, weights, blocks, bends, angular, angles}, v, out) {
  for (let i = 0; i < n; i++) for (let e = d * i; e < d * (i + 1); e++) out[e] = weights[i] * v[e];
  for (let j = 0; j < springs.length / 2; j++) {
    const a = springs[2 * j], b = springs[2 * j + 1];
    for (let axis = 0; axis < d; axis++) {
      let force = 0;
      for (let other = 0; other < d; other++) force += blocks[d * d * j + d * axis + other] * (v[d * b + other] - v[d * a + other]);
      if (!fixed[a]) out[d * a + axis] -= force;
      if (!fixed[b]) out[d * b + axis] += force;
    }
  }
  if (bends) addBending(angular, angles, d, v, (i, axis, force) => { if (!fixed[i]) out[d * i + axis] -= force; });
  return out;
}

// What angular springs' derivatives by their arms make of moves q of masses: the force on each mass and axis.
function addBending(angular, angles, d, q, add) {
  const size = 2 * d, arms = new Float64Array(size);
  for (let k = 0; k < angular.masses.length / 3; k++) {
    const [a, b, c] = angular.masses.subarray(3 * k, 3 * k + 3);
    for (let axis = 0; axis < d; axis++) { arms[axis] = q[d * a + axis] - q[d * b + axis]; arms[d + axis] = q[d * c + axis] - q[d * b + axis]; }
    for (let row = 0; row < size; row++) {
      let force = 0;
      for (let column = 0; column < size; column++) force += angles[size * size * k + size * row + column] * arms[column];
      add(row < d ? a : c, row % d, force); add(b, row % d, -force);
    }
  }
}

// BiCGSTAB (van der Vorst 1992), the diagonal before it; null where ROUNDS are too few.
function byIteration(matrix, right) {
  const {d, n, springs, weights, blocks} = matrix, size = n * d, diagonal = Float64Array.from({length: size}, (_, e) => weights[Math.floor(e / d)]);
  springs.forEach((i, end) => { for (let axis = 0; axis < d; axis++) diagonal[d * i + axis] += blocks[d * d * (end >> 1) + (d + 1) * axis]; });
  const scale = Math.sqrt(dot(right, right)) || 1, b = right.map(value => value / scale);
  const x = new Float64Array(size), r = b.slice(), shadow = b.slice(), p = new Float64Array(size), v = new Float64Array(size);
  const before = new Float64Array(size), t = new Float64Array(size), guess = q => { for (let e = 0; e < size; e++) before[e] = q[e] / diagonal[e]; return before; };
  let rho = 1, alpha = 1, omega = 1;
  const left = () => { multiplied(matrix, x, t); let squares = 0; for (let e = 0; e < size; e++) squares += (t[e] - b[e]) ** 2; return Math.sqrt(squares); };
  for (let round = 0; round < SOLVER.ROUNDS && dot(r, r) > (SOLVER.REMAINDER / 10) ** 2; round++) {
    const next = dot(shadow, r), turn = round ? next / rho * alpha / omega : 0;
    for (let e = 0; e < size; e++) p[e] = r[e] + (round ? turn * (p[e] - omega * v[e]) : 0);
    rho = next;
    multiplied(matrix, guess(p), v);
    alpha = rho / dot(shadow, v);
    for (let e = 0; e < size; e++) { x[e] += alpha * before[e]; r[e] -= alpha * v[e]; }
    if (dot(r, r) <= (SOLVER.REMAINDER / 10) ** 2) break;
    multiplied(matrix, guess(r), t);
    omega = dot(t, r) / dot(t, t);
    for (let e = 0; e < size; e++) { x[e] += omega * before[e]; r[e] -= omega * t[e]; }
  }
  return left() <= SOLVER.REMAINDER ? x.map(value => scale * value) : null;
}

// By elimination in a band, rows exchanged (Golub and Van Loan, Matrix Computations (2013), 4.3), masses so numbered that
// the band is narrow.
function byElimination(matrix, right) {
  const {d, n, fixed, springs, weights, blocks, bends, angular, angles} = matrix, {place, free, reach} = narrowOrder(matrix);
  const m = d * free.length, b = d * (reach + 1) - 1, width = 3 * b + 1, band = new Float64Array(m * width);
  const add = (i, p, j, q, value) => { const [row, column] = [d * place[i] + p, d * place[j] + q]; band[column * width + row - column + 2 * b] += value; };
  for (const i of free) for (let axis = 0; axis < d; axis++) add(i, axis, i, axis, weights[i]);
  for (let j = 0; j < springs.length / 2; j++) {
    for (const [i, k] of [[springs[2 * j], springs[2 * j + 1]], [springs[2 * j + 1], springs[2 * j]]]) {
      if (fixed[i]) continue;
      for (let p = 0; p < d; p++) for (let q = 0; q < d; q++) {
        const value = blocks[d * d * j + d * p + q];
        add(i, p, i, q, value);
        if (!fixed[k]) add(i, p, k, q, -value);
      }
    }
  }
  if (bends) {
    for (let k = 0; k < angular.masses.length / 3; k++) {
      const [a, middle, c] = angular.masses.subarray(3 * k, 3 * k + 3), size = 2 * d;
      for (let row = 0; row < size; row++) for (let column = 0; column < size; column++) {
        const value = angles[size * size * k + size * row + column], [i, j] = [row < d ? a : c, column < d ? a : c];
        for (const [on, sign] of [[i, -1], [middle, 1]]) for (const [by, way] of [[j, 1], [middle, -1]]) {
          if (!fixed[on] && !fixed[by]) add(on, row % d, by, column % d, sign * way * value);
        }
      }
    }
  }
  const x = new Float64Array(m);
  for (const i of free) for (let axis = 0; axis < d; axis++) x[d * place[i] + axis] = right[d * i + axis];
  eliminate(band, m, b, x);
  const found = new Float64Array(n * d);
  for (const i of free) for (let axis = 0; axis < d; axis++) found[d * i + axis] = x[d * place[i] + axis];
  return found;
}

function eliminate(band, m, b, x) {
  const width = 3 * b + 1, at = (row, column) => column * width + row - column + 2 * b;
  for (let k = 0; k < m; k++) {
    const low = Math.min(m - 1, k + b), far = Math.min(m - 1, k + 2 * b);
    let pivot = k;
    for (let i = k + 1; i <= low; i++) if (Math.abs(band[at(i, k)]) > Math.abs(band[at(pivot, k)])) pivot = i;
    if (!(Math.abs(band[at(pivot, k)]) > 0)) throw new SolverError();
    if (pivot !== k) {
      for (let j = k; j <= far; j++) [band[at(k, j)], band[at(pivot, j)]] = [band[at(pivot, j)], band[at(k, j)]];
      [x[k], x[pivot]] = [x[pivot], x[k]];
    }
    const here = at(k, k);
    for (let i = 1; i <= low - k; i++) { band[here + i] /= band[here]; x[k + i] -= band[here + i] * x[k]; }
    for (let j = k + 1; j <= far; j++) {
      const top = at(k, j), factor = band[top];
      if (factor !== 0) for (let i = 1; i <= low - k; i++) band[top + i] -= band[here + i] * factor;
    }
  }
  for (let k = m - 1; k >= 0; k--) {
    x[k] /= band[at(k, k)];
    for (let i = Math.max(0, k - 2 * b); i < k; i++) x[i] -= band[at(i, k)] * x[k];
  }
}

// Free masses, each at a place near to those it is joined to (Cuthill and McKee 1969); kept while the same are fixed.
function narrowOrder({n, fixed, springs, system, angular}) {
  const held = fixed.join("");
  if (system.order && system.order.held === held) return system.order;
  const near = Array.from({length: n}, () => new Set()), join = (i, j) => { if (i !== j && !fixed[i] && !fixed[j]) { near[i].add(j); near[j].add(i); } };
  for (let j = 0; j < springs.length; j += 2) join(springs[j], springs[j + 1]);
  for (let k = 0; angular && k < angular.masses.length; k += 3) {
    const [a, b, c] = angular.masses.subarray(k, k + 3);
    join(a, b); join(b, c); join(a, c);
  }
  const place = new Int32Array(n).fill(-1), free = [], fewest = (i, j) => near[i].size - near[j].size;
  const from = start => {
    const reached = [start], seen = new Set(reached);
    for (let k = 0; k < reached.length; k++) for (const j of [...near[reached[k]]].sort(fewest)) if (!seen.has(j)) { seen.add(j); reached.push(j); }
    return reached;
  };
  for (const i of Array.from({length: n}, (_, i) => i).filter(i => !fixed[i]).sort(fewest)) {
    if (place[i] >= 0) continue;
    for (const j of from(from(i).at(-1))) { place[j] = free.length; free.push(j); }
  }
  let reach = 0;
  free.forEach(i => near[i].forEach(j => { reach = Math.max(reach, Math.abs(place[i] - place[j])); }));
  return system.order = {held, place, free, reach};
}
