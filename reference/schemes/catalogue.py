"""The catalogue of schemes: every way of advancing a state that the lab knows by name.

A scheme is one function from a whole state to a new whole state; the decorator `scheme` enters it. Adding one touches
the file it stands in and nothing else.
"""

from __future__ import annotations

import inspect
import pkgutil
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import inf, isfinite
from types import MappingProxyType
from typing import Any, Literal, TypeVar, cast, get_type_hints

import reference.schemes
from reference.errors import InputError, Unsupported, unknown_name
from reference.motion import EveryMotion, Motion, MotionByMass, MotionOfRods, MotionOfSprings
from reference.registry import Registry, origin, plug_ins, summary_of
from reference.state import State

#: How a scheme stands to the theory: right; used by an engine; of those, a solver of constraints with parameters;
#: deliberately incorrect; or right, and of the wide catalogue, which is run where it is asked for only.
Kind = Literal["scheme", "engine_scheme", "constraint_scheme", "in_place", "wide_scheme"]

#: What a scheme asks of the equations of motion, by the protocol its first parameter is annotated with.
Needs = Literal["accelerations", "accelerations of one mass", "springs", "distance constraints"]
NEEDS: Mapping[type, Needs] = {
    Motion: "accelerations",
    MotionByMass: "accelerations of one mass",
    MotionOfSprings: "springs",
    MotionOfRods: "distance constraints",
}

#: And what it is given of them, by name.
GIVEN: Mapping[Needs, tuple[str, ...]] = {
    "accelerations": ("acceleration", "slope"),
    "accelerations of one mass": ("acceleration", "slope", "acceleration_of"),
    "springs": ("acceleration", "slope", "system", "placed", "jacobians"),
    "distance constraints": ("acceleration", "slope", "rods", "constrained", "rest_lengths"),
}

#: A step: equations of motion, a state, dt [s] -> the new state. It may ask for any of the protocols of `motion`, and
#: have keyword parameters with defaults.
Step = Callable[[EveryMotion, State, float], State]

S = TypeVar("S", bound=Step)

#: A parameter of a scheme: a number of iterations, a factor, a word.
Parameter = bool | int | float | str


@dataclass(frozen=True)
class Scheme:
    """An integration method with its name and what theory says of it.

    Attributes:
        step: the function.
        order: of accuracy, predicted by theory.
        kind: see Kind.
        implicit: whether it solves equations in each step.
        linear: whether a step is linear in the state where the equations of motion are, also where it is given many
            states at once as columns, in shape (n, d, columns). Then its step map is had at one go.
        one_step: whether a step depends on the state alone; a multistep method keeps what it needs of earlier steps in
            `State.memory`.
        iterated: whether it stops iterating before its equations are solved: momentum, symmetries and order then hold
            up to what is left only.
        interactive_up_to: the largest system for interactive use, in masses: that many it steps some hundred times
            within half a minute; None where there is no bound.
        given: its keyword parameters that are not as the function has them, by name.
        aliases: other names it can be found by.
        ranges: from where to where a parameter that is a number may be; of others counts are 1 or more, and all finite.
    """

    step: Step
    order: int
    kind: Kind = "scheme"
    implicit: bool = False
    linear: bool = True
    one_step: bool = True
    iterated: bool = False
    interactive_up_to: int | None = None
    given: tuple[tuple[str, Parameter], ...] = ()
    aliases: tuple[str, ...] = ()
    ranges: tuple[tuple[str, tuple[float, float]], ...] = ()

    @cached_property
    def name(self) -> str:
        """The function's name, and the parameters that are not as it has them: xpbd_jacobi(iterations=3)."""
        words = ", ".join(f"{name}={value}" for name, value in self.given)
        return f"{self.step.__name__}({words})" if words else self.step.__name__

    @property
    def summary(self) -> str:
        """The first line of the function's docstring."""
        return summary_of(self.step)

    @cached_property
    def needs(self) -> Needs:
        """What it asks of the equations of motion, by the annotation of its first parameter.

        Raises:
            InputError: where that is none of the protocols of `motion`.
        """
        first = next(iter(inspect.signature(self.step).parameters), "")
        asked: Any = get_type_hints(self.step).get(first)
        if asked not in NEEDS:
            names = ", ".join(protocol.__name__ for protocol in NEEDS)
            raise InputError(f"scheme {self.step.__name__!r}: expected its first parameter annotated as one of {names}")
        return NEEDS[asked]

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """Its keyword parameters with their values here."""
        signature = inspect.signature(self.step).parameters.values()
        defaults = {p.name: p.default for p in signature if p.kind is inspect.Parameter.KEYWORD_ONLY}
        return MappingProxyType({**defaults, **dict(self.given)})

    def with_parameters(self, **values: Parameter) -> Scheme:
        """The same scheme with some of its parameters set; those set to what the function has are not in its name.

        Raises:
            InputError: for a parameter it does not have, or a value of another type or out of its range.
        """
        defaults = replace(self, given=()).parameters
        for name, value in values.items():
            if name not in defaults and not defaults:
                raise InputError(f"scheme {self.step.__name__!r} has no parameters: {name} was given")
            if name not in defaults:
                raise unknown_name(f"parameter of scheme {self.step.__name__!r}", name, defaults)
            if type(value) is not type(defaults[name]):
                expected = f"{type(defaults[name]).__name__}, as in {defaults[name]!r}"
                raise InputError(f"{name} = {value!r}: expected {expected}")
            self._check_range(name, value)
        changed = {name: v for name, v in {**self.parameters, **values}.items() if v != defaults[name]}
        return replace(self, given=tuple(sorted(changed.items())))

    def _check_range(self, name: str, value: Parameter) -> None:
        """Raise InputError for a number that is not in its range."""
        if isinstance(value, bool | str):
            return
        low, high = dict(self.ranges).get(name, (1, inf) if isinstance(value, int) else (-inf, inf))
        if not (isfinite(value) and low <= value <= high):
            expected = f"a number from {low:.6g} to {high:.6g}" if isfinite(high) else "a finite number"
            expected = f"{low} or more" if isinstance(value, int) and high == inf else expected
            raise InputError(f"{name} = {value!r} of scheme {self.step.__name__!r}: expected {expected}")

    def on(self, motion: Motion | MotionOfRods) -> Callable[[State, float], State]:
        """The step of a state by dt [s] on equations of motion, of which the scheme is given what it needs only.

        Raises:
            Unsupported: where these equations do not have that.
        """
        missing = [name for name in GIVEN[self.needs] if not hasattr(motion, name)]
        if missing:
            raise Unsupported(f"{self.name} needs {self.needs}, which {type(motion).__name__} does not give")
        # the protocol that the step is annotated with: what is given has all of that, and the type says more only
        given = cast(EveryMotion, Given(self, motion))
        return partial(self.step, given, **dict(self.given))


