"""Runs of a tenth of a second and of one second, and what the process at the top does for each."""

from __future__ import annotations

from experiments import million_runs
from experiments.experiment import Result
from experiments.million_runs import Hand, Kind

KINDS = [Kind("heun", 0.1), Kind("heun, in a new process after a crash", 1.0)]

#: 1 ms at every run, of which looking it up is most; 2 ms more on this machine; through a cluster its part of 0.2 s.
HANDS = [
    Hand("making the task", 3e-4),
    Hand("looking it up in the store", 7e-4),
    Hand("a task to a process and back", 2e-3, "on this machine"),
    Hand("a batch of runs to a worker and back", 2e-1, "on a cluster, a batch"),
]

#: What a run takes in the store [bytes].
SIZE = 2000.0


def usual() -> Result:
    """Of these."""
    return million_runs.result_of(KINDS, HANDS, SIZE)
