"""Steps that students write, against what each is said to do, worked out for one mass with plain numbers."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.exercises.solutions.stepping import STEPS
from reference.state import Array, Slope, State

#: Stiffness over mass [1/s^2], that of the third power [1/(m s)^2], damping over mass [1/s]; where the mass is [m], how
#: fast [m/s]; the step [s]. Of linear motion two schemes of second order make the same.
K, K3, C = 2.0, 1.5, 0.3
X, V, H = 0.7, -0.4, 0.1


class OneMass:
    """x'' = -K x - K3 x^3 - C x'."""

    def acceleration(self, state: State) -> Array:
        """Of the mass, shape (1, 1)."""
        return -K * state.positions - K3 * state.positions**3 - C * state.velocities

    def slope(self, state: State) -> Slope:
        """Velocity and acceleration."""
        return Slope(1.0, state.velocities, self.acceleration(state))


def a(x: float, v: float) -> float:
    """The acceleration [m/s^2]."""
    return -K * x - K3 * x**3 - C * v


# At Euler's guess, half-way to it, and at two thirds of the way; and Heun's velocity.
GUESS = X + H * V, V + H * a(X, V)
HALF = X + H / 2 * V, V + H / 2 * a(X, V)
THIRDS = X + 2 / 3 * H * V, V + 2 / 3 * H * a(X, V)
CORRECTED = V + H / 2 * (a(X, V) + a(*GUESS))
EULER, AVERAGE = H * V, H / 2 * (V + GUESS[1])

EXPECTED = {
    "midpoint": (X + H * HALF[1], V + H * a(*HALF)),
    "ralston": (X + H * (V / 4 + 3 / 4 * THIRDS[1]), V + H * (a(X, V) / 4 + 3 / 4 * a(*THIRDS))),
    "without_half": (X + 2 * AVERAGE, 2 * CORRECTED - V),
    "half_of_one": (X + H * V + H / 2 * GUESS[1], V + H * a(X, V) + H / 2 * a(*GUESS)),
    "wrong_pair": (X + H / 2 * (V + HALF[1]), V + H / 2 * (a(X, V) + a(*HALF))),
    "crossed_pair": (X + H / 2 * (V + CORRECTED), CORRECTED),
    "end_slope": (X + H * GUESS[1], V + H * a(*GUESS)),
    "from_guess": (GUESS[0] + AVERAGE, GUESS[1] + CORRECTED - V),
    "positions_by_euler": (GUESS[0], CORRECTED),
    "velocities_by_euler": (X + AVERAGE, GUESS[1]),
    "new_velocity": (X + H * CORRECTED, CORRECTED),
    "guess_of_positions": (GUESS[0], V + H / 2 * (a(X, V) + a(GUESS[0], V))),
    "guess_of_velocities": (X + AVERAGE, V + H / 2 * (a(X, V) + a(X, GUESS[1]))),
    "guess_by_kick_drift": (X + AVERAGE, V + H / 2 * (a(X, V) + a(X + H * GUESS[1], GUESS[1]))),
    "old_velocity_in_force": (X + AVERAGE, V + H / 2 * (a(X, V) + a(GUESS[0], V))),
    "velocities_without_dt": (GUESS[0], V + a(X, V)),
    "positions_without_dt": (X + V, GUESS[1]),
    "still_positions": (X, GUESS[1]),
    "still_velocities": (GUESS[0], V),
    "velocity_replaced": (GUESS[0], H * a(X, V)),
    "nothing": (X, V),
}


def test_each_has_its_numbers() -> None:
    """And none of them those of another."""
    assert STEPS.keys() == EXPECTED.keys()
    assert len({tuple(np.round(numbers, 12)) for numbers in EXPECTED.values()}) == len(EXPECTED)


@pytest.mark.parametrize("name", EXPECTED)
def test_a_step_does_what_it_says(name: str) -> None:
    """Position and velocity after a step, to rounding, and the time."""
    end = STEPS[name](OneMass(), State(0.5, np.array([[X]]), np.array([[V]])), H)
    assert (end.positions[0, 0], end.velocities[0, 0]) == pytest.approx(EXPECTED[name], rel=1e-14)
    assert end.time == pytest.approx(0.5 + H)
