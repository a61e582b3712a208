"""One function of many steppers, and which scheme each of them is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeVar

from engines.process.isolation import EngineStepper
from experiments.runs.runner import current
from reference.identification import Identification, identify_run
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem

T = TypeVar("T")

#: Called with what is being done now.
Progress = Callable[[str], None]


def side_by_side(
    steppers: Sequence[Stepper], function: Callable[[Stepper], T], progress: Progress
) -> Iterator[tuple[Stepper, T]]:
    """What a function makes of every stepper, in their order. Engines, being other processes, run in parallel."""

    def told(stepper: Stepper) -> T:
        progress(stepper.name)
        return function(stepper)

    with current().threads() as pool:
        engines = {s.name: pool.submit(told, s) for s in steppers if isinstance(s, EngineStepper)}
        for stepper in steppers:
            yield stepper, engines[stepper.name].result() if stepper.name in engines else told(stepper)


def identify_start(
    stepper: Stepper, outcome: Outcome, system: MassSpringSystem, known: Mapping[str, Trajectory]
) -> Identification:
    """Which scheme a run is, judged by as much of its beginning as is known of the catalogue."""
    trajectory = outcome.trajectory
    if trajectory is not None:
        frames = min(len(trajectory), max(map(len, known.values())))
        trajectory = Trajectory(
            trajectory.times[:frames], trajectory.positions[:frames], trajectory.velocities[:frames]
        )
    return identify_run(stepper.name, Outcome(outcome.ending, outcome.reason, trajectory), system, known)


def scheme_of(stepper: Stepper, identification: Identification) -> SchemeStepper | None:
    """What theory knows a stepper as: a scheme is itself, another is what it was identified as."""
    if isinstance(stepper, SchemeStepper):
        return stepper
    named = identification.identified_as
    return None if named is None else catalogued()[named]
