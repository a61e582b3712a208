"""The order a stepper has on a spring that turns: a step matrix tells the order of linear motion only."""

from __future__ import annotations

import numpy as np

from reference.derivation.oscillators import Run, Runs
from reference.errors import SolverError, Unsupported
from reference.state import Array
from reference.system import MassSpringSystem

#: The longest step [s], how many of them, and how often it is halved.
DT, STEPS, HALVINGS = 1 / 8, 4, 3

#: An error below this part of a metre is rounding: it tells no order.
ROUNDING = 1e-11

#: Where the masses below, without damping, truly are after half a second [m], by `theory.exact`, which takes a while to
#: load: the tests solve for them again.
END_OF_ONE = np.array([[0.0, 0.0], [0.5514652132982372, -0.7898235843207049]])
END_OF_TWO = np.array([[0.0, 0.0], [0.542387459976358, -0.7750832130695136], [0.1613312702752428, -1.9247333159491082]])

#: How near to a whole number the order found has to come.
NEAR = 0.3


def nonlinear_order(runs: Runs, damped: bool, dragged: bool) -> int | None:
    """By the error after half a second with steps of 1/32 s and 1/64 s, to a whole number.

    None where the stepper cannot do it, is no better with shorter steps, or is too good for its order to be seen.
    """
    system = swinging(damped, dragged)
    return _order_on(system, runs, true_end(system) if damped or dragged else END_OF_ONE)


def order_of_two_masses(runs: Runs) -> int | None:
    """The same of two masses, without damping: one alone does not show whether one is moved before the other."""
    return _order_on(two_swinging(), runs, END_OF_TWO)


def true_end(system: MassSpringSystem) -> Array:
    """Where its masses truly come to [m]."""
    from reference.theory.exact import exact

    return np.asarray(exact(system, DT * STEPS, 1).positions[-1])


def _order_on(system: MassSpringSystem, runs: Runs, true: Array) -> int | None:
    halved = [(DT / 2**i, STEPS * 2**i) for i in range(HALVINGS + 1)]
    try:
        outcomes = runs([Run(system, dt, steps) for dt, steps in halved])
    except (SolverError, Unsupported):
        return None
    errors = []
    for outcome, (_, steps) in zip(outcomes, halved, strict=True):
        run = outcome.trajectory
        if run is None or len(run) != steps + 1:
            return None
        errors.append(float(np.abs(run.positions[-1] - true).max()))
    if not all(np.isfinite(errors)):
        return None
    told = [i for i in range(1, len(errors)) if errors[i] > ROUNDING]
    if not told:
        return None
    order = float(np.log2(errors[told[-1] - 1] / errors[told[-1]]))
    return round(order) if abs(order - round(order)) < NEAR else None


def swinging(damped: bool, dragged: bool) -> MassSpringSystem:
    """A mass of 1 kg on a stretched spring, moving across it: it turns by half a radian and lengthens by a third."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.1, -1.2]]),
        velocities=np.array([[0.0, 0.0], [1.0, 0.3]]),
        springs=np.array([[0, 1]]),
        masses=np.array([1.0, 1.0]),
        rest_lengths=np.array([1.0]),
        stiffness=np.array([16.0]),
        damping=np.array([0.8 if damped else 0.0]),
        drag=0.5 if dragged else 0.0,
        gravity=np.zeros(2),
        fixed=np.array([True, False]),
    )


def two_swinging() -> MassSpringSystem:
    """Another mass below that one, moving the other way."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.1, -1.2], [0.4, -2.1]]),
        velocities=np.array([[0.0, 0.0], [1.0, 0.3], [-0.5, 0.4]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([1.0, 1.0, 1.5]),
        rest_lengths=np.array([1.0, 1.0]),
        stiffness=np.array([16.0, 12.0]),
        gravity=np.zeros(2),
        fixed=np.array([True, False, False]),
    )
