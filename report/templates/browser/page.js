// The page: its controls, its words, and what is drawn sixty times a second.

const $ = id => document.getElementById(id);
let language = "en";
const say = (key, words = {}) => (WORDS[language][key] ?? WORDS.en[key] ?? key).replace(/\{(\w+)\}/g, (_, name) => words[name] ?? "");
const number = (value, digits = 4) => value === undefined || value === null || Number.isNaN(value) ? "" : String(+value.toPrecision(digits));
const element = (name, settings = {}, ...inside) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(settings)) if (key in made && key !== "list") made[key] = value; else made.setAttribute(key, value);
  made.append(...inside);
  return made;
};

// Parameters as sliders have them: from, to; in powers of ten where the range is wide.
const RANGES = {mass: [1e-4, 1e4], rest_length: [1e-3, 10], stiffness: [1e-1, 1e9], damping: [1e-5, 1e6], drag: [1e-5, 1e3], gravity: [0, 30]};
const MAGNIFIED = [1, 3, 10, 30, 100, 300];
const SPEEDS = [1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 2, 4];

function translate() {
  document.documentElement.lang = language;
  document.title = say("title");
  for (const one of document.querySelectorAll("[data-t]")) one.textContent = say(one.dataset.t);
  for (const one of document.querySelectorAll("[data-label]")) one.setAttribute("aria-label", say(one.dataset.label));
  $("language").replaceChildren(...Object.keys(WORDS).map(key => element("option", {value: key, selected: key === language}, WORDS[key].language)));
  $("speed").replaceChildren(...SPEEDS.map(value => element("option", {value, selected: value === lab.speed}, `${value} × ${say("real_time")}`)));
  $("lesson").replaceChildren(...[0, 1, 2, 3, 4, 5, 6].filter(isHere).map(k => element("option", {value: k, selected: k === lab.lesson}, k ? `${k} ${say(`lesson_${k}_title`)}` : say("no_lesson"))));
  showAll();
}

// What is typed, with a comma or a point; nothing is no number.
const numberIn = text => String(text).trim() === "" ? NaN : Number(String(text).replace(",", "."));

// A field that keeps what it had: what was typed, and what was expected, in one line.
function refuse(field, name, kept, expected) {
  $("refused").textContent = say("refused", {name, value: field.value.slice(0, 40), expected});
  field.value = kept;
}

function showAll() { $("refused").textContent = ""; showScene(); showLanes(); showLimits(); showParameters(); showLesson(); showEquations(); showState(); }

const slidesSaid = slides => say(/^\d+$/.test(slides) ? "slide" : "slides", {slides});

function showScene() {
  const sizes = [...new Set([...MAGNIFIED, lab.magnified])].sort((a, b) => a - b);
  $("magnified").replaceChildren(...sizes.map(value => element("option", {value, selected: value === lab.magnified}, `${value} ×`)));
  $("scene").replaceChildren(...DATA.scenes.map(scene => element("option", {value: scene.name, selected: scene === lab.scene}, scene.title || scene.name)));
  const slides = lab.scene.slides ? ` (${slidesSaid(lab.scene.slides)})` : "";
  $("not-taken").textContent = lab.refused.length ? say("not_taken", {parts: lab.refused.join(", ")}) : "";
  const kinds = Object.keys(lab.scene.system.nonlinear || {}).map(name => say(name));
  const summary = WORDS[language][`scene_${lab.scene.scene}`] || lab.scene.summary;
  $("summary").textContent = summary + slides + (kinds.length ? ` ${say("kinds", {kinds: kinds.join(", ")})}` : "");
}

function swatch(k) {
  const shapes = [`<circle cx="10" cy="10" r="6"/>`, `<rect x="4" y="4" width="12" height="12"/>`, `<path d="M10 3 17 16H3Z"/>`, `<path d="M10 2 18 10 10 18 2 10Z"/>`];
  return `<svg viewBox="0 0 20 20" aria-hidden="true" fill="${colourOf(k)}">${shapes[k]}</svg>`;
}

const nameOf = lane => lane.recording ? say("recorded", {name: lane.recording.stepper}) : lane.scheme;

