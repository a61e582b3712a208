// The picture: lanes over one another or side by side, each in a colour and with a marker of its own.

const COLOURS = {light: ["#0072b2", "#b84e00", "#007d5b", "#a8507f"], dark: ["#5aa9e6", "#f0803a", "#2fc195", "#e59bc5"]};
const MARKERS = ["circle", "square", "triangle", "diamond"];
// Springs are drawn the thicker the more they are strained: up to 1 %, 5 %, 20 %, and beyond.
const STRAINS = [0.01, 0.05, 0.2, Infinity], WIDTHS = [0.8, 1.4, 2.2, 3.4];
const MARKED_UP_TO = 260;
// Without a graphics card a line of at most a pixel is drawn several times as fast as a thicker one: over this many
// springs the strained ones are not thicker but less transparent.
const THICK_UP_TO = 300, OPACITIES = [0.45, 0.6, 0.8, 1];

const view = {yaw: 0.5, pitch: 0.35, scale: 1, centre: [0, 0, 0], zoom: 1, boxes: [], selected: null};
const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
const colourOf = k => COLOURS[isDark() ? "dark" : "light"][k % 4];

// The page's own colours, looked up when they change: to ask in a frame makes the browser lay the page out in it.
const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "paper", "soft"]) colours[name] = style.getPropertyValue(`--${name}`).trim();
}
readColours();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", readColours);
const ink = () => colours.ink, sheet = () => colours.paper, soft = () => colours.soft;

// Which parts of a place, from the centre of the picture, are right, up and near.
function camera(d) {
  if (d < 3) return d === 1 ? [[0], [1], [0]] : [[1, 0], [0, 1], [0, 0]];
  const [c, s, cp, sp] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
  return [[c, 0, s], [s * sp, cp, -c * sp], [-s * cp, sp, c * cp]];
}

// Where a place is seen from the camera [m]: right, up, and how near.
const seen = (place, d) => camera(d).map(row => row.reduce((sum, part, axis) => sum + part * (place[axis] - view.centre[axis]), 0));

// Where all masses are seen [px], two numbers for each, into an array of the lane's own; from where they started they are
// drawn as many times as far as is set.
function seenAll({memory: {F, at}, start}, seenAt) {
  const {n, d, x} = at, [right, up] = camera(d), {scale, centre} = view, {magnified} = lab;
  for (let i = 0; i < n; i++) {
    let across = 0, high = 0;
    for (let axis = 0; axis < d; axis++) {
      const from = start[d * i + axis], away = from + magnified * (F[x + d * i + axis] - from) - centre[axis];
      across += right[axis] * away; high += up[axis] * away;
    }
    seenAt[2 * i] = clamp(scale * across); seenAt[2 * i + 1] = clamp(-scale * high);
  }
  return seenAt;
}

// All of the scene at its start and at rest in the picture, with a margin.
function fitView() {
  const {system, rest} = lab.scene, {d} = system, points = [];
  for (let e = 0; e < system.positions.length; e += d) points.push(system.positions.slice(e, e + d));
  for (let e = 0; e < rest.length; e += d) {
    points.push(rest.slice(e, e + d).map((value, axis) => system.positions[e + axis] + lab.magnified * (value - system.positions[e + axis])));
  }
  for (const {kind, values} of system.obstacles) {
    if (kind.startsWith("circle") || kind.startsWith("sphere")) {
      const radius = values[d];
      for (const sign of [-1, 1]) points.push(values.slice(0, d).map(value => value + sign * radius));
    }
  }
  const {fixed} = system;
  if (d > 1 && fixed.length > 0 && fixed.length < 3) {  // what hangs on a mass or two swings to both sides
    const about = axis => fixed.reduce((sum, i) => sum + system.positions[d * i + axis], 0) / fixed.length;
    points.push(...points.map(point => point.map((value, axis) => axis === 1 ? value : 2 * about(axis) - value)));
  }
  const low = [], high = [];
  for (let axis = 0; axis < d; axis++) {
    low[axis] = Math.min(...points.map(point => point[axis])); high[axis] = Math.max(...points.map(point => point[axis]));
  }
  view.centre = low.map((value, axis) => (value + high[axis]) / 2);
  const around = points.map(point => seen(point, d));
  const across = axis => Math.max(...around.map(point => Math.abs(point[axis]))) || 0;
  view.width = 2.5 * Math.max(across(0), 0.1 * across(1), 1e-6); view.height = 2.9 * Math.max(across(1), 0.1 * across(0), 1e-6);
  view.zoom = 1;
  view.selected = null;
}

