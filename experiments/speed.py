"""How fast are the kernels, as a ratio to tuned C on the same mesh in the same run?"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from engines.engine import Engine, registry
from engines.process.isolation import isolated
from experiments.benchmark.meshes import LARGE, cases, peak_per_mass, string
from experiments.benchmark.timing import adapter_overhead, seconds_of
from experiments.benchmark.traffic import bytes_per_step, seconds_to_copy
from experiments.benchmark.tuned import TunedHeun
from experiments.experiment import Experiment, Result, Table
from experiments.runs.environment import processor
from experiments.runs.progress import Progress
from reference.compiled.kernels import Kernel
from reference.compiled.loops import LANES
from reference.compiled.sweep import sweep
from reference.errors import Unsupported
from reference.forces import SpringMotion
from reference.outcome import Outcome
from reference.scenes import find
from reference.schemes import catalogue
from reference.state import State
from reference.system import MassSpringSystem

DT = 1e-5

#: How many node-steps a timing is of, about, and of how many rounds it is the least.
WORK, ROUNDS = 4_000_000, 5


@dataclass(frozen=True)
class Timing:
    """One kernel against tuned C on the same mesh without obstacles: node-steps per second, the ratio of times, memory.

    Attributes:
        bytes_per_mass: of the arrays that are stepped.
        moved_per_mass: how many bytes a step reads and writes, counted.
        bound: node-steps per second if that took what a copy of as many bytes takes on as many threads, measured.
        peak_per_mass: the most memory [bytes] that making the system and stepping it took a process, for large ones.
    """

    what: str
    threads: int
    masses: int
    springs: int
    ours: float
    tuned: float | None
    bytes_per_mass: float | None
    moved_per_mass: float | None = None
    bound: float | None = None
    peak_per_mass: float | None = None

    @property
    def ratio(self) -> float | None:
        """Our time over tuned C's, for the same work."""
        return None if self.tuned is None else self.tuned / self.ours

    @property
    def over_bound(self) -> float | None:
        """Our time over the bound's."""
        return None if self.bound is None else self.bound / self.ours


def time_adapter(engine: Engine) -> list[list[object]]:
    """What an adapter adds to the engine's own step: engine, masses, seconds of both, their ratio."""
    rows: list[list[object]] = []
    for masses in (10, 100):
        found = isolated(adapter_overhead, engine, find("string").system({"masses": masses}), DT)
        if isinstance(found, Outcome):
            rows.append([engine.name, masses, None, None, None, found.reason])
        else:
            rows.append([engine.name, masses, *found, found[0] / found[1], ""])
    return rows


def run(progress: Progress) -> Result:
    """All meshes, the sweep, and NumPy arrays for comparison."""
    rows = []
    for name, system in cases().items():
        progress(name)
        timings = time_mesh(name, system())
        peak = peak_per_mass(name) if timings[0].masses >= LARGE else None
        rows += [replace(row, peak_per_mass=peak) for row in timings]
    progress("string 200, renumbered")
    order = np.concatenate([[0], 1 + np.random.default_rng(0).permutation(200)])
    rows += time_mesh("string 200, renumbered at random", string(200).renumbered(order))
    progress("sweep")
    rows += time_sweep()
    progress("adapters")
    adapters = [row for engine in registry().values() for row in time_adapter(engine)]
    progress("NumPy arrays")
    rows.append(time_numpy())
    return result_of(rows, adapters)


def result_of(rows: Sequence[Timing], adapters: Sequence[Sequence[object]]) -> Result:
    """Timings, and rows of `time_adapter`, as findings and tables."""
    columns = [
        "what",
        "threads",
        "masses",
        "springs",
        "node-steps/s",
        "tuned C, node-steps/s",
        "time / tuned C",
        "bytes/mass",
        "bytes moved/mass and step",
        "bound by memory, node-steps/s",
        "time / bound by memory",
        "peak bytes/mass",
    ]
    table = Table("speed", columns, [_row(r) for r in rows])
    columns = ["engine", "masses", "step [s]", "engine's own step [s]", "ratio", "reason"]
    ratios = {str(row[0]): row[4] for row in adapters if isinstance(row[4], float) and row[1] == 100}
    findings = [*_findings(rows), _adapter_finding(ratios)]
    return Result(findings, [table, Table("adapters", columns, adapters)], {"rows": rows})


def _row(r: Timing) -> list[object]:
    work = [r.what, r.threads, r.masses, r.springs, r.ours, r.tuned, r.ratio]
    return [*work, r.bytes_per_mass, r.moved_per_mass, r.bound, r.over_bound, r.peak_per_mass]


def time_mesh(name: str, system: MassSpringSystem) -> list[Timing]:
    """Heun by our kernel, on one thread and on all, against tuned C."""
    n = len(system.masses)
    return [_time_kernel(name, system, threads) for threads in ((1, os.cpu_count() or 1) if n >= 2_000 else (1,))]


