"""Rests on obstacles, and limits about them: against closed forms, balances of forces, and runs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.obstacles import Circle, Obstacle, Plane
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.contacts import projection_jacobian
from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium
from reference.theory.keeps_to_surfaces import keeps_to_surfaces
from reference.theory.limits import stability_limit
from reference.theory.measured_mode import measured_mode_limit
from reference.theory.rates import rates
from tests.reference.systems import two_on_a_floor

FLOOR = Plane((0.0, 0.0), (0.0, 1.0))
MASS, STIFFNESS, LENGTH, HEIGHT, WEIGHT = 0.5, 20.0, 0.8, 1.0, 9.81


def on_spring(place: Array, obstacle: Obstacle, **more: object) -> MassSpringSystem:
    """One mass on one spring whose other end is fixed at a HEIGHT."""
    given = {
        "positions": np.array([[0.0, HEIGHT], place]),
        "springs": np.array([[0, 1]]),
        "masses": np.full(2, MASS),
        "rest_lengths": np.array([LENGTH]),
        "stiffness": np.array([STIFFNESS]),
        "gravity": np.array([0.0, -WEIGHT]),
        "fixed": np.array([True, False]),
        "obstacles": (obstacle,),
    }
    return MassSpringSystem(**(given | more))  # type: ignore[arg-type]


def test_a_mass_on_the_floor_swings_like_a_pendulum_in_tension() -> None:
    """It lies below its spring's other end, from wherever it starts: N = m g - k (H - L0).

    Along the floor only the spring's tension brings it back: w^2 = k (1 - L0 / H) / m, and kick-drift's limit is 2 / w.
    The rest is known to rounding of the positions, some 1e-15 m, and so is w^2 to some 1e-14 of itself.
    """
    system = on_spring(np.array([0.3, 0.0]), FLOOR)
    rest = spring_equilibrium(system)
    np.testing.assert_allclose(rest.state.positions[1], [0.0, 0.0], atol=1e-12)
    assert rest.contacts is not None
    np.testing.assert_allclose(rest.contacts.forces, [MASS * WEIGHT - STIFFNESS * (HEIGHT - LENGTH)], rtol=1e-12)
    swing = np.sqrt(STIFFNESS * (1 - LENGTH / HEIGHT) / MASS)
    assert stability_limit(find("kick_drift"), rest).dt == pytest.approx(2 / swing, rel=1e-8)
    assert stability_limit(find("kick_drift"), rest).certainty == "certified"
    alone = spring_equilibrium(replace(system, obstacles=()))
    assert stability_limit(find("kick_drift"), alone).dt != pytest.approx(2 / swing, rel=0.1)


@pytest.mark.parametrize("scale", [1e-12, 1e-6, 1.0, 1e6, 1e12])
@pytest.mark.parametrize("stiffness", [0.0, STIFFNESS])
def test_the_rest_is_the_same_in_any_unit_of_mass(scale: float, stiffness: float) -> None:
    """N = m g - k (H - L0), as before, for masses and stiffness as many times as large; without stiffness N = m g."""
    start, loose = np.array([0.3, 0.0]), stiffness == 0.0
    system = on_spring(start, FLOOR, masses=np.full(2, scale * MASS), stiffness=np.array([scale * stiffness]))
    rest = spring_equilibrium(system)
    np.testing.assert_allclose(rest.state.positions[1], start if loose else [0.0, 0.0], atol=1e-12)
    assert rest.contacts is not None
    pressed = MASS * WEIGHT - stiffness * (HEIGHT - LENGTH)
    np.testing.assert_allclose(rest.contacts.forces, [scale * pressed], rtol=1e-12)


def test_a_surface_that_curves_lets_a_mass_slide() -> None:
    """On top of a circle of radius R below the spring, m w^2 = k (1 - L0 / H) - N / R: less than on a floor."""
    radius, stiffness = 2.0, 60.0
    top = Circle((0.0, -radius), radius)
    system = on_spring(np.array([0.1, 0.0]), top, stiffness=np.array([stiffness]), masses=np.full(2, 1.5))
    rest = spring_equilibrium(system)
    assert rest.contacts is not None
    (force,) = rest.contacts.forces
    assert force == pytest.approx(1.5 * WEIGHT - stiffness * (HEIGHT - LENGTH), rel=1e-9)
    tension = stiffness * (1 - LENGTH / HEIGHT)
    assert tension > force / radius
    assert rates(rest).fastest == pytest.approx(np.sqrt((tension - force / radius) / 1.5), rel=1e-9)


@pytest.mark.parametrize("above", [0.0, 1e-3, 0.1])
def test_a_mass_that_starts_at_rest_stays(above: float) -> None:
    """On top of a circle of radius R between two springs that are as long as at rest: m w^2 = 2 k - m g / R."""
    mass, stiffness, radius = 0.5, 100.0, 0.5
    system = MassSpringSystem(
        positions=np.array([[-1.0, radius], [1.0, radius], [0.0, radius + above]]),
        springs=np.array([[0, 2], [1, 2]]),
        masses=np.full(3, mass),
        rest_lengths=np.ones(2),
        stiffness=np.full(2, stiffness),
        fixed=np.array([True, True, False]),
        obstacles=(Circle((0.0, 0.0), radius),),
    )
    rest = spring_equilibrium(system)
    np.testing.assert_allclose(rest.state.positions[2], [0.0, radius], atol=1e-9)
    swing = np.sqrt((2 * stiffness - mass * WEIGHT / radius) / mass)
    assert rates(rest).fastest == pytest.approx(swing, rel=1e-8)


def test_what_slides_off_is_on_no_rest() -> None:
    """The same circle without a spring that holds: from its very top, a ridge of the energy, the mass falls past it."""
    top = Circle((0.0, -2.0), 2.0)
    system = on_spring(np.array([0.0, 0.0]), top, stiffness=np.zeros(1))
    with pytest.raises(SolverError, match=r"falls past the obstacles|steps downhill"):
        spring_equilibrium(system)


@pytest.mark.rotating(4, in_turn=True)
def test_a_block_is_carried_by_the_floor() -> None:
    """The contacts' forces are its weight together, and none pulls."""
    rest, about = equilibrium_on_obstacles(find_scene("drop").system({}))
    system = rest.system
    assert rest.contacts is not None
    weight = system.masses.sum() * np.linalg.norm(system.gravity)
    assert rest.contacts.forces.sum() == pytest.approx(weight, rel=1e-9)
    assert (rest.contacts.forces > 0).all()
    assert about == "about its rest on obstacles, where 16 masses press"


