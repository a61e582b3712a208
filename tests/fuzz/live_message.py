"""Messages to the live page: from a viewer who is one, of all the parts of its panel, with values that nobody sets."""

from __future__ import annotations

import io
import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr
from pathlib import Path
from random import Random
from typing import Any

import msgspec

from report.live.page import Page
from report.live.server import LiveServer
from report.plain import shortened
from tests.fuzz import wild
from tests.fuzz.doors import Enter
from tests.soak.guests import CAMERA, Guest

#: How long a page may take for its next frame [s], and how many messages are looked at together.
PATIENCE, TOGETHER = 120.0, 20

#: Parts that are set to what they can have, so that more than the start of a page is seen.
SOUND: list[tuple[str, list[Any]]] = [
    ("", ["Play", "Pause", "Step", "Reset"]),
    ("scene", ["string", "spring", "oscillator", "chain", "barrier"]),
    ("as on slide", ["13", "14", "15", "16"]),
    ("as on", ["Earth", "Moon", "Jupiter"]),
    ("lane 1", ["heun", "euler", "kick_drift"]),
    ("lane 2", ["-", "rk4"]),
    ("masses", [1, 2, 5, 9]),
    ("barrier in the way", [True, False]),
    ("side by side", [True, False]),
    ("Add lane", [True]),
    ("Copy command", [True]),
    ("CSV of this run", [True]),
    ("Picture", [True]),
    ("by name", ["heun", "drift_kick_sequential_damping(rounds=3)"]),
]

#: Parts that are numbers.
NUMBERS = [
    "dt [ms]",
    "speed [s of the scene in 1 s]",
    "mass [kg]",
    "stiffness [N/m]",
    "damping [N s/m]",
    "drag [N s/m]",
]
NUMBERS += ["rest length [m]", "gravity [m/s^2]", "back [s]", "steps a frame, at most", "masses", " "]


def make(random: Random) -> tuple[str, Any]:
    """What is sent: ("value", part and value), ("message", fields), or ("bytes", of a message that is damaged)."""
    kind = random.randrange(10)
    if kind < 2:
        part, values = wild.one_of(random, SOUND)
        return "value", (part, wild.one_of(random, values))
    if kind < 5:
        return "value", (wild.one_of(random, NUMBERS), wild.number(random))
    if kind < 7:
        part = wild.one_of(random, [*NUMBERS, *(part for part, _ in SOUND)])
        return "value", (part, wild.value(random))
    message = _message(random)
    if kind == 7:
        return "bytes", wild.damaged(random, msgspec.msgpack.encode(message))
    return "message", message


def _message(random: Random) -> dict[str, Any]:
    """A camera, a click, a drag, a picture, a part's attributes; or one of a kind that no page sends."""
    place = [wild.number(random) if random.random() < 0.2 else random.uniform(-1, 1) for _ in range(3)]
    node = {"name": wild.one_of(random, ["/lane0/masses", "/lane1/masses", "/true", wild.text(random)])}
    node |= {"instance_index": wild.one_of(random, [None, 0, 1, 5, -1, 10**6, 10**7, 2**40]), "modifier": None}
    screen = [random.random(), random.random()]
    messages: list[dict[str, Any]] = [
        {**CAMERA, "position": place},
        {**CAMERA, wild.one_of(random, [*CAMERA]): wild.value(random)},
        {"type": "SceneNodeClickMessage", **node, "ray_origin": place, "ray_direction": place, "screen_pos": screen},
        {
            "type": "SceneNodeDragMessage",
            **node,
            "phase": wild.one_of(random, ["start", "update", "end", "x"]),
            "start_position": place,
            "start_screen_pos": screen,
            "end_position": place,
            "end_screen_pos": screen,
            "button": wild.one_of(random, ["left", "middle", "right", "none"]),
        },
        {"type": "GetRenderResponseMessage", "payload": random.randbytes(8), "render_uuid": wild.text(random)},
        {"type": "GuiUpdateMessage", "uuid": wild.text(random), "updates": {"value": 1}},
        {"type": wild.text(random), "value": wild.value(random)},
        {"type": "ShareUrlRequest"},
        {"type": "FileTransferStartUpload", "source_component_uuid": "", "part_count": 10**9},
    ]
    found = wild.one_of(random, messages)
    return {key: _utf8(item) for key, item in found.items()}


def _utf8(item: Any) -> Any:
    """What MessagePack can write: no lone surrogates."""
    if isinstance(item, str):
        return item.encode(errors="replace").decode()
    if isinstance(item, list):
        return [_utf8(one) for one in item]
    return {_utf8(key): _utf8(one) for key, one in item.items()} if isinstance(item, dict) else item


class _Lab:
    """A server with a viewer who sends, anew after a problem."""

    def __init__(self) -> None:
        self.server = LiveServer(port=0)
        self.guest = Guest(self.server.address)
        self.guest.wait_for("t = ")
        (self.page,) = self.server.pages.values()

    def end(self) -> None:
        self.guest.leave()
        self.server.stop()


@contextmanager
def opened(_: Path) -> Iterator[Enter]:
    """After some messages the page is looked at, whether it makes frames, and whether anybody complained."""
    complaints = io.StringIO()
    handler = logging.StreamHandler(complaints)
    logging.getLogger().addHandler(handler)
    with redirect_stderr(complaints):
        lab = _Lab()
        sent: list[Any] = []

        def enter(made: Any) -> str:
            nonlocal lab
            _send(lab.guest, *made)
            sent.append(made)
            if len(sent) < TOGETHER:
                return "taken"
            problem = _problem(lab.page, complaints.getvalue)
            if problem:
                problem = f"{problem}\nof {[shortened(ascii(one), 100) for one in sent]}"
                lab.end()
                lab = _Lab()
                complaints.seek(0)
                complaints.truncate()
            sent.clear()
            return problem or "taken"

        try:
            yield enter
        finally:
            lab.end()
            logging.getLogger().removeHandler(handler)


def _send(guest: Guest, kind: str, what: Any) -> None:
    if kind == "bytes":
        guest.send_raw(what)
    elif kind == "message":
        guest.send(**what)
    else:
        part, value = what
        if part in guest.parts:
            guest.set(part, _utf8(value))


def _problem(page: Page, said: Callable[[], str]) -> str:
    """What is wrong with a page: it makes no frames, or somebody complains. Nothing, where nothing is."""
    frames, deadline = page.frames, time.monotonic() + PATIENCE
    while page.frames < frames + 2:
        if time.monotonic() > deadline or not page._thread.is_alive():
            return f"no frame within {PATIENCE:g} s: {said()[-1500:]}"
        time.sleep(0.002)
    return said()[-1500:]
