"""What an engine is to the lab, and which engines there are.

An adapter is a file of this folder with a tuple ENGINES of frozen dataclasses that satisfy Engine; adding one touches
nothing else. Adapters import NumPy only at module level, their engine inside `start`.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from functools import cache
from importlib import metadata
from typing import Protocol

import engines
from reference.errors import Unsupported as Unsupported
from reference.errors import unknown_name
from reference.state import Array
from reference.system import MassSpringSystem

#: What masses may not enter, by its kind. An engine that takes one holds masses out of it in its own way, without
#: friction: where nothing touches it, it steps as the engine does without.
OBSTACLES = {
    "circle": "a circle that masses may not enter",
    "sphere": "a sphere that masses may not enter",
    "cylinder": "a cylinder that masses may not enter",
    "plane": "a plane that masses may not enter",
    "box": "a box that masses may not enter",
}

#: What a system may ask of an engine, and how the lack of it is said.
CAPABILITIES = {
    "3d": "motion in three dimensions",
    "mesh": "systems other than a string hung at its first mass",
    "masses": "masses that differ from one another",
    "rest_lengths": "springs whose rest lengths differ",
    "stiffnesses": "springs whose stiffness differs",
    "dampings": "springs whose damping differs",
    "stretched": "a start with springs off their rest lengths",
    "velocities": "a start in motion",
    "damping": "damping along the springs",
    "drag": "drag on the masses",
    "tilted gravity": "gravity along any axis but the second",
    "no fixed mass": "a system with no fixed mass",
    **OBSTACLES,
}


class Simulation(Protocol):
    """One system inside an engine, at one time."""

    def step(self) -> None:
        """Let the engine advance by the dt it was started with."""

    def bare_step(self) -> Callable[[], object]:
        """The engine's own step and nothing else, to measure what the adapter adds to it."""

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s] of all masses in the system's order, each (n, d), as new arrays."""

    def change(self, parameter: str, value: float) -> None:
        """Set one of reference.system.PARAMETERS on the fly. Raises Unsupported where the engine cannot."""


class Engine(Protocol):
    """One engine with one choice of settings. Implementations are frozen dataclasses: they travel between processes."""

    @property
    def name(self) -> str:
        """How the command line calls it."""

    @property
    def package(self) -> str:
        """The distribution it comes in, for its version."""

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, recorded with every result."""

    @property
    def capabilities(self) -> frozenset[str]:
        """Names from CAPABILITIES."""

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The catalogue scheme it is known to step by: "plain", with "damping" of the springs, with "drag"."""

    @property
    def semantics(self) -> str:
        """What its stiffness, damping and drag mean in SI units, in a sentence."""

    def start(self, system: MassSpringSystem, dt: float) -> Simulation:
        """The system, built in the engine and ready for its first step of dt [s].

        Raises:
            Unsupported: with the reason, where `demands` of the system go beyond the capabilities or the system has
                something else the engine cannot take.
        """


def demands(system: MassSpringSystem) -> list[str]:
    """The capabilities a system asks for."""
    gravity = system.gravity
    moving = ~system.fixed
    lengths = _lengths(system)
    asked = {
        "3d": system.dimension == 3,
        "mesh": not system.is_string,
        "masses": _differ(system.masses[moving]),
        "rest_lengths": _differ(system.rest_lengths),
        "stiffnesses": _differ(system.stiffness),
        "dampings": _differ(system.damping),
        "stretched": bool((abs(lengths - system.rest_lengths) > 1e-12 * lengths).any()),
        "velocities": bool(system.velocities.any()),
        "damping": bool(system.damping.any()),
        "drag": system.drag > 0,
        "tilted gravity": bool(gravity[0] or gravity[2:].any()),
        "no fixed mass": not system.fixed.any(),
        **{kind: any(obstacle.kind == kind for obstacle in system.obstacles) for kind in OBSTACLES},
    }
    return [name for name, needed in asked.items() if needed]


def refuse_beyond(engine: Engine, system: MassSpringSystem) -> None:
    """Raise Unsupported for the first demand of the system that is not among the engine's capabilities."""
    for demand in demands(system):
        if demand not in engine.capabilities:
            raise Unsupported(f"{engine.name} cannot do {CAPABILITIES[demand]}")


def version(engine: Engine) -> str | None:
    """The installed version of the engine's package, or None where it is not installed."""
    return installed_version(engine.package)


@cache
def installed_version(package: str) -> str | None:
    """The installed version of a package, or None. It is looked up once: that takes milliseconds."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


@cache
def registry() -> Mapping[str, Engine]:
    """All engines by name. Imports the adapters (cheap) but none of the engines."""
    adapters = [m.name for m in pkgutil.iter_modules(engines.__path__)]
    modules = [importlib.import_module(f"engines.{name}") for name in adapters]
    return {engine.name: engine for module in modules for engine in getattr(module, "ENGINES", ())}


def find(name: str) -> Engine:
    """The engine of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in registry():
        raise unknown_name("engine", name, registry())
    return registry()[name]


def _differ(values: Array) -> bool:
    return bool(len(values) and (values != values[0]).any())


def _lengths(system: MassSpringSystem) -> Array:
    a, b = system.springs.T
    gaps = system.positions[b] - system.positions[a]
    return (gaps**2).sum(axis=1) ** 0.5
