"""The energy experiment: energies by their closed forms, kinds as theory says, and who keeps momentum."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from engines.engine import Engine, demands
from engines.process.isolation import EngineStepper
from experiments.energy import (
    DT,
    DURATION,
    FREE_DURATION,
    PARTS,
    STRING,
    Bench,
    Row,
    bench,
    change,
    energy_errors,
    measure,
    measured_trend,
    result_of,
    rounding,
)
from reference.conserved import angular_momentum, momentum
from reference.motion import Motion
from reference.outcome import first_blown_up_frame
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array, State, Trajectory
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem
from reference.theory.energy_trend import predicted_energy_trend
from tests import wrong
from tests.conformance.doctored import Doctored, Euler
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.reference.systems import IN_PLACE, SOLVED, label

TURNED_SIDEWAYS = wrong.stepped(wrong.sideways, find("kick_drift"))
ONE_SIDED = wrong.stepped(wrong.one_sided, find("kick_drift"))


@pytest.fixture(scope="module")
def on() -> Bench:
    """The experiment's own."""
    return bench()


# --- Energy, in closed form ---

#: |R(i z)|^2 of the schemes whose step multiplies an undamped oscillator's complex amplitude by R(i z), z = dt w: its
#: energy, m w^2 |amplitude|^2 / 2, is multiplied by that (Hairer and Wanner II, IV.2).
AMPLIFICATION: dict[str, Callable[[float], float]] = {
    "euler": lambda z: 1 + z**2,
    "heun": lambda z: 1 + z**4 / 4,
    "rk4": lambda z: 1 - z**6 / 72 + z**8 / 576,
    "backward_euler": lambda z: 1 / (1 + z**2),
    "implicit_midpoint": lambda z: 1.0,
}


def check_energy_of_an_oscillator(scheme: Scheme, name: str) -> None:
    """E(n dt) / E(0) = |R(i dt w)|^2n for one mass on one spring without weight, let go 1 cm from rest; n is 400.

    Steps round the energy by some eps each, 400 of them: 400 eps times 10 is 1e-12.
    """
    system = find_scene("spring").system({"gravity": 0.0, "stiffness": 10.0})
    times, errors = energy_errors(system, simulate(system, scheme, DT, 400 * DT))
    energies = AMPLIFICATION[name](DT * np.sqrt(10.0 / 0.02)) ** (times / DT)
    assert np.abs((1 + errors) / energies - 1).max() < 1e-12


@pytest.mark.parametrize("name", AMPLIFICATION)
def test_energy_of_an_oscillator_is_multiplied_at_each_step(name: str) -> None:
    """What the experiment calls the energy error is that of theory, as a part of the energy there is."""
    check_energy_of_an_oscillator(find(name), name)


@pytest.mark.parametrize(
    ("scheme", "name"),
    [
        (wrong.heun_without_half, "heun"),
        (wrong.rk4_equally_weighted, "rk4"),
        (wrong.explicit_in_place_of_backward, "backward_euler"),
        (find("velocity_verlet"), "implicit_midpoint"),
        (find("heun"), "euler"),
    ],
    ids=label,
)
def test_energy_of_an_oscillator_fails_on_wrong_schemes(scheme: Scheme, name: str) -> None:
    """Each multiplies it by something else, or lets it swing."""
    with pytest.raises(AssertionError):
        check_energy_of_an_oscillator(scheme, name)


def test_energy_after_a_string_is_torn_is_not_counted() -> None:
    """Euler tears the soft string: the last time is the step before that."""
    system = find_scene("string").system(STRING)
    trajectory = catalogued()["euler"].run(system, DT, 2000).trajectory
    assert trajectory is not None
    times, errors = energy_errors(system, trajectory)
    torn = trajectory.times[first_blown_up_frame(system, trajectory)]
    assert times[-1] == pytest.approx(torn - DT)
    assert np.isfinite(errors).all()


def test_the_largest_error_is_that_of_every_step() -> None:
    """An energy that is off in one step alone is seen, whichever step it is."""
    system = find_scene("string").system(STRING)
    trajectory = simulate(system, find("rk4"), DT, 40 * DT)
    for step in (1, 13, 39):
        velocities = trajectory.velocities.copy()
        velocities[step] *= 1.5
        _, errors = energy_errors(system, replace(trajectory, velocities=velocities))
        assert int(np.abs(errors).argmax()) == step