class Given:
    """Of equations of motion, what a scheme says that it needs."""

    def __init__(self, scheme: Scheme, motion: object) -> None:
        self._scheme = scheme
        for name in GIVEN[scheme.needs]:
            setattr(self, name, getattr(motion, name))

    def __getattr__(self, name: str) -> Any:
        scheme = self.__dict__["_scheme"]
        has = [protocol.__name__ for protocol, needs in NEEDS.items() if name in GIVEN[needs]]
        hint = f"annotate its first parameter with {has[0]}" if has else f"it is given {', '.join(GIVEN[scheme.needs])}"
        raise InputError(f"scheme {scheme.name!r} asks for motion.{name}, but says it needs {scheme.needs}: {hint}")


#: Where schemes stand, the simplest first: where two do the same, the first is the one to name. Other files follow.
FIRST = ("reference.schemes.textbook", "reference.schemes.implicit_damping", "reference.schemes.in_place")


def _files() -> list[str]:
    """Every file of this folder, and those of installed packages."""
    found = [f"{reference.schemes.__name__}.{file.name}" for file in pkgutil.iter_modules(reference.schemes.__path__)]
    return [*FIRST, *(file for file in found if file not in FIRST), *plug_ins("schemes")]


_SCHEMES = Registry[Scheme]("scheme", _files)


def scheme(
    order: int,
    kind: Kind = "scheme",
    *,
    implicit: bool = False,
    linear: bool = True,
    one_step: bool = True,
    iterated: bool = False,
    interactive_up_to: int | None = None,
    aliases: tuple[str, ...] = (),
    ranges: Mapping[str, tuple[float, float]] = MappingProxyType({}),
) -> Callable[[S], S]:
    """Enter the decorated step into the catalogue. See Scheme for what can be said of it.

    Raises:
        InputError: where its name is taken, or its first parameter is not annotated.
    """

    def enter(step: S) -> S:
        limits = tuple(ranges.items())
        entry = Scheme(step, order, kind, implicit, linear, one_step, iterated, interactive_up_to, (), aliases, limits)
        assert entry.needs
        _SCHEMES.enter(entry.name, entry, step.__module__)
        return step

    return enter


def schemes() -> Mapping[str, Scheme]:
    """The schemes that everything is compared with, the simplest first: where two do the same, the first is named."""
    apart = ("constraint_scheme", "wide_scheme")
    return {name: scheme for name, scheme in _SCHEMES.all().items() if scheme.kind not in apart}


def wide_schemes() -> Mapping[str, Scheme]:
    """What people write besides: run where it is asked for, and what steppers are identified with on small systems."""
    return {name: scheme for name, scheme in _SCHEMES.all().items() if scheme.kind == "wide_scheme"}


def constraint_schemes() -> Mapping[str, Scheme]:
    """Solvers of constraints: what they do depends on their parameters, so they are tried where they are named."""
    return {name: scheme for name, scheme in _SCHEMES.all().items() if scheme.kind == "constraint_scheme"}


def comes_from(name: str) -> str:
    """The installed package that adds a scheme; empty for the lab's own. Raises InputError for an unknown name."""
    return origin(_SCHEMES.module_of(name))


def aliases() -> Mapping[str, Scheme]:
    """The schemes that have other names, by these."""
    return {alias: scheme for scheme in schemes().values() for alias in scheme.aliases}


def find(name: str) -> Scheme:
    """The scheme of that name, an alias, or a name with parameters: xpbd_jacobi(iterations=3).

    Raises:
        InputError: with a suggestion, where there is none; for a parameter it does not have.
    """
    known = {**_SCHEMES.all(), **aliases()}
    parts = re.fullmatch(r"([^(]*)(?:\((.*)\))?", name, re.S)
    if parts is None:
        raise InputError(
            f"scheme {name!r}: expected a name, or a name with parameters, as in xpbd_jacobi(iterations=3)"
        )
    base, parameters = parts.groups()
    if base not in known:
        raise unknown_name("scheme", base, known)
    return known[base].with_parameters(**_parsed(known[base], parameters)) if parameters else known[base]


def _parsed(scheme: Scheme, words: str) -> dict[str, Parameter]:
    """Parameters as they are written in a name, each as the type its default has."""
    values: dict[str, Parameter] = {}
    for word in words.split(","):
        name, _, text = (part.strip() for part in word.partition("="))
        default = scheme.parameters.get(name)
        try:
            if isinstance(default, bool):
                values[name] = {"True": True, "False": False}[text]
            else:
                values[name] = text if default is None else type(default)(text)
        except (ValueError, KeyError):
            raise InputError(f"{name} = {text!r}: expected {type(default).__name__}, as in {default!r}") from None
    return values
