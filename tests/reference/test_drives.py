"""Parameters that go and swing, masses that are held and let go: against closed forms, in schemes and engines."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from engines.process.isolation import run_engine
from experiments.runs.steppers import find_steppers
from reference.changes import Change, Driven
from reference.drives import Ramp, Sine
from reference.errors import InputError
from reference.files.setup import setup_for
from reference.identification import identify_all
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from tests.report.commands.terminal import springlab

#: One mass that nothing but gravity moves, of which a change is seen at once.
FREE = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0]]),
    springs=np.array([[0, 1]]),
    masses=np.ones(2),
    rest_lengths=np.ones(1),
    stiffness=np.zeros(1),
    fixed=np.array([True, False]),
)


def velocity_after(drive: Ramp | Sine, dt: float, duration: float) -> float:
    """Of the free mass, downwards [m/s]: the sum of its weight over steps."""
    changes = drive.changes(FREE, dt, duration)
    motion = simulate(FREE, find("kick_drift"), dt, duration, changes)
    return float(-motion.velocities[-1, 1, 1])


@pytest.mark.parametrize(
    ("drive", "fallen"),
    [
        (Ramp("gravity", 0.2, 0.6, 1.0), lambda g: 0.2 * g + 0.4 * (g + 1) / 2 + 0.4 * 1.0),
        (Sine("gravity", 0.0, 3.0, 1.25), lambda g: g + 3.0 * (1 - np.cos(2.5 * np.pi)) / (2.5 * np.pi)),
        (Sine("gravity", 0.4, 3.0, 1.25), lambda g: g + 3.0 * (1 - np.cos(1.5 * np.pi)) / (2.5 * np.pi)),
    ],
)
def test_what_falls_has_gathered_the_integral(drive: Ramp | Sine, fallen: Callable[[float], float]) -> None:
    """In 1 s, from g = 9.81 m/s^2: the midpoints of steps sum to it to the order dt^2, f^2 dt^2 here 1e-5."""
    assert velocity_after(drive, 1e-3, 1.0) == pytest.approx(fallen(9.81), abs=2e-5)
    assert velocity_after(drive, 1e-3, 1.0) != pytest.approx(9.81, abs=0.1)


def test_a_ramp_of_stiffness_is_of_every_spring() -> None:
    """Each from its own to the one value; nothing before and after."""
    system = setup_for("string", settings={"masses": "2", "stiffness": "100,200"}).system
    changes = Ramp("stiffness", 0.1, 0.2, 300.0).changes(system, 0.01, 0.5)
    assert [round(change.time, 9) for change in changes] == pytest.approx([0.01 * i for i in range(10, 21)])
    assert changes[0].value == pytest.approx((110.0, 205.0))
    assert changes[-1].value == (300.0, 300.0)


def test_a_mass_that_is_held_stays_and_falls_from_rest_when_released() -> None:
    """Held at 0.3 s, let go at 0.5 s: after 0.2 s more it has fallen g t^2 / 2; RK4 is exact there."""
    changes = (Change(0.3, "hold", 1), Change(0.5, "release", 1))
    motion = simulate(FREE, find("rk4"), 0.01, 0.7, changes)
    held = -9.81 * 0.3**2 / 2
    assert motion.positions[30:51, 1, 1] == pytest.approx(held)
    assert motion.velocities[50, 1, 1] == 0.0
    assert motion.positions[-1, 1, 1] == pytest.approx(held - 9.81 * 0.2**2 / 2)
    assert motion.positions[0, 0] == pytest.approx(motion.positions[-1, 0])
    np.testing.assert_allclose(exact(FREE, 0.01, 70, changes).positions, motion.positions, atol=1e-10)
    wrong = simulate(FREE, find("euler"), 0.01, 0.7, changes)  # shown to fail: a first-order step falls another way
    assert wrong.positions[-1, 1, 1] != pytest.approx(held - 9.81 * 0.2**2 / 2, rel=1e-3)


@pytest.mark.parametrize("name", ["mujoco_tendons", "pymunk_springs"])
def test_engines_hold_and_release_as_their_schemes_do(name: str) -> None:
    """A string let go at its upper end, one mass held a little later: identified to rounding all the way."""
    changes = (Change(0.1, "release", 0), Change(0.15, "hold", (5, 6)))
    setup = setup_for("string", dt=1e-3, duration=0.2, changes=changes)
    (stepper,) = find_steppers([name])
    outcome = run_engine(stepper.engine, setup.system, setup.dt, setup.steps, setup.changes)  # type: ignore[attr-defined]
    assert outcome.trajectory is not None
    assert outcome.trajectory.positions[-1, 0, 1] < -0.04
    found = identify_all([(stepper, outcome)], setup.system, setup.dt, setup.steps, setup.changes).each[0]
    assert found.identified_as in ("kick_drift", "drift_kick")
    assert found.error < 1e-13


def test_rods_are_not_let_go() -> None:
    """A pendulum, a cable: unsupported, with the reason."""
    changes = (Change(0.1, "release", 0),)
    setup = setup_for("string", duration=0.2, changes=changes)
    for stepper in find_steppers(["pendulum_rk4", "mujoco_cable"]):
        outcome = stepper.run(setup.system, setup.dt, setup.steps, setup.changes)
        assert outcome.ending == "unsupported"
        assert outcome.reason


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--change", "0.1:release=11"), "release = 11: expected a mass from 0 to 10"),
        (("--change", "0.1:hold=0.5"), "hold = 0.5: expected a mass from 0 to 10"),
        (("--change", "0.1:relaese=0"), "did you mean 'release'"),
        (("--ramp", "0.3:0.1:damping=1"), "expected 0 <= begin < end"),
        (("--ramp", "0.1:0.3:damping"), "expected BEGIN:END:KEY=VALUE"),
        (("--ramp", "0.1:0.3:dampng=1"), "did you mean 'damping'"),
        (("--ramp", "0.1:0.3:stiffness=-1"), "stiffness = -1: expected a number >= 0"),
        (("--sine", "0:drag=1@0"), "at 0 Hz: expected"),
        (("--sine", "0:drag=1"), "expected BEGIN:KEY=AMPLITUDE@FREQUENCY"),
        (("--sine", "0:damping=1@5"), "damping"),
        (("--sine", "0:drag=0.1@5", "--change", "0.1:drag=0"), "drag is driven, and changed besides"),
        (("--sine", "0:drag=0.1@5", "--ramp", "0:1:drag=0"), "drag is driven 2 times"),
    ],
)
def test_what_makes_no_sense_is_told(words: tuple[str, ...], why: str) -> None:
    """One line, exit code 2; a sine that would make a damping negative, too."""
    said = springlab("simulate", "string", *words)
    assert (said.code, said.err.count("\n")) == (2, 1)
    assert why in said.err


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf, -1.0])
def test_times_that_are_no_finite_number_are_refused(wrong: float) -> None:
    """Each number of a drive but those that may be below zero; and a ramp that ends as it begins, a sine of 0 Hz."""
    drives = [
        lambda: Ramp("damping", wrong, 0.3, 1.0),
        lambda: Ramp("damping", 0.0, wrong, 1.0),
        lambda: Sine("drag", wrong, 1.0, 5.0),
        lambda: Sine("drag", 0.0, 1.0, wrong),
        lambda: Ramp("damping", 0.3, 0.3, 1.0),
        lambda: Sine("drag", 0.0, 1.0, 0.0),
        *([] if np.isfinite(wrong) else [lambda: Sine("drag", 0.0, wrong, 5.0)]),
    ]
    for drive in drives:
        with pytest.raises(InputError, match="expected"):
            drive()
    assert Ramp("damping", 0.0, 0.3, -1.0).begin == Sine("drag", 0.0, -1.0, 5.0).begin == 0.0


def test_files_have_them_too(tmp_path: Path) -> None:
    """The same numbers as the command line's."""
    file = tmp_path / "own.toml"
    file.write_text(
        'scene = "string"\n[[changes]]\ntime = 0.2\nparameter = "release"\nvalue = [0]\n'
        '[[ramps]]\nparameter = "damping"\nbegin = 0.1\nend = 0.3\nvalue = 0.5\n'
        '[[sines]]\nparameter = "gravity"\namplitude = 1.0\nfrequency = 2.0\n'
    )
    drives = (Ramp("damping", 0.1, 0.3, 0.5), Sine("gravity", 0.0, 1.0, 2.0))
    by_hand = setup_for("string", changes=(Change(0.2, "release", (0,)),), drives=drives)
    assert sorted(setup_for(str(file)).changes, key=repr) == sorted(by_hand.changes, key=repr)
    file.write_text(file.read_text() + '[[changes]]\ntime = 0.2\nparameter = "gravity"\nvalue = 1.0\n')
    with pytest.raises(InputError, match="gravity is driven, and changed besides"):
        setup_for(str(file))


def test_ground_moves_where_a_drive_says_so_and_not_where_a_parameter_does() -> None:
    """Among other drives; a ramp of gravity alone leaves the ground where it is."""

    class Shaking(Ramp):
        """Gravity as it is seen from ground that moves."""

        moves_ground = True

    ramp, shaking = Ramp("drag", 0.0, 1.0, 2.0), Shaking("gravity", 0.0, 1.0, 2.0)
    assert not Driven(FREE).ground_moves
    assert not Driven(FREE, (Ramp("gravity", 0.0, 1.0, 2.0), ramp)).ground_moves
    assert Driven(FREE, (ramp, shaking)).ground_moves


@pytest.mark.parametrize("make", [lambda name: Ramp(name, 0.0, 1.0, 2.0), lambda name: Sine(name, 0.0, 1.0, 2.0)])
def test_what_is_driven_is_a_parameter_or_a_pull(make: Callable[[str], Ramp | Sine]) -> None:
    """Anything else is refused, with a suggestion."""
    for name in ("mass", "gravity", "pull.1.x"):
        assert make(name).parameter == name
    with pytest.raises(InputError, match=r"^unknown parameter 'stifness': did you mean 'stiffness'\?$"):
        make("stifness")
