"""What an engine is to the lab, and which engines there are.

An adapter is a file of this folder, or of one below it, with a tuple ENGINES of frozen dataclasses that satisfy Engine;
adding one touches nothing else. Adapters import NumPy only at module level, their engine inside `start`.
"""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Mapping
from functools import cache
from typing import Literal, Protocol

import numpy as np

import engines
from engines.process.available import available_version as available_version
from engines.process.available import how_to_install
from engines.process.available import installed_version as installed_version
from reference.errors import Unsupported as Unsupported
from reference.errors import unknown_name
from reference.line import is_vertical
from reference.pulls import is_pull
from reference.registry import Registry, imported, plug_ins
from reference.state import Array
from reference.system import BREAK, MassSpringSystem, Value

#: What masses may not enter, by its kind. An engine that takes one holds masses out of it in its own way, without
#: friction: where nothing touches it, it steps as the engine does without.
OBSTACLES = {
    "circle": "a circle that masses may not enter",
    "sphere": "a sphere that masses may not enter",
    "cylinder": "a cylinder that masses may not enter",
    "plane": "a plane that masses may not enter",
    "box": "a box that masses may not enter",
}

#: Springs that are not linear. Of those that break the lab sees after every step which do, and tells the engine.
LAWS = {
    "tension_only": "springs that only pull",
    "compression_only": "springs that only push",
    "hardening": "springs that harden",
    "largest_force": "springs with a largest force",
    "breaking": "springs that break",
}

#: Masses that collide: until they touch an engine steps as without; how they part is measured.
COLLISIONS = {
    "collisions": "masses that collide with one another",
    "restitution": "masses that bounce off one another",
}

#: What a system may ask of an engine, and how the lack of it is said.
CAPABILITIES = {
    "1d": "motion along a line",
    "2d": "motion in the plane",
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
    "tilted gravity": "gravity along any axis but the vertical",
    "no fixed mass": "a system with no fixed mass",
    "no rest length": "springs of rest length 0",
    "pulls": "forces that pull on masses",
    "angular springs": "springs that resist bending at a mass",
    **LAWS,
    **COLLISIONS,
    **OBSTACLES,
}


#: All that masses on linear springs ask for, and nothing else: for engines to take from, and to leave out of.
LINEAR_SPRINGS = frozenset(
    {"1d", "2d", "3d", "mesh", "masses", "rest_lengths", "stiffnesses", "dampings", "stretched", "velocities"}
    | {"damping", "drag", "tilted gravity", "no fixed mass"}
)

#: In which floating-point numbers an engine keeps positions and velocities.
Precision = Literal["double", "single"]


class Simulation(Protocol):
    """One system inside an engine, at one time."""

    def step(self) -> None:
        """Let the engine advance by the dt it was started with."""

    def bare_step(self) -> Callable[[], object]:
        """The engine's own step and nothing else, to measure what the adapter adds to it."""

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s] of all masses in the system's order, each (n, d), as new arrays."""

    def change(self, parameter: str, value: Value) -> None:
        """Set one of reference.system.PARAMETERS on the fly, as `changed` has it. Raises Unsupported beyond that."""


class Engine(Protocol):
    """One engine with one choice of settings. Implementations are frozen dataclasses: they travel between processes.

    One whose steps cost much more than masses and springs may have `interactive_up_to` besides, the largest system for
    interactive use, in masses: that many it steps some hundred times within half a minute. `compare` leaves it out
    beyond, unless it is asked for by name. One that computes in single precision has `precision` "single" (see
    `precision`). One whose package does not come along everywhere has `where_it_comes`, which says where, and how to
    have it elsewhere. One whose package stepped otherwise in earlier versions may have `formerly`: by the last version
    that did so, the oldest first, what it is to be `identified_as` there.
    """

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
        """The scheme it claims to step by: "plain", with "damping" of the springs, with "drag".

        By its name in the catalogue, with parameters where they are not the scheme's own: xpbd_jacobi(iterations=3).
        """

    @property
    def semantics(self) -> str:
        """What its stiffness, damping and drag mean in SI units, in a sentence."""

    def start(self, system: MassSpringSystem, dt: float) -> Simulation:
        """The system, built in the engine and ready for its first step of dt [s].

        Raises:
            Unsupported: with the reason, where `demands` of the system go beyond the capabilities or the system has
                something else the engine cannot take.
        """


#: What a parameter that changes on the fly may ask for besides. Once in motion, springs are stretched anyway.
ASKED_BY: Mapping[str, tuple[str, ...]] = {
    "mass": ("masses",),
    "rest_length": ("rest_lengths", "no rest length"),
    "stiffness": ("stiffnesses",),
    "damping": ("dampings", "damping"),
    "drag": ("drag",),
    "gravity": ("tilted gravity",),
    "break": ("breaking",),
}


def asked_by(parameter: str) -> tuple[str, ...]:
    """The capabilities that a change of a parameter may ask for."""
    return ("pulls",) if is_pull(parameter) else ASKED_BY[parameter]


