"""Over which dt a stepper is the scheme it was named at one: a step may change its rule with dt.

Single steps of a string in motion, at other dt than the one that named it, beside those of the scheme. A dt counts only
where the scheme is told from others so: at very small ones all do the same but for rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from reference.derivation.oscillators import Run, Runs, runs_of
from reference.identification.scale import ROUNDING, Precision
from reference.outcome import Outcome
from reference.state import Array
from reference.stepper import stepper_named
from reference.system import MassSpringSystem

#: What is tried [s].
DTS = (2e-6, 2e-5, 2e-4, 2e-2)

#: Schemes that the named one has to be told from.
OTHERS = ("euler", "kick_drift", "drift_kick", "heun")

#: Two steps are the same within so many roundings, and told apart by so many times that.
ROUNDINGS, APART = 1e4, 10.0

#: In a step as short as that [s] schemes differ so little that rounding may hide which one it is.
SHORT = 1e-4

#: What is said there of one that has no name.
UNNAMED = "was not identified, as rounding probably hides which scheme it is"

#: What is said of one that iterates.
ITERATES = "it is not the same at every dt, as its iterations do not converge, or its own steps do not suffice, at all"

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
        iterates: whether it solves equations by iterations, or makes steps of its own.
    """

    scheme: str
    same: tuple[float, ...]
    other: tuple[float, ...] = ()
    named_there: tuple[str | None, ...] = ()
    iterates: bool = False

    def __str__(self) -> str:
        """In a sentence without its stop."""
        if not self.other:
            return f"It is {self.scheme} at dt = {_listed(self.same)} s, too" if self.same else ""
        there = (
            f"{dt:g} s, where it {f'is {name}' if name else UNNAMED if dt < SHORT else 'was not identified'}"
            for dt, name in zip(self.other, self.named_there, strict=True)
        )
        same = f" and at {_listed(self.same)} s" if self.same else ""
        holds = f"it is {self.scheme} at the dt that named it{same}"
        why = ITERATES if self.iterates else "it changes its rule with dt"
        return f"{why}: {holds}, but not at {'; '.join(there)}"


def _listed(dts: tuple[float, ...]) -> str:
    return ", ".join(f"{dt:g}" for dt in dts)


def over_dts(
    runs: Runs,
    scheme: str,
    system: MassSpringSystem,
    precision: Precision,
    named_at: Callable[[float], str | None],
) -> OverDts:
    """Try them.

    Args:
        runs: the stepper's. scheme: what it was named.
        system: on which; it is set in motion where the stepper can begin so.
        named_at: what the stepper is named at another dt.
    """
    moving = _in_motion(system)
    outcomes = runs([Run(moving, dt) for dt in DTS])
    if all(outcome.ending == "unsupported" for outcome in outcomes):
        moving = system
        outcomes = runs([Run(moving, dt) for dt in DTS])
    known = runs_of(stepper_named(scheme))([Run(moving, dt) for dt in DTS])
    others = [runs_of(stepper_named(name))([Run(moving, dt) for dt in DTS]) for name in OTHERS if name != scheme]
    same: list[float] = []
    other: list[float] = []
    for i, dt in enumerate(DTS):
        ends = [_end(outcome) for outcome in (outcomes[i], known[i], *(each[i] for each in others))]
        own, its, *rest = ends
        if own is None or its is None:
            continue
        tol = ROUNDINGS * ROUNDING[precision]
        if any(found is None or _off(found, its) < APART * tol for found in rest):
            continue
        (same if _off(own, its) <= tol else other).append(dt)
    return OverDts(scheme, tuple(same), tuple(other), tuple(map(named_at, other)))


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
