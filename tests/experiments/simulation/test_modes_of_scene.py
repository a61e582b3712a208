"""Natural modes and forces at rest: against closed forms, by the command, and in runs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from engines.own.stepper import stepper_of
from experiments.runs.steppers import find_steppers
from experiments.simulation.modes_of_scene import modes_of, swings
from reference.files.setup import setup_for
from reference.scenes import Setup
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.modes import natural_modes
from tests.report.commands.terminal import springlab


def test_four_masses_in_a_row() -> None:
    """The first on a wall, m 4 kg, k 16 N/m: w = 2 sqrt(k/m) sin((2 j - 1) pi / 18), 0.695, 2, 3.06 and 3.76 rad/s."""
    settings = ("masses=4", "mass=4", "stiffness=16", "gravity=0")
    said = springlab("modes", "chain", "--json", *(f"--set={word}" for word in settings))
    assert said.code == 0
    document = json.loads(said.out)
    angular = 2 * np.pi * np.array(document["frequencies_hz"])
    j = np.arange(1, 5)
    assert angular == pytest.approx(4 * np.sin((2 * j - 1) * np.pi / 18), rel=1e-12)
    assert angular == pytest.approx([0.695, 2, 3.06, 3.76], abs=6e-3)
    assert document["damping_ratios"] == pytest.approx([0, 0, 0, 0])
    assert {"equilibrium_m", "frequencies_hz", "damping_ratios", "spring_forces_n"} <= set(document)


def test_a_truss_carries_what_the_method_of_joints_says() -> None:
    """A triangle of three bars on a wall, 5 kN at its tip: by joints, the upper bar pulls 5/3 x 5 kN, the lower pushes.

    Bars from (0, 3) and (0, 0) to the tip at (4, 0): the upper one carries P 5/3 in tension, the lower one P 4/3 in
    compression. The bars give way by 1e-5 of their length, which turns them by as little.
    """
    load = 5_000.0
    system = MassSpringSystem(
        positions=np.array([[0.0, 3.0], [0.0, 0.0], [4.0, 0.0]]),
        springs=np.array([[0, 2], [1, 2]]),
        masses=np.array([1.0, 1.0, load / 9.81]),
        rest_lengths=np.array([5.0, 4.0]),
        stiffness=np.full(2, 2e8),
        fixed=np.array([True, True, False]),
    )
    found = modes_of(Setup("bracket", system, 1e-5, 1e-4))
    assert found.forces == pytest.approx([load * 5 / 3, -load * 4 / 3], rel=1e-4)


#: Of a Howe truss of six panels, 4 m wide and 3 m high, with the weight W at every joint, in W, by sections and joints:
#: supports push with 6 W, so that panels carry the shears 5, 3 and 1 W, and diagonals, 3-4-5, 5/3 of them.
HOWE = {
    "bottom chord": [20 / 3, 32 / 3, 12, 12, 32 / 3, 20 / 3],
    "top chord": [-20 / 3, -32 / 3, -32 / 3, -20 / 3],
    "end posts": [-25 / 3, -25 / 3],
    "verticals": [4, 2, 1, 2, 4],
    "diagonals": [-5, -5 / 3, -5 / 3, -5],
    "rocker": [-6],
}


def test_a_howe_truss_carries_what_the_method_of_joints_says() -> None:
    """By one command, W = 10 kN; members so stiff that the truss sags by 1e-6 of itself. A Pratt's carry otherwise."""
    words = ["panels=6", "panel=4", "height=3", "joint_mass=1000", "gravity=10", "axial_stiffness=1e12"]
    found = {}
    for kind in ("howe", "pratt"):
        said = springlab("modes", "bridge", "--json", f"--set=kind={kind}", *(f"--set={word}" for word in words))
        found[kind] = json.loads(said.out)["spring_forces_n"]
    right = 1e4 * np.concatenate(list(HOWE.values()))
    assert found["howe"] == pytest.approx(right, rel=1e-5)
    assert found["pratt"] != pytest.approx(right, rel=1e-1)  # shown to fail


