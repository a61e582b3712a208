"""Many runs: steppers on a scene, over a grid of its parameters and of dt, each run judged where it is done."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import isfinite, prod
from typing import Any, TypeVar

import numpy as np

from engines.engine import Engine
from engines.process.isolation import MEMORY_LIMIT, TIME_LIMIT, EngineStepper
from engines.process.worker import FOR_SCHEMES, import_beforehand
from experiments.runs.task import Task
from reference.changes import Change, whole_steps
from reference.errors import InputError
from reference.files.setup import setup_for
from reference.outcome import Outcome
from reference.stepper import Stepper
from reference.system import MassSpringSystem

T = TypeVar("T")

#: So many values an axis may have, and all together so many runs.
MOST_VALUES, MOST_RUNS = 1_000_000, 10_000_000


@dataclass(frozen=True)
class ParameterSweep:
    """What is run.

    Attributes:
        scene: a name or a TOML file.
        axes: the values of the scene's parameters that are varied, and of dt [s]; all combinations are run.
        settings: of the parameters that are not.
        identify: whether to find the scheme of every run, which takes a second for each.
        keep: whether to keep trajectories.
        time_limit: of a run [s].
        memory_limit: of a run's process [bytes].
    """

    scene: str
    steppers: Sequence[Stepper]
    axes: Mapping[str, Sequence[float]]
    settings: Mapping[str, str]
    dt: float | None = None
    duration: float | None = None
    identify: bool = False
    keep: bool = False
    time_limit: float = TIME_LIMIT
    memory_limit: float = MEMORY_LIMIT

    def __post_init__(self) -> None:
        for name, limit, unit in (("time", self.time_limit, "s"), ("memory", self.memory_limit / 2**30, "GiB")):
            if not limit > 0:
                raise InputError(f"--{name}-limit {limit:g}: expected a number > 0 [{unit}]")
        fixed = {*self.settings, *([] if self.dt is None else ["dt"])}
        for name in self.axes:
            if name in fixed:
                raise InputError(f"--over {name}: expected a parameter that is not set to one value as well")
        if len(self) > MOST_RUNS:
            raise InputError(f"--over makes {len(self):,} runs: expected at most {MOST_RUNS:,}")

    def __len__(self) -> int:
        return len(self.steppers) * prod(map(len, self.axes.values()))

    def tasks(self) -> Iterator[Task]:
        """A task for every run. Raises InputError for a point of the grid that makes no sense."""
        import_beforehand(FOR_SCHEMES)
        for values in product(*self.axes.values()):
            point = dict(zip(self.axes, values, strict=True))
            settings = {**self.settings, **{name: f"{value:.17g}" for name, value in point.items() if name != "dt"}}
            setup = setup_for(self.scene, point.get("dt", self.dt), self.duration, settings)
            steps = whole_steps(setup.dt, setup.duration)
            for stepper in self.steppers:
                engine = stepper.engine if isinstance(stepper, EngineStepper) else None
                wishes = (self.identify, self.keep)
                arguments = (stepper.name, engine, setup.system, setup.dt, steps, setup.changes, *wishes)
                named = {"scene": setup.name, **{k: _number(v) for k, v in self.settings.items()}, **point}
                yield Task(judged, arguments, named, self.time_limit, self.memory_limit)


def _number(text: str) -> float | str:
    """What was set to a number is looked for as a number."""
    try:
        return float(text)
    except ValueError:
        return text


def judged(
    stepper: str,
    engine: Engine | None,
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: tuple[Change, ...],
    identify: bool,
    keep: bool,
) -> dict[str, Any]:
    """Run a stepper in this very process, and say how far it is from the true motion [m] and which scheme it is.

    Args:
        engine: the stepper, if it is an engine; otherwise it is found by its name.
        identify: whether to say which scheme it is.
        keep: whether to return the trajectory.
    """
    from experiments.runs.comparison import finite, told, true_motion
    from experiments.runs.steppers import find_steppers
    from reference.identification import identify_all

    made_by = find_steppers([stepper])[0] if engine is None else EngineStepper(engine, isolate=_here)
    outcome = made_by.run(system, dt, steps, changes)
    answer: dict[str, Any] = {"outcome": outcome if keep else replace(outcome, trajectory=None)}
    if outcome.ending == "done" and outcome.trajectory is not None and not system.obstacles:
        frames = len(outcome.trajectory)
        true, _ = true_motion(system, dt, frames - 1, changes)
        answer["error_m"] = None if true is None else finite(float(outcome.trajectory.distance(true).max()))
    if identify:
        (found,) = identify_all([(made_by, outcome)], system, dt, steps, changes).each
        answer |= {**told(found), "ties": ", ".join(found.ties)}
    return answer


def _here(function: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT) -> T | Outcome:
    """What a function returns, called in this very process: it is the run's own."""
    return function(*arguments)


