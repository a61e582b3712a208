"""What viewers send: nothing but what the live page sends, and a value that a part cannot have costs only itself."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import msgspec
import pytest

from report.live.messages import complaint, well_formed
from report.live.server import LiveServer
from tests.soak.guests import CAMERA, Guest

WRONG_VALUES: list[tuple[str, Any, str]] = [
    ("speed [s of the scene in 1 s]", math.nan, "speed [s of the scene in 1 s] = nan: expected a finite number"),
    ("speed [s of the scene in 1 s]", -1.0, "speed = -1: expected a number from 1e-06 to 1e+06"),
    ("dt [ms]", math.inf, "dt [ms] = inf: expected a finite number"),
    ("dt [ms]", 1e300, "dt = 1e+297: expected a number from 1e-12 to 1000 [s]"),
    ("dt [ms]", "1", "dt [ms] = '1': expected a finite number"),
    ("stiffness [N/m]", -1.0, "stiffness"),
    ("stiffness [N/m]", 1e308, "stiffness = 1e+308: expected a number of at most 1e+50 [N/m]"),
    ("as on slide", "99", "as on slide = '99': expected one of 13, 14, 15, 16"),
    ("as on", "Pluto", "as on = 'Pluto': expected one of Earth, Moon, Jupiter"),
    ("scene", "x" * 300, "scene = 'xxxxxx"),
    ("scene", "/etc/passwd", "scene = '/etc/passwd': expected one of"),
    ("scene", 7, "scene = 7: expected one of"),
    ("masses", 1e9, "masses = 1000000000.0: expected a number from 1 to 1000"),
    ("back [s]", -3, "back [s] = -3: expected a number from 0 to 10"),
    ("steps a frame, at most", 1e9, "steps a frame, at most = 1000000000.0: expected a number from 1 to 2000"),
    ("by name", "y" * 10_000, "expected at most 200 printable characters"),
    ("by name", "\x1b]0;hi\x07", "expected at most 200 printable characters"),
    ("side by side", "yes", "side by side = 'yes': expected yes or no"),
]


@pytest.fixture(scope="module")
def lab() -> Iterator[LiveServer]:
    """A server."""
    server = LiveServer(port=0)
    yield server
    server.stop()


@pytest.fixture(scope="module")
def guest(lab: LiveServer) -> Iterator[Guest]:
    """One viewer for all."""
    found = Guest(lab.address)
    found.wait_for("t = ")
    yield found
    found.leave()


def test_nothing_moves_before_somebody_looks(lab: LiveServer, guest: Guest) -> None:
    """A tab in the background draws no picture: its scene is not there yet, and begins once it is looked at."""
    before = set(lab.pages)
    waiting = Guest(lab.address, looks=False)
    waiting.once(lambda: waiting.messages > 0)
    assert set(lab.pages) == before
    waiting.send(**CAMERA)
    waiting.wait_for("t = ")
    assert len(lab.pages) == len(before) + 1
    waiting.leave()
    guest.once(lambda: set(lab.pages) == before)


@pytest.mark.parametrize(("part", "value", "said"), WRONG_VALUES, ids=lambda value: str(value)[:20])
def test_a_wrong_value_is_a_notice_and_the_page_lives_on(
    lab: LiveServer, guest: Guest, part: str, value: Any, said: str
) -> None:
    """The scene goes on as it was."""
    guest.set(part, value)
    guest.wait_for_notice(said)
    (page,) = lab.pages.values()
    frames, time, dt = page.frames, page.lab.timeline.time, page.lab.timeline.dt
    guest.once(lambda: page.frames > frames and page.lab.timeline.time > time)
    assert page.lab.timeline.dt == dt


def test_a_stiffness_that_no_dt_is_stable_for_blows_up_and_can_be_taken_back(lab: LiveServer, guest: Guest) -> None:
    """As large as it may be; beyond that it is refused."""
    (page,) = lab.pages.values()
    guest.set("stiffness [N/m]", 1e40)
    guest.once(lambda: not page.lab.playing)
    guest.set("stiffness [N/m]", 200.0)
    guest.set("", "Play")
    guest.once(lambda: page.lab.playing and page.lab.timeline.time > 0.1)


def test_inner_attributes_are_nobody_s_to_set(lab: LiveServer, guest: Guest) -> None:
    """Viser sets whatever attribute it is told; here only values arrive."""
    (page,) = lab.pages.values()
    part = page.controls._scene
    guest.send(type="GuiUpdateMessage", uuid=guest.part("scene"), updates={"removed": True})
    guest.send(type="GuiUpdateMessage", uuid=guest.part("scene"), updates={"value": "cloth", "update_cb": []})
    guest.set("as on slide", "98")
    guest.wait_for_notice("'98'")
    assert not part._impl.removed
    assert part._impl.update_cb
    assert part.value == "string"


def test_what_is_no_message_costs_nothing(guest: Guest) -> None:
    """Neither the connection nor the page: bytes that mean nothing, unknown kinds, texts, uploads."""
    for raw in (b"", b"\xc1", b"\x93" * 5000, msgspec.msgpack.encode([1, 2]), "text"):
        guest.send_raw(raw)
    guest.send(
        type="FileTransferStartUpload",
        source_component_uuid="",
        transfer_uuid="",
        filename="",
        mime_type="",
        part_count=1,
        size_bytes=1,
    )
    guest.send(type="RemoveSceneNodeMessage", name="/lane0/masses")
    guest.send(**{**CAMERA, "position": [math.nan, 0.0, 0.0]})
    guest.set("as on slide", "97")
    guest.wait_for_notice("'97'")


@pytest.mark.parametrize(
    "change",
    [
        lambda m: m | {"fov": 0.0},
        lambda m: m | {"position": [0.0, 0.0]},
        lambda m: m | {"position": [math.inf, 0.0, 0.0]},
        lambda m: m | {"near": 1e300},
        lambda m: m | {"image_height": -1},
        lambda m: m | {"image_width": 10**9},
        lambda m: m | {"more": 1},
        lambda m: m | {"type": "Camera"},
        lambda m: {key: m[key] for key in m if key != "fov"},
    ],
)
def test_a_camera_of_another_form_is_none(change: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    """As it is, it is one."""
    assert well_formed(msgspec.msgpack.encode(CAMERA))
    assert not well_formed(msgspec.msgpack.encode(change(CAMERA)))


def test_only_a_picture_may_be_large() -> None:
    """And no picture larger than 32 MiB."""
    picture = {"type": "GetRenderResponseMessage", "render_uuid": "u", "payload": bytes(2**20)}
    assert well_formed(msgspec.msgpack.encode(picture))
    assert not well_formed(msgspec.msgpack.encode(picture | {"payload": bytes(2**25 + 1)}))
    text = {"type": "GuiUpdateMessage", "uuid": "u", "updates": {"value": "x" * 2**20}}
    assert not well_formed(msgspec.msgpack.encode(text))
    short = text | {"updates": {"value": "x"}}
    assert well_formed(msgspec.msgpack.encode(short))
    assert not well_formed(msgspec.msgpack.encode(text | {"updates": {"value": "x", "removed": True}}))


def test_several_numbers_have_to_be_as_many_as_before() -> None:
    """A slider with two thumbs has two."""
    part = SimpleNamespace(value=(1, 2), label=" ", min=0, max=400)
    assert complaint(part, [3, 4]) == ""
    assert complaint(part, [3]) == "slider = [3]: expected 2 numbers"
    assert complaint(part, [3, 401]) == "slider = [3, 401]: expected a number from 0 to 400"
    from_one = SimpleNamespace(value=3, label="rows", min=1, max=None)
    assert complaint(from_one, 0) == "rows = 0: expected a number from 1 to inf"
    assert complaint(SimpleNamespace(value=3, label="any"), "0") == "any = '0': expected a finite number"
    assert complaint(part, [3, True]) == "slider = [3, True]: expected a number from 0 to 400"


def test_a_viewer_who_looks_at_nothing_sees_another_scene_too(lab: LiveServer, guest: Guest) -> None:
    """Where a camera is in the place that it looks at, it has no direction."""
    (page,) = lab.pages.values()
    guest.send(**{**CAMERA, "position": [0.0, 0.0, 0.0]})
    guest.set("scene", "spring")
    guest.once(lambda: page.lab.timeline.opened.name == "spring" and page.lab.timeline.time > 0)
    guest.send(**CAMERA)


def test_a_part_of_the_scene_before_is_no_mistake(lab: LiveServer, guest: Guest) -> None:
    """It is set while another scene is still to be opened, which has other parameters."""
    (page,) = lab.pages.values()
    guest.set("scene", "string")
    guest.once(lambda: page.lab.timeline.opened.name == "string")
    frames = page.frames
    guest.once(lambda: page.frames > frames + 2)  # and all is drawn anew
    guest.notices.clear()
    guest.set("scene", "oscillator")
    guest.set("barrier in the way", True)
    guest.once(lambda: page.lab.timeline.opened.name == "oscillator" and page.lab.timeline.time > 0)
    assert not guest.notices
