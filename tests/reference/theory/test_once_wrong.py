"""Inputs on which a limit was once wrong or missing, each with its right value from a closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.limit import Limit
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.measured_mode import measured_mode_limit
from reference.theory.modes import string_mode
from reference.theory.rates import rates


def both(name: str, rest: Equilibrium) -> tuple[Limit, Limit]:
    """A scheme's limit, predicted and measured."""
    found = rates(rest)
    predicted = stability_limit(find(name), rest, found)
    return predicted, measured_mode_limit(find(name), rest, predicted, found)


def chain(count: int, mass: float, stiffness: float, walls: int) -> MassSpringSystem:
    """Masses in a row, unstretched and without weight, between so many walls."""
    n = count + walls
    return MassSpringSystem(
        positions=np.stack([np.arange(n), np.zeros(n)], axis=1).astype(float),
        springs=np.stack([np.arange(n - 1), np.arange(1, n)], axis=1),
        masses=np.array(mass),
        rest_lengths=np.array(1.0),
        stiffness=np.array(stiffness),
        gravity=np.array(0.0),
        fixed=np.isin(np.arange(n), [0, n - 1][:walls]),
    )


@pytest.mark.parametrize(
    ("system", "squared"),
    [
        (find_scene("string").system({"gravity": 0.0}), 200.0 / 0.02 * string_mode(10)),
        (chain(2, 1.0, 4.0, 1), 4.0 * string_mode(2)),
        (chain(4, 4.0, 16.0, 2), 4.0 * 4 * np.sin(4 * np.pi / 10) ** 2),
    ],
    ids=["string", "two masses on a wall", "four masses between walls"],
)
def test_rk4_without_weight(system: MassSpringSystem, squared: float) -> None:
    """sqrt(8)/w, predicted to 1e-9 and measured to 1e-4; across the line nothing resists, and that is no growth."""
    predicted, measured = both("rk4", spring_equilibrium(system))
    assert predicted.dt == pytest.approx(np.sqrt(8 / squared), rel=1e-9)
    assert measured.dt == pytest.approx(np.sqrt(8 / squared), rel=1e-4)


def test_a_string_in_three_dimensions() -> None:
    """M = 0.1, k = 50 N/m: 2/w = 2 sqrt(m/k)."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(50.0),
        fixed=np.array([True, False]),
    )
    predicted, measured = both("kick_drift", spring_equilibrium(system))
    assert predicted.dt == pytest.approx(2 * np.sqrt(0.1 / 50), rel=1e-8)
    assert measured.dt == pytest.approx(2 * np.sqrt(0.1 / 50), rel=1e-4)


@pytest.mark.parametrize("gravity", [9.81, -9.81])
def test_weight_upwards_has_the_limit_of_weight_downwards(gravity: float) -> None:
    """0.02 s either way, no phantom at 1e-7 s."""
    limit = stability_limit(find("kick_drift"), spring_equilibrium(find_scene("spring").system({"gravity": gravity})))
    assert limit.dt == pytest.approx(0.02, rel=1e-8)


def test_masses_with_drag_and_no_spring() -> None:
    """Explicit drag is stable to 2 m / Cd = 2e-3 s; Euler too."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0]]),
        springs=np.zeros((0, 2), dtype=np.int64),
        masses=np.array(1e-3),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        damping=np.zeros(0),
        drag=1.0,
        gravity=np.array(9.81),
    )
    for name in ("kick_drift", "euler", "velocity_verlet"):
        assert stability_limit(find(name), spring_equilibrium(system)).dt == pytest.approx(2e-3, rel=1e-7)


@pytest.mark.parametrize("drag", [0.0, 0.05])
def test_a_loose_mass_leaves_the_limit_of_the_rest(drag: float) -> None:
    """It has its own, 2 m / Cd, which is far longer."""
    string = find_scene("string").system({"masses": 3, "drag": drag})
    with_loose = replace(
        string,
        positions=np.vstack([string.positions, [5.0, 5.0]]),
        velocities=np.zeros((5, 2)),
        masses=np.append(string.masses, 0.02),
        fixed=np.append(string.fixed, False),
    )
    for name in ("kick_drift", "rk4", "drift_kick_implicit_damping"):
        alone, beside = (stability_limit(find(name), spring_equilibrium(s)).dt for s in (string, with_loose))
        assert beside == pytest.approx(alone, rel=1e-8)


def test_a_spring_without_stiffness_leaves_the_limit_of_the_rest() -> None:
    """The part below it falls: two masses on one spring, w^2 = 2 k/m; the part above, one mass, w^2 = k/m."""
    system = find_scene("string").system({"masses": 3, "stiffness": [200.0, 0.0, 200.0]})
    predicted, measured = both("kick_drift", spring_equilibrium(system))
    assert predicted.dt == pytest.approx(2 / np.sqrt(2 * 200 / 0.02), rel=1e-8)
    assert measured.dt == pytest.approx(predicted.dt, rel=1e-4)


def test_a_body_that_falls() -> None:
    """A dumb-bell in free fall: w^2 = 2 k/m, in the frame that falls with it; measured against a run that falls too."""
    system = replace(chain(2, 0.5, 100.0, 0), gravity=np.array([0.0, -9.81]))
    predicted, measured = both("kick_drift", spring_equilibrium(system))
    assert predicted.dt == pytest.approx(2 / np.sqrt(2 * 100 / 0.5), rel=1e-8)
    assert measured.dt == pytest.approx(predicted.dt, rel=1e-4)


def test_a_damped_oscillator_on_its_line() -> None:
    """Euler: |1 + h mu| <= 1 up to h = c/k = 2.5 ms with c = 0.5, where nothing can swing across."""
    on_line = MassSpringSystem(
        positions=np.array([[0.0], [-0.125]]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.02),
        rest_lengths=np.array(0.125),
        stiffness=np.array(200.0),
        damping=np.array(0.5),
        fixed=np.array([True, False]),
    )
    predicted, measured = both("euler", spring_equilibrium(on_line))
    assert predicted.dt == pytest.approx(0.5 / 200, rel=1e-9)
    assert measured.dt == pytest.approx(0.5 / 200, rel=1e-4)


def test_a_mesh_of_hundreds_of_masses_has_certified_limits() -> None:
    """A net of 21 x 21 held at its edges, unstretched: w^2 = (k/m) 4 (sin^2 + ...) along each thread by itself."""
    net = find_scene("cloth").system({"rows": 21, "columns": 21, "shear": 0.0, "bend": 0.0, "gravity": 0.0})
    edge = (np.ptp(net.positions[:, [0]], axis=1) == 0) & False
    numbers = np.arange(441).reshape(21, 21)
    edge[np.concatenate([numbers[0], numbers[-1], numbers[:, 0], numbers[:, -1]])] = True
    held = replace(net, fixed=edge, velocities=np.zeros_like(net.velocities))
    limit = stability_limit(find("kick_drift"), spring_equilibrium(held))
    fastest = held.stiffness[0] / held.masses[0] * 4 * np.sin(19 * np.pi / 40) ** 2
    assert limit.certainty == "certified"
    assert limit.dt == pytest.approx(2 / np.sqrt(fastest), rel=1e-8)


def test_a_wrong_value_is_caught() -> None:
    """Shown to fail: of another scheme the closed form is not it."""
    predicted, _ = both("drift_kick", spring_equilibrium(chain(2, 1.0, 4.0, 1)))
    with pytest.raises(AssertionError):
        assert predicted.dt == pytest.approx(np.sqrt(8 / (4.0 * string_mode(2))), rel=1e-4)