@pytest.mark.rotating(8, in_turn=True)
@pytest.mark.parametrize("name", ["kick_drift", "heun", "velocity_verlet"])
def test_limits_on_a_circle_are_those_that_runs_have(name: str) -> None:
    """A string over slide 17's barrier, run from a perturbation with its end of each step: predicted and measured.

    Both are found to 4e-5 of themselves. Without the obstacle the limit is more than a hundredth of a part shorter.
    """
    system = find_scene("barrier").system({"damping": 0.05})
    rest = spring_equilibrium(system)
    assert rest.contacts is not None
    predicted = stability_limit(find(name), rest)
    measured = measured_mode_limit(find(name), rest, predicted, rates(rest))
    assert measured.dt == pytest.approx(predicted.dt, rel=1e-4)
    alone = stability_limit(find(name), spring_equilibrium(replace(system, obstacles=())))
    assert alone.dt != pytest.approx(measured.dt, rel=1e-3)


def test_a_step_that_moves_first_has_no_rest_on_a_floor() -> None:
    """From rest x' = x + dt v leads nowhere, the next step inside: `drift_kick` is put out in every second step."""
    rest = spring_equilibrium(on_spring(np.array([0.0, 0.0]), FLOOR))
    with pytest.raises(SolverError, match="every second step"):
        stability_limit(find("drift_kick"), rest)
    assert keeps_to_surfaces(find("kick_drift"))
    assert not any(map(keeps_to_surfaces, map(find, ("drift_kick", "heun", "kick_drift_implicit_damping"))))


