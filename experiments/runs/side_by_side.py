"""One function of many steppers, engines in parallel."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from engines.process.isolation import EngineStepper
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.stepper import Stepper

T = TypeVar("T")


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
