"""Engines made for the suite, in NumPy: an honest one, and liars that the suite must catch.

All claim to be kick-drift on strings. Each liar's class says its one lie.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from engines.engine import CAPABILITIES, Precision, Unsupported, refuse_beyond
from reference.obstacles import project_out
from reference.springs.nonlinear_law import secant_stiffness, stretches
from reference.state import Array
from reference.system import MassSpringSystem, Value


class KickDrift:
    """Honest: v += h a(x, v), then x += h v."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        self.system, self.dt = system, dt
        self.x, self.v = system.positions.copy(), system.velocities.copy()

    def step(self) -> None:
        """Advance by dt."""
        self.v += self.dt * self.acceleration()
        self.x += self.dt * self.v
        self.project()

    def bare_step(self) -> Callable[[], object]:
        """There is no adapter around it."""
        return self.step

    def project(self) -> None:
        """Masses inside an obstacle are put on its surface."""
        self.x, self.v = project_out(self.system.obstacles, self.system.fixed[:, None], self.x, self.v)

    def acceleration(self) -> Array:
        """Of all masses [m/s^2], shape (n, d)."""
        system = self.system
        a, b = system.springs.T
        separation, w = self.x[b] - self.x[a], self.v[b] - self.v[a]
        length = np.linalg.norm(separation, axis=1)
        u = separation / length[:, None]
        spring_force = self.stiffness() * (length - system.rest_lengths) + system.damping * (u * w).sum(axis=1)
        force = system.masses[:, None] * system.gravity + system.pulls - system.drag * self.v
        np.add.at(force, a, spring_force[:, None] * u)
        np.subtract.at(force, b, spring_force[:, None] * u)
        self.bend(force)
        return np.where(system.fixed[:, None], 0.0, force / system.masses[:, None])

    def bend(self, force: Array) -> None:
        """Add what resists bending in the plane: the angle's gradients as quotients of complex numbers."""
        angular = self.system.angular_springs
        for k, (a, b, c) in enumerate([] if angular is None else angular.masses.tolist()):
            assert angular is not None
            p, q = (complex(*(self.x[i] - self.x[b])) for i in (a, c))
            torque = angular.stiffness[k] * np.angle(q / p * np.exp(-1j * angular.rest_angles[k]))
            for i, push in ((a, 1j * torque / p.conjugate()), (c, -1j * torque / q.conjugate())):
                force[i] += [push.real, push.imag]
                force[b] -= [push.real, push.imag]

    def stiffness(self) -> Array:
        """Of all springs [N/m]: the secant stiffness of those that are not linear."""
        return secant_stiffness(self.system, stretches(self.system, self.x))

    def state(self) -> tuple[Array, Array]:
        """Copies."""
        return self.x.copy(), self.v.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Any parameter."""
        self.system = self.system.with_parameter(parameter, value)


class Euler(KickDrift):
    """Moves with the velocities before the kick."""

    def step(self) -> None:
        """Advance by dt."""
        before = self.v.copy()
        self.v += self.dt * self.acceleration()
        self.x += self.dt * before


class StifferByAMillionth(KickDrift):
    """Has springs stiffer than told by 1e-6 of their stiffness."""

    def stiffness(self) -> Array:
        """Of all springs [N/m]."""
        return (1 + 1e-6) * self.system.stiffness


class ForgetsDrag(KickDrift):
    """Has no drag, and does not say so."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system.with_parameter("drag", 0.0), dt)


class OneMassForAll(KickDrift):
    """Gives all masses the first one's mass."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system.with_parameter("mass", float(system.masses[0])), dt)


class PassesThrough(KickDrift):
    """Knows of no obstacle, and does not say so."""

    def project(self) -> None:
        """Nothing."""


class Bounces(KickDrift):
    """Is thrown back by an obstacle as fast as it came."""

    def project(self) -> None:
        """The velocity across is turned."""
        before = self.v
        super().project()
        self.v = 2 * self.v - before


class Rubs(KickDrift):
    """Loses some of the velocity along an obstacle."""

    def project(self) -> None:
        """A tenth of it, at each projection."""
        before = self.v
        super().project()
        self.v = np.where((self.v != before).any(axis=1, keepdims=True), 0.9 * self.v, self.v)


class ResetsSilently(KickDrift):
    """Starts anew when a spring is ten times as long as it should be, and goes on as if nothing had been."""

    def step(self) -> None:
        """Advance by dt."""
        super().step()
        if np.linalg.norm(np.diff(self.x, axis=0), axis=1).max() > 10 * self.system.rest_lengths.max():
            self.x[:], self.v[:] = self.system.positions, self.system.velocities


class FallsAsleep(KickDrift):
    """Stops for good once no mass has been faster than 0.04 m/s for 2 s."""

    slow = 0.0

    def step(self) -> None:
        """Advance by dt."""
        if self.slow < 2:
            super().step()
        self.slow = self.slow + self.dt if np.linalg.norm(self.v, axis=1).max() < 0.04 else 0.0


class IgnoresChanges(KickDrift):
    """Accepts every change and makes none."""

    def change(self, parameter: str, value: Value) -> None:
        """Nothing."""


class ChangesAllAlike(KickDrift):
    """Of one number for each takes the first for all."""

    def change(self, parameter: str, value: Value) -> None:
        """One number."""
        first = value if isinstance(value, int | float) else value[0]
        super().change(parameter, first)


class RoundsToSingle(KickDrift):
    """Honest, in single precision."""

    def step(self) -> None:
        """Advance by dt, and round."""
        super().step()
        self.x[:], self.v[:] = self.x.astype(np.float32), self.v.astype(np.float32)


class OneMassInSingle(RoundsToSingle, OneMassForAll):
    """In single precision gives all masses the first one's mass."""


class RefusesEverything(KickDrift):
    """Can do whatever it is asked, so it says, and refuses all of it."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        raise Unsupported("not today")


class RefusesWhatItCan(KickDrift):
    """Refuses everything for the lack of a capability that it says it has."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        raise Unsupported(f"RefusesWhatItCan cannot do {CAPABILITIES['3d']}")


class RefusesChanges(KickDrift):
    """Refuses every change by its name."""

    def change(self, parameter: str, value: Value) -> None:
        """None."""
        raise Unsupported(f"a change of {parameter} is not for it")


class HandsOutItsMemory(KickDrift):
    """Hands out the very arrays it works on."""

    def state(self) -> tuple[Array, Array]:
        """Views."""
        return self.x, self.v


class StartsAtRest(KickDrift):
    """Forgets the velocities at the start."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system, dt)
        self.v[:] = 0.0


@dataclass(frozen=True)
class Doctored:
    """An engine of one of the classes above."""

    simulation: type[KickDrift] = KickDrift
    capabilities: frozenset[str] = frozenset(CAPABILITIES)
    package: str = "numpy"
    settings: Mapping[str, object] = field(default_factory=dict)
    semantics: str = "everything is as given, so it says"
    refuses: bool = True

    @property
    def name(self) -> str:
        """The class's."""
        return self.simulation.__name__

    @property
    def identified_as(self) -> Mapping[str, str]:
        """Kick-drift, whatever it is."""
        return dict.fromkeys(("plain", "damping", "drag"), "kick_drift")

    def start(self, system: MassSpringSystem, dt: float) -> KickDrift:
        """The simulation, for a system within the capabilities unless it takes all systems."""
        if self.refuses:
            refuse_beyond(self, system)
        return self.simulation(system, dt)


@dataclass(frozen=True)
class DoctoredSingle(Doctored):
    """The same, which says that it computes in single precision."""

    precision: Precision = "single"
