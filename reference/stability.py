"""Stability, predicted: how a scheme's step answers a small push, and up to which dt the answer does not grow.

One step is a map z -> Phi(z) of the whole state z = (positions, dt velocities). About an equilibrium a small push dz
becomes J dz, with J the Jacobian of Phi. Pushes do not grow while all eigenvalues of J lie within the unit circle
(Hairer and Wanner II, IV.2). This asks nothing about how a step is made: in-place variants have a J like any other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reference import catalogue, exact
from reference.assembly import Blocks, assemble, spring_blocks
from reference.catalogue import Scheme
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.motion import Motion
from reference.pendulum import PendulumMotion
from reference.rope import RopeMotion
from reference.state import Array, Slope, State
from reference.system import BoolArray, MassSpringSystem

#: An eigenvalue this little over 1 may be rounding.
MARGIN = 1e-9

#: An eigenvalue this near to 1 is of motion that nothing resists.
UNRESISTED = 1e-6

#: How often dt is doubled or halved in search of a limit. Far beyond 1/w, eigenvalues near -1 are lost in rounding.
UP, DOWN = 5, 22

#: A limit is found to this part of itself. Where two eigenvalues meet on the unit circle none is known much better.
PRECISION = 1e-7


@dataclass(frozen=True)
class Equilibrium:
    """A system at rest, ready to be pushed.

    Attributes:
        motion: its equations.
        state: at rest, all forces in balance.
        free: which rows of the state can move.
        scale: a length [m] (for a pendulum an angle [rad]) that pushes are to be small against.
    """

    motion: Motion
    state: State
    free: BoolArray
    scale: float


def spring_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """Where a mesh of springs comes to rest. Raises SolverError if it never does."""
    free = ~system.fixed
    return Equilibrium(SpringMotion(system), exact.equilibrium(system), free, float(system.rest_lengths.min()))


def pendulum_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """All rods along gravity."""
    motion = PendulumMotion(system)
    angles = np.full(len(system.springs), np.arctan2(system.gravity[0], -system.gravity[1]))
    return Equilibrium(motion, State(0.0, angles, np.zeros_like(angles)), np.ones(len(angles), dtype=bool), 1.0)


def rope_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """The same, in the masses' own coordinates."""
    hanging = pendulum_equilibrium(system)
    (positions,) = hanging.motion.trajectory([hanging.state]).positions
    state = State(0.0, positions, np.zeros_like(positions))
    return Equilibrium(RopeMotion(system), state, ~system.fixed, float(system.rest_lengths.min()))


def equilibrium(equations: Callable[[MassSpringSystem], Motion], system: MassSpringSystem) -> Equilibrium:
    """Where a system comes to rest by its equations of motion."""
    known: Mapping[object, Callable[[MassSpringSystem], Equilibrium]] = {
        PendulumMotion: pendulum_equilibrium,
        RopeMotion: rope_equilibrium,
    }
    return known.get(equations, spring_equilibrium)(system)


