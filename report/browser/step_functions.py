"""Schemes as functions of whole states, and the derivatives of springs that implicit ones ask for, as JavaScript.

Explicit schemes have loops too (`programs`), which are many times as quick. What is here is every scheme that can be
said: also those that solve equations, and all of them where springs resist bending, which no loop has.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np

from reference import assembly
from reference.assembly import Blocks, damping_blocks, spring_blocks
from reference.errors import InputError, SolverError, Unsupported
from reference.schemes.catalogue import Scheme
from reference.springs.angular_law import derivatives, energy_of_bends, forces_on_masses
from reference.state import Array, Slope, State
from reference.theory.step_coefficients import coefficients
from report.browser.array_functions import ArrayFunctions
from report.browser.recorded import Recorded, Recorder

#: Dimensions of systems, and those in which something bends.
DIMENSIONS, BENDING = (1, 2, 3), (2, 3)

#: The numbers of a spring, in the order of the arguments; those of nonlinear ones last.
NUMBERS = ("rest_length", "stiffness", "damping", "hardening", "largest_force", "tension_only", "compression_only")

#: Classes of the reference, with the methods that schemes call.
_CLASSES: Mapping[type, tuple[str, ...]] = {
    State: ("__add__", "kick", "remembering", "drift"),
    Slope: ("__rmul__", "__add__"),
    Blocks: ("of_masses", "__rmul__", "__add__"),
}

#: Of the reference's solver: from how many unknowns on it iterates, how often, and what it may leave.
_SOLVER = ("ITERATE_FROM", "ROUNDS", "REMAINDER")


@cache
def damps_in_proportion(scheme: Scheme) -> bool:
    """Whether what a step makes of damping is in proportion to it, as of a mode alone: told by masses on springs."""
    masses, damping = np.array([1.0, 1.0, 2.0]), np.array([0.1, 0.3, 0.1])
    try:
        made = coefficients(scheme, 0.5, masses, damping)
    except (SolverError, Unsupported, InputError):
        return False
    return _all_alike(np.stack([made.implicit, made.all]) / damping)


@cache
def drags_in_proportion(scheme: Scheme) -> bool:
    """The same of drag: told by masses on springs without damping."""
    masses, drags = np.array([1.0, 2.0]), (0.1, 0.3)
    try:
        made = [coefficients(scheme, 0.5, masses, np.zeros(2), drag) for drag in drags]
    except (SolverError, Unsupported, InputError):
        return False
    parts = [np.stack([one.implicit, one.all]) / drag for one, drag in zip(made, drags, strict=True)]
    return _all_alike(np.concatenate(parts, axis=1))


def _all_alike(parts: Array) -> bool:
    return bool(np.isfinite(parts).all() and np.ptp(parts, axis=1).max() < 1e-9)


@cache
def step_refusal(scheme: Scheme) -> str:
    """Why a scheme cannot be said as a function of whole states; empty where it can."""
    try:
        ArrayFunctions().add(scheme.step)
    except Unsupported as reason:
        return str(reason)
    return ""


def steps_script(all_schemes: Mapping[str, Scheme]) -> str:
    """The functions of all that can be said, by their schemes' names, and what they ask of springs."""
    functions = ArrayFunctions()
    for cls, methods in _CLASSES.items():
        functions.add_class(cls, methods)
    names = [functions.add(scheme.step) for scheme in all_schemes.values() if not step_refusal(scheme)]
    wanted = [*(cls.__name__ for cls in _CLASSES), *names]
    lines = ["class SolverError extends Error {}"]
    lines += [f"const {{State, Slope, Blocks, ...steps}} = {chr(10).join(functions.script(wanted))};"]
    lines += [f"const SOLVER = {json.dumps({name: getattr(assembly, name) for name in _SOLVER})};"]
    return "\n".join([*lines, *_of_springs()]) + "\n"


