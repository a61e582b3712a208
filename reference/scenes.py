"""The scenes: systems with a name and parameters, after the lecture's pictures.

A scene is one function from keyword parameters to a system; its signature says which parameters there are, their types
and defaults; the decorator `scene` enters it. All quantities in SI units, angles in degrees.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from types import MappingProxyType
from typing import Any

import numpy as np

from reference.changes import Change, changes_by_step, whole_steps
from reference.errors import InputError, unknown_name
from reference.system import MassSpringSystem, check_parameter

#: One number for all, or one for each.
PerItem = float | Sequence[float]

#: More masses than that are a slip of the finger, and would fill the memory.
MOST_MASSES = 10_000_000

_SCENES: dict[str, Scene] = {}


@dataclass(frozen=True)
class Scene:
    """A named system with parameters.

    Attributes:
        build: makes the system; keyword parameters only.
        dt: the step it is shown with [s].
        duration: how long [s].
        slides: of the lecture.
    """

    build: Callable[..., MassSpringSystem]
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

    def system(self, settings: Mapping[str, Any]) -> MassSpringSystem:
        """The system with some parameters set, given as numbers, lists of numbers, or text of either.

        Raises:
            InputError: for an unknown parameter or a value of the wrong type or range.
        """
        values = {}
        for name, value in settings.items():
            if name not in self.parameters:
                raise unknown_name(f"parameter of scene {self.name!r}", name, self.parameters)
            several = self.build.__annotations__[name] in (PerItem, "PerItem")
            values[name] = _converted(name, value, self.parameters[name], several)
        return self.build(**values)


@dataclass(frozen=True)
class Setup:
    """Everything a run needs but the stepper: what `compare` and `identify` are given as SCENE.

    Attributes:
        name: of the scene, or of its file.
        system: what moves.
        dt: the step [s].
        duration: how long [s].
        changes: parameters that change on the fly.
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


def scene(dt: float, duration: float, slides: str) -> Callable[[Callable[..., MassSpringSystem]], Any]:
    """Enter the decorated function into the scenes."""

    def enter(build: Callable[..., MassSpringSystem]) -> Callable[..., MassSpringSystem]:
        entry = Scene(build, dt, duration, slides)
        _SCENES[entry.name] = entry
        return build

    return enter


def scenes() -> Mapping[str, Scene]:
    """All scenes by name."""
    return MappingProxyType(_SCENES)


def find(name: str) -> Scene:
    """The scene of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in _SCENES:
        raise unknown_name("scene", name, _SCENES)
    return _SCENES[name]


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
    if not 1 <= masses <= MOST_MASSES:
        raise InputError(f"masses = {masses:g}: expected a whole number from 1 to {MOST_MASSES:,}")
    lengths = _each("rest_length", rest_length, masses)
    reach = np.concatenate([[0.0], np.cumsum(lengths)])
    if np.ptp(lengths) == 0:
        reach = lengths[0] * np.arange(masses + 1)
    # Exactly horizontal or vertical where that is asked for: cos(90 degrees) is 6e-17 on a computer.
    across, down = (round(f(radians(angle)), 15) if angle % 90 == 0 else f(radians(angle)) for f in (cos, sin))
    carried = _each("mass", mass, masses)
    return MassSpringSystem(
        positions=np.column_stack([x0 + across * reach, y0 - down * reach]),
        springs=np.column_stack([np.arange(masses), np.arange(1, masses + 1)]),
        masses=np.concatenate([carried[:1], carried]),
        rest_lengths=lengths,
        stiffness=_each("stiffness", stiffness, masses),
        damping=_each("damping", damping, masses),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.arange(masses + 1) == 0,
    )


def _each(name: str, value: PerItem, count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    values = np.asarray(value, dtype=np.float64)
    if values.ndim == 1 and len(values) != count:
        raise InputError(f"{name} has {len(values)} numbers: expected one, or one for each of {count}")
    return np.array(np.broadcast_to(values, (count,)))


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
