// The plots: energy, how far lanes are apart, and the growth that theory predicts at every dt. A line of them is {k, count,
// at, value}: lane k has so many points, with functions of their numbers for where each is and what it is there.

function plot(id, {lines, low, high, from, to, logarithmic, marks = [], unit, axis}) {
  const of = document.getElementById(id), [width, height] = sizeCanvas(of), on = of.getContext("2d");
  on.clearRect(0, 0, width, height);
  on.font = "12px system-ui, sans-serif";
  const ends = [low, high].map(value => [value, shortNumber(value)]), widest = Math.max(...ends.map(([, text]) => on.measureText(text).width));
  const left = Math.max(52, widest + 8), right = width - 10, bottom = height - 22, top = 8;
  const scale = value => logarithmic ? Math.log10(Math.max(value, 1e-300)) : value;
  const x = value => left + (right - left) * (value - from) / (to - from || 1);
  const y = value => bottom - (bottom - top) * (scale(value) - scale(low)) / (scale(high) - scale(low) || 1);
  on.strokeStyle = on.fillStyle = soft(); on.lineWidth = 1;
  on.beginPath(); on.moveTo(left, top); on.lineTo(left, bottom); on.lineTo(right, bottom); on.stroke();
  on.textAlign = "right"; on.textBaseline = "middle";
  for (const [value, text] of ends) on.fillText(text, left - 4, Math.min(Math.max(y(value), 8), bottom - 4));
  on.textAlign = "left"; on.textBaseline = "alphabetic"; on.fillText(shortNumber(from), left, height - 6);
  on.textAlign = "right"; on.fillText(`${shortNumber(to)} ${axis}`, right, height - 6);
  on.textAlign = "left"; on.textBaseline = "top"; on.fillText(unit, left + 4, top);
  on.save(); on.beginPath(); on.rect(left, top - 2, right - left, bottom - top + 4); on.clip();
  for (const {at, k, label} of marks) {
    on.strokeStyle = k === undefined ? ink() : colourOf(k); on.setLineDash(k === undefined ? [] : [5, 3]); on.lineWidth = 1.5;
    on.beginPath(); on.moveTo(x(at), top); on.lineTo(x(at), bottom); on.stroke(); on.setLineDash([]);
    if (label) { on.fillStyle = ink(); on.textBaseline = "bottom"; on.fillText(label, Math.min(x(at) + 3, right - 28), bottom - 2); }
  }
  for (const {count, at, value, k} of lines) {
    on.strokeStyle = on.fillStyle = colourOf(k); on.lineWidth = 1.8; on.beginPath();
    let last = -1;
    for (let q = 0; q < count; q++) {
      const shown = value(q);
      if (!Number.isFinite(shown)) continue;
      on[last < 0 ? "moveTo" : "lineTo"](x(at(q)), Math.max(-50, Math.min(height + 50, y(shown))));
      last = q;
    }
    on.stroke();
    if (last >= 0 && y(value(last)) >= top && y(value(last)) <= bottom) drawMarker(on, k, x(at(last)), y(value(last)), 3.5);
  }
  on.restore();
}

const shortNumber = value => {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e4 || size < 1e-3 ? value.toExponential(0).replace("e+", "e") : String(+value.toPrecision(3));
};

function drawPlots() { for (const one of PLOTS) one(); }

// While it runs one of them is drawn at a time, so that no frame is long.
let nextPlot = 0;
const drawNextPlot = () => PLOTS[nextPlot++ % PLOTS.length]();

const until = () => Math.max(laneTime(), lab.scene.duration);

function drawEnergy() {
  const rows = lab.series, first = rows.length ? rows[0].energy.find(Number.isFinite) || 0 : 0;
  const given = Math.max(lab.lanes[0].world.given, 1e-9);
  // of stiff scenes what is exchanged is a small part of what would blow them up: the scale is the curves' own
  let most = 0;
  for (const {energy} of rows) for (const value of energy) if (Number.isFinite(value)) most = Math.max(most, Math.min(20 * given, Math.abs(value - first)));
  if (!(most > 1e-15 * given)) most = given;  // before the first step
  const lines = lab.lanes.map((lane, k) => ({k, count: rows.length, at: q => rows[q].time, value: q => rows[q].energy[k] - first}));
  plot("energy", {lines, low: -most, high: most, from: 0, to: until(), unit: "J", axis: "s"});
}

// How far each lane is from the first, on a logarithmic scale.
function drawDistances() {
  document.getElementById("apart").parentElement.hidden = lab.lanes.length === 1;
  if (lab.lanes.length === 1) return;
  const rows = lab.series, size = Math.max(view.width, view.height) / 2.5;
  let least = size, largest = 0;
  for (const {apart} of rows) for (const value of apart) if (value > 0 && Number.isFinite(value)) { least = Math.min(least, value); largest = Math.max(largest, value); }
  // before lanes are apart, from a millionth of the scene on
  if (!(largest > 0)) [least, largest] = [1e-6 * size, size];
  const power = (value, round) => 10 ** round(Math.log10(value));
  least = power(Math.max(1e-16, least), Math.floor); largest = power(Math.min(Math.max(largest, 10 * least), 1e3 * size), Math.ceil);
  const lines = lab.lanes.map((lane, k) => ({k, count: k ? rows.length : 0, at: q => rows[q].time, value: q => rows[q].apart[k] > 0 ? rows[q].apart[k] : NaN}));
  plot("apart", {lines, low: least, high: largest, logarithmic: true, from: 0, to: until(), unit: "m", axis: "s"});
}

// By what the fastest mode is multiplied in a step, by dt, for each lane's scheme; dt and the limits are marked.
function drawGrowth() {
  if (!lab.mode) return plot("growth", {lines: [], low: 0, high: 2, from: 0, to: 1e3 * lab.dt * 2, unit: "", axis: "ms"});
  const limits = lab.lanes.map(lane => (lab.limits[lane.scheme] || {}).limit).filter(limit => limit > 0 && limit < Infinity);
  const to = 1e3 * Math.max(1.3 * lab.dt, 1.4 * Math.max(...limits, 2 / Math.sqrt(lab.mode.w2)));
  const lines = lab.lanes.map((lane, k) => {
    const scheme = schemes[lane.scheme];
    const at = q => to * (q + 1) / 161, known = lab.mode.grown = lab.mode.grown || {};
    if (scheme && scheme.kind !== "in_place" && !known[`${lane.scheme} ${to}`]) {
      const growth = growthOfMode(scheme, lab.mode.w2, lab.mode.g - lab.mode.drag, lab.mode.drag);
      known[`${lane.scheme} ${to}`] = Float64Array.from({length: 161}, (_, q) => growth(at(q) / 1e3));
    }
    const grown = known[`${lane.scheme} ${to}`] || [];
    return {k, count: grown.length, at, value: q => grown[q]};
  });
  const marks = lab.lanes.flatMap((lane, k) => {
    const {limit} = lab.limits[lane.scheme] || {};
    return limit > 0 && limit < Infinity ? [{at: 1e3 * limit, k}] : [];
  });
  plot("growth", {lines, low: 0, high: 2, from: 0, to, marks: [...marks, {at: 1e3 * lab.dt, label: "dt"}], unit: "", axis: "ms"});
}

const PLOTS = [drawEnergy, drawDistances, drawGrowth];
