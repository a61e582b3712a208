"""Many systems at once: the same mesh with other parameters or steps, for maps of whole parameter planes.

The loops are those of every other run, with LANES systems side by side in the innermost one, where a processor does the
same to many numbers at a time. Blocks of lanes go to threads. Every system gets the bits it would get alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reference.compiled.kernels import arrays_of, compiled, lists, loops_for
from reference.compiled.loops import LANES
from reference.errors import InputError
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.system import BoolArray, MassSpringSystem

#: After each chunk of this many steps blown-up systems are looked for, and blocks of nothing else are left alone.
CHUNK = 100

#: From this many blocks on, threads are worth what loops for them take to compile, some seconds.
THREADS_FROM = 32

#: Parameters there is one number of for each spring, as the loops call them.
OF_SPRINGS = ("rest_length", "stiffness", "damping")


@dataclass(frozen=True)
class SweptSystems:
    """Where many systems ended.

    Attributes:
        positions: shape (m, n, d) [m]; where a system has blown up, from when that was noticed.
        velocities: shape (m, n, d) [m/s].
        distances: of the mass furthest from where it is at rest, after each chunk of steps, shape (chunks, m) [m].
        blown_up: shape (m,), whether some mass went further than the limit, or nowhere that is a number.
    """

    positions: Array
    velocities: Array
    distances: Array
    blown_up: BoolArray


def sweep(
    system: MassSpringSystem,
    scheme: Scheme,
    dt: Array,
    steps: int,
    parameters: Mapping[str, Array] | None = None,
    positions: Array | None = None,
    still: Array | None = None,
    limit: float = np.inf,
    threads: int | None = None,
    progress: Callable[[float], None] = lambda _: None,
) -> SweptSystems:
    """Advance many systems that differ from one in some parameters, in where they start, or in their steps.

    Args:
        system: what they have in common.
        scheme: an explicit one that treats all springs alike.
        dt: the step of each [s], shape (m,).
        steps: how many.
        parameters: from reference.system.PARAMETERS, each an array of shape (m,).
        positions: where each starts [m], shape (m, n, d); as the system does, where left out.
        still: where distances are measured from [m], shape (m, n, d); from each one's start, where left out.
        limit: how far from there a mass may go [m] before its system has blown up.
        threads: how many; left out, all there are for many systems and one for few.
        progress: told now and then which part of the work is done.

    Raises:
        InputError: for parameters that make no sense, or arrays that do not fit.
        Unsupported: for a scheme that cannot be swept.
    """
    m, (n, d) = len(dt), system.positions.shape
    blocks = -(-m // LANES)
    if threads is None and blocks < THREADS_FROM:
        threads = 1
    loops = loops_for(scheme, system, lanes=True, threads=threads != 1)
    start = np.broadcast_to(system.positions if positions is None else positions, (m, n, d))
    values = _per_system(system, parameters or {}, m)
    named = {name: _in_lanes(array, m, blocks) for name, array in values.items()}
    numbers = np.array([loops.program.numbers(h) for h in np.asarray(dt, dtype=np.float64).tolist()])
    named |= {f"c{k}": _in_lanes(column, m, blocks) for k, column in enumerate(numbers.T)}
    for name, array in arrays_of(system, loops).items():
        named.setdefault(name, _in_lanes(np.broadcast_to(array, (m, *np.shape(array))), m, blocks))
    for i in loops.axes:
        begin = _in_lanes(start[:, :, i], m, blocks)
        named |= {f"x{i}": begin, f"xs{i}": begin.copy(), f"sum{i}": np.zeros((blocks, LANES))}
    still = start if still is None else np.broadcast_to(still, (m, n, d))
    origin = [_in_lanes(still[:, :, i], m, blocks) for i in loops.axes]
    function = compiled(loops).sweep
    _use_threads(threads)
    alive = np.arange(blocks)
    distances = []
    for done in range(0, steps, CHUNK):
        count = min(CHUNK, steps - done)
        function(alive, *(named[name] for name in (*loops.arrays, *loops.per_system)), *lists(system, loops), count)
        with np.errstate(invalid="ignore", over="ignore"):
            squares = sum((named[f"x{i}"] - origin[i]) ** 2 for i in loops.axes)
            furthest = np.sqrt(np.asarray(squares).max(axis=1))
        distances.append(furthest)
        alive = alive[(furthest[alive] <= limit).any(axis=1)]
        progress((done + count) / steps)
    x, v = (np.stack([_out_of_lanes(named[f"{q}{i}"], m) for i in loops.axes], axis=2) for q in "xv")
    history = np.array([f.reshape(-1)[:m] for f in distances])
    return SweptSystems(x, v, history, ~(history[-1] <= limit))


def _per_system(system: MassSpringSystem, parameters: Mapping[str, Array], m: int) -> dict[str, Array]:
    """The loops' arrays that parameters decide, one for each system: shape (m, masses or springs) or (m,)."""
    given = {name: np.asarray(values, dtype=np.float64) for name, values in parameters.items()}
    for name, values in given.items():
        _check(system, name, values, m)
    arrays = {name: _for_each(given[name], len(system.springs)) for name in OF_SPRINGS if name in given}
    if "drag" in given:
        arrays["drag"] = given["drag"]
    return arrays | _weights(system, given, m)


def _check(system: MassSpringSystem, name: str, values: Array, m: int) -> None:
    """Refuse a parameter that is not one number for each system, or of which one makes no sense."""
    if values.shape != (m,):
        raise InputError(f"{name} has shape {values.shape}: expected ({m},), one for each system")
    # Ranges are intervals: what holds for the ends holds between them.
    for value in (values.min(), values.max()):
        system.with_parameter(name, float(value))


def _weights(system: MassSpringSystem, given: Mapping[str, Array], m: int) -> dict[str, Array]:
    """What masses are divided by and what they weigh, along each axis, where masses or gravity differ."""
    if not {"mass", "gravity"} & given.keys():
        return {}
    masses, gravity = np.tile(system.masses, (m, 1)), np.tile(system.gravity, (m, 1))
    if "mass" in given:
        masses = _for_each(given["mass"], len(system.masses))
    if "gravity" in given:
        gravity = np.zeros((m, system.dimension))
        gravity[:, system.vertical_axis] = -given["gravity"]
    weights = {f"weight{i}": masses * gravity[:, i, None] for i in range(system.dimension)}
    return {"divisor": np.where(system.fixed, np.inf, masses), **weights}


def _for_each(values: Array, count: int) -> Array:
    """One number for each system as one for each of its items, shape (m, count)."""
    return np.repeat(values[:, None], count, axis=1)


def _in_lanes(array: Array, m: int, blocks: int) -> Array:
    """Shape (m, ...) as (blocks, ..., LANES); the last block is filled up with its last system."""
    filled = np.concatenate([array, np.repeat(array[-1:], blocks * LANES - m, axis=0)])
    return np.ascontiguousarray(np.moveaxis(filled.reshape(blocks, LANES, *array.shape[1:]), 1, -1))


def _out_of_lanes(array: Array, m: int) -> Array:
    """The reverse of _in_lanes."""
    turned = np.moveaxis(array, -1, 1)
    return turned.reshape(-1, *turned.shape[2:])[:m]


def _use_threads(threads: int | None) -> None:
    import numba

    most = numba.config.NUMBA_NUM_THREADS
    numba.set_num_threads(most if threads is None else min(threads, most))
