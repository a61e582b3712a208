"""Where the live page may listen, and what is said of who is there; without a server."""

from __future__ import annotations

import socket
from typing import Any

import pytest

from reference.errors import InputError
from report.live.server import MOST_VIEWERS, check_port, company


def test_a_port_that_is_free_is_taken_and_one_that_is_taken_is_not() -> None:
    """One line, with the port and the address; it is free again afterwards."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(
            InputError, match=rf"cannot listen at port {port} of 127\.0\.0\.1 \(.+\): try another --port"
        ):
            check_port("127.0.0.1", port)
    check_port("127.0.0.1", 0)
    check_port("127.0.0.1", 0)


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_number_that_is_no_port_is_refused(port: int) -> None:
    """Beyond either end of them."""
    with pytest.raises(InputError, match=f"port = {port}: expected a number from 0 to 65535"):
        check_port("127.0.0.1", port)


def test_a_name_of_several_addresses_means_the_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it does for what listens; the last one of both port numbers is one, too."""

    def addresses(host: str, port: int, type: int) -> list[Any]:
        stream = (type, 6, "")
        return [(socket.AF_INET, *stream, ("127.0.0.1", 0)), (socket.AF_INET, *stream, ("192.0.2.1", 0))]

    monkeypatch.setattr(socket, "getaddrinfo", addresses)
    check_port("lab.example", 65535)
    monkeypatch.setattr(socket, "getaddrinfo", lambda *given, type: addresses(*given, type)[::-1])
    with pytest.raises(InputError, match=r"cannot listen at port 65535 of lab\.example"):
        check_port("lab.example", 65535)


@pytest.mark.parametrize(
    ("number", "said"),
    [(0, "you are the only viewer"), (1, "you are the only viewer"), (2, "2 viewers are here, each with their own")],
)
def test_how_many_are_there_is_said(number: int, said: str) -> None:
    """And how many can be."""
    assert company(number) == f"This simulation is yours alone; {said}. At most {MOST_VIEWERS} can be."
