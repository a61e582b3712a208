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

    [[pulls]]                   # and forces that pull on masses
    mass = 3
    force = [0.0, -2.0]         # N

    [[angular_springs]]         # and springs that resist bending at a mass (`reference.springs.angular`)
    masses = [0, 1, 2]          # at the second one, between the first and the third
    stiffness = 0.05            # N m/rad
    rest_angle = 3.14159        # rad; as laid out where left out

    [ground_motion]             # the ground moves, and all supports with it (`reference.scenes.ground_motion`)
    from_frequency = 0.5        # Hz; or, in place of the numbers of a sweep, file = "record.csv" and its scale
    to_frequency = 5.0          # Hz
    amplitude = 1.0             # m/s^2
    duration = 4.0              # s

    [[obstacles]]               # what masses may not enter: added to the scene's own, with either form of file
    kind = "circle"             # circle, sphere: centre [m], radius [m]; cylinder: also its axis, a direction;
    centre = [0.5, -0.6]        # plane: point [m], normal (a direction, out of it); box: centre, half_sizes [m]
    radius = 0.3

In place of `scene` and [parameters], a table [system] has the fields of `MassSpringSystem`: positions, springs, masses,
rest_lengths (left out: as long as the springs are at the start), stiffness, damping, drag, gravity, velocities, fixed
(the indices of the fixed masses). Positions and velocities have one, two or three numbers for each mass: along a line
they may be written [0.0, 0.5] or [[0.0], [0.5]], and a single number of gravity acts against the line's direction.

Or a table [mesh] takes masses and springs from a mesh file, an OBJ or a VTK file (`reference.files.mesh_file`).
Vertices are masses, in the file's order and counted from 0; edges of elements are springs, each once, unstretched at
the start.

    [mesh]
    file = "blanket.obj"        # beside the scene file, or a path from there
    scale = 0.01                # m in a unit of the mesh file; 1 where left out
    diagonals = true            # quadrilaterals have springs along both diagonals, too; false where left out
    total_mass = 0.3            # kg, shared evenly; or masses = ..., kg, one number or one for each
    stiffness = 50.0            # N/m, of every spring
    damping = 0.02              # N s/m, of every spring, along it; 0 where left out
    drag = 0.0                  # N s/m, on every mass; 0 where left out
    gravity = [0.0, 0.0, -9.81] # m/s^2; one number: downwards, along the second axis; 9.81 where left out
    fixed = [0, 7]              # masses that never move; none where left out

[system] and [mesh] may say of springs, one number for all or one for each, what is not linear about them: hardening,
largest_force, breaking_force, breaking_stretch; and tension_only or compression_only, which is true of all or of those
whose numbers are given (`reference.springs.kinds`). And of masses that collide with one another their radii, and the
restitution (`reference.collisions.round_masses`); and angular_stiffness [N m/rad] puts an angular spring at every mass
that two springs meet at. A named scene has all of them among its [parameters].
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from reference.changes import Change, Drive, Driven
from reference.drives import Ramp, Sine
from reference.errors import InputError
from reference.files.angular_tables import AngularTable, angular_springs_of
from reference.files.pull_tables import PullTable, pulls_of
from reference.files.regular_file import check_file
from reference.files.system_tables import MeshTable, Numbers, SystemTable
from reference.files.toml_message import plain
from reference.obstacles import KINDS as OBSTACLES
from reference.obstacles import Obstacle, obstacle_of
from reference.scenes import Setup, find
from reference.scenes.ground_motion import FrequencySweep, GroundMotion, Law, read_record
from reference.springs.kinds import ONE_SIDED
from reference.system import PARAMETERS, MassSpringSystem

#: A file may be so large [bytes]: of larger systems only the mesh file is.
LARGEST_FILE = 32 * 2**20

T = TypeVar("T")


class ChangeTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[changes]]."""

    time: float
    parameter: str
    value: Numbers


class RampTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[ramps]]."""

    parameter: str
    begin: float
    end: float
    value: float


class SineTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[sines]]."""

    parameter: str
    amplitude: float
    frequency: float
    begin: float = 0.0


class GroundMotionTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table [ground_motion]."""

    file: str | None = None
    scale: float | None = None
    from_frequency: float | None = None
    to_frequency: float | None = None
    amplitude: float | None = None
    duration: float | None = None
    law: Law | None = None
    direction: list[float] | None = None

    def motion(self, folder: Path) -> Drive:
        """What it describes: a record, or a sweep. Raises InputError, as `read_record` too."""
        numbers = {name: getattr(self, name) for name in self.__struct_fields__ if name not in ("file", "scale")}
        given = {name: value for name, value in numbers.items() if value is not None}
        if self.file is not None:
            for name in given:
                raise InputError(f"ground_motion.{name}: expected a record or a sweep, not both")
            return GroundMotion(read_record(folder / self.file, 1.0 if self.scale is None else self.scale))
        if self.scale is not None:
            raise InputError("ground_motion.scale: expected a file with it")
        for name in ("from_frequency", "to_frequency", "amplitude", "duration"):
            if name not in given:
                raise InputError(f"ground_motion.{name} is missing: expected a sweep's numbers or a file")
        if "direction" in given:
            given["direction"] = tuple(given["direction"])
        return _within("ground_motion", lambda: GroundMotion(FrequencySweep(**given)))


class SceneFile(msgspec.Struct, forbid_unknown_fields=True):
    """A whole scene file."""

    scene: str | None = None
    system: SystemTable | None = None
    mesh: MeshTable | None = None
    parameters: dict[str, Any] = {}
    dt: float | None = None
    duration: float | None = None
    changes: list[ChangeTable] = []
    ramps: list[RampTable] = []
    sines: list[SineTable] = []
    pulls: list[PullTable] = []
    angular_springs: list[AngularTable] = []
    obstacles: list[dict[str, Any]] = []
    ground_motion: GroundMotionTable | None = None


