"""What a viewer's page may send: the form of messages, and the values its parts can have.

viser believes all that is sent to it, up to the inner attributes of its handles. Here is all that the live page sends,
with its sizes; other messages are dropped, and a value that a part cannot have is said to the viewer who sent it.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from report.plain import shortened

#: The largest message [bytes]: a picture of what is seen; and the largest of any other kind.
LARGEST, LARGEST_OTHER = 32 * 1024**2, 64 * 1024

#: A text that somebody types.
LONGEST_TEXT = 200

Name = Annotated[str, Meta(max_length=300)]
Real = Annotated[float, Meta(ge=-1e15, le=1e15)]
Pixels = Annotated[float, Meta(ge=0, le=16_384)]
Place = tuple[Real, Real, Real]
Point = tuple[Real, Real]
Index = Annotated[int, Meta(ge=0, le=1_000_000)]


class _Message(msgspec.Struct, tag_field="type", forbid_unknown_fields=True):
    """Any of them."""


class _Value(msgspec.Struct, forbid_unknown_fields=True):
    """A part's value, and no other of its attributes."""

    value: bool | int | float | str | list[int | float]


class _GuiUpdate(_Message, tag="GuiUpdateMessage"):
    uuid: Name
    updates: _Value


class _Camera(_Message, tag="ViewerCameraMessage"):
    wxyz: tuple[Real, Real, Real, Real]
    position: Place
    fov: Annotated[float, Meta(gt=0, lt=math.pi)]
    near: Real
    far: Real
    image_height: Pixels
    image_width: Pixels
    look_at: Place
    up_direction: Place


class _Click(_Message, tag="SceneNodeClickMessage"):
    name: Name
    instance_index: Index | None
    ray_origin: Place
    ray_direction: Place
    screen_pos: Point
    modifier: Name | None
    owner: Name = ""


class _Drag(_Message, tag="SceneNodeDragMessage"):
    phase: Literal["start", "update", "end"]
    name: Name
    instance_index: Index | None
    start_position: Place
    start_screen_pos: Point
    end_position: Place
    end_screen_pos: Point
    button: Literal["left", "middle", "right"]
    modifier: Name | None
    owner: Name = ""


class _Picture(_Message, tag="GetRenderResponseMessage"):
    payload: bytes
    render_uuid: Name


_SMALL = msgspec.msgpack.Decoder(_GuiUpdate | _Camera | _Click | _Drag | _Picture)
_LARGE = msgspec.msgpack.Decoder(_Picture)


def well_formed(raw: object) -> bool:
    """Whether it is a message such as the live page sends."""
    if not isinstance(raw, bytes) or len(raw) > LARGEST:
        return False
    try:
        (_SMALL if len(raw) <= LARGEST_OTHER else _LARGE).decode(raw)
    except (msgspec.MsgspecError, ValueError, RecursionError):
        return False
    return True


def complaint(part: Any, value: object) -> str:
    """Why a part of the page cannot have a value, in a line; nothing where it can.

    Args:
        part: a handle of viser's: its value now says the type, its `options`, `min` and `max` the range.
        value: as it was sent.
    """
    expected = _expected(part, value)
    return f"{part.label.strip() or 'slider'} = {shortened(repr(value))}: expected {expected}" if expected else ""


def _expected(part: Any, value: object) -> str:
    """What a part expects, where a value is not that."""
    now = part.value
    if options := getattr(part, "options", None):
        return "" if value in options else f"one of {', '.join(map(str, options[:4]))}{', ...' * (len(options) > 4)}"
    if isinstance(now, bool):
        return "" if isinstance(value, bool) else "yes or no"
    if isinstance(now, str):
        short_enough = isinstance(value, str) and len(value) <= LONGEST_TEXT and value.isprintable()
        return "" if short_enough else f"at most {LONGEST_TEXT} printable characters"
    low, high = (getattr(part, end, None) for end in ("min", "max"))
    low, high = -math.inf if low is None else low, math.inf if high is None else high
    several = isinstance(now, tuple)
    values = value if several else [value]
    if not isinstance(values, list | tuple) or (several and len(values) != len(now)):
        return f"{len(now)} numbers"
    if all(_is_number(x) and low <= x <= high for x in values):
        return ""
    return "a finite number" if math.isinf(low) and math.isinf(high) else f"a number from {low:g} to {high:g}"


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= 1e308
