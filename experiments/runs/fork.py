"""A function begun in a copy of this process, which has imported all already, while this one is at something else."""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn, TypeVar

T = TypeVar("T")


@contextmanager
def begun(function: Callable[..., T], *arguments: object) -> Iterator[Callable[[], T]]:
    """Begin a function; what is given waits for what it returns.

    It is called here, when it is waited for, where this process cannot be copied (not on Linux, or it has threads,
    whose locks would stay locked in the copy), and where no answer comes from there: so what is wrong is told here.

    Args:
        function: what it does to its process is lost with the copy; what it returns can be pickled.
    """
    if sys.platform != "linux" or threading.active_count() > 1:
        yield lambda: function(*arguments)
        return
    reader, writer = os.pipe()
    copy = os.fork()
    if copy == 0:
        _answer(writer, function, arguments)
    os.close(writer)
    with open(reader, "rb") as pipe:

        def answer() -> T:
            content = pipe.read()
            found: T = pickle.loads(content) if content else function(*arguments)
            return found

        try:
            yield answer
        finally:
            os.kill(copy, signal.SIGKILL)
            os.waitpid(copy, 0)


def _answer(writer: int, function: Callable[..., object], arguments: tuple[object, ...]) -> NoReturn:
    """Write into a pipe what a function returns, or nothing, and end this process without another word."""
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        content = pickle.dumps(function(*arguments))
        with open(writer, "wb") as pipe:
            pipe.write(content)
    finally:
        os._exit(0)
