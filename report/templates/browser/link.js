// A link is a state: all that was set, behind the #; and the command, the table and the picture of what is seen.

function stateText() {
  const words = [["v", 1], ["s", lab.scene.name], ["w", lab.lanes.map(lane => lane.scheme).join(",")], ["dt", String(startDt())]];
  const changes = lab.changes.filter(change => !(change.time === 0 && change.parameter === "dt"));
  if (changes.length) words.push(["at", changes.map(({time, parameter, value}) => `${time}:${parameter}:${[value].flat().join("+")}`).join(",")]);
  const {steps} = lab.lanes[0].world;
  if (steps) words.push(["n", steps]);
  if (lab.speed !== 1) words.push(["speed", lab.speed]);
  if (lab.beside) words.push(["beside", 1]);
  if (lab.magnified !== lab.scene.magnified) words.push(["magnified", lab.magnified]);
  if (lab.lesson) words.push(["lesson", lab.lesson]);
  if (language !== "en") words.push(["lang", language]);
  return words.map(([key, value]) => `${key}=${encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":").replace(/%2B/g, "+")}`).join("&");
}

// The dt that the run began with: what it became later is among the changes.
const startDt = () => {
  const later = lab.changes.find(change => change.parameter === "dt" && change.time > 0);
  return later ? lab.firstDt : lab.dt;
};

// What a link says; what is no such thing is left out.
function readState(text) {
  const words = Object.fromEntries(text.split("&").filter(Boolean).map(word => {
    const [key, ...value] = word.split("=");
    try { return [key, decodeURIComponent(value.join("="))]; } catch { return [key, ""]; }
  }));
  const number = (word, least, most) => { const value = Number(word); return word !== undefined && value >= least && value <= most ? value : undefined; };
  const changes = (words.at || "").split(",").flatMap(word => {
    const [time, parameter, text] = word.split(":"), values = (text || "").split("+").map(Number), at = number(time, 0, 1e6);
    const known = parameter in PARAMETERS || [...LISTS, "dt"].includes(parameter);
    if (at === undefined || !known || !text || !values.every(Number.isFinite)) return [];
    if (parameter === "dt" && !(values[0] > 1e-9 && values[0] <= 10)) return [];
    return [{time: at, parameter, value: LISTS.includes(parameter) ? values.map(Math.round) : values.length > 1 ? values : values[0]}];
  });
  return {
    scene: sceneNamed(words.s) ? words.s : undefined, lanes: words.w ? words.w.split(",") : undefined, dt: number(words.dt, 1e-9, 10), changes,
    steps: Math.round(number(words.n, 0, 2e6) || 0), speed: number(words.speed, 1e-6, 8), beside: words.beside === "1", magnified: number(words.magnified, 1, 1000),
    lesson: Math.round(number(words.lesson, 0, 6) || 0), lang: words.lang,
  };
}

// The state of a link, at once: steps are taken before anything is shown, up to a second's worth.
function openState(state) {
  lab.speed = state.speed || 1; lab.beside = state.beside; lab.playing = false;
  const {n, s} = (sceneNamed(state.scene) || DATA.scenes[0]).system;
  const inside = ({parameter, value}) => !LISTS.includes(parameter) || value.every(i => i >= 0 && i < (parameter === "break" ? s : n));
  openScene(state.scene, {lanes: state.lanes || ["kick_drift"], dt: state.dt, changes: state.changes.filter(inside), magnified: state.magnified});
  lab.firstDt = lab.dt;
  const begin = performance.now();
  let taken = 0;
  for (; taken < state.steps && performance.now() - begin < 3000; taken++) { oneStep(); if (taken % 16 === 15) keepPast(); }
  if (taken) keepPast();
  lab.dt = lab.lanes[0].world.dt;
  lab.short = taken < state.steps;
  askLimits();
}

const linkText = () => location.href.split("#")[0] + "#" + stateText();

// The command line that comes to the present state, as far as a command can say it.
function commandText() {
  const names = [...new Set(lab.lanes.map(lane => lane.recording ? lane.recording.stepper : lane.scheme))];
  const words = ["springlab", "compare", quoted(lab.scene.command), ...names.map(name => `--stepper=${quoted(name)}`), `--dt=${startDt()}`];
  words.push(`--duration=${+Math.max(laneTime(), lab.dt).toPrecision(12)}`);
  for (const [key, value] of Object.entries(lab.scene.settings)) words.push(`--set=${key}=${value}`);
  for (const {time, parameter, value} of lab.changes) {
    if (parameter !== "dt") words.push(`--change=${time}:${parameter}=${[value].flat().join(",")}`);
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
  const rows = lab.lanes.flatMap(({scheme, world: {memory: {F, at}}}) => Array.from({length: n}, (_, i) =>
    [scheme.replace(/[",\n]/g, " "), i, ...axes.map((_, axis) => F[at.x + d * i + axis]), ...axes.map((_, axis) => F[at.v + d * i + axis])].join(",")));
  return [["stepper", "mass", ...axes.map(axis => `${axis} [m]`), ...axes.map(axis => `v${axis} [m/s]`)].join(","), ...rows].join("\n") + "\n";
}

function download(name, href) {
  const link = document.createElement("a");
  Object.assign(link, {href, download: name});
  document.body.append(link); link.click(); link.remove();
}

const asFile = (text, type) => URL.createObjectURL(new Blob([text], {type}));
const embedText = () => `<iframe src="${linkText().replace(/&/g, "&amp;")}" width="800" height="900" title="springlab" style="border:0"></iframe>`;