def test_what_angular_springs_carry_is_told(tmp_path: Path) -> None:
    """A beam of two springs, held at its root: the torque there is m g times how far out the tip is; modes and runs."""
    (tmp_path / "beam.toml").write_text(
        "[system]\npositions = [[0, 0], [0.3, 0], [0.6, 0]]\nsprings = [[0, 1], [1, 2]]\nmasses = 0.1\n"
        "stiffness = 1e5\ndamping = 5\ndrag = 0.3\nfixed = [0, 1]\n"
        "[[angular_springs]]\nmasses = [0, 1, 2]\nstiffness = 2.0\n"
    )
    beam = str(tmp_path / "beam.toml")
    at_rest = json.loads(springlab("modes", beam, "--json").out)
    (after,) = json.loads(
        springlab("simulate", beam, "--json", "--stepper=backward_euler", "--dt=0.05", "--duration=8").out
    )["runs"]
    for told, x in ((at_rest, at_rest["equilibrium_m"]), (after, after["positions_m"])):
        out = x[2][0] - 0.3
        assert np.abs(told["torques_n_m"]) == pytest.approx([0.1 * 9.81 * out], rel=1e-6)
        assert np.abs(told["bends_rad"]) == pytest.approx([np.arccos(out / np.hypot(out, x[2][1]))], rel=1e-9)
    shown = springlab("modes", beam).out
    assert "torque [N m]" in shown
    assert "torque [N m]" not in springlab("modes", "spring").out


def test_damping_ratios_are_those_of_one_oscillator() -> None:
    """One mass on one damped spring: zeta = c / (2 sqrt(k m)); with drag beside, (c + Cd) / (2 sqrt(k m))."""
    for damping, drag in ((0.4, 0.0), (0.1, 0.3)):
        setup = setup_for("oscillator", settings={"damping": str(damping), "drag": str(drag)})
        (ratio,) = modes_of(setup).natural.damping_ratios
        assert ratio == pytest.approx((damping + drag) / (2 * np.sqrt(200 * 0.02)), rel=1e-12)


def test_coupled_damping_is_told() -> None:
    """One damped spring among others: damping acts between modes; drag on equal masses acts within them."""
    drag = setup_for("chain", settings={"drag": "0.1"}).system
    assert natural_modes(spring_equilibrium(drag).linear).coupled < 1e-12  # type: ignore[arg-type]
    one = setup_for("chain", settings={"damping": "0.5,0,0,0,0,0,0,0,0,0"}).system
    assert natural_modes(spring_equilibrium(one).linear).coupled > 0.1  # type: ignore[arg-type]


@pytest.mark.parametrize("stiffness", [3e-4, 1.0, 7e8])
def test_what_nothing_resists_has_no_frequency(stiffness: float) -> None:
    """A free triangle, aslant: moved as a whole it swings at exactly 0 Hz, two ways and a turn, however stiff it is."""
    system = MassSpringSystem(
        positions=np.array([[0.1, 0.2], [1.3, 0.5], [0.4, 1.7]]),
        springs=np.array([[0, 1], [1, 2], [2, 0]]),
        masses=np.array([0.3, 0.7, 1.1]),
        rest_lengths=np.linalg.norm(np.array([[1.2, 0.3], [-0.9, 1.2], [-0.3, -1.5]]), axis=1),
        stiffness=np.full(3, stiffness),
        gravity=np.zeros(2),
    )
    linear = spring_equilibrium(system).linear
    assert linear is not None
    frequencies = natural_modes(linear).frequencies
    assert list(frequencies[:3]) == [0, 0, 0]
    assert frequencies[3] > 0.01 * frequencies[-1]


def test_the_slowest_of_a_large_system_are_those_of_all() -> None:
    """By sparse matrices, from below."""
    linear = spring_equilibrium(setup_for("cloth").system).linear
    assert linear is not None
    every, few = natural_modes(linear), natural_modes(linear, 6)
    assert few.frequencies == pytest.approx(every.frequencies[:6], rel=1e-8)


