// What drives a scene, drawn with it: a truck where the masses beside it have become larger, ground with its acceleration,
// and gravity that swings by itself.

function drawDriven({world}, k) {
  const [, , width, height] = view.boxes[k];
  const line = width < 480 ? lab.lanes.length : 0;  // in a narrow picture below the names of the lanes
  paper.save();
  for (const drive of world.drives) {
    if (drive.parameter === "mass") drawTruck(world, drive, k);
    const [right, top] = [width / 2 - 12, 16 + 20 * line - height / 2];
    if (drive.ground) drawGround(world, drive, right, top);
    else if (drive.parameter === "gravity") drawGravity(world, right, top);
  }
  paper.restore();
}

// In the middle of the mass that has come on: a joint beside a truck carries the more of it the nearer it is.
function drawTruck({system, memory: {F, at}}, {columns}, k) {
  const own = spread(system.masses, at.n), places = lab.lanes[k].seenAt;
  let sum = 0, x = 0, y = 0;
  for (const i of columns) {
    const more = F[at.masses + i] - own[i];
    sum += more; x += more * places[2 * i]; y += more * places[2 * i + 1];
  }
  if (!(sum > 1e-9 * own[columns[0]])) return;
  const size = Math.max(14, 0.22 * view.scale * Math.max(...spread(system.rest_lengths, at.s)));
  const [left, floor] = [x / sum - size, y / sum - 4];
  paper.fillStyle = colourOf(k); paper.strokeStyle = ink(); paper.lineWidth = 1;
  const part = (from, to, height) => { paper.beginPath(); paper.rect(left + from * size, floor - height * size, (to - from) * size, (height - 0.2) * size); paper.fill(); paper.stroke(); };
  part(0, 1.4, 1); part(1.45, 2, 0.75);
  paper.fillStyle = ink();
  for (const wheel of [0.3, 0.75, 1.7]) { paper.beginPath(); paper.arc(left + wheel * size, floor - 0.15 * size, 0.18 * size, 0, 7); paper.fill(); }
}

// Seen from ground that moves the fixed masses are at rest: an arrow, ending at the right, says how the ground is accelerated.
function drawGround({system, memory: {F, at}}, drive, right, top) {
  const places = lab.lanes[0].seenAt;
  paper.strokeStyle = soft(); paper.lineWidth = 1.5; paper.beginPath();
  for (const i of system.fixed) {
    const x = places[2 * i], floor = places[2 * i + 1] + 4;
    paper.moveTo(x - 24, floor); paper.lineTo(x + 24, floor);
    for (let k = -2; k < 4; k++) { paper.moveTo(x + 8 * k, floor); paper.lineTo(x + 8 * k - 8, floor + 8); }
  }
  paper.stroke();
  const [across, up] = [0, 1].map(axis => (system.gravity[axis] || 0) - F[at.gravity + axis]);
  drive.most = drive.most || largestOf(drive, system.gravity);
  const length = 50 / drive.most;
  if (drive.most) arrow(right - 60, top + 22, right - 60 + length * across, top + 22 - length * up);
  paper.fillStyle = ink(); paper.font = "14px system-ui, sans-serif"; paper.textAlign = "right"; paper.textBaseline = "middle";
  const along = Math.abs(across) >= Math.abs(up) ? across : up;
  paper.fillText(say("ground", {acceleration: along.toFixed(2)}), right, top);
}

// Gravity as it is, by an arrow of 50 px for 9.81 m/s^2, and in numbers.
function drawGravity({memory: {F, at}}, right, top) {
  const pull = Array.from(F.subarray(at.gravity, at.gravity + at.d)), [across, up] = at.d === 1 ? [0, pull[0]] : pull, part = 50 / 9.81;
  arrow(right - 60, top + 22, right - 60 + part * across, top + 22 - part * up);
  paper.fillStyle = ink(); paper.font = "14px system-ui, sans-serif"; paper.textAlign = "right"; paper.textBaseline = "middle";
  paper.fillText(say("gravity_now", {gravity: pull.map(value => value.toFixed(2)).join(", ")}), right, top);
}

// The largest acceleration of the table [m/s^2]; there is one once a step was taken.
function largestOf({table, columns}, gravity) {
  if (!table) return 0;
  let most = 1e-300;
  table.forEach((value, e) => { most = Math.max(most, Math.abs(value - gravity[columns[e % columns.length]])); });
  return most;
}

function arrow(x, y, toX, toY) {
  const length = Math.hypot(toX - x, toY - y);
  if (!(length > 1)) return;
  const [along, up] = [(toX - x) / length, (toY - y) / length], head = Math.min(9, length);
  paper.strokeStyle = paper.fillStyle = ink(); paper.lineWidth = 3;
  paper.beginPath(); paper.moveTo(x, y); paper.lineTo(toX - head * along, toY - head * up); paper.stroke();
  paper.beginPath(); paper.moveTo(toX, toY);
  for (const side of [-1, 1]) paper.lineTo(toX - head * along + side * 0.5 * head * up, toY - head * up - side * 0.5 * head * along);
  paper.fill();
}
