"""A task: a function with its arguments, and the key that everything which decides its result goes into."""

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
from engines.engine import recorded_settings, version
from engines.process.isolation import MEMORY_LIMIT, TIME_LIMIT
from reference.system import MassSpringSystem

#: Packages that the reference computes with: other versions may round otherwise.
COMPUTES_WITH = ("numpy", "numba", "scipy")


@dataclass(frozen=True)
class Task:
    """A call of a function, to be made in a process of its own.

    Attributes:
        function: a function of a module; its arguments travel as pickles.
        parameters: what is varied from task to task, by name: for people, who will look for it in the results.
        time_limit: [s].
        memory_limit: [bytes].
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    parameters: Mapping[str, Any] = field(default_factory=dict)
    time_limit: float = TIME_LIMIT
    memory_limit: float = MEMORY_LIMIT

    @cached_property
    def question(self) -> str:
        """The digest of what is asked: function, arguments, version of the engine."""
        return digest(self.function, self.arguments, self._version)

    @cached_property
    def key(self) -> str:
        """The digest of everything that decides the result: the question, our sources and versions, the machine."""
        return digest(self.question, _sources(self.function), _computer())

    @cached_property
    def labels(self) -> dict[str, Any]:
        """What the task is about, in the store's columns."""
        engine, system = self._argument("engine"), self._argument("system")
        return {
            "task": self.function.__name__,
            "stepper": getattr(engine, "name", None) or self._argument("stepper"),
            "version": self._version,
            "settings": recorded_settings(engine) if engine is not None else None,
            "system": digest(system)[:12] if isinstance(system, MassSpringSystem) else None,
            "parameters": dict(self.parameters),
            "dt": self._one_number("dt"),
            "steps": self._one_number("steps"),
        }

    @property
    def _version(self) -> str | None:
        """Of the engine that the task is about, where it is about one."""
        engine = self._argument("engine")
        return None if engine is None else version(engine)

    def _argument(self, name: str) -> Any:
        """The argument of that name; None where the function has none."""
        value = self._bound.get(name)
        return value.item() if isinstance(value, np.generic) else value

    def _one_number(self, name: str) -> float | None:
        """The argument of that name where it is one number: a function may take many of them."""
        value = self._argument(name)
        return value if isinstance(value, int | float) else None

    @cached_property
    def _bound(self) -> dict[str, Any]:
        return _signature(self.function).bind(*self.arguments).arguments


def digest(*things: Any) -> str:
    """A SHA-256 digest of numbers, words, bytes, arrays, dataclasses, functions by name, and collections of them.

    A list and a tuple of the same are the same; so are a mapping or a set in whatever order.

    Raises:
        TypeError: for anything else, whose digest might not say all there is to it.
    """
    found = hashlib.sha256()
    _feed(found.update, things)
    return found.hexdigest()


def _feed(update: Callable[[bytes], object], thing: Any) -> None:
    """Each thing with its kind and its size before it: no two things look alike."""
    if thing is None or isinstance(thing, bool | int | str):
        _tell(update, type(thing).__name__, str(thing).encode())
    elif isinstance(thing, float):
        _tell(update, "float", float(thing).hex().encode())
    elif isinstance(thing, bytes):
        _tell(update, "bytes", thing)
    elif isinstance(thing, np.ndarray) and _plain(thing.dtype):
        _tell(update, f"array {thing.dtype.str} {thing.shape}", thing.tobytes())
    elif isinstance(thing, np.generic) and _plain(thing.dtype):
        _feed(update, thing.item())
    elif dataclasses.is_dataclass(thing) and not isinstance(thing, type):
        values = [(f.name, getattr(thing, f.name)) for f in dataclasses.fields(thing)]
        _feed_all(update, f"dataclass {_name(type(thing))}", values)
    elif isinstance(thing, Mapping):
        _feed_all(update, "mapping", sorted((digest(key), digest(value)) for key, value in thing.items()))
    elif isinstance(thing, Set):
        _feed_all(update, "set", sorted(map(digest, thing)))
    elif isinstance(thing, list | tuple):
        _feed_all(update, "sequence", thing)
    elif isinstance(thing, partial):
        _feed_all(update, "partial", [thing.func, thing.args, thing.keywords])
    elif isinstance(thing, FunctionType | type):
        _tell(update, "name", _name(thing).encode())
    else:
        raise TypeError(f"a {type(thing).__name__} has no digest")


def _feed_all(update: Callable[[bytes], object], kind: str, things: Sequence[Any]) -> None:
    _tell(update, kind, str(len(things)).encode())
    for thing in things:
        _feed(update, thing)


def _tell(update: Callable[[bytes], object], kind: str, content: bytes) -> None:
    update(f"{kind} {len(content)}:".encode() + content)


def _plain(kind: np.dtype[Any]) -> bool:
    """Whether an array's bytes say all there is to it: truths, numbers, words; not long floats, which have padding."""
    return kind.kind in "biufcSU" and kind.char not in "gG"


def _name(thing: Any) -> str:
    name = f"{thing.__module__}.{thing.__qualname__}"
    if "<" in name:  # a lambda, or made inside a function: others may have the same name
        raise TypeError(f"{name} has no digest: expected a function or class of a module")
    return name


@cache
def _signature(function: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(function)


@cache
def _sources(function: Callable[..., Any]) -> str:
    """The digest of all that is written in the rooms that compute, and in the function's own file."""
    rooms: Sequence[ModuleType] = (reference, engines)
    files = [file for room in rooms for folder in room.__path__ for file in sorted(Path(folder).rglob("*.py"))]
    own = inspect.getsourcefile(function)
    texts = [file.read_bytes() for file in [*files, *([Path(own)] if own else [])]]
    return digest(_name(function), texts)


@cache
def _computer() -> str:
    return digest(platform.machine(), sys.implementation.name, [metadata.version(p) for p in COMPUTES_WITH])
