"""Less damping: what the drag takes is what is missing, and small swings decay as they should."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import less_damping
from experiments.less_damping import Swing, falls_to, swing
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Trajectory
from reference.system import MassSpringSystem
from reference.theory.exact import damped_oscillator, exact
from report.figures import draw
from tests import wrong
from tests.reference.systems import label

DT, STEPS = 1e-3, 400


def string(drag: float) -> MassSpringSystem:
    """Five masses."""
    return find_scene("string").system({"masses": 5, "drag": drag})


def check_balance(system: MassSpringSystem, motion: Trajectory) -> None:
    """E(0) - E(t) = Cd integral of sum v^2 dt, for the drag is all that takes energy.

    The trapezoidal rule is off by (w dt)^2 / 12 of what oscillates: 0.2^2 / 12 = 3e-3 for the fastest mode, which has
    next to nothing of the energy. 1e-6 of it all is allowed.
    """
    found = swing(system, motion)
    assert found.energies[0] - found.energies[-1] == pytest.approx(found.taken, abs=1e-6 * found.energies[0])


@pytest.mark.parametrize("drag", [0.004, 0.02, 0.1])
def test_what_is_missing_of_the_energy_is_what_the_drag_has_taken(drag: float) -> None:
    """Of the true motion, whatever the drag."""
    check_balance(string(drag), exact(string(drag), DT, STEPS))


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "scheme",
    [
        find("euler"),
        wrong.heun_without_half,
        wrong.kick_drift_gaining_energy,
        wrong.last_mass_forgotten,
        wrong.stepped(wrong.damping_turned, find("rk4")),
        wrong.stepped(wrong.gravity_turned, find("rk4")),
        wrong.stepped(wrong.one_sided, find("rk4")),
    ],
    ids=label,
)
def test_the_balance_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """They make energy, or lose it elsewhere. RK4 with the right forces keeps the balance."""
    check_balance(string(0.02), simulate(string(0.02), find("rk4"), DT, STEPS * DT))
    with pytest.raises(AssertionError):
        check_balance(string(0.02), simulate(string(0.02), scheme, DT, STEPS * DT))


def oscillator(drag: float, doctored_drag: float | None = None) -> Swing:
    """One mass on one spring for 3 s, in closed form; perhaps with another drag than it says."""
    stretch, weight, stiffness = 0.02, 0.02 * 9.81, 200.0
    system = find_scene("spring").system({"drag": drag, "stretch": stretch, "stiffness": stiffness})
    times = DT * np.arange(3001)
    # y is measured upwards from rest, where the spring is longer by weight / stiffness.
    y, v = damped_oscillator(0.02, stiffness, doctored_drag or drag, weight / stiffness - stretch, 0.0, times)
    positions, velocities = (np.zeros((len(times), 2, 2)) for _ in range(2))
    positions[:, 1, 1] = -(0.125 + weight / stiffness) + y
    velocities[:, 1, 1] = v
    return swing(system, Trajectory(times, positions, velocities))


def check_decay(found: Swing) -> None:
    """E falls as exp(-t Cd/m): to 1/e in m/Cd.

    The energy wobbles about that by Cd/(2 m w) of itself, w = 100 1/s; over many swings the fit sees a part of it: 1 %.
    """
    assert found.fitted == pytest.approx(found.predicted, rel=0.01)
    assert found.predicted == pytest.approx(0.02 / found.drag)


@pytest.mark.parametrize("drag", [0.004, 0.02, 0.1])
def test_small_swings_decay_in_the_predicted_time(drag: float) -> None:
    """Shown on the closed form of the damped oscillator, which owes nothing to any scheme."""
    check_decay(oscillator(drag))


@pytest.mark.parametrize("drag", [0.02, 0.1])
def test_the_time_to_1_e_is_where_1_e_is_crossed(drag: float) -> None:
    """E = exp(-t Cd/m), which wobbles by Cd/(2 m w) of itself, 0.5 % at 0.02 N s/m: the time by as much of m/Cd."""
    found = oscillator(drag)
    assert found.measured == pytest.approx(0.02 / drag, rel=drag / (2 * 0.02 * 100))


def test_a_run_that_ends_before_has_no_time_to_1_e() -> None:
    """m/Cd = 5 s in 3 s: there is nothing to measure, whatever a fit says."""
    assert oscillator(0.004).measured is None


def test_the_crossing_is_that_of_the_energies_and_not_of_a_fit() -> None:
    """E falls linearly to nothing in 1 s: 1/e is left at 1 - 1/e, where an exponential fit says something else.

    Between two times its logarithm is taken for straight: at most dt^2 / (8 (1 - t)) = 3.4e-7 s off.
    """
    times = np.linspace(0.0, 0.999, 1000)
    assert falls_to(1 / np.e, times, 1.0 - times) == pytest.approx(1 - 1 / np.e, abs=3.5e-7)
    assert falls_to(1 / np.e, times[:500], 1.0 - times[:500]) is None


def test_the_decay_fails_with_another_drag() -> None:
    """By 3 % more than it says it has."""
    with pytest.raises(AssertionError):
        check_decay(oscillator(0.02, doctored_drag=0.0206))


def test_findings_are_made_from_the_swings(monkeypatch: pytest.MonkeyPatch) -> None:
    """With other numbers, other sentences; and there is a figure of them."""
    monkeypatch.setattr(less_damping, "DRAGS", (0.05,))
    result = less_damping.run(lambda _: None)
    (found,) = result.data["swings"]
    said = " ".join(result.findings)
    assert "With a drag of 0.05 N s/m" in said
    assert f"to 1/e at {found.measured:.3g} s, measured" in said
    assert f"predicted: 0.4 s; fitted to the whole run: {found.fitted:.3g} s" in said
    picture = draw("less_damping", result)
    assert f"{found.energies[-1] / found.energies[0]:.1e} of the energy is left" in picture.alt
    weaker = replace(found, energies=np.geomspace(1.0, 0.5, len(found.energies)))
    assert "5.0e-01 of the energy is left" in draw("less_damping", replace(result, data={"swings": [weaker]})).alt


def test_a_swing_s_decay_is_predicted_from_the_masses_that_move() -> None:
    """M/Cd, whatever holds the string; drag takes Cd times the square of all velocities over time, by hand."""
    system = find_scene("string").system({"masses": 2, "drag": 0.05})
    held = replace(system, masses=np.array([50.0, *system.masses[1:]]))
    positions = np.array([system.positions] * 3)
    velocities = np.zeros_like(positions)
    velocities[:, 1:] = np.array([3.0, 2.0, 1.0])[:, None, None]
    found = swing(held, Trajectory(np.array([0.0, 0.1, 0.2]), positions, velocities))
    assert found.predicted == pytest.approx(system.masses[1] / 0.05)
    squares = np.array([36.0, 16.0, 4.0])
    assert found.taken == pytest.approx(0.05 * 0.1 * (squares[0] / 2 + squares[1] + squares[2] / 2))
