"""In-place schemes as compiled loops: a scheme's own function, run once on symbols of a single mass.

Such a scheme goes over the masses in loops of its own, `for i in range(len(x))`, and writes into what it still reads.
Here its arrays say that there is one mass: each loop is gone through once, and what is done to mass i is noted down,
line by line and in order. Of `euler_in_place` the loop is

    for i in range(len(x)):
        for axis in range(x.shape[1]):
            t3[i, axis] = w1[i, axis]
        one_acceleration(i, w0, w1, ...)
        for axis in range(x.shape[1]):
            t5 = out[i, axis]
            t6 = c0 * t3[i, axis]
            t7 = w0[i, axis]
            t8 = t7 + t6
            w0[i, axis] = t8
            t10 = c0 * t5
            t11 = w1[i, axis]
            t12 = t11 + t10
            w1[i, axis] = t12

What asks for another mass than i, or does anything else with whole arrays than copy them first, cannot be written down.
What a function does with the number i itself is not seen: so loops are used only where they end, on a small mesh, in
the bits that the function ends in. Else the function runs as it is written.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np

from reference.compiled.expressions import Expression, Scalar, Symbol, Untraceable
from reference.errors import InputError
from reference.forces import SpringMotion, acceleration_of_mass, force_of_spring, one_acceleration, springs_of_masses
from reference.jit import HEADER, module, text_of
from reference.motion import Equations
from reference.schemes.catalogue import Scheme
from reference.springs.linear_law import spring_force
from reference.state import State
from reference.system import MassSpringSystem

#: From this many masses on, loops are worth being compiled, ...
COMPILED_FROM = 200

#: ... in runs of at least so many steps of masses (200 masses' 100 steps, say): some of the function take less time.
LONG_FROM = 20_000

#: What a system gives to `one_acceleration`, by the names of its arguments.
_SYSTEM = ["springs", "rest_lengths", "stiffness", "damping", "masses", "drag", "gravity", "fixed"]
_GIVEN = [*_SYSTEM, "first", "spring", "sign", "forces", "out"]

#: How the lines of a trace name what they keep, call for an acceleration, and begin a loop.
_TEMPORARY, _CALL, _LOOP = re.compile(r"\bt\d+\b"), "one_acceleration", "loop"

Step = Callable[[State, float], State]


@dataclass(frozen=True)
class InPlaceLoops:
    """What a scheme does in a step.

    Attributes:
        text: of a module with the function `step`.
        coefficients: how its arguments c0, c1, ... are made of dt.
        texts: the same, as texts.
    """

    text: str
    coefficients: tuple[Callable[[float], Any], ...]
    texts: tuple[str, ...] = ()


def step_of(scheme: Scheme, motion: Equations, steps: float = math.inf) -> Step:
    """The scheme's step on equations of motion; of an in-place scheme on many masses by its loops, to the same bits.

    Args:
        steps: how many are to be taken; left out, nobody knows.

    Raises:
        Unsupported: where the equations do not have what the scheme needs.
    """
    as_written = scheme.on(motion)
    if scheme.needs != "accelerations of one mass" or not isinstance(motion, SpringMotion):
        return as_written
    system = motion.system
    plain = system.nonlinear is None and system.angular_springs is None and not system.pulls.any()
    masses = len(system.masses)
    worth_it = plain and masses >= COMPILED_FROM and masses * steps >= LONG_FROM
    loops = _trusted(scheme) if worth_it else None
    return as_written if loops is None else _step_by(loops, motion.system)


def _step_by(loops: InPlaceLoops, system: MassSpringSystem) -> Step:
    """The step of loops on a system."""
    function = module(loops.text).step
    room = np.empty((len(system.springs), system.dimension)), np.empty_like(system.positions)
    given = [*(getattr(system, name) for name in _SYSTEM), *springs_of_masses(system), *room]

    def step(state: State, dt: float) -> State:
        # copies are writable, as not all states' arrays are: one type of them is compiled for, not two
        numbers = [float(value(dt)) for value in loops.coefficients]
        return State(state.time + dt, *function(state.positions.copy(), state.velocities.copy(), *numbers, *given))

    return step


@cache
def _trusted(scheme: Scheme) -> InPlaceLoops | None:
    """The loops of a scheme; None where they are not the function."""
    try:
        loops = trace_in_place(scheme)
    except (Untraceable, InputError, AttributeError, TypeError, ValueError, IndexError, ZeroDivisionError):
        return None
    system = _small_mesh()
    as_written, by_loops = scheme.on(SpringMotion(system)), _step_by(loops, system)
    one = two = system.start
    for dt in (1e-3, 2e-3):
        one, two = as_written(one, dt), by_loops(two, dt)
    same = (one.positions == two.positions).all() and (one.velocities == two.velocities).all()
    return loops if same else None


def _small_mesh() -> MassSpringSystem:
    """Eleven masses on a spiral in space, each joined to the next three, all of them moving but one."""
    turn = np.arange(11.0)
    positions = np.stack([np.cos(turn), np.sin(2 * turn), turn / 5], axis=1)
    springs = np.array([(i, j) for i in range(11) for j in range(i + 1, min(i + 4, 11))])
    fixed = turn == 4
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=0.1 + turn / 50,
        rest_lengths=np.array(0.7),
        stiffness=np.linspace(100.0, 130.0, len(springs)),
        damping=np.array(0.05),
        drag=0.02,
        velocities=np.where(fixed[:, None], 0.0, positions[:, ::-1]),
        fixed=fixed,
    )


# --- Tracing ---


class _Array:
    """A whole array of one mass: what may be done with it is noted in the lines."""

    def __init__(self, name: str, lines: list[str]) -> None:
        self.name, self._lines, self.shape = name, lines, ()

    def copy(self) -> _Array:
        """A new one, that may be written into."""
        if _LOOP in self._lines:
            raise Untraceable("it copies whole arrays after its first loop")
        name = f"w{len(self._lines)}"
        self._lines.append(f"{name} = {self.name}.copy()")
        return _Array(name, self._lines)

    def __len__(self) -> int:
        self._lines.append(_LOOP)
        return 1

    def __getitem__(self, i: object) -> _Row:
        self.check(i)
        return _Row(self, self._lines)

    def __setitem__(self, i: object, value: Any) -> None:
        self.check(i)
        if isinstance(value, _Row) and value.array is self:
            return  # written already: x[i] += ... ends so
        if not isinstance(value, Symbol):
            raise Untraceable("it writes what is not made of its arrays")
        text = value.expression.text(str)
        self._lines.append(f"{self.name}[i, axis] = {text}")

    def check(self, i: object) -> None:
        """Refuse any other mass than the loop's."""
        if type(i) is not int or i != 0 or _LOOP not in self._lines:
            raise Untraceable("it asks for another mass than the loop is at")


