"""The live lab's server: viser's, on this machine alone unless told otherwise, with a page for each viewer."""

from __future__ import annotations

import contextlib
import io
import logging
import socket
import threading
import time
import warnings
from collections.abc import Sequence
from typing import Any

from reference.errors import InputError
from report.live.access import guarded, policy_for
from report.live.own_files import admit
from report.live.page import Page
from report.live.scenes import open_scene
from report.live.stepping import checked

#: Viewers with a simulation of their own; more than that two cores do not make.
MOST_VIEWERS = 8

#: Who has been turned away may come again.
FULL = "This lab has {} viewers already, each with a simulation of their own: come back when one has left."


class LiveServer:
    """A server under way, until `stop`.

    Args:
        scene, steppers: to begin with; own files among them are in all menus, and no other file is ever run.
        host: the address it listens at.
        port: 0 for any that is free.
        origins: of other pages that may come in, as "https://lab.example"; the lab's own page always may.

    Raises:
        InputError: for an unknown scene or stepper, a port that cannot be used, or an origin that is none.
    """

    def __init__(
        self,
        scene: str = "string",
        host: str = "127.0.0.1",
        port: int = 8080,
        steppers: Sequence[str] = ("kick_drift",),
        origins: Sequence[str] = (),
    ) -> None:
        open_scene(scene)
        policy = policy_for(host, origins)
        self._scene, self._steppers = scene, checked([admit(name) for name in steppers])
        check_port(host, port)
        import viser

        class Server(viser.ViserServer):  # type: ignore[misc]
            """One that never opens a way in from outside."""

            def request_share_url(self, *_: Any, **__: Any) -> None:
                """Refuse."""

        # A viewer may leave in the middle of a frame: what was for it is nobody's then.
        warnings.filterwarnings("ignore", message="Queued a .* on a closed connection")
        self.pages: dict[int, Page] = {}
        self._lock = threading.Lock()
        with guarded(policy), contextlib.redirect_stdout(io.StringIO()):  # it would print a table
            self._server = Server(host=host, port=port, label="springlab live", verbose=False)
        self._server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="large")
        # In place of viser's environment and shadows, which cost a page seconds without a graphics card.
        self._server.scene.configure_environment_map(hdri=None)
        self._server.scene.configure_default_lights(cast_shadow=False)
        self._server.scene.add_light_ambient("/light", intensity=1.5)
        self._server.scene.set_up_direction("+y")
        self._server.on_client_connect(self._welcome)
        self._server.on_client_disconnect(self._goodbye)

    @property
    def address(self) -> str:
        """What to open in a browser."""
        host = self._server.get_host()
        return f"http://{'localhost' if host in ('0.0.0.0', '127.0.0.1', '::') else host}:{self._server.get_port()}"

    def stop(self) -> None:
        """End all pages, then the server."""
        # Viewers who are still there are cut off: what websockets says of that is no news.
        logging.getLogger("websockets.server").setLevel(logging.CRITICAL)
        with self._lock:
            pages, self.pages = list(self.pages.values()), {}
        for page in pages:
            page.end()
        for page in pages:
            page.wait()
        with contextlib.redirect_stdout(io.StringIO()):
            self._server.stop()

    def wait(self) -> None:
        """For ever."""
        while True:
            time.sleep(3600)

    # Coroutines: viser runs them one after the other, so that nobody leaves before they have come.

    async def _welcome(self, client: object) -> None:
        from viser import ClientHandle

        assert isinstance(client, ClientHandle)
        with self._lock:
            if len(self.pages) >= MOST_VIEWERS:
                client.gui.add_markdown(FULL.format(MOST_VIEWERS))
                return
            self.pages[client.client_id] = Page(client, self._scene, self._steppers, lambda: company(len(self.pages)))

    async def _goodbye(self, client: object) -> None:
        with self._lock:
            page = self.pages.pop(client.client_id, None)  # type: ignore[attr-defined]
        if page is not None:
            page.end()


def company(number: int) -> str:
    """What is said of viewers and simulations."""
    here = "you are the only viewer" if number <= 1 else f"{number} viewers are here, each with their own"
    return f"This simulation is yours alone; {here}. At most {MOST_VIEWERS} can be."


def check_port(host: str, port: int) -> None:
    """Refuse a port that is taken, or an address that is not this machine's. Raises InputError."""
    if not 0 <= port <= 65535:
        raise InputError(f"port = {port}: expected a number from 0 to 65535")
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        with socket.socket(found[0], socket.SOCK_STREAM) as attempt:
            attempt.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            attempt.bind(found[4])
    except OSError as error:
        raise InputError(
            f"cannot listen at port {port} of {host} ({error.strerror or error}): try another --port"
        ) from None