def demands(system: MassSpringSystem) -> list[str]:
    """The capabilities a system asks for."""
    return [name for name in CAPABILITIES if _needed(name, system)]


def _needed(capability: str, system: MassSpringSystem) -> bool:
    """Whether a system asks for one of CAPABILITIES."""
    if capability in OBSTACLES:
        return any(obstacle.kind == capability for obstacle in system.obstacles)
    return bool(_NEEDED[capability](system))


#: By capability, whether a system asks for it: looked at one by one, as parameters may change at every step.
_NEEDED: Mapping[str, Callable[[MassSpringSystem], object]] = {
    "1d": lambda system: system.dimension == 1,
    # what stays on a vertical line of the plane is as good as along a line
    "2d": lambda system: system.dimension == 2 and not is_vertical(system),
    "3d": lambda system: system.dimension == 3,
    "mesh": lambda system: not system.is_string,
    "masses": lambda system: _differ(system.masses[~system.fixed]),
    "rest_lengths": lambda system: _differ(system.rest_lengths),
    "stiffnesses": lambda system: _differ(system.stiffness),
    "dampings": lambda system: _differ(system.damping),
    "stretched": lambda system: system.off_rest_length.any(),
    "velocities": lambda system: system.velocities.any(),
    "damping": lambda system: system.damping.any(),
    "drag": lambda system: system.drag > 0,
    "tilted gravity": lambda system: system.gravity[: system.vertical_axis].any() or system.gravity[2:].any(),
    "no fixed mass": lambda system: not system.fixed.any(),
    "no rest length": lambda system: not system.rest_lengths.all(),
    "pulls": lambda system: system.pulls.any(),
    "angular springs": lambda system: system.angular_springs,
    "collisions": lambda system: system.collisions,
    "restitution": lambda system: system.collisions and system.collisions.restitution > 0,
    "tension_only": lambda system: system.nonlinear and system.nonlinear.tension_only.any(),
    "compression_only": lambda system: system.nonlinear and system.nonlinear.compression_only.any(),
    "hardening": lambda system: system.nonlinear and system.nonlinear.hardening.any(),
    "largest_force": lambda system: system.nonlinear and (system.nonlinear.largest_force < np.inf).any(),
    "breaking": lambda system: system.nonlinear and system.nonlinear.breaks,
}


def refuse_beyond(engine: Engine, system: MassSpringSystem) -> None:
    """Raise Unsupported for the first demand of the system that is not among the engine's capabilities."""
    for demand in demands(system):
        if demand not in engine.capabilities:
            raise Unsupported(f"{engine.name} cannot do {CAPABILITIES[demand]}")


def changed(engine: Engine, system: MassSpringSystem, parameter: str, value: Value) -> MassSpringSystem:
    """The system with a parameter changed on the fly: what every adapter's `change` begins with.

    Raises:
        Unsupported: where it then asks for what it did not ask for before, and the engine cannot.
    """
    other = system.with_parameter(parameter, value)
    for demand in asked_by(parameter):
        asked = parameter == BREAK or (_needed(demand, other) and not _needed(demand, system))
        if demand not in engine.capabilities and asked:
            raise Unsupported(f"{engine.name} cannot do {CAPABILITIES[demand]}, asked for by a change of {parameter}")
    return other


def version(engine: Engine) -> str | None:
    """The version of the engine's package, beside the lab or in an environment of its own; None where it is in none."""
    return available_version(engine.package)


def absence(engine: Engine) -> str:
    """Why an engine whose package is not there is not: with its `where_it_comes`, if it says that."""
    where = getattr(engine, "where_it_comes", "")
    return how_to_install(engine.package) + (f"; {where}" if where else "")


def precision(engine: Engine) -> Precision:
    """In which floating-point numbers an engine keeps its state: "double", unless it has a `precision` of its own."""
    found: Precision = getattr(engine, "precision", "double")
    return found


def recorded_settings(engine: Engine) -> dict[str, object]:
    """What is recorded with every result of an engine: its settings and its precision."""
    return {**engine.settings, "precision": precision(engine)}


def modules() -> list[str]:
    """Every module of this folder and those below it."""
    return [found.name for found in pkgutil.walk_packages(engines.__path__, "engines.") if not found.ispkg]


@cache
def registry() -> Mapping[str, Engine]:
    """All engines by name, those of installed packages last. Imports the adapters (cheap) but none of the engines.

    Raises:
        InputError: where two engines have one name.
    """
    known = Registry[Engine]("engine")
    for file in (*modules(), *plug_ins("engines")):
        for engine in getattr(imported(file), "ENGINES", ()):
            known.enter(engine.name, engine, file)
    return known.all()


def find(name: str) -> Engine:
    """The engine of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in registry():
        raise unknown_name("engine", name, registry())
    return registry()[name]


def _differ(values: Array) -> bool:
    """By more than rounding: equal members of a truss are as long as one another to an ulp or two."""
    return bool(len(values) and (abs(values - values[0]) > 1e-15 * abs(values[0])).any())
