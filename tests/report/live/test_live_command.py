"""The command `springlab live` itself: what it says in a line, and that it ends when it is told to."""

from __future__ import annotations

import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator, Sequence

import pytest

from report.commands.live import _opened
from tests.report.commands.terminal import springlab
from tests.report.live.visit import ROOT, command_line, server
from tests.soak.guests import Guest


@pytest.fixture(scope="module")
def plain() -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """One that was told nothing: its address, and its process."""
    with server() as found:
        yield found


def refused(words: Sequence[str]) -> str:
    """The line on which it ends, with exit code 2."""
    done = subprocess.run(command_line(*words), capture_output=True, text=True, cwd=ROOT, timeout=600)
    assert done.returncode == 2, done.stderr
    (line,) = done.stderr.splitlines()
    return line


@pytest.mark.rotating(4, in_turn=True)
def test_a_port_in_use_is_one_line() -> None:
    """Whoever has it."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert f"cannot listen at port {port} of 127.0.0.1" in refused([f"--port={port}"])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["strin"], "unknown scene 'strin': did you mean 'string'?"),
        (["--stepper=huen"], "unknown stepper 'huen': did you mean 'heun'?"),
        (["--port=70000"], "port = 70000: expected a number from 0 to 65535"),
        (["--host=192.0.2.1"], "of 192.0.2.1"),
    ],
)
def test_what_cannot_be_is_one_line(words: Sequence[str], said: str) -> None:
    """192.0.2.1 is nobody's (RFC 5737)."""
    done = springlab("live", "--no-open", *words)
    assert done.code == 2
    (line,) = done.err.splitlines()
    assert said in line


@pytest.mark.rotating(4, in_turn=True)
def test_open_to_all_it_says_what_that_means() -> None:
    """And is there at every address of this machine; on loopback nothing is said."""
    with server("--host=0.0.0.0") as (address, process):
        (line,) = process.said  # type: ignore[attr-defined]
        assert line.startswith("listening at 0.0.0.0: whoever can reach this machine can use the lab")
        with urllib.request.urlopen(address.replace("localhost", "127.0.0.2")) as answer:
            assert b"<html" in answer.read().lower()


@pytest.mark.rotating(4, in_turn=True)
def test_on_loopback_alone_nothing_is_said_and_nobody_else_gets_in(plain: tuple[str, subprocess.Popen[str]]) -> None:
    """127.0.0.2 is this machine's, too, but not the address that it listens at."""
    address, process = plain
    assert process.said == []  # type: ignore[attr-defined]
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", int(address.rpartition(":")[2])), timeout=600)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere there always is one")
def test_without_a_browser_the_address_is_said() -> None:
    """On a machine without windows; who opens it is let in."""
    with server("--open") as (_, process):
        assert process.stdout is not None
        assert process.stdout.readline().startswith("no browser found here: open http://localhost:")


@pytest.mark.rotating(4, in_turn=True)
def test_viewers_who_vanish_in_the_middle_of_a_frame_are_no_news(plain: tuple[str, subprocess.Popen[str]]) -> None:
    """Neither to the others nor to whoever started it: the server's output has nothing more (see `server`)."""
    address, _ = plain
    stays = Guest(address)
    for _ in range(6):
        guest = Guest(address)
        guest.leave(politely=False)
    guest = Guest(address)
    before, deadline = stays.messages, time.monotonic() + 600
    while min(stays.messages - before, guest.messages) < 30 and time.monotonic() < deadline:
        time.sleep(0.02)
    assert min(stays.messages - before, guest.messages) >= 30
    stays.leave()
    guest.leave(politely=False)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere a browser needs no display by a name")
@pytest.mark.parametrize("display", ["DISPLAY", "WAYLAND_DISPLAY", None])
def test_a_browser_is_asked_where_there_is_a_screen_of_either_kind(
    display: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of X or of Wayland; without one, a browser would take over the terminal."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if display is not None:
        monkeypatch.setenv(display, ":0")
    asked: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda address: not asked.append(address))
    assert _opened("http://there") is (display is not None)
    assert asked == ["http://there"] * (display is not None)