def load(path: Path, settings: Mapping[str, Any], dt: float | None = None, duration: float | None = None) -> Setup:
    """The setup a scene file describes, with some of its scene's parameters, dt or duration [s] set otherwise.

    Raises:
        InputError: naming the file, the key path and, where it is known, the line.
    """
    try:
        check_file(path, LARGEST_FILE)
        text = path.read_text(encoding="utf-8-sig")
    except InputError as error:
        raise InputError(f"scene file {path}: {error}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"scene file {path}: {getattr(error, 'strerror', None) or 'expected UTF-8 text'}") from None
    try:
        content = msgspec.toml.decode(text, type=SceneFile)
    except msgspec.ValidationError as error:
        raise InputError(f"scene file {path}{_line(text, str(error))}: {plain(str(error), SceneFile)}") from None
    except (msgspec.DecodeError, RecursionError) as error:
        raise InputError(f"scene file {path}: {error}") from None
    try:
        return _setup(path, content, settings, dt, duration)
    except InputError as error:
        # What is set otherwise is not the file's fault; what the file alone does not allow either, is.
        try:
            _setup(path, content, {}, None, None)
        except InputError as its_own:
            raise InputError(f"scene file {path}{_line(text, str(its_own))}: {its_own}") from None
        raise error


def _setup(
    path: Path, content: SceneFile, settings: Mapping[str, Any], dt: float | None, duration: float | None
) -> Setup:
    remarks: list[str] = []
    driven = _driven(path, content, settings, remarks)
    scene = find(content.scene) if content.scene is not None else None
    own_dt, own_duration = (scene.dt, scene.duration) if scene else (1e-3, 0.5)
    dt = next(value for value in (dt, content.dt, own_dt) if value is not None)
    duration = next(value for value in (duration, content.duration, own_duration) if value is not None)
    changes = tuple(Change(c.time, c.parameter, c.value) for c in content.changes)
    _refuse_wrong_numbers(changes, driven.system)
    _refuse_both(changes, driven.drives)
    all_changes = (*driven.changes(dt, duration), *changes)
    setup = Setup(path.stem, driven.system, dt, duration, all_changes, tuple(remarks), driven.ground_moves)
    setup.check()
    return setup


def _driven(path: Path, content: SceneFile, settings: Mapping[str, Any], remarks: list[str]) -> Driven:
    """The system, its obstacles, and what drives it."""
    if [content.scene, content.system, content.mesh].count(None) != 2:
        raise InputError('expected either scene = "..." or a table [system] or a table [mesh]')
    words = find(content.scene).choices if content.scene is not None else ()
    for name, value in content.parameters.items():
        if name in words or (name in ONE_SIDED and isinstance(value, bool)):
            continue
        numbers = value if isinstance(value, list) else [value]
        if any(isinstance(number, bool) or not isinstance(number, int | float) for number in numbers):
            raise InputError(f"parameters.{name} = {value!r}: expected a number or a list of numbers")
    written_out = content.system or content.mesh
    if written_out is not None:
        if settings or content.parameters:
            name = next(iter([*settings, *content.parameters]))
            raise InputError(f"{name}: expected no parameters, the system is written out")
        driven = Driven(written_out.system(path.parent, remarks))
    else:
        driven = find(content.scene or "").driven({**content.parameters, **settings})
    system, drives = driven.system, driven.drives
    if content.pulls:
        system = replace(system, pulls=pulls_of(system, content.pulls))
    if content.angular_springs:
        system = replace(system, angular_springs=angular_springs_of(system, content.angular_springs))
    if content.obstacles:
        given = tuple(_obstacle(i, table) for i, table in enumerate(content.obstacles))
        system = replace(system, obstacles=(*system.obstacles, *given))
    if content.ground_motion is not None:
        drives = (*drives, content.ground_motion.motion(path.parent))
    ramps = (Ramp(t.parameter, t.begin, t.end, t.value) for t in content.ramps)
    sines = (Sine(t.parameter, t.begin, t.amplitude, t.frequency) for t in content.sines)
    drives = (*drives, *ramps, *sines)
    return Driven(system, drives)


def _refuse_wrong_numbers(changes: Iterable[Change], system: MassSpringSystem) -> None:
    """Numbers that a parameter cannot have, where they stand: in a change. Raises InputError."""
    for k, change in enumerate(changes):
        if change.parameter in PARAMETERS:
            try:
                system.with_parameter(change.parameter, change.value)
            except InputError as error:
                raise InputError(f"changes[{k}].value: {error}") from None


def _refuse_both(changes: Iterable[Change], drives: Iterable[Drive]) -> None:
    """What is driven cannot be changed besides: one would undo what the other does. Raises InputError."""
    both = {change.parameter for change in changes} & {drive.parameter for drive in drives}
    if both:
        name = min(both)
        raise InputError(f"{name} is driven, and changed besides: expected one of the two")


def _obstacle(i: int, table: dict[str, Any]) -> Obstacle:
    if "kind" not in table:
        raise InputError(f"obstacles[{i}].kind is missing: expected one of {', '.join(OBSTACLES)}")
    return _within(f"obstacles[{i}]", lambda: obstacle_of(**table))


def _within(table: str, make: Callable[[], T]) -> T:
    """What is made of a table; of a mistake in it the table is named too."""
    try:
        return make()
    except InputError as error:
        # a mistake begins with the key that it is in, or with what there is none of
        joined = ": " if str(error).startswith("unknown ") else "."
        raise InputError(f"{table}{joined}{error}") from None


def _line(text: str, message: str) -> str:
    """Where the last key a message names stands in the file, as ', line N'; nothing if it does not stand there once."""
    keys = re.findall(r"[A-Za-z_]\w*", message.partition("$.")[2] or re.split(r"[^\w.\[\]]", message)[0])
    unknown = re.search(r"unknown (?:field|parameter[^:]*) [`'](\w+)[`']", message)
    key = unknown[1] if unknown else keys[-1] if keys else ""
    lines = [i for i, line in enumerate(text.splitlines(), 1) if key and re.match(rf"\s*{key}\s*=", line)]
    return f", line {lines[0]}" if len(lines) == 1 else ""
