// What people do: buttons, sliders, the pointer and the keyboard.

function setPlaying(wanted) {
  lab.playing = wanted && canGoOn();
  lab.debt = 0;
  showState();
}

function stepOnce() { lab.playing = false; oneStep(); keepPast(); showState(); }
function stepBack() { if (lab.past.length > 1) { lab.playing = false; rewind(lab.past.length - 2); showAll(); } }

function togglePin(mass) {
  const {I, at} = furthest().world.memory, held = I[at.fixed + mass];
  change(held ? "release" : "hold", [mass]);
  $("shared").textContent = say(held ? "released" : "held", {which: mass});
}

function setDt(ms) {
  const value = numberIn(ms) / 1e3, fine = value >= SHORTEST_DT && value <= LONGEST_DT;
  if (fine) change("dt", value);
  showAll();
  if (!fine) refuse($("dt"), say("dt"), number(1e3 * lab.dt, 6), say("expected_from", {least: number(1e3 * SHORTEST_DT), most: 1e3 * LONGEST_DT}));
}

function listen() {
  $("play").onclick = () => setPlaying(!lab.playing);
  $("step").onclick = stepOnce;
  $("back").onclick = stepBack;
  $("reset").onclick = () => { reset(); showAll(); };
  $("speed").onchange = event => { lab.speed = +event.target.value; };
  $("past").oninput = event => { lab.playing = false; showPast(+event.target.value); };
  $("past").onchange = event => { rewind(+event.target.value); showAll(); };
  $("scene").onchange = event => { lab.changes = []; lab.playing = false; openScene(event.target.value, {lanes: lab.lanes.map(lane => lane.scheme)}); showAll(); };
  $("add").onclick = () => setLanes([...lab.lanes.map(lane => lane.scheme), Object.keys(schemes).find(name => !lab.lanes.some(lane => lane.scheme === name)) || "rk4"]);
  $("magnified").onchange = event => { lab.magnified = +event.target.value; fitView(); };
  $("beside").onchange = event => { lab.beside = event.target.checked; };
  $("dt").onchange = event => setDt(event.target.value);
  $("dt-slider").oninput = event => setDt(1e3 * ofSlider(+event.target.value, [1e-5, 1]));
  $("language").onchange = event => { language = event.target.value; bannerKey = ""; translate(); };
  $("lesson").onchange = event => openLesson(+event.target.value);
  $("lesson-start").onclick = () => openLesson(lab.lesson);
  $("answer").oninput = checkLesson;
  const copy = text => navigator.clipboard.writeText(text).then(() => { $("shared").textContent = `${say("copied")} ${leftOut()}`; }, () => { $("command").textContent = text; });
  $("copy-link").onclick = () => { history.replaceState(null, "", "#" + stateText()); copy(linkText()); };
  $("copy-command").onclick = () => copy(commandText());
  $("copy-embed").onclick = () => copy(embedText());
  $("table").onclick = () => download(fileName("table.csv"), asFile(tableText(), "text/csv"));
  $("places").onclick = () => download(fileName("positions.csv"), asFile(placesText(), "text/csv"));
  $("picture").onclick = () => { draw(); download(fileName("picture.png"), canvas.toDataURL("image/png")); };
  addEventListener("hashchange", () => { if (!$(location.hash.slice(1))) openHash(); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", translate);
  listenToStage();
}

// A frame of the past, looked at while the slider moves; the run goes on from it once it is let go.
function showPast(k) {
  const frame = lab.past[k];
  if (frame) lab.lanes.forEach(({world: {memory: {F, at}}}, which) => F.set(frame.states[which], at.x));
}

function listenToStage() {
  let turning = null;
  const place = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  canvas.onpointerdown = event => {
    const [x, y] = place(event), found = massAt(x, y);
    canvas.setPointerCapture(event.pointerId);
    if (found && event.shiftKey) return togglePin(found.mass);
    if (found) { lab.grabbed = {...found, place: placeUnder(x, y, found)}; view.selected = found.mass; holdGrabbed(); }
    else turning = [x, y, view.yaw, view.pitch];
  };
  canvas.onpointermove = event => {
    const [x, y] = place(event);
    if (lab.grabbed) { lab.grabbed.place = placeUnder(x, y, lab.grabbed); holdGrabbed(); }
    else if (turning) { view.yaw = turning[2] + (x - turning[0]) / 150; view.pitch = Math.max(-1.4, Math.min(1.4, turning[3] + (y - turning[1]) / 150)); }
  };
  canvas.onpointerup = canvas.onpointercancel = () => { if (lab.grabbed) { lab.grabbed = null; showState(); } turning = null; };
  canvas.addEventListener("wheel", event => { if (event.ctrlKey) { event.preventDefault(); view.zoom *= Math.exp(-event.deltaY / 300); } }, {passive: false});
  canvas.onkeydown = event => { if (onKey(event.key, event.shiftKey)) event.preventDefault(); };
}

// The keyboard on the stage: all that a pointer does.
function onKey(key, shift) {
  const {n, d} = lab.scene.system, move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[key];
  if (key === " ") setPlaying(!lab.playing);
  else if (key === ".") stepOnce();
  else if (key === ",") stepBack();
  else if (key === "r" || key === "R") { reset(); showAll(); }
  else if (key === "+" || key === "=") view.zoom *= 1.2;
  else if (key === "-") view.zoom /= 1.2;
  else if ("nNbB".includes(key)) {
    const way = "nN".includes(key) ? 1 : n - 1;
    view.selected = view.selected === null ? (way === 1 ? 0 : n - 1) : (view.selected + way) % n;
    $("shared").textContent = say("chosen", {which: view.selected});
  } else if ((key === "p" || key === "P") && view.selected !== null) togglePin(view.selected);
  else if (move && view.selected !== null && !shift) nudge(move);
  else if (move && d === 3) { view.yaw += 0.1 * move[0]; view.pitch = Math.max(-1.4, Math.min(1.4, view.pitch - 0.1 * move[1])); }
  else return false;
  return true;
}

// The chosen mass a little aside, at rest.
function nudge([right, up]) {
  const found = {mass: view.selected, box: 0};
  const [left, top, width, height] = view.boxes[0], {seenAt} = lab.lanes[0];
  const px = left + width / 2 + seenAt[2 * found.mass] + 12 * right, py = top + height / 2 + seenAt[2 * found.mass + 1] - 12 * up;
  lab.grabbed = {...found, place: placeUnder(px, py, found)};
  holdGrabbed();
  lab.grabbed = null;
  showState();
}
