"""Solutions that owe nothing to the schemes: a closed form, and the most accurate numbers there are.

Where there is a formula it is used; else SciPy's Dormand-Prince method of order 8 with a tolerance of 1e-12.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import numpy.typing as npt

from reference.changes import Change, applied, changes_by_step
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.motion import EquationsOf, Motion
from reference.springs.breaking import breaking
from reference.state import Array, State, Trajectory
from reference.system import BREAK, IntArray, MassSpringSystem

TOLERANCE = 1e-12

#: So many steps the solver makes besides one for every time that is asked for: those of tens of thousands of periods.
MOST_STEPS = 200_000

#: After SEEN of them it is clear how far it will come: what lies more than TOO_FAR times as far is not tried.
SEEN, TOO_FAR = 500, 3.0

#: Evaluations in a step of DOP853; a step that is rejected, as too long, counts as one.
STAGES = 12

#: What is said of systems with obstacles. A run of tiny steps would only be one scheme's word against another's.
WHY_NOT_EXACT = "no true motion: a mass that meets an obstacle loses velocity at once, which no solver here can follow"


def damped_oscillator(
    mass: float, stiffness: float, damping: float, y0: float, v0: float, times: npt.ArrayLike
) -> tuple[Array, Array]:
    """The motion m y'' + c y' + k y = 0 about its rest, in closed form, for any damping.

    With gamma = c / 2m and s = sqrt(|gamma^2 - k/m|), y = exp(-gamma t) (y0 C + (v0 + gamma y0) S), where C and S are
    cos(st), sin(st)/s if under-damped; 1, t if critically; cosh(st), sinh(st)/s if over-damped.
    (French, *Vibrations and Waves*, ch. 3; lecture slide 2 has the equation.)

    Args:
        mass: [kg]. stiffness: [N/m]. damping: [N s/m]. y0: [m]. v0: [m/s]. times: [s].

    Returns:
        Positions [m] and velocities [m/s] at the times.
    """
    t = np.asarray(times, dtype=np.float64)
    gamma = damping / (2 * mass)
    square = stiffness / mass - gamma**2
    s = np.sqrt(abs(square))
    if square > 0:
        decay, c, d = np.exp(-gamma * t), np.cos(s * t), np.sin(s * t) / s
    elif square < 0:
        # The slow decay, at gamma - s = k/m / (gamma + s), apart: cosh alone would overflow. What remains of sinh is
        # 1 - exp(-2st), which expm1 keeps exact where the two decays are nearly equal.
        parted = -np.expm1(-2 * s * t)
        decay, c, d = np.exp(-stiffness / mass / (gamma + s) * t), 1 - parted / 2, parted / (2 * s)
    else:
        decay, c, d = np.exp(-gamma * t), np.ones_like(t), t
    y = decay * (y0 * c + (v0 + gamma * y0) * d)
    v = decay * (v0 * c - (gamma * v0 + stiffness / mass * y0) * d)
    return y, v


def exact(
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
    equations: EquationsOf = SpringMotion,
    most_steps: int = MOST_STEPS,
) -> Trajectory:
    """The true trajectory at the times 0, dt, 2 dt, ..., to about 1e-11 of its size while it is not chaotic.

    A parameter that changes does so at the start of the step it acts on, as it does for every stepper, and a spring
    breaks at the end of a step (`springs.breaking`): the solver stops there and starts anew.

    Args:
        equations: what to make of the system; `pendulum.PendulumMotion` hangs rods in place of the springs.
        most_steps: of the solver, besides one for every time.

    Raises:
        SolverError: if the solver gives up, or needs more steps; for a system with obstacles.
    """
    if system.obstacles or system.collisions is not None:
        raise SolverError(WHY_NOT_EXACT if system.obstacles else WHY_NOT_EXACT.replace("an obstacle", "another"))
    pending = changes_by_step(changes, dt)
    stops = sorted({i for i in pending if i < steps} | {steps})
    motion = equations(system)
    states = [motion.start]
    while (begin := len(states) - 1) < steps:
        state = states[-1]
        for change in pending.get(begin, ()):
            system, state = applied(change, system, state)
            motion = equations(system)
        end = next(stop for stop in stops if stop > begin)
        times = np.array([dt * i for i in range(begin, end + 1)])
        breaks = partial(breaking, system) if system.nonlinear is not None and system.nonlinear.breaks else None
        solved, made = _solve(motion, state, times, system.size or system.scale, most_steps, breaks)
        states, most_steps = [*states, *solved], most_steps - made
        if breaks is not None and len(broken := breaks(states[-1])):
            system = system.with_parameter(BREAK, broken.tolist())
            motion = equations(system)
    return motion.trajectory(states)


def _solve(
    motion: Motion,
    state: State,
    times: Array,
    size: float,
    most_steps: int,
    breaks: Callable[[State], IntArray] | None = None,
) -> tuple[list[State], int]:
    """The states at times[1:], from the one at times[0], by DOP853 (Hairer, Norsett and Wanner I, II.5).

    Args:
        breaks: which springs break at a state; the first where some do is the last.

    Returns:
        The states, and how many steps the solver made besides one for each.

    Raises:
        SolverError: if it gives up, or needs more steps.
    """
    from scipy.integrate import DOP853

    shape = state.positions.shape

    def derivative(t: float, y: Array) -> Array:
        x, v = y.reshape(2, *shape)
        return np.concatenate([v, motion.acceleration(State(t, x, v))], axis=None)

    start = np.concatenate([state.positions, state.velocities], axis=None)
    solver = DOP853(derivative, times[0], start, times[-1], rtol=TOLERANCE, atol=TOLERANCE * size)
    states: list[State] = []
    most, seen = len(times) - 1 + most_steps, False
    for time in times[1:].tolist():
        # Steps end at every time asked for: what DOP853 interpolates in between is of a lower order, and was seen
        # 400 times less accurate where damping is strong.
        solver.t_bound, solver.status = time, "running"
        while solver.status == "running":
            made = solver.nfev // STAGES
            part = (solver.t - times[0]) / (times[-1] - times[0])
            if made > most or (made >= SEEN and not seen and TOO_FAR * most * part < made):
                raise SolverError(
                    f"no exact solution: {made:,} steps of the solver come to {solver.t:.3g} s of {times[-1]:.3g} s, "
                    f"and it makes at most {most:,}"
                )
            seen, message = made >= SEEN, solver.step()
        if solver.status == "failed":
            raise SolverError(f"no exact solution: {message}")
        states.append(State(time, *solver.y.reshape(2, *shape)))
        if breaks is not None and len(breaks(states[-1])):
            break
    return states, max(solver.nfev // STAGES - len(states), 0)
