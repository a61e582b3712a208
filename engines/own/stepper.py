"""The stepper of a user's own file or function. To the lab it is an engine, which can do what its form is told of."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from engines.engine import CAPABILITIES, changed, refuse_beyond
from engines.own import c_file, python_file
from engines.own.forms import EXPECTED, form_of, roles_of
from engines.own.recorded import recording_of
from engines.own.stepping import OwnStep
from engines.own.system import BESIDES
from engines.process.isolation import EngineStepper, in_this_process
from reference.errors import Fault, InputError, Unsupported
from reference.line import system_in_plane
from reference.outcome import Outcome
from reference.state import Array, State
from reference.system import MassSpringSystem, Value

if TYPE_CHECKING:
    from reference.derivation.recording import Recording

#: A run of an own file may take so long [s]; the look at what it should not do, less.
TIME_LIMIT, LOOK_LIMIT = 20.0, 5.0

#: What may be a file's name.
SUFFIXES = (".py", ".c")


def capabilities_of(roles: Sequence[str]) -> frozenset[str]:
    """What a step of these roles can do: everything, by the lab's own forces; as in an exercise, what that is told."""
    of_exercise = form_of(roles) in ("string", "spring")
    return frozenset(CAPABILITIES) - ({*BESIDES, "breaking"} if of_exercise else set())


@dataclass(frozen=True)
class OwnFile:
    """A file with a step in it, as an engine: `engines.engine.Engine`.

    Attributes:
        source: its text: what is kept of its runs is its own, and no other version's.
        roles: of the function's parameters (`forms`).
    """

    path: str
    source: str
    function: str
    roles: tuple[str, ...]
    package: str = "numpy"
    settings: Mapping[str, object] = field(default_factory=dict)
    identified_as: Mapping[str, str] = field(default_factory=dict)
    semantics: str = "a file of the user's own"

    @property
    def capabilities(self) -> frozenset[str]:
        """By its form."""
        return capabilities_of(self.roles)

    @property
    def name(self) -> str:
        """The file's name, and the function's where that is not `step`."""
        from reference.printable import printable

        function = "" if self.function == python_file.DEFAULT else f":{self.function}"
        return printable(f"{Path(self.path).name}{function}")

    def load(self) -> Callable[..., Any]:
        """Its function, of code that is run anew."""
        if self.path.endswith(".c"):
            return c_file.read(self.path, self.name, self.source)
        return python_file.read(self.path, self.name, self.source, self.function)

    def start(self, system: MassSpringSystem, dt: float) -> OwnSimulation:
        """The system, ready for its first step. Raises Unsupported for springs or masses that it is not told of."""
        refuse_beyond(self, system)
        return OwnSimulation(self, self.load(), system, dt)


@dataclass(frozen=True)
class OwnFunction:
    """A function of this process as an engine. What it remembers is not begun anew with each run, as a file is."""

    function: Callable[..., Any]
    name: str
    roles: tuple[str, ...]
    package: str = "numpy"
    settings: Mapping[str, object] = field(default_factory=dict)
    identified_as: Mapping[str, str] = field(default_factory=dict)
    semantics: str = "a function of the user's own"

    @property
    def capabilities(self) -> frozenset[str]:
        """By its form."""
        return capabilities_of(self.roles)

    def load(self) -> Callable[..., Any]:
        """It."""
        return self.function

    def start(self, system: MassSpringSystem, dt: float) -> OwnSimulation:
        """The system, ready for its first step. Raises Unsupported for springs or masses that it is not told of."""
        refuse_beyond(self, system)
        return OwnSimulation(self, self.function, system, dt)


class OwnSimulation:
    """A system stepped by a function: `engines.engine.Simulation`. Steps end as those of every scheme do."""

    def __init__(
        self, engine: OwnFile | OwnFunction, function: Callable[..., Any], system: MassSpringSystem, dt: float
    ) -> None:
        self._engine, self._system, self._dt = engine, system, dt
        self._function, self._count = function, 0
        self._step = OwnStep(engine.name, function, engine.roles, system)
        self._x, self._v = system.positions, system.velocities

    def step(self) -> None:
        """One; then masses inside obstacles or one another are put out."""
        from reference.simulate import projected

        x, v = self._step(self._x, self._v, self._count * self._dt, self._dt)
        self._count += 1
        end = projected(self._system, State(self._count * self._dt, x, v), self._count * self._dt)
        self._x, self._v = end.positions, end.velocities

    def bare_step(self) -> Callable[[], object]:
        """The function's own, from where it is."""
        return lambda: self._step(self._x, self._v, 0.0, self._dt)

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities."""
        return self._x.copy(), self._v.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Set a parameter on the fly: the function is given another system."""
        self._system = changed(self._engine, self._system, parameter, value)
        self._step = OwnStep(self._engine.name, self._function, self._engine.roles, self._system)


