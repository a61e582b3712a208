"""The same system numbered otherwise, and how much that changes: nothing, for who is invariant under permutations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reference.outcome import Outcome
from reference.system import IntArray, MassSpringSystem

#: What is done to the numbering, and whose order it changes.
CHANGES = {"masses renumbered": "masses", "springs reversed": "springs", "ends swapped": "ends"}


@dataclass(frozen=True)
class PermutationEffects:
    """What a stepper makes of other numberings of the same system.

    Attributes:
        distances: for each change that it could run, the largest distance of any mass at any time [m].
        reasons: for each change that it could not run, why.
    """

    distances: Mapping[str, float]
    reasons: Mapping[str, str]

    @classmethod
    def none_ran(cls, reason: str) -> PermutationEffects:
        """Where nothing could be run."""
        return cls({}, dict.fromkeys(CHANGES, reason))

    def depends_on(self, rounding: float) -> frozenset[str]:
        """Whose order changes the motion by more than rounding [m]."""
        return frozenset(CHANGES[change] for change, distance in self.distances.items() if distance > rounding)

    @property
    def permuted(self) -> frozenset[str]:
        """Whose order was changed."""
        return frozenset(CHANGES[change] for change in self.distances)


def permutations(system: MassSpringSystem) -> dict[str, tuple[MassSpringSystem, IntArray]]:
    """The system numbered otherwise, and for each mass its number in the original. Mass 0 stays mass 0."""
    n = len(system.masses)
    same = np.arange(n)
    shuffled = np.concatenate([[0], 1 + np.random.default_rng(1).permutation(n - 1)])
    systems = [
        (system.renumbered(shuffled), shuffled),
        (system.with_springs_reversed(), same),
        (system.with_ends_swapped(), same),
    ]
    return dict(zip(CHANGES, systems, strict=True))


def permutation_effects(run: Callable[[MassSpringSystem], Outcome], system: MassSpringSystem) -> PermutationEffects:
    """How far apart the runs of a system and of the same system numbered otherwise are."""
    original = run(system)
    if original.ending != "done" or original.trajectory is None:
        return PermutationEffects.none_ran(f"{original.ending}, {original.reason}")
    distances, reasons = {}, {}
    for change, (other, order) in permutations(system).items():
        outcome = run(other)
        if outcome.ending == "done" and outcome.trajectory is not None:
            separation = outcome.trajectory.positions - original.trajectory.positions[:, order]
            distances[change] = float(np.linalg.norm(separation, axis=2).max())
        else:
            reasons[change] = f"{outcome.ending}, {outcome.reason}"
    return PermutationEffects(distances, reasons)
