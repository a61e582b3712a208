"""Answers as tables for people: what the commands print, and what the module `springlab` shows in a notebook."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isnan, pi
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # these import NumPy and Numba: a command's help does without
    from experiments.runs.comparison import Comparison
    from experiments.simulation.modes_of_scene import Modes
    from experiments.simulation.simulation import Break, Largest, Simulation
    from reference.identification import Identification
    from reference.scenes import Setup
    from reference.state import Array
    from reference.system import MassSpringSystem

#: So many springs that broke are named.
FEW_BREAKS = 3


@dataclass(frozen=True)
class Shown:
    """A table, and sentences below it.

    Attributes:
        title: in words; may be empty.
        columns: headings, with units.
        rows: numbers, words, or None for what there is not.
        notes: sentences.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]
    notes: Sequence[str] = ()


def title_of(setup: Setup) -> str:
    """The scene, its dt, and how long it is run; where these are not whole steps, that too."""
    title = f"{setup.name}: dt = {setup.dt:g} s, {setup.run_duration:.6g} s"
    if abs(setup.run_duration - setup.duration) > 1e-9 * setup.duration:
        title += f", which is {setup.steps} whole steps ({setup.duration:g} s were asked for)"
    return title


def of_comparison(comparison: Comparison) -> Shown:
    """Each stepper: how far from the true motion, which scheme it is, how far from that."""
    from experiments.runs.comparison import remarks

    columns = ["stepper", "outcome", "error [m]", "identified as", "deviation [m]", "reason"]
    keys = ["stepper", "outcome", "error_m", "identified_as", "identification_error_m"]
    rows = [[*(run.row[key] for key in keys), run.why] for run in comparison.runs]
    notes = list(remarks(comparison.runs))
    if comparison.why_no_true_motion:
        notes.append(f"No error is known: {comparison.why_no_true_motion}.")
    return Shown(title_of(comparison.setup), columns, rows, notes)


def of_identification(found: Identification) -> Shown:
    """The catalogue, nearest first; what it is, in words, is the title."""
    from experiments.runs.comparison import finite

    rows = [[match.scheme, finite(match.error), match.steps] for match in found.ranking]
    deviation = "deviation in a step [m]" if found.by_single_steps else "deviation [m]"
    return Shown(str(found), ["scheme", deviation, "over [steps]"], rows, [found.remark] if found.remark else [])


def of_simulation(simulation: Simulation) -> Shown:
    """What the scene did under each stepper, a column for each."""
    names = [run.stepper.name for run in simulation.runs]
    rows = [[label, *(cell(run) for run in simulation.runs)] for label, cell in SUMMARY.items()]
    runs = [run for run in simulation.runs if run.outcome.reason]
    notes = [f"{run.stepper.name}: {run.outcome.ending}: {run.outcome.reason}" for run in runs]
    return Shown(title_of(simulation.setup), ["", *names], rows, notes)


def of_modes(modes: Modes) -> Shown:
    """Frequencies, periods and damping ratios, slowest first."""
    from experiments.simulation.modes_of_scene import UNCOUPLED

    natural = modes.natural
    rows = [
        [str(i + 1), float(f), 2 * pi * float(f), 1 / f if f else None, None if isnan(ratio) else float(ratio)]
        for i, (f, ratio) in enumerate(zip(natural.frequencies, natural.damping_ratios, strict=True))
    ]
    columns = ["mode", "frequency [Hz]", "angular [rad/s]", "period [s]", "damping ratio"]
    notes = []
    if natural.coupled > UNCOUPLED:
        notes.append(
            f"Damping couples the modes ({natural.coupled:.1%} of it): the damping ratios are what acts within each."
        )
    if modes.about:
        notes.append(f"These are {modes.about}.")
    return Shown(f"{modes.setup.name}: natural modes about its rest", columns, rows, notes)


def of_springs_at_rest(modes: Modes) -> Shown:
    """What every spring carries at rest."""
    springs = modes.setup.system.springs.tolist()
    rows = [
        [str(j), f"{a} - {b}", float(force), "tension" if force > 0 else "compression" if force < 0 else "none"]
        for j, ((a, b), force) in enumerate(zip(springs, modes.forces, strict=True))
    ]
    return Shown("Springs at rest", ["spring", "masses", "force [N]", ""], rows)


def of_bends(system: MassSpringSystem, bends: Array, torques: Array, when: str) -> Shown:
    """How far every angular spring is bent, and what it gives; one that went with a broken spring is gone."""
    masses = [] if system.angular_springs is None else system.angular_springs.masses.tolist()
    rows = [
        [str(j), " - ".join(map(str, three)), "gone" if isnan(bend) else float(bend), float(torque)]
        for j, (three, bend, torque) in enumerate(zip(masses, bends, torques, strict=True))
    ]
    return Shown(f"Angular springs {when}", ["spring", "masses", "bend [rad]", "torque [N m]"], rows)


def _gave_up(run: Any) -> bool:
    """Whether a step found no solution, so that no state is known that had blown up: the reason below has t and dt."""
    return run.outcome.ending == "diverged" and run.motion is None


def _of_motion(cell: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda run: None if run.motion is None else cell(run.motion)


def _largest(found: Largest | None, what: str, unit: str) -> str | None:
    if found is None:
        return "none"
    return f"{found.value:.4g} {unit}, {what} {found.which}, t = {found.time:.4g} s"


def _breaks(breaks: Sequence[Break]) -> str:
    """The first few, in the order they broke."""
    told = [
        f"{b.which} at t = {b.time:.4g} s, with {b.value:.4g} N{', by a change' if b.by_change else ''}"
        for b in breaks[:FEW_BREAKS]
    ]
    more = [f"and {len(breaks) - FEW_BREAKS} more"] if len(breaks) > FEW_BREAKS else []
    return "; ".join([*told, *more]) or "none"


def _vector(values: Any) -> str:
    return ", ".join(f"{value:.4g}" for value in values.tolist())


#: What is said of every run of a simulation.
SUMMARY: dict[str, Callable[[Any], Any]] = {
    "outcome": lambda run: run.outcome.ending,
    "blew up at [s]": lambda run: "no: see below" if _gave_up(run) else run.blew_up_at,
    "largest sag": _of_motion(lambda m: _largest(m.sag, "mass", "m")),
    "largest stretch": _of_motion(lambda m: _largest(m.stretched, "spring", "m")),
    "largest tension": _of_motion(lambda m: None if m.forces is None else _largest(m.tension, "spring", "N")),
    "largest compression": _of_motion(lambda m: None if m.forces is None else _largest(m.compression, "spring", "N")),
    "springs that broke": _of_motion(lambda m: _breaks(m.breaks)),
    "energy at the start [J]": _of_motion(lambda m: f"{m.energy_at_start['total']:.6g}"),
    "energy at the end [J]": _of_motion(lambda m: f"{m.energy['total']:.6g}"),
    "of it kinetic, elastic, gravitational [J]": _of_motion(
        lambda m: ", ".join(f"{m.energy[name]:.4g}" for name in ("kinetic", "elastic", "gravitational"))
    ),
    "momentum at the end [kg m/s]": _of_motion(lambda m: _vector(m.momentum)),
}
