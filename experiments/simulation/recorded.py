"""Trajectories that other programs have recorded, as files: to be identified without running anything.

CSV with the columns that `springlab simulate` writes, time [s], mass, x, y, ... [m], vx, vy, ... [m/s], a row for every
mass at every step; or NPZ with the arrays time_s, positions_m and velocities_m_s. Velocities may be left out.
"""

from __future__ import annotations

import csv
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from zipfile import BadZipFile, is_zipfile

import numpy as np

from experiments.simulation.files import AXES
from reference.changes import Change
from reference.errors import InputError
from reference.identification import Identification, identify_all
from reference.outcome import Outcome, outcome_of
from reference.scenes import Setup
from reference.state import Array, State, Trajectory
from reference.stepper import Stepper
from reference.system import MassSpringSystem

#: What may be a recording's name.
SUFFIXES = (".csv", ".npz")

#: Steps may differ from dt by this part of it: times are written with few figures.
UNEVEN = 1e-3

#: Along an axis that a scene has not positions may differ by this part of the others' extent: single precision's noise,
#: which changes lengths by its square only.
FLAT = 1e-6


@dataclass(frozen=True)
class Recording:
    """A recording as a stepper that cannot be run: `reference.stepper.Stepper`."""

    name: str
    kind: str = "recorded"
    version: str | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """It was run already."""
        return Outcome("unsupported", "a recording cannot be run")


def is_recording(word: str) -> bool:
    """Whether a stepper's name is a recording's file."""
    return word.endswith(SUFFIXES)


def identify_recording(file: Path, setup: Setup, dt: float | None) -> Identification:
    """Which scheme made a recording of a scene, begun where the recording begins.

    Args:
        dt: the step [s], as it was given; left out, what the file's times say.

    Raises:
        InputError: where the file cannot be read, or is no recording of this scene at this dt.
    """
    trajectory = read(file, setup.system)
    step = float(np.diff(trajectory.times).mean())
    if np.abs(np.diff(trajectory.times) - step).max() > UNEVEN * step:
        raise InputError(f"{file}: its times are not even: expected a row for every mass at every step")
    if dt is not None and abs(dt - step) > UNEVEN * dt:
        raise InputError(f"{file}: its steps are {step:.6g} s: expected --dt {dt:g} s, or that left out")
    step = dt if dt is not None else round(step, 12)
    times = np.asarray(step * np.arange(len(trajectory)), dtype=np.float64)
    run = Trajectory(times, trajectory.positions, trajectory.velocities)
    start = State(
        0.0, run.positions[0], np.where(np.isnan(run.velocities[0]), setup.system.velocities, run.velocities[0])
    )
    system = setup.system.at(start)
    run = replace(run, velocities=np.concatenate([start.velocities[None], run.velocities[1:]]))
    stepper: Stepper = Recording(file.name)
    outcome = outcome_of(system, run, setup.changes)
    (found,) = identify_all([(stepper, outcome)], system, step, len(run) - 1, setup.changes).each
    return found


def read(file: Path, system: MassSpringSystem) -> Trajectory:
    """The trajectory of a system's masses in a file; velocities that it does not tell are not numbers.

    Raises:
        InputError: naming the file and what is wrong with it.
    """
    try:
        found = _of_csv(file, system) if file.suffix == ".csv" else _of_npz(file)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: expected a file that can be read: {getattr(error, 'strerror', error)}") from None
    n, d = system.positions.shape
    if found.positions.shape[1:] != (n, d):
        got = found.positions.shape[1:]
        raise InputError(f"{file}: it has {got[0]} masses in {got[1]} dimensions: expected the scene's {n} in {d}")
    if len(found) < 3:
        raise InputError(f"{file}: it has {len(found)} times: expected three at least, the start and two steps")
    if not np.isfinite(found.positions[0]).all():
        raise InputError(f"{file}: it begins with what is not a number")
    return found


def _of_csv(file: Path, system: MassSpringSystem) -> Trajectory:
    axes = AXES[: system.dimension]
    with file.open(newline="", encoding="utf-8-sig") as open_file:
        rows = list(csv.reader(open_file))
    header = [name.strip().partition(" ")[0] for name in rows[0]] if rows else []
    needed = ["time", "mass", *axes]
    for name in needed:
        if name not in header:
            raise InputError(f"{file}: its first row has no column {name!r}: expected {', '.join(needed)}, vx, ...")
    told = all(f"v{axis}" in header for axis in axes)
    columns = [header.index(name) for name in (*needed, *(f"v{axis}" for axis in axes if told))]
    numbers = []
    for line, row in enumerate(rows[1:], start=2):
        try:
            numbers.append([float(row[column]) for column in columns])
        except (ValueError, IndexError):
            raise InputError(f"{file}, line {line}: expected {len(columns)} numbers: {','.join(row)[:60]}") from None
    table = np.array(numbers).reshape(-1, len(columns))
    n, d = system.positions.shape
    if len(table) % n or (table[:, 1].reshape(-1, n) != np.arange(n)).any():
        raise InputError(f"{file}: expected rows for masses 0 to {n - 1} at every time, in this order")
    frames = table.reshape(-1, n, len(columns))
    positions = frames[:, :, 2 : 2 + d]
    _require_no_other_axis(file, header, rows[1:], positions)
    velocities = frames[:, :, 2 + d :] if told else np.full_like(positions, np.nan)
    return Trajectory(frames[:, 0, 0], positions, velocities)


def _require_no_other_axis(file: Path, header: list[str], rows: Sequence[Sequence[str]], positions: Array) -> None:
    """Refuse positions that differ along an axis that the scene has not; where they are the same, it is left out."""
    axes = AXES[: positions.shape[-1]]
    for axis in AXES[len(axes) :]:
        if axis in header:
            try:
                extent = float(np.ptp([float(row[header.index(axis)]) for row in rows]))
            except (ValueError, IndexError):
                continue  # a column without numbers is no axis
            if extent > FLAT * np.ptp(positions, axis=(0, 1)).max():
                has = ", ".join(axes)
                raise InputError(f"{file}: its positions differ along {axis}: expected the scene's axes, {has}, only")


def _of_npz(file: Path) -> Trajectory:
    if file.is_file() and not is_zipfile(file):
        raise InputError(f"{file}: expected an NPZ file, as numpy.savez writes it")
    try:
        with np.load(file, allow_pickle=False) as arrays:
            times, positions = _numbers(arrays["time_s"]), _numbers(arrays["positions_m"])
            told = "velocities_m_s" in arrays
            velocities = _numbers(arrays["velocities_m_s"]) if told else np.full_like(positions, np.nan)
            return Trajectory(times, positions, velocities)
    except KeyError as error:
        raise InputError(f"{file}: {error.args[0]}: expected time_s, positions_m, velocities_m_s") from None
    except (ValueError, EOFError, BadZipFile, zlib.error) as error:
        raise InputError(f"{file}: expected an NPZ file of arrays of numbers: {error}") from None


def _numbers(array: Array) -> Array:
    if np.iscomplexobj(array) or not np.ndim(array):
        raise ValueError(f"one holds {'complex numbers' if np.ndim(array) else 'a single one'}")
    return np.asarray(array, dtype=float)
