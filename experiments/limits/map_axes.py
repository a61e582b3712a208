"""The axes of a map of stability, and the systems at its points."""

from __future__ import annotations

from collections.abc import Mapping

from experiments.limits.plane import AXES, Axis, SystemAt
from reference.errors import InputError, unknown_name
from reference.files.setup import setup_for
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import fastest_rate


def system_maker(scene: str, settings: Mapping[str, str], dt: float | None = None) -> tuple[SystemAt, float]:
    """A function from the axes' values to the scene's system with these set, and dt [s], by default the scene's."""
    setup = setup_for(scene, dt, settings=settings)

    def system_at(values: Mapping[str, float]) -> MassSpringSystem:
        system = setup.system
        if "masses" in values:
            system = setup_for(scene, settings={**settings, "masses": f"{values['masses']:.0f}"}).system
        for name, value in values.items():
            if name != "masses":
                system = system.with_parameter(name, value)
        return system

    return system_at, setup.dt


def axes_for(
    names: tuple[str, str], ranges: Mapping[str, tuple[float, float]], system: MassSpringSystem
) -> tuple[Axis, Axis]:
    """The two axes, with the ranges that are given or those that show the limits of most schemes.

    Args:
        names: two different ones of AXES.
        ranges: from where to where an axis goes, by its name, in SI units.
        system: the scene's, which the usual ranges are made for.

    Raises:
        InputError: for an unknown axis, the same one twice, or the range of another axis.
    """
    for name in names:
        if name not in AXES:
            raise unknown_name("map axis", name, AXES)
    if names[0] == names[1]:
        raise InputError(f"--map {names[0]} {names[1]}: expected two different axes")
    for name in ranges:
        if name not in names:
            raise InputError(f"--range {name}: expected one of the map's axes, {names[0]} or {names[1]}")
    x, y = (Axis(name, *(ranges.get(name) or _usual_range(name, system))) for name in names)
    return x, y


def _usual_range(name: str, system: MassSpringSystem) -> tuple[float, float]:
    """From next to nothing to about twice what the system has, or to where most schemes have given up."""
    fastest = fastest_rate(spring_equilibrium(system))
    if name == "dt":
        return 0.05 / fastest, 3.5 / fastest
    if name == "masses":
        return 1.0, 40.0
    now = {
        "mass": float(system.masses[-1]),
        "rest_length": float(system.rest_lengths[0]),
        "stiffness": float(system.stiffness[0]),
        "gravity": float(-system.gravity[system.vertical_axis]) or 9.81,
        # As much as damps the fastest mode critically: 2 m w of one mass.
        "damping": 0.5 * float(system.masses[-1]) * fastest,
        "drag": 0.5 * float(system.masses[-1]) * fastest,
    }[name]
    return (0.0, now) if name in ("damping", "drag") else (0.05 * now, 2 * now)