class _Row(Symbol):
    """The row of mass i, as NumPy has it: read when it is used, and not before; written by +=."""

    def __init__(self, array: _Array, lines: list[str]) -> None:
        self.array, self.lines = array, lines

    @property
    def expression(self) -> Expression:  # type: ignore[override]
        """What is in it now."""
        name = f"t{len(self.lines or ())}"
        assert self.lines is not None
        self.lines.append(f"{name} = {self.array.name}[i, axis]")
        return Expression(name)

    def copy(self) -> Symbol:
        """What is in it now, to keep."""
        return Symbol(self.expression, self.lines)

    def __iadd__(self, other: Any) -> _Row:  # type: ignore[override, misc]
        self.array[0] = self + other
        return self


class _TracedByMass:
    """Equations of motion that note down which acceleration is asked for."""

    def __init__(self, lines: list[str]) -> None:
        self._lines = lines

    def acceleration_of(self, i: int, state: State) -> Symbol:
        """Of the mass that the loop is at."""
        x, v = state.positions, state.velocities
        if not (isinstance(x, _Array) and isinstance(v, _Array)):
            raise Untraceable("its states are not made of the one it was given")
        x.check(i)
        self._lines.append(f"{_CALL}(i, {x.name}, {v.name}, {', '.join(_GIVEN)})")
        name = f"t{len(self._lines)}"
        self._lines.append(f"{name} = out[i, axis]")
        return Symbol(name, self._lines)

    def acceleration(self, state: State) -> Symbol:
        """Of all masses: not in a loop over them."""
        raise Untraceable("it asks for all accelerations")

    slope = acceleration


def trace_in_place(scheme: Scheme) -> InPlaceLoops:
    """The loops of a scheme.

    Raises:
        Untraceable: where that cannot be written down.
    """
    lines: list[str] = []
    known: dict[str, Callable[[float], Any]] = {}
    x, v = _Array("x", lines), _Array("v", lines)
    dt = Scalar(lambda dt: dt, "dt", known)
    end = scheme.on(_TracedByMass(lines))(State(0.0, x, v), dt)  # type: ignore[arg-type]
    if not (isinstance(end.positions, _Array) and isinstance(end.velocities, _Array)):
        raise Untraceable("its states are not made of the one it was given")
    written = {line.partition("[")[0] for line in lines if re.match(r"\w+\[i", line)}
    if written & {"x", "v"}:
        raise Untraceable("it changes in place what it was given")
    numbers = [f"c{k}" for k in range(len(known))]
    body = [*_body(lines), f"return {end.positions.name}, {end.velocities.name}"]
    functions = [
        text_of(f, inner=True) for f in (spring_force, force_of_spring, acceleration_of_mass, one_acceleration)
    ]
    head = "@njit(cache=True, nogil=True, error_model='numpy')\ndef step(" + ", ".join(["x", "v", *numbers, *_GIVEN])
    text = "\n\n\n".join([HEADER, *functions, "\n    ".join([f"{head}):", *body])])
    return InPlaceLoops(text + "\n", tuple(known.values()), tuple(known))


def _body(lines: list[str]) -> list[str]:
    """The lines in loops over masses and axes; what is looked at again after a call is kept for each mass."""
    groups = _groups(lines)
    made = {line.partition(" = ")[0]: k for k, group in enumerate(groups) for line in group}
    used = {(name, k) for k, group in enumerate(groups) for line in group for name in _TEMPORARY.findall(line)}
    kept = {name for name, k in used if made[name] != k}
    body = [*(f"{name} = np.empty_like(x)" for name in sorted(kept)), *groups[0]]
    for first, *others in groups[1:]:
        body.append("for i in range(len(x)):" if first == _LOOP else f"    {first}")
        body += ["    for axis in range(x.shape[1]):"] * bool(others)
        body += [f"        {_TEMPORARY.sub(partial(_at_mass, kept), line)}" for line in others]
    return body


def _groups(lines: list[str]) -> list[list[str]]:
    """The lines before the first loop; then a group from each loop's begin and from each call on."""
    groups: list[list[str]] = [[]]
    for line in lines:
        if line == _LOOP or line.startswith(_CALL):
            groups.append([])
        groups[-1].append(line)
    return groups


def _at_mass(kept: set[str], name: re.Match[str]) -> str:
    return f"{name[0]}[i, axis]" if name[0] in kept else name[0]
