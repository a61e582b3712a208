// Eigenvalues: the largest of a symmetric operator (Lanczos), all of a small real matrix (QR).

// A row of numbers that looks random, the same every time.
function pseudoRandom(count, seed = 1) {
  const values = new Float64Array(count);
  for (let i = 0, state = seed; i < count; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    values[i] = state / 2 ** 32 - 0.5;
  }
  return values;
}

const dot = (a, b) => { let sum = 0; for (let i = 0; i < a.length; i++) sum += a[i] * b[i]; return sum; };

// Lanczos's method with all vectors kept orthogonal (Parlett, The Symmetric Eigenvalue Problem (1998), 13): the largest
// eigenvalue and its vector. `apply` writes A q to its second argument.
function largestEigenpair(apply, m, start = pseudoRandom(m), most = 160) {
  const basis = [], alpha = [], beta = [], w = new Float64Array(m);
  let q = Float64Array.from(start), norm = Math.sqrt(dot(q, q)), before = -Infinity;
  for (let k = 0; k < Math.min(m, most); k++) {
    q = q.map(value => value / norm);
    basis.push(q);
    apply(q, w);
    alpha.push(dot(q, w));
    for (let round = 0; round < 2; round++) {
      for (const known of basis) {
        const part = dot(known, w);
        for (let i = 0; i < m; i++) w[i] -= part * known[i];
      }
    }
    norm = Math.sqrt(dot(w, w));
    beta.push(norm);
    const scale = Math.max(...alpha.map(Math.abs), 1e-300);
    if (norm < 1e-13 * scale) break;
    if (k % 10 === 9) {
      const now = largestOfTridiagonal(alpha, beta);
      if (k > 40 && Math.abs(now - before) < 1e-15 * Math.abs(now)) break;
      before = now;
    }
    q = w.slice();
  }
  const value = largestOfTridiagonal(alpha, beta), weights = vectorOfTridiagonal(alpha, beta, value);
  const vector = new Float64Array(m);
  basis.forEach((known, k) => { for (let i = 0; i < m; i++) vector[i] += weights[k] * known[i]; });
  const length = Math.sqrt(dot(vector, vector));
  return {value, vector: vector.map(entry => entry / length)};
}

// By counting eigenvalues above a number (Sturm), halving; beta[k] joins k and k + 1, the last is not in the matrix.
function largestOfTridiagonal(alpha, beta) {
  const reach = Math.max(...alpha.map((a, k) => Math.abs(a) + Math.abs(beta[k]) + Math.abs(beta[k - 1] || 0)));
  let low = -reach, high = reach;
  const someAbove = number => {
    let pivot = 1;
    for (let k = 0; k < alpha.length; k++) {
      pivot = number - alpha[k] - (k ? beta[k - 1] ** 2 / pivot : 0);
      if (pivot <= 0) return true;
    }
    return false;
  };
  for (let round = 0; round < 200 && high - low > 2 ** -52 * Math.abs(high); round++) {
    const middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    if (someAbove(middle)) low = middle; else high = middle;
  }
  return high;
}

// By inverse iteration: (T - value) y = y, twice, by elimination from the top.
function vectorOfTridiagonal(alpha, beta, value) {
  const size = alpha.length;
  let y = new Array(size).fill(1);
  const shift = value * (1 + 1e-12) + 1e-300;
  for (let round = 0; round < 3; round++) {
    const pivots = [], right = y.slice();
    for (let k = 0; k < size; k++) {
      pivots[k] = shift - alpha[k] - (k ? beta[k - 1] ** 2 / pivots[k - 1] : 0) || 1e-300;
      if (k) right[k] += beta[k - 1] / pivots[k - 1] * right[k - 1];
    }
    for (let k = size - 1; k >= 0; k--) y[k] = (right[k] + (k < size - 1 ? beta[k] * y[k + 1] : 0)) / pivots[k];
    const length = Math.hypot(...y);
    y = y.map(entry => entry / length);
  }
  return y;
}

// All eigenvalues [re, im] of a real matrix, its rows one after the other, which is written to: reduced to Hessenberg's
// form by elimination, then by Francis's double steps (Wilkinson and Reinsch, Handbook (1971), II/12 and II/14).
function eigenvalues(a, n) {
  const at = (i, j) => i * n + j;
  for (let k = 1; k < n - 1; k++) {
    let pivot = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(a[at(i, k - 1)]) > Math.abs(a[at(pivot, k - 1)])) pivot = i;
    const top = a[at(pivot, k - 1)];
    if (top === 0) continue;
    if (pivot !== k) {
      for (let j = k - 1; j < n; j++) [a[at(pivot, j)], a[at(k, j)]] = [a[at(k, j)], a[at(pivot, j)]];
      for (let i = 0; i < n; i++) [a[at(i, pivot)], a[at(i, k)]] = [a[at(i, k)], a[at(i, pivot)]];
    }
    for (let i = k + 1; i < n; i++) {
      const factor = a[at(i, k - 1)] / top;
      if (factor === 0) continue;
      a[at(i, k - 1)] = 0;
      for (let j = k; j < n; j++) a[at(i, j)] -= factor * a[at(k, j)];
      for (let row = 0; row < n; row++) a[at(row, k)] += factor * a[at(row, i)];
    }
  }
  return ofHessenberg(a, n, at);
}