// Paper that nothing shines through is put together with the page in two thirds of the time, and saved as it is seen.
const canvas = document.getElementById("stage"), paper = canvas.getContext("2d", {alpha: false});

// How large canvases are on the page, told by the browser when it changes, for the same reason.
const sizes = new Map(), resized = new ResizeObserver(all => { for (const {target} of all) sizes.set(target, sizeOnPage(target)); });
const sizeOnPage = ({clientWidth, clientHeight}) => ({clientWidth, clientHeight});

function sizeCanvas(of) {
  if (!sizes.has(of)) { sizes.set(of, sizeOnPage(of)); resized.observe(of); }
  const ratio = Math.min(window.devicePixelRatio || 1, 2), {clientWidth, clientHeight} = sizes.get(of);
  const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
  if (of.width !== width || of.height !== height) { of.width = width; of.height = height; }
  of.getContext("2d").setTransform(ratio, 0, 0, ratio, 0, 0);
  return [clientWidth, clientHeight];
}

// Where each lane has its part of the picture.
function boxes(width, height) {
  const count = lab.lanes.length;
  if (!lab.beside || count === 1) return lab.lanes.map(() => [0, 0, width, height]);
  const columns = width > 1.2 * height ? count : Math.ceil(count / 2), rows = Math.ceil(count / columns);
  return lab.lanes.map((_, k) => [(k % columns) * width / columns, Math.floor(k / columns) * height / rows, width / columns, height / rows]);
}

function draw() {
  const [width, height] = sizeCanvas(canvas);
  paper.fillStyle = sheet(); paper.fillRect(0, 0, width, height);
  view.boxes = boxes(width, height);
  const [, , w, h] = view.boxes[0];
  view.scale = view.zoom * Math.min(w / view.width, h / view.height);
  follow(w, h);
  lab.lanes.forEach((lane, k) => {
    paper.save();
    const [left, top, boxWidth, boxHeight] = view.boxes[k];
    paper.beginPath(); paper.rect(left, top, boxWidth, boxHeight); paper.clip();
    paper.translate(left + boxWidth / 2, top + boxHeight / 2);
    if (k === 0 || lab.beside) drawObstacles(boxWidth, boxHeight);
    paper.translate(aside(k), 0);
    drawLane(lane, k);
    paper.restore();
    if (lab.beside && k) { paper.strokeStyle = soft(); paper.lineWidth = 0.5; paper.strokeRect(left, top, boxWidth, boxHeight); }
  });
  drawScale(height);
  drawNames();
}

// Who is who, with the marker of each, on paper of its own: springs that blow up go everywhere.
function drawNames() {
  paper.font = "14px system-ui, sans-serif"; paper.textAlign = "left"; paper.textBaseline = "middle";
  lab.lanes.forEach((lane, k) => {
    const [left, top] = view.boxes[k], y = top + 16 + (lab.beside ? 0 : 20 * k);
    const name = nameOf(lane) + (lane.world.blownUp ? " ✕" : "");
    paper.fillStyle = sheet(); paper.fillRect(left + 5, y - 10, 26 + paper.measureText(name).width, 20);
    paper.fillStyle = colourOf(k); drawMarker(paper, k, left + 14, y, 5);
    paper.fillStyle = lane.world.blownUp ? soft() : ink(); paper.fillText(name, left + 26, y);
  });
}