function showLanes() {
  const groups = {kind_engines: Object.keys(lab.scene.engines || {}).filter(engineNamed)};
  for (const [name, {kind}] of Object.entries(schemes)) (groups[`kind_${kind}`] ||= []).push(name);
  groups.kind_recorded = (lab.scene.recordings || []).map(one => `recorded:${one.name}`);
  const shown = name => name.startsWith("recorded:") ? say("recorded", {name: recordingNamed(name).stepper}) : name;
  $("lanes").replaceChildren(...lab.lanes.map((lane, k) => {
    const select = element("select", {id: `lane-${k}`, "aria-label": say("lane", {k: k + 1}), onchange: () => setLanes(lab.lanes.map((one, q) => q === k ? select.value : one.scheme))},
      ...Object.entries(groups).filter(([, names]) => names.length).map(([kind, names]) =>
        element("optgroup", {label: say(kind)}, ...names.map(name => element("option", {value: name, selected: name === lane.scheme}, shown(name))))));
    const item = element("li", {});
    item.insertAdjacentHTML("beforeend", swatch(k));
    item.append(select);
    if (lab.lanes.length > 1) item.append(element("button", {type: "button", "aria-label": say("remove_lane", {k: k + 1}), onclick: () => setLanes(lab.lanes.filter((_, q) => q !== k).map(one => one.scheme))}, "×"));
    return item;
  }));
  $("solving").hidden = !lab.lanes.some(({scheme}) => (schemes[scheme] || {}).implicit);
  const refused = Object.values(lab.scene.engines || {}).filter(Boolean);
  $("engines-refused").textContent = refused.length ? `${refused.join("; ")}.` : "";
  $("add").disabled = lab.lanes.length >= 4;
  $("beside").checked = lab.beside;
}

// Other lanes: from the start again with what is set.
function setLanes(names) {
  lab.changes = lab.changes.map(change => change);
  lab.playing = false;
  startLanes(names);
  showAll();
}

function limitsCame() { showLimits(); showBanner(); drawGrowth(); showNumbers(); checkLesson(); }

function showLimits() {
  if (document.activeElement !== $("dt")) $("dt").value = number(1e3 * lab.dt, 6);
  $("dt-slider").value = sliderOf(lab.dt, [1e-5, 1]);
  $("dt-slider").setAttribute("aria-valuetext", `${number(1e3 * lab.dt)} ms`);
  const items = lab.lanes.map((lane, k) => {
    const item = element("li", {});
    item.insertAdjacentHTML("beforeend", swatch(k).replace("<svg", `<svg width="14" height="14"`));
    item.append(element("span", {}, limitSaid(lane)));
    const {limit} = lab.limits[lane.scheme] || {};
    if (!lane.recording && limit > 0 && limit < Infinity) {
      const buttons = element("span", {className: "row"});
      item.append(buttons);
      for (const [part, key] of [[0.98, "to_limit"], [1.02, "beyond_limit"]]) {
        buttons.append(element("button", {type: "button", "aria-label": say(key, {k: k + 1}), title: say(key, {k: k + 1}), onclick: () => { change("dt", limit * part); showAll(); }}, `× ${part}`));
      }
    }
    return item;
  });
  items.push(...aboutSaid().map(text => element("li", {}, element("span", {className: "about small"}, text))));
  $("limits").replaceChildren(...items);
}

// Of scenes with obstacles: about which rest predictions are, of all lanes that have one, or of which.
function aboutSaid() {
  const predicted = lab.lanes.filter(({scheme, recording, engine}) => !recording && !engine && lab.limits[scheme] && lab.limits[scheme].limit !== null);
  const groups = {};
  for (const {scheme} of lab.scene.about ? predicted : []) {
    const about = lab.limits[scheme].alone ? say("without_obstacles") : restSaid();
    groups[about] = [...groups[about] || [], scheme];
  }
  const all = Object.entries(groups), named = all.length > 1 || predicted.length < lab.lanes.length;
  return all.map(([about, names]) => say(named ? "about_lanes" : "about_rest", {about, names: [...new Set(names)].join(", ")}));
}

function restSaid() {
  const count = new Set(lab.scene.contacts.map(({mass}) => mass)).size;
  return say(lab.scene.about, {masses: say(count === 1 ? "masses_1" : "masses_more", {count})});
}

function limitSaid(lane) {
  const name = lane.recording ? nameOf(lane) : lane.scheme;
  if (lane.engine) return say("engine_note", {...lane.engine, precision: say(`precision_${lane.engine.precision}`)});
  if (lane.recording) return say("recorded_note", {name, dt: number(1e3 * lane.recording.dt), error: number(lane.recording.error, 2)});
  const told = lab.limits[lane.scheme];
  if (!lab.scene.rest.length) return say("limit_unknown", {name, why: say("no_rest")});
  if (!told) return `${name}: ${say("computing")}`;
  if (told.limit === null) return say("limit_unknown", {name, why: say({"too large": "too_large", slow: "too_slow", corner: "corner", unheld: "unheld", unsolved: "unsolved"}[told.reason] || "no_rest")});
  if (told.reason === "nothing moves") return say("limit_nothing", {name});
  if (told.limit === 0) return say("limit_never", {name});
  if (told.limit === Infinity) return say("limit_always", {name});
  return say(told.about ? "limit_about" : "limit_of", {name, limit: number(1e3 * told.limit, 6), part: number(lab.dt / told.limit, 4)});
}

