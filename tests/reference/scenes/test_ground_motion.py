"""Ground that moves: against supports that are really moved, against closed forms, and read from files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from reference.changes import Change
from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.scenes.ground_motion import FrequencySweep, GroundMotion, read_record
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.modes import squared_frequencies

#: A plain sine along both axes.
SHAKING = FrequencySweep(3.0, 3.0, 2.0, 10.0, direction=(0.6, 0.8))


# --- Wrong ones, which every check must be seen to refuse ---


class TurnedRound(GroundMotion):
    """Gravity is g + a."""

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """With the wrong sign."""
        right = super().changes(system, dt, duration)
        return [replace(c, value=tuple(2 * system.gravity - np.array(c.value))) for c in right]


class Early(GroundMotion):
    """Takes the acceleration at the start of the step for all of it."""

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """Half a step late, that is."""
        starts = dt * np.arange(round(duration / dt))
        gravity = system.gravity - self.ground.acceleration(starts)
        return [Change(t, "gravity", g) for t, g in zip(starts.tolist(), gravity.tolist(), strict=True)]


@dataclass(frozen=True)
class SweptTwiceAsFast(FrequencySweep):
    """Its phase is 2 pi f(t) t in place of the integral: the frequency rises twice as fast."""

    def acceleration(self, times: Array) -> Array:
        """The common slip."""
        shaking = self.amplitude * np.sin(2 * np.pi * self.frequency(times) * times)
        return np.outer(shaking, np.array(self.direction) / np.linalg.norm(self.direction))


# --- (a) The frame of the ground ---


def really_moved(system: MassSpringSystem, sine: FrequencySweep, duration: float) -> Array:
    """Where the masses are relative to the ground in the end, (n, d) [m]: supports moved, forces by NumPy, DOP853.

    For a = A sin(w t) from rest the ground is at A/w (t - sin(w t)/w), at the speed A/w (1 - cos(w t)).
    """
    w, n, d = 2 * np.pi * sine.from_frequency, *system.positions.shape
    towards = sine.amplitude / w * np.array(sine.direction)

    def ground(t: float) -> tuple[Array, Array]:
        return towards * (t - np.sin(w * t) / w), towards * (1 - np.cos(w * t))

    def slope(t: float, y: Array) -> Array:
        place, speed = ground(t)
        x, v = y.reshape(2, n, d)
        x, v = (np.where(system.fixed[:, None], held, q) for held, q in ((system.positions + place, x), (speed, v)))
        force = system.masses[:, None] * system.gravity - system.drag * (v - speed)
        for j, (a, b) in enumerate(system.springs):
            along = x[b] - x[a]
            length = np.sqrt(along @ along)
            u = along / length
            pull = system.stiffness[j] * (length - system.rest_lengths[j]) + system.damping[j] * (u @ (v[b] - v[a]))
            force[a] += pull * u
            force[b] -= pull * u
        return np.concatenate([v, np.where(system.fixed[:, None], 0.0, force / system.masses[:, None])], axis=None)

    start = np.concatenate([system.positions, system.velocities], axis=None)
    found = solve_ivp(slope, (0.0, duration), start, "DOP853", rtol=1e-11, atol=1e-13)
    moved = found.y[:, -1].reshape(2, n, d)[0] - ground(duration)[0]
    return np.asarray(np.where(system.fixed[:, None], system.positions, moved))


def check_frame(drive: type[GroundMotion], sine: FrequencySweep = SHAKING) -> None:
    """Three damped masses on a string, in air, for T = 0.5 s: the errors at dt and dt/2 are as 4 to 1, and small.

    Held in the middle of steps the acceleration is off by A w^2 dt^2/24 at most on the average over a step, which moves
    a free mass by T^2/2 of that: 2e-7 m at dt = 1/4096 s, and masses on springs by some of it; three times that are
    allowed. RK4's own error is of the order dt^4.
    """
    system = find_scene("string").system({"masses": 3, "damping": 0.05, "drag": 0.02, "angle": 30.0})
    duration, expected = 0.5, really_moved(system, SHAKING, 0.5)
    errors = []
    for dt in (1 / 2048, 1 / 4096):
        changes = drive(sine).changes(system, dt, duration)
        end = simulate(system, find("rk4"), dt, duration, changes).positions[-1]
        errors.append(np.abs(end - expected).max())
    bound = 2.0 * (2 * np.pi * 3) ** 2 / 4096**2 / 24 * duration**2 / 2
    assert errors[1] < 3 * bound
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.rotating(4, in_turn=True)
def test_seen_from_the_ground_it_is_gravity() -> None:
    """To the second order of the step, with drag and damping, large swings and all."""
    check_frame(GroundMotion)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("wrong", [TurnedRound, Early])
def test_the_frame_fails_on(wrong: type[GroundMotion]) -> None:
    """The other sign; gravity of the start of the step, which is of first order."""
    with pytest.raises(AssertionError):
        check_frame(wrong)


@pytest.mark.rotating(3)
def test_the_frame_fails_on_another_shaking() -> None:
    """Stronger by a thousandth."""
    with pytest.raises(AssertionError):
        check_frame(GroundMotion, replace(SHAKING, amplitude=2.002))


# --- (b) One mass on a spring ---


def duhamel(mass: float, k: float, c: float, ground: FrequencySweep, times: Array) -> Array:
    """How far m x'' + c x' + k x = -m a(t) goes from rest, shape (m,) [m].

    x(t) = -1/w_d times the integral of a(s) exp(-z (t - s)) sin(w_d (t - s)) (Chopra, ch. 4), in closed form for a
    sine: the steady state, and a free vibration that cancels it at the start.
    """
    forcing, w2, damping = 2 * np.pi * ground.from_frequency, k / mass, c / mass
    steady = -ground.amplitude / (w2 - forcing**2 + 1j * damping * forcing)  # of exp(i w t), its imaginary part
    free = np.sqrt(w2 - damping**2 / 4)
    x0, v0 = -steady.imag, -(1j * forcing * steady).imag
    decay = np.exp(-damping / 2 * times)
    cancelling = decay * (x0 * np.cos(free * times) + (v0 + damping / 2 * x0) / free * np.sin(free * times))
    return np.asarray((steady * np.exp(1j * forcing * times)).imag + cancelling)


def test_the_closed_form_is_duhamels_integral() -> None:
    """By quadrature, at a few times, to its own tolerance."""
    for time in (0.1, 0.7, 1.3):

        def integrand(s: float, t: float = time) -> float:
            decay = 0.4 / 0.1 / 2
            free = np.sqrt(40 / 0.1 - decay**2)
            return float(np.exp(-decay * (t - s)) * np.sin(free * (t - s)) / free * -2 * np.sin(2 * np.pi * 3 * s))

        by_hand = duhamel(0.1, 40.0, 0.4, SHAKING, np.array([time]))[0]
        assert quad(integrand, 0, time, epsabs=1e-13)[0] == pytest.approx(by_hand, abs=1e-12)


def check_oscillator(drive: type[GroundMotion], dt: float = 1e-3, damping: float = 0.4) -> None:
    """A hanging mass shaken up and down, for 1.5 s: x(t) is Duhamel's, at every step.

    What a step's constant leaves of a is (s - m) a'(m) + (s - m)^2/2 a'': with the response h to a push, |h| <= 1/w and
    |h'| <= 1, all steps together move the mass by T dt^2 A W/12 (1 + W/(2 w)) at most, W = 2 pi f. RK4's own error,
    T w (w dt)^4/120 of the motion, is 1e-8 of it.
    """
    settings = {"mass": 0.1, "stiffness": 40.0, "damping": damping, "stretch": 0.1 * 9.81 / 40, "drag": 0.0}
    system = find_scene("spring").system(settings)
    ground, duration = replace(SHAKING, direction=(0.0, 1.0)), 1.5
    motion = simulate(system, find("rk4"), dt, duration, drive(ground).changes(system, dt, duration))
    expected = duhamel(0.1, 40.0, 0.4, ground, motion.times)
    forcing, own = 2 * np.pi * 3, 20.0
    bound = duration * dt**2 * 2.0 * forcing / 12 * (1 + forcing / (2 * own)) + 1e-7 * np.abs(expected).max()
    assert np.abs(motion.positions[:, 1, 1] - system.positions[1, 1] - expected).max() <= bound


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("dt", [4e-3, 1e-3, 2.5e-4])
def test_a_shaken_oscillator_goes_as_duhamel_says(dt: float) -> None:
    """The transient and the steady state, near resonance."""
    check_oscillator(GroundMotion, dt)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("wrong", [TurnedRound, Early])
def test_the_oscillator_fails_on(wrong: type[GroundMotion]) -> None:
    """Wrong drives; and another damping, by a hundredth."""
    with pytest.raises(AssertionError):
        check_oscillator(wrong)
    with pytest.raises(AssertionError):
        check_oscillator(GroundMotion, damping=0.404)


# --- (c) Resonance ---


def check_resonance(sweep: type[FrequencySweep], truck: float = 5000.0) -> None:
    """A bridge on rock shaken up and down sways most when the sweep is 2.157 sqrt(beta) past its lowest frequency.

    Without damping the envelope is a Fresnel integral, with its maximum 1.217 of its units (pi/beta)^(1/2) after the
    sweep, whose frequency rises at beta [rad/s^2], has passed (Lewis, *Trans. ASME* 54 (1932)). The largest sway is
    seen to half a period; the next mode, at more than twice the frequency, adds as much again.
    """
    settings = {"on": "rock", "damping": 0.0, "axis": "y", "amplitude": 1e-3}
    system = find_scene("earthquake").system({**settings, "truck": 5000.0})
    lowest = float(np.sqrt(squared_frequencies(system, equilibrium(system))[0]) / (2 * np.pi))
    shaken = find_scene("earthquake").system({**settings, "truck": truck})
    ground = sweep(0.25 * lowest, 1.75 * lowest, 1e-3, 30.0 / lowest, direction=(0.0, 1.0))
    rate = (ground.to_frequency - ground.from_frequency) / ground.duration
    dt = 2e-3
    changes = GroundMotion(ground).changes(shaken, dt, ground.duration)
    motion = simulate(shaken, find("velocity_verlet"), dt, ground.duration, changes)
    sway = motion.positions[:, 3, 1] - shaken.positions[3, 1]
    peak = float(ground.frequency(motion.times)[np.argmax(np.abs(sway))])
    assert peak == pytest.approx(lowest + 2.157 * np.sqrt(2 * np.pi * rate) / (2 * np.pi), abs=rate / lowest)


@pytest.mark.rotating(4, in_turn=True)
def test_a_swept_bridge_resonates_at_its_lowest_frequency() -> None:
    """As theory says, after the delay that theory says."""
    check_resonance(FrequencySweep)


@pytest.mark.rotating(7, in_turn=True)
def test_resonance_fails_on_another_sweep_and_another_bridge() -> None:
    """A frequency that rises twice as fast as it says; a truck of twice the mass."""
    with pytest.raises(AssertionError):
        check_resonance(SweptTwiceAsFast)
    with pytest.raises(AssertionError):
        check_resonance(FrequencySweep, truck=10000.0)


# --- Sweeps ---


@pytest.mark.parametrize("law", ["linear", "exponential"])
def test_the_phase_of_a_sweep_is_the_integral_of_its_frequency(law: Any) -> None:
    """By quadrature; and not for the one swept twice as fast."""
    times = np.linspace(0.05, 1.95, 7)
    for kind, right in ((FrequencySweep, True), (SweptTwiceAsFast, False)):
        sweep = kind(1.0, 8.0, 3.0, 2.0, law)
        turns = [quad(lambda t, s=sweep: s.frequency(np.array(t)), 0, end)[0] for end in times]  # type: ignore[misc]
        expected = 3.0 * np.sin(2 * np.pi * np.array(turns))
        assert np.allclose(sweep.acceleration(times)[:, 0], expected, atol=1e-10) == right
    assert FrequencySweep(1.0, 8.0, 3.0, 2.0, law).frequency(np.array([0.0, 2.0])) == pytest.approx([1.0, 8.0])


def test_a_sweep_of_one_frequency_is_a_sine_by_either_law() -> None:
    """And nothing before and after it."""
    times = np.array([-0.1, 0.1, 0.2, 1.9, 2.1])
    expected = np.array([0.0, *np.sin(2 * np.pi * 1.5 * times[1:4]), 0.0])
    for law in ("linear", "exponential"):
        assert FrequencySweep(1.5, 1.5, 1.0, 2.0, law).acceleration(times)[:, 0] == pytest.approx(expected)  # type: ignore[arg-type]


def test_after_the_motion_gravity_is_the_systems_own() -> None:
    """To the bit, from the first step after it; and the ground moves relative to whatever gravity there is."""
    system = find_scene("string").system({"gravity": 1.6})
    changes = GroundMotion(FrequencySweep(2.0, 2.0, 1.0, 0.1)).changes(system, 0.01, 0.2)
    assert changes[-1] == Change(0.1, "gravity", (0.0, -1.6))
    assert len(changes) == 11
    assert {change.value[1] for change in changes} == {-1.6}  # type: ignore[index]


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("from_frequency", 0.0, "from_frequency = 0: expected a finite number > 0 [Hz]"),
        ("to_frequency", float("inf"), "to_frequency = inf: expected a finite number > 0 [Hz]"),
        ("amplitude", -1.0, "amplitude = -1: expected a finite number >= 0 [m/s^2]"),
        ("duration", float("nan"), "duration = nan: expected a finite number > 0 [s]"),
        ("law", "cubic", "law = 'cubic': expected one of linear, exponential"),
        ("direction", (0.0, 0.0), "direction = [0.0, 0.0]: expected one to three finite numbers, not all zero"),
    ],
)
def test_a_sweep_that_makes_no_sense_is_refused(field: str, value: Any, message: str) -> None:
    """By field, value, and what was expected."""
    with pytest.raises(InputError) as refused:
        replace(SHAKING, **{field: value})
    assert str(refused.value) == message


def test_ground_that_moves_along_more_axes_than_there_are_is_refused() -> None:
    """Three in a plane."""
    drive = GroundMotion(replace(SHAKING, direction=(0.0, 0.0, 1.0)))
    with pytest.raises(InputError, match=r"^the ground moves along 3 axes: expected at most the system's 2$"):
        drive.changes(find_scene("string").system({}), 0.01, 0.1)


# --- Records ---

RECORD = "time [s], x [m/s^2], y [m/s^2]\n0.1, 0, 1\n0.2, 2, 0\n\n0.4, -2, 0.5\n"


def test_a_record_is_followed_along_straight_lines(tmp_path: Path) -> None:
    """In its unit times the scale; still before it and after it."""
    (tmp_path / "r.csv").write_text(RECORD)
    record = read_record(tmp_path / "r.csv", scale=10.0)
    found = record.acceleration(np.array([0.05, 0.1, 0.15, 0.3, 0.4, 0.41]))
    assert found[:, 0] == pytest.approx([0, 0, 10, 0, -20, 0])
    assert found[:, 1] == pytest.approx([0, 10, 5, 2.5, 5, 0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", ", line 1: expected a header, as: time [s], x [m/s^2]"),
        (RECORD.split("\n", 1)[1], ", line 1: expected a header, as: time [s], x [m/s^2]"),
        ("t\n0\n1\n", ", line 1: 1 columns, expected two to four: time, then one for each axis"),
        ("t, x\n0, 1\n", ": 1 lines after the header, expected two or more"),
        ("t, x\n0, 1\n1\n", ", line 3: 1 columns, expected 2 as in the header"),
        ("t, x\n0, 1\n1, up\n", ", line 3, column 'x': ' up', expected a finite number"),
        ("t, x\n0, 1\n1, nan\n", ", line 3, column 'x': ' nan', expected a finite number"),
        ("t, x\n-1, 1\n1, 2\n", ", line 2, column 't': -1, expected a time >= 0 [s]"),
        ("t, x\n0, 1\n1, 2\n1, 3\n", ", line 4, column 't': 1, expected a time later than the line before [s]"),
        ("t, x\n0, 1\n1, 1e308\n", ": scale = 10 makes accelerations that are no finite numbers"),
    ],
)
def test_a_record_that_is_none_is_refused_with_its_place(tmp_path: Path, text: str, message: str) -> None:
    """File, line, column, value, and what was expected."""
    (tmp_path / "r.csv").write_text(text)
    with pytest.raises(InputError) as refused:
        read_record(tmp_path / "r.csv", scale=10.0)
    assert str(refused.value) == f"record {tmp_path / 'r.csv'}{message}"


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    """None there; not of text."""
    with pytest.raises(InputError, match="No such file or directory"):
        read_record(tmp_path / "r.csv")
    (tmp_path / "r.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="expected lines of numbers"):
        read_record(tmp_path / "r.csv")
