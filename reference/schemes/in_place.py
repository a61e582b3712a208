"""Deliberately incorrect schemes: each writes into the state it is still reading.

The lecture warns of them (slides 7-11): a state is to be advanced as a whole, not link by link. Here they are written
with the care given to the right ones, because students write them, and the lab must know them by name. The bases and
slopes are right; only *when the state is overwritten* is wrong. All lose an order of accuracy.
"""

from __future__ import annotations

from reference.motion import MotionByMass
from reference.schemes.catalogue import scheme
from reference.state import State


@scheme(order=1, kind="in_place", interactive_up_to=5000)
def euler_in_place(motion: MotionByMass, state: State, dt: float) -> State:
    """Euler, but each mass is advanced before the next has looked at it."""
    end = _copy(state, dt)
    x, v = end.positions, end.velocities
    for i in range(len(x)):
        slope_x, slope_v = v[i].copy(), motion.acceleration_of(i, end)
        x[i] += dt * slope_x
        v[i] += dt * slope_v
    return end


@scheme(order=1, kind="in_place", interactive_up_to=5000)
def heun_link_by_link(motion: MotionByMass, state: State, dt: float) -> State:
    """Heun, but predictor and corrector of one mass are done before the next mass begins."""
    end = _copy(state, dt)
    x, v = end.positions, end.velocities
    for i in range(len(x)):
        x0, v0 = x[i].copy(), v[i].copy()
        a0 = motion.acceleration_of(i, end)
        x[i] = x0 + dt * v0
        v[i] = v0 + dt * a0
        v1, a1 = v[i].copy(), motion.acceleration_of(i, end)
        x[i] = x0 + dt / 2 * (v0 + v1)
        v[i] = v0 + dt / 2 * (a0 + a1)
    return end


@scheme(order=1, kind="in_place", interactive_up_to=5000)
def heun_aliased(motion: MotionByMass, state: State, dt: float) -> State:
    """Heun in the two loops of slide 11, but the temporary state *is* the state.

    The first loop predicts each mass while the next still looks at it; the second corrects in the same way. Each
    mass's own base value is kept: were that lost too, every step would advance about 2 dt and converge to nothing.
    """
    end = _copy(state, dt)
    x, v = end.positions, end.velocities
    slopes = []
    for i in range(len(x)):
        slopes.append((v[i].copy(), motion.acceleration_of(i, end)))
        x[i] = state.positions[i] + dt * slopes[i][0]
        v[i] = state.velocities[i] + dt * slopes[i][1]
    for i in range(len(x)):
        v1, a1 = v[i].copy(), motion.acceleration_of(i, end)
        x[i] = state.positions[i] + dt / 2 * (slopes[i][0] + v1)
        v[i] = state.velocities[i] + dt / 2 * (slopes[i][1] + a1)
    return end


def _copy(state: State, dt: float) -> State:
    return State(state.time + dt, state.positions.copy(), state.velocities.copy())