// Sliders of wide ranges go by powers; 0 is the lower end of those that can be zero.
const sliderOf = (value, [low, high]) => low > 0 ? Math.round(1000 * (Math.log(Math.max(value, low) / low) / Math.log(high / low))) : Math.round(1000 * (value - low) / (high - low));
const ofSlider = (place, [low, high]) => +(low > 0 ? low * (high / low) ** (place / 1000) : low + (high - low) * place / 1000).toPrecision(4);

// A parameter as one number, gravity downwards, and whether that is all there is to it.
function oneNumber(name) {
  const {F, at} = furthest().world.memory, [begin, count] = PARAMETERS[name](at), values = F.subarray(begin, begin + count);
  if (name === "gravity") return {same: -values[Math.min(1, at.d - 1)], all: true};
  return {same: values[0], all: values.every(value => value === values[0])};
}

const shownOf = name => { const {same, all} = oneNumber(name); return all ? number(same, 6) : ""; };
const expectedOf = name => name === "mass" ? say("expected_over", {most: LARGEST}) : say("expected_from", {least: name === "gravity" ? -LARGEST : 0, most: LARGEST});

function showParameters() {
  const box = $("parameters");
  for (const name of Object.keys(PARAMETERS)) {
    const {same, all} = oneNumber(name);
    let row = document.getElementById(`row-${name}`);
    if (!row) {
      const zero = !["mass", "rest_length"].includes(name), range = RANGES[name];
      const slider = element("input", {type: "range", min: zero && range[0] > 0 ? -1 : 0, max: 1000, id: `slider-${name}`, oninput: () => { set(+slider.value < 0 ? 0 : ofSlider(+slider.value, range)); }});
      const typed = element("input", {id: `typed-${name}`, className: "typed", inputMode: "decimal", autocomplete: "off", onchange: () => {
        const value = numberIn(typed.value);
        if (mayBe(name, value)) set(value); else refuse(typed, say(name), shownOf(name), expectedOf(name));
      }});
      const set = value => { change(name, value); $("refused").textContent = ""; showParameters(); showState(); };
      row = element("div", {className: "parameter", id: `row-${name}`}, element("label", {htmlFor: `typed-${name}`, id: `label-${name}`}), slider, typed);
      box.append(row);
    }
    $(`label-${name}`).textContent = say(name);
    const slider = $(`slider-${name}`), typed = $(`typed-${name}`), driven = lab.scene.drives.some(drive => drive.parameter === name);
    slider.disabled = typed.disabled = driven;
    slider.title = driven ? say("driven") : "";
    slider.setAttribute("aria-label", say(name));
    slider.value = all ? (same === 0 && RANGES[name][0] > 0 ? -1 : sliderOf(same, RANGES[name])) : 500;
    slider.setAttribute("aria-valuetext", all ? number(same) : say("as_scene"));
    if (document.activeElement !== typed) { typed.value = shownOf(name); typed.placeholder = all ? "" : "…"; typed.title = all ? "" : say("as_scene"); }
  }
}

function showLesson() {
  const box = $("lesson-box"), lesson = LESSONS[lab.lesson - 1];
  box.hidden = !lesson;
  if (!lesson) return;
  $("lesson-title").textContent = `${lab.lesson}. ${say(`lesson_${lab.lesson}_title`)} (${slidesSaid(lesson.slides)})`;
  $("lesson-text").textContent = say(`lesson_${lab.lesson}_text`);
  $("lesson-task").textContent = say(`lesson_${lab.lesson}_task`);
  $("lesson-answer").hidden = !lesson.answer;
  checkLesson();
}

const doneLessons = new Set();
function checkLesson() {
  if (!lab.lesson) return;
  const typed = $("answer").value;
  if (typed !== lessonState.typed) doneLessons.delete(lab.lesson);  // the last answer counts
  lessonState.typed = typed;
  if (lessonDone(typed)) doneLessons.add(lab.lesson);
  const lesson = LESSONS[lab.lesson - 1], done = doneLessons.has(lab.lesson);
  const text = done ? say("done") : lesson.answer && !typed ? "" : say("not_yet");
  if ($("lesson-state").textContent !== text) $("lesson-state").textContent = text;
}

