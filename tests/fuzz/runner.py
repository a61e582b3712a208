"""Many inputs through one door: how many were taken, how many refused, and everything else, by its seed."""

from __future__ import annotations

import contextlib
import traceback
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from tests.fuzz.doors import Door, Enter, door
from tests.reference.files.test_fuzzed_files import TooLong, time_limit

#: An input may take so long of the processor and in all [s], and so much memory beside what is held already [bytes].
SECONDS, WAITING, MEMORY = 10.0, 60.0, 2**29


@dataclass
class Report:
    """What became of the inputs of a door.

    Attributes:
        endings: how many were taken, refused, and found fault with.
        findings: by the seed of the input, what happened.
        memory: the most that was held [bytes].
    """

    name: str
    endings: Counter[str] = field(default_factory=Counter)
    findings: dict[int, str] = field(default_factory=dict)
    memory: int = 0

    def __str__(self) -> str:
        counts = ", ".join(f"{self.endings[ending]} {ending}" for ending in ("taken", "refused"))
        return f"{self.name}: {counts}, {len(self.findings)} findings, at most {self.memory / 2**20:.0f} MiB"


def run(name: str, count: int, seed: int, folder: Path) -> Report:
    """Let the inputs of the seeds from `seed` on through a door."""
    report, found = Report(name), door(name)
    with found.opened(folder) as enter:
        for number in range(seed, seed + count):
            ending = entered(found, enter, number)
            if ending not in ("taken", "refused"):
                report.findings[number] = ending
            else:
                report.endings[ending] += 1
            report.memory = max(report.memory, most_memory())
    return report


def entered(found: Door, enter: Enter, seed: int) -> str:
    """What becomes of the input of a seed."""
    made = found.make(Random(seed))
    forget_most_memory()
    before = most_memory()
    try:
        with time_limit(SECONDS, of_the_processor=True), time_limit(WAITING):
            ending = enter(made)
    except TooLong:
        return f"takes more than {SECONDS:g} s of the processor, or {WAITING:g} s"
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        return "".join(traceback.format_exception(error)[-4:])
    taken = most_memory() - before
    return f"takes {taken / 2**20:.0f} MiB" if taken > MEMORY else ending


def most_memory() -> int:
    """The most memory that this process has held since it was forgotten [bytes]; 0 where nobody knows."""
    with contextlib.suppress(OSError, StopIteration):
        lines = Path("/proc/self/status").read_text().splitlines()
        return int(next(line for line in lines if line.startswith("VmHWM")).split()[1]) * 1024
    return 0


def forget_most_memory() -> None:
    """From now on (proc(5), clear_refs)."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")


def inputs(name: str, seeds: range) -> Iterator[Any]:
    """What a door's generator makes of some seeds."""
    return (door(name).make(Random(seed)) for seed in seeds)
