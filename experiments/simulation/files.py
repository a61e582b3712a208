"""A motion as files that other programs read: CSV tables, NumPy arrays, a time series for ParaView."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from experiments.simulation.simulation import Motion
from experiments.simulation.spring_state import energies, spring_frames
from reference.scenes import Setup
from reference.state import Array
from reference.system import MassSpringSystem

#: Axes, as columns and arrays have them.
AXES = "xyz"

#: What the arrays of an NPZ file hold, by key.
NPZ_KEYS = {
    "time_s": "of every frame, shape (m,)",
    "positions_m": "shape (m, n, d)",
    "velocities_m_s": "shape (m, n, d)",
    "spring_forces_n": "tension positive, shape (m, s); not there where rods stand for springs",
    "stretch_m": "length less rest length, shape (m, s)",
    "energy_kinetic_j": "shape (m,); likewise energy_elastic_j, energy_gravitational_j and energy_total_j",
    "springs": "the two masses each spring joins, shape (s, 2)",
    "masses_kg": "shape (n,)",
    "fixed": "which masses never move, shape (n,)",
}


def frames_of(motion: Motion, every: int) -> list[int]:
    """Every so many steps, from the first on, and the last."""
    last = len(motion.trajectory) - 1
    return sorted({*range(0, last + 1, every), last})


def write_masses(file: Path, setup: Setup, motion: Motion, frames: Sequence[int]) -> None:
    """A row for every mass at every time: time [s], mass, x, y, ... [m], vx, vy, ... [m/s]."""
    axes = AXES[: setup.system.dimension]
    columns = ["time", "mass", *axes, *(f"v{axis}" for axis in axes)]
    trajectory = motion.trajectory
    with _table(file, columns) as write:
        for frame in frames:
            rows = np.hstack([trajectory.positions[frame], trajectory.velocities[frame]]).tolist()
            time = float(trajectory.times[frame])
            write((time, mass, *row) for mass, row in enumerate(rows))


def write_springs(file: Path, setup: Setup, motion: Motion, frames: Sequence[int]) -> None:
    """A row for every spring at every time: time [s], spring, force [N], tension positive, stretch [m]."""
    times = motion.trajectory.times[list(frames)]
    with _table(file, ["time", "spring", "force", "stretch"]) as write:
        for part in spring_frames(motion.setup, motion.trajectory, frames):
            for i, (forces, stretches) in enumerate(zip(part.force.tolist(), part.stretch.tolist(), strict=True)):
                time = float(times[part.frames.start + i])
                known = forces if motion.forces is not None else [""] * len(forces)
                write((time, j, f, s) for j, (f, s) in enumerate(zip(known, stretches, strict=True)))


@contextmanager
def _table(file: Path, columns: Sequence[str]) -> Iterator[Any]:
    with file.open("w", newline="", encoding="utf-8") as open_file:
        writer = csv.writer(open_file)
        writer.writerow(columns)
        yield writer.writerows


def write_arrays(file: Path, setup: Setup, motion: Motion, frames: Sequence[int]) -> None:
    """A NumPy file with the arrays of NPZ_KEYS."""
    trajectory = motion.trajectory.frames(list(frames))
    springs = list(spring_frames(motion.setup, motion.trajectory, frames))
    arrays: dict[str, Any] = {
        "time_s": trajectory.times,
        "positions_m": trajectory.positions,
        "velocities_m_s": trajectory.velocities,
        "stretch_m": np.concatenate([part.stretch for part in springs]),
        "springs": setup.system.springs,
        "masses_kg": setup.system.masses,
        "fixed": setup.system.fixed,
    }
    if motion.forces is not None:
        arrays["spring_forces_n"] = np.concatenate([part.force for part in springs])
    for name, values in energies(motion.setup, motion.trajectory, frames).items():
        arrays[f"energy_{name}_j"] = values
    with file.open("wb") as open_file:
        np.savez(open_file, **arrays)


def write_time_series(file: Path, setup: Setup, motion: Motion, frames: Sequence[int]) -> None:
    """What ParaView opens: FILE.pvd, which names a VTU file for every time in a folder beside it.

    Points are masses, with their velocities [m/s]; lines are springs, with force [N] and stretch [m].
    """
    import meshio

    folder = file.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    parts = []
    for part in spring_frames(motion.setup, motion.trajectory, frames):
        for i, frame in zip(part.frames, frames[part.frames.start : part.frames.stop], strict=True):
            data: dict[str, Any] = {"stretch": [part.stretch[i - part.frames.start]]}
            if motion.forces is not None:
                data["force"] = [part.force[i - part.frames.start]]
            mesh = meshio.Mesh(
                _in_space(motion.trajectory.positions[frame]),
                [("line", setup.system.springs)],
                point_data={"velocity": _in_space(motion.trajectory.velocities[frame])},
                cell_data=data,
            )
            name = f"{folder.name}/{frame:08d}.vtu"
            meshio.write(file.parent / name, mesh, binary=True)
            time = float(motion.trajectory.times[frame])
            parts.append(f'<DataSet timestep="{time!r}" part="0" file={quoteattr(name)}/>')
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">']
    file.write_text("\n".join([*lines, "<Collection>", *parts, "</Collection>", "</VTKFile>", ""]), encoding="utf-8")


def _in_space(vectors: Array) -> Array:
    """With as many zeros as make three coordinates; along a line the one there is is the height."""
    if vectors.shape[1] == 1:
        return np.pad(vectors, ((0, 0), (1, 1)))
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def rows_of(system: MassSpringSystem, frames: Sequence[int]) -> int:
    """How many rows both tables have together."""
    return len(frames) * (len(system.masses) + len(system.springs))
