// The lab: a scene, lanes that step it side by side, what was changed on the way, and what has been.

// How much of a frame steps may take, at least and at most [ms], how long a frame is that came in time [ms], and how much
// the past may hold [doubles].
const STEPPING = [2, 10], IN_TIME = 20, PAST = 4e6;

// How many lanes there are at most.
const MOST_LANES = 4;

// What happens to masses or springs by their numbers.
const LISTS = ["hold", "release", "break"];

const lab = {
  scene: null, lanes: [], dt: 1e-3, changes: [], playing: false, speed: 1, beside: false,
  past: [], series: [], touched: false, grabbed: null, reached: 1, debt: 0, limits: {}, lesson: 0, budget: 8, magnified: 1, refused: [],
};

const sceneNamed = name => DATA.scenes.find(scene => scene.name === name);

// The lane that is furthest, the first of those: one that stopped stays where it was, with the parameters it had then.
const furthestOf = lanes => lanes.reduce((most, lane) => timeOf(lane.world) > timeOf(most.world) ? lane : most);
const furthest = () => furthestOf(lab.lanes);
const laneTime = () => lab.lanes.length ? timeOf(furthest().world) : 0;
const canGoOn = () => lab.lanes.some(lane => !lane.recording && !lane.world.blownUp);

// A scene with lanes, from its start, with changes on the way besides the scene's own.
function openScene(name, {lanes, dt, changes = [], magnified} = {}) {
  const scene = sceneNamed(name) || DATA.scenes[0];
  lab.scene = scene;
  lab.refused = [];
  lab.dt = dt || scene.dt;
  lab.changes = changes;
  lab.magnified = magnified || scene.magnified;
  startLanes(lanes || lab.lanes.map(lane => lane.scheme));
  fitView();
}

function startLanes(names) {
  const chosen = names.filter(name => schemes[name] || recordingNamed(name) || engineNamed(name)).slice(0, MOST_LANES);
  lab.lanes = (chosen.length ? chosen : ["kick_drift"]).map(startLane);
  Object.assign(lab, {past: [], series: [], touched: false, debt: 0, grabbed: null, short: false, firstDt: lab.dt});
  keepPast();
  askLimits();
}

function startLane(name, k) {
  const recording = recordingNamed(name), engine = engineNamed(name);
  const world = startWorld(lab.scene.system, schemes[name] ? name : "kick_drift", lab.dt, [...lab.scene.changes, ...lab.changes], lab.scene.drives);
  applyChanges(world);
  if (engine) carry(engine, world, k);
  return {scheme: name, recording, engine, world};
}

const recordingNamed = name => lab.scene && (lab.scene.recordings || []).find(one => `recorded:${one.name}` === name);

// From the start again, with everything as it is set now.
function reset() {
  const last = {};
  for (const change of lab.changes) if (![...LISTS, "dt"].includes(change.parameter)) last[change.parameter] = change;
  lab.changes = Object.values(last).map(change => ({...change, time: 0}));
  lab.playing = false;
  startLanes(lab.lanes.map(lane => lane.scheme));
}

// A parameter, dt, or masses held or let go: from now on, in all lanes.
function change(parameter, value) {
  const time = laneTime();
  if (parameter === "dt") {
    lab.dt = value;
    if (time === 0) { lab.changes = lab.changes.filter(one => one.parameter !== "dt"); return startLanes(lab.lanes.map(lane => lane.scheme)); }
  }
  lab.changes = lab.changes.filter(one => one.time !== time || one.parameter !== parameter || LISTS.includes(parameter));
  lab.changes.push({time, parameter, value});
  for (const {world} of lab.lanes) {
    world.changes = [...lab.scene.changes, ...lab.changes].sort((a, b) => a.time - b.time);
    world.done = world.changes.filter(one => one.time < time).length;
    applyChanges(world);
  }
  askLimits();
}

// Steps get what drawing leaves of a frame: less at once where a frame came late, a little more after each in time.
function shareFrame(ms) {
  const [least, most] = STEPPING;
  lab.budget = ms > IN_TIME ? Math.max(least, 0.8 * lab.budget) : Math.min(most, lab.budget + 0.03);
}

// As many steps as are due; fewer where the machine is too slow for the speed that is asked for.
function stepLanes(seconds) {
  lab.debt += seconds;
  const begin = performance.now(), wanted = Math.floor(lab.debt / lab.dt);
  let done = 0;
  for (; done < wanted && performance.now() - begin < lab.budget; done++) {
    if (!canGoOn()) break;
    oneStep();
  }
  lab.debt = done < wanted ? 0 : lab.debt - done * lab.dt;
  lab.reached = wanted ? done / wanted : 1;
  if (done) keepPast();
  return done;
}

function oneStep() {
  holdGrabbed();
  for (const lane of lab.lanes) {
    if (lane.recording) showRecording(lane, laneTime());
    else if (!lane.world.blownUp) advance(lane.world, 1);
  }
  const stepped = lab.lanes.filter(lane => !lane.recording);
  if (!stepped.length) return;
  const {steps, origin, dt} = furthestOf(stepped).world;
  for (const lane of lab.lanes) if (lane.recording) Object.assign(lane.world, {steps, origin, dt});
}

