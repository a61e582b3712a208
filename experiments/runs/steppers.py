"""Every stepper there is, by name: schemes, pendulum schemes, lecture listings, engines."""

from __future__ import annotations

import os
from collections.abc import Iterable

from engines.engine import absence, registry
from engines.own.stepper import is_own, own_stepper
from engines.process.isolation import EngineStepper
from engines.process.packages import APART
from experiments.runs.runner import answer
from reference.cache import remarks
from reference.errors import InputError, unknown_name
from reference.lecture.listings import listings
from reference.schemes import catalogue
from reference.stepper import Stepper, catalogued, stepper_named


def all_steppers() -> dict[str, Stepper]:
    """All of them, in the order they are shown."""
    engines = {name: EngineStepper(engine, isolate=answer) for name, engine in registry().items()}
    return {**catalogued(), **listings(), **engines}


def installed_engines() -> list[EngineStepper]:
    """The engines there are on this machine."""
    return [s for s in all_steppers().values() if isinstance(s, EngineStepper) and s.version is not None]


def steppers_here() -> dict[str, Stepper]:
    """All that are run where none is named: engines in environments of their own once these have been made.

    `springlab list` has the others, with what makes their environments.
    """

    def unmade(stepper: Stepper) -> bool:
        return isinstance(stepper, EngineStepper) and stepper.version is None and stepper.engine.package in APART

    return {name: stepper for name, stepper in all_steppers().items() if not unmade(stepper)}


def default_steppers() -> list[Stepper]:
    """What `compare` runs if nothing is named: all but the pendulum schemes, which are another system's."""
    return [stepper for stepper in steppers_here().values() if stepper.kind != "pendulum"]


def _scheme_named(name: str, known: Iterable[str]) -> Stepper:
    """A scheme by an alias, or with parameters."""
    base = name.partition("(")[0]
    besides = {**catalogue.aliases(), **catalogue.constraint_schemes(), **catalogue.wide_schemes()}
    if base == name and base not in besides:
        if os.path.isdir(name):
            raise InputError(f"{name} is a folder: expected a stepper's name, or FILE.py, FILE.py:FUNCTION or FILE.c")
        raise unknown_name("stepper", name, [*known, *besides])
    return stepper_named(name)


def find_steppers(names: Iterable[str]) -> list[Stepper]:
    """The steppers of these names; of schemes also aliases, parameters, as in xpbd_jacobi(iterations=3), and solvers.

    A name may be a file of the user's own, FILE.py, FILE.py:FUNCTION or FILE.c (`engines.own`). What such a file does
    that a step should not is among `cache.remarks`.

    Raises:
        InputError: for an unknown name, or an engine that is not installed.
    """
    known = all_steppers()
    found: list[Stepper] = []
    for name in names:
        if is_own(name):
            own = own_stepper(name)
            remarks.update(dict.fromkeys(own.remarks()))
            found.append(own)
            continue
        stepper = known.get(name) or _scheme_named(name, known)
        if isinstance(stepper, EngineStepper) and stepper.version is None:
            raise InputError(f"stepper {name!r} cannot run: {absence(stepper.engine)}")
        found.append(stepper)
    return found
