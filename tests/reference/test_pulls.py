"""Constant forces on masses: sag, step responses and driven swings in closed form, and who can step them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.engine import registry, version
from experiments.runs.steppers import find_steppers
from reference.changes import Change
from reference.compiled.kernels import advance
from reference.conserved import energies
from reference.drives import Ramp, Sine
from reference.errors import InputError, SolverError, Unsupported
from reference.files.scene_file import load
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.exact import exact
from tests.wrong import heun_without_half

MASS, STIFFNESS, FORCE = 0.5, 200.0, 3.0
OMEGA = np.sqrt(STIFFNESS / MASS)


def on_wall(**more: object) -> MassSpringSystem:
    """A mass on a spring along a line, at rest, without weight."""
    system = MassSpringSystem(
        positions=np.array([[0.0], [1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(MASS),
        rest_lengths=np.array(1.0),
        stiffness=np.array(STIFFNESS),
        gravity=np.zeros(1),
        fixed=np.array([True, False]),
    )
    return replace(system, **more)  # type: ignore[arg-type]


def check(found: Array, times: Array, true: Callable[[Array], Array], within: float) -> None:
    """A mass is where it should be, to a part of its largest displacement."""
    expected = true(times)
    assert np.abs(found[:, 1, 0] - 1.0 - expected).max() < within * np.abs(expected).max()


def under_a_step(times: Array) -> Array:
    """X = F/k (1 - cos w t)."""
    return np.asarray(FORCE / STIFFNESS * (1 - np.cos(OMEGA * times)))


def test_a_mass_under_a_step_force_swings_about_its_sag() -> None:
    """F/k (1 - cos w t): the true motion to 1e-10; RK4's to (w h)^4 t w / 120 = 1e-8; with its energy, -F x in it.

    The same where the force comes on the fly, and shown to fail of a wrong scheme.
    """
    pulled, plain, on_the_fly = on_wall(pulls=np.array([[0.0], [FORCE]])), on_wall(), [Change(0.0, "pull.1.x", FORCE)]
    for run in (exact(pulled, 1e-3, 400), exact(plain, 1e-3, 400, on_the_fly)):
        check(run.positions, run.times, under_a_step, 1e-10)
    rk4 = find("rk4")
    runs = [simulate(pulled, rk4, 1e-3, 0.4), simulate(plain, rk4, 1e-3, 0.4, on_the_fly)]
    for run in runs:
        check(run.positions, run.times, under_a_step, 1e-7)
    assert np.ptp(energies(pulled, runs[0])) < 1e-8 * FORCE**2 / STIFFNESS
    assert (runs[0].positions == runs[1].positions).all()
    wrong = simulate(pulled, heun_without_half, 1e-3, 0.4)
    with pytest.raises(AssertionError):  # shown to fail
        check(wrong.positions, wrong.times, under_a_step, 1e-3)


@pytest.mark.rotating(2, in_turn=True)
def test_a_sine_pull_drives_as_the_closed_form_has_it() -> None:
    """From rest x = F/m (sin W t - W/w sin w t) / (w^2 - W^2); the force is held through a step at its middle: h^2.

    To (W h)^2 / 24 + (w h)^2 / 24, below 1e-5 of the swing at h = 2e-4 s; another frequency is told apart.
    """
    frequency, dt, duration = 1.7, 2e-4, 1.0

    def driven(times: Array, hertz: float = frequency) -> Array:
        w = 2 * np.pi * hertz
        swing = np.sin(w * times) - w / OMEGA * np.sin(OMEGA * times)
        return np.asarray(FORCE / MASS * swing / (OMEGA**2 - w**2))

    system = on_wall()
    changes = Sine("pull.1.x", 0.0, FORCE, frequency).changes(system, dt, duration)
    run = simulate(system, find("rk4"), dt, duration, changes)
    check(run.positions, run.times, driven, 1e-5)
    with pytest.raises(AssertionError):  # shown to fail
        check(run.positions, run.times, lambda times: driven(times, 1.8), 1e-3)


@pytest.mark.rotating(2, in_turn=True)
def test_a_slow_ramp_ends_at_the_sag() -> None:
    """A ramp over whole periods of a spring leaves nothing swinging: F/k at its end, at rest (to h^2 of the period)."""
    period, system = 2 * np.pi / OMEGA, on_wall()
    changes = Ramp("pull.1.x", 0.0, 2 * period, FORCE).changes(system, period / 1000, 3 * period)
    run = simulate(system, find("rk4"), period / 1000, 3 * period, changes)
    late = run.positions[2001:, 1, 0] - 1.0
    assert late == pytest.approx(np.full(len(late), FORCE / STIFFNESS), rel=1e-4)


def test_a_pull_moves_the_rest_and_nothing_else() -> None:
    """Sag F/k; a string pulled sideways hangs along m g + F; the stiffness about the rest is that of the springs."""
    rest = spring_equilibrium(on_wall(pulls=np.array([[0.0], [FORCE]])))
    assert rest.state.positions[1, 0] - 1.0 == pytest.approx(FORCE / STIFFNESS, rel=1e-12)
    assert rest.linear is not None
    assert rest.linear.scaled_stiffness.toarray() == pytest.approx(np.array([[STIFFNESS / MASS]]))
    spring = find_scene("spring").system({"mass": 0.5, "stiffness": 200.0})
    aside = np.array([[0.0, 0.0], [4.0, 0.0]])
    there = spring_equilibrium(replace(spring, pulls=aside)).state.positions
    load = 0.5 * spring.gravity + aside[1]
    size = np.linalg.norm(load)
    expected = (spring.rest_lengths[0] + size / 200.0) * load / size
    assert there[1] - there[0] == pytest.approx(expected, rel=1e-9)


def test_what_nothing_holds_is_at_rest_in_the_frame_that_is_pulled() -> None:
    """Two masses and a spring, pulled at one: both accelerate by F / 2m, and the spring carries F / 2."""
    free = on_wall(fixed=np.zeros(2, dtype=bool), pulls=np.array([[0.0], [FORCE]]))
    rest = spring_equilibrium(free).state.positions
    assert np.diff(rest[:, 0]) - 1.0 == pytest.approx([FORCE / 2 / STIFFNESS], rel=1e-9)
    with pytest.raises(SolverError, match="pulled"):
        spring_equilibrium(replace(free, drag=0.1))


@pytest.mark.parametrize(
    ("name", "scheme"),
    [("pymunk_springs", "drift_kick"), ("mujoco_tendons", "kick_drift"), ("exudyn_springs", "rk4")],
)
@pytest.mark.parametrize("scene", ["string", "oscillator"])
def test_engines_pull_as_their_schemes_do(name: str, scheme: str, scene: str) -> None:
    """To rounding, 1e-12 of the size: from the start, on the fly, and until it is let go."""
    system = find_scene(scene).system({})
    pulls = np.zeros_like(system.positions)
    pulls[-1] = 0.3
    pulled, last = replace(system, pulls=pulls), len(pulls) - 1
    changes = (Change(0.02, f"pull.{last}.x", -0.2), Change(0.04, f"pull.{last}.x", 0.0))
    runs = [stepper.run(pulled, 1e-3, 60, changes).trajectory for stepper in find_steppers([name, scheme])]
    plain = stepper_named(scheme).run(system, 1e-3, 60).trajectory
    assert runs[0] is not None
    assert runs[1] is not None
    assert plain is not None
    assert runs[0].distance(runs[1]).max() < 1e-12 * system.scale
    assert runs[0].distance(plain).max() > 1e-5


@pytest.mark.parametrize(
    "name", ["bullet_softbody", "mujoco_rope", "rope_kick_drift", "pendulum_heun", "lecture_heun_loops"]
)
def test_what_cannot_pull_says_so(name: str) -> None:
    """Engines by their capability, rods and listings in their words; from the start, and on the fly."""
    string = find_scene("string").system({"masses": 2})
    pulled = string.with_parameter("pull.2.x", 0.1)
    if name in registry() and version(find_engine(name)) is None:
        pytest.skip(f"{name} is not installed")
    (stepper,) = find_steppers([name])
    for system, changes in ((pulled, ()), (string, (Change(0.002, "pull.2.x", 0.1),))):
        outcome = stepper.run(system, 1e-3, 4, changes)
        assert (outcome.ending, "pull" in outcome.reason) == ("unsupported", True), outcome.reason


def test_compiled_loops_leave_it_to_the_scheme_as_written() -> None:
    """The kernel refuses; a scheme in place gives way to its function."""
    string = find_scene("string").system({"masses": 250}).with_parameter("pull.100.y", 1.0)
    with pytest.raises(Unsupported, match="pulls"):
        advance(string, find("heun"), 1e-3, 1)
    run = simulate(string, find("euler_in_place"), 1e-3, 1e-3)
    plain = simulate(replace(string, pulls=np.zeros(1)), find("euler_in_place"), 1e-3, 1e-3)
    assert (run.velocities[-1] != plain.velocities[-1]).any(axis=1).nonzero()[0].tolist()[0] == 100


def test_a_scene_file_has_pulls(tmp_path: Path) -> None:
    """Added up by mass; a wrong mass, and a wrong number of numbers, are named."""
    file = tmp_path / "pulled.toml"
    words = 'scene = "string"\n[[pulls]]\nmass = 3\nforce = [0, -2]\n[[pulls]]\nmass = 3\nforce = [1, 0]\n'
    file.write_text(words)
    system = load(file, {}).system
    assert system.pulls[3].tolist() == [1.0, -2.0]
    assert np.count_nonzero(system.pulls) == 2
    assert MassSpringSystem(**system.to_dict()).to_dict() == system.to_dict()
    for old, new, said in (("mass = 3", "mass = 99", r"pulls\[0\].mass = 99"), ("[0, -2]", "[2]", "force has 1")):
        file.write_text(words.replace(old, new, 1))
        with pytest.raises(InputError, match=said):
            load(file, {})


@pytest.mark.parametrize("name", ["pull", "pull.1", "pull.11.x", "pull.1.z", "pull.x.1", "pull.-1.x", "pull.1.xy"])
def test_a_pull_that_names_nothing_is_refused(name: str) -> None:
    """By its name, with what was expected."""
    with pytest.raises(InputError, match=r"expected pull\.MASS\.AXIS"):
        find_scene("string").system({}).with_parameter(name, 1.0)
