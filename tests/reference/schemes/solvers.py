"""What solves a system for the tests of exact solutions: a scheme, or the exact solution of other forces."""

from __future__ import annotations

from collections.abc import Callable

from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Trajectory
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from tests import wrong

#: Solves a system at 0, dt, 2 dt, ...: the exact solution, or a wrong one.
Solver = Callable[[MassSpringSystem, float, int], Trajectory]


def solved_by(name: str) -> Solver:
    """A catalogued scheme in place of the exact solution."""
    return lambda system, dt, steps: simulate(system, find(name), dt, steps * dt)


def under(law: wrong.Law) -> Solver:
    """The exact solution under a wrong force law."""
    return lambda system, dt, steps: exact(system, dt, steps, equations=wrong.under(law))
