// Moves the lines of every animation on a page: report/film/animations.py makes what it reads.
for (const figure of document.querySelectorAll(".motion")) {
  const data = JSON.parse(figure.querySelector("script").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const places = new Int16Array(bytes(data.places)), colours = new Uint8Array(bytes(data.colours));
  const order = new Uint16Array(bytes(data.order));
  const lines = figure.querySelectorAll("line"), dots = figure.querySelectorAll("circle");
  const masses = places.length / 2 / data.frames, springs = data.springs.length / 2;
  const widths = [];
  lines.forEach((line, i) => widths[order[(data.frames - 1) * springs + i]] = line.getAttribute("stroke-width"));
  const at = (frame, mass, axis) => places[2 * (frame * masses + mass) + axis] / data.parts;
  const show = (frame) => {
    lines.forEach((line, i) => {
      const spring = order[frame * springs + i], a = data.springs[2 * spring], b = data.springs[2 * spring + 1];
      line.setAttribute("x1", at(frame, a, 0)); line.setAttribute("y1", at(frame, a, 1));
      line.setAttribute("x2", at(frame, b, 0)); line.setAttribute("y2", at(frame, b, 1));
      line.setAttribute("stroke", data.palette[colours[frame * springs + spring]]);
      line.setAttribute("stroke-width", widths[spring]);
    });
    dots.forEach((dot, i) => {
      dot.setAttribute("cx", at(frame, data.dotted[i], 0)); dot.setAttribute("cy", at(frame, data.dotted[i], 1));
    });
  };
  const controls = document.createElement("figcaption"), button = document.createElement("button");
  const slider = document.createElement("input");
  Object.assign(slider, {type: "range", min: 0, max: data.frames - 1, value: data.frames - 1});
  slider.setAttribute("aria-label", `time, ${figure.dataset.name}`);
  controls.append(`${figure.dataset.name} `, button, slider);
  figure.append(controls);
  let playing = false, begin = 0;
  const each = 1000 * data.duration / (data.frames - 1);
  const tick = (now) => {
    if (!playing) return;
    const frame = Math.max(0, Math.floor((now - begin) / each)) % data.frames;  // a frame can begin before "begin"
    slider.value = frame;
    show(frame);
    requestAnimationFrame(tick);
  };
  const play = (wanted) => {
    playing = wanted;
    button.textContent = playing ? "Pause" : "Play";
    begin = performance.now() - (slider.value % (data.frames - 1)) * each;
    if (playing) requestAnimationFrame(tick);
  };
  addEventListener("beforeprint", () => { play(false); slider.value = data.frames - 1; show(data.frames - 1); });
  button.onclick = () => play(!playing);
  slider.oninput = () => { play(false); show(+slider.value); };
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
}
