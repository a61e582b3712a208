"""The one way to register: things with names, entered by the file they stand in, found by anybody."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib.metadata import entry_points
from types import MappingProxyType, ModuleType
from typing import Generic, TypeVar

from reference.errors import InputError, unknown_name

T = TypeVar("T")


class Registry(Generic[T]):
    """Things of one kind by name, in the order of the files they stand in, and within a file in the file's own order.

    >>> colours = Registry[int]("colour")
    >>> colours.enter("red", 0xFF0000, "palette")
    >>> colours.find("red") == 0xFF0000
    True

    Args:
        kind: what they are, in a word or two, for messages.
        files: the modules that enter them, imported when somebody asks what there is.
    """

    def __init__(self, kind: str, files: Iterable[str] | Callable[[], Iterable[str]] = ()) -> None:
        self.kind = kind
        self._files = files
        self._entries: dict[str, tuple[str, T]] = {}
        self._in_order: dict[tuple[str, ...], Mapping[str, T]] = {}  # by the files, until something is entered

    def enter(self, name: str, entry: T, module: str) -> None:
        """Enter a thing under a name that nothing has yet.

        In a session's own module, `__main__`, a name may be entered again: a notebook's cell is run more than once.

        Args:
            module: the name of the module it stands in.

        Raises:
            InputError: where the name is taken, with the module that has it.
        """
        owner = self._entries.get(name, (None,))[0]
        if owner is not None and not owner == module == "__main__":
            raise InputError(f"{self.kind} {name!r} is taken by {owner}: expected another name")
        self._entries[name] = (module, entry)
        self._in_order.clear()

    def all(self) -> Mapping[str, T]:
        """Everything there is, by name."""
        files = tuple(self._files() if callable(self._files) else self._files)
        if files in self._in_order:
            return self._in_order[files]
        for file in files:
            imported(file)
        place = {file: i for i, file in enumerate(files)}
        # By file, whichever was imported first: sorting is stable, and keeps the order within each.
        entries = sorted(self._entries.items(), key=lambda item: place.get(item[1][0], len(files)))
        self._in_order[files] = MappingProxyType({name: entry for name, (_, entry) in entries})
        return self._in_order[files]

    def find(self, name: str) -> T:
        """The thing of that name. Raises InputError, with a suggestion, where there is none."""
        known = self.all()
        if name not in known:
            raise unknown_name(self.kind, name, known)
        return known[name]

    def module_of(self, name: str) -> str:
        """The module that a thing stands in. Raises InputError, with a suggestion, where there is none."""
        self.find(name)
        return self._entries[name][0]

    @contextmanager
    def as_it_is(self) -> Iterator[None]:
        """Within this, things may be entered on trial: afterwards all is as it was before."""
        self.all()  # files that are imported within it would not enter what is theirs again
        before = dict(self._entries)
        try:
            yield
        finally:
            self._entries = before
            self._in_order.clear()


#: What installed packages add, by what it is: entry points name the modules that enter it.
GROUPS = {"schemes": "springlab.schemes", "scenes": "springlab.scenes", "engines": "springlab.engines"}


@cache
def plug_ins(kind: str) -> tuple[str, ...]:
    """The modules that installed packages name in the entry points of GROUPS, in the order of their names.

    [project.entry-points."springlab.schemes"]
    my_methods = "my_package.methods"
    """
    return tuple(dict.fromkeys(point.module for point in sorted(entry_points(group=GROUPS[kind]), key=str)))


def imported(module: str) -> ModuleType:
    """A module that enters things. Raises InputError where a plug-in's cannot be imported, with the reason."""
    try:
        return importlib.import_module(module)
    except InputError:
        raise
    except Exception as error:
        if module.partition(".")[0] in ("reference", "engines"):
            raise
        raise InputError(f"plug-in {module}: it cannot be imported: {type(error).__name__}: {error}") from error


def summary_of(function: Callable[..., object]) -> str:
    """The first line of a function's docstring, wherever it begins; empty where there is none."""
    return (function.__doc__ or "").strip().partition("\n")[0]


def origin(module: str) -> str:
    """Where something comes from: the package of a plug-in, empty for the lab's own."""
    package = module.partition(".")[0]
    return "" if package in ("reference", "engines", "experiments") else package
