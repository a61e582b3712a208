"""The `springlab compare ...` that reproduces what is seen: from the scene's start, or from the last thing unsayable.

A command can say a scene, its parameters, dt, and parameters that change at their times. It cannot say that dt changed
midway, that a mass was dragged or pinned, or that a stepper took over from another. From there on a new segment begins
(`segment`), and the command is given a scene file with the state at its beginning.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reference.changes import Change
from reference.files.setup import is_file
from reference.springs.kinds import ONE_SIDED
from reference.state import State
from reference.system import MassSpringSystem
from report.live.segment import Segment

#: More changes than these, or longer ones, are put into a scene file: nobody wants them on one line.
ON_ONE_LINE = 12

#: Why there is a file.
SINCE = (
    "From the last thing on a command cannot say (another dt or stepper, a mass dragged or pinned, a barrier, what the "
    "scene changes itself); the state at that time is in the file."
)


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


def reproduction(segment: Segment) -> Reproduction:
    """The commands that come to the present state, and the files they need."""
    acted = max(1, segment.steps)  # what was changed after the last step is not seen yet
    changes = [Change(step * segment.dt, name, value) for step, name, value in segment.changes if step < acted]
    on_one_line = len(changes) <= ON_ONE_LINE and all(isinstance(c.value, int | float) for c in changes)
    note = "" if segment.steps else "Nothing has moved yet: the command takes one step."
    if segment.settings is None:
        return _written_out(segment, changes, f"{SINCE} {note}".strip())
    if on_one_line:
        words = [f"--set={key}={value}" for key, value in segment.settings.items()]
        words += [f"--change={c.time!r}:{c.parameter}={c.value!r}" for c in changes]
        return Reproduction((_command(segment, segment.scene, segment.steppers, words),), {}, note)
    if is_file(segment.scene):  # a scene file can name a scene, but no other file
        return _written_out(segment, changes, note)
    file, text = f"{segment.scene}-live.toml", _times(segment) + _named(segment) + _changes(changes)
    return Reproduction((_command(segment, file, segment.steppers),), {file: text}, note)


def _written_out(segment: Segment, changes: list[Change], note: str) -> Reproduction:
    """A file with the state where lanes began, and a command, for every group of lanes that began alike."""
    groups = _groups(segment)
    stem = segment.scene.rpartition("/")[2].removesuffix(".toml")
    files, commands = {}, []
    for i, (state, names) in enumerate(groups):
        file = f"{stem}-live{'' if len(groups) == 1 else f'-{i + 1}'}.toml"
        files[file] = _times(segment) + written_out(segment.system, state) + _changes(changes)
        commands.append(_command(segment, file, tuple(names)))
    return Reproduction(tuple(commands), files, note)


def _groups(segment: Segment) -> list[tuple[State, list[str]]]:
    """The states where lanes began, each with the steppers that began there."""
    groups: list[tuple[State, list[str]]] = []
    for name, state in zip(segment.steppers, segment.begin, strict=True):
        alike = next((names for begin, names in groups if _same(begin, state)), None)
        if alike is None:
            groups.append((state, [name]))
        else:
            alike.append(name)
    return groups


def _command(segment: Segment, scene: str, steppers: tuple[str, ...], more: list[str] | None = None) -> str:
    words = ["springlab", "compare", scene, *(f"--stepper={name}" for name in dict.fromkeys(steppers))]
    return shlex.join([*words, f"--dt={segment.dt!r}", f"--duration={_duration(segment)!r}", *(more or [])])


def _times(segment: Segment) -> str:
    """The file's own dt and duration [s], so that its changes fit without the command, too."""
    return f"dt = {segment.dt!r}\nduration = {_duration(segment)!r}\n"


def _duration(segment: Segment) -> float:
    return segment.dt * max(1, segment.steps)


def _same(one: State, other: State) -> bool:
    return np.array_equal(one.positions, other.positions) and np.array_equal(one.velocities, other.velocities)


def _named(segment: Segment) -> str:
    settings = [f"{key} = {_setting(value)}" for key, value in (segment.settings or {}).items()]
    return "\n".join([f"scene = {json.dumps(segment.scene)}", "", "[parameters]", *settings, ""])


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
    obstacles, law, angular = now.pop("obstacles"), now.pop("nonlinear", {}), now.pop("angular_springs", {})
    now |= now.pop("collisions", {})
    broken = np.flatnonzero(now.pop("broken", [])).tolist()
    now["fixed"] = np.flatnonzero(system.fixed).tolist()
    lines = ["[system]", *(f"{key} = {json.dumps(value)}" for key, value in now.items())]
    for key, values in law.items():
        given = [j for j, true in enumerate(values) if true] if key in ONE_SIDED else values
        lines.append(f"{key} = {json.dumps(given).replace('null', 'inf')}")
    for masses, stiffness, rest_angle in zip(*angular.values(), strict=True):
        lines += ["", "[[angular_springs]]", f"masses = {masses}", f"{stiffness = }", f"{rest_angle = }"]
    for obstacle in obstacles:
        lines += ["", "[[obstacles]]", *(f"{key} = {json.dumps(value)}" for key, value in obstacle.items())]
    if broken:  # no parameter that changes later brings one back
        lines += ["", "[[changes]]", "time = 0.0", 'parameter = "break"', f"value = {broken}"]
    return "\n".join([*lines, ""])


def _changes(changes: list[Change]) -> str:
    tables = [
        f'\n[[changes]]\ntime = {c.time!r}\nparameter = "{c.parameter}"\n'
        f"value = {json.dumps(list(c.value) if isinstance(c.value, tuple) else float(c.value))}\n"  # type: ignore[arg-type]
        for c in changes
    ]
    return "".join(tables)
