"""The scenes: systems with a name and parameters, after the lecture's pictures.

A scene is one function from keyword parameters to a system, or to a system with what drives it (`changes.Driven`); its
signature says which parameters there are, their types and defaults; the decorator `scene` enters it. All quantities in
SI units, angles in degrees. Here are the string's; the others stand in files by subject.
"""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from types import MappingProxyType
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np

from reference.changes import Change, Driven, changes_by_step, whole_steps
from reference.errors import InputError, unknown_name
from reference.state import Array
from reference.system import MassSpringSystem, check_parameter

#: One number for all, or one for each.
PerItem = float | Sequence[float]

#: More masses than that are a slip of the finger, and would fill the memory.
MOST_MASSES = 10_000_000

#: Where the scenes stand, in the order they are shown.
_FILES = (
    "reference.scenes",
    "reference.barrier",
    "reference.lattices",
    "reference.cloths",
    "reference.drape",
    "reference.trusses",
    "reference.driven",
)
_SCENES: dict[str, Scene] = {}


@dataclass(frozen=True)
class Scene:
    """A named system with parameters.

    Attributes:
        build: makes the system, driven or not; keyword parameters only.
        dt: the step it is shown with [s].
        duration: how long [s].
        slides: of the lecture.
    """

    build: Callable[..., MassSpringSystem | Driven]
    dt: float
    duration: float
    slides: str

    @property
    def name(self) -> str:
        """The function's name."""
        return self.build.__name__

    @property
    def summary(self) -> str:
        """The first line of the function's docstring."""
        return (self.build.__doc__ or "").splitlines()[0]

    @property
    def parameters(self) -> Mapping[str, Any]:
        """Parameter names and their defaults."""
        return {name: p.default for name, p in inspect.signature(self.build).parameters.items()}

    @property
    def choices(self) -> Mapping[str, tuple[str, ...]]:
        """The parameters that are a word, with the words there are."""
        hints = get_type_hints(self.build)
        return {name: get_args(hints[name]) for name in self.parameters if get_origin(hints[name]) is Literal}

    def system(self, settings: Mapping[str, Any]) -> MassSpringSystem:
        """The system alone, with some parameters set. Raises InputError as `driven` does."""
        return self.driven(settings).system

    def setup(self, settings: Mapping[str, Any], dt: float | None = None, duration: float | None = None) -> Setup:
        """The system with what changes while it moves, for a dt and a duration [s] or the scene's own.

        Raises:
            InputError: as `driven` does; for times that make no sense.
        """
        driven = self.driven(settings)
        dt = self.dt if dt is None else dt
        duration = self.duration if duration is None else duration
        return Setup(self.name, driven.system, dt, duration, driven.changes(dt, duration))

    def driven(self, settings: Mapping[str, Any]) -> Driven:
        """The system, and what drives it, if anything does, with some parameters set.

        They are given as words, numbers, lists of numbers, or text of either.

        Raises:
            InputError: for an unknown parameter or a value of the wrong type or range.
        """
        values = {}
        for name, value in settings.items():
            if name not in self.parameters:
                raise unknown_name(f"parameter of scene {self.name!r}", name, self.parameters)
            if name in self.choices:
                values[name] = _chosen(name, value, self.choices[name])
                continue
            several = self.build.__annotations__[name] in (PerItem, "PerItem")
            values[name] = _converted(name, value, self.parameters[name], several)
        # of numbers that are too large the system itself says so
        with np.errstate(all="ignore"):
            built = self.build(**values)
        return built if isinstance(built, Driven) else Driven(built)


@dataclass(frozen=True)
class Setup:
    """Everything a run needs but the stepper: what `compare` and `identify` are given as SCENE.

    Attributes:
        name: of the scene, or of its file.
        system: what moves.
        dt: the step [s].
        duration: how long [s].
        changes: parameters that change on the fly, those by what drives the system included.
    """

    name: str
    system: MassSpringSystem
    dt: float
    duration: float
    changes: tuple[Change, ...] = ()

    def check(self) -> None:
        """Refuse now what would only be met midway in a run. Raises InputError."""
        whole_steps(self.dt, self.duration)
        changes_by_step(self.changes, self.dt)
        for change in self.changes:
            self.system.with_parameter(change.parameter, change.value)


def scene(dt: float, duration: float, slides: str) -> Callable[[Callable[..., MassSpringSystem | Driven]], Any]:
    """Enter the decorated function into the scenes."""

    def enter(build: Callable[..., MassSpringSystem | Driven]) -> Callable[..., MassSpringSystem | Driven]:
        entry = Scene(build, dt, duration, slides)
        _SCENES[entry.name] = entry
        return build

    return enter


def scenes() -> Mapping[str, Scene]:
    """All scenes by name."""
    for file in _FILES:
        importlib.import_module(file)
    # By file, whichever was imported first: sorting is stable, and keeps the order within each.
    return MappingProxyType(dict(sorted(_SCENES.items(), key=lambda entry: _place(entry[1]))))