def test_the_end_of_a_step_is_linearised() -> None:
    """Against central differences of the projection itself, a mass in each of two obstacles, one in none, one fixed."""
    obstacles = (Circle((0.0, 0.0), 1.0), Plane((0.0, -2.0), (0.6, 0.8)))
    x = np.array([[0.3, 0.7], [1.0, -3.0], [3.0, 3.0], [0.1, 0.2]])
    system = MassSpringSystem(
        positions=x + np.array([[0, 5.0]]),
        springs=np.array([[0, 1]]),
        masses=np.ones(4),
        rest_lengths=np.ones(1),
        stiffness=np.ones(1),
        fixed=np.array([False, False, False, True]),
    )
    system, v, dt = replace(system, obstacles=obstacles), np.array([[0.2, -0.9], [1.0, -2.0], [1.0, 1.0], [0, 0]]), 0.1

    def after(z: Array) -> Array:
        from reference.obstacles import project_out

        moves = z.reshape(2, 3, 2)
        places, speeds = np.array(x), np.array(v)
        places[:3] += moves[0]
        speeds[:3] += moves[1] / dt
        out = project_out(obstacles, system.fixed[:, None], places, speeds)
        return np.concatenate([out[0][:3].ravel(), dt * out[1][:3].ravel()])

    differenced = np.stack([(after(1e-6 * e) - after(-1e-6 * e)) / 2e-6 for e in np.eye(12)], axis=1)
    np.testing.assert_allclose(projection_jacobian(system, x, v, dt), differenced, atol=1e-9)


#: A short string with springs that are not linear rests on a circle; a dt [s], and whether RK4 lets it blow up there.
BESIDE_THE_TANGENT = [({"tension_only": 1}, 0.01627, False), ({"hardening": 2e5}, 0.01589, True)]


@pytest.mark.rotating(8, in_turn=True)
@pytest.mark.parametrize(("kind", "dt", "blows_up"), BESIDE_THE_TANGENT, ids=["rope", "hardening"])
def test_limits_on_obstacles_are_those_of_the_springs_own_law(kind: dict[str, Any], dt: float, blows_up: bool) -> None:
    """Between the limits of the law and of its tangents at the rest a run tells which of them holds.

    Steps stay 1.3 mm beside the rest, where ropes are slack and springs harder. Shown to fail: with the tangents both
    limits are on the other side of dt.
    """
    system = find_scene("barrier").system({"masses": 4, "circle_x": 0.2, "circle_y": -0.2, "radius": 0.15, **kind})
    rest, scheme = spring_equilibrium(system), find("rk4")
    limit, of_tangents = (stability_limit(scheme, one).dt for one in (rest, replace(rest, by_law=None)))
    assert limit is not None
    assert of_tangents is not None
    assert (limit < dt < of_tangents) if blows_up else (of_tangents < dt < limit)
    run = simulate(system.at(rest.state), scheme, dt, 3000 * dt)
    if blows_up:
        assert len(run) < 3001 or np.abs(run.positions[-1] - rest.state.positions).max() > 0.1
    else:
        assert np.abs(run.positions[-1] - run.positions[-2]).max() < 1e-9  # of what blows up 1e-4


@pytest.mark.rotating(2)
@pytest.mark.parametrize("damping", [1e-9, 1e-5])
def test_weak_damping_on_the_floor_hides_no_limit(damping: float) -> None:
    """Two masses on a floor 1 cm below: a scheme's limit is that without damping, 1e-4 of it off at most.

    Heun's is where decay of 1e-10 in a step and less ends, which differences do not tell: it is not computed.
    """
    damped, plain = (spring_equilibrium(two_on_a_floor(c)) for c in (damping, 0.0))
    for name in ("velocity_verlet", "rk4", "leapfrog_kick_drift_kick"):
        expected = stability_limit(find(name), plain).dt
        assert expected is not None
        assert stability_limit(find(name), damped).dt == pytest.approx(expected, rel=1e-4)
    assert stability_limit(find("heun"), damped).stable_steps == "unknown"