// What nothing holds may fall out of the picture: then the picture goes along.
function follow(width, height) {
  const {system} = lab.scene, {d} = system;
  const free = lab.lanes.filter(({world}) => !world.blownUp);
  if (system.fixed.length || !free.length || lab.grabbed) return;
  const mean = new Array(d).fill(0);
  for (const {world: {memory: {F, at}}} of free) for (let e = 0; e < at.n * d; e++) mean[e % d] += F[at.x + e] / at.n / free.length;
  const [right, up] = seen(mean, d);
  const beyond = Math.max(Math.abs(right) * view.scale / (0.12 * width), Math.abs(up) * view.scale / (0.08 * height));
  if (beyond > 1 && beyond < Infinity) view.centre = view.centre.map((c, axis) => c + (1 - 1 / beyond) * (mean[axis] - c));
}

function drawLane(lane, k) {
  const {world: {memory}, recording} = lane, {I, at} = memory, {n, s} = at;
  if (!lane.seenAt || lane.seenAt.length !== 2 * n) lane.seenAt = new Float64Array(2 * n);
  const places = seenAll(lane.world, lane.seenAt);
  paper.strokeStyle = paper.fillStyle = colourOf(k);
  if (recording) paper.setLineDash([4, 3]);
  strokeSprings(pathsByStrain(lane.world, places), s > THICK_UP_TO, k);
  paper.setLineDash([]); paper.globalAlpha = 1;
  if (k === 0 || lab.beside) drawDriven(lane, k);
  const size = Math.max(2, Math.min(n > 60 ? 2.5 : 5, 0.3 * view.scale * meanLength(lane.world)));
  for (let i = 0; i < n; i++) {
    if (I[at.fixed + i]) drawFixed(places[2 * i], places[2 * i + 1], n > 60 ? 3 : 5);
    else if (n <= MARKED_UP_TO) drawMarker(paper, k, places[2 * i], places[2 * i + 1], size);
  }
  const chosen = view.selected;
  if (chosen !== null && chosen < n) {
    paper.strokeStyle = ink(); paper.lineWidth = 2; paper.beginPath();
    paper.arc(places[2 * chosen], places[2 * chosen + 1], 10, 0, 7); paper.stroke();
  }
}

// How long springs are in the mean at the start [m]: markers of masses are smaller than that.
function meanLength(world) {
  const {start, memory: {I, at: {s, d, springs}}} = world;
  if (world.apart === undefined) {
    const squares = (a, b) => { let sum = 0; for (let e = 0; e < d; e++) sum += (start[d * b + e] - start[d * a + e]) ** 2; return sum; };
    world.apart = s ? 0 : Infinity;
    for (let j = 0; j < s; j++) world.apart += Math.sqrt(squares(I[springs + 2 * j], I[springs + 2 * j + 1])) / s;
  }
  return world.apart;
}

// One path for the springs of each class of strain; a spring that begins where the one before it in its class ended goes on
// from there.
function pathsByStrain({memory, natural}, places) {
  const {F, I, at} = memory, {s, springs, rest_lengths, broken} = at, lengths = lengthsOf(memory);
  const paths = STRAINS.map(() => new Path2D()), ends = STRAINS.map(() => -1);
  for (let j = 0; j < s; j++) {
    if (I[broken + j]) continue;
    const a = I[springs + 2 * j], b = I[springs + 2 * j + 1];
    const rest = F[rest_lengths + j], strain = Math.abs(lengths[j] / (rest > 0 ? rest : natural[j]) - 1);
    const bin = strain <= STRAINS[0] ? 0 : strain <= STRAINS[1] ? 1 : strain <= STRAINS[2] ? 2 : 3;
    if (ends[bin] !== a) paths[bin].moveTo(places[2 * a], places[2 * a + 1]);
    paths[bin].lineTo(places[2 * b], places[2 * b + 1]);
    ends[bin] = b;
  }
  return paths;
}

// Where lanes lie over one another the first are wider, so that they are seen behind the others.
function strokeSprings(paths, many, k) {
  const wider = lab.beside ? 1 : 1 + 0.9 * (lab.lanes.length - 1 - k);
  paths.forEach((path, bin) => {
    paper.lineWidth = many ? 1 : WIDTHS[bin] * wider;
    paper.globalAlpha = many ? OPACITIES[bin] : 1;
    paper.stroke(path);
  });
}

