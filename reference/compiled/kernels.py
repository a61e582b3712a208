"""Schemes at the speed of tuned C: the loops of `loops`, compiled once and kept on disk.

`advance` does what `simulate` does, to the bit, for explicit schemes without changes on the fly; it keeps only the end.
"""

from __future__ import annotations

import os
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np

from reference.compiled import runs
from reference.compiled.loops import Loops
from reference.compiled.mesh_loops import MeshLoops, lists_of, numbering
from reference.compiled.run_loops import RunLoops
from reference.compiled.tracing import numbers_of, trace, trace_obstacles
from reference.errors import Unsupported
from reference.forces import springs_of_masses
from reference.jit import module
from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.system import MassSpringSystem

#: From this many springs on, threads are worth their waking (`springlab run speed` shows where).
THREADS_FROM = 300_000


def advance(system: MassSpringSystem, scheme: Scheme, dt: float, steps: int, threads: int | None = None) -> State:
    """The state after a number of steps of dt [s]; the same bits for any number of threads.

    Args:
        threads: how many; left out, all there are for large systems and one for others.

    Raises:
        Unsupported: for a scheme that needs more than the accelerations of the whole state.
    """
    kernel = Kernel(system, scheme, threads)
    kernel.advance(dt, steps)
    return State(steps * dt, *kernel.state())


class Kernel:
    """A system in the arrays of a scheme's loops, to be advanced again and again.

    Args, and what is raised: see `advance`.
    """

    def __init__(self, system: MassSpringSystem, scheme: Scheme, threads: int | None = None) -> None:
        if threads is None:
            threads = (os.cpu_count() or 1) if len(system.springs) >= THREADS_FROM else 1
        self._threads = threads
        self._loops = loops_for(scheme, system, threads=threads > 1)
        self._arrays = arrays_of(system, self._loops)
        self._lists = lists(system, self._loops)
        self._function = compiled(self._loops).advance

    @property
    def text(self) -> str:
        """The text of its loops."""
        return self._loops.text()

    @property
    def arrays(self) -> dict[str, Array]:
        """What they work on, by the names it has in the text."""
        named = {**self._arrays, **dict(zip(self._loops.lists, self._lists, strict=True))}
        return {name: array for name, array in named.items() if isinstance(array, np.ndarray)}

    @property
    def bytes(self) -> int:
        """How much memory its arrays take."""
        return sum(array.nbytes for array in self.arrays.values())

    def advance(self, dt: float, steps: int) -> None:
        """A number of steps of dt [s]."""
        if self._threads > 1:
            import numba

            numba.set_num_threads(min(self._threads, numba.config.NUMBA_NUM_THREADS))
        arrays = [self._arrays[name] for name in (*self._loops.arrays, "drag")]
        self._function(*arrays, *self._loops.program.numbers(dt), *self._lists, steps)

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s] now, each (n, d)."""
        x, v = (np.stack([self._arrays[f"{q}{i}"] for i in self._loops.axes], axis=1) for q in "xv")
        if "order" in self._arrays:
            x, v = (q[np.argsort(self._arrays["order"], kind="stable")] for q in (x, v))
        return x, v


def loops_for(scheme: Scheme, system: MassSpringSystem, lanes: bool = False, threads: bool = False) -> Loops:
    """The loops of a scheme on a system. Raises Unsupported for a scheme or springs not to be written as such loops."""
    if system.collisions is not None:
        raise Unsupported("no compiled loops of masses that collide: they run as written")
    if not system.rest_lengths.all():
        raise Unsupported("no compiled loops of springs of rest length 0: they run as written")
    if system.pulls.any():
        raise Unsupported("no compiled loops of masses that a force pulls: they run as written")
    if system.angular_springs is not None:
        raise Unsupported("no compiled loops of springs that resist bending: they run as written")
    if system.nonlinear is not None:
        raise Unsupported(f"no compiled loops of springs with {', '.join(system.nonlinear.asked)}: they run as written")
    program = trace(scheme)
    n, springs = len(system.masses), system.springs
    string = len(springs) == n - 1 and bool((springs == np.arange(n - 1)[:, None] + [0, 1]).all())
    obstacles = trace_obstacles(system.obstacles, system.dimension) if system.obstacles else None
    kind: type[Loops] = Loops
    if not lanes and runs.is_large(system):
        kind = RunLoops if runs.has_runs(system) else MeshLoops
    return kind(program, system.dimension, string and kind is Loops, obstacles, lanes, threads, _noalias())


def arrays_of(system: MassSpringSystem, loops: Loops) -> dict[str, Any]:
    """A system as the loops want it: one array per axis, and room for what they keep.

    A fixed mass is divided by infinity, so that it needs no question in the loop; the forces of a string have a zero at
    either end for the same reason.
    """
    if isinstance(loops, MeshLoops):
        order = numbering(system)
        return _arrays_of(system.renumbered(order), loops) | {"order": order}
    return _arrays_of(system, loops)


def _arrays_of(system: MassSpringSystem, loops: Loops) -> dict[str, Any]:
    n, s = len(system.masses), len(system.springs)
    arrays: dict[str, Any] = {
        "rest_length": system.rest_lengths,
        "stiffness": system.stiffness,
        "damping": system.damping,
        "divisor": np.where(system.fixed, np.inf, system.masses),
        "drag": system.drag,
    }
    for i in loops.axes:
        x, v = system.positions[:, i].copy(), system.velocities[:, i].copy()
        arrays |= {f"x{i}": x, f"v{i}": v, f"xs{i}": x.copy(), f"vs{i}": v.copy(), f"sum{i}": np.zeros(1)}
        arrays |= {f"force{i}": np.zeros(s + 2 if loops.string else s), f"weight{i}": system.masses * system.gravity[i]}
        arrays |= {f"a{k}_{i}": np.zeros(n) for k in loops.kept}
    if isinstance(loops, RunLoops):
        chunks = (os.cpu_count() or 1) if loops.threads else 1
        arrays |= (lists_of if isinstance(loops, MeshLoops) else runs.runs_of)(system, chunks)
    return arrays


def lists(system: MassSpringSystem, loops: Loops) -> list[Any]:
    """What is joined to what, and the numbers of obstacles, as the loops want them.

    Indices are unsigned, as Numba asks of signed ones if they are negative.
    """
    obstacles = [np.array(numbers_of(system.obstacles))] if loops.obstacles else []
    if loops.string or isinstance(loops, RunLoops):
        return obstacles
    first, spring, sign = springs_of_masses(system)
    ends = [np.ascontiguousarray(end, dtype=np.uint32) for end in system.springs.T]
    return [*ends, first.astype(np.uint32), spring.astype(np.uint32), sign, *obstacles]


@cache
def compiled(loops: Loops) -> ModuleType:
    """The loops as a module of compiled functions, kept on disk under the digest of their text and the spring's law."""
    return module(loops.text())


@cache
def _noalias() -> bool:
    """Let `njit` take the option noalias: that no two arrays given to a kernel share memory. Whether it does.

    Numba's compiler has it (its parallel loops use it) but its decorator does not offer it. Without it short loops
    spend more time on asking whether arrays overlap than on springs: at 20 masses twice the time. The way in is not
    public: where another Numba has none, loops are as right, and slower.
    """
    try:
        from numba.core.cpu import CPUTargetOptions
        from numba.core.options import _mapping

        CPUTargetOptions.noalias = _mapping("noalias")
    except (ImportError, AttributeError):
        return False
    return True
