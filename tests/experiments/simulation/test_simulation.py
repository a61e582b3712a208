"""What a scene did: against closed forms, as public sheets ask for it; and as files, by readers that are not ours."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import meshio
import numpy as np
import pytest

from experiments.runs.steppers import find_steppers
from experiments.simulation.files import NPZ_KEYS, frames_of
from experiments.simulation.simulation import OF_MOTION, simulate_all
from reference.changes import Change
from reference.conserved import energy, energy_parts
from reference.files.setup import setup_for
from reference.lengths import lengths, lengths_and_rates, spring_lengths
from reference.state import State
from tests.report.commands.terminal import springlab


def simulated(scene: str, *steppers: str, **more: object) -> list[dict[str, object]]:
    """The runs of a scene, as JSON has them."""
    setup = setup_for(scene, **more)  # type: ignore[arg-type]
    document = simulate_all(setup, find_steppers(steppers)).document
    runs: list[dict[str, object]] = json.loads(json.dumps(document))["runs"]
    return runs


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("force", [["--set=gravity=50"], ["--set=gravity=0", "--change=0:pull.1.x=-80"]])
def test_a_sheet_of_exercises_is_answered_by_one_command(force: list[str]) -> None:
    """With m 1.6 kg, k 4000 N/m, c 8 N s/m, F 80 N, from u = -0.08 m at 1 m/s: u(1 s) = 0.01183 m.

    u = F/k + e^(-z w t) (A cos wd t + B sin wd t) with w = 50/s, z = 0.05. As a weight of 80 N, or a
    pull, it hangs on the spring: u is what the mass is below the spring's rest length. RK4's error at
    w dt = 0.0125 is below 1e-6 of 0.1 m.
    """
    words = ["mass=1.6", "stiffness=4000", "damping=8", "stretch=-0.08", "velocity=-1", "rest_length=1"]
    times = ("--dt", "2.5e-4", "--duration", "1")
    said = springlab(
        "simulate", "oscillator", "--stepper=rk4", *times, "--json", *force, *(f"--set={w}" for w in words)
    )
    assert said.code == 0
    document = json.loads(said.out)
    assert list(document)[:3] == ["scene", "dt_s", "duration_s"]
    (run,) = document["runs"]
    u = -run["positions_m"][1][0] - 1.0
    w, z = 50.0, 0.05
    wd = w * np.sqrt(1 - z**2)
    a = -0.08 - 0.02
    b = (1.0 + z * w * a) / wd
    assert u == pytest.approx(0.02 + np.exp(-z * w) * (a * np.cos(wd) + b * np.sin(wd)), abs=2e-7)
    assert u == pytest.approx(0.01183, abs=5e-6)
    said = springlab(
        "simulate", "oscillator", "--stepper=euler", *times, "--json", *force, *(f"--set={w}" for w in words)
    )
    wrong = -json.loads(said.out)["runs"][0]["positions_m"][1][0] - 1.0
    assert wrong != pytest.approx(0.01183, abs=1e-4)  # shown to fail: Euler's step is told apart


def test_a_mass_on_a_tendon_sags_by_its_weight_over_its_stiffness() -> None:
    """With k 1000 N/m, m 1 kg, heavily damped until it is at rest: m g / k = 9.81 mm, and the spring carries m g."""
    settings = {"stiffness": "1000", "mass": "1", "damping": "70", "stretch": "0", "gravity": "9.81"}
    for run in simulated("spring", "mujoco_tendons", "heun", dt=1e-3, duration=2.0, settings=settings):
        assert run["largest_sag_m"] == pytest.approx(9.81e-3, rel=1e-6)
        assert run["spring_forces_n"] == pytest.approx([9.81], rel=1e-9)
        assert run["stretch"] == pytest.approx([9.81e-3], rel=1e-9)


def test_energies_are_those_of_the_state() -> None:
    """Kinetic, elastic and gravitational make the total, and that is `conserved.energy`; kick-drift keeps it."""
    setup = setup_for("string", dt=1e-4, duration=0.2)
    (run,) = simulate_all(setup, find_steppers(["kick_drift"])).runs
    assert run.motion is not None
    parts = run.motion.energy
    assert sum(parts[name] for name in ("kinetic", "elastic", "gravitational")) == pytest.approx(parts["total"])
    assert parts["total"] == energy(setup.system, run.motion.end)
    assert parts["total"] == pytest.approx(run.motion.energy_at_start["total"], abs=1e-3 * parts["kinetic"])
    fast = State(0.0, setup.system.positions, np.ones_like(setup.system.positions))
    moving = energy_parts(setup.system, fast)
    assert moving["kinetic"] == pytest.approx(0.5 * setup.system.masses.sum() * 2)


def test_a_run_that_blows_up_is_told_up_to_there() -> None:
    """When, why, and what was before: all numbers are finite."""
    (run,) = simulated("string", "euler", dt=0.02, duration=2.0)
    assert run["outcome"] == "diverged"
    assert 0 < float(str(run["blew_up_at_s"])) < 2.0
    assert float(str(run["end_s"])) < float(str(run["blew_up_at_s"]))
    assert np.isfinite(np.array(run["positions_m"], dtype=float)).all()


def test_where_a_solver_gives_up_the_table_says_so() -> None:
    """Not that it blew up at an unknown time; below the table stand t and dt. Euler's has the time."""
    said = springlab("simulate", "cloth", "--stepper=backward_euler", "--dt=0.2")
    (row,) = [line for line in said.out.splitlines() if "blew up at" in line]
    assert row.split("[s]")[1].strip() == "no: see below"
    assert "backward Euler found no solution at t = 0 s with dt = 0.2 s" in said.out
    said = springlab("simulate", "string", "--stepper=euler", "--dt=0.02", "--duration=2")
    (row,) = [line for line in said.out.splitlines() if "blew up at" in line]
    assert 0 < float(row.split("[s]")[1]) < 2