// Along a line lanes stand beside one another: there they would hide one another.
const aside = k => lab.scene.system.d === 1 && !lab.beside ? 44 * (k - (lab.lanes.length - 1) / 2) : 0;

const clamp = value => Math.max(-1e5, Math.min(1e5, Number.isFinite(value) ? value : 0));

function drawFixed(x, y, size) { paper.fillStyle = ink(); paper.fillRect(x - size, y - size / 2, 2 * size, size); paper.fillStyle = paper.strokeStyle; }

function drawMarker(to, k, x, y, size) {
  to.beginPath();
  if (MARKERS[k] === "circle") to.arc(x, y, size, 0, 7);
  else if (MARKERS[k] === "square") to.rect(x - size * 0.9, y - size * 0.9, 1.8 * size, 1.8 * size);
  else if (MARKERS[k] === "triangle") { to.moveTo(x, y - 1.2 * size); to.lineTo(x + 1.1 * size, y + 0.8 * size); to.lineTo(x - 1.1 * size, y + 0.8 * size); }
  else { to.moveTo(x, y - 1.3 * size); to.lineTo(x + 1.3 * size, y); to.lineTo(x, y + 1.3 * size); to.lineTo(x - 1.3 * size, y); }
  to.fill();
}

function drawObstacles(width, height) {
  const {system} = lab.scene, {d} = system, {scale} = view;
  paper.fillStyle = paper.strokeStyle = soft(); paper.lineWidth = 1.5;
  for (const {kind, values} of system.obstacles) {
    const at = values.slice(0, d), [right, up] = seen(at, d), place = [scale * right, -scale * up];
    paper.globalAlpha = 0.25; paper.beginPath();
    if (kind.startsWith("circle") || kind.startsWith("sphere")) paper.arc(...place, scale * values[d], 0, 7);
    else if (kind.startsWith("box")) outlineOfBox(at, values.slice(d), d);
    else if (kind.startsWith("plane")) outlineOfPlane(at, values.slice(d), d, 2 * (width + height) / scale);
    else if (kind.startsWith("cylinder")) outlineOfCylinder(at, values.slice(3, 6), values[6]);
    paper.fill(); paper.globalAlpha = 1; paper.stroke();
  }
}

// In space the sides that are turned towards the camera: they do not hide one another.
function outlineOfBox(centre, half, d) {
  const line = corners => {
    corners.map(signs => seen(centre.map((c, axis) => c + signs[axis] * half[axis]), d)).forEach(([x, y], k) => paper[k ? "lineTo" : "moveTo"](view.scale * x, -view.scale * y));
    paper.closePath();
  };
  const around = [[-1, -1], [1, -1], [1, 1], [-1, 1]], near = camera(d)[2];
  if (d === 2) return line(around);
  for (let axis = 0; axis < 3; axis++) {
    line(around.map(signs => [...signs.slice(0, axis), near[axis] < 0 ? -1 : 1, ...signs.slice(axis)]));
  }
}

