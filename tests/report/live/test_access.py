"""Who is let in to the live page: its own page, whatever this machine is called, and no other one.

The server is a real one; the other side is a client that says of itself what a browser would say of a page.
"""

from __future__ import annotations

import http.client
from collections.abc import Iterator

import pytest
from websockets.exceptions import InvalidStatus

from reference.errors import InputError
from report.live.access import AccessPolicy, policy_for
from report.live.server import LiveServer
from tests.soak.guests import Guest


@pytest.fixture(scope="module")
def lab() -> Iterator[LiveServer]:
    """A server that also lets in one page from elsewhere."""
    server = LiveServer(port=0, origins=["https://lab.example"])
    yield server
    server.stop()


def status(lab: LiveServer, **headers: str) -> int:
    """What a plain request is answered with."""
    connection = http.client.HTTPConnection("127.0.0.1", port_of(lab), timeout=600)
    connection.putrequest("GET", "/", skip_host=True)
    for name, value in headers.items():
        connection.putheader(name, value.format(port=port_of(lab)))
    connection.endheaders()
    try:
        with connection.getresponse() as response:
            return response.status
    finally:
        connection.close()


def port_of(lab: LiveServer) -> int:
    """Where it listens."""
    return int(lab.address.rpartition(":")[2])


FOREIGN = ("http://evil.example", "http://127.0.0.1:1", "https://127.0.0.1:{port}", "http://localhost:{port}", "null")


@pytest.mark.parametrize("origin", FOREIGN)
def test_a_foreign_origin_opens_no_socket_and_gets_no_page(lab: LiveServer, origin: str) -> None:
    """Nor another port of this machine, another scheme, another of its names, or a page of no origin."""
    with pytest.raises(InvalidStatus) as refusal:
        Guest(lab.address.replace("localhost", "127.0.0.1"), origin=origin.format(port=port_of(lab)))
    assert refusal.value.response.status_code == 403
    assert status(lab, Host="127.0.0.1:{port}", Origin=origin) == 403


def test_its_own_origin_opens_one(lab: LiveServer) -> None:
    """And a lab comes with it."""
    guest = Guest(lab.address)
    guest.wait_for("t = ")
    guest.leave()


def test_who_says_no_origin_opens_no_socket(lab: LiveServer) -> None:
    """Every browser says it."""
    with pytest.raises(InvalidStatus):
        Guest(lab.address, origin=None)


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("localhost:{port}", 200),
        ("127.0.0.1:{port}", 200),
        ("[::1]:{port}", 200),
        ("LOCALHOST:9000", 200),
        ("lab.example", 200),
        ("evil.example:{port}", 403),
        ("localhost.evil.example", 403),
        ("evil.example@localhost", 403),
        ("[::1", 403),
        ("", 403),
    ],
)
def test_only_a_host_that_is_this_machine_gets_the_page(lab: LiveServer, host: str, expected: int) -> None:
    """Through whatever port it is forwarded; a name of somebody's own is none, wherever it leads to."""
    assert status(lab, Host=host) == expected


def test_a_page_that_is_allowed_comes_in_and_others_do_not_with_it() -> None:
    """It may be loaded from this machine, or from where it says that it is."""
    policy = policy_for("0.0.0.0", ["https://Lab.example:443/"])
    assert policy.origins == {"https://lab.example"}
    assert policy.allows("lab.example", "https://lab.example", "10.0.0.5", handshake=True)
    assert policy.allows("localhost:8080", "https://lab.example", "10.0.0.5", handshake=True)
    assert not policy.allows("evil.example", "https://lab.example", "10.0.0.5", handshake=True)
    assert not policy.allows("lab.example", "http://lab.example", "10.0.0.5", handshake=True)


def test_open_to_all_its_own_addresses_are_those_that_are_come_to() -> None:
    """Whoever comes to 10.0.0.5 may call it so; 0.0.0.0 is nobody's name."""
    policy = AccessPolicy("0.0.0.0")
    assert policy.allows("10.0.0.5:8080", None, "10.0.0.5", handshake=False)
    assert not policy.allows("10.0.0.5:8080", None, "10.0.0.5", handshake=True)
    assert policy.allows("10.0.0.5:8080", "http://10.0.0.5:8080", "10.0.0.5", handshake=True)
    assert not policy.allows("10.0.0.6:8080", "http://10.0.0.6:8080", "10.0.0.5", handshake=True)
    assert not policy.allows("0.0.0.0:8080", "http://0.0.0.0:8080", "10.0.0.5", handshake=True)


@pytest.mark.parametrize(
    "origin", ["*", "lab.example", "ftp://lab.example", "http://", "http://a@b", "http://a/b", "http://[", "http://a:x"]
)
def test_what_is_no_origin_is_refused(origin: str) -> None:
    """In a line."""
    with pytest.raises(InputError, match=r"--allow-origin .*: expected as in https://lab\.example"):
        policy_for("127.0.0.1", [origin])
