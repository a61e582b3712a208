"""The semi-implicit schemes engines use for damped springs: forces explicit, damping of the springs implicit.

All kick the velocities by the undamped forces to v*, then slow them down along the springs, so that

    (M + dt C) v = M v*,    C = sum over springs of c_j J_j^T J_j,   J_j v = the rate at which spring j gets longer.

They differ in when positions move, in what they put for c_j, and in how far they solve. Without damping they are
`kick_drift` and `drift_kick` to the bit. Which engine does which is said by `springlab list` and shown by the tests.
"""

from __future__ import annotations

import numpy as np

from reference.assembly import Blocks, assemble, damping_blocks, damping_of, solve_velocities
from reference.jit import compiled
from reference.lengths import divisors
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.schemes.conjugate_residual import conjugate_residual
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem

#: Pymunk's default number of rounds over the springs in a step.
ROUNDS = 10


@scheme(order=1, kind="engine_scheme", implicit=True)
def kick_drift_implicit_damping(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift with the damping of the springs implicit (Baraff and Witkin, SIGGRAPH 1998, for damping alone)."""
    kicked = state.kick(dt * motion.acceleration(state, damping=False))
    return slowed(motion, kicked, dt * damping_of(motion.system, motion.placed(kicked))).drift(dt)


@scheme(order=1, kind="engine_scheme", implicit=True, linear=False)
def kick_drift_implicit_drag(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift with the drag implicit and the damping of the springs explicit.

    (m + dt Cd) (v1 - v0) = dt f(x0, v0): MuJoCo's Euler step as it comes.
    """
    slower = 1 + dt * motion.system.drag / motion.system.masses[:, None]
    return state.kick(dt * motion.acceleration(state) / slower).drift(dt)


@scheme(order=1, kind="engine_scheme", implicit=True)
def kick_drift_implicit_damping_and_drag(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift with everything that depends on velocities implicit, damping of the springs and drag.

    (M + dt C) (v1 - v0) = dt f(x0, v0) with C the whole damping matrix: MuJoCo's `implicit` integrator.
    """
    system = motion.system
    blocks = damping_blocks(
        system, motion.placed(state), dt * damping_of(system, motion.placed(state))
    ) + Blocks.of_masses(system, dt * system.drag)
    return state.kick(dt * solve_velocities(system, blocks, motion.acceleration(state))).drift(dt)


@scheme(order=1, kind="engine_scheme", implicit=True, linear=False, iterated=True)
def kick_drift_truncated_damping(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift with implicit damping that is solved to 1e-8 m/s only, by conjugate residuals.

    Bullet's way, to the rounding: unlike the exact solve it does nothing at all where the first residual is that small.
    """
    system = motion.system
    kicked = state.kick(dt * motion.acceleration(state, damping=False))
    if not system.damping.any():
        return kicked.drift(dt)
    free = ~system.fixed
    mass = np.repeat(system.masses[free], system.dimension)
    damping = assemble(system, -dt * damping_blocks(system, state, damping_of(system, state)))
    diagonal = mass + damping.diagonal()
    change = np.zeros_like(kicked.velocities)
    change[free] = conjugate_residual(
        lambda v: mass * v + damping @ v,
        -(damping @ kicked.velocities[free].ravel()),
        lambda residual: residual / diagonal,
    ).reshape(-1, system.dimension)
    return kicked.kick(change).drift(dt)


@scheme(order=1, kind="engine_scheme", implicit=True)
def drift_kick_implicit_damping(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Drift-kick with the damping of the springs implicit."""
    drifted = state.drift(dt)
    kicked = drifted.kick(dt * motion.acceleration(drifted, damping=False))
    return slowed(motion, kicked, dt * damping_of(motion.system, motion.placed(kicked)))


@scheme(order=1, kind="engine_scheme", iterated=True)
def drift_kick_sequential_damping(motion: MotionOfSprings, state: State, dt: float, *, rounds: int = ROUNDS) -> State:
    """Drift-kick, then rounds of damping spring by spring in their order: sequential impulses.

    Each spring in turn gives up the part 1 - exp(-dt c / m) of what its elongation rate is off its target, zero at
    first, and remembers the rate that leaves as its new target: later rounds take only what its neighbours have put
    back. With ten `rounds` (Pymunk's default) the order of the springs shows where damping is strong. Sequential
    impulses: Catto, GDC 2006; as in Chipmunk's cpDampedSpring.
    """
    drifted = state.drift(dt)
    kicked = drifted.kick(dt * motion.acceleration(drifted, damping=False))
    system = motion.system
    if not system.damping.any():
        return kicked
    directions = spring_directions(system, motion.placed(kicked))
    mass = effective_masses(system)
    part = -np.expm1(-dt * damping_of(system, motion.placed(kicked)) / mass)
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    velocities = kicked.velocities.reshape(*system.positions.shape, -1).copy()
    damp_in_order(velocities, system.springs, directions, inverse, mass, part, rounds)
    return State(kicked.time, kicked.positions, velocities.reshape(kicked.velocities.shape))


@scheme(order=1, kind="engine_scheme", implicit=True)
def drift_kick_exponential_damping(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Drift-kick, springs damped as if each alone decayed exponentially: dt c becomes m (exp(dt c / m) - 1).

    m is the spring's effective mass, 1 / (1/m_a + 1/m_b). Two masses and one spring slow down by exactly
    exp(-dt c / m), whatever dt. This is what `drift_kick_sequential_damping` converges to with more rounds.
    """
    drifted = state.drift(dt)
    kicked = drifted.kick(dt * motion.acceleration(drifted, damping=False))
    mass, damping = effective_masses(motion.system), damping_of(motion.system, motion.placed(kicked))
    return slowed(motion, kicked, mass * np.expm1(dt * damping / mass))


def sequential_impulses(
    v: Array,
    springs: IntArray,
    directions: Array,
    inverse_masses: Array,
    effective: Array,
    part: Array,
    rounds: int,
) -> None:
    """Slow the velocities v down in place, spring after spring, `rounds` times over.

    Args:
        v: of many states at once, one per column, shape (n, d, columns).
    """
    target = np.zeros((len(springs), v.shape[2]))
    for _ in range(rounds):
        for j in range(len(springs)):
            a, b = springs[j, 0], springs[j, 1]
            for column in range(v.shape[2]):
                rate = 0.0
                for axis in range(v.shape[1]):
                    rate += (v[b, axis, column] - v[a, axis, column]) * directions[j, axis]
                taken = (rate - target[j, column]) * part[j]
                target[j, column] = rate - taken
                for axis in range(v.shape[1]):
                    impulse = effective[j] * taken * directions[j, axis]
                    v[a, axis, column] += inverse_masses[a] * impulse
                    v[b, axis, column] -= inverse_masses[b] * impulse


(damp_in_order,) = compiled(sequential_impulses)


def slowed(motion: MotionOfSprings, state: State, coefficients: Array) -> State:
    """The state after an implicit step of damping alone: dt c_j [N s^2/m = kg] given for every spring, shape (s,)."""
    if not coefficients.any():
        return state
    blocks = damping_blocks(motion.system, motion.placed(state), coefficients)
    velocities = solve_velocities(motion.system, blocks, state.velocities)
    return State(state.time, state.positions, velocities)


def effective_masses(system: MassSpringSystem) -> Array:
    """1 / (1/m_a + 1/m_b) of the masses each spring joins [kg], shape (s,); a fixed mass counts as infinite."""
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    a, b = system.springs.T
    both = inverse[a] + inverse[b]
    # Between two fixed masses any number will do: no impulse moves them.
    return np.divide(1.0, both, out=np.ones_like(both), where=both > 0)


def spring_directions(system: MassSpringSystem, state: State) -> Array:
    """The unit vector from each spring's first mass to its second, shape (s, d)."""
    a, b = system.springs.T
    separation = state.positions[b] - state.positions[a]
    return separation / divisors(np.linalg.norm(separation, axis=1), system.rest_lengths)[:, None]
