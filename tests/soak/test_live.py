"""Three viewers of the live lab who come and go, and sliders moved at random: nothing grows, nothing fails.

And the physics is right at the end. With --full 100,000 frames: half an hour of them, as quickly as they go.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
import psutil
import pytest

from report.live.lab import Lab
from report.live.page import Page
from report.live.scenes import names
from report.live.server import LiveServer
from tests.report.live.commands import ends
from tests.soak.guests import Guest

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(8)

#: Memory may grow by this part of itself, once everything has been imported and compiled.
GROWTH = 0.1

#: Whatever is waited for is there after this time [s].
PATIENCE = 600.0

MOVES = {"stiffness": (100, 300), "mass": (0.015, 0.03), "drag": (0, 0.1), "gravity": (1, 20)}


def move_at_random(lab: Lab, random: Random) -> None:
    """One thing of all that can be done with a string."""
    name = random.choice([*MOVES, "dt", "drag a mass", "let go", "pin", "rewind", "stepper", "reset"])
    if name in MOVES:
        lab.set_parameter(name, random.uniform(*MOVES[name]))
    elif name == "dt":
        lab.set_dt(random.choice([5e-4, 1e-3, 2e-3, 12e-3]))
    elif name == "drag a mass":
        lab.grab(random.randint(1, 10), np.array([random.uniform(-1, 1), random.uniform(-1, 1)]))
    elif name == "let go":
        lab.release()
    elif name == "pin":
        lab.toggle_pin(random.randint(1, 10))
        fixed = np.flatnonzero(lab.timeline.system.fixed).tolist()
        if len(fixed) > 1:
            lab.toggle_pin(fixed[-1])
    elif name == "rewind":
        lab.rewind(random.uniform(0, 5))
    elif name == "stepper":
        lab.set_steppers(random.sample(["kick_drift", "heun", "rk4", "euler_in_place"], random.randint(1, 3)))
    else:
        lab.reset()


def test_frames_without_a_page(request: pytest.FixtureRequest, tmp_path: Path) -> None:
    """Random moves every 20 frames; at the end each lane is where a plain run comes to, to rounding."""
    frames = 100_000 if request.config.getoption("--full") else 600
    lab, random, settled = Lab("string", ["kick_drift", "heun"]), Random(5), 0
    for i in range(frames):
        if i % 20 == 0:
            move_at_random(lab, random)
            lab.play()
        lab.frame(1 / 60)
        if i == frames // 4:
            gc.collect()
            settled = psutil.Process().memory_info().rss
    lab.release()
    lab.set_dt(9e-4)
    lab.advance(50)
    last = ends(lab.reproduction(), tmp_path)
    for lane in lab.timeline.lanes:
        assert lane.stopped is None or lane.blown_up
        if not lane.stopped:
            assert np.abs(lane.state.positions - last[lane.name].positions).max() <= 1e-12
    gc.collect()
    grown = psutil.Process().memory_info().rss / settled - 1
    print(f"\n{frames:,} frames: memory grew by {grown:.1%}")
    assert grown < GROWTH
    lab.end()


def test_viewers_come_and_go(request: pytest.FixtureRequest, capfd: pytest.CaptureFixture[str]) -> None:
    """Some vanish in the middle of a frame; pages end with them, and nothing is said of it."""
    full = request.config.getoption("--full")
    rounds = 2_000 if full else 12
    server, random = LiveServer("string", port=0), Random(7)
    guests: list[Guest] = []
    settled = 0
    for i in range(rounds):
        if len(guests) < 3:
            guests.append(Guest(server.address))
        elif random.random() < 0.2:
            guests.pop(random.randrange(3)).leave(politely=random.random() < 0.5)
        for page in ready(server):
            page.do(lambda page=page: disturb(page, random))  # type: ignore[misc]
        show_more(server)
        if i == rounds // 4:
            gc.collect()
            settled = psutil.Process().memory_info().rss
    assert any(page.frames for page in ready(server))
    for guest in guests:
        guest.leave()
    wait_until(lambda: not server.pages)
    grown = psutil.Process().memory_info().rss / settled - 1
    server.stop()
    said = capfd.readouterr()
    assert "Traceback" not in said.err + said.out, said.err
    print(f"\n{rounds} rounds of viewers: memory grew by {grown:.1%}")
    assert grown < GROWTH or not full


def ready(server: LiveServer) -> list[Page]:
    """The pages that have been built."""
    return [page for page in list(server.pages.values()) if hasattr(page, "controls")]


def show_more(server: LiveServer) -> None:
    """Until every page has shown one more frame, or its viewer is gone."""
    before = {page: page.frames for page in list(server.pages.values())}
    wait_until(lambda: all(page.frames > n or page not in server.pages.values() for page, n in before.items()))


def wait_until(seen: Callable[[], bool]) -> None:
    """Until something is so: a hang alone is caught here, however busy the machine is."""
    deadline = time.monotonic() + PATIENCE
    while not seen():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def disturb(page: Page, random: Random) -> None:
    """Move something, or open another scene."""
    if random.random() < 0.1:
        page.open(random.choice([name for name in names() if name in ("string", "barrier", "spring")]))
    elif page.lab.timeline.opened.name == "string":
        move_at_random(page.lab, random)
        page.controls.renew(page.lab)
        page.lab.play()
