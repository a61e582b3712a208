"""What a step of a user's own is given of the system."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from engines.engine import CAPABILITIES, LAWS, demands
from reference.errors import Unsupported
from reference.state import Array, State
from reference.system import MassSpringSystem

#: What acts on masses besides linear springs, drag and weight. Springs that break have no stiffness from then on.
BESIDES = (*(law for law in LAWS if law != "breaking"), "pulls", "angular springs")

#: What a step with forces of its own reads of springs.
OF_SPRINGS = ("springs", "rest_lengths", "stiffness", "damping")


class OwnSystem:
    """Masses and springs as arrays of its own, in SI units, and what they do: for `step(x, v, dt, system)`.

    Attributes:
        masses, fixed: shape (n,). springs: shape (s, 2). rest_lengths, stiffness, damping: shape (s,).
        drag: a number. gravity: shape (d,). positions: where all masses start, shape (n, d).

    Springs' own numbers are not all there is to a force where the system has what is in BESIDES: who asks for them then
    has forces of its own that would be wrong, and Unsupported is raised.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        from reference.forces import SpringMotion

        self._besides = next((CAPABILITIES[demand] for demand in demands(system) if demand in BESIDES), "")
        numbers = () if self._besides else OF_SPRINGS
        for name in ("masses", "fixed", "gravity", "positions", *numbers):
            setattr(self, name, getattr(system, name).copy())
        self.drag = system.drag
        self._motion, self._masses = SpringMotion(system), system.masses

    def acceleration(self, x: Array, v: Array) -> Array:
        """Accelerations of all masses at positions x and velocities v [m/s^2], shape (n, d); of fixed ones zero."""
        state = State(0.0, np.ascontiguousarray(x, float), np.ascontiguousarray(v, float))
        return np.asarray(self._motion.acceleration(state))

    def forces(self, x: Array, v: Array) -> Array:
        """Mass times that [N]."""
        return self._masses[:, None] * self.acceleration(x, v)

    def __getattr__(self, name: str) -> Any:
        """What is not there. Raises Unsupported for numbers of springs that do not say what forces there are."""
        if name in OF_SPRINGS:
            raise Unsupported(
                f"asks for system.{name}, which does not tell the whole force where there are "
                f"{self.__dict__.get('_besides')}: system.acceleration(x, v) does"
            )
        raise AttributeError(f"a system has no {name}")


def exercise_string(system: MassSpringSystem) -> Any:
    """A string as exercises 3 and 4 have it, without its fixed mass. Raises Unsupported for what is none."""
    if not system.is_string or (system.damping != 0).any():
        raise Unsupported("a step of exercise 4 knows strings without damping only")
    return SimpleNamespace(
        masses=system.masses[1:].copy(),
        stiffness=system.stiffness.copy(),
        rest_lengths=system.rest_lengths.copy(),
        drag=system.drag,
        gravity=-float(system.gravity[system.vertical_axis]),
        anchor=system.positions[0].copy(),
    )


def exercise_spring(system: MassSpringSystem) -> Any:
    """One mass hanging on a spring, as exercises 1 and 2 have it. Raises Unsupported for what is none."""
    up = system.vertical_axis
    beside = np.delete(np.concatenate([np.diff(system.positions, axis=0), system.velocities]), up, axis=1)
    if not system.is_string or len(system.masses) != 2 or beside.any() or system.drag:
        raise Unsupported("a step of exercises 1 and 2 knows one mass that hangs on one spring, without drag")
    return SimpleNamespace(
        mass=float(system.masses[1]),
        stiffness=system.stiffness.item(),
        rest_length=system.rest_lengths.item(),
        damping=system.damping.item(),
        gravity=-float(system.gravity[up]),
    )
