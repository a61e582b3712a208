"""The `springlab compare ...` that reproduces what is seen: from the scene's start, or from the last thing unsayable.

A command can say a scene, its parameters, dt, and parameters that change at their times. It cannot say that dt changed
midway, that a mass was dragged or pinned, or that a stepper took over from another. From there on a **stretch** begins,
and the command is given a scene file with the state at its beginning.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from reference.changes import Change
from reference.state import State
from reference.system import MassSpringSystem, Value

#: More changes than these, or longer ones, are put into a scene file: nobody wants them on one line.
ON_ONE_LINE = 12

#: Why there is a file.
SINCE = (
    "From the last thing on a command cannot say (another dt or stepper, a mass dragged or pinned, a barrier, what the "
    "scene changes itself); the state at that time is in the file."
)


@dataclass(frozen=True, eq=False)
class Stretch:
    """A run that can be repeated.

    Attributes:
        name: of the scene.
        settings: its parameters that were set otherwise; None where the scene cannot be named: it is written out.
        system: at the beginning, without the changes.
        steppers: one for each world.
        begin: where each world began.
        dt: [s].
        steps: how many there have been.
        changes: of parameters: before which step, which one, to what.
    """

    name: str
    settings: Mapping[str, str] | None
    system: MassSpringSystem
    steppers: tuple[str, ...]
    begin: tuple[State, ...]
    dt: float
    steps: int = 0
    changes: tuple[tuple[int, str, Value], ...] = ()

    def after(self, steps: int) -> Stretch:
        """The same, so many steps further."""
        return replace(self, steps=self.steps + steps)

    def with_change(self, parameter: str, value: Value) -> Stretch:
        """The same with a change now; a change of the same parameter since the last step is undone by it."""
        before = len(self.changes)
        while before and self.changes[before - 1][0] == self.steps:
            before -= 1
        now = tuple(change for change in self.changes[before:] if change[1] != parameter)
        return replace(self, changes=(*self.changes[:before], *now, (self.steps, parameter, value)))


@dataclass(frozen=True)
class Reproduction:
    """What to run.

    Attributes:
        commands: lines for a shell.
        files: scene files the commands need, by name.
        note: what the commands do not say.
    """

    commands: tuple[str, ...]
    files: Mapping[str, str]
    note: str


def reproduction(stretch: Stretch) -> Reproduction:
    """The commands that come to the present state, and the files they need."""
    changes = [Change(step * stretch.dt, name, value) for step, name, value in stretch.changes]
    short = len(changes) <= ON_ONE_LINE and all(isinstance(c.value, int | float) for c in changes)
    note = "" if stretch.steps else "Nothing has moved yet: the command takes one step."
    if stretch.settings is not None and short:
        words = [f"--set={key}={value}" for key, value in stretch.settings.items()]
        words += [f"--change={c.time!r}:{c.parameter}={c.value!r}" for c in changes]
        return Reproduction((_command(stretch, stretch.name, stretch.steppers, words),), {}, note)
    if stretch.settings is not None:
        file, text = f"{stretch.name}-live.toml", _named(stretch) + _changes(changes)
        return Reproduction((_command(stretch, file, stretch.steppers),), {file: text}, note)
    groups: list[tuple[State, list[str]]] = []
    for name, state in zip(stretch.steppers, stretch.begin, strict=True):
        alike = next((g for g in groups if _same(g[0], state)), None)
        if alike is None:
            groups.append((state, [name]))
        else:
            alike[1].append(name)
    files, commands = {}, []
    for i, (state, names) in enumerate(groups):
        stem = stretch.name.rpartition("/")[2].removesuffix(".toml")
        file = f"{stem}-live{'' if len(groups) == 1 else f'-{i + 1}'}.toml"
        files[file] = written_out(stretch.system, state) + _changes(changes)
        commands.append(_command(stretch, file, tuple(names)))
    return Reproduction(tuple(commands), files, f"{SINCE} {note}".strip())


def _command(stretch: Stretch, scene: str, steppers: tuple[str, ...], more: list[str] | None = None) -> str:
    duration = stretch.dt * max(1, stretch.steps)
    words = ["springlab", "compare", scene, *(f"--stepper={name}" for name in dict.fromkeys(steppers))]
    return shlex.join([*words, f"--dt={stretch.dt!r}", f"--duration={duration!r}", *(more or [])])


def _same(one: State, other: State) -> bool:
    return np.array_equal(one.positions, other.positions) and np.array_equal(one.velocities, other.velocities)


def _named(stretch: Stretch) -> str:
    settings = [f"{key} = {_setting(value)}" for key, value in (stretch.settings or {}).items()]
    return "\n".join([f"scene = {json.dumps(stretch.name)}", "", "[parameters]", *settings, ""])


def _setting(value: str) -> str:
    """Numbers as they are, words in quotes."""
    try:
        float(value)
    except ValueError:
        return json.dumps(value)
    return value


def written_out(system: MassSpringSystem, state: State) -> str:
    """A system at a state as a scene file, every number to its last bit."""
    now = system.to_dict() | {"positions": state.positions.tolist(), "velocities": state.velocities.tolist()}
    obstacles = now.pop("obstacles")
    now["fixed"] = np.flatnonzero(system.fixed).tolist()
    lines = ["[system]", *(f"{key} = {json.dumps(value)}" for key, value in now.items())]
    for obstacle in obstacles:
        lines += ["", "[[obstacles]]", *(f"{key} = {json.dumps(value)}" for key, value in obstacle.items())]
    return "\n".join([*lines, ""])


def _changes(changes: list[Change]) -> str:
    tables = [
        f'\n[[changes]]\ntime = {c.time!r}\nparameter = "{c.parameter}"\n'
        f"value = {json.dumps(list(c.value) if isinstance(c.value, tuple) else float(c.value))}\n"  # type: ignore[arg-type]
        for c in changes
    ]
    return "".join(tables)
