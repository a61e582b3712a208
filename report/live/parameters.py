"""The sliders: which parameters there are, their units and ranges, and the lecture's pictures in one click."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reference.errors import InputError
from reference.system import FIELDS, PARAMETERS, MassSpringSystem, Value, check_parameter

#: Gravity by where one is [m/s^2].
GRAVITIES = {"Earth": 9.81, "Moon": 1.62, "Jupiter": 24.79}

#: Sliders go from a value over this to a value times this; damping and drag, which may be 0, have a range of their own.
REACH = 100.0


@dataclass(frozen=True)
class Preset:
    """One of the lecture's pictures: a scene, its parameters, who steps it, and with which dt [s]."""

    scene: str
    steppers: tuple[str, ...]
    dt: float
    parameters: Mapping[str, float]


#: By slide: a string swings; with less damping; Euler explodes where Heun does not; a string meets a circle.
PRESETS = {
    "13": Preset("string", ("heun",), 1e-3, {"drag": 0.02}),
    "14": Preset("string", ("heun",), 1e-3, {"drag": 0.004}),
    "15": Preset("string", ("heun", "euler"), 1e-3, {"drag": 0.02}),
    "16": Preset("barrier", ("heun",), 1e-3, {"drag": 0.02}),
}


@dataclass(frozen=True)
class Slider:
    """A parameter to be moved.

    Attributes:
        name: one of PARAMETERS.
        unit: of its number; empty where that is a multiple of what each mass or spring has itself.
        value: to begin with.
        low, high: how far it goes; a slider that has a zero goes from zero to low at its very left.
        zero: whether it may be 0.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    zero: bool


def sliders(system: MassSpringSystem) -> list[Slider]:
    """One for each of PARAMETERS that the system has: without springs, none of theirs."""
    return [_slider(system, name) for name in PARAMETERS if _values(system, name).size]


def _slider(system: MassSpringSystem, name: str) -> Slider:
    unit = PARAMETERS[name].partition(",")[0]
    if not uniform(system, name):
        return Slider(name, "", 1.0, 1 / REACH, REACH, False)
    value = own_number(system, name)
    if name == "gravity":
        return Slider(name, unit, value, 0.01, max(30.0, 3 * value), True)
    if name in ("damping", "drag"):
        # what would damp a mass on one spring critically, 2 sqrt(k m)
        most = 2 * float(np.sqrt(system.stiffness.max(initial=1.0) * system.masses.max()))
        return Slider(name, unit, value, min(1e-4 * most, value or most), max(most, value), True)
    if value == 0:  # springs without rest length, or without stiffness
        most = system.scale if name == "rest_length" else 1e3
        return Slider(name, unit, value, 1e-4 * most, most, True)
    return Slider(name, unit, value, value / REACH, value * REACH, False)


def uniform(system: MassSpringSystem, name: str) -> bool:
    """Whether one number says it all: for gravity, that it points downwards."""
    values = _values(system, name)
    if name == "gravity":
        return not np.delete(values, system.vertical_axis).any() and values[system.vertical_axis] <= 0
    return bool(np.ptp(values) <= 1e-12 * np.abs(values).max(initial=0.0)) if values.size else True


def own_number(system: MassSpringSystem, name: str) -> float:
    """The one number."""
    values = _values(system, name)
    return float(-values[system.vertical_axis]) if name == "gravity" else float(values.flat[0])


def own_value(system: MassSpringSystem, name: str, number: float) -> Value:
    """What a slider's number means: the value of all, or a multiple of what each has in this system.

    Raises:
        InputError: for a number the parameter cannot be.
    """
    check_parameter(name, number)
    if uniform(system, name):
        return float(number) + 0.0
    if not number > 0:
        raise InputError(f"{name} times {number:g}: expected a number > 0")
    return tuple((number * _values(system, name)).tolist())


def _values(system: MassSpringSystem, name: str) -> np.ndarray:
    return np.atleast_1d(np.asarray(getattr(system, FIELDS.get(name, name)), dtype=np.float64))
