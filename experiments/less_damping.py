"""How does a string swing with less damping?

The true motion, whose energy only the drag takes: dE/dt = -2 (Cd/m) T, with T the kinetic energy. A small swing has
half of its energy in motion on average, so that it should decay as exp(-t Cd/m). The string's first are not small.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from experiments.experiment import Experiment, Result, Table
from experiments.runs.progress import Progress
from reference.conserved import energy
from reference.scenes import find
from reference.state import Array, Trajectory
from reference.system import MassSpringSystem
from reference.theory.equilibrium import hanging_string
from reference.theory.exact import exact

#: On every mass [N s/m]: more, the report's usual one, and less.
DRAGS = (0.1, 0.02, 0.004)

DT, DURATION = 1e-3, 3.0

#: When the string is drawn [s].
TIMES = (0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8)


@dataclass(frozen=True)
class Swing:
    """One string.

    Attributes:
        drag: on every mass [N s/m].
        motion: the true one.
        energies: above that of rest [J], one for each time of the motion.
        predicted: the decay time of a small swing's energy, in which it falls to 1/e [s].
        fitted: the decay time of the exponential that is nearest to all the energies in logarithms [s].
        measured: when the energy has fallen to 1/e of the start's [s]; None where the motion ends before.
        taken: what the drag has taken by the end, from the velocities alone [J].
    """

    drag: float
    motion: Trajectory
    energies: Array
    predicted: float
    fitted: float
    measured: float | None
    taken: float


def run(progress: Progress) -> Result:
    """The string with more and less drag."""
    swings = []
    for drag in DRAGS:
        progress(f"drag {drag:g} N s/m")
        system = find("string").system({"drag": drag})
        swings.append(swing(system, exact(system, DT, round(DURATION / DT))))
    return result_of(swings)


def result_of(swings: Sequence[Swing]) -> Result:
    """Swings as findings and tables."""
    tables = [_summary(swings), _over_time(swings)]
    return Result(_findings(swings), tables, {"swings": swings})


def swing(system: MassSpringSystem, motion: Trajectory) -> Swing:
    """What becomes of a string's energy in a motion."""
    rest = energy(system, hanging_string(system))
    energies = np.array([energy(system, state) for state in motion.states()]) - rest
    squares = (motion.velocities**2).sum(axis=(1, 2))
    return Swing(
        drag=system.drag,
        motion=motion,
        energies=energies,
        predicted=float(system.masses[-1] / system.drag),
        fitted=float(-1 / np.polyfit(motion.times, np.log(energies), 1)[0]),
        measured=falls_to(1 / np.e, motion.times, energies),
        taken=float(system.drag * np.trapezoid(squares, motion.times)),
    )


def falls_to(part: float, times: Array, energies: Array) -> float | None:
    """The first time [s] at which no more than a part of the first energy is left; None where that is never.

    Between two times the logarithm of the energy is a straight line.
    """
    left = np.log(energies / (part * energies[0]))
    if left.min() > 0:
        return None
    i = int(np.argmax(left <= 0))
    return float(np.interp(0.0, -left[i - 1 : i + 1], times[i - 1 : i + 1]))


def _summary(swings: Sequence[Swing]) -> Table:
    columns = ["drag [N s/m]", "falls to 1/e at, measured [s]"]
    columns += ["decay time, predicted for small swings [s]", "decay time, fitted to the whole run [s]"]
    columns += ["energy at the start [J]", f"after {DURATION:g} s [J]", "taken by the drag [J]", "left [1]"]
    rows = []
    for s in swings:
        first, last = s.energies[[0, -1]].tolist()
        rows.append([s.drag, s.measured, s.predicted, s.fitted, first, last, s.taken, last / first])
    return Table("less_damping", columns, rows)


def _over_time(swings: Sequence[Swing]) -> Table:
    """The energies that the figure draws, and where the last mass is."""
    columns = ["drag [N s/m]", "time [s]", "energy above rest [J]", "last mass x [m]", "last mass y [m]"]
    rows = [
        [s.drag, time, joule, *end]
        for s in swings
        for time, joule, end in list(
            zip(s.motion.times.tolist(), s.energies.tolist(), s.motion.positions[:, -1].tolist(), strict=True)
        )[::10]
    ]
    return Table("less_damping_over_time", columns, rows)


def _findings(swings: Sequence[Swing]) -> list[str]:
    off = max(abs(s.fitted / s.predicted - 1) for s in swings)
    balance = max(abs(s.energies[0] - s.energies[-1] - s.taken) / s.energies[0] for s in swings)
    return [
        *(_decay(s) for s in swings),
        "Small swings are predicted to decay with m/Cd, whatever their size; an exponential fitted to all of a run "
        f"has a decay time that differs from it by {100 * off:.1f} % at most. The first swings are large, and the time "
        "to 1/e is theirs.",
        f"What is missing of the energy and what the drag has taken differ by {balance:.0e} of it at most.",
    ]


def _decay(s: Swing) -> str:
    keeps = f"With a drag of {s.drag:g} N s/m {100 * s.energies[-1] / s.energies[0]:.2g} % of the energy is left after "
    falls = (
        "it never falls to 1/e in that time, which is too short to measure when"
        if s.measured is None
        else f"it falls to 1/e at {s.measured:.3g} s, measured"
    )
    small = f"(decay time of small swings, predicted: {s.predicted:.2g} s; fitted to the whole run: {s.fitted:.3g} s)"
    return f"{keeps}{DURATION:g} s: {falls} {small}."


EXPERIMENT = Experiment(
    name="less_damping",
    title="Less damping",
    question="How does a string swing with less damping?",
    slides="13-14",
    run=run,
)