def test_what_cannot_run_leaves_nothing() -> None:
    """All keys are there, without values."""
    (run,) = simulated("cloth", "pymunk_springs", duration=0.01)
    assert run["outcome"] == "unsupported"
    assert {run[key] for key in OF_MOTION} == {None}


def test_rods_have_no_spring_forces() -> None:
    """A cable's do not stretch: that is said by nothing in their place."""
    (cable,) = simulated("string", "mujoco_cable", duration=0.05)
    assert (cable["spring_forces_n"], cable["largest_tension_n"]) == (None, None)
    assert len(cable["stretch"]) == 10  # type: ignore[arg-type]


def test_forces_follow_changes_on_the_fly(tmp_path: Path) -> None:
    """With half the stiffness from a time on the force is half that of the same stretch, in tables too."""
    setup = setup_for("spring", dt=1e-3, duration=0.1, changes=(Change(0.05, "stiffness", 100.0),))
    (run,) = simulate_all(setup, find_steppers(["rk4"])).runs
    assert run.motion is not None
    assert run.motion.forces is not None
    assert run.motion.forces == pytest.approx(100.0 * run.motion.stretch)


def test_files_are_read_by_others(tmp_path: Path) -> None:
    """CSV by the standard library, NPZ by NumPy, VTU by meshio: all have the same numbers, those of the run."""
    said = springlab("simulate", "string", "--duration", "0.01", "--every", "4", "--out", str(tmp_path), "--json")
    assert said.code == 0
    (run,) = json.loads(said.out)["runs"]
    frames = [0, 4, 8, 10]
    with (tmp_path / "heun-masses.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["time", "mass", "x", "y", "vx", "vy"]
    assert len(rows) == len(frames) * 11
    assert [[float(row["x"]), float(row["y"])] for row in rows[-11:]] == run["positions_m"]
    with (tmp_path / "heun-springs.csv").open(newline="") as file:
        springs = list(csv.DictReader(file))
    assert list(springs[0]) == ["time", "spring", "force", "stretch"]
    assert [float(row["force"]) for row in springs[-10:]] == run["spring_forces_n"]
    with np.load(tmp_path / "heun-arrays.npz") as arrays:
        assert arrays["time_s"] == pytest.approx([1e-3 * i for i in frames])
        assert arrays["positions_m"][-1].tolist() == run["positions_m"]
        assert arrays["spring_forces_n"][-1].tolist() == run["spring_forces_n"]
        assert arrays["energy_total_j"][-1] == run["energy_j"]["total"]
        told = " ".join(f"{key} {text}" for key, text in NPZ_KEYS.items())
        assert all(key in told for key in arrays)
    meshes = sorted((tmp_path / "heun-frames").iterdir())
    assert len(meshes) == len(frames)
    mesh = meshio.read(meshes[-1])
    assert mesh.points[:, :2].tolist() == run["positions_m"]
    assert mesh.cell_data["force"][0].tolist() == run["spring_forces_n"]
    collection = (tmp_path / "heun-frames.pvd").read_text()
    assert all(f'file="heun-frames/{path.name}"' in collection for path in meshes)


@pytest.mark.rotating(3, in_turn=True)
def test_plots_and_films_are_drawn(tmp_path: Path) -> None:
    """Each that is asked for; a wrong word is one line."""
    words = ("paths", "energy", "forces", "10:y")
    asked = [word for what in words for word in ("--plot", what)]
    said = springlab("simulate", "string", "--duration", "0.02", "--out", str(tmp_path), "--animate", *asked)
    assert said.code == 0
    for name in ("string-paths.svg", "string-energy.svg", "string-forces.svg", "string-mass-10-y.svg", "string.gif"):
        assert (tmp_path / name).stat().st_size > 1000
    for word, why in (("10:z", "AXIS one of x, y"), ("11:y", "a mass from 0 to 10"), ("path", "expected paths")):
        said = springlab("simulate", "string", "--plot", word)
        assert (said.code, said.err.count("\n")) == (2, 1)
        assert why in said.err


def test_the_last_step_is_always_in_the_files() -> None:
    """However many are left out."""
    setup = setup_for("spring", dt=1e-3, duration=0.01)
    (run,) = simulate_all(setup, find_steppers(["heun"])).runs
    assert run.motion is not None
    assert frames_of(run.motion, 3) == [0, 3, 6, 9, 10]
    assert frames_of(run.motion, 100) == [0, 10]


def test_lengths_axis_by_axis_are_lengths() -> None:
    """Against NumPy's norm, of one state and of many."""
    rng = np.random.default_rng(0)
    springs = np.array([[0, 1], [2, 4], [3, 3]])
    for shape in ((5, 3), (7, 5, 2), (4, 5, 1)):
        x = rng.normal(size=shape)
        apart = x[..., springs[:, 1], :] - x[..., springs[:, 0], :]
        np.testing.assert_allclose(spring_lengths(x, springs), np.linalg.norm(apart, axis=-1), rtol=1e-15)
        v = rng.normal(size=shape)
        speeds = v[..., springs[:, 1], :] - v[..., springs[:, 0], :]
        wanted = np.array([True, False, True])
        with np.errstate(invalid="ignore"):
            right = np.nan_to_num(np.where(wanted, (apart * speeds).sum(axis=-1) / np.linalg.norm(apart, axis=-1), 0))
        length, rate = lengths_and_rates(x, v, springs, wanted)
        assert np.array_equal(length, spring_lengths(x, springs))
        np.testing.assert_allclose(rate, right, rtol=1e-13, atol=1e-15)
        np.testing.assert_allclose(lengths(x), np.linalg.norm(x, axis=-1), rtol=1e-15)
