"""The scenes: systems with a name and parameters, after the lecture's pictures.

A scene is one function from keyword parameters to a system, or to a system with what drives it (`changes.Driven`); its
signature says which parameters there are, their types and defaults; the decorator `scene` enters it. All quantities in
SI units, angles in degrees. They stand in files by subject.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np

from reference.changes import Change, Driven, changes_by_step, whole_steps
from reference.checked_numbers import check_sizes
from reference.collisions.round_masses import Collisions
from reference.errors import InputError, unknown_name
from reference.registry import Registry, origin, plug_ins, summary_of
from reference.scenes.parameters import PerItem, chosen, converted
from reference.springs.bending import with_bending
from reference.springs.kinds import KINDS, with_kinds
from reference.system import ABOVE_ZERO, MassSpringSystem

#: What masses that collide have, and all that every scene's parameters are besides its own.
ROUND = {
    "radii": "m, of masses that collide with one another; 0 of those that do not",
    "restitution": "the part of the speed at which two meet that they part with, from 0 to 1",
}
BENDING = {"angular_stiffness": "N m/rad, of an angular spring at every mass where two springs meet; 0: none"}
BESIDES = {**KINDS, **ROUND, **BENDING}


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
        return summary_of(self.build)

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
        changes = driven.changes(dt, duration)
        return Setup(self.name, driven.system, dt, duration, changes, ground_moves=driven.ground_moves)

    def driven(self, settings: Mapping[str, Any]) -> Driven:
        """The system, and what drives it, if anything does, with some parameters set.

        They are given as words, numbers, lists of numbers, or text of either. Every scene has besides its own those of
        BESIDES, one number for all springs or masses, or one for each.

        Raises:
            InputError: for an unknown parameter or a value of the wrong type or range, or beyond what floats hold.
        """
        values: dict[str, Any] = {}
        besides: dict[str, Any] = {}
        for name, value in settings.items():
            if name in BESIDES and name not in self.parameters:
                several = name != "restitution"
                besides[name] = converted(name, int(value) if isinstance(value, bool) else value, 0.0, several)
                continue
            if name not in self.parameters:
                raise unknown_name(f"parameter of scene {self.name!r}", name, [*self.parameters, *BESIDES])
            if name in self.choices:
                values[name] = chosen(name, value, self.choices[name])
                continue
            several = self.build.__annotations__[name] in (PerItem, "PerItem")
            values[name] = converted(name, value, self.parameters[name], several)
        try:
            # where NumPy gives infinity the system itself says so; Python's own numbers raise
            with np.errstate(all="ignore"):
                built = self.build(**values)
        except (OverflowError, ZeroDivisionError):
            given = ", ".join(f"{name} = {value:g}" for name, value in values.items() if isinstance(value, int | float))
            raise InputError(f"{given}: expected numbers that are not too large or too small for {self.name}") from None
        driven = built if isinstance(built, Driven) else Driven(built)
        return replace(driven, system=_with(driven.system, besides)) if besides else driven


def _with(system: MassSpringSystem, besides: Mapping[str, Any]) -> MassSpringSystem:
    """A scene's system with some of BESIDES. Raises InputError as a system does."""
    kinds = {name: value for name, value in besides.items() if name in KINDS}
    nonlinear = with_kinds(system.nonlinear, kinds) if kinds else system.nonlinear
    system = with_bending(replace(system, nonlinear=nonlinear), besides.get("angular_stiffness", 0.0))
    if not ROUND.keys() & besides.keys():
        return system
    round_ones = system.collisions or Collisions()
    radii = np.asarray(besides.get("radii", round_ones.radii), dtype=float)
    collisions = Collisions(radii, float(besides.get("restitution", round_ones.restitution)))
    return replace(system, collisions=collisions)


@dataclass(frozen=True)
class Setup:
    """Everything a run needs but the stepper: what `compare` and `identify` are given as SCENE.

    Attributes:
        name: of the scene, or of its file.
        system: what moves.
        dt: the step [s].
        duration: how long [s].
        changes: parameters that change on the fly, those by what drives the system included.
        remarks: what there is to say of how it was read.
        ground_moves: whether gravity changes as it does seen from ground that moves.
    """

    name: str
    system: MassSpringSystem
    dt: float
    duration: float
    changes: tuple[Change, ...] = ()
    remarks: tuple[str, ...] = ()
    ground_moves: bool = False

    @property
    def steps(self) -> int:
        """The whole number of steps nearest to the duration. Raises InputError as `whole_steps` does."""
        return whole_steps(self.dt, self.duration)

    @property
    def run_duration(self) -> float:
        """How long these steps truly take [s], up to half a step from the duration."""
        return self.steps * self.dt

    def systems_at(self, steps: Sequence[int]) -> list[MassSpringSystem]:
        """The system as it is at each of some steps, in their order: parameters may change on the fly."""
        pending = sorted(changes_by_step(self.changes, self.dt).items())
        system, found = self.system, []
        for step in steps:
            while pending and pending[0][0] < step:
                for change in pending.pop(0)[1]:
                    system = system.with_parameter(change.parameter, change.value)
            found.append(system)
        return found

    def check(self) -> None:
        """Refuse now what would only be met midway in a run, or never. Raises InputError."""
        steps = self.steps
        self.system.check_sizes()
        changes_by_step(self.changes, self.dt)
        for change in self.changes:
            if change.step(self.dt) >= steps:
                last = f"{(steps - 1) * self.dt:.6g} s, when the last step begins"
                raise InputError(f"change of {change.parameter} at {change.time:g} s: expected at most {last}")
            self.system.with_parameter(change.parameter, change.value)
            check_sizes(change.parameter, change.value, divided_by=change.parameter in ABOVE_ZERO)


#: Where the scenes stand, in the order they are shown.
_SCENES = Registry[Scene](
    "scene",
    lambda: (
        "reference.scenes.strings",
        "reference.scenes.line",
        "reference.scenes.barrier",
        "reference.scenes.lattices",
        "reference.scenes.cloths",
        "reference.scenes.drape",
        "reference.scenes.trusses",
        "reference.scenes.driven",
        *plug_ins("scenes"),
    ),
)


def scene(dt: float, duration: float, slides: str) -> Callable[[Callable[..., MassSpringSystem | Driven]], Any]:
    """Enter the decorated function into the scenes. Raises InputError where its name is taken."""

    def enter(build: Callable[..., MassSpringSystem | Driven]) -> Callable[..., MassSpringSystem | Driven]:
        entry = Scene(build, dt, duration, slides)
        _SCENES.enter(entry.name, entry, build.__module__)
        return build

    return enter


def comes_from(name: str) -> str:
    """The installed package that adds a scene; empty for the lab's own. Raises InputError for an unknown name."""
    return origin(_SCENES.module_of(name))


def scenes() -> Mapping[str, Scene]:
    """All scenes by name."""
    return _SCENES.all()


def find(name: str) -> Scene:
    """The scene of that name. Raises InputError, with a suggestion, where there is none."""
    return _SCENES.find(name)
