"""A pendulum's small swings, linearised by hand: against its own accelerations, and against closed forms."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, pendulum_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.linear_motion import LinearPendulum
from reference.theory.modes import laguerre_frequencies
from reference.theory.step_map import step_jacobian
from tests.reference.systems import with_fields


class DragOfOneMass(PendulumMotion):
    """Every rod is slowed by as many masses as if it carried one."""

    def derivatives_at_rest(self, state: State) -> tuple[Array, Array]:
        """With a fraction of the damping."""
        by_angle, by_rate = super().derivatives_at_rest(state)
        return by_angle, by_rate / len(state.positions)


class WeightOfOneMass(PendulumMotion):
    """Every rod is brought back by the weight of the mass at its end only."""

    def derivatives_at_rest(self, state: State) -> tuple[Array, Array]:
        """With less and less of the torque, the higher the rod."""
        by_angle, by_rate = super().derivatives_at_rest(state)
        return by_angle / np.arange(len(state.positions), 0, -1), by_rate


def aslant() -> MassSpringSystem:
    """Four unequal masses on unequal rods, dragged, in a field that is not vertical."""
    values = {"masses": 4, "mass": [0.02, 0.05, 0.01, 0.03], "rest_length": [0.1, 0.2, 0.15, 0.3], "drag": 0.1}
    return with_fields(find_scene("string").system(values), gravity=np.array([3.0, -9.0]))


def check_derivatives(motion: PendulumMotion) -> None:
    """The derivatives are those of the accelerations, by central differences of eps^(1/3): eps^(2/3) apart."""
    rest = pendulum_equilibrium(motion.system).state
    small = np.finfo(float).eps ** (1 / 3)
    nothing = np.zeros_like(rest.positions)
    assert motion.acceleration(rest) == pytest.approx(nothing, abs=1e-10)
    derivatives = motion.derivatives_at_rest(rest)
    for of_angles, derivative in zip((True, False), derivatives, strict=True):
        for j, unit in enumerate(small * np.eye(len(nothing))):
            x, v = (unit, nothing) if of_angles else (nothing, unit)
            plus, minus = (
                motion.acceleration(State(0.0, rest.positions + sign * x, rest.velocities + sign * v))
                for sign in (1, -1)
            )
            expected = (plus - minus) / (2 * small)
            assert derivative[:, j] == pytest.approx(expected, abs=1e-8 * np.abs(derivative).max())


def test_the_derivatives_at_rest_are_those_of_the_accelerations() -> None:
    """Of unequal masses and rods, with drag, aslant."""
    check_derivatives(PendulumMotion(aslant()))


@pytest.mark.parametrize("wrong", [DragOfOneMass, WeightOfOneMass])
def test_wrong_derivatives_are_caught(wrong: type[PendulumMotion]) -> None:
    """Those that forget what is further down."""
    with pytest.raises(AssertionError):
        check_derivatives(wrong(aslant()))


def about_rest(motion: PendulumMotion) -> Equilibrium:
    """A pendulum at rest whose equations are those given."""
    return replace(pendulum_equilibrium(motion.system), motion=motion)


def check_limits(motion: PendulumMotion) -> None:
    """Lagrange's loaded string: w^2 = (g/l) x, x a zero of Laguerre's polynomial; limits are found to 1e-8.

    Kick-drift is stable to h w = 2, rk4 to 2 sqrt(2).
    """
    fastest = sqrt(laguerre_frequencies(5, 0.125, 9.81).max())
    rest = about_rest(motion)
    assert stability_limit(find("kick_drift"), rest).dt == pytest.approx(2 / fastest, rel=2e-8)
    assert stability_limit(find("rk4"), rest).dt == pytest.approx(2 * sqrt(2) / fastest, rel=2e-8)


def test_limits_on_rods_are_those_of_the_loaded_string() -> None:
    """Five equal masses."""
    check_limits(PendulumMotion(find_scene("string").system({"masses": 5})))


def test_limits_on_wrong_rods_are_elsewhere() -> None:
    """Where a rod feels the lowest mass only."""
    with pytest.raises(AssertionError):
        check_limits(WeightOfOneMass(find_scene("string").system({"masses": 5})))


def test_a_step_of_small_swings_is_what_the_step_does_to_small_angles() -> None:
    """Heun's own function, given a matrix of columns, against differences of its step: to 1e-8."""
    rest, dt, small = pendulum_equilibrium(aslant()), 3e-3, 1e-6
    jacobian, step = step_jacobian(find("heun"), rest, dt), find("heun").on(rest.motion)
    assert isinstance(rest.linear_motion, LinearPendulum)
    for j, unit in enumerate(small * np.eye(4)):
        ends = [step(State(0.0, rest.state.positions + s * unit, 0 * unit), dt) for s in (1, -1)]
        change = np.concatenate([ends[0].positions - ends[1].positions, dt * (ends[0].velocities - ends[1].velocities)])
        assert jacobian[:, j] == pytest.approx(change / (2 * small), abs=1e-8)