function ofHessenberg(a, n, at) {
  const found = [];
  let norm = 0;
  for (let i = 0; i < n; i++) for (let j = Math.max(i - 1, 0); j < n; j++) norm += Math.abs(a[at(i, j)]);
  let end = n - 1, shifted = 0, rounds = 0;
  while (end >= 0) {
    let l = end;
    for (; l > 0; l--) {
      const size = Math.abs(a[at(l - 1, l - 1)]) + Math.abs(a[at(l, l)]) || norm;
      if (Math.abs(a[at(l, l - 1)]) < 2 ** -53 * size) { a[at(l, l - 1)] = 0; break; }
    }
    let x = a[at(end, end)];
    if (l === end) { found.push([x + shifted, 0]); end--; rounds = 0; continue; }
    let y = a[at(end - 1, end - 1)], w = a[at(end, end - 1)] * a[at(end - 1, end)];
    if (l === end - 1) { found.push(...ofTwo(x + shifted, y + shifted, w)); end -= 2; rounds = 0; continue; }
    if (rounds === 90) return found.concat(Array.from({length: end + 1}, () => [NaN, NaN]));
    if (rounds % 10 === 9) {
      shifted += x;
      for (let i = 0; i <= end; i++) a[at(i, i)] -= x;
      const size = Math.abs(a[at(end, end - 1)]) + Math.abs(a[at(end - 1, end - 2)]);
      x = y = 0.75 * size; w = -0.4375 * size * size;
    }
    rounds++;
    francisStep(a, n, at, l, end, x, y, w);
  }
  return found;
}

function ofTwo(x, y, w) {
  const p = (y - x) / 2, q = p * p + w, root = Math.sqrt(Math.abs(q));
  if (q < 0) return [[x + p, root], [x + p, -root]];
  const z = p + (p < 0 ? -root : root);
  return [[x + z, 0], [z ? x - w / z : x + z, 0]];
}

function francisStep(a, n, at, l, end, x, y, w) {
  let p, q, r, m;
  for (m = end - 2; m >= l; m--) {
    const z = a[at(m, m)], u = x - z, v = y - z;
    p = (u * v - w) / a[at(m + 1, m)] + a[at(m, m + 1)]; q = a[at(m + 1, m + 1)] - z - u - v; r = a[at(m + 2, m + 1)];
    const size = Math.abs(p) + Math.abs(q) + Math.abs(r);
    p /= size; q /= size; r /= size;
    if (m === l) break;
    const small = Math.abs(a[at(m, m - 1)]) * (Math.abs(q) + Math.abs(r));
    const sum = Math.abs(a[at(m - 1, m - 1)]) + Math.abs(z) + Math.abs(a[at(m + 1, m + 1)]);
    if (small < 2 ** -53 * Math.abs(p) * sum) break;
  }
  for (let i = m + 2; i <= end; i++) { a[at(i, i - 2)] = 0; if (i > m + 2) a[at(i, i - 3)] = 0; }
  for (let k = m; k < end; k++) {
    const last = k === end - 1;
    let size = 1;
    if (k !== m) {
      p = a[at(k, k - 1)]; q = a[at(k + 1, k - 1)]; r = last ? 0 : a[at(k + 2, k - 1)];
      size = Math.abs(p) + Math.abs(q) + Math.abs(r);
      if (size === 0) continue;
      p /= size; q /= size; r /= size;
    }
    const s = (p < 0 ? -1 : 1) * Math.sqrt(p * p + q * q + r * r);
    if (k === m) { if (l !== m) a[at(k, k - 1)] *= -1; } else a[at(k, k - 1)] = -s * size;
    p += s;
    const f = p / s, g = q / s, h = r / s;
    q /= p; r /= p;
    for (let j = k; j < n; j++) {
      const sum = a[at(k, j)] + q * a[at(k + 1, j)] + (last ? 0 : r * a[at(k + 2, j)]);
      a[at(k, j)] -= sum * f; a[at(k + 1, j)] -= sum * g;
      if (!last) a[at(k + 2, j)] -= sum * h;
    }
    for (let i = 0; i <= Math.min(end, k + 3); i++) {
      const sum = f * a[at(i, k)] + g * a[at(i, k + 1)] + (last ? 0 : h * a[at(i, k + 2)]);
      a[at(i, k)] -= sum; a[at(i, k + 1)] -= sum * q;
      if (!last) a[at(i, k + 2)] -= sum * r;
    }
  }
}
