"""A scheme's stability limit, measured: it is run from rest perturbed along one mode, and that mode is watched.

Theory says which mode it is, the eigenvector of the step's Jacobian whose eigenvalue is largest, and where to look.
What becomes of it is seen in a run of the scheme itself, a little below the predicted limit, a little above, and
between. In one mode alone growth of a millionth in a step shows within some hundred steps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from reference.bisection import bisect
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.limit import Limit
from reference.measured_stability import GROWN, PERTURBATION, mode_growth
from reference.schemes.catalogue import Scheme
from reference.simulate import projected
from reference.state import Array, State
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of
from reference.theory.parts import falling_velocities
from reference.theory.rates import Rates
from reference.theory.step_map import resisted, settled_state, step_jacobian

#: How many steps a mode is watched.
STEPS = 120

#: What a run shows of growth in a step where there is none: rounding, and what is not linear.
MARGIN = 1e-8

#: Growth that is told from none for certain.
SEEN = 3 * MARGIN

#: How far from a predicted limit it is looked first, as a part of it, and by what that widens; the measured precision.
NEAR, WIDER, WIDEST, PRECISION = 1e-4, 10.0, 0.5, 4e-5

#: Where no limit is predicted a run is made at these parts of the fastest mode's 1/w.
TRIED = (0.1, 1.0, 10.0)

#: States of more numbers than that are not perturbed along a mode: it takes all of the Jacobian.
WHOLE_UP_TO = 700


@dataclass(frozen=True)
class FastestMode:
    """The mode of a scheme's step that grows fastest, as vectors (`step_map.Layout`).

    Attributes:
        shape: the real part of the eigenvector.
        left: the left eigenvector, which tells the mode from all others.
        growth: the eigenvalue's modulus less 1.
    """

    shape: Array
    left: Array
    growth: float


def measured_mode_limit(scheme: Scheme, rest: Equilibrium, predicted: Limit, found: Rates) -> Limit:
    """The dt up to which a scheme, run from a perturbation along its fastest mode, does not let it grow.

    Args:
        predicted: where theory expects it.
        found: the eigenvalues of the motion.
    """
    if found.fastest == 0:
        return Limit(None, predicted.reason)
    if layout_of(scheme, rest, 1 / found.fastest)[0].size > WHOLE_UP_TO:
        return Limit(None, f"not measured: of more than {WHOLE_UP_TO} positions and velocities no mode is taken apart")

    def unstable(dt: float) -> bool:
        return measured_mode_growth(scheme, rest, dt, found) > MARGIN

    if predicted.dt is None and rest.contacts is not None:
        return Limit(None, predicted.reason)
    if predicted.dt is None or not predicted.exact:
        return _without_expectation(scheme, rest, found)
    if predicted.note:
        return Limit(None, f"not measured: {predicted.note}")
    mode = fastest_mode_of_step(scheme, rest, (1 + NEAR) * predicted.dt, found)
    if mode is not None and mode.growth < SEEN:
        beyond = f"growth at {1 + NEAR:g} of the predicted limit is {mode.growth:.1g} a step"
        return Limit(None, f"not measured: {beyond}, too slow for a run of {STEPS} steps")
    low, high = _around(unstable, predicted.dt)
    if low is None or high is None:
        where = f"{(1 - WIDEST) * predicted.dt:.4g} and {(1 + WIDEST) * predicted.dt:.4g} s"
        return Limit(None, f"no limit between {where}: runs are {'stable' if high is None else 'unstable'} at both")
    measured = (_window(unstable, *window, predicted.looked_to) for window in predicted.windows)
    windows = tuple(window for window in measured if window is not None)
    return Limit((low + high) / 2, windows=windows, looked_to=predicted.looked_to)


def _around(unstable: Callable[[float], bool], dt: float) -> tuple[float | None, float | None]:
    """A stable dt and an unstable one above it, PRECISION apart, around an expected limit; None for a missing one."""
    part = NEAR
    low: float | None = None
    high: float | None = None
    while part <= WIDEST and (low is None or high is None):
        low = low or (None if unstable((1 - part) * dt) else (1 - part) * dt)
        high = high or ((1 + part) * dt if unstable((1 + part) * dt) else None)
        part *= WIDER if part * WIDER <= WIDEST or part == WIDEST else WIDEST / part
    if low is None or high is None:
        return low, high
    return bisect(unstable, low, high, lambda low, high: high - low <= PRECISION * low)


def _window(unstable: Callable[[float], bool], low: float, high: float, looked_to: float) -> tuple[float, float] | None:
    """A window of stability, measured: its ends where they are expected; None where runs are unstable inside.

    Where it ends because no further was looked, no end is measured: runs there are to be stable still.
    """
    if unstable((low + high) / 2):
        return None
    _, first = bisect(lambda dt: not unstable(dt), 0.99 * low, (low + high) / 2, _near)
    if high >= looked_to and not unstable(high):
        return first, high
    last, _ = bisect(unstable, (low + high) / 2, 1.01 * high, _near)
    return first, last


def _near(low: float, high: float) -> bool:
    return high - low <= PRECISION * high


def _without_expectation(scheme: Scheme, rest: Equilibrium, found: Rates) -> Limit:
    """What runs show where no one limit is predicted: growth at every dt that is tried, or at none."""
    growths, unsolved = _growths_tried(scheme, rest, found)
    shortest = TRIED[0]
    if shortest not in growths:
        return Limit(None, f"not measured: {unsolved}")
    if growths[shortest] > MARGIN:
        rate = float(growths[shortest])
        return Limit(
            None, f"unstable at {shortest / found.fastest:.2g} s: grows by {rate:.2g} of itself in a step", rate
        )
    grown = [part for part in growths if growths[part] > MARGIN]
    if grown:
        return Limit(None, f"stable at {shortest / found.fastest:.2g} s, unstable at {grown[0] / found.fastest:.2g} s")
    tried = ", ".join(f"{part / found.fastest:.2g}" for part in growths)
    return Limit(None, f"stable at {tried} s; {unsolved}" if unsolved else f"stable at all of {tried} s")


def _growths_tried(scheme: Scheme, rest: Equilibrium, found: Rates) -> tuple[dict[float, float], str]:
    """What runs show at the parts TRIED, up to the first at which a step's equations are not solved, and what that is.

    A solver that gives up is no growth: what it gives up at says nothing about stability.
    """
    growths: dict[float, float] = {}
    for part in TRIED:
        dt = part / found.fastest
        try:
            growths[part] = _growth_of_run(scheme, rest, dt, found)
        except SolverError as error:
            return growths, f"at {dt:.2g} s its equations were not solved: {error}"
    return growths, ""


def measured_mode_growth(scheme: Scheme, rest: Equilibrium, dt: float, found: Rates) -> float:
    """By how much of itself the fastest mode grows in a step [1]; infinite where the scheme comes to no next state."""
    try:
        return _growth_of_run(scheme, rest, dt, found)
    except SolverError:
        return np.inf


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _growth_of_run(scheme: Scheme, rest: Equilibrium, dt: float, found: Rates) -> float:
    """The same; raises SolverError where the scheme's equations are not solved."""
    try:
        mode = fastest_mode_of_step(scheme, rest, dt, found)
        return np.inf if mode is None else mode_growth(np.array([*offsets(scheme, rest, dt, mode.shape)]), mode.left)
    except np.linalg.LinAlgError:
        return np.inf