// A floor in the plane is all below it; in space, a square of it.
function outlineOfPlane(point, normal, d, wide) {
  if (d < 3) {
    const along = d === 1 ? null : [-normal[1], normal[0]];
    const ends = d === 1 ? [[-wide, 0], [wide, 0]].map(([x]) => [x, seen(point, 1)[1]]) : [-wide, wide].map(far => seen(point.map((p, axis) => p + far * along[axis]), 2));
    const down = d === 1 ? [0, -wide * normal[0]] : normal.map(n => -wide * n);
    [ends[0], ends[1], [ends[1][0] + down[0], ends[1][1] + down[1]], [ends[0][0] + down[0], ends[0][1] + down[1]]]
      .forEach(([x, y], k) => paper[k ? "lineTo" : "moveTo"](view.scale * x, -view.scale * y));
    return paper.closePath();
  }
  const other = Math.abs(normal[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const one = cross(normal, other), two = cross(normal, one), size = 0.4 * Math.max(view.width, view.height);
  const nearest = view.centre.map((c, axis) => c - normal[axis] * normal.reduce((sum, n, k) => sum + n * (view.centre[k] - point[k]), 0));
  [[-1, -1], [1, -1], [1, 1], [-1, 1]].forEach(([a, b], k) => {
    const [x, y] = seen(nearest.map((c, axis) => c + size * (a * one[axis] + b * two[axis])), 3);
    paper[k ? "lineTo" : "moveTo"](view.scale * x, -view.scale * y);
  });
  paper.closePath();
}

function outlineOfCylinder(centre, axis, radius) {
  const ends = [-1, 1].map(sign => seen(centre.map((c, k) => c + sign * 0.5 * view.width * axis[k]), 3));
  const [dx, dy] = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]], length = Math.sqrt(dx * dx + dy * dy) || 1;
  const aside = [-dy / length * radius, dx / length * radius];
  [[0, 1], [1, 1], [1, -1], [0, -1]].forEach(([end, sign], k) =>
    paper[k ? "lineTo" : "moveTo"](view.scale * (ends[end][0] + sign * aside[0]), -view.scale * (ends[end][1] + sign * aside[1])));
  paper.closePath();
}

// A bar of a round length at the lower left.
function drawScale(height) {
  const wanted = 90 / view.scale, power = 10 ** Math.floor(Math.log10(wanted)), length = power * (wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1);
  paper.strokeStyle = paper.fillStyle = ink(); paper.lineWidth = 2;
  paper.beginPath(); paper.moveTo(12, height - 12); paper.lineTo(12 + length * view.scale, height - 12); paper.stroke();
  paper.font = "13px system-ui, sans-serif"; paper.textBaseline = "bottom"; paper.textAlign = "left";
  if (lab.magnified !== 1) paper.fillText(say("magnified", {times: lab.magnified}), 12, height - 36);
  paper.fillText(length >= 1 ? `${length} m` : length >= 0.01 ? `${+(length * 100).toPrecision(2)} cm` : `${+(length * 1000).toPrecision(2)} mm`, 12, height - 16);
}

// The free or fixed mass nearest to a place of the picture, within 28 px, and the lane's part it is in.
function massAt(px, py) {
  let best = null, nearest = 28;
  lab.lanes.forEach(({world: {memory: {at}}, recording, seenAt}, k) => {
    if (recording || !seenAt) return;
    const [left, top, width, height] = view.boxes[k];
    for (let i = 0; i < at.n; i++) {
      const dx = left + width / 2 + aside(k) + seenAt[2 * i] - px, dy = top + height / 2 + seenAt[2 * i + 1] - py, away = Math.sqrt(dx * dx + dy * dy);
      if (away < nearest) { nearest = away; best = {mass: i, box: k}; }
    }
  });
  return best;
}

// The place in space under the pointer, where the mass would be drawn there.
function placeUnder(px, py, found) {
  const {start} = lab.lanes[found.box].world, {d} = lab.scene.system;
  return drawnUnder(px, py, found).map((value, axis) => {
    const from = start[d * found.mass + axis];
    return from + (value - from) / lab.magnified;
  });
}

// The place under the pointer in the plane through the mass that faces the camera.
function drawnUnder(px, py, {mass, box}) {
  const {d} = lab.scene.system, [left, top, width, height] = view.boxes[box], {memory: {F, at}} = lab.lanes[box].world;
  const right = (px - left - width / 2) / view.scale, up = -(py - top - height / 2) / view.scale;
  if (d === 1) return [view.centre[0] + up];
  if (d === 2) return [view.centre[0] + right, view.centre[1] + up];
  const near = seen(F.subarray(at.x + 3 * mass, at.x + 3 * mass + 3), 3)[2], {yaw, pitch} = view;
  const y = up * Math.cos(pitch) + near * Math.sin(pitch), away = -up * Math.sin(pitch) + near * Math.cos(pitch);
  return [view.centre[0] + right * Math.cos(yaw) - away * Math.sin(yaw), view.centre[1] + y, view.centre[2] + right * Math.sin(yaw) + away * Math.cos(yaw)];
}