@pytest.mark.parametrize("name", ["euler", "heun", "kick_drift", "rk4", "backward_euler", "velocity_verlet"])
def test_a_swing_is_predicted_as_it_is_measured(name: str) -> None:
    """Of each mode of a chain: numerical frequency and damping, from the step's eigenvalues and from a run.

    They start 1e-5 of the size from rest, in exactly linear springs: what is left is rounding, 1e-11 of the swing.
    """
    modes = modes_of(setup_for("chain", dt=2e-3, settings={"masses": "3"}))
    for swing in swings(modes, find_steppers([name]), lambda _: None):
        assert swing.predicted is not None
        assert swing.measured is not None
        assert swing.measured.frequency == pytest.approx(swing.predicted.frequency, rel=1e-6)
        assert swing.measured.damping_ratio == pytest.approx(swing.predicted.damping_ratio, abs=1e-6)
    coarse = modes_of(setup_for("chain", dt=4e-3, settings={"masses": "3"}))
    other = swings(coarse, find_steppers([name]), lambda _: None)[-1]
    assert other.measured is not None
    assert other.measured.frequency != pytest.approx(swing.measured.frequency, rel=1e-4)


def test_an_engine_is_predicted_as_what_it_is_identified_as() -> None:
    """Pymunk as drift-kick, by whose step it swings as measured; one that is no scheme has the reason, and a run.

    The tolerance of a run from rest: rounding, 1e-11 of the swing, over some tens of steps.
    """

    def damped_twice(a, x, v, dt):  # type: ignore[no-untyped-def]
        v = 0.97 * (v + dt * a(x, v))
        return x + dt * v, v

    modes = modes_of(setup_for("string", dt=2e-3, settings={"masses": "1"}))
    named, unnamed = find_steppers(["pymunk_springs"])[0], stepper_of(damped_twice)
    for swing in swings(modes, [named], lambda _: None):
        assert swing.identified_as == "drift_kick"
        assert swing.reason == ""
        assert swing.predicted is not None
        assert swing.measured is not None
        assert swing.measured.frequency == pytest.approx(swing.predicted.frequency, rel=1e-6)
        assert swing.measured.frequency != pytest.approx(modes.natural.frequencies[swing.mode], rel=1e-6)
    for swing in swings(modes, [unnamed], lambda _: None):
        assert swing.predicted is None
        assert swing.identified_as is None
        assert swing.measured is not None
        assert "not identified" in swing.reason


def test_kick_drift_swings_too_fast_by_the_square_of_its_step() -> None:
    """sin(wd h / 2) = w h / 2, Hairer, Lubich and Wanner, *Geometric Numerical Integration* (2006), I.1.4."""
    modes = modes_of(setup_for("oscillator", dt=5e-3))
    (swing,) = swings(modes, find_steppers(["kick_drift"]), lambda _: None)
    w = 100.0
    assert swing.predicted is not None
    assert 2 * np.pi * swing.predicted.frequency == pytest.approx(2 * np.arcsin(w * 5e-3 / 2) / 5e-3, rel=1e-12)


@pytest.mark.rotating(7)
def test_pictures_and_a_film_of_modes(tmp_path: Path) -> None:
    """In the plane and in space; a film only with a place for it."""
    for scene in ("string", "jello"):
        said = springlab("modes", scene, "--lowest", "3", "--out", str(tmp_path), "--animate")
        assert said.code == 0
        for ending in ("svg", "csv", "gif"):
            assert (tmp_path / f"{scene}-modes.{ending}").stat().st_size > 40
    assert springlab("modes", "string", "--animate").code == 2


def test_where_damping_couples_modes_nothing_is_predicted_beside_a_run() -> None:
    """One damped spring among others: a run has no mode alone, and what one oscillator would do is another quantity."""
    modes = modes_of(setup_for("chain", settings={"masses": "3", "damping": "0.5,0,0"}))
    made = swings(modes, find_steppers(["heun"]), lambda _: None)
    assert {swing.predicted for swing in made} == {None}
    assert all("not predicted: " in swing.reason for swing in made)