@pytest.mark.parametrize(("name", "largest"), [("velocity_verlet", 0.00397), ("kick_drift", 0.0553)])
def test_the_largest_errors_of_symplectic_schemes(name: str, largest: float) -> None:
    """To three figures, found by looking at every step of 20 s; at one in eight they seem 0.00311 and 0.0515."""
    system = find_scene("string").system(STRING)
    trajectory = simulate(system, find(name), DT, DURATION)
    assert np.abs(energy_errors(system, trajectory)[1]).max() == pytest.approx(largest, rel=2e-3)


# --- Its kind ---


def check_kind(scheme: Scheme, on: Bench, kind: str) -> None:
    """By theory and by measurement the energy of the undamped string is of that kind."""
    row = measure(SchemeStepper(scheme), on)
    assert (row.predicted, row.measured) == (kind, kind)


#: By |R(i z)| above, and for the symplectic ones by HLW IX.8. In place, one mass alone would do as Euler and Heun.
KINDS = {
    "euler": "growing",
    "heun": "growing",
    "rk4": "decaying",
    "backward_euler": "decaying",
    "kick_drift": "bounded",
    "drift_kick": "bounded",
    "velocity_verlet": "bounded",
    "implicit_midpoint": "bounded",
    **{scheme.name: "growing" for scheme in IN_PLACE},
}


@pytest.mark.rotating(9)
@pytest.mark.parametrize("name", KINDS)
def test_energy_is_of_the_kind_that_theory_says(name: str, on: Bench) -> None:
    """Bounded for symplectic schemes; the others gain or lose."""
    check_kind(find(name), on, KINDS[name])


def test_the_energy_of_a_rope_is_bounded(on: Bench) -> None:
    """Its rods lose what they are too long, which is no energy of its swings, and it keeps both momenta."""
    row = measure(catalogued()["rope_kick_drift"], on)
    assert (row.predicted, row.measured) == ("bounded", "bounded")
    assert row.momentum is not None
    assert row.angular_momentum is not None
    assert max(row.momentum, row.angular_momentum) < rounding()


@pytest.mark.parametrize(
    ("scheme", "kind"),
    [
        (wrong.kick_drift_gaining_energy, "bounded"),
        (wrong.verlet_with_one_force, "bounded"),
        (wrong.in_order_of_number, "bounded"),
        (wrong.explicit_in_place_of_backward, "growing"),
        (wrong.heun_without_half, "decaying"),
    ],
    ids=label,
)
def test_the_kind_of_energy_fails_on_wrong_schemes(scheme: Scheme, kind: str, on: Bench) -> None:
    """Even growth by a part in a million a step is told from a swing of some percent."""
    with pytest.raises(AssertionError):
        check_kind(scheme, on, kind)


T = np.linspace(0, 30, 800)
SWING = 0.05 * np.sin(17 * T)


@pytest.mark.parametrize(
    ("errors", "kind"),
    [
        (SWING, "bounded"),
        (np.zeros_like(T), "bounded"),
        (SWING + 0.03 * np.sin(T / 3), "bounded"),
        (SWING + 0.002 * T, "growing"),
        (SWING - 0.002 * T, "decaying"),
        (1e-9 * np.exp(T / 3), "growing"),
        (np.exp(-T) - 1, "decaying"),
        (np.where(T < 15, T, 30 - T), "growing"),
        (T[: 2 * PARTS - 1], None),
    ],
    ids=["swing", "none", "slow", "up", "down", "exponential", "to rest", "beyond all there is", "too short"],
)
def test_kinds_of_made_up_errors(errors: Array, kind: str | None) -> None:
    """A swing, fast or slow, is none; a trend is one, however small against the swing; no more errors, no kind."""
    assert measured_trend(errors) == kind