@cache
def _of_springs() -> tuple[str, ...]:
    """What is asked of one spring: its blocks, those of damping alone, and of one that bends force and derivatives."""
    of_kinds = {kind: {d: _spring_blocks(d, kind == "any") for d in DIMENSIONS} for kind in ("linear", "any")}
    blocks = ", ".join(f"{kind}: {_by_dimension(texts)}" for kind, texts in of_kinds.items())
    return (
        f"const spring_blocks = {{{blocks}}};",
        f"const damping_block = {_by_dimension({d: _damping_block(d) for d in DIMENSIONS})};",
        f"const bending_forces = {_by_dimension({d: _bending(forces_on_masses, d) for d in BENDING})};",
        f"const bending_energy = {_by_dimension({d: _bending(energy_of_bends, d) for d in BENDING})};",
        f"const bending_derivatives = {_by_dimension({d: _bending(derivatives, d) for d in BENDING})};",
    )


def _by_dimension(texts: Mapping[int, str]) -> str:
    return "{" + ", ".join(f"{d}: {text}" for d, text in texts.items()) + "}"


def _spring_blocks(d: int, nonlinear: bool) -> str:
    """Writes the derivatives of a spring's force by positions and by velocities."""
    recorder = Recorder()
    state, system = _two_masses(recorder, d)
    if nonlinear:
        system.nonlinear = SimpleNamespace(**{name: recorder.numbers(1, name=name) for name in NUMBERS[3:]})
    blocks: tuple[Any, Any] = spring_blocks(system, state)
    by_position, by_velocity = blocks
    arguments = ["x0", "v0", *(f"{name}0" for name in NUMBERS)]
    return _function(recorder, d, arguments, {"by_position": by_position.springs, "by_velocity": by_velocity.springs})


def _damping_block(d: int) -> str:
    recorder = Recorder()
    state, system = _two_masses(recorder, d)
    blocks: Any = damping_blocks(system, state, recorder.numbers(1, name="damping"))  # type: ignore[arg-type]
    return _function(recorder, d, ["x0", "rest_length0", "damping0"], {"by_velocity": blocks.springs})


def _bending(law: Callable[..., Any], d: int) -> str:
    """The force on the three masses of an angular spring, or its derivatives by the arms."""
    recorder = Recorder()
    springs: Any = SimpleNamespace(masses=np.array([[0, 1, 2]]))
    springs.stiffness = recorder.numbers(1, name="stiffness")
    springs.rest_angles = recorder.numbers(1, name="rest_angle")
    found = law(springs, recorder.numbers(3, d, name="x"))
    places = [f"x{k}" for k in range(3 * d)]
    lines = [*recorder.lines, *(f"out[to + {k}] = {text};" for k, text in enumerate(found.texts.ravel()))]
    head = f"(F, places, stiffness0, rest_angle0, out, to) => {{\n  const [{', '.join(places)}] = places;"
    return head + "".join(f"\n  {line}" for line in lines) + "\n}"


def _two_masses(recorder: Recorder, d: int) -> tuple[Any, Any]:
    """Two masses and the spring between them, of numbers that write themselves."""
    state = SimpleNamespace(positions=recorder.numbers(2, d, name="x"), velocities=recorder.numbers(2, d, name="v"))
    numbers = {"rest_lengths": "rest_length", "stiffness": "stiffness", "damping": "damping"}
    system = SimpleNamespace(
        springs=np.array([[0, 1]]),
        masses=np.zeros(2),
        dimension=d,
        drag=0.0,
        nonlinear=None,
        angular_springs=None,
        **{field: recorder.numbers(1, name=name) for field, name in numbers.items()},
    )
    return state, system


def _function(recorder: Recorder, d: int, arguments: list[str], made: Mapping[str, Recorded]) -> str:
    """A function of where the spring's two masses stand in F, and its numbers."""
    vectors = [name[0] for name in arguments if name in ("x0", "v0")]
    read = [
        f"const {', '.join(f'{q}{k} = F[{q}{chr(97 + k // d)} + {k % d}]' for k in range(2 * d))};" for q in vectors
    ]
    written = [f"{name}[to + {k}] = {text};" for name, array in made.items() for k, text in enumerate(array.texts.flat)]
    numbers = [name for name in arguments if name not in ("x0", "v0")]
    head = ["F", *(f"{q}{end}" for q in vectors for end in "ab"), *numbers, *made, "to"]
    return f"({', '.join(head)}) => {{" + "".join(f"\n  {line}" for line in [*read, *recorder.lines, *written]) + "\n}"
