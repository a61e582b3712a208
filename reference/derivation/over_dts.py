"""Over which dt a stepper is the scheme it was named at one: a step may change its rule with dt.

Single steps of a string in motion, at other dt than the one that named it, beside those of the scheme. A dt counts only
where the scheme is told from others so: at very small ones all do the same but for rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from reference.derivation.oscillators import DT, Run, Runs, runs_of
from reference.identification.scale import ROUNDING, Precision
from reference.outcome import Outcome
from reference.state import Array
from reference.stepper import stepper_named
from reference.system import MassSpringSystem

#: What is tried [s]; the last is that of step matrices.
DTS = (2e-6, 2e-5, 2e-4, 2e-2, DT)

#: In longer steps than this [s] springs are softer, so that h w is as large as in this one: equations that are to be
#: solved have several solutions where it is larger.
LONG = 2e-2

#: Schemes that the named one has to be told from.
OTHERS = ("euler", "kick_drift", "drift_kick", "heun")

#: Two steps are the same within so many roundings, and told apart by so many times that.
ROUNDINGS, APART = 1e4, 10.0

#: In a step as short as that [s] schemes differ so little that rounding may hide which one it is.
SHORT = 1e-4

#: What is said there of one that has no name.
UNNAMED = "was not identified, as rounding probably hides which scheme it is"

#: How fast masses move at most [m/s], along each axis.
SPEED = 0.5


@dataclass(frozen=True)
class OverDts:
    """What was found.

    Attributes:
        scheme: the name.
        same: at which dt of DTS a step is the scheme's [s].
        other: at which it is not [s].
        named_there: what it is at each of these, by `identify`; None where it has no name.
        off: by what part of its size a step is off the scheme's there.
        drowned: at which the scheme is not told from others for rounding [s].
        failed: at which its step, or the scheme's, gives no numbers [s].
        iterates: whether it solves equations by iterations, or makes steps of its own.
    """

    scheme: str
    same: tuple[float, ...]
    other: tuple[float, ...] = ()
    named_there: tuple[str | None, ...] = ()
    off: tuple[float, ...] = ()
    drowned: tuple[float, ...] = ()
    failed: tuple[float, ...] = ()
    iterates: bool = False

    @property
    def changed(self) -> tuple[tuple[float, str | None], ...]:
        """At which dt [s] it is not the scheme, and what it is there."""
        named = zip(self.other, self.named_there, strict=True)
        return tuple((dt, name) for dt, name in named if name != self.scheme)

    @property
    def loose(self) -> tuple[tuple[float, float], ...]:
        """At which dt [s] it is named as the scheme, but a step is off by more than rounding; and by how much."""
        named = zip(self.other, self.named_there, self.off, strict=True)
        return tuple((dt, off) for dt, name, off in named if name == self.scheme)

    @property
    def is_another(self) -> bool:
        """Whether it is another scheme somewhere: not only off."""
        return any(name is not None for _, name in self.changed)

    def __str__(self) -> str:
        """In a sentence without its stop; empty where there is nothing to say."""
        if not self.other:
            same = f"It is {self.scheme} at dt = {_listed(self.same)} s, too" if self.same else ""
            return "; ".join([same] * bool(same) + self._untold())
        words = f"it is {self.scheme} at the dt that named it"
        words += f" and at {_listed(self.same)} s" if self.same else ""
        if self.changed:
            there = (
                f"{dt:g} s, where it {f'is {name}' if name else UNNAMED if dt < SHORT else 'was not identified'}"
                for dt, name in self.changed
            )
            why = "it is not the same at every dt" if self.iterates else "it changes its rule with dt"
            words = f"{why}: {words}, but not at {'; '.join(there)}"
        loose = [
            f"at {dt:g} s it is so, too, but a step is off by {off:.1g}, more than rounding of one step"
            for dt, off in self.loose
        ]
        return "; ".join([words, *loose, *self._untold()])

    def _untold(self) -> list[str]:
        of = ((self.drowned, "rounding drowns it"), (self.failed, "a step fails"))
        return [f"not told at {_listed(dts)} s, where {why}" for dts, why in of if dts]


def _listed(dts: tuple[float, ...]) -> str:
    return ", ".join(f"{dt:g}" for dt in dts)


def over_dts(
    runs: Runs,
    scheme: str,
    system: MassSpringSystem,
    precision: Precision,
    named_on: Callable[[MassSpringSystem, float], str | None],
) -> OverDts:
    """Try them.

    Args:
        runs: the stepper's. scheme: what it was named.
        system: on which; it is set in motion where the stepper can begin so.
        named_on: what the stepper is named on a system at a dt.
    """
    tried = [Run(_in_motion(_soft_enough(system, dt)), dt) for dt in DTS]
    outcomes = runs(tried)
    if all(outcome.ending == "unsupported" for outcome in outcomes):
        tried = [Run(_soft_enough(system, dt), dt) for dt in DTS]
        outcomes = runs(tried)
    known = runs_of(stepper_named(scheme))(tried)
    others = [runs_of(stepper_named(name))(tried) for name in OTHERS if name != scheme]
    same: list[float] = []
    other: list[tuple[float, float]] = []
    drowned: list[float] = []
    failed: list[float] = []
    tol = ROUNDINGS * ROUNDING[precision]
    for i, dt in enumerate(DTS):
        ends = [_end(outcome) for outcome in (outcomes[i], known[i], *(each[i] for each in others))]
        own, its, *rest = ends
        if own is None or its is None:
            failed.append(dt)
        elif any(found is None or _off(found, its) < APART * tol for found in rest):
            drowned.append(dt)
        elif _off(own, its) <= tol:
            same.append(dt)
        else:
            other.append((dt, _off(own, its)))
    dts, off = tuple(dt for dt, _ in other), tuple(off for _, off in other)
    return OverDts(
        scheme,
        tuple(same),
        dts,
        tuple(named_on(_soft_enough(system, dt), dt) for dt in dts),
        off,
        tuple(drowned),
        tuple(failed),
    )


def _soft_enough(system: MassSpringSystem, dt: float) -> MassSpringSystem:
    part = min(1.0, LONG / dt)
    return replace(system, stiffness=system.stiffness * part**2, damping=system.damping * part)


def _in_motion(system: MassSpringSystem) -> MassSpringSystem:
    random = np.random.default_rng(4)
    speed = SPEED * random.uniform(-1, 1, system.positions.shape)
    return replace(system, velocities=np.where(system.fixed[:, None], 0.0, speed))


def _end(outcome: Outcome) -> Array | None:
    """Positions and velocities after the step; None where there are no such numbers."""
    run = outcome.trajectory
    if run is None or len(run) < 2:
        return None
    found = np.concatenate([run.positions[-1], run.velocities[-1]])
    return found if np.isfinite(found).all() else None


def _off(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / max(1.0, np.abs(other).max()))
