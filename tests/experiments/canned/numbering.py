"""What permutations change: nothing, or the order of masses or springs shows; and Pymunk's rounds."""

from __future__ import annotations

import numpy as np

from experiments import numbering
from experiments.experiment import Result
from experiments.numbering import DAMPINGS, ROUNDS, Convergence, Row
from experiments.runs.permutation import CHANGES, PermutationEffects
from reference.stepper import catalogued
from tests.experiments.canned.steppers import SCHEME_OF, Named

MASSES, SPRINGS, NONE = frozenset({"masses"}), frozenset({"springs"}), frozenset[str]()

#: What a round leaves with each of the dampings: predicted, and measured.
LEFT = ((0.5, 0.52), (0.8, 0.81))

#: The difference with no round [m].
START = 1e-2


def row(name: str, predicted: frozenset[str] | None, masses: float, springs: float, damping: float, ends: float) -> Row:
    """Differences of each permutation [m]; a name that is no scheme's is an engine's."""
    stepper = catalogued().get(name) or Named(name)
    return Row(
        stepper, damping, predicted, PermutationEffects(dict(zip(CHANGES, (masses, springs, ends), strict=True)), {})
    )


def rows() -> list[Row]:
    """With each damping: one sees nothing, one masses, one springs if damped, one is not known, one takes ends only."""
    made = []
    for damping in DAMPINGS:
        made += [
            row("kick_drift", NONE, 0.0, 1e-16, damping, 3e-16),
            row("euler_in_place", MASSES, 2e-3, 0.0, damping, 0.0),
            row("pymunk_springs", SPRINGS if damping else NONE, 0.0, 5e-6 if damping else 0.0, damping, 0.0),
            row("stranger", None, 0.0, 0.0, damping, 7e-7),
            Row(
                Named("mujoco_cable"),
                damping,
                NONE,
                PermutationEffects(
                    {"ends swapped": 4e-16}, {"masses renumbered": "strings only", "springs reversed": "strings only"}
                ),
            ),
        ]
    return made


def convergences() -> list[Convergence]:
    """The difference falls by what is measured, with each round."""
    return [
        Convergence(c, list(START * left ** np.array(ROUNDS)), predicted, left)
        for c, (predicted, left) in zip(numbering.ROUNDS_DAMPINGS, LEFT, strict=True)
    ]


def usual() -> Result:
    """Of these rows and rounds."""
    return numbering.result_of(rows(), convergences())


def full() -> Result:
    """All schemes and engines."""
    names = [name for name, s in catalogued().items() if s.kind != "pendulum"]
    made = [row(name, NONE, 0.0, 1e-16, c, 0.0) for c in DAMPINGS for name in [*names, *SCHEME_OF]]
    return numbering.result_of(made, convergences())
