"""Cloths that fall, and a flag: where they stay, against closed forms and the energy that they may not gain."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.conserved import energy
from reference.errors import InputError
from reference.obstacles import Box
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from tests import wrong

# --- A flag ---


def flag(**settings: Any) -> MassSpringSystem:
    """Hung from a line, the wind square to it."""
    return find_scene("flag").system({"rows": 4, "columns": 5, "held": "line", "direction": 90.0, **settings})


def check_angle(system: MassSpringSystem, drag: float, wind: float, mass: float = 0.002) -> None:
    """At rest all masses are in the plane at tan(angle) = Cd w/(m g) from the vertical: to 1e-9, the solver's 1e-9."""
    rest = equilibrium(system).positions
    top = rest[:, 1].max()
    free = ~system.fixed
    expected = drag * wind / (mass * 9.81)
    assert rest[free, 2] / (top - rest[free, 1]) == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("wind", [1.0, 8.0])
def test_a_flag_on_a_line_hangs_at_the_angle_of_the_wind(wind: float) -> None:
    """And not at that of a wind stronger by a millionth."""
    system = flag(wind=wind, drag=0.004)
    check_angle(system, 0.004, wind)
    with pytest.raises(AssertionError):
        check_angle(system, 0.004, wind * (1 + 1e-6))


def drag_by_hand(system: MassSpringSystem, scheme: Scheme, wind: float, still: MassSpringSystem) -> float:
    """How far the flag's end is [m] from one in still air that is pushed by -Cd (v - w) in place of -Cd v."""
    moving = simulate(system, scheme, 1e-3, 0.2).positions[-1]
    state = still.start
    from reference.forces import SpringMotion
    from reference.state import State

    motion = SpringMotion(still)
    for _ in range(200):
        seen = State(state.time, state.positions, state.velocities - wind * np.array([0.0, 0.0, 1.0]))
        state = state.kick(1e-3 * np.where(still.fixed[:, None], 0.0, motion.acceleration(seen))).drift(1e-3)
    return float(np.abs(moving - state.positions).max())


def test_wind_is_drag_relative_to_the_air() -> None:
    """Kick-drift with -Cd (v - w): the same to rounding, 200 steps of 1e-16 m; not in half the wind."""
    system, still = flag(wind=8.0), flag(wind=0.0)
    assert drag_by_hand(system, find("kick_drift"), 8.0, still) < 1e-12
    assert drag_by_hand(system, find("kick_drift"), 4.0, still) > 1e-3


def check_never_gains(system: MassSpringSystem, scheme: Scheme) -> None:
    """Drag takes energy, Cd v^2 at each mass, the wind's gravity counted as weight: to 1e-6 J of 0.1 J a step's error.

    RK4's error in energy is (w dt)^5 with w dt = 0.2: 3e-4 of what is in the fastest springs, next to nothing.
    """
    energies = [energy(system, state) for state in simulate(system, scheme, 1e-3, 0.5).states()]
    assert np.diff(energies).max() < 1e-6


def test_a_flag_in_a_steady_wind_never_gains_energy() -> None:
    """On its pole. Heun without its half does."""
    system = find_scene("flag").system({})
    check_never_gains(system, find("rk4"))
    for doctored in (wrong.kick_drift_kicked_twice, wrong.stepped(wrong.damping_turned, find("rk4"))):
        with pytest.raises(AssertionError):
            check_never_gains(system, doctored)


# --- Cloths that fall ---


@pytest.mark.parametrize("name", ["falling_cloth", "tablecloth"])
def test_a_cloth_that_falls_stays_out_and_gains_no_energy(name: str) -> None:
    """No mass is inside; the middle rests on what it fell on; energy goes down, but for a step's first-order error."""
    scene = find_scene(name)
    system = scene.system({})
    assert not system.fixed.any()
    motion = simulate(system, find("kick_drift"), scene.dt, scene.duration)
    (obstacle,) = system.obstacles
    gaps = obstacle.signed_distances(motion.positions)[0][..., 0]
    assert -1e-14 <= gaps.min() <= 1e-14
    energies = [energy(system, state) for state in motion.states()]
    weight = system.masses.sum() * 9.81
    assert max(energies) - energies[0] < 0.02 * weight * system.size
    assert energies[-1] < energies[0]
    assert motion.positions[-1, :, 1].min() < system.positions[0, 1] - 0.1


def test_a_tablecloth_lies_on_a_table_and_hangs_over_one_edge() -> None:
    """A part of its columns beyond; with none or all of them it is refused."""
    system = find_scene("tablecloth").system({"overhang": 0.3})
    (table,) = system.obstacles
    assert isinstance(table, Box)
    gaps, normals = table.signed_distances(system.positions)
    edge = table.centre[0] + table.half_sizes[0]
    beyond = system.positions[:, 0] > edge
    assert beyond.mean() == pytest.approx(0.3)
    assert np.abs(gaps[~beyond]).max() == 0
    assert (normals[~beyond, 1] == 1).all()
    for overhang in (0.0, 1.0, -1.0):
        with pytest.raises(InputError, match=r"overhang = .*: expected a number between 0 and 1"):
            find_scene("tablecloth").system({"overhang": overhang})