function openLesson(k) {
  lab.lesson = k;
  doneLessons.delete(k);
  Object.assign(lessonState, startOfLesson());
  $("answer").value = "";
  if (k) openState(readState(LESSONS[k - 1].state));
  lab.lesson = k;
  translate();
}

function showEquations() {
  const names = [...new Set(lab.lanes.map(lane => lane.scheme).filter(name => schemes[name]))];
  $("equations").replaceChildren(...names.flatMap(name => {
    const {equations, kind, implicit} = schemes[name], summary = WORDS[language][`about_${name}`] || schemes[name].summary;
    const none = kind === "in_place" ? "no_equations" : implicit ? "no_equations_implicit" : "no_equations_other";
    const shown = element("div", {className: "equations wide", tabIndex: 0, role: "group", ariaLabel: `${say("equations")}: ${name}`});
    if (equations) shown.innerHTML = equations; else shown.textContent = `${name} ${say(none)}`;
    return [element("p", {className: "small"}, `${name}: ${summary}`), shown];
  }));
}

// What was said last: which lanes blew up and why, with the way back; a screen reader hears it once.
let bannerKey = "";
function showBanner() {
  const blown = lab.lanes.filter(lane => lane.world.blownUp && !lane.recording);
  const key = blown.map(lane => `${lane.scheme} ${lane.world.steps} ${language} ${Boolean(lab.mode)} ${Boolean(lab.limits[lane.scheme])}`).join();
  if (key === bannerKey) return;
  bannerKey = key;
  if (!blown.length) return $("said").replaceChildren();
  const said = blown.map(lane => {
    const {what, which} = lane.world.blownUp;
    return element("p", {}, `${say(`blew_${what}`, {name: lane.scheme, time: number(timeOf(lane.world)), which})} ${whyBlown(lane)}`);
  });
  const first = blown.reduce((one, other) => timeOf(other.world) < timeOf(one.world) ? other : one).world.blownUp.what;
  const buttons = [element("button", {type: "button", onclick: goBack}, say(["unsolved", "refused"].includes(first) ? "go_back_stopped" : "go_back"))];
  const shorter = shorterDt(blown);
  if (shorter >= SHORTEST_DT && shorter < Infinity) {
    buttons.push(element("button", {type: "button", onclick: () => { lab.dt = shorter; reset(); showAll(); }}, say("shorter", {dt: number(1e3 * shorter)})));
  }
  $("said").replaceChildren(element("div", {className: "banner"}, ...said, element("div", {className: "row"}, ...buttons)));
}

// A dt at which lanes that blew up may go on: below all limits, and half of one at which equations were not solved.
function shorterDt(blown) {
  const limits = lab.lanes.map(one => (lab.limits[one.scheme] || {}).limit).filter(value => value > 0 && value < Infinity);
  const beyond = blown.some(({scheme}) => (lab.limits[scheme] || {}).limit > 0 && lab.limits[scheme].limit < lab.dt);
  const halves = blown.filter(({world}) => world.blownUp.what === "unsolved").map(({world}) => world.dt / 2);
  return Math.min(...beyond ? [+(0.9 * Math.min(...limits)).toPrecision(2)] : [], ...halves.map(half => +half.toPrecision(3)));
}

function whyBlown(lane) {
  const told = lab.limits[lane.scheme], mode = lab.mode;
  if ((lane.world.blownUp || {}).what === "unsolved") return say(told && told.limit === Infinity ? "why_unsolved_stable" : "why_unsolved");
  if (!told || !mode || told.limit === null) return "";
  const scheme = schemes[lane.scheme], {dt} = lane.world, omega = number(Math.sqrt(mode.w2), 4);
  // what is no mode's growth, as on obstacles or where a scheme writes in place, is not given as the reason
  const factor = scheme.kind !== "in_place" && !told.alone ? growthOfMode(scheme, mode.w2, mode.g - mode.drag, mode.drag)(dt) : NaN, grows = factor > 1, growth = grows && factor < 1.0005 ? `1 + ${number(factor - 1, 2)}` : number(factor, 4);
  if (told.limit === 0) return grows ? say("why_never", {omega, growth}) : say("limit_never", {name: lane.scheme}) + ".";
  if (dt <= told.limit) return say("why_below");
  if (!grows) return say("why_over", {part: number(dt / told.limit, 4), limit: number(1e3 * told.limit, 4)});
  return say("why_beyond", {product: number(lane.world.dt * Math.sqrt(mode.w2), 4), most: number(told.limit * Math.sqrt(mode.w2), 4), omega, growth, springs: mode.springs.join(", ")});
}