def in_momenta(system: MassSpringSystem) -> Scheme:
    """Semi-implicit Euler of a pendulum in its angles q and their momenta p = M(q) q', momenta first (HLW VI.3).

    p1 = p0 - dt dH/dq(q0, p1), by iteration; q1 = q0 + dt M(q0)^-1 p1. With w = M(q)^-1 p, and as Lagrange's equations
    say, -dH/dq = p' = M w' + (dM/dt) w with w' the acceleration at (q, w). M is that of the system's masses and rods.
    """
    lengths, hanging = system.rest_lengths, np.cumsum(system.masses[:0:-1])[::-1]
    longest = np.maximum.outer(np.arange(len(lengths)), np.arange(len(lengths)))
    inertia = np.outer(lengths, lengths) * hanging[longest]

    def step(motion: Motion, state: State, dt: float) -> State:
        q = state.positions
        between = q[:, None] - q[None, :]
        mass = inertia * np.cos(between)
        start = mass @ state.velocities
        momenta = start
        for _ in range(100):
            w = np.linalg.solve(mass, momenta)
            turning = -inertia * np.sin(between) * (w[:, None] - w[None, :])
            before, momenta = momenta, start + dt * (mass @ motion.acceleration(State(0.0, q, w)) + turning @ w)
            if np.abs(momenta - before).max() < 1e-15 * np.abs(momenta).max():
                break
        moved = q + dt * np.linalg.solve(mass, momenta)
        return State(
            state.time + dt, moved, np.linalg.solve(inertia * np.cos(moved[:, None] - moved[None, :]), momenta)
        )

    return Scheme(step, 1, "scheme", linear=False)


@pytest.mark.rotating(3, in_turn=True)
def test_kick_drift_of_rods_grows_for_want_of_momenta(on: Bench) -> None:
    """In angles and rates kick-drift is not symplectic; in angles and momenta the same idea is, and stays bounded.

    So what MuJoCo's cable gains is not in its equations, nor in its dt.
    """
    schemes = (in_momenta(on.system), find("kick_drift"))
    kinds = [measure(SchemeStepper(scheme, PendulumMotion), on).measured for scheme in schemes]
    assert kinds == ["bounded", "growing"]


@pytest.mark.rotating(7)
def test_engines_do_with_energy_what_their_schemes_do(engine: Engine, on: Bench) -> None:
    """An engine is identified, and its energy is of its scheme's kind; theirs differ by chaos, from rounding on."""
    row = measure(EngineStepper(engine), on)
    assert row.scheme is not None
    assert row.measured == measure(row.scheme, on).measured
    assert row.predicted == predicted_energy_trend(row.scheme.scheme, on.at_rest[row.scheme.equations], DT)


# --- Momentum ---


def lost(scheme: Scheme, on: Bench, quantity: Callable[[MassSpringSystem, State], Array]) -> float:
    """How far a quantity gets from its start on the free string."""
    trajectory = SchemeStepper(scheme).run(on.free, DT, round(FREE_DURATION / DT)).trajectory
    assert trajectory is not None
    return change(on.free, trajectory, quantity)


def check_momentum(scheme: Scheme, on: Bench) -> None:
    """d/dt sum m v = 0 without outer forces, to one rounding in each step at most."""
    gone = lost(scheme, on, momentum)  # by a name of its own, as pytest would write out the bench where this fails
    assert gone < rounding()


def check_angular_momentum(scheme: Scheme, on: Bench) -> None:
    """d/dt sum m x cross v = 0 without outer forces, to one rounding in each step at most."""
    gone, few = lost(scheme, on, angular_momentum), rounding() * on.free.size
    assert gone < few


@pytest.mark.parametrize("scheme", SOLVED, ids=label)
def test_whole_state_schemes_keep_momentum(scheme: Scheme, on: Bench) -> None:
    """The two forces of a spring are taken from one state, and cancel."""
    check_momentum(scheme, on)


@pytest.mark.parametrize("scheme", [*IN_PLACE, wrong.in_order_of_number, ONE_SIDED], ids=label)
def test_momentum_fails_in_place_and_one_sided(scheme: Scheme, on: Bench) -> None:
    """The finding that belongs in words: in-place variants do not conserve momentum."""
    with pytest.raises(AssertionError):
        check_momentum(scheme, on)


@pytest.mark.parametrize("name", ["kick_drift", "drift_kick", "velocity_verlet", "implicit_midpoint"])
def test_symplectic_schemes_keep_angular_momentum(name: str, on: Bench) -> None:
    """It is quadratic in positions and velocities, and they keep what is (HLW VI.4, IV.2)."""
    check_angular_momentum(find(name), on)


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "scheme", [*(find(n) for n in ("euler", "heun", "rk4", "backward_euler")), *IN_PLACE, TURNED_SIDEWAYS], ids=label
)
def test_angular_momentum_fails_on_others(scheme: Scheme, on: Bench) -> None:
    """Each mixes positions and forces of two times, or has forces that are not along the springs."""
    with pytest.raises(AssertionError):
        check_angular_momentum(scheme, on)


