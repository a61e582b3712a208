"""Steppers run on a scene, and what it did under each: where masses came to, what springs carried, how far they sag."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engines.process.isolation import EngineStepper
from experiments.runs.claims import claimed
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.room import check_room
from experiments.runs.side_by_side import side_by_side
from experiments.simulation.spring_state import spring_frames
from reference.changes import Change
from reference.conserved import energy_parts, momentum
from reference.outcome import Outcome, first_blown_up_frame
from reference.scenes import Setup
from reference.springs.angular_law import bends_and_torques
from reference.springs.breaking import breaks_of, tensions
from reference.state import Array, State, Trajectory
from reference.stepper import SchemeStepper, Stepper
from reference.system import BREAK

#: What is said of rods that stand for springs.
RODS = "rods stand for the springs: with which forces they pull is not known"


@dataclass(frozen=True)
class Largest:
    """The largest of its kind in a whole run.

    Attributes:
        value: how large [m] or [N].
        which: of the masses or springs.
        time: when [s].
    """

    value: float
    which: int
    time: float


@dataclass(frozen=True)
class Break(Largest):
    """A spring that broke, with the tension it had then.

    Attributes:
        by_change: whether a change on the fly broke it, and not what it carried.
    """

    by_change: bool


@dataclass(frozen=True, eq=False)
class Motion:
    """What a scene did under one stepper, up to where it ended or blew up.

    Attributes:
        trajectory: of every step.
        end: its last state, shape (n, d).
        stretch: at the end, length less rest length of every spring [m], shape (s,).
        forces: at the end, tension positive [N], shape (s,); None where rods stand for springs.
        bends, torques: at the end, of the angular springs [rad], [N m], shape (k,); of those that went with a broken
            spring the bend is not a number.
        energy_at_start, energy: kinetic, elastic, gravitational and total [J], at the start and at the end.
        momentum: at the end [kg m/s], shape (d,).
        sag: how far a mass came below where it started, at most.
        stretched, tension, compression: the largest of the whole run; None where no spring ever was.
        setup: what was run, with the springs that broke on the way among its changes.
        breaks: which did, by themselves or by a change, each with the time of the step at whose end it did, and the
            tension it had then [N].
    """

    trajectory: Trajectory
    end: State
    stretch: Array
    forces: Array | None
    bends: Array
    torques: Array
    energy_at_start: dict[str, float]
    energy: dict[str, float]
    momentum: Array
    sag: Largest | None
    stretched: Largest | None
    tension: Largest | None
    compression: Largest | None
    setup: Setup
    breaks: tuple[Break, ...]


@dataclass(frozen=True)
class Run:
    """One stepper.

    Attributes:
        motion: what it did; None where it left nothing.
        blew_up_at: when [s]; None where it did not.
    """

    stepper: Stepper
    outcome: Outcome
    motion: Motion | None
    blew_up_at: float | None

    @property
    def document(self) -> dict[str, Any]:
        """As the command line's JSON has it: the state at the end, tension positive; None for what is not known."""
        told: dict[str, Any] = {
            "stepper": self.stepper.name,
            "version": self.stepper.version,
            "outcome": self.outcome.ending,
            "reason": self.outcome.reason,
            "blew_up_at_s": self.blew_up_at,
        }
        motion = self.motion
        if motion is None:
            return {**told, **dict.fromkeys(OF_MOTION)}
        largest = {"sag": motion.sag, "stretch": motion.stretched}
        forces = {"tension": motion.tension, "compression": motion.compression}
        return {
            **told,
            "end_s": float(motion.end.time),
            "positions_m": _plain(motion.end.positions),
            "velocities_m_s": _plain(motion.end.velocities),
            "spring_forces_n": None if motion.forces is None else _plain(motion.forces),
            "stretch": _plain(motion.stretch),
            "bends_rad": _plain(motion.bends),
            "torques_n_m": _plain(motion.torques),
            "energy_j": {name: finite(value) for name, value in motion.energy.items()},
            "energy_at_start_j": {name: finite(value) for name, value in motion.energy_at_start.items()},
            "momentum_kg_m_s": _plain(motion.momentum),
            **{f"largest_{name}_m": found.value if found else 0.0 for name, found in largest.items()},
            **{f"largest_{name}_n": found.value if found else None for name, found in forces.items()},
            "breaks": [_break(broken) for broken in motion.breaks],
        }


#: The keys of a motion in JSON.
OF_MOTION = (
    "end_s",
    "positions_m",
    "velocities_m_s",
    "spring_forces_n",
    "stretch",
    "bends_rad",
    "torques_n_m",
    "energy_j",
    "energy_at_start_j",
    "momentum_kg_m_s",
    "largest_sag_m",
    "largest_stretch_m",
    "largest_tension_n",
    "largest_compression_n",
    "breaks",
)


@dataclass(frozen=True)
class Simulation:
    """All steppers on one scene."""

    setup: Setup
    runs: tuple[Run, ...]

    @property
    def document(self) -> dict[str, Any]:
        """As the command line's JSON has it."""
        asked = {"scene": self.setup.name, "dt_s": self.setup.dt, "duration_s": self.setup.duration}
        ran = {"steps": self.setup.steps, "run_duration_s": self.setup.run_duration}
        return {**asked, **ran, "runs": [run.document for run in self.runs]}


