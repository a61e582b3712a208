"""The one way to register: things with names, entered by the file they stand in, found by anybody."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
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

    def all(self) -> Mapping[str, T]:
        """Everything there is, by name."""
        files = list(self._files() if callable(self._files) else self._files)
        for file in files:
            importlib.import_module(file)
        place = {file: i for i, file in enumerate(files)}
        # By file, whichever was imported first: sorting is stable, and keeps the order within each.
        entries = sorted(self._entries.items(), key=lambda item: place.get(item[1][0], len(files)))
        return MappingProxyType({name: entry for name, (_, entry) in entries})

    def find(self, name: str) -> T:
        """The thing of that name. Raises InputError, with a suggestion, where there is none."""
        known = self.all()
        if name not in known:
            raise unknown_name(self.kind, name, known)
        return known[name]

    @contextmanager
    def as_it_is(self) -> Iterator[None]:
        """Within this, things may be entered on trial: afterwards all is as it was before."""
        self.all()  # files that are imported within it would not enter what is theirs again
        before = dict(self._entries)
        try:
            yield
        finally:
            self._entries = before