// A recorded run at a time: between two frames, in a straight line.
function showRecording({recording, world}, time) {
  const {F, at} = world.memory, size = at.n * at.d;
  recording.values = recording.values || Int16Array.from(new Int16Array(Uint8Array.from(atob(recording.frames), c => c.charCodeAt(0)).buffer));
  const last = recording.values.length / size - 1, place = Math.min(time / recording.every, last);
  const frame = Math.max(0, Math.min(Math.floor(place), last - 1)), part = place - frame;
  for (let e = 0; e < size; e++) {
    const before = recording.values[frame * size + e], after = recording.values[(frame + 1) * size + e];
    F[at.x + e] = (before + part * (after - before)) * recording.quantum + recording.offset[e % at.d];
  }
}

// The mass that hangs on the pointer is where the pointer is, at rest, in all lanes.
function holdGrabbed() {
  if (!lab.grabbed) return;
  const {mass, place} = lab.grabbed;
  for (const {world, recording} of lab.lanes) {
    if (recording) continue;
    const {F, at} = world.memory;
    for (let axis = 0; axis < at.d; axis++) { F[at.x + at.d * mass + axis] = place[axis]; F[at.v + at.d * mass + axis] = 0; }
    if (world.put) world.put(mass);
  }
  lab.touched = true;
}

// What was: positions and velocities of all lanes, thinned out where it would fill the memory; and the plots' numbers.
function keepPast() {
  const states = lab.lanes.map(({world: {memory: {F, at}}}) => F.slice(at.x, at.x + 2 * at.n * at.d));
  const worlds = lab.lanes.map(({world}) => ({steps: world.steps, origin: world.origin, dt: world.dt, blownUp: world.blownUp, remembered: world.remembered, broken: brokenOf(world.memory)}));
  lab.past.push({time: laneTime(), states, worlds, changes: lab.changes.slice()});
  const size = states.reduce((sum, state) => sum + state.length, 0);
  if (lab.past.length > 60 && lab.past.length * size > PAST) lab.past = lab.past.filter((_, k) => k % 2 === 0 || k === lab.past.length - 1);
  if (lab.past.length > 1500) lab.past = lab.past.filter((_, k) => k % 2 === 0);
  lab.series.push(measured());
  if (lab.series.length > 1500) lab.series = lab.series.filter((_, k) => k % 2 === 0);
}

// Which springs are broken; null where none can.
function brokenOf({I, at}) {
  const found = [];
  if (at.nonlinear) for (let j = 0; j < at.s; j++) if (I[at.broken + j]) found.push(j);
  return found;
}

// How far lanes are apart is known at one time only: not of one that stopped and one that went on.
function measured() {
  const first = lab.lanes[0].world, apartOf = ({world}) => timeOf(world) === timeOf(first) ? apart(first, world) : NaN;
  return {
    time: laneTime(),
    energy: lab.lanes.map(lane => lane.recording ? NaN : energies(lane.world).total),
    apart: lab.lanes.map((lane, k) => k ? apartOf(lane) : 0),
  };
}

// Back to a frame of the past, all that was set then included.
function rewind(k) {
  const frame = lab.past[k];
  lab.changes = frame.changes.slice();
  lab.lanes.forEach((lane, which) => {
    const fresh = startLane(lane.scheme, which).world, {F, at} = fresh.memory;
    Object.assign(fresh, frame.worlds[which]);
    fresh.done = 0;
    while (fresh.done < fresh.changes.length && fresh.changes[fresh.done].time <= frame.time) {
      const {parameter, value} = fresh.changes[fresh.done++];
      if (parameter !== "dt") applyChange(fresh.memory, parameter, value);
    }
    breakSprings(fresh.memory, fresh.broken);
    F.set(frame.states[which], at.x);
    if (fresh.put) for (let i = 0; i < at.n; i++) fresh.put(i);
    lane.world = fresh;
  });
  lab.dt = furthest().world.dt;
  lab.past = lab.past.slice(0, k + 1);
  lab.series = lab.series.filter(row => row.time <= frame.time);
  lab.debt = 0;
  askLimits();
}

// The limits of all lanes as things are set: asked of a worker, so that the page goes on meanwhile.
let worker = null, asked = 0;
function askLimits() {
  const {memory} = furthest().world, {F, I, at, angular} = memory;
  const names = [...new Set(lab.lanes.map(lane => lane.recording ? lane.recording.scheme : lane.scheme).filter(name => schemes[name]))];
  lab.limits = {};
  if (!lab.scene.rest.length) return limitsCame();
  const question = {id: ++asked, memory: {F: F.slice(), I: I.slice(), at, angular}, system: {obstacles: lab.scene.system.obstacles}, rest: lab.scene.rest, contacts: lab.scene.contacts, alone: lab.scene.alone, names};
  if (!worker) {
    const code = document.getElementById("physics").textContent + "\nonmessage = ({data}) => postMessage(answerLimits(data));";
    worker = new Worker(URL.createObjectURL(new Blob([code], {type: "text/javascript"})));
    worker.onmessage = ({data}) => { if (data.id === asked) { lab.limits = data.limits; lab.mode = data.mode; limitsCame(); } };
  }
  worker.postMessage(question);
}