def step_jacobian(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """J over the free positions and dt x velocities: exactly where the scheme allows, else by differences.

    A scheme that asks for accelerations only, of all masses or of one at a time, is linear in them; so is one that
    solves equations whose coefficients a push changes by little, where rates at rest are zero.
    Given the linearised equations and the identity matrix in place of a state, its own function returns J.
    """
    allowed = not scheme.springs_only or scheme.kind == "in_place" or scheme.solves
    linear = isinstance(rest.motion, SpringMotion) and allowed
    return _by_linear_motion(scheme, rest, dt) if linear else _by_differences(scheme, rest, dt)


class LinearMotion:
    """The equations of motion about an equilibrium, linearised: of many small pushes at once, one per column.

    States have shape (n, d, columns), pushes from the equilibrium and their velocities.
    """

    def __init__(self, system: MassSpringSystem, equilibrium: State) -> None:
        self.system, self._equilibrium = system, equilibrium
        free = np.repeat(~system.fixed, system.dimension)
        mass = np.repeat(system.masses, system.dimension)[free, None]
        self._by_position, self._by_velocity = (np.zeros((len(free), len(free))) for _ in range(2))
        by_position, by_velocity = spring_blocks(system, equilibrium)
        self._by_position[np.ix_(free, free)] = assemble(system, by_position, sparse=False) / mass
        self._by_velocity[np.ix_(free, free)] = assemble(system, by_velocity, sparse=False) / mass
        self._drag = np.where(system.fixed, 0.0, system.drag / system.masses)[:, None, None]

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """Of all masses; without the damping of the springs if so asked."""
        if damping:
            return self._of_rows(slice(None), state).reshape(state.positions.shape)
        moved = self._by_position @ state.positions.reshape(len(self._by_position), -1)
        return np.asarray(moved.reshape(state.positions.shape) - self._drag * state.velocities)

    def placed(self, state: State) -> State:
        """Where springs have their directions: at rest, whatever the pushes."""
        return self._equilibrium

    def jacobians(self, state: State) -> tuple[Blocks, Blocks]:
        """The derivatives of the forces by positions [N/m] and velocities [N s/m], at rest whatever the pushes."""
        return spring_blocks(self.system, self._equilibrium)

    def acceleration_of(self, i: int, state: State) -> Array:
        """Of mass i alone."""
        d = state.positions.shape[1]
        return self._of_rows(slice(i * d, i * d + d), state)

    def slope(self, state: State) -> Slope:
        """(1, x', x'')."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def _of_rows(self, rows: slice, state: State) -> Array:
        x, v = (q.reshape(len(self._by_position), -1) for q in (state.positions, state.velocities))
        return self._by_position[rows] @ x + self._by_velocity[rows] @ v


def _by_linear_motion(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    assert isinstance(rest.motion, SpringMotion)
    n, d = rest.state.positions.shape
    count = int(rest.free.sum()) * d
    x, v = (np.zeros((n, d, 2 * count)) for _ in range(2))
    x[rest.free] = np.eye(count, 2 * count).reshape(-1, d, 2 * count)
    v[rest.free] = np.eye(count, 2 * count, count).reshape(-1, d, 2 * count) / dt
    end = scheme.step(LinearMotion(rest.motion.system, rest.state), State(0.0, x, v), dt)
    moved = [q[rest.free].reshape(count, -1) for q in (end.positions, dt * end.velocities)]
    return np.concatenate(moved)


def _by_differences(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """Central differences of fourth order.

    Their truncation goes as push^4 and their rounding as 1/push; at the fifth root of rounding both are about 1e-12.
    """
    shape = rest.state.positions[rest.free].shape
    count = int(np.prod(shape))
    push = np.finfo(float).eps ** 0.2 * rest.scale

    def after(z: Array) -> Array:
        x, v = rest.state.positions.copy(), rest.state.velocities.copy()
        x[rest.free] += z[:count].reshape(shape)
        v[rest.free] += z[count:].reshape(shape) / dt
        end = scheme.step(rest.motion, State(0.0, x, v), dt)
        return np.concatenate([end.positions[rest.free], dt * end.velocities[rest.free]], axis=None)

    pushes = push * np.eye(2 * count)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        columns = [8 * (after(z) - after(-z)) - (after(2 * z) - after(-2 * z)) for z in pushes]
    return np.stack(columns, axis=1) / (12 * push)


def spectral_radius(jacobian: Array) -> float:
    """The largest modulus of an eigenvalue: by how much the worst push grows in a step, in the long run.

    Eigenvalues of 1 are left out. They are of motion that no force resists, which goes on as it is pushed; they come in
    pairs, and rounding tears a pair apart by its own root.
    """
    if not np.isfinite(jacobian).all():
        return np.inf
    values = np.linalg.eigvals(jacobian)
    return float(np.abs(values[np.abs(values - 1) > UNRESISTED]).max(initial=1.0 - UNRESISTED))


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def growth(scheme: Scheme, rest: Equilibrium, dt: float) -> float:
    """The spectral radius of a scheme's step."""
    try:
        return spectral_radius(step_jacobian(scheme, rest, dt))
    except SolverError:
        return np.inf


def fastest_rate(rest: Equilibrium) -> float:
    """The largest modulus of an eigenvalue of the equations of motion [1/s]: the highest frequency, or fastest decay.

    Euler's step of an equation z' = A z is 1 + dt A, exactly: its Jacobian has all of A in it.
    """
    euler = catalogue.find("euler")
    dt = 1e-3
    for _ in range(3):
        rates = (np.linalg.eigvals(step_jacobian(euler, rest, dt)) - 1) / dt
        fastest = float(np.abs(rates).max())
        if fastest == 0:
            break
        # Once more with a step that suits it, so that neither positions nor velocities drown in the other.
        dt = 1 / fastest
    return fastest


@dataclass(frozen=True)
class Limit:
    """Up to which dt pushes do not grow.

    Attributes:
        dt: the limit [s]; None where there is none.
        reason: why there is none; empty where there is one.
        growth: where pushes grow at any dt, how much they do in a step of a tenth of the fastest mode's 1/w.
    """

    dt: float | None
    reason: str = ""
    growth: float | None = None


def stability_limit(scheme: Scheme, rest: Equilibrium) -> Limit:
    """The predicted limit of a scheme about an equilibrium: the dt below which pushes do not grow."""
    fastest = fastest_rate(rest)
    if fastest == 0:
        return Limit(None, "nothing moves")
    return find_limit(lambda dt: growth(scheme, rest, dt) - 1, 1 / fastest)


def find_limit(
    excess: Callable[[float], float], dt: float, margin: float = MARGIN, precision: float = PRECISION
) -> Limit:
    """The limit where an excess of growth over 1 in a step rises above a margin, from any dt about as long as a mode.

    Where pushes grow at any dt the excess falls as a power of dt, and the margin is crossed on a slope; at a true
    limit there is nothing but rounding below it.
    """
    unit = dt

    def unstable(h: float) -> bool:
        # Beyond the fastest mode's 1/w, positions and dt x velocities are of different sizes, and so is rounding.
        return excess(h) > margin * max(1.0, h / unit)

    high, low = _bracket(unstable, 3 * unit)
    if high is None:
        return Limit(None, f"stable at any dt that was tried, up to {low:.3g} s")
    if low is not None:
        low, high = _bisect(unstable, low, high, 0.02)
    if low is None or excess(0.9 * low) > 0.1 * margin:
        rate = excess(0.1 * unit)
        return Limit(None, f"unstable at any dt: grows by {rate:.2g} of itself in a step of {0.1 * unit:.2g} s", rate)
    low, high = _bisect(unstable, low, high, precision)
    return Limit(low)


def _bracket(unstable: Callable[[float], bool], dt: float) -> tuple[float | None, float | None]:
    """(an unstable dt, a stable one below it), by doubling or halving; None for what is not found."""
    if not unstable(dt):
        for _ in range(UP):
            dt *= 2
            if unstable(dt):
                return dt, dt / 2
        return None, dt
    for _ in range(DOWN):
        dt /= 2
        if not unstable(dt):
            return 2 * dt, dt
    return 2 * dt, None


def _bisect(unstable: Callable[[float], bool], low: float, high: float, precision: float) -> tuple[float, float]:
    while high - low > precision * low:
        middle = (low + high) / 2
        low, high = (low, middle) if unstable(middle) else (middle, high)
    return low, high


def string_mode(masses: int) -> float:
    """Lambda of the fastest mode of a string along itself, w^2 = (k/m) lambda: 4 sin^2((2n-1) pi / (4n+2))."""
    return float(4 * np.sin((2 * masses - 1) * np.pi / (4 * masses + 2)) ** 2)


def explicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with explicit damping, of a mode x'' + gamma x' + omega^2 x = 0: h^2 w^2 + 2 gamma h < 4."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) - gamma) / omega**2)


def implicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with implicit damping: h^2 w^2 < 4 + 2 gamma h."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) + gamma) / omega**2)
