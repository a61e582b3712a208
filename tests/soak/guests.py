"""Viewers of the live lab without a browser: they connect as viser's page does, read all that is sent, and can send."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from typing import Any

#: What a page sends first.
CAMERA: dict[str, Any] = {
    "type": "ViewerCameraMessage",
    "wxyz": [1.0, 0.0, 0.0, 0.0],
    "position": [0.0, 0.0, 3.0],
    "fov": 1.0,
    "near": 0.1,
    "far": 100.0,
    "image_height": 600,
    "image_width": 800,
    "look_at": [0.0, 0.0, 0.0],
    "up_direction": [0.0, 1.0, 0.0],
}

#: So long something may take to be seen, on a busy machine [s].
PATIENCE = 600.0

#: Where a viewer comes from, unless told otherwise: from the page of the lab itself.
OWN = "own"


class Guest:
    """One viewer, reading in a thread until `leave`.

    Args:
        address: of the lab.
        origin: where its page says it was loaded from; None for a client that says nothing.
        looks: whether its page has been drawn, as that of a tab in the background has not.

    Attributes:
        messages: how many have been read.
        bytes: and how much.
        parts: of the panel, the last of each label: what they are called in messages.
        notices: what was said for a while.
    """

    def __init__(self, address: str, origin: str | None = OWN, looks: bool = True) -> None:
        import viser
        from websockets.sync.client import connect

        self.messages = self.bytes = 0
        self.parts: dict[str, str] = {}
        self.notices: list[str] = []
        self.shown = ""
        self._connection = connect(
            address.replace("http", "ws"),
            origin=address if origin == OWN else origin,  # type: ignore[arg-type]
            subprotocols=[f"viser-v{viser.__version__}"],  # type: ignore[list-item]
            max_size=None,
            compression=None,
        )
        if looks:
            self.send(**CAMERA)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def leave(self, politely: bool = True) -> None:
        """Go; or vanish, in the middle of a frame."""
        if politely:
            self._connection.close()
        else:
            self._connection.socket.close()
        self._thread.join(5)

    # What they send.

    def send(self, **message: Any) -> None:
        """A message."""
        import msgspec

        self.send_raw(msgspec.msgpack.encode(message))

    def send_raw(self, raw: bytes | str) -> None:
        """Whatever."""
        self._connection.send(raw)

    def set(self, label: str, value: Any) -> None:
        """Give a part of the panel a value."""
        self.send(type="GuiUpdateMessage", uuid=self.part(label), updates={"value": value})

    # What they see.

    def part(self, label: str) -> str:
        """What the part with a label is called in messages."""
        self.once(lambda: label in self.parts)
        return self.parts[label]

    def wait_for(self, words: str) -> None:
        """Until a banner of the panel has shown them last."""
        self.once(lambda: words in self.shown)

    def wait_for_notice(self, words: str) -> None:
        """Until they have been said; what was said before is forgotten."""
        self.once(lambda: any(words in notice for notice in self.notices), lambda: f"{words!r} in {self.notices}")
        self.notices.clear()

    def once(self, seen: Callable[[], bool], wanted: Callable[[], str] = lambda: "") -> None:
        """Wait until something is so."""
        deadline = time.monotonic() + PATIENCE
        while not seen():
            assert time.monotonic() < deadline, wanted()
            time.sleep(0.02)

    def _read(self) -> None:
        from websockets.exceptions import ConnectionClosed

        while True:
            try:
                message: Any = self._connection.recv()
            except (ConnectionClosed, OSError):
                return
            self.messages += 1
            self.bytes += len(message)
            self._note(message)

    def _note(self, raw: bytes) -> None:
        """Keep what there is to be seen in a batch of messages: two lengths, then what is compressed."""
        import msgspec
        import zstandard

        length = int.from_bytes(raw[8:16], "little")
        batch = msgspec.msgpack.decode(zstandard.ZstdDecompressor().decompress(raw[16 : 16 + length]))
        for message in batch["messages"]:
            self._note_one(message)

    def _note_one(self, message: dict[str, Any]) -> None:
        properties = message.get("props") or {}
        if "uuid" in message and "label" in properties:
            self.parts[properties["label"]] = message["uuid"]
        if message["type"] == "NotificationShowMessage":
            self.notices.append(properties["body"])
        content = message.get("updates", {}).get("content") or properties.get("content")
        if isinstance(content, str) and "role=" in content:  # a banner, and not the legend
            self.shown = content


if __name__ == "__main__":
    guest = Guest(sys.argv[1])
    guest._thread.join()