def test_engines_fly_free_if_they_say_so(engine: Engine, on: Bench) -> None:
    """Momentum to rounding; or unsupported with a reason, if and only if the string demands what they cannot do."""
    outcome = EngineStepper(engine).run(on.free, DT, round(FREE_DURATION / DT))
    if set(demands(on.free)) <= engine.capabilities:
        assert outcome.trajectory is not None
        assert change(on.free, outcome.trajectory, momentum) < rounding()
    else:
        assert outcome.ending == "unsupported"
        assert "cannot do" in outcome.reason


# --- What is said of it ---


@pytest.fixture(scope="module")
def mixed(on: Bench) -> list[Row]:
    """Two schemes, one in place, an engine that claims kick-drift and does Euler, one that crashes."""
    names = ("kick_drift", "rk4", "heun_link_by_link", "pendulum_kick_drift")
    steppers: list[Stepper] = [catalogued()[name] for name in names]
    steppers += [EngineStepper(engine) for engine in (Doctored(), Doctored(Euler), Misbehaving(Segfaults))]
    return [measure(stepper, on) for stepper in steppers]


@pytest.mark.rotating(3, in_turn=True)
def test_findings_follow_the_kinds(mixed: list[Row]) -> None:
    """Who does what; who not as predicted, and why with rods; who loses momentum, and why in place."""
    said = " ".join(result_of(mixed).findings)
    assert "bounded in 2, growing in 3, decaying in 1 steppers: as predicted in 5 of 6." in said
    assert "Predicted bounded, measured growing: pendulum_kick_drift. These really drift: the prediction is for" in said
    assert "the mass matrix of a pendulum's angles depends on the angles" in said
    assert "Of the engines, energy is bounded in KickDrift; growing in Euler." in said
    assert "4 of 5 steppers keep a free string's momentum" in said
    assert "In-place variants do not conserve momentum (heun_link_by_link)" in said


@pytest.mark.rotating(3, in_turn=True)
def test_findings_are_not_written_for_one_outcome(mixed: list[Row]) -> None:
    """Without rods, in-place variants and engines not a word of them; other kinds are other exceptions; nobody."""
    said = " ".join(result_of(mixed[:2]).findings)
    assert "as predicted in 2 of 2" in said
    for word in ("small swings", "In-place", "engines"):
        assert word not in said
    turned = replace(mixed[1], measured="growing")
    said = " ".join(result_of([mixed[0], turned]).findings)
    assert "Predicted decaying, measured growing: rk4." in said
    assert "small swings" not in said
    assert result_of([]).findings == ["No stepper has both a predicted and a measured kind of energy."]


def test_failures_have_their_reasons(mixed: list[Row]) -> None:
    """A crash, a blow-up; and on the free string, what cannot fly."""
    result = result_of(mixed)
    said = "; ".join(result.failures)
    assert "Segfaults: crashed, killed by SIGSEGV" in said
    assert "Euler: diverged, spring" in said
    assert "pendulum_kick_drift on the free string: unsupported, expected a string" in said
    (crashed,) = (row for row in result.tables[0].rows if row[0] == "Segfaults")
    assert crashed[1:6] == [None] * 5
    assert crashed[-1] == "killed by SIGSEGV"  # on both strings, and told once


def test_a_change_is_the_largest_since_the_start() -> None:
    """Up by 3 and back to 1: 3, over sum m |v| of the start, 2 x 5 + 3 x 1 by hand."""
    system = replace(
        find_scene("string").system({"masses": 2}),
        masses=np.array([7.0, 2.0, 3.0]),
        velocities=np.array([[0.0, 0.0], [3.0, 4.0], [0.0, 1.0]]),
    )
    times = np.arange(3.0)
    still = Trajectory(times, np.zeros((3, 3, 2)), np.zeros((3, 3, 2)))
    there_and_back = {0.0: 0.0, 1.0: 3.0, 2.0: 1.0}
    found = change(system, still, lambda _, state: np.array([there_and_back[state.time], 0.0]))
    assert found == pytest.approx(3 / 13)
