"""Helper processes that are stopped (SIGSTOP): a hang with its limit, whoever it is, and the work goes on without."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterator

import pytest

from engines.process import stopped
from engines.process.stopped import is_stopped, server_pid
from engines.process.supervisor import Supervisor
from reference.outcome import Outcome
from tests.engines.process import misbehaving, used

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there nobody is stopped")

#: [s], and [bytes]: what nothing comes near to.
LONG, MUCH = 600.0, 4 * 2**30


@pytest.fixture
def supervisor(monkeypatch: pytest.MonkeyPatch) -> Iterator[Supervisor]:
    """A supervisor; a server that is stopped is ended soon."""
    monkeypatch.setattr(stopped, "LOOK", 0.02)
    monkeypatch.setattr(stopped, "LOOKS", 5)
    found = Supervisor()
    yield found
    found.stop()


@pytest.mark.rotating(5, in_turn=True)
def test_a_stopped_server_is_replaced(supervisor: Supervisor) -> None:
    """What waits to be forked is forked by another."""
    supervisor.run(used.pid, (), LONG, MUCH)
    first = server_pid()
    assert first is not None
    os.kill(first, signal.SIGSTOP)
    # one process hangs, and is ended, which only the server could tell; another is to be forked in its place
    assert supervisor.run(misbehaving.hang, (), 0.5, MUCH) == Outcome("timed out", "no answer within 0.5 s")
    assert supervisor.run(misbehaving.fine, (), LONG, MUCH) == Outcome("done")
    assert server_pid() not in (None, first)


@pytest.mark.rotating(5, in_turn=True)
def test_a_stopped_worker_is_a_hang(supervisor: Supervisor) -> None:
    """With its time limit; and the next task is well."""
    pid = supervisor.run(used.pid, (), LONG, MUCH)
    stop = threading.Timer(0.5, os.kill, (pid, signal.SIGSTOP))
    stop.start()
    try:
        # it is tried again in a fresh process, which nobody stops, and which hangs by itself
        assert supervisor.run(misbehaving.hang, (), 1.5, MUCH) == Outcome("timed out", "no answer within 1.5 s")
    finally:
        stop.join()
    assert supervisor.run(misbehaving.fine, (), LONG, MUCH) == Outcome("done")


def test_one_that_is_stopped_is_told_from_one_that_waits(supervisor: Supervisor) -> None:
    """And nobody is, that is no more."""
    pid = supervisor.run(used.pid, (), LONG, MUCH)
    assert not is_stopped(pid)
    os.kill(pid, signal.SIGSTOP)
    for _ in range(1000):
        if is_stopped(pid):
            break
    assert is_stopped(pid)
    os.kill(pid, signal.SIGCONT)
    assert not is_stopped(2**22 + 1)


def test_a_server_that_goes_on_is_let_be(supervisor: Supervisor, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was only stopped for a moment, as with Ctrl-Z and fg."""
    monkeypatch.setattr(stopped, "LOOKS", 10**6)
    supervisor.run(used.pid, (), LONG, MUCH)
    server = server_pid()
    assert server is not None
    os.kill(server, signal.SIGSTOP)
    goes_on = threading.Timer(0.3, os.kill, (server, signal.SIGCONT))
    goes_on.start()
    assert Supervisor().run(misbehaving.fine, (), LONG, MUCH) == Outcome("done")
    goes_on.join()
    assert server_pid() == server