@dataclass(frozen=True)
class OwnStepper(EngineStepper):
    """An own file or function as a stepper."""

    engine: OwnFile | OwnFunction
    time_limit: float = TIME_LIMIT
    kind: str = "own"

    @property
    def begins_anew(self) -> bool:
        """Whether it remembers nothing of other runs: a file is read anew for each."""
        return isinstance(self.engine, OwnFile)

    @property
    def version(self) -> str:
        """What tells its text from another's; of a function, nothing."""
        return sha256(self.engine.source.encode()).hexdigest()[:8] if isinstance(self.engine, OwnFile) else ""

    def recording(self) -> Recording | None:
        """What its step does with slopes; None where it asks for none, or gives no answer."""
        answer = self.isolate(record_own, self.engine, time_limit=self.time_limit)
        return None if isinstance(answer, Outcome) else answer

    def remarks(self) -> tuple[str, ...]:
        """What it does that a step should not: change what it is given, roll dice, remember earlier calls."""
        answer = self.isolate(look_at, self.engine, time_limit=LOOK_LIMIT)
        return () if isinstance(answer, Outcome) else answer


def own_stepper(word: str) -> OwnStepper:
    """The stepper of FILE or FILE:FUNCTION.

    Raises:
        InputError: where there is no such file or function, or the function's parameters are of no form.
    """
    path, colon, function = word.rpartition(":")
    if not colon or not path.endswith(SUFFIXES):
        path, function = word, ""
    file = Path(path)
    try:
        source = file.read_text(encoding="utf-8-sig")  # editors on Windows write a mark first, which Python skips
    except OSError as error:
        raise InputError(f"stepper {word!r}: expected a file that can be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"stepper {word!r}: expected a text file in UTF-8") from None
    if file.suffix == ".c":
        if function not in ("", python_file.DEFAULT):
            raise InputError(f"stepper {word!r}: expected {path} or {path}:step, as a C file has its step by that name")
        return OwnStepper(OwnFile(str(file.resolve()), source, "step", c_file.ROLES))
    name, roles = python_file.step_in(file.name, source, function or None)
    return OwnStepper(OwnFile(str(file.resolve()), source, name, roles))


def is_own(word: str) -> bool:
    """Whether a stepper's name is a file's, perhaps with a function."""
    return word.endswith(SUFFIXES) or word.partition(":")[0].endswith(SUFFIXES)


def stepper_of(function: Callable[..., Any], name: str | None = None) -> OwnStepper:
    """The stepper of a function, which runs in this very process: for notebooks.

    >>> def step(x, v, dt, system):
    ...     return x + dt * v, v + dt * system.acceleration(x, v)
    >>> stepper_of(step, "mine").name
    'mine'

    Args:
        function: in one of the forms of a file: step(x, v, dt, system), step(f, y, t, dt), step(a, x, v, dt).
        name: what it is called; left out, the function's name.

    Raises:
        InputError: where its parameters are of no form.
    """
    called = str(name or _name_of(function))
    try:
        given = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        raise InputError(f"{called} does not tell its parameters: {EXPECTED}") from None
    asked = [p for p in given if p.default is p.empty and p.kind is not p.VAR_KEYWORD]
    roles = roles_of(called, [p.name for p in asked])
    by_name = [p.name for p in asked if p.kind is p.KEYWORD_ONLY]
    taken = _by_position(function, by_name) if by_name else function
    return OwnStepper(OwnFunction(taken, called, roles), isolate=in_this_process)


def _name_of(function: Callable[..., Any]) -> str:
    """What a function is called; of a partial one or an object, what stands behind it."""
    found = getattr(function, "__name__", None) or getattr(getattr(function, "func", None), "__name__", None)
    return str(found or type(function).__name__)


def _by_position(function: Callable[..., Any], by_name: Sequence[str]) -> Callable[..., Any]:
    """A function whose last parameters go by name only, called by position."""

    def called(*values: Any) -> Any:
        first = len(values) - len(by_name)
        return function(*values[:first], **dict(zip(by_name, values[first:], strict=True)))

    return called


def record_own(engine: OwnFile | OwnFunction) -> Recording | None:
    """Record it, in this very process."""
    return recording_of(lambda: OwnStep(engine.name, engine.load(), engine.roles, _small()))


def look_at(engine: OwnFile | OwnFunction) -> tuple[str, ...]:
    """What it does in two steps of a small system that it should not; nothing where it cannot do these at all."""
    from reference.derivation.explanation import OR_REMEMBERS

    system, dt = _small(), 1 / 64
    try:
        first, again = (OwnStep(engine.name, engine.load(), engine.roles, system) for _ in range(2))
        start = system.positions, system.velocities
        one, same = first(*start, 0.0, dt), again(*start, 0.0, dt)
        two = first(*one, dt, dt)
        fresh = OwnStep(engine.name, engine.load(), engine.roles, system)(*one, dt, dt)
    except (Fault, Unsupported):
        return ()
    remarks = []
    if first.changes_input:
        remarks.append("changes the arrays it is given: it was given copies")
    if not all(np.isfinite(part).all() for part in one):
        return (*(f"{engine.name} {remark}" for remark in remarks), f"{engine.name} returns NaN or infinity")
    if not all(map(np.array_equal, one, same)):
        or_remembers = "" if isinstance(engine, OwnFile) else f", {OR_REMEMBERS}"
        remarks.append(f"is random: the same step twice is not the same{or_remembers}")
    elif not all(map(np.array_equal, two, fresh)):
        remarks.append("remembers earlier calls: the same step with another past is not the same")
    return tuple(f"{engine.name} {remark}" for remark in remarks)


def _small() -> MassSpringSystem:
    """One mass that hangs on a spring in the plane, off its rest and moving: all forms can step it."""
    from reference.derivation.oscillators import oscillator

    return system_in_plane(oscillator(0.3, 0.0, 0.0, 1 / 32, 1 / 4))
