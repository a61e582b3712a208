"""What would a sweep of a million runs take, on few cores and on many, and what would become its bottleneck?"""

from __future__ import annotations

import importlib
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, islice
from pathlib import Path
from time import perf_counter
from typing import Any, Literal

from engines.process.isolation import isolated
from engines.process.supervisor import supervisor
from experiments.experiment import Experiment, Result, Table
from experiments.runs.cluster import BATCH_SECONDS
from experiments.runs.progress import Progress
from experiments.runs.steppers import all_steppers, installed_engines
from experiments.runs.store import Store
from experiments.runs.sweeps import ParameterSweep
from experiments.runs.task import Task
from reference.scratch import owner_prefix
from reference.stepper import Stepper

#: The sweep, and the cores it is thought to run on.
RUNS, CORES = 1_000_000, (2, 100, 1000)

#: Runs of each kind that are timed, and tasks that are handed out and kept.
TIMED, HANDED = 20, 500


@dataclass(frozen=True)
class Kind:
    """A kind of run, and what it takes of a core [s], measured."""

    name: str
    seconds: float


@dataclass(frozen=True)
class Hand:
    """Something that the one process at the top does, and what it takes [s], measured.

    Attributes:
        where: at every run, at one on this machine's cores, or at a batch of runs for a cluster's worker.
    """

    name: str
    seconds: float
    where: Literal["always", "on this machine", "on a cluster, a batch"] = "always"


def run(progress: Progress) -> Result:
    """The costs, measured, and what a million runs would take, predicted from them."""
    progress("runs")
    kinds = list(_kinds())
    progress("handing out and keeping")
    hands, size = _hands()
    progress("a cluster")
    dask = _dask()
    hands += [] if dask is None else [Hand("a batch of runs to a Dask worker and back", dask, "on a cluster, a batch")]
    failures = [] if dask is not None else ["Dask: not installed; expected the extra springlab[cluster]"]
    return result_of(kinds, hands, size, failures)


def result_of(kinds: Sequence[Kind], hands: Sequence[Hand], size: float, failures: Sequence[str] = ()) -> Result:
    """Costs as findings and tables.

    Args:
        size: what a run takes in the store [bytes].
    """
    tables = [_predictions(kinds, hands), _costs(kinds, hands)]
    return Result(_findings(kinds, hands, size), tables, {"kinds": kinds, "hands": hands}, failures)


def serial(kind: Kind, hands: Sequence[Hand], cores: int) -> float:
    """What the process at the top does for a run, one after another [s]; beyond this machine's cores through Dask."""
    if cores <= (os.cpu_count() or 1):
        return sum(hand.seconds for hand in hands if hand.where in ("always", "on this machine"))
    shares = {"always": 1.0, "on this machine": 0.0, "on a cluster, a batch": min(1.0, kind.seconds / BATCH_SECONDS)}
    return sum(shares[hand.where] * hand.seconds for hand in hands)


def predicted(kind: Kind, hands: Sequence[Hand], cores: int) -> float:
    """Seconds for all RUNS: what takes longer, the runs shared by the cores or what is done for each at the top."""
    return RUNS * max(kind.seconds / cores, serial(kind, hands, cores))


def _kinds() -> Iterator[Kind]:
    """One stepper of each package, and a scheme; then with identification, and in a process that is new each time."""
    for stepper in _one_of_each():
        yield Kind(stepper.name, _seconds_of_run(stepper))
    heun = all_steppers()["heun"]
    yield Kind("heun, identified", _seconds_of_run(heun, identify=True, runs=3))
    yield Kind("heun, in a new process after a crash", _seconds_of_run(heun, afresh=True, runs=3))


def _one_of_each() -> list[Stepper]:
    by_package = {s.engine.package: s for s in reversed(installed_engines())}
    return [all_steppers()["heun"], *reversed(by_package.values())]


def _seconds_of_run(stepper: Stepper, identify: bool = False, afresh: bool = False, runs: int = TIMED) -> float:
    """The mean of some runs on strings of different stiffness, in a process that has run one before."""
    tasks = list(islice(_tasks(stepper, identify), runs + 1))
    _do(tasks.pop())
    begin = perf_counter()
    for task in tasks:
        if afresh:
            supervisor().stop()
        _do(task)
    return (perf_counter() - begin) / len(tasks)


def _tasks(stepper: Stepper, identify: bool = False) -> Iterator[Task]:
    for stiffness in count(150.0, 0.01):
        yield from ParameterSweep("string", [stepper], {"stiffness": [stiffness]}, {}, identify=identify).tasks()


def _do(task: Task) -> Any:
    return isolated(task.function, *task.arguments, time_limit=task.time_limit, memory_limit=task.memory_limit)


