"""What a fuzz target is, and where they stand."""

from __future__ import annotations

import importlib
from contextlib import AbstractContextManager
from pathlib import Path
from random import Random
from typing import Any, Protocol, cast

#: The doors, each a module of that name with a `make` and an `opened`.
DOORS = ("live_message", "scene_file", "mesh_file", "command_line", "store", "submission_reply")


class Enter(Protocol):
    """A door that is open."""

    def __call__(self, made: Any) -> str:
        """Let something in: "taken", "refused", or else what happened that must not, as is what it raises."""


class Door(Protocol):
    """A module of this package."""

    def make(self, random: Random) -> Any:
        """An input, by chance."""

    def opened(self, folder: Path) -> AbstractContextManager[Enter]:
        """The door, with a folder to work in."""


def door(name: str) -> Door:
    """The door of that name."""
    return cast(Door, importlib.import_module(f"tests.fuzz.{name}"))
