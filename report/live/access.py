"""Access to the live page: which pages and clients its server answers, and what they may send; others get one line.

A browser lets any web page speak to any address, this machine's own included, and a name of that page's own may be made
to mean this machine (DNS rebinding). What tells such a page from ours is what the browser says of it and no page can
change: the Origin it was loaded from, and the Host it asks for (RFC 6454, RFC 9110; for WebSockets RFC 6455, 10.2).
"""

from __future__ import annotations

import contextlib
import http
import threading
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from reference.errors import InputError
from report.live.messages import LARGEST, well_formed
from report.live.title import titled

#: What everyone calls this machine, and itself only.
OWN_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})

#: Addresses to listen at that mean each of the machine's: nobody is called so.
EVERY_ADDRESS = frozenset({"", "0.0.0.0", "::"})

_PATCHING = threading.Lock()


@dataclass(frozen=True)
class AccessPolicy:
    """Which Host and Origin are answered.

    Attributes:
        host: the address the server listens at; one of its own names besides OWN_NAMES.
        origins: allowed besides, as "https://lab.example:8443"; so is what they have for a Host.
    """

    host: str
    origins: frozenset[str] = frozenset()

    def allows(self, host: str, origin: str | None, arrived_at: str, handshake: bool) -> bool:
        """Whether a request is answered.

        Args:
            host, origin: its headers; browsers send no Origin with a page's first request.
            arrived_at: the address of this machine it came to.
            handshake: whether it opens a WebSocket, with which browsers always say their Origin.
        """
        if origin is None:
            return not handshake and (self._own(host, arrived_at) or host in map(_place, self.origins))
        if origin in self.origins:
            return self._own(host, arrived_at) or host == _place(origin)
        return self._own(host, arrived_at) and origin == f"http://{host}"

    def _own(self, host: str, arrived_at: str) -> bool:
        names = OWN_NAMES | {arrived_at} | ({self.host} - EVERY_ADDRESS)
        return _name(host) in names


def policy_for(host: str, origins: Iterable[str]) -> AccessPolicy:
    """The policy of a server at an address. Raises InputError for an origin that is none."""
    return AccessPolicy(host.lower(), frozenset(map(_checked, origins)))


@contextlib.contextmanager
def guarded(policy: AccessPolicy) -> Iterator[None]:
    """A server of viser's that is started within has this policy.

    viser has no option for it: what it asks of websockets is changed on the way.
    """
    import websockets.asyncio.server as websockets

    serve = websockets.serve

    class Connection(websockets.ServerConnection):
        """One that passes on well-formed messages only."""

        async def recv(self, *arguments: Any, **named: Any) -> Any:
            """The next of them."""
            while not well_formed(raw := await super().recv(*arguments, **named)):
                pass
            return raw

    def serve_guarded(*arguments: Any, process_request: Any, **named: Any) -> Any:
        def answer(connection: Any, request: Any) -> Any:
            return _refusal(policy, connection, request) or titled(process_request(connection, request))

        named |= {"process_request": answer, "create_connection": Connection, "max_size": LARGEST}
        return serve(*arguments, **named)

    with _PATCHING:
        websockets.serve = serve_guarded  # type: ignore[assignment,misc]
        try:
            yield
        finally:
            websockets.serve = serve  # type: ignore[misc]


def _refusal(policy: AccessPolicy, connection: Any, request: Any) -> Any:
    """The response to whoever is not let in; None for those who are."""
    hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
    handshake = "upgrade" in request.headers
    arrived_at = str(connection.local_address[0]).removeprefix("::ffff:")
    origin = origins[0].lower() if origins else None
    if len(hosts) == 1 and len(origins) <= 1 and policy.allows(hosts[0].lower(), origin, arrived_at, handshake):
        return None
    return connection.respond(
        http.HTTPStatus.FORBIDDEN,
        "This lab is open to its own page only; `springlab live --allow-origin ORIGIN` opens it to others.\n",
    )


def _name(host: str) -> str:
    """The name in a Host header, without its port; nothing where it is malformed."""
    try:
        parts = urlsplit(f"//{host}")
        return (parts.hostname or "") if parts.netloc == host and "@" not in host else ""
    except ValueError:
        return ""


def _place(origin: str) -> str:
    """An origin's name and port, as a Host header has them."""
    return origin.partition("://")[2]


def _checked(origin: str) -> str:
    """An origin as browsers write it. Raises InputError for what is none."""
    try:
        parts = urlsplit(origin.lower())
        right = parts.scheme in ("http", "https") and parts.hostname and parts.port != 0
    except ValueError:
        right = False
    if not right or f"{parts.scheme}://{parts.netloc}" != origin.lower().rstrip("/") or "@" in parts.netloc:
        raise InputError(f"--allow-origin {origin!r}: expected as in https://lab.example or http://lab.example:8080")
    default = {"http": ":80", "https": ":443"}[parts.scheme]
    return f"{parts.scheme}://{parts.netloc.removesuffix(default)}"
