"""What a worker's process does: one task after another, each in a folder of its own, until nobody asks any more.

Needs NumPy only, and the standard library.
"""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import pickle
import shutil
import signal
import sys
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from reference.errors import Fault, Unsupported
from reference.outcome import Outcome

if sys.platform == "linux":
    import fcntl

#: Where, in its scratch folder, a process's output is kept.
OUTPUT = "output.txt"

#: What is said before the first task: whatever goes wrong from then on is a task's doing.
READY = "ready"


def work(connection: Connection, lifeline: Connection, scratch: Path) -> None:
    """What the process does: tasks, one after another, until nobody is left to send one."""
    _hang_on(lifeline)
    with suppress(EOFError, OSError):  # nobody is there any more, or not even our folder
        _prepare(scratch)
        connection.send(READY)
        while True:
            _do(connection, connection.recv_bytes(), scratch / "run")
    shutil.rmtree(scratch, ignore_errors=True)
    os._exit(0)  # at once: Python would wait for what our tasks have started, and that ends when we do


def _prepare(scratch: Path) -> None:
    """Output goes into a file; Ctrl-C is for the one we work for to act on."""
    os.chdir(scratch)
    output = os.open(OUTPUT, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    for standard in (1, 2):
        os.dup2(output, standard)
    faulthandler.disable()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Under forkserver, which it would be here, Numba makes a semaphore that is left behind where a process is killed.
    multiprocessing.set_start_method("spawn", force=True)


def _hang_on(lifeline: Connection) -> None:
    """Let the kernel kill this process, whatever it is at, once nobody holds the other end of a pipe.

    On Linux. Its signal for a parent's end would not do: our parent is the server, which outlives the one we work for.
    """
    if sys.platform == "linux":
        fcntl.fcntl(lifeline, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(lifeline, fcntl.F_SETSIG, signal.SIGKILL)
        fcntl.fcntl(lifeline, fcntl.F_SETFL, os.O_ASYNC)
        if lifeline.poll():  # it happened before we listened
            os.kill(os.getpid(), signal.SIGKILL)


def _do(connection: Connection, message: bytes, folder: Path) -> None:
    """A task, in a folder that is removed afterwards; then its answer or its exception down the pipe."""
    os.ftruncate(1, 0)
    folder.mkdir()
    os.chdir(folder)
    try:
        function, arguments = _understood(message)
        answer = pickle.dumps(function(*arguments))
    except Unsupported as error:
        answer = pickle.dumps(Outcome("unsupported", str(error)))
    except Fault as error:  # it says what it is itself
        answer = pickle.dumps(Outcome("crashed", one_line(str(error))))
    except Exception as error:
        answer = pickle.dumps(Outcome("crashed", f"{type(error).__name__}: {one_line(str(error))}"))
    finally:
        os.chdir(folder.parent)
        shutil.rmtree(folder, ignore_errors=True)
    connection.send_bytes(answer)


def _understood(message: bytes) -> Any:
    """A task's function and arguments. Raises Unsupported for what stands in the program that asks for it."""
    try:
        return pickle.loads(message)
    except AttributeError as error:
        if "__main__" not in str(error):
            raise
        name = str(error).partition("attribute ")[2].split("'")[1]
        raise Unsupported(f"{name} stands in the program itself: expected it in a file that it imports") from None


def one_line(text: str) -> str:
    """A text without its line breaks, and not too long."""
    return " ".join(text.split())[:300]


if __name__ == "__main__":
    work(Connection(int(sys.argv[1])), Connection(int(sys.argv[2])), Path(sys.argv[3]))
