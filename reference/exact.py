"""Solutions that owe nothing to the schemes: closed forms, and the most accurate numbers to be had.

Where there is a formula it is used; else SciPy's Dormand-Prince method of order 8 with a tolerance of 1e-12.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from reference.assembly import DENSE_UP_TO, assemble, spring_blocks
from reference.changes import Change, changes_by_step
from reference.errors import InputError, SolverError
from reference.forces import SpringMotion
from reference.least_energy import force_tolerance, least_energy
from reference.motion import Motion
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem

TOLERANCE = 1e-12

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
    equations: Callable[[MassSpringSystem], Motion] = SpringMotion,
) -> Trajectory:
    """The true trajectory at the times 0, dt, 2 dt, ..., to about 1e-11 of its size while it is not chaotic.

    A parameter that changes does so at the start of the step it acts on, as it does for every stepper.

    Args:
        equations: what to make of the system; `pendulum.PendulumMotion` hangs rods in place of the springs.

    Raises:
        SolverError: if the solver gives up; for a system with obstacles.
    """
    if system.obstacles:
        raise SolverError(WHY_NOT_EXACT)
    pending = changes_by_step(changes, dt)
    starts = sorted({0, *(i for i in pending if i < steps)})
    motion = equations(system)
    states = [motion.start]
    for begin, end in zip(starts, [*starts[1:], steps], strict=True):
        for change in pending.get(begin, ()):
            system = system.with_parameter(change.parameter, change.value)
            motion = equations(system)
        times = np.array([dt * i for i in range(begin, end + 1)])
        states += _solve(motion, states[-1], times, system.size)
    return motion.trajectory(states)


def _solve(motion: Motion, state: State, times: Array, size: float) -> list[State]:
    """The states at times[1:], from the one at times[0], by DOP853 (Hairer, Norsett and Wanner I, II.5)."""
    from scipy.integrate import DOP853

    shape = state.positions.shape

    def derivative(t: float, y: Array) -> Array:
        x, v = y.reshape(2, *shape)
        return np.concatenate([v, motion.acceleration(State(t, x, v))], axis=None)

    start = np.concatenate([state.positions, state.velocities], axis=None)
    solver = DOP853(derivative, times[0], start, times[-1], rtol=TOLERANCE, atol=TOLERANCE * size)
    states = []
    for time in times[1:].tolist():
        # Steps end at every time asked for: what DOP853 interpolates in between is of a lower order, and was seen
        # 400 times less accurate where damping is strong.
        solver.t_bound, solver.status = time, "running"
        while solver.status == "running":
            message = solver.step()
        if solver.status == "failed":
            raise SolverError(f"no exact solution: {message}")
        states.append(State(time, *solver.y.reshape(2, *shape)))
    return states


def equilibrium(system: MassSpringSystem) -> State:
    """The state at rest in which all forces balance, reached by giving way from the start.

    In closed form for a string hanging down; else least energy by L-BFGS, then Newton's method to rounding. Of large
    systems see `least_energy`.

    Raises:
        SolverError: if there is none nearby (a free system falls for ever); for a system with obstacles.
    """
    if system.obstacles:
        raise SolverError("no equilibrium: with obstacles the forces need not balance, and a push is no small push")
    if system.is_string and system.stiffness.all() and not system.gravity[0] and not system.gravity[2:].any():
        return hanging_string(system)
    from scipy.optimize import minimize

    from reference.conserved import energy

    free = ~system.fixed
    if free.all() and system.gravity.any():
        raise SolverError("no equilibrium: nothing holds the system, it falls for ever")
    if free.sum() * system.dimension > DENSE_UP_TO:
        return least_energy(system)
    motion = SpringMotion(system)

    def at(coordinates: Array) -> State:
        positions = system.positions.copy()
        positions[free] = coordinates.reshape(-1, system.dimension)
        return State(0.0, positions, np.zeros_like(positions))

    def force(coordinates: Array) -> Array:
        pull = motion.acceleration(at(coordinates)) * system.masses[:, None]
        return np.asarray(pull[free].ravel())

    weight = float((system.masses[:, None] * np.abs(system.gravity)).sum()) or 1.0
    found = minimize(
        lambda q: energy(system, at(q)) / (weight * system.size),
        system.positions[free].ravel(),
        jac=lambda q: -force(q) / (weight * system.size),
        method="L-BFGS-B",
        options={"maxiter": 50_000, "maxfun": 100_000, "ftol": 1e-16, "gtol": 1e-9},
    )
    q = found.x
    for _ in range(30):
        stiffness = -assemble(system, spring_blocks(system, at(q))[0], sparse=False)
        change = np.linalg.lstsq(stiffness, force(q))[0]
        q = q + change
        if np.abs(change).max() < 1e-14 * system.size:
            break
    if not np.abs(force(q)).max() < force_tolerance(system, weight):
        raise SolverError("no equilibrium: the forces do not balance anywhere near the start")
    return at(q)


def hanging_string(system: MassSpringSystem) -> State:
    """The equilibrium of a string under its own weight: straight down, each spring carrying all that is below it.

    The length of spring j is L0_j + (m_{j+1} + ... + m_n) g / k_j.

    Raises:
        InputError: unless the system is a string in 2D, hung at its first mass, with stiffness everywhere.
    """
    n = len(system.positions)
    if not system.is_string or not system.stiffness.all() or system.dimension != 2 or system.gravity[0]:
        raise InputError(
            "system is no string: expected springs from each mass to the next, all with stiffness > 0, in 2D under "
            "gravity along the second axis"
        )
    below = np.cumsum(system.masses[:0:-1])[::-1]
    lengths = system.rest_lengths + below * -system.gravity[1] / system.stiffness
    positions = np.tile(system.positions[0], (n, 1))
    positions[1:, 1] -= np.cumsum(lengths)
    return State(0.0, positions, np.zeros_like(positions))


def squared_frequencies(system: MassSpringSystem, state: State, lowest: int | None = None) -> Array:
    """The squares w^2 [1/s^2] of the small oscillations about an equilibrium, rising, shape (free masses x d,).

    From K q = w^2 M q with K the derivative of the forces, damping and drag left out.

    Args:
        lowest: only so many, the slowest, by sparse matrices: for systems of thousands of masses that are held.
    """
    mass = np.repeat(system.masses[~system.fixed], system.dimension)
    if lowest is not None and lowest < len(mass) - 1:
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import eigsh

        stiffness = -assemble(system, spring_blocks(system, state)[0], sparse=True)
        # always the same start, and one that no symmetry keeps from any of them
        start = np.random.default_rng(0).normal(size=len(mass))
        return np.sort(eigsh(stiffness, lowest, diags_array(mass).tocsc(), sigma=0.0, v0=start)[0])
    from scipy.linalg import eigh

    stiffness = -assemble(system, spring_blocks(system, state)[0], sparse=False)
    values: Array = eigh(stiffness, np.diag(mass), eigvals_only=True)
    return values if lowest is None else values[:lowest]


def laguerre_frequencies(links: int, length: float, gravity: float) -> Array:
    """The squares w^2 [1/s^2] of the swings of n equal masses on n equal rods, rising, shape (n,).

    w^2 = (g/l) x_i with x_i the zeros of the Laguerre polynomial L_n: the hanging string's frequencies across itself
    in the limit of infinite stiffness (Lagrange, *Mecanique analytique*, 1788, on the loaded string).
    """
    from scipy.special import roots_laguerre

    zeros: Array = roots_laguerre(links)[0]
    return gravity / length * zeros