function goBack() {
  let k = lab.past.findIndex(frame => frame.worlds.some(world => world.blownUp));
  k = Math.max(0, (k < 0 ? lab.past.length : k) - 12);
  lab.playing = false;
  rewind(k);
  showAll();
}

// Words where they are others: what is the same is not laid out again.
function write(place, text) { if (place.textContent !== text) place.textContent = text; }

function showState() {
  write($("play"), say(lab.playing ? "pause" : "play"));
  const {steps} = furthest().world;
  const words = [say("status", {scene: lab.scene.title || lab.scene.name, time: number(laneTime(), 5) || "0", steps, paused: lab.playing ? "" : say("paused")})];
  if (lab.playing && lab.reached < 0.9) words.push(say("slow", {part: number(lab.reached, 2)}));
  if (!canGoOn()) words.push(say("all_stopped"));
  else if (lab.short) words.push(say("link_short"));
  write($("status"), words.join(" "));
  $("past").max = lab.past.length - 1;
  if (document.activeElement !== $("past") || lab.playing) $("past").value = lab.past.length - 1;
  $("past").setAttribute("aria-valuetext", `${number(laneTime())} s`);
  write($("command"), commandText());
  write($("shared"), leftOut());
  showBanner();
  showNumbers();
  checkLesson();
}

// The table is made once; then its numbers change where they do.
function showNumbers() {
  const last = lab.series[lab.series.length - 1], first = lab.series[0];
  if (!last) return;
  const numbers = lab.lanes.flatMap((lane, k) => [number(timeOf(lane.world)), number(last.energy[k] - first.energy[k]), k ? number(last.apart[k]) : ""]);
  const shown = $("numbers"), made = `${language} ${lab.lanes.map(nameOf).join()}`;
  if (shown.dataset.made !== made) makeNumbers(shown, made);
  shown.querySelectorAll("td").forEach((cell, k) => write(cell, numbers[k]));
}

function makeNumbers(shown, made) {
  shown.dataset.made = made;
  const head = element("tr", {}, ...[say("scheme"), say("time") + " [s]", say("energy_plot"), say("apart_plot")].map(text => element("th", {scope: "col"}, text)));
  const row = lane => element("tr", {}, element("th", {scope: "row"}, nameOf(lane)), ...[0, 1, 2].map(() => element("td", {className: "number"})));
  shown.replaceChildren(element("thead", {}, head), element("tbody", {}, ...lab.lanes.map(row)));
}

// Sixty times a second.
let before = 0, told = 0;
function frame(now) {
  const ms = now - before;
  before = now;
  if (lab.playing) {
    shareFrame(ms);
    stepLanes(Math.min(ms / 1e3, 0.05) * lab.speed);
    if (!canGoOn()) { lab.playing = false; showState(); }
  }
  draw();
  if (lab.playing && now - told > 120) { drawNextPlot(); showState(); told = now; }
  if (!lab.playing && now - told > 400) { drawPlots(); told = now; }
  requestAnimationFrame(frame);
}

// A link that names no scene opens its lesson, or is about the scene that the page begins with; one to a place of the page
// is no state.
function openHash() {
  const hash = location.hash.slice(1), text = $(hash) ? "" : hash, named = /(^|&)s=/.test(text), lesson = !named && /(^|&)lesson=/.test(text);
  const state = readState(named || lesson ? text : `${DATA.first}&${text}`), here = isHere(state.lesson), refused = state.refused.slice();
  // a lesson has a scene and settings of its own
  for (const part of lesson ? text.split("&") : []) if (part && !/^(v|lang|lesson)=/.test(part) && !refused.some(one => one.startsWith(part))) refused.push(part.slice(0, 40));
  if (state.lang) language = state.lang;
  if (!here) refused.push(`lesson=${state.lesson}`);
  if (lesson && state.lesson && here) openLesson(state.lesson);
  else {
    lab.lesson = here ? state.lesson : 0;
    openState(lesson ? readState(DATA.first) : state);
  }
  lab.refused = refused;
  translate();
}

function begin() {
  openHash();
  listen();
  if (DATA.carried) $("licences").append(element("details", {}, element("summary", {}, say("licence", DATA.carried.engines[0])), element("pre", {tabIndex: 0}, DATA.carried.licence)));
  requestAnimationFrame(frame);
}

if (!DATA.carried) begin();
else loadEngines().then(begin, error => {
  for (const scene of DATA.scenes) for (const name of Object.keys(scene.engines)) scene.engines[name] = `${name}: ${error.message}`;
  begin();
});
