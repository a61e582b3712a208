"""What the page costs the server: `python -m tests.soak.live_rate`.

A net of 2,025 masses and 3,960 springs, shown to one viewer, who is in a process of their own. The page's part is all
the processor time of the server's process but that of the lab (steps, measures, history).
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from report.live.lab import Lab
from report.live.server import LiveServer

#: Masses along each side, and for how long it is watched [s].
SIDE, SECONDS = 45, 20.0


def net() -> str:
    """The net as a scene file, held by one edge."""
    places = [[0.02 * i, 0.0, 0.02 * j] for j in range(SIDE) for i in range(SIDE)]
    number = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    across = np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], axis=1)
    along = np.stack([number[:-1].ravel(), number[1:].ravel()], axis=1)
    table = {"positions": places, "springs": [*across.tolist(), *along.tolist()], "masses": 0.001, "stiffness": 40.0}
    lines = [f"{key} = {json.dumps(value)}" for key, value in {**table, "fixed": list(range(SIDE))}.items()]
    return "\n".join(["dt = 1e-3", "", "[system]", *lines, ""])


class Watch:
    """How long a method takes of its thread's processor time [s]."""

    def __init__(self) -> None:
        self.seconds = 0.0
        frame = Lab.frame

        def timed(lab: Lab, elapsed: float) -> None:
            begin = time.thread_time()
            frame(lab, elapsed)
            self.seconds += time.thread_time() - begin

        Lab.frame = timed  # type: ignore[method-assign]


def main() -> None:
    """Watch, and say it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "net.toml"
        file.write_text(net())
        server = LiveServer(str(file), port=0)
        guest = subprocess.Popen([sys.executable, "-m", "tests.soak.guests", server.address])
        try:
            measure(server, Watch())
        finally:
            guest.kill()
            server.stop()


def measure(server: LiveServer, watch: Watch) -> None:
    """With one or two steps to a frame, once all that is compiled or imported has been."""
    while not server.pages:
        time.sleep(0.1)
    (page,) = server.pages.values()
    time.sleep(5)
    page.do(lambda: setattr(page.lab, "speed", 0.06))
    time.sleep(15)
    begin, cpu, lab, frames = time.perf_counter(), time.process_time(), watch.seconds, page.frames
    time.sleep(SECONDS)
    took, cpu, lab = time.perf_counter() - begin, time.process_time() - cpu, watch.seconds - lab
    frames = page.frames - frames
    system = page.lab.timeline.system
    print(f"{len(system.masses):,} masses, {len(system.springs):,} springs: {frames / took:.1f} updates/s")
    print(
        f"page {(cpu - lab) / took:.2f} of a core, {(cpu - lab) / frames * 1e3:.1f} ms an update; lab {lab / took:.2f}"
    )


if __name__ == "__main__":
    main()
