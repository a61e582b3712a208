// A link is a state: all that was set, behind the #; and the command, the table and the picture of what is seen.

function stateText() {
  const words = [["v", FORMAT], ["s", lab.scene.name], ["w", lab.lanes.map(lane => lane.scheme).join(",")], ["dt", String(startDt())]];
  const changes = lab.changes.filter(change => !(change.time === 0 && change.parameter === "dt"));
  if (changes.length) words.push(["at", changes.map(({time, parameter, value}) => `${timeText(time)}:${parameter}:${[value].flat().join("+")}`).join(",")]);
  const steps = stepsTried();
  if (steps) words.push(["n", steps]);
  if (lab.speed !== 1) words.push(["speed", lab.speed]);
  if (lab.beside) words.push(["beside", 1]);
  if (lab.magnified !== lab.scene.magnified) words.push(["magnified", lab.magnified]);
  if (lab.lesson) words.push(["lesson", lab.lesson]);
  if (language !== "en") words.push(["lang", language]);
  return words.map(([key, value]) => `${key}=${encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":").replace(/%2B/g, "+")}`).join("&");
}

// How many steps of the furthest lane come to what is seen: with the one that a solver gave up, or an engine refused.
function stepsTried() {
  const {steps} = furthest().world, gaveUp = ({blownUp}) => blownUp && ["unsolved", "refused"].includes(blownUp.what);
  return steps + lab.lanes.some(({world}) => world.steps === steps && gaveUp(world));
}

// The dt that the run began with: what it became later is among the changes.
const startDt = () => {
  const later = lab.changes.find(change => change.parameter === "dt" && change.time > 0);
  return later ? lab.firstDt : lab.dt;
};

// A time by the fewest digits that still begin the same step: `applyChanges` takes what is off by less than 1e-9 of a step.
function timeText(time) {
  const shortest = Math.min(startDt(), ...lab.changes.filter(change => change.parameter === "dt").map(change => change.value));
  for (let digits = 6; digits < 17; digits++) if (Math.abs(+time.toPrecision(digits) - time) <= 1e-10 * shortest) return String(+time.toPrecision(digits));
  return String(time);
}

// What a link says. What is no such thing is left out, and told in `refused`: each part as the link has it.
function readState(text) {
  const refused = [], words = {}, shorten = part => part.length > 40 ? part.slice(0, 40) + "…" : part;
  const refuse = part => { refused.push(shorten(part)); };
  for (const word of text.split("&").filter(Boolean)) {
    const [key, ...value] = word.split("=");
    try { words[key] = decodeURIComponent(value.join("=")); } catch { refuse(word); }
    if (!LINKED.includes(key)) refuse(word);
  }
  const among = (key, has) => { if (words[key] === undefined || has(words[key])) return words[key]; refuse(`${key}=${words[key]}`); };
  const number = (key, least, most) => {
    const value = words[key] === undefined ? undefined : numberIn(words[key]);
    if (value === undefined || (value >= least && value <= most)) return value;
    refuse(`${key}=${words[key]} (${say("expected_from", {least, most})})`);
  };
  if (words.v !== undefined && words.v !== FORMAT) refuse(`v=${words.v} (${say("other_format", {format: FORMAT})})`);
  const scene = among("s", sceneNamed), own = sceneNamed(scene) || DATA.scenes[0];
  const recorded = (own.recordings || []).map(one => `recorded:${one.name}`), stepped = Object.keys(own.engines || {}).filter(name => own.engines[name] === "");
  const lanes = (words.w || "").split(",").filter(Boolean), known = lanes.filter(name => schemes[name] || recorded.includes(name) || stepped.includes(name));
  for (const name of [...lanes.filter(name => !known.includes(name)), ...known.slice(MOST_LANES)]) refuse(`w=${name}`);
  const changes = (words.at || "").split(",").filter(Boolean).flatMap(word => {
    const change = readChange(word, (sceneNamed(scene) || DATA.scenes[0]).system);
    if (!change) refuse(`at=${word}`);
    return change || [];
  });
  return {
    scene, lanes: known.length ? known.slice(0, MOST_LANES) : undefined, dt: number("dt", SHORTEST_DT, LONGEST_DT), changes,
    steps: Math.round(number("n", 0, 2e6) || 0), speed: number("speed", 1e-6, 8), beside: words.beside === "1", magnified: number("magnified", 1, 1000),
    lesson: Math.round(number("lesson", 0, LESSONS.length) || 0), lang: among("lang", name => Object.hasOwn(WORDS, name)), refused,
  };
}

// The format of links that this page writes and reads.
const FORMAT = "1";

// The parts that a link has.
const LINKED = ["v", "s", "w", "dt", "at", "n", "speed", "beside", "magnified", "lesson", "lang"];

