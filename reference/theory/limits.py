"""Stability, predicted: up to which dt perturbations of an equilibrium do not grow under a scheme.

They do not while all eigenvalues of the step map's Jacobian lie within the unit circle (Hairer and Wanner, *Solving
Ordinary Differential Equations II* (1996), IV.2).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.bisection import bisect
from reference.errors import SolverError
from reference.growth_factor import growth_factor
from reference.limit import Limit
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.theory.equilibria import Equilibrium
from reference.theory.step_map import step_jacobian

#: An eigenvalue this little over 1 may be rounding.
MARGIN = 1e-9

#: How often dt is doubled or halved in search of a limit. Far beyond 1/w, eigenvalues near -1 are lost in rounding.
UP, DOWN = 5, 22

#: A limit is found to this part of itself. Where two eigenvalues meet on the unit circle none is known much better.
PRECISION = 1e-7


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def growth(scheme: Scheme, rest: Equilibrium, dt: float) -> float:
    """The growth factor of a scheme's step."""
    try:
        return growth_factor(step_jacobian(scheme, rest, dt))
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


def stability_limit(scheme: Scheme, rest: Equilibrium) -> Limit:
    """The predicted limit of a scheme about an equilibrium: the dt below which perturbations do not grow."""
    fastest = fastest_rate(rest)
    if fastest == 0:
        return Limit(None, "nothing moves")
    return find_limit(lambda dt: growth(scheme, rest, dt) - 1, 1 / fastest)


def find_limit(
    excess: Callable[[float], float], dt: float, margin: float = MARGIN, precision: float = PRECISION
) -> Limit:
    """The limit where an excess of growth over 1 in a step rises above a margin, from any dt about as long as a mode.

    Where perturbations grow at any dt the excess falls as a power of dt, and the margin is crossed on a slope; at a
    true limit there is nothing but rounding below it.
    """
    unit = dt

    def unstable(h: float) -> bool:
        # Beyond the fastest mode's 1/w, positions and dt x velocities are of different sizes, and so is rounding.
        return excess(h) > margin * max(1.0, h / unit)

    high, low = _bracket(unstable, 3 * unit)
    if high is None:
        return Limit(None, f"stable at any dt that was tried, up to {low:.3g} s")
    if low is not None:
        low, high = bisect(unstable, low, high, _within(0.02))
    if low is None or excess(0.9 * low) > 0.1 * margin:
        rate = excess(0.1 * unit)
        return Limit(None, f"unstable at any dt: grows by {rate:.2g} of itself in a step of {0.1 * unit:.2g} s", rate)
    low, high = bisect(unstable, low, high, _within(precision))
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


def _within(part: float) -> Callable[[float, float], bool]:
    return lambda low, high: high - low <= part * low


def explicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with explicit damping, of a mode x'' + gamma x' + omega^2 x = 0: h^2 w^2 + 2 gamma h < 4."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) - gamma) / omega**2)


def implicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with implicit damping: h^2 w^2 < 4 + 2 gamma h."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) + gamma) / omega**2)