def _time_kernel(name: str, system: MassSpringSystem, threads: int) -> Timing:
    """The least of ROUNDS times of each, one after the other, so that all see the same machine."""
    n = len(system.masses)
    steps = max(2, WORK // n)
    kernel, tuned = Kernel(system, catalogue.find("heun"), threads), _anchor(system)
    kernel.advance(DT, 1)
    moved = bytes_per_step(kernel.text, kernel.arrays)
    times = [
        (
            seconds_of(lambda: kernel.advance(DT, steps)),
            tuned.advance(DT, steps) if tuned else np.inf,
            steps * seconds_to_copy(moved, threads),
        )
        for _ in range(ROUNDS)
    ]
    ours, theirs, bound = (n * steps / min(column) for column in zip(*times, strict=True))
    return Timing(name, threads, n, len(system.springs), ours, theirs or None, kernel.bytes / n, moved / n, bound)


def time_sweep(systems: int = 65_536, masses: int = 20) -> list[Timing]:
    """Many strings at once, on one thread and on all, against tuned C on one of them and one thread."""
    return [_time_sweep(systems, masses, threads) for threads in dict.fromkeys((1, os.cpu_count() or 1))]


def _time_sweep(systems: int, masses: int, threads: int, steps: int = 200) -> Timing:
    """What it takes to set the arrays up is taken off: the speed is that of stepping."""
    system, heun, dt = string(masses), catalogue.find("heun"), np.full(systems, DT)
    sweep(system, heun, dt[:LANES], 1, threads=threads)

    def seconds(count: int) -> float:
        return min(seconds_of(lambda: sweep(system, heun, dt, count, threads=threads)) for _ in range(2))

    speed = systems * masses * steps / (seconds(steps + 1) - seconds(1))
    return Timing(f"sweep of {systems} strings", threads, masses, masses, speed, _anchor_speed(system), None)


def time_numpy(masses: int = 20) -> Timing:
    """Heun as the scheme's own function on whole arrays, as a student runs it."""
    system = string(masses)
    motion = SpringMotion(system)
    heun = catalogue.find("heun").on(motion)
    steps = 2_000

    def stepping() -> None:
        state: State = motion.start
        for _ in range(steps):
            state = heun(state, DT)

    ours = min(seconds_of(stepping) for _ in range(ROUNDS))
    speed = masses * steps / ours
    return Timing("scheme's own function, string 20", 1, masses, masses, speed, _anchor_speed(system), None)


def _anchor_speed(system: MassSpringSystem) -> float | None:
    """Node-steps per second of tuned C on a small system."""
    tuned, n = _anchor(system), len(system.masses)
    return max(WORK / tuned.advance(DT, WORK // n) for _ in range(ROUNDS)) if tuned else None


def _anchor(system: MassSpringSystem) -> TunedHeun | None:
    try:
        return TunedHeun(system, as_string=True)
    except Unsupported:
        return None


def _findings(rows: Sequence[Timing]) -> list[str]:
    single = [r for r in rows if r.threads == 1 and r.ratio is not None and r.bytes_per_mass is not None]
    if not single:
        return [f"Measured on {processor()}; there is no C compiler here, so there are no ratios."]
    slowest = max(single, key=lambda r: r.ratio or 0.0)
    sweeps = [r for r in rows if r.what.startswith("sweep") and r.ratio]
    sentences = [
        f"On {processor()}, one thread of ours takes at most {slowest.ratio:.2f} times the time of tuned C on the same "
        f"mesh (at {slowest.what})."
    ]
    peaks = [r for r in single if r.peak_per_mass is not None]
    if peaks:
        most = max(peaks, key=lambda r: r.peak_per_mass or 0.0)
        sentences.append(
            f"A large system's arrays take at most {max(r.bytes_per_mass or 0.0 for r in peaks):.0f} bytes a mass; "
            f"making and stepping it takes a process at most {most.peak_per_mass:.0f} ({most.what})."
        )
    bound = [r for r in single if r.over_bound is not None and r.masses >= LARGE]
    if bound:
        largest = max(bound, key=lambda r: r.springs)
        sentences.append(
            f"On the largest mesh ({largest.what}) one thread takes {largest.ratio:.2f} times the time of tuned C, and "
            f"{largest.over_bound:.1f} times what a copy of the {largest.moved_per_mass:.0f} bytes takes that a step "
            "reads and writes for each mass: as many times at most could it be quicker with its arrays as they are."
        )
    sentences += [
        f"The sweep is {1 / r.ratio:.2f} times as fast as tuned C on {r.threads} thread{'s' if r.threads > 1 else ''}."
        for r in sweeps
        if r.ratio
    ]
    return sentences


def _adapter_finding(ratios: Mapping[str, float]) -> str:
    if not ratios:
        return "No engine could be timed."
    worst = max(ratios, key=lambda name: ratios[name])
    return f"On 100 masses an adapter adds at most {ratios[worst] - 1:.1%} to the engine's own step ({worst})."


EXPERIMENT = Experiment(
    name="speed",
    title="Speed",
    question="How fast are the kernels, as a ratio to tuned C on the same mesh in the same run?",
    slides="8",
    run=run,
    in_report=False,
    timed=True,
)