// TIME:PARAMETER:VALUE of a link, or null where it is no such thing: one number for all, one for each, or a list of numbers.
function readChange(word, {n, s, d}) {
  const [at, parameter, text] = word.split(":"), time = numberIn(at), values = (text || "").split("+").map(numberIn);
  const known = Object.hasOwn(PARAMETERS, parameter), [, count] = known ? PARAMETERS[parameter]({n, s, d}) : [0, 0];
  const most = parameter === "break" ? s : n, one = values.length === 1;
  if (!(time >= 0 && time <= 1e6)) return null;
  if (LISTS.includes(parameter)) return values.every(i => Number.isInteger(i) && i >= 0 && i < most) ? {time, parameter, value: values} : null;
  const fine = parameter === "dt" ? one && values[0] >= SHORTEST_DT && values[0] <= LONGEST_DT
    : known && (one || values.length === count) && values.every(value => mayBe(parameter, value));
  return fine ? {time, parameter, value: one ? values[0] : values} : null;
}

// The state of a link, at once: steps are taken before anything is shown, up to a second's worth.
function openState(state) {
  lab.speed = state.speed || 1; lab.beside = state.beside; lab.playing = false;
  openScene(state.scene, {lanes: state.lanes || ["kick_drift"], dt: state.dt, changes: state.changes, magnified: state.magnified});
  lab.firstDt = lab.dt;
  const begin = performance.now();
  let taken = 0;
  for (; taken < state.steps && canGoOn() && performance.now() - begin < 3000; taken++) { oneStep(); if (taken % 16 === 15) keepPast(); }
  if (taken) keepPast();
  lab.dt = furthest().world.dt;
  lab.short = taken < state.steps && canGoOn();
  askLimits();
}

const linkText = () => location.href.split("#")[0] + "#" + stateText();

// The command line that comes to the present state, as far as a command can say it.
function commandText() {
  const names = [...new Set(lab.lanes.map(lane => lane.recording ? lane.recording.stepper : lane.scheme))];
  const words = ["springlab", "compare", quoted(lab.scene.command), ...names.map(name => `--stepper=${quoted(name)}`), `--dt=${startDt()}`];
  if (laneTime() > 0) words.push(`--duration=${+laneTime().toPrecision(12)}`);  // at the start the scene's own
  for (const [key, value] of Object.entries(lab.scene.settings)) words.push(`--set=${key}=${value}`);
  for (const {time, parameter, value} of lab.changes) {
    if (parameter !== "dt") words.push(`--change=${timeText(time)}:${parameter}=${[value].flat().join(",")}`);
  }
  return words.join(" ");
}

const quoted = word => /^[\w./-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`;

// What a command and a link leave out, in words; empty where they say all.
const leftOut = () => lab.touched ? say("left_out_moved") : lab.changes.some(change => change.parameter === "dt" && change.time > 0) ? say("left_out_dt") : "";

function tableText() {
  const names = lab.lanes.map(lane => lane.scheme.replace(/[",\n]/g, " "));
  const head = ["time [s]", ...names.map(name => `energy of ${name} [J]`), ...names.slice(1).map(name => `distance of ${name} from ${names[0]} [m]`)];
  const rows = lab.series.map(row => [row.time, ...row.energy, ...row.apart.slice(1)].map(value => Number.isFinite(value) ? value : "").join(","));
  return [head.join(","), ...rows].join("\n") + "\n";
}

function placesText() {
  const {d, n} = lab.scene.system, axes = ["x", "y", "z"].slice(0, d);
  const rows = lab.lanes.flatMap(({scheme, world}) => Array.from({length: n}, (_, i) => {
    const {steps, memory: {F, at}} = world;
    return [scheme.replace(/[",\n]/g, " "), timeOf(world), steps, i, ...axes.map((_, axis) => F[at.x + d * i + axis]), ...axes.map((_, axis) => F[at.v + d * i + axis])].join(",");
  }));
  return [["stepper", "time [s]", "step", "mass", ...axes.map(axis => `${axis} [m]`), ...axes.map(axis => `v${axis} [m/s]`)].join(","), ...rows].join("\n") + "\n";
}

// What a file of the present state is called: after its scene and dt.
const fileName = what => `springlab-${lab.scene.name.replace(/[^\w.-]/g, "_")}-dt-${lab.dt}-${what}`;

function download(name, href) {
  const link = document.createElement("a");
  Object.assign(link, {href, download: name});
  document.body.append(link); link.click(); link.remove();
}

const asFile = (text, type) => URL.createObjectURL(new Blob([text], {type}));
const embedText = () => `<iframe src="${linkText().replace(/&/g, "&amp;")}" width="800" height="900" title="springlab" style="border:0"></iframe>`;
