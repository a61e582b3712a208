"""Python's own library for who may no longer walk the way to it: a finder of modules below an open folder.

Root's Python may stand under a folder that only root may enter. A submission's process that has become another user
still holds the library's folder open, and reads modules relative to that. Imports Python's own library only.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class LibraryFinder(MetaPathFinder, Loader):
    """Finds modules written in Python in a folder that is open."""

    def __init__(self, folder: int, path: str) -> None:
        """A handle of the folder, and how it is called in messages."""
        self._folder, self._path = folder, path

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """See `importlib.abc.MetaPathFinder`."""
        stem = fullname.replace(".", "/")
        for name, is_package in ((f"{stem}/__init__.py", True), (f"{stem}.py", False)):
            try:
                os.close(os.open(name, os.O_RDONLY, dir_fd=self._folder))
            except OSError:
                continue
            spec = ModuleSpec(fullname, self, origin=f"{self._path}/{name}", is_package=is_package)
            spec.loader_state = name
            return spec
        return None

    def exec_module(self, module: ModuleType) -> None:
        """See `importlib.abc.Loader`."""
        spec = module.__spec__
        assert spec is not None
        with open(os.open(spec.loader_state, os.O_RDONLY, dir_fd=self._folder), "rb") as file:
            exec(compile(file.read(), spec.origin or "", "exec"), module.__dict__)
