"""Viewers of the live lab without a browser: they connect as viser's page does, and read all that is sent."""

from __future__ import annotations

import sys
import threading
from typing import Any


class Guest:
    """One viewer, reading in a thread until `leave`.

    Attributes:
        messages: how many have been read.
        bytes: and how much.
    """

    def __init__(self, address: str) -> None:
        import msgspec
        import viser
        from viser._messages import ViewerCameraMessage
        from websockets.sync.client import connect

        self.messages = self.bytes = 0
        self._connection = connect(
            address.replace("http", "ws"),
            subprotocols=[f"viser-v{viser.__version__}"],  # type: ignore[list-item]
            max_size=None,
            compression=None,
        )
        upright, away, nowhere = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 3.0), (0.0, 0.0, 0.0)
        camera = ViewerCameraMessage(upright, away, 1.0, 0.1, 100.0, 600, 800, nowhere, (0.0, 1.0, 0.0))
        self._connection.send(msgspec.msgpack.encode(camera.as_serializable_dict()))
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def leave(self, politely: bool = True) -> None:
        """Go; or vanish, in the middle of a frame."""
        if politely:
            self._connection.close()
        else:
            self._connection.socket.close()
        self._thread.join(5)

    def _read(self) -> None:
        from websockets.exceptions import ConnectionClosed

        while True:
            try:
                message: Any = self._connection.recv()
            except (ConnectionClosed, OSError):
                return
            self.messages += 1
            self.bytes += len(message)


if __name__ == "__main__":
    guest = Guest(sys.argv[1])
    guest._thread.join()
