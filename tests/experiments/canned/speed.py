"""Timings by hand: one thread at 0.8, 1.25 and 1.1 of tuned C's time, two threads at half of that.

Memory would let them be four times as quick.
"""

from __future__ import annotations

from experiments import speed
from experiments.experiment import Result
from experiments.speed import Timing

#: By mesh: masses, springs, our time over tuned C's on one thread, bytes of arrays and of the process for a mass.
MESHES: dict[str, tuple[int, int, float, float, float | None]] = {
    "string 200": (200, 200, 0.8, 40.0, None),
    "cloth 300 x 300": (90_000, 538_000, 1.25, 60.0, 120.0),
    "jello 50^3": (125_000, 1_500_000, 1.1, 80.0, 160.0),
}

#: Node-steps of tuned C in a second.
TUNED = 1e8


def timings() -> list[Timing]:
    """Of each mesh on one thread and on two; a sweep; NumPy, which has no arrays to count."""
    rows = []
    for name, (masses, springs, ratio, arrays, peak) in MESHES.items():
        for threads in (1, 2):
            ours = TUNED / ratio * threads
            rows.append(Timing(name, threads, masses, springs, ours, TUNED, arrays, 3 * arrays, 4 * ours, peak))
    rows += [Timing("sweep of 65536 strings", n, 20, 20, 4 * n * TUNED, TUNED, None) for n in (1, 2)]
    return [*rows, Timing("scheme's own function, string 20", 1, 20, 20, TUNED / 100, TUNED, None)]


def usual() -> Result:
    """Of these, and of two engines' adapters; a third could not be timed."""
    adapters: list[list[object]] = [
        ["mujoco_tendons", 100, 1.02e-5, 1e-5, 1.02, ""],
        ["pymunk_springs", 100, 1.2e-5, 1e-5, 1.2, ""],
        ["pymunk_springs", 10, 5e-6, 1e-6, 5.0, ""],
        ["exudyn_springs", 100, None, None, None, "exudyn is not installed"],
    ]
    return speed.result_of(timings(), adapters)


def no_compiler() -> Result:
    """Without tuned C there are no ratios."""
    return speed.result_of([Timing("string 200", 1, 200, 200, TUNED, None, 40.0)], [])