def _place(entry: Scene) -> int:
    module = entry.build.__module__
    return _FILES.index(module) if module in _FILES else len(_FILES)


def find(name: str) -> Scene:
    """The scene of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in scenes():
        raise unknown_name("scene", name, scenes())
    return scenes()[name]


@scene(dt=1e-3, duration=2.0, slides="2, 4")
def spring(
    *,
    mass: float = 0.02,
    rest_length: float = 0.125,
    stiffness: float = 200.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    stretch: float = 0.01,
    velocity: float = 0.0,
) -> MassSpringSystem:
    """One mass hanging on one spring, moving up and down: the damped oscillator.

    It hangs at (0, y) below an anchor at (0, 0), starting `stretch` [m] below the spring's rest length with a velocity
    upwards [m/s]. Slide 2 has the equation, with y measured from the spring's other end.
    """
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -(rest_length + stretch)]]),
        velocities=np.array([[0.0, 0.0], [0.0, velocity]]),
        springs=np.array([[0, 1]]),
        masses=np.array(mass),
        rest_lengths=np.array(rest_length),
        stiffness=np.array(stiffness),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.array([True, False]),
    )


@scene(dt=1e-3, duration=0.5, slides="3-5, 9-10, 13")
def string(
    *,
    masses: int = 10,
    mass: PerItem = 0.02,
    rest_length: PerItem = 0.125,
    stiffness: PerItem = 200.0,
    damping: PerItem = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    x0: float = 0.0,
    y0: float = 0.0,
    angle: float = 0.0,
) -> MassSpringSystem:
    """A string of masses and springs, let go straight and unstretched at an angle below the horizontal.

    It hangs from an anchor at (x0, y0), which is mass 0 of the system and fixed; spring j joins masses j and j + 1.
    mass, rest_length, stiffness and damping are one number, or one for each of the masses.
    """
    counted("masses", masses)
    lengths = each("rest_length", rest_length, masses)
    reach = np.concatenate([[0.0], np.cumsum(lengths)])
    if np.ptp(lengths) == 0:
        reach = lengths[0] * np.arange(masses + 1)
    # Exactly horizontal or vertical where that is asked for: cos(90 degrees) is 6e-17 on a computer.
    across, down = (round(f(radians(angle)), 15) if angle % 90 == 0 else f(radians(angle)) for f in (cos, sin))
    carried = each("mass", mass, masses)
    return MassSpringSystem(
        positions=np.column_stack([x0 + across * reach, y0 - down * reach]),
        springs=np.column_stack([np.arange(masses), np.arange(1, masses + 1)]),
        masses=np.concatenate([carried[:1], carried]),
        rest_lengths=lengths,
        stiffness=each("stiffness", stiffness, masses),
        damping=each("damping", damping, masses),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.arange(masses + 1) == 0,
    )


def counted(name: str, value: int, least: int = 1, most: int = MOST_MASSES) -> int:
    """The number, if it is in that range. Raises InputError."""
    if not least <= value <= most:
        raise InputError(f"{name} = {value:g}: expected a whole number from {least} to {most:,}")
    return value


def not_below_zero(**values: float) -> None:
    """Refuse a number below zero, by its name. Raises InputError."""
    for name, value in values.items():
        if not value >= 0:
            raise InputError(f"{name} = {value:g}: expected a number >= 0")


def each(name: str, value: PerItem, count: int) -> Array:
    """One number for each of `count` items, shape (count,). Raises InputError for another number of numbers."""
    values = np.asarray(value, dtype=np.float64)
    if values.ndim == 1 and len(values) != count:
        raise InputError(f"{name} has {len(values)} numbers: expected one, or one for each of {count}")
    return np.array(np.broadcast_to(values, (count,)))


def _chosen(name: str, value: Any, words: tuple[str, ...]) -> str:
    if value not in words:
        raise InputError(f"{name} = {value!r}: expected one of {', '.join(words)}")
    return str(value)


def _converted(name: str, value: Any, default: Any, several: bool) -> Any:
    """The value as the type its default has, or several of them: text from the command line, or numbers from a file."""
    whole = isinstance(default, int)
    parts = value.split(",") if isinstance(value, str) else value if isinstance(value, list) else [value]
    try:
        if any(isinstance(part, bool | list | dict) for part in parts):
            raise ValueError
        numbers = [_whole(part) if whole else float(part) for part in parts]
    except (TypeError, ValueError, OverflowError):
        expected = "a whole number" if whole else "a number"
        raise InputError(f"{name} = {value!r}: expected {expected}") from None
    for number in numbers:
        check_parameter(name, number)
    if len(numbers) == 1 and not isinstance(value, list):
        return numbers[0]
    if not several:
        raise InputError(f"{name} = {value!r}: expected one number")
    return numbers


def _whole(part: Any) -> int:
    if float(part) != int(float(part)):
        raise ValueError
    return int(float(part))
