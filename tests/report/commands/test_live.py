"""`springlab live` without a server: what it begins with, what it says, and whether a browser is asked."""

from __future__ import annotations

import signal
from typing import Any

import pytest

from report.commands import live
from report.live import server
from tests.report.commands.terminal import springlab

#: What it begins with where nothing is given.
PLAIN = ("string", "127.0.0.1", 8080, ("kick_drift",), ())


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What was done, in order; nobody listens, and no browser is there."""
    done: list[Any] = []

    class Server:
        address = "http://here:8080"

        def __init__(self, *given: Any) -> None:
            done.append(given)

        def wait(self) -> None:
            done.append("wait")

        def stop(self) -> None:
            done.append("stop")

    monkeypatch.setattr(server, "LiveServer", Server)
    monkeypatch.setattr(live, "_opened", lambda address: done.append(address))
    monkeypatch.setattr(signal, "signal", lambda number, action: done.append((number, action)))
    return done


def test_it_opens_the_lab_on_this_machine_and_stops_it_in_the_end(done: list[Any]) -> None:
    """To be told to end is as good as Ctrl-C; where no browser is found, the address is said once more."""
    said = springlab("live")
    assert done == [
        (signal.SIGTERM, signal.default_int_handler),
        PLAIN,
        "http://here:8080",
        "wait",
        "stop",
    ]
    assert said.code == 0
    assert said.out == "springlab live: http://here:8080 (Ctrl-C ends it)\n"
    assert said.err == "no browser found here: open http://here:8080 in yours\n"


def test_what_is_given_is_passed_on(done: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """A browser that took it is not mentioned; that everybody can come in is said before."""
    monkeypatch.setattr(live, "_opened", lambda address: True)
    words = ["chain", "--stepper", "rk4", "--stepper", "euler", "--host", "0.0.0.0", "--port", "0"]
    said = springlab("live", *words, "--allow-origin", "https://a.example", "--allow-origin", "https://b.example")
    assert done[1] == ("chain", "0.0.0.0", 0, ("rk4", "euler"), ("https://a.example", "https://b.example"))
    assert said.err == "listening at 0.0.0.0: whoever can reach this machine can use the lab and its processor\n"


@pytest.mark.parametrize("host", ["localhost", "::1"])
def test_on_this_machine_alone_nothing_is_said(host: str, done: list[Any]) -> None:
    """By any of its names; and no browser is asked where none is wanted."""
    assert springlab("live", "--host", host, "--no-open").err == ""
    assert done[2:] == ["wait", "stop"]


def test_ctrl_c_ends_it_as_it_should(done: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """The server is stopped, the terminal's line ended."""

    def interrupted(_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(server.LiveServer, "wait", interrupted)
    said = springlab("live", "--no-open")
    assert (said.code, said.out.splitlines()[1:], said.err) == (0, [""], "")
    assert done[-1] == "stop"
