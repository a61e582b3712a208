// A small part of NumPy: arrays of doubles, row by row, with the operations that schemes use, in NumPy's order.

class Nd {
  constructor(shape, data, mask = false) { Object.assign(this, {shape, data, mask}); }
  get T() {
    const [rows, columns] = this.shape, made = nd.zeros([columns, rows]);
    for (let i = 0; i < rows; i++) for (let j = 0; j < columns; j++) made.data[rows * j + i] = this.data[columns * i + j];
    return made;
  }
  *[Symbol.iterator]() { for (let i = 0; i < this.shape[0]; i++) yield nd.at(this, i); }
  any() { return this.data.some(value => value !== 0); }
  max({initial = -Infinity} = {}) { return this.data.reduce((most, value) => value > most || value !== value ? value : most, initial); }
  copy() { return new Nd(this.shape, Float64Array.from(this.data)); }
  ravel() { return new Nd([this.data.length], this.data); }
  repeat(times) { return nd.repeat(this, times); }
  reshape(...given) {
    const shape = given.flat(), known = shape.reduce((all, one) => one < 0 ? all : all * one, 1);
    return new Nd(shape.map(one => one < 0 ? this.data.length / known : one), this.data);
  }
}

const nd = (() => {
  const ALL = Symbol("all"), size = shape => shape.reduce((all, one) => all * one, 1);
  const zeros = shape => { const whole = [shape].flat(); return new Nd(whole, new Float64Array(size(whole))); };

  // The shape that two are spread over, and where the entries of one stand along each axis of it: 0 where it is spread.
  const spreadOver = (one, other) => Array.from({length: Math.max(one.length, other.length)}, (_, k, most = Math.max(one.length, other.length)) =>
    Math.max(one[k - most + one.length] ?? 1, other[k - most + other.length] ?? 1));
  const strides = (shape, whole) => {
    const found = new Array(whole.length).fill(0);
    for (let k = shape.length - 1, stride = 1; k >= 0; stride *= shape[k--]) if (shape[k] > 1) found[k + whole.length - shape.length] = stride;
    return found;
  };
  const same = (one, other) => one.length === other.length && one.every((value, k) => value === other[k]);

  function each(f, one, other, mask) {
    if (!(other instanceof Nd)) return new Nd(one.shape, Float64Array.from(one.data, value => f(value, other)), mask);
    if (!(one instanceof Nd)) return new Nd(other.shape, Float64Array.from(other.data, value => f(one, value)), mask);
    const a = one.data, b = other.data;
    if (same(one.shape, other.shape)) return new Nd(one.shape, Float64Array.from(a, (value, k) => f(value, b[k])), mask);
    const shape = spreadOver(one.shape, other.shape), made = zeros(shape), [p, q] = [strides(one.shape, shape), strides(other.shape, shape)];
    made.data.forEach((_, e) => {
      let i = 0, j = 0;
      for (let k = shape.length - 1, left = e; k >= 0; left = Math.floor(left / shape[k--])) { i += p[k] * (left % shape[k]); j += q[k] * (left % shape[k]); }
      made.data[e] = f(a[i], b[j]);
    });
    return new Nd(shape, made.data, mask);
  }
  // An operation of numbers or arrays; of what is more than an array by its own method.
  const operation = (f, own, reversed) => (one, other) => {
    if (typeof one === "number" && typeof other === "number") return f(one, other);
    if (one && one[own]) return one[own](other);
    if (other && other[reversed]) return other[reversed](one);
    return each(f, one, other, false);
  };
  const comparison = f => (one, other) => one instanceof Nd || other instanceof Nd ? each((a, b) => f(a, b) ? 1 : 0, one, other, true) : f(one, other);
  const function_ = f => value => value instanceof Nd ? new Nd(value.shape, Float64Array.from(value.data, f)) : f(value);

  // Rows, of a mask or of numbers; entries; or all of an axis, and a new one of one entry.
  function at(from, ...places) {
    const [first] = places;
    if (Array.isArray(from)) return from[first < 0 ? from.length + first : first];
    if (places.includes(ALL)) return new Nd(places.map((place, k) => place === null ? 1 : from.shape[k]), from.data);
    if (first instanceof Nd) return rows(from, first.mask ? chosen(first) : first.data);
    const {shape, data} = from, place = placeOf(shape, places);
    if (places.length === shape.length) return data[place];
    const rest = shape.slice(places.length), width = size(rest);
    return new Nd(rest, data.subarray(width * place, width * (place + 1)));
  }
  const placeOf = (shape, places) => { let place = 0; for (let k = 0; k < places.length; k++) place = place * shape[k] + places[k]; return place; };
  const chosen = mask => { const found = []; mask.data.forEach((value, i) => { if (value) found.push(i); }); return found; };
  function rows({shape, data}, which) {
    const width = size(shape.slice(1)), made = zeros([which.length, ...shape.slice(1)]);
    which.forEach((i, k) => made.data.set(data.subarray(width * i, width * (i + 1)), width * k));
    return made;
  }
  function put(into, value, ...places) {
    const [first] = places, {shape, data} = into;
    if (first instanceof Nd) {
      const width = size(shape.slice(1));
      return void chosen(first).forEach((i, k) => data.set(value.data.subarray(width * k, width * (k + 1)), width * i));
    }
    const place = placeOf(shape, places);
    if (places.length === shape.length) data[place] = value;
    else data.set(value.data, place * value.data.length);
  }

  return {
    ALL, zeros, at, put,
    plus: operation((a, b) => a + b, "__add__"), minus: operation((a, b) => a - b), times: operation((a, b) => a * b, "__mul__", "__rmul__"),
    over: operation((a, b) => a / b), power: operation((a, b) => b === 2 ? a * a : a ** b), matmul: (matrix, vector) => matrix.times(vector),
    less: comparison((a, b) => a < b), greater: comparison((a, b) => a > b), most: comparison((a, b) => a <= b), least: comparison((a, b) => a >= b),
    equal: comparison((a, b) => a === b), and: comparison((a, b) => Boolean(a && b)), invert: mask => new Nd(mask.shape, Float64Array.from(mask.data, a => a ? 0 : 1), true),
    negative: value => value instanceof Nd ? function_(a => -a)(value) : -value,
    abs: function_(Math.abs), exp: function_(Math.exp), expm1: function_(Math.expm1), sqrt: function_(Math.sqrt),
    truth: value => Array.isArray(value) ? value.length > 0 : Boolean(value),
    len: value => Array.isArray(value) ? value.length : value.shape[0],
    full: (shape, value) => { const made = zeros(shape); made.data.fill(value); return made; },
    zeros_like: like => zeros(like.shape), ones_like: like => nd.full(like.shape, 1),
    repeat: ({data}, times) => new Nd([data.length * times], Float64Array.from({length: data.length * times}, (_, k) => data[Math.floor(k / times)])),
    vdot: (one, other) => one.data.reduce((sum, value, k) => sum + value * other.data[k], 0),
    where: (when, one, other) => new Nd(when.shape, Float64Array.from(when.data, (yes, k) => { const from = yes ? one : other; return from instanceof Nd ? from.data[k] : from; })),
    divide: (one, other, {out, where}) => new Nd(out.shape, Float64Array.from(out.data, (value, k) => where.data[k] ? one / other.data[k] : value)),
    linalg: {
      norm: ({shape: [count, d], data}) => new Nd([count], Float64Array.from({length: count}, (_, j) => {
        let squares = 0;
        for (let e = d * j; e < d * (j + 1); e++) squares += data[e] * data[e];
        return Math.sqrt(squares);
      })),
    },
    // Halves to even, as NumPy rounds.
    rint: value => { const near = Math.round(value); return Math.abs(value - Math.trunc(value)) === 0.5 && near % 2 !== 0 ? near - 1 : near; },
  };
})();
