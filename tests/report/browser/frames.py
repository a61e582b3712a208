"""What a frame of the page costs in Chromium without a graphics card: `python -m tests.report.browser.frames [STATE]`.

Canvas 2D, rasterised in software. Printed for some seconds of play are frames a second, and per frame: script, all that
the page's thread did (script, style and raster), and CPU time of the renderer and of the process that puts pictures
together. On a machine that is busy otherwise frames come late that would not; the load is printed beside.

As the page gives steps only what drawing leaves of a frame, it is then played once more with all the steps of 1/60 s in
each frame, however long they take: the CPU time of that hangs little on what else the machine does, and below
16.7 ms the scene can run in real time at 60 frames a second.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import psutil

from report.browser.lab_page import lab_page
from report.browser.presets import PRESETS
from tests.report.chromium import VIEWS, Shown, chromium

#: A cloth of 30 x 30 masses and two lanes, one over the other.
STATE = "s=cloth_30&w=kick_drift,rk4"

#: For how long frames are counted [s], after as long again for the steps' share of a frame to settle.
SECONDS = 4

#: From now on each frame takes the steps of a sixtieth of a second.
ALL_STEPS = """() => {
    const own = stepLanes;
    stepLanes = () => { lab.budget = Infinity; return own(1 / 60); };
    reset(); setPlaying(true);
}"""

COUNT = """ms => new Promise(done => {
    let frames = 0;
    const begin = performance.now();
    const next = () => {
        frames++;
        if (performance.now() - begin < ms) requestAnimationFrame(next); else done(frames);
    };
    requestAnimationFrame(next);
})"""


def cost(browser: Any, file: Path, state: str) -> dict[str, float]:
    """Frames a second, costs of one [ms], and how much of real time the scene reaches."""
    shown = Shown(browser, file, VIEWS[0])
    page = shown.page
    page.evaluate("state => { location.hash = state; }", state)
    page.wait_for_timeout(1000 * SECONDS)
    page.evaluate("reset(); setPlaying(true)")
    page.wait_for_timeout(1000 * SECONDS)
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable")

    def now() -> dict[str, float]:
        measured = {one["name"]: one["value"] for one in session.send("Performance.getMetrics")["metrics"]}
        of_scene = {"scene": page.evaluate("laneTime()")}
        return measured | _processor_times() | of_scene

    def play() -> tuple[int, dict[str, float]]:
        before = now()
        frames = page.evaluate(COUNT, 1000 * SECONDS)
        return frames, {name: value - before.get(name, 0.0) for name, value in now().items()}

    frames, spent = play()
    page.evaluate(ALL_STEPS)
    frames_of_all, of_all = play()
    page.close()
    return {
        "frames a second": frames / spent["Timestamp"],
        "script [ms a frame]": 1e3 * spent["ScriptDuration"] / frames,
        "page's thread [ms a frame]": 1e3 * spent["TaskDuration"] / frames,
        "CPU of the renderer [ms a frame]": 1e3 * spent["renderer"] / frames,
        "CPU of compositing [ms a frame]": 1e3 * spent["gpu-process"] / frames,
        "part of real time": spent["scene"] / spent["Timestamp"],
        "CPU with all steps [ms a frame]": 1e3 * of_all["renderer"] / frames_of_all,
        "load of the machine": os.getloadavg()[0],
    }


def _processor_times() -> dict[str, float]:
    """CPU time [s] of this program's Chromium, by its kinds of processes."""
    times: Counter[str] = Counter()
    for process in psutil.Process().children(recursive=True):
        kinds = [word.removeprefix("--type=") for word in process.cmdline() if word.startswith("--type=")]
        spent = process.cpu_times()
        times[kinds[0] if kinds else "browser"] += spent.user + spent.system
    return dict(times)


def main() -> None:
    """Print it."""
    state = sys.argv[1] if len(sys.argv) > 1 else STATE
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        file = Path(folder) / "lab.html"
        file.write_text(lab_page([one for one in PRESETS if f"s={one.name or one.stem}" in state.split("&")]), "utf-8")
        for name, value in cost(browser, file, state).items():
            print(f"{name:34}{value:7.2f}")


if __name__ == "__main__":
    main()