@dataclass(frozen=True)
class Tally:
    """How the runs of one stepper ended."""

    stepper: str
    endings: Counter[str]
    reasons: Counter[str]

    @property
    def row(self) -> list[Any]:
        """The stepper, how many runs ended how, and the reason given most often."""
        common = self.reasons.most_common(1)
        counts = ", ".join(f"{count} {ending}" for ending, count in self.endings.most_common())
        return [self.stepper, counts, common[0][0] if common else None]


def tally(steppers: Sequence[Stepper]) -> dict[str, Tally]:
    """No run of anybody yet."""
    return {stepper.name: Tally(stepper.name, Counter(), Counter()) for stepper in steppers}


def count(tallies: Mapping[str, Tally], stepper: str, outcome: Outcome) -> None:
    """One more run of a stepper."""
    tallies[stepper].endings[outcome.ending] += 1
    if outcome.ending in ("crashed", "timed out", "unsupported"):
        tallies[stepper].reasons[outcome.reason] += 1


def parse_axes(words: Sequence[str]) -> dict[str, Sequence[float]]:
    """KEY=LOW:HIGH:COUNT, evenly spaced, or with `:log` after it, by equal factors; or KEY=A,B,C.

    Raises:
        InputError: for anything else, or a key given twice.
    """
    axes: dict[str, Sequence[float]] = {}
    for word in words:
        key, equals, values = word.partition("=")
        if not (key and equals and values):
            raise InputError(f"--over {word!r}: expected KEY=LOW:HIGH:COUNT, KEY=LOW:HIGH:COUNT:log or KEY=A,B,C")
        if key in axes:
            raise InputError(f"--over {word!r}: {key} is varied already")
        try:
            axes[key] = _values(values)
        except InputError as error:
            raise InputError(f"--over {word!r}: {error}") from None
        except ValueError:
            raise InputError(
                f"--over {word!r}: expected KEY=LOW:HIGH:COUNT, KEY=LOW:HIGH:COUNT:log or KEY=A,B,C"
            ) from None
    return axes


def _values(text: str) -> Sequence[float]:
    if ":" not in text:
        return [_finite(value) for value in text.split(",")]
    low, high, number, *spacing = text.split(":")
    ends = (_finite(low), _finite(high))
    if spacing not in ([], ["log"]):
        raise ValueError(text)
    if int(number) < 1:
        raise InputError(f"COUNT = {int(number)}: expected at least 1")
    if spacing and min(ends) <= 0:
        raise InputError(f"from {ends[0]:g} to {ends[1]:g} by equal factors: expected both ends > 0 with :log")
    if int(number) > MOST_VALUES:
        raise InputError(f"{int(number):,} values: expected at most {MOST_VALUES:,}")
    space = np.geomspace if spacing else np.linspace
    values: list[float] = space(*ends, int(number)).tolist()
    return values


def _finite(text: str) -> float:
    if not isfinite(value := float(text)):
        raise ValueError(text)
    return value
