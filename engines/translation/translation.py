"""A translation: between the stiffness and damping of a spring in SI units and what one engine calls them.

A file of this folder has a tuple TRANSLATIONS; adding one touches nothing else. Needs NumPy only.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import isfinite, pi, sqrt

import engines.translation
from engines.translation.program import run
from reference.errors import InputError, unknown_name
from reference.registry import Registry
from reference.state import Array
from reference.system import MassSpringSystem

#: Of k/m [1/s^2], what no spring has: squares and products of such numbers are still finite.
LARGEST = 1e150

#: What is typed: numbers by the engine's own words for them.
Settings = Mapping[str, float]


class NoSpringError(InputError):
    """Numbers that are no spring.

    Attributes:
        field: the one that is wrong.
    """

    def __init__(self, field: str, said: str) -> None:
        super().__init__(said)
        self.field = field


@dataclass(frozen=True)
class Spring:
    """One spring with what it joins.

    Attributes:
        stiffness: k [N/m].
        damping: c along the spring [N s/m].
        mass: of one end [kg].
        other: of the other end [kg]; None where that is fixed.
    """

    stiffness: float
    damping: float
    mass: float
    other: float | None = None

    def __post_init__(self) -> None:
        for field, value in (("stiffness", self.stiffness), ("mass", self.mass), ("mass-b", self.other)):
            if value is not None and not (isfinite(value) and value > 0):
                raise NoSpringError(field, f"{field} = {value:g}: expected a finite number > 0")
        if not (isfinite(self.damping) and self.damping >= 0):
            raise NoSpringError("damping", f"damping = {self.damping:g}: expected a finite number >= 0")
        if not 0 < self.stiffness * self._inverse_mass < LARGEST:
            numbers = f"stiffness = {self.stiffness:g}, mass = {self.mass:g}"
            raise NoSpringError("stiffness", f"{numbers}: expected k/m between 0 and {LARGEST:g} 1/s^2")

    @property
    def _inverse_mass(self) -> float:
        """1/m_a + 1/m_b [1/kg]."""
        return 1 / self.mass + (1 / self.other if self.other else 0.0)

    @property
    def effective_mass(self) -> float:
        """1 / (1/m_a + 1/m_b) [kg]: what swings on the spring."""
        return 1 / self._inverse_mass

    @property
    def omega(self) -> float:
        """(k/m)^(1/2) [1/s], m the effective mass."""
        return sqrt(self.stiffness / self.effective_mass)

    @property
    def hertz(self) -> float:
        """The frequency [Hz] without damping."""
        return self.omega / (2 * pi)

    @property
    def damping_ratio(self) -> float:
        """C / (2 m w)."""
        return self.damping / (2 * self.effective_mass * self.omega)

    def with_oscillation(self, hertz: float, damping_ratio: float) -> Spring:
        """The spring on the same masses that has this frequency [Hz] and damping ratio."""
        if hertz < 0:
            raise InputError(f"hertz = {hertz:g}: expected a number >= 0 [1/s]")
        omega = 2 * pi * hertz
        mass = self.effective_mass
        return replace(self, stiffness=mass * omega**2, damping=2 * damping_ratio * mass * omega)


@dataclass(frozen=True)
class Stepping:
    """How an engine is stepped.

    Attributes:
        dt: the step [s].
        substeps, iterations: as the engine has them where None.
    """

    dt: float
    substeps: int | None = None
    iterations: int | None = None

    def __post_init__(self) -> None:
        if not (isfinite(self.dt) and self.dt > 0):
            raise InputError(f"dt = {self.dt:g}: expected a finite number > 0 [s]")
        for name in ("substeps", "iterations"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise InputError(f"{name} = {value}: expected a whole number >= 1")


@dataclass(frozen=True)
class Translation:
    """Of one engine.

    Attributes:
        name: how the command line calls it.
        title: the engine and the kind of spring, in words.
        fields: what is typed, with the value each has where it is left out; None where there is none to begin with.
        settings: a spring and how it is stepped -> what to type.
        meaning: what was typed, masses and stepping -> the spring it is nominally.
        scheme: how it is stepped -> the scheme, by its name in the catalogue.
        snippet: a system, stepping, steps, and settings spring by spring -> a program that runs them, and leaves the
            elongations of the first spring [m] in a list `elongations`, one for each step and the start (in JavaScript
            it prints them); or, where nobody can run it here, the calls to type.
        package: the distribution that a snippet runs with; None where it is not run here.
        run: what runs it, in a process of its own, and tells the elongations.
        iterations: whether it has any, to be set.
        substeps: likewise.
        dimensions: of systems it takes.
        note: what else one must know.
    """

    name: str
    title: str
    fields: Mapping[str, float | None]
    settings: Callable[[Spring, Stepping], Settings]
    meaning: Callable[[Settings, Spring, Stepping], Spring]
    scheme: Callable[[Stepping], str]
    snippet: Callable[[MassSpringSystem, Stepping, int, list[Settings]], str]
    package: str | None = None
    run: Callable[[str], Array] = run
    substeps: bool = False
    iterations: bool = False
    dimensions: frozenset[int] = frozenset({2, 3})
    note: str = ""

    def typed(self, words: Settings) -> Settings:
        """What was typed, with what was left out.

        Raises:
            InputError: for a field it does not have, or one that is missing.
        """
        for word in words:
            if word not in self.fields:
                raise unknown_name(f"setting of {self.name}", word, self.fields)
        whole = {**self.fields, **words}
        missing = [name for name, value in whole.items() if value is None]
        if missing:
            raise InputError(f"{self.name}: expected {missing[0]}=NUMBER")
        return {name: value for name, value in whole.items() if value is not None}

    def check(self, stepping: Stepping) -> None:
        """Raise InputError for sub-steps or iterations that the engine does not have."""
        for name in ("substeps", "iterations"):
            if getattr(stepping, name) is not None and not getattr(self, name):
                raise InputError(f"{name} = {getattr(stepping, name)}: {self.name} has none to set")


def newtons(stiffness: str = "stiffness", damping: str = "damping") -> dict[str, Callable[..., object]]:
    """Settings and meaning of an engine whose numbers are in N/m and N s/m, under these names."""
    return {
        "settings": lambda spring, stepping: {stiffness: spring.stiffness, damping: spring.damping},
        "meaning": lambda typed, masses, stepping: replace(masses, stiffness=typed[stiffness], damping=typed[damping]),
    }


@cache
def translations() -> Mapping[str, Translation]:
    """All of them by name."""
    known = Registry[Translation]("translation")
    for found in pkgutil.iter_modules(engines.translation.__path__, f"{engines.translation.__name__}."):
        for translation in getattr(importlib.import_module(found.name), "TRANSLATIONS", ()):
            known.enter(translation.name, translation, found.name)
    return known.all()


def find(name: str) -> Translation:
    """The translation of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in translations():
        raise unknown_name("engine to translate for", name, translations())
    return translations()[name]
