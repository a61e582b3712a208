"""What advances a lane bit by bit: a scheme of ours in this process, or an engine in a process of its own."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from engines.engine import Engine, find, registry, version
from engines.own.stepper import is_own
from engines.process.session import EngineStopped, Session
from reference.compiled.in_place import step_of
from reference.compiled.kernels import Kernel, loops_for
from reference.compiled.loops import Loops
from reference.errors import InputError, SolverError, Unsupported, unknown_name
from reference.forces import SpringMotion
from reference.obstacles import project_out
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.simulate import projected
from reference.state import State
from reference.system import MassSpringSystem, Value
from report.live import own_files

#: No more lanes than can be told apart by their colours.
MOST_LANES = 4

#: What an engine must be able to begin with, to go on from where a lane is.
NEEDED = frozenset({"stretched", "velocities"})


class Stopped(Exception):  # noqa: N818 - an ending
    """A stepper cannot go on; the message says why, in one line."""


class Stepping(Protocol):
    """Something that advances one state, from where it was started."""

    def advance(self, steps: int) -> State:
        """The state after a number of steps. Raises Stopped."""

    def change(self, parameter: str, value: Value) -> None:
        """Set one of PARAMETERS; the state goes on as it is. Raises Stopped."""

    def end(self) -> None:
        """Let go of what it holds."""


def choices() -> list[str]:
    """What a lane can be stepped by: every scheme, the wrong ones too, engines that can start in motion, own files."""
    able = [e.name for e in registry().values() if e.capabilities >= NEEDED and version(e) is not None]
    return [*catalogue.schemes(), *able, *own_files.opened()]


def checked(names: Sequence[str]) -> tuple[str, ...]:
    """The names of steppers, if they are known and not too many.

    Args:
        names: of engines; of own files that were admitted; of schemes, which may be aliases, or have parameters:
            xpbd_jacobi(iterations=3).

    Raises:
        InputError: for an unknown name, no name, or too many; for a parameter that a scheme does not have.
    """
    if not 1 <= len(names) <= MOST_LANES:
        raise InputError(f"{len(names)} lanes: expected from 1 to {MOST_LANES}")
    return tuple(checked_name(name) for name in names)


def checked_name(name: str) -> str:
    """A stepper's own name, for a name of it as `checked` takes them. Raises InputError as that does."""
    known = choices()
    if name in known:
        return name
    if is_own(name):
        raise InputError(
            f"stepper {name!r}: expected one of the files that `springlab live --stepper` was started with"
        )
    base = name.partition("(")[0]
    if base not in {**catalogue.schemes(), **catalogue.aliases()}:
        raise unknown_name("stepper", name, known)
    return catalogue.find(name).name


def scheme_behind(name: str, system: MassSpringSystem) -> Scheme:
    """The scheme that theory knows a stepper as, on this system: itself, or the one the engine is identified with.

    Raises:
        InputError: for an own file that was not identified, or cannot be used any more.
    """
    if name in own_files.opened():
        found = own_files.identified(name, system)
        if found.identified_as is None:
            raise InputError(f"not identified on a string: {found.reason}")
        return catalogue.find(found.identified_as)
    if name not in registry():
        return catalogue.find(name)
    case = "damping" if system.damping.any() else "drag" if system.drag else "plain"
    return catalogue.find(find(name).identified_as[case])


def stepping(name: str, system: MassSpringSystem, state: State, dt: float) -> Stepping:
    """The stepper of that name, on a system whose masses are at a state.

    Raises:
        InputError: for an unknown name.
        Stopped: where an engine or an own file cannot take the system; for springs that break.
    """
    if system.nonlinear is not None and system.nonlinear.breaks:
        raise Stopped(
            "unsupported: springs that break are drawn here as if they did not; `springlab simulate` tells them"
        )
    if name in own_files.opened():
        try:
            return EngineStepping(own_files.file_of(name), system, state, dt)
        except InputError as error:
            raise Stopped(str(error)) from None
    if name in registry():
        return EngineStepping(find(name), system, state, dt)
    return SchemeStepping(catalogue.find(checked_name(name)), system, state, dt)


