"""What a step makes of one spring: its matrix, and the k and c of the spring that does just that without steps.

The elongation r of a spring and its rate obey m r'' + c r' + k r = 0. A step of dt whose two eigenvalues are z1, z2
does what such a spring does in dt with the roots u = log(z)/dt: k = m u1 u2, c = -m (u1 + u2).
"""

from __future__ import annotations

import numpy as np

from engines.translation.translation import Spring
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.schemes.catalogue import find
from reference.state import Array, State
from reference.system import MassSpringSystem

#: At rest [m], and by how much it is stretched: along a line every step is linear, so the amount does not matter.
LENGTH, STRETCH = 1.0, 0.1

#: Growth in a step that is no rounding.
ROUNDING = 1e-9

#: The search for the largest stable dt: from this part of the fastest time of the spring, by this ratio, to so many.
SHORTEST, RATIO, FARTHEST = 0.02, 1.25, 1e4


def system_of(spring: Spring, dimension: int = 1) -> MassSpringSystem:
    """The spring, stretched by STRETCH and at rest, without gravity; its first end is `other`."""
    positions = np.zeros((2, dimension))
    positions[1, 0] = LENGTH + STRETCH
    return MassSpringSystem(
        positions=positions,
        springs=np.array([[0, 1]]),
        masses=np.array([spring.other or spring.mass, spring.mass]),
        rest_lengths=np.array(LENGTH),
        stiffness=np.array(spring.stiffness),
        damping=np.array(spring.damping),
        gravity=np.zeros(dimension),
        fixed=np.array([spring.other is None, False]),
    )


def step_matrix(scheme: str, spring: Spring, dt: float) -> Array:
    """The matrix of a step over (r, dt r', what a warm start keeps), shape (2, 2) or (3, 3).

    Raises:
        SolverError: if the scheme finds no solution.
    """
    known = find(scheme)
    system = system_of(spring)
    step = known.on(SpringMotion(system))
    shares = np.array([-1 / spring.other if spring.other else 0.0, 1 / spring.mass]) * spring.effective_mass
    size = 2 if known.one_step else 3

    def after(z: Array) -> Array:
        x = np.array([[0.0], [LENGTH]]) + z[0] * shares[:, None]
        v = z[1] / dt * shares[:, None]
        end = step(State(0.0, x, v, () if size == 2 else (z[2:],)), dt)
        r, rate = float(end.positions[1, 0] - end.positions[0, 0]), float(end.velocities[1, 0] - end.velocities[0, 0])
        return np.array([r - LENGTH, dt * rate, *(end.memory[0] if size == 3 else ())])

    with np.errstate(all="ignore"):
        return np.stack([(after(STRETCH * z) - after(-STRETCH * z)) / (2 * STRETCH) for z in np.eye(size)], axis=1)


def spring_of_step(matrix: Array, spring: Spring, dt: float) -> tuple[float, float] | None:
    """The k [N/m] and c [N s/m] that a step is of; None where no spring does what it does."""
    values = np.linalg.eigvals(matrix).astype(complex)
    return spring_of_values(values[np.argsort(-np.abs(values), kind="stable")][:2], spring.effective_mass, dt)


def spring_of_values(
    values: np.ndarray[tuple[int, ...], np.dtype[np.complex128]], mass: float, dt: float
) -> tuple[float, float] | None:
    """Of the two eigenvalues of a step. A negative one turns a spring over in every step, which no k and c do."""
    if not np.isfinite(values).all() or (np.abs(values) < 1e-12).any():
        return None
    if (np.abs(values.imag) < 1e-12).all() and (values.real < 0).any():
        return None
    rates = np.log(values) / dt
    return float((mass * rates[0] * rates[1]).real), float((-mass * (rates[0] + rates[1])).real)


def grows(scheme: str, spring: Spring, dt: float) -> bool:
    """Whether a perturbation grows in steps of dt [s]."""
    try:
        matrix = step_matrix(scheme, spring, dt)
    except SolverError:
        return True
    return not np.isfinite(matrix).all() or float(np.abs(np.linalg.eigvals(matrix)).max()) > 1 + ROUNDING


def largest_stable_dt(scheme: str, spring: Spring) -> float | None:
    """The first limit [s], from short steps on; None where no step that was looked at grows."""
    from reference.bisection import bisect

    fastest = spring.omega + spring.damping / spring.effective_mass
    dt = SHORTEST / fastest
    while not grows(scheme, spring, RATIO * dt):
        dt *= RATIO
        if dt > FARTHEST / fastest:
            return None
    low, high = bisect(lambda h: grows(scheme, spring, h), dt, RATIO * dt, lambda low, high: high - low <= 1e-7 * low)
    return (low + high) / 2
