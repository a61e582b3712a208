"""Tasks and engines that misbehave, each in one way, in processes of their own: nothing heavy is imported here."""

from __future__ import annotations

import ctypes
import gc
import os
import signal
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NoReturn

import numpy as np

from engines.engine import CAPABILITIES
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem, Value


def fine() -> Outcome:
    """Come to an end."""
    return Outcome("done")


def segfault() -> Outcome:
    """Read address zero."""
    ctypes.string_at(0)
    return Outcome("done")


def abort() -> NoReturn:
    """Abort, with a last word on standard error."""
    os.write(2, b"no iterations: cannot go on\n")
    os.abort()


def leave(code: int) -> NoReturn:
    """End the process without an answer, skipping all of Python's cleaning up."""
    os._exit(code)


def exit_politely() -> NoReturn:
    """End the process without an answer, the way Python programs do."""
    sys.exit(0)


def divide() -> Outcome:
    """Raise an exception whose message has two lines."""
    raise ZeroDivisionError("mass 3 is zero\nand cannot be divided by")


def hang() -> NoReturn:
    """Never end, busily."""
    while True:
        pass


def sleep() -> NoReturn:
    """Never end, idly, deaf to polite requests."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while True:
        time.sleep(60)


def shout(code: int) -> Outcome:
    """Print 20 MB on both outputs and end, with an answer if the code is zero."""
    for standard in (1, 2):
        for _ in range(10):
            os.write(standard, b"words without end " * 60_000)
    if code:
        os._exit(code)
    return Outcome("done")


def answer_what_no_pickle_can_hold() -> Outcome:
    """Return something that cannot travel."""
    return Outcome("done", lambda: "")  # type: ignore[arg-type]


def leave_before_any_task(*_: object) -> NoReturn:
    """In place of `work`: the process ends before it is ready."""
    os._exit(3)


def die_in_mid_sentence() -> NoReturn:
    """Announce an answer of a thousand bytes, send ten, and be killed: as the kernel does when memory runs out."""
    (pipe,) = (o for o in gc.get_objects() if isinstance(o, Connection) and not o.closed and o.writable)
    os.write(pipe.fileno(), (1000).to_bytes(4, "big") + b"0123456789")
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def crash_and_leave_a_child() -> NoReturn:
    """Fork a child that lives on as long as the folder it works in, holding the pipe open, and abort."""
    if os.fork() == 0:
        with suppress(FileNotFoundError):
            while os.getcwd():
                time.sleep(0.05)
        os._exit(0)
    os.abort()


def leave_a_file() -> Outcome:
    """Write into the working folder, and say where that is."""
    Path("left.txt").write_text("here")
    return Outcome("done", str(Path.cwd()))


def load_in_bullet(obj: str) -> Outcome:
    """Give Bullet a mesh as a soft body, and step."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD, physicsClientId=client)
    Path("mesh.obj").write_text(obj)
    pybullet.loadSoftBody("mesh.obj", mass=1.0, useMassSpring=1, springElasticStiffness=100.0, physicsClientId=client)
    pybullet.stepSimulation(physicsClientId=client)
    return Outcome("done")


class Still:
    """A simulation in which nothing moves."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        self.x, self.v = system.positions.copy(), system.velocities.copy()

    def step(self) -> None:
        """Nothing moves."""

    def state(self) -> tuple[Array, Array]:
        """As at the start."""
        return self.x.copy(), self.v.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Makes no difference."""


class Segfaults(Still):
    """Reads address zero in its first step."""

    def step(self) -> None:
        """Crash."""
        segfault()


class Hangs(Still):
    """Never comes back from its first step."""

    def step(self) -> None:
        """Hang."""
        hang()


class GoesToNan(Still):
    """Loses mass 2 in its third step."""

    steps = 0

    def step(self) -> None:
        """Count."""
        self.steps += 1
        if self.steps == 3:
            self.x[2] = np.nan


class Raises(Still):
    """Raises an exception in its first step."""

    def step(self) -> None:
        """Raise."""
        divide()


@dataclass(frozen=True)
class Misbehaving:
    """An engine that steps by one of the classes above."""

    simulation: Callable[[MassSpringSystem, float], Still]
    capabilities: frozenset[str] = frozenset(CAPABILITIES)
    package: str = "numpy"
    settings: Mapping[str, object] = field(default_factory=dict)
    semantics: str = "stiffness, damping and drag mean nothing to it"

    @property
    def name(self) -> str:
        """The class's."""
        return str(self.simulation.__name__)

    @property
    def identified_as(self) -> Mapping[str, str]:
        """A claim it cannot keep."""
        return {"plain": "kick_drift"}

    def start(self, system: MassSpringSystem, dt: float) -> Still:
        """The simulation."""
        return self.simulation(system, dt)
