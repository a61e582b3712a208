"""More Runge-Kutta methods that people write: known by name, run where they are asked for (`catalogue.wide_schemes`).

HNW is Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I* (1993).
"""

from __future__ import annotations

from reference.motion import Motion
from reference.schemes.catalogue import scheme
from reference.state import State


@scheme(order=2, kind="wide_scheme")
def explicit_midpoint(motion: Motion, state: State, dt: float) -> State:
    """Explicit midpoint: the slope half-way, by half an Euler step (Runge 1895; HNW II.1)."""
    return state + dt * motion.slope(state + dt / 2 * motion.slope(state))


@scheme(order=2, kind="wide_scheme")
def ralston(motion: Motion, state: State, dt: float) -> State:
    """Ralston: slopes here and two thirds on, weighted 1/4 and 3/4 (Ralston, Math. Comp. 16, 1962)."""
    first = motion.slope(state)
    second = motion.slope(state + 2 * dt / 3 * first)
    return state + dt / 4 * (first + 3 * second)


@scheme(order=3, kind="wide_scheme")
def rk3(motion: Motion, state: State, dt: float) -> State:
    """Kutta's third-order method: Simpson's rule with weights 1, 4, 1 (Kutta 1901; HNW II.1)."""
    first = motion.slope(state)
    second = motion.slope(state + dt / 2 * first)
    third = motion.slope(state + dt * (-1 * first + 2 * second))
    return state + dt / 6 * (first + 4 * second + third)


@scheme(order=3, kind="wide_scheme")
def ssprk3(motion: Motion, state: State, dt: float) -> State:
    """The strong-stability-preserving method of three stages (Shu and Osher, J. Comput. Phys. 77, 1988)."""
    first = motion.slope(state)
    second = motion.slope(state + dt * first)
    third = motion.slope(state + dt / 4 * (first + second))
    return state + dt / 6 * (first + second + 4 * third)


@scheme(order=3, kind="wide_scheme")
def bogacki_shampine(motion: Motion, state: State, dt: float) -> State:
    """Bogacki and Shampine's third-order method, without its error estimate (Appl. Math. Lett. 2, 1989)."""
    first = motion.slope(state)
    second = motion.slope(state + dt / 2 * first)
    third = motion.slope(state + 3 * dt / 4 * second)
    return state + dt / 9 * (2 * first + 3 * second + 4 * third)


@scheme(order=4, kind="wide_scheme")
def rk4_three_eighths(motion: Motion, state: State, dt: float) -> State:
    """The 3/8 rule: four slopes, at thirds of the step, weighted 1, 3, 3, 1 (Kutta 1901; HNW II.1)."""
    first = motion.slope(state)
    second = motion.slope(state + dt / 3 * first)
    third = motion.slope(state + dt * (-1 / 3 * first + second))
    fourth = motion.slope(state + dt * (first + -1 * second + third))
    return state + dt / 8 * (first + 3 * second + 3 * third + fourth)


@scheme(order=5, kind="wide_scheme")
def dormand_prince(motion: Motion, state: State, dt: float) -> State:
    """Dormand and Prince's fifth-order method, without its error estimate (J. Comput. Appl. Math. 6, 1980)."""
    k1 = motion.slope(state)
    k2 = motion.slope(state + dt / 5 * k1)
    k3 = motion.slope(state + dt * (3 / 40 * k1 + 9 / 40 * k2))
    k4 = motion.slope(state + dt * (44 / 45 * k1 + -56 / 15 * k2 + 32 / 9 * k3))
    k5 = motion.slope(state + dt * (19372 / 6561 * k1 + -25360 / 2187 * k2 + 64448 / 6561 * k3 + -212 / 729 * k4))
    k6 = motion.slope(
        state + dt * (9017 / 3168 * k1 + -355 / 33 * k2 + 46732 / 5247 * k3 + 49 / 176 * k4 + -5103 / 18656 * k5)
    )
    return state + dt * (35 / 384 * k1 + 500 / 1113 * k3 + 125 / 192 * k4 + -2187 / 6784 * k5 + 11 / 84 * k6)
