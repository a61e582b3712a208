"""What is begun in a copy of the process answers from there; and here, where there is no copy or no answer."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import pytest

from experiments.runs.fork import begun

#: A process without threads, whose one copy answers, whose next ends without a word, and whose last goes on for ever.
PROGRAM = """
import os, time
from experiments.runs.fork import begun

here = os.getpid()

def this_one_only():
    if os.getpid() != here:
        os._exit(3)
    return here

def without_end():
    if os.getpid() != here:
        time.sleep(1000)

with begun(os.getpid) as number, begun(bytes, 10**6) as many:
    print(number() != here, len(many()))
with begun(this_one_only) as number:
    print(number() == here)
try:
    with begun(divmod, 1, 0) as quotient:
        quotient()
except ZeroDivisionError as error:
    print(error)
with begun(without_end) as never:
    pass
try:
    os.waitpid(-1, os.WNOHANG)
except ChildProcessError:
    print("no copy is left")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere processes are not copied")
def test_it_is_called_in_a_copy() -> None:
    """What is wrong is told here, where it is called again; a copy that nobody waits for ends."""
    ran = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    expected = ["True 1000000", "True", "integer division or modulo by zero", "no copy is left"]
    assert (ran.stdout.splitlines(), ran.stderr) == (expected, "")


def test_beside_threads_it_is_called_here() -> None:
    """When it is waited for, and by nobody else."""
    calls: list[int] = []
    done = threading.Event()
    thread = threading.Thread(target=done.wait)
    thread.start()
    try:
        with begun(lambda: calls.append(1) or os.getpid()) as number:
            assert not calls
            assert (number(), calls) == (os.getpid(), [1])
    finally:
        done.set()
        thread.join()
