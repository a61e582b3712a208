"""A job: a task with its arguments, and the key that everything which decides its result goes into."""

from __future__ import annotations

import dataclasses
import hashlib
import inspect
import platform
import sys
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from importlib import metadata
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

import engines
import reference
from engines.engine import version
from engines.isolation import MEMORY_LIMIT, TIME_LIMIT
from reference.system import MassSpringSystem

#: Packages that the reference computes with: other versions may round otherwise.
COMPUTES_WITH = ("numpy", "numba", "scipy")


@dataclass(frozen=True)
class Job:
    """A task to be done in a process of its own.

    Attributes:
        task: a function of a module; its arguments travel as pickles.
        parameters: what is varied from job to job, by name: for people, who will look for it in the results.
        time_limit: [s].
        memory_limit: [bytes].
    """

    task: Callable[..., Any]
    arguments: tuple[Any, ...]
    parameters: Mapping[str, Any] = field(default_factory=dict)
    time_limit: float = TIME_LIMIT
    memory_limit: float = MEMORY_LIMIT

    @cached_property
    def question(self) -> str:
        """The digest of what is asked: task, arguments, version of the engine."""
        return digest(self.task, self.arguments, self._version)

    @cached_property
    def key(self) -> str:
        """The digest of everything that decides the result: the question, our sources and versions, the machine."""
        return digest(self.question, _sources(self.task), _computer())

    @cached_property
    def labels(self) -> dict[str, Any]:
        """What the job is about, in the store's columns."""
        engine, system = self._argument("engine"), self._argument("system")
        return {
            "task": self.task.__name__,
            "stepper": getattr(engine, "name", None) or self._argument("stepper"),
            "version": self._version,
            "settings": dict(engine.settings) if engine is not None else None,
            "system": digest(system)[:12] if isinstance(system, MassSpringSystem) else None,
            "parameters": dict(self.parameters),
            "dt": self._argument("dt"),
            "steps": self._argument("steps"),
        }

    @property
    def _version(self) -> str | None:
        """Of the engine that the job is about, where it is about one."""
        engine = self._argument("engine")
        return None if engine is None else version(engine)

    def _argument(self, name: str) -> Any:
        """The argument of that name; None where the task has none."""
        value = self._bound.get(name)
        return value.item() if isinstance(value, np.generic) else value

    @cached_property
    def _bound(self) -> dict[str, Any]:
        return _signature(self.task).bind(*self.arguments).arguments


def digest(*things: Any) -> str:
    """A SHA-256 digest of numbers, words, arrays, dataclasses, functions by name, and collections of them.

    Raises:
        TypeError: for anything else, whose digest might not say all there is to it.
    """
    found = hashlib.sha256()
    _feed(found.update, things)
    return found.hexdigest()


def _feed(update: Callable[[bytes], object], thing: Any) -> None:
    """Each thing with its kind and its size before it: no two collections of things look alike."""
    if thing is None or isinstance(thing, bool | int | str):
        _tell(update, type(thing).__name__, str(thing).encode())
    elif isinstance(thing, float):
        _tell(update, "float", float(thing).hex().encode())
    elif isinstance(thing, np.ndarray):
        _tell(update, f"array {thing.dtype.str} {thing.shape}", np.ascontiguousarray(thing).tobytes())
    elif isinstance(thing, np.generic):
        _feed(update, thing.item())
    elif dataclasses.is_dataclass(thing) and not isinstance(thing, type):
        _feed(update, [_name(type(thing)), *((f.name, getattr(thing, f.name)) for f in dataclasses.fields(thing))])
    elif isinstance(thing, Mapping):
        _feed(update, ["mapping", *sorted(thing.items(), key=lambda item: str(item[0]))])
    elif isinstance(thing, Set):
        _feed(update, ["set", *sorted(thing, key=str)])
    elif isinstance(thing, Sequence):
        _tell(update, "sequence", str(len(thing)).encode())
        for item in thing:
            _feed(update, item)
    elif isinstance(thing, partial):
        _feed(update, ["partial", thing.func, thing.args, thing.keywords])
    elif isinstance(thing, FunctionType | type):
        _tell(update, "name", _name(thing).encode())
    else:
        raise TypeError(f"a {type(thing).__name__} has no digest")


def _tell(update: Callable[[bytes], object], kind: str, content: bytes) -> None:
    update(f"{kind} {len(content)}:".encode() + content)


def _name(thing: Any) -> str:
    return f"{thing.__module__}.{thing.__qualname__}"


@cache
def _signature(task: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(task)


@cache
def _sources(task: Callable[..., Any]) -> str:
    """The digest of all that is written in the rooms that compute, and in the task's own file."""
    rooms: Sequence[ModuleType] = (reference, engines)
    files = [file for room in rooms for folder in room.__path__ for file in sorted(Path(folder).glob("*.py"))]
    own = inspect.getsourcefile(task)
    texts = [file.read_bytes().hex() for file in [*files, *([Path(own)] if own else [])]]
    return digest(_name(task), texts)


@cache
def _computer() -> str:
    return digest(platform.machine(), sys.implementation.name, [metadata.version(p) for p in COMPUTES_WITH])
