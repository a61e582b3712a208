"""The catalogue of schemes: every way of advancing a state that the lab knows by name.

A scheme is one function from a whole state to a new whole state; the decorator `scheme` enters it. Adding one touches
the file it stands in and nothing else.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal

from reference.errors import unknown_name
from reference.state import State

#: How a scheme stands to the theory: right; used by an engine; or deliberately incorrect.
Kind = Literal["scheme", "engine_scheme", "in_place"]

#: A step: equations of motion, a state, dt [s] -> the new state. `Any` because some steps ask more than Motion.
Step = Callable[[Any, State, float], State]

_FILES = ("reference.schemes", "reference.damping_schemes", "reference.in_place")
_SCHEMES: dict[str, Scheme] = {}


@dataclass(frozen=True)
class Scheme:
    """An integration method with its name and what theory says of it.

    Attributes:
        step: the function.
        order: of accuracy, predicted by theory.
        kind: see Kind.
        springs_only: whether it needs springs (damped ones apart, or one mass at a time) and so cannot step a pendulum.
        quick_up_to: how many masses it steps some hundred times within half a minute; None for as many as any.
        solves: whether it solves equations, which are linear about an equilibrium, as is everything else it does.
    """

    step: Step
    order: int
    kind: Kind
    springs_only: bool
    quick_up_to: int | None = None
    solves: bool = False

    @cached_property
    def name(self) -> str:
        """The function's name, by which everything else calls it."""
        return self.step.__name__

    @property
    def summary(self) -> str:
        """The first line of the function's docstring."""
        return (self.step.__doc__ or "").strip().splitlines()[0]


def scheme(
    order: int,
    kind: Kind = "scheme",
    springs_only: bool = False,
    quick_up_to: int | None = None,
    solves: bool = False,
) -> Callable[[Step], Step]:
    """Enter the decorated step into the catalogue."""

    def enter(step: Step) -> Step:
        entry = Scheme(step, order, kind, springs_only, quick_up_to, solves)
        _SCHEMES[entry.name] = entry
        return step

    return enter


def schemes() -> Mapping[str, Scheme]:
    """All schemes by name, the simplest first: where two do the same, the first is the one to name."""
    for file in _FILES:
        importlib.import_module(file)
    # By file, whichever was imported first: sorting is stable, and keeps the order within each.
    return MappingProxyType(dict(sorted(_SCHEMES.items(), key=lambda entry: _place(entry[1]))))


def _place(entry: Scheme) -> int:
    module = entry.step.__module__
    return _FILES.index(module) if module in _FILES else len(_FILES)


def find(name: str) -> Scheme:
    """The scheme of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in schemes():
        raise unknown_name("scheme", name, schemes())
    return schemes()[name]