def simulate_all(setup: Setup, steppers: Sequence[Stepper], progress: Progress = lambda _: None) -> Simulation:
    """Run steppers on a setup, and say what the scene did under each.

    Raises:
        InputError: for a dt or duration that makes no sense; where the trajectories would not fit into the memory.
    """
    check_room(steppers, setup.system, setup.steps)

    def task(stepper: Stepper) -> Outcome:
        return stepper.run(setup.system, setup.dt, setup.steps, setup.changes)

    runs = []
    for stepper, outcome in side_by_side(steppers, task, progress):
        progress(f"what {stepper.name} did")
        runs.append(_run(setup, stepper, outcome))
    return Simulation(setup, tuple(runs))


def on_rods(stepper: Stepper) -> bool:
    """Whether a stepper puts rods for the springs."""
    scheme = claimed(stepper.engine) if isinstance(stepper, EngineStepper) else stepper
    return isinstance(scheme, SchemeStepper) and scheme.on_rods


def _run(setup: Setup, stepper: Stepper, outcome: Outcome) -> Run:
    whole = outcome.trajectory
    if whole is None or not len(whole):
        return Run(stepper, outcome, None, None)
    blown_up = first_blown_up_frame(setup.system, whole, changes=setup.changes) if outcome.reason else len(whole)
    sane = whole.frames(slice(max(1, blown_up)))
    at = float(whole.times[blown_up]) if blown_up < len(whole) else None
    broken = breaks_of(setup.system, sane, setup.dt, setup.changes)
    broke = replace(setup, changes=(*setup.changes, *broken))
    return Run(stepper, outcome, _motion(broke, sane, on_rods(stepper), broken), at)


def _motion(setup: Setup, motion: Trajectory, rods: bool, broken: Sequence[Change]) -> Motion:
    first, last = (setup.systems_at([step])[0] for step in (0, len(motion) - 1))
    end = motion.states()[-1]
    tension, compression, stretched = None, None, None
    stretch, forces = np.zeros(0), np.zeros(0)
    for part in spring_frames(setup, motion):
        times = motion.times[part.frames.start : part.frames.stop]
        stretched = _larger(stretched, part.stretch, times)
        tension = _larger(tension, part.force, times)
        compression = _larger(compression, -part.force, times)
        stretch, forces = part.stretch[-1], part.force[-1]
    bend, torque = bends_and_torques(last.angular_springs, end.positions)
    if first.angular_springs is not None and last.angular_springs is not None:
        gone = (first.angular_springs.stiffness > 0) & (last.angular_springs.stiffness == 0)
        bend[gone], torque[gone] = np.nan, 0.0
    return Motion(
        motion,
        end,
        stretch,
        None if rods else forces,
        bend,
        torque,
        energy_parts(first, motion.frames([0]).states()[0]),
        energy_parts(last, end),
        momentum(last, end),
        _sag(setup, motion),
        stretched,
        None if rods else tension,
        None if rods else compression,
        setup,
        tuple(_breaks(setup, motion, broken)),
    )


def _breaks(setup: Setup, motion: Trajectory, broken: Sequence[Change]) -> Iterator[Break]:
    """The springs that broke, with what they carried at the end of that step; what is broken breaks no more."""
    cuts = [change for change in setup.changes if change.parameter == BREAK]
    gone: set[int] = set()
    for change in sorted(cuts, key=lambda change: change.step(setup.dt)):
        step, by_change = change.step(setup.dt), change not in broken
        if step >= len(motion) - by_change:  # a change at the end comes too late to act
            continue
        (system,) = setup.systems_at([step])
        forces = tensions(system, motion.positions[step], motion.velocities[step])
        for spring in np.atleast_1d(change.value).astype(int).tolist():
            if spring not in gone:
                yield Break(float(forces[spring]), spring, float(motion.times[step]), by_change)
            gone.add(spring)


def _break(broken: Break) -> dict[str, Any]:
    """As JSON has it."""
    told = {"spring": broken.which, "time_s": broken.time, "tension_n": finite(broken.value)}
    return {**told, "by_change": broken.by_change}


def _larger(so_far: Largest | None, values: Array, times: Array) -> Largest | None:
    """The larger of what was found so far and the largest of values (m, s) above zero."""
    value = float(np.fmax.reduce(values, axis=None)) if values.size else np.nan
    if not value > (so_far.value if so_far else 0.0):
        return so_far
    frame, which = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return Largest(value, int(which), float(times[frame]))


def _sag(setup: Setup, motion: Trajectory) -> Largest | None:
    """Along gravity, whichever way that points at the start; without any, downwards along the vertical axis."""
    gravity = setup.system.gravity
    size = float(np.linalg.norm(gravity))
    down = gravity / size if size else -np.eye(setup.system.dimension)[setup.system.vertical_axis]
    return _larger(None, (motion.positions - motion.positions[0]) @ down, motion.times)


def _plain(values: Array) -> Any:
    """Lists of numbers; None for what is no number: JSON has no word for it."""
    if np.isfinite(values).all():
        return values.tolist()
    plain = values.astype(object)
    plain[~np.isfinite(values)] = None
    return plain.tolist()