def fastest_mode_of_step(scheme: Scheme, rest: Equilibrium, dt: float, found: Rates) -> FastestMode | None:
    """The eigenvectors of the step's largest eigenvalue; None where its Jacobian is not finite.

    Args:
        found: the eigenvalues of the motion: what nothing resists is left out.
    """
    jacobian = step_jacobian(scheme, rest, dt)
    if not np.isfinite(jacobian).all():
        return None
    values, modes = np.linalg.eig(jacobian)
    kept = resisted(values.astype(complex), found.unresisted, dt * found.fastest)
    if not len(kept):
        return None
    fastest = int(np.argmax(values == kept[np.argmax(np.abs(kept))]))
    value = complex(values[fastest])
    return FastestMode(modes[:, fastest].real, _left_eigenvector(jacobian, value), abs(value) - 1)


def _left_eigenvector(jacobian: Array, value: complex) -> Array:
    """Of one eigenvalue, by inverse iteration: the inverse of all eigenvectors is nothing where some are alike."""
    shifted = jacobian.T.conj() - np.conj(value) * (1 + 1e-10) * np.eye(len(jacobian))
    vector = np.random.default_rng(0).normal(size=len(jacobian)).astype(complex)
    for _ in range(3):
        vector = np.linalg.solve(shifted, vector)
        vector /= np.linalg.norm(vector)
    return np.asarray(vector)


def offsets(scheme: Scheme, rest: Equilibrium, dt: float, shape: Array) -> Iterator[Array]:
    """How far from rest a run is after every step, the start first, as vectors like the shape it starts in.

    Where something falls, as fast as it does in the long run, from a run that is not perturbed: it falls in both. It
    ends after STEPS, or once the perturbation is GROWN times as large: what comes then says no more.
    """
    # what stops iterating at a velocity that counts as none must be pushed well beyond it
    size = (100 if scheme.iterated else 1) * PERTURBATION * rest.scale
    layout, settled = layout_of(scheme, rest, dt)[0], settled_state(scheme, rest, dt)
    if isinstance(rest.motion, SpringMotion) and not rest.contacts:
        settled = replace(settled, velocities=falling_velocities(rest.system))
    free_step = scheme.on(rest.motion)

    def step(state: State, dt: float) -> State:
        return projected(rest.system, free_step(state, dt), 0.0) if rest.contacts else free_step(state, dt)

    still, state = settled, layout.state(shape * (size / np.abs(shape).max()), settled)
    falls = np.abs(step(settled, dt).positions - settled.positions).max() > 1e-3 * size
    base = layout.vector(still)
    for _ in range(STEPS + 1):
        offset = (layout.vector(state) - base)[:, 0]
        yield offset
        if not np.abs(offset[: layout.block]).max() <= GROWN * size:
            return
        state = step(state, dt)
        if falls:
            still = step(still, dt)
            base = layout.vector(still)
