"""States, slopes and trajectories: their shapes, their arithmetic, and how far apart two runs are."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from reference.errors import InputError
from reference.state import Slope, State, Trajectory


def trajectory(positions: Any) -> Trajectory:
    """A trajectory through these positions, shape (m, n, d), every 0.1 s, at rest."""
    x = np.array(positions, dtype=float)
    return Trajectory(np.linspace(0.0, 0.1 * (len(x) - 1), len(x)), x, np.zeros_like(x))


def test_a_state_moves_by_a_slope_times_a_time() -> None:
    """(t, x, v) + dt (1, x', v'), and slopes add."""
    state = State(1.0, np.array([[1.0, 2.0]]), np.array([[3.0, 4.0]]))
    slope = Slope(1.0, np.array([[10.0, 20.0]]), np.array([[30.0, 40.0]]))
    end = state + 0.5 * (slope + slope)
    assert end.time == 2.0
    assert end.positions.tolist() == [[11.0, 22.0]]
    assert end.velocities.tolist() == [[33.0, 44.0]]


def test_kick_and_drift() -> None:
    """A kick changes velocities alone and takes no time; a drift moves on at the velocity there is."""
    state = State(1.0, np.array([[1.0, 2.0]]), np.array([[3.0, 4.0]]))
    kicked, drifted = state.kick(np.array([[1.0, -1.0]])), state.drift(0.5)
    assert (kicked.time, drifted.time) == (1.0, 1.5)
    assert kicked.positions is state.positions
    assert kicked.velocities.tolist() == [[4.0, 3.0]]
    assert drifted.positions.tolist() == [[2.5, 4.0]]
    assert drifted.velocities is state.velocities
    assert state.positions.tolist() == [[1.0, 2.0]]


def test_states_and_trajectories_are_frozen() -> None:
    """Nothing can be put in the place of what they hold."""
    state = State(0.0, np.zeros((1, 2)), np.zeros((1, 2)))
    with pytest.raises(dataclasses.FrozenInstanceError):
        state.time = 1.0  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        trajectory([[[0.0, 0.0]]]).times = np.zeros(1)  # type: ignore[misc]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: State(0.0, np.zeros((2, 2)), np.zeros((3, 2))),
            "velocities has shape (3, 2): expected that of positions, (2, 2)",
        ),
        (
            lambda: Trajectory(np.zeros(3), np.zeros((2, 1, 2)), np.zeros((2, 1, 2))),
            "positions has shape (2, 1, 2): expected (3, n, d) for 3 times",
        ),
        (
            lambda: Trajectory(np.zeros(2), np.zeros((2, 2)), np.zeros((2, 2))),
            "positions has shape (2, 2): expected (2, n, d) for 2 times",
        ),
        (
            lambda: Trajectory(np.zeros(2), np.zeros((2, 1, 2)), np.zeros((2, 1, 3))),
            "velocities has shape (2, 1, 3): expected that of positions, (2, 1, 2)",
        ),
    ],
)
def test_shapes_that_do_not_fit_are_refused(make: Any, message: str) -> None:
    """In one line."""
    with pytest.raises(InputError) as refused:
        make()
    assert str(refused.value) == message


def test_a_trajectory_is_its_states() -> None:
    """There and back."""
    states = [State(0.1 * i, np.full((2, 3), float(i)), np.full((2, 3), -float(i))) for i in range(4)]
    run = Trajectory.of(states)
    assert len(run) == 4
    assert run.positions.shape == (4, 2, 3)
    for given, back in zip(states, run.states(), strict=True):
        assert back.time == given.time
        assert back.positions.tolist() == given.positions.tolist()
        assert back.velocities.tolist() == given.velocities.tolist()


def test_distance_is_that_of_the_mass_furthest_off() -> None:
    """Euclidean: 3-4-5; at each time."""
    one = trajectory([[[0, 0], [1, 1]], [[0, 0], [1, 1]]])
    other = trajectory([[[0, 0], [1, 1]], [[3, 4], [1, 2]]])
    assert one.distance(other).tolist() == [0.0, 5.0]
    assert other.distance(one).tolist() == [0.0, 5.0]


def test_where_a_run_has_ended_or_is_no_number_the_distance_is_infinite() -> None:
    """Whichever of the two it is, and without a warning."""
    one = trajectory([[[0.0, 0.0]], [[1e308, 0.0]], [[np.nan, 0.0]], [[0.0, 0.0]]])
    other = trajectory([[[0.0, 0.0]], [[-1e308, 0.0]], [[0.0, 0.0]]])
    assert one.distance(other).tolist() == [0.0, np.inf, np.inf, np.inf]
    assert other.distance(one).tolist() == [0.0, np.inf, np.inf, np.inf]
