"""A motion's tables and arrays on a string no two of whose numbers are alike: each in its column, at its time."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from experiments.simulation.files import frames_of, write_arrays, write_masses, write_springs, write_time_series
from experiments.simulation.simulation import Motion, simulate_all
from reference.conserved import energy_parts
from reference.scenes import Setup, find
from reference.state import Array
from reference.stepper import stepper_named

SETUP = Setup("string", find("string").system({"masses": 3, "damping": 0.2, "drag": 0.01}), 1e-3, 0.02)


@pytest.fixture(scope="module")
def motion() -> Motion:
    """What the string does under Heun."""
    (run,) = simulate_all(SETUP, [stepper_named("heun")]).runs
    assert run.motion is not None
    return run.motion


def rows_of(file: Path) -> tuple[list[str], Array]:
    """A table's heading and its numbers."""
    head, *rows = csv.reader(file.read_text().splitlines())
    return head, np.array(rows, dtype=float)


def test_the_frames_are_every_so_many_and_the_last(motion: Motion) -> None:
    """Of 21."""
    assert frames_of(motion, 8) == [0, 8, 16, 20]
    assert frames_of(motion, 5) == [0, 5, 10, 15, 20]


def test_the_table_of_masses_has_time_mass_place_and_velocity(motion: Motion, tmp_path: Path) -> None:
    """Mass by mass at each time."""
    write_masses(tmp_path / "masses.csv", SETUP, motion, [3, 20])
    head, rows = rows_of(tmp_path / "masses.csv")
    assert head == ["time", "mass", "x", "y", "vx", "vy"]
    run = motion.trajectory
    expected = [
        [i * 1e-3, mass, *run.positions[i, mass], *run.velocities[i, mass]] for i in (3, 20) for mass in range(4)
    ]
    assert rows == pytest.approx(np.array(expected))


def test_the_table_of_springs_has_time_spring_force_and_stretch(motion: Motion, tmp_path: Path) -> None:
    """Spring by spring at each time: the force k stretch + c rate of stretch, by hand."""
    write_springs(tmp_path / "springs.csv", SETUP, motion, [3, 20])
    head, rows = rows_of(tmp_path / "springs.csv")
    assert head == ["time", "spring", "force", "stretch"]
    expected, system = [], SETUP.system
    for i in (3, 20):
        for j, (a, b) in enumerate(system.springs):
            along, rate = (q[i, b] - q[i, a] for q in (motion.trajectory.positions, motion.trajectory.velocities))
            length = np.linalg.norm(along)
            stretch = length - system.rest_lengths[j]
            force = system.stiffness[j] * stretch + system.damping[j] * (along @ rate) / length
            expected.append([i * 1e-3, j, force, stretch])
    assert rows == pytest.approx(np.array(expected))


def test_arrays_have_energies_and_times_of_the_frames(motion: Motion, tmp_path: Path) -> None:
    """Kinetic, elastic, gravitational and total, of each frame; what is fixed and what is joined."""
    write_arrays(tmp_path / "arrays.npz", SETUP, motion, [3, 20])
    with np.load(tmp_path / "arrays.npz") as arrays:
        assert arrays["time_s"] == pytest.approx([3e-3, 20e-3])
        states = [motion.trajectory.states()[i] for i in (3, 20)]
        for name in ("kinetic", "elastic", "gravitational", "total"):
            expected = [energy_parts(SETUP.system, state)[name] for state in states]
            assert arrays[f"energy_{name}_j"] == pytest.approx(expected)
        assert arrays["positions_m"].shape == (2, 4, 2)
        assert arrays["fixed"].tolist() == [True, False, False, False]
        assert arrays["springs"].tolist() == [[0, 1], [1, 2], [2, 3]]


def test_a_time_series_is_written_anew_and_into_folders_that_are_not_there(motion: Motion, tmp_path: Path) -> None:
    """The same file twice."""
    file = tmp_path / "deep" / "frames.pvd"
    for _ in range(2):
        write_time_series(file, SETUP, motion, [3, 20])
    assert sorted(part.name for part in (tmp_path / "deep" / "frames").iterdir()) == ["00000003.vtu", "00000020.vtu"]
