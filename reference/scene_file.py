"""Scene files: a scene with its parameters, or a system written out, in TOML.

    scene = "string"            # a named scene ...
    dt = 1e-3                   # s; the scene's own where left out
    duration = 0.5              # s

    [parameters]                # ... with some of its parameters, in SI units
    masses = 20
    stiffness = 500.0

    [[changes]]                 # and parameters that change on the fly
    time = 0.2                  # s
    parameter = "stiffness"
    value = 100.0

In place of `scene` and [parameters], a table [system] has the fields of `MassSpringSystem`: positions, springs, masses,
rest_lengths (left out: as long as the springs are at the start), stiffness, damping, drag, gravity, velocities, fixed
(the indices of the fixed masses).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from reference.changes import Change
from reference.errors import InputError
from reference.scenes import Setup, find
from reference.system import MassSpringSystem

Numbers = float | list[float]


class SystemTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table [system]."""

    positions: list[list[float]]
    springs: list[list[int]]
    masses: Numbers
    stiffness: Numbers
    rest_lengths: Numbers | None = None
    damping: Numbers = 0.0
    drag: float = 0.0
    gravity: Numbers = 9.81
    velocities: list[list[float]] | None = None
    fixed: list[int] = []

    def system(self) -> MassSpringSystem:
        """The system it describes. Raises InputError as MassSpringSystem does."""
        n = len(self.positions)
        for place, i in enumerate(self.fixed):
            if not 0 <= i < n:
                raise InputError(f"fixed[{place}] = {i}: expected a mass from 0 to {n - 1}")
        values: dict[str, Any] = {name: getattr(self, name) for name in self.__struct_fields__}
        values["fixed"] = np.isin(np.arange(n), self.fixed)
        if self.velocities is None:
            values["velocities"] = 0.0
        if self.rest_lengths is None:
            values["rest_lengths"] = 1.0
            unstretched = MassSpringSystem(**values)
            a, b = unstretched.springs.T
            with np.errstate(over="ignore"):
                values["rest_lengths"] = np.linalg.norm(unstretched.positions[b] - unstretched.positions[a], axis=1)
        return MassSpringSystem(**values)


class ChangeTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[changes]]."""

    time: float
    parameter: str
    value: float


class SceneFile(msgspec.Struct, forbid_unknown_fields=True):
    """A whole scene file."""

    scene: str | None = None
    system: SystemTable | None = None
    parameters: dict[str, Any] = {}
    dt: float | None = None
    duration: float | None = None
    changes: list[ChangeTable] = []


def load(path: Path, settings: Mapping[str, Any]) -> Setup:
    """The setup a scene file describes, with some of its scene's parameters set otherwise.

    Raises:
        InputError: naming the file, the key path and, where it is known, the line.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"scene file {path}: {getattr(error, 'strerror', None) or 'expected UTF-8 text'}") from None
    try:
        content = msgspec.toml.decode(text, type=SceneFile)
    except msgspec.ValidationError as error:
        raise InputError(f"scene file {path}{_line(text, str(error))}: {_plain(str(error))}") from None
    except (msgspec.DecodeError, RecursionError) as error:
        raise InputError(f"scene file {path}: {error}") from None
    try:
        setup = _setup(path, content, {})
    except InputError as error:
        raise InputError(f"scene file {path}{_line(text, str(error))}: {error}") from None
    # What is set otherwise is not the file's fault.
    return _setup(path, content, settings) if settings else setup


def _setup(path: Path, content: SceneFile, settings: Mapping[str, Any]) -> Setup:
    changes = tuple(Change(c.time, c.parameter, c.value) for c in content.changes)
    if (content.scene is None) == (content.system is None):
        raise InputError('expected either scene = "..." or a table [system]')
    words = find(content.scene).choices if content.scene is not None else ()
    for name, value in content.parameters.items():
        if name in words:
            continue
        numbers = value if isinstance(value, list) else [value]
        if any(isinstance(number, bool) or not isinstance(number, int | float) for number in numbers):
            raise InputError(f"parameters.{name} = {value!r}: expected a number or a list of numbers")
    if content.system is not None:
        if settings or content.parameters:
            name = next(iter([*settings, *content.parameters]))
            raise InputError(f"{name}: expected no parameters, the system is written out")
        system, dt, duration = content.system.system(), 1e-3, 0.5
    else:
        scene = find(content.scene or "")
        system, dt, duration = scene.system({**content.parameters, **settings}), scene.dt, scene.duration
    dt = dt if content.dt is None else content.dt
    duration = duration if content.duration is None else content.duration
    setup = Setup(path.stem, system, dt, duration, changes)
    setup.check()
    return setup


def _plain(message: str) -> str:
    """The validator's message as ours are: key path first."""
    what, _, where = message.partition(" - at `$.")
    return f"{where.rstrip('`')}: {what[0].lower()}{what[1:]}" if where else what[0].lower() + what[1:]


def _line(text: str, message: str) -> str:
    """Where the last key a message names stands in the file, as ', line N'; nothing if it does not stand there once."""
    keys = re.findall(r"[A-Za-z_]\w*", message.partition("$.")[2] or re.split(r"[^\w.\[\]]", message)[0])
    unknown = re.search(r"unknown (?:field|parameter[^:]*) [`'](\w+)[`']", message)
    key = unknown[1] if unknown else keys[-1] if keys else ""
    lines = [i for i, line in enumerate(text.splitlines(), 1) if key and re.match(rf"\s*{key}\s*=", line)]
    return f", line {lines[0]}" if len(lines) == 1 else ""