def _hands() -> tuple[list[Hand], float]:
    """What the process at the top does for a run, and the bytes that a run takes in the store."""
    waiting = _tasks(all_steppers()["heun"])
    answer = _do(next(waiting))
    with tempfile.TemporaryDirectory(prefix=owner_prefix()) as folder:
        store = Store(Path(folder) / "store.sqlite")
        making, tasks = _mean(lambda: next(waiting))
        steps: Mapping[str, Callable[[Task], Any]] = {
            "its key": lambda task: task.key,
            "looking it up in the store": store.find,
            "keeping its answer": lambda task: store.keep(task, answer, 0.0),
        }
        hands = [Hand("making the task", making)]
        for name, step in steps.items():
            left = iter(tasks)
            hands.append(Hand(name, _mean(lambda step=step, left=left: step(next(left)))[0]))  # type: ignore[misc]
        there, _ = _mean(lambda: isolated(_nothing, tasks[0].arguments))
        hands.append(Hand("a task to a process and back", there, "on this machine"))
        store.close()
        return hands, store.file.stat().st_size / len(tasks)


def _mean(task: Callable[[], Any]) -> tuple[float, list[Any]]:
    """Seconds of a task, the mean of many, and what they returned; the first is for warming up."""
    task_first = [task()]
    begin = perf_counter()
    answers = [task() for _ in range(HANDED - 1)]
    return (perf_counter() - begin) / len(answers), task_first + answers


def _nothing(arguments: tuple[Any, ...]) -> int:
    """What is left of a task when there is nothing to do."""
    return len(arguments)


def _dask() -> float | None:
    """Seconds that a scheduler and its client need for a task with nothing to do, many of them under way at once."""
    try:
        dask: Any = importlib.import_module("distributed")
    except ImportError:
        return None
    local = {"n_workers": 1, "threads_per_worker": 1, "dashboard_address": None, "host": "127.0.0.1"}
    with dask.LocalCluster(**local) as cluster, dask.Client(cluster) as client:
        task = next(_tasks(all_steppers()["heun"]))
        client.submit(_nothing, task.arguments, pure=False).result()
        begin = perf_counter()
        client.gather([client.submit(_nothing, task.arguments, pure=False) for _ in range(HANDED)])
        return (perf_counter() - begin) / HANDED


def _predictions(kinds: Sequence[Kind], hands: Sequence[Hand]) -> Table:
    columns = ["kind of run", "measured, a run [s]"]
    columns += [f"predicted, {cores:,} cores" for cores in CORES]
    columns += ["predicted, cores that help"]
    rows = []
    for kind in kinds:
        times = [in_words(predicted(kind, hands, cores)) for cores in CORES]
        rows.append([kind.name, kind.seconds, *times, round(kind.seconds / serial(kind, hands, max(CORES)))])
    return Table("million_runs", columns, rows)


def _costs(kinds: Sequence[Kind], hands: Sequence[Hand]) -> Table:
    rows = [[kind.name, "on a core", kind.seconds] for kind in kinds]
    rows += [[hand.name, f"at the top, {hand.where}", hand.seconds] for hand in hands]
    return Table("million_runs_costs", ["what", "where", "measured [s]"], rows)


def in_words(seconds: float) -> str:
    """A time as people say it."""
    for unit, size in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


def _findings(kinds: Sequence[Kind], hands: Sequence[Hand], size: float) -> list[str]:
    few, many = min(CORES), max(CORES)
    fastest, slowest = min(kinds, key=lambda k: k.seconds), max(kinds, key=lambda k: k.seconds)
    helping = [round(kind.seconds / serial(kind, hands, many)) for kind in (fastest, slowest)]
    most = max((hand for hand in hands if hand.where == "always"), key=lambda hand: hand.seconds)
    return [
        f"Measured here, a run takes from {1e3 * fastest.seconds:.0f} ms ({fastest.name}) to "
        f"{1e3 * slowest.seconds:.0f} ms ({slowest.name}): a million are predicted to take "
        f"{in_words(predicted(fastest, hands, few))} to {in_words(predicted(slowest, hands, few))} on {few} cores, and "
        f"{in_words(predicted(fastest, hands, many))} to {in_words(predicted(slowest, hands, many))} on {many:,}.",
        f"The bottleneck is then the one process that hands out tasks and keeps answers: it needs "
        f"{1e3 * serial(fastest, hands, many):.2g} ms for each, so that beyond {helping[0]} cores for the "
        f"quickest kind of run, and {helping[1]} for the slowest, more are predicted to help no more. The "
        f"largest part of that is {most.name}.",
        f"A run takes {size / 1e3:.2g} kB in the store, a million {RUNS * size / 1e9:.2g} GB, without trajectories.",
    ]


EXPERIMENT = Experiment(
    name="million_runs",
    title="A million runs",
    question="What would a sweep of a million runs take, and what would become its bottleneck?",
    slides="15",
    run=run,
    in_report=False,
    timed=True,
)