class SchemeStepping:
    """A scheme, step by step as `simulate` has it; by compiled loops, which give the same bits, once there are some."""

    def __init__(self, scheme: Scheme, system: MassSpringSystem, state: State, dt: float) -> None:
        self._scheme, self._system, self._state, self._dt = scheme, system, state, dt
        self._motion = SpringMotion(system)
        self._kernel: Kernel | None = None

    def advance(self, steps: int) -> State:
        """See Stepping."""
        if self._kernel is None and _COMPILED.ready(self._scheme, self._system):
            self._kernel = Kernel(moved(self._system, self._state), self._scheme, threads=1)
        time = self._state.time + steps * self._dt
        with np.errstate(all="ignore"):
            if self._kernel is not None:
                self._kernel.advance(self._dt, steps)
                self._state = State(time, *self._kernel.state())
            else:
                self._state = replace(self._one_by_one(steps), time=time)
        return self._state

    def _one_by_one(self, steps: int) -> State:
        state, system, step = self._state, self._system, step_of(self._scheme, self._motion)
        try:
            for _ in range(steps):
                state = projected(system, step(state, self._dt), state.time + self._dt)
                if not np.isfinite(state.positions).all():
                    break
        except (SolverError, np.linalg.LinAlgError) as error:
            raise Stopped(str(error)) from None
        return state

    def change(self, parameter: str, value: Value) -> None:
        """See Stepping."""
        self._system = self._system.with_parameter(parameter, value)
        self._motion, self._kernel = SpringMotion(self._system), None

    def end(self) -> None:
        """Nothing is held."""


class EngineStepping:
    """An engine, or a file of the user's own, in a process of its own."""

    def __init__(self, engine: Engine, system: MassSpringSystem, state: State, dt: float) -> None:
        self._dt, self._time = dt, state.time
        try:
            self._session = Session(engine, moved(system, state), dt)
        except EngineStopped as stop:
            raise Stopped(f"{stop.outcome.ending}: {stop}") from None

    def advance(self, steps: int) -> State:
        """See Stepping."""
        try:
            x, v = self._session.advance(steps)
        except EngineStopped as stop:
            raise Stopped(f"{stop.outcome.ending}: {stop}") from None
        self._time += steps * self._dt
        return State(self._time, x, v)

    def change(self, parameter: str, value: Value) -> None:
        """See Stepping."""
        try:
            self._session.change(parameter, value)
        except EngineStopped as stop:
            raise Stopped(f"{stop.outcome.ending}: {stop}") from None

    def end(self) -> None:
        """End its process."""
        self._session.end()


def moved(system: MassSpringSystem, state: State) -> MassSpringSystem:
    """The system with its masses at a state, pushed out of obstacles: soft contacts let them in a little.

    Raises:
        Stopped: where the state is not of numbers.
    """
    x, v = state.positions, state.velocities
    try:
        if system.obstacles:
            x, v = project_out(system.obstacles, system.fixed[:, None], x, v)
        return replace(system, positions=x, velocities=np.where(system.fixed[:, None], 0.0, v))
    except InputError as error:
        raise Stopped(str(error)) from None


class _Compiled:
    """Which loops are ready: to compile some takes seconds, in a thread, while steps go on without."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._ready: dict[Loops, bool] = {}

    def ready(self, scheme: Scheme, system: MassSpringSystem) -> bool:
        """Whether there are loops for a scheme on such a system; if not, they are begun."""
        try:
            loops = loops_for(scheme, system)
        except Unsupported:
            return False
        with self._lock:
            if loops not in self._ready:
                self._ready[loops] = False
                threading.Thread(target=self._compile, args=(loops, scheme, system), daemon=True).start()
            return self._ready[loops]

    def _compile(self, loops: Loops, scheme: Scheme, system: MassSpringSystem) -> None:
        Kernel(system, scheme, threads=1).advance(1e-9, 1)
        with self._lock:
            self._ready[loops] = True


_COMPILED = _Compiled()
