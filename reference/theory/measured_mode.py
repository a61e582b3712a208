"""A scheme's stability limit, measured: it is run from rest perturbed along one mode, and that mode is watched.

Theory says which mode it is, the eigenvector of the step's Jacobian whose eigenvalue is largest, and where to look.
What becomes of it is seen in a run of the scheme itself, a little below the predicted limit, a little above, and
between. In one mode alone growth of a millionth in a step shows within some hundred steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import floor, log, log1p

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
from reference.theory.parts import in_falling_frame
from reference.theory.rates import Rates
from reference.theory.step_map import resisted, settled_state, step_jacobian

#: How many steps a mode is watched.
STEPS = 120

#: What a run shows of growth in a step where there is none: rounding, and what is not linear.
MARGIN = 1e-8

#: Growth that is told from none for certain; and where a part is held by nothing, which rounding sets in motion.
SEEN, SEEN_LOOSE = 3 * MARGIN, 10 * MARGIN

#: What counts as growth near a limit: this part of what there is NEAR beyond it, between MARGIN and MOST.
PART, MOST = 1e-3, 1e-6

#: Growth that differs by less is alike.
ALIKE = 1e-11

#: A mode that is all but one with others takes up as many times what rounding does to its eigenvalue.
ILL_CONDITIONED = 100

#: Limits are found to this part of themselves.
PRECISION = 4e-5

#: Runs are made at powers of 1 + PRECISION, so far below and above the whole one below the predicted limit: where to
#: look is expected, what is found is not. The widest two are near half the limit and twice.
AROUND = ((0, 1), (-25, 25), (-250, 250), (-2500, 2500), (-17000, 17000))

#: So much above a predicted limit growth is to be fast enough to be seen.
NEAR = 1e-4

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
        rounding: by how much rounding may move it: n eps |J| / |y* x| of its left and right eigenvectors of length one
            (Golub and Van Loan, *Matrix Computations* (2013), 7.2.2).
    """

    shape: Array
    left: Array
    growth: float
    rounding: float


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

    if scheme.iterated and found.unresisted:
        return Limit(
            None, "not measured: where its iteration stops early differs, and tears motion that nothing resists"
        )

    def unstable(dt: float, margin: float = MARGIN) -> bool:
        return measured_mode_growth(scheme, rest, dt, found) > margin

    if predicted.dt is None and rest.contacts is not None:
        return Limit(None, predicted.reason)
    if predicted.dt is None or not predicted.exact:
        return _without_expectation(scheme, rest, found)
    if predicted.note:
        return Limit(None, f"not measured: {predicted.note}")
    mode = fastest_mode_of_step(scheme, rest, (1 + NEAR) * predicted.dt, found)
    seen = SEEN_LOOSE if found.unresisted else SEEN
    if mode is not None and mode.growth < max(seen, ILL_CONDITIONED * mode.rounding):
        growth = f"{mode.growth:.1g} a step" if mode.growth > 0 else "next to none"
        beyond = f"growth at {1 + NEAR:g} of the predicted limit is {growth}"
        why = (
            f"too slow for a run of {STEPS} steps"
            if mode.growth < seen
            else "of a mode that is all but one with others"
        )
        return Limit(None, f"not measured: {beyond}, {why}")
    # where two modes meet on the unit circle, rounding is more than MARGIN on both sides, and growth beyond far more
    margin = MARGIN if mode is None else min(max(MARGIN, PART * mode.growth), MOST)
    between = _around(lambda dt: unstable(dt, margin), predicted.dt)
    if isinstance(between, str):
        return Limit(None, between)
    measured = (_window(unstable, *window, predicted.looked_to) for window in predicted.windows)
    windows = tuple(window for window in measured if window is not None)
    return Limit(float(np.mean(between)), windows=windows, looked_to=predicted.looked_to)


def _around(unstable: Callable[[float], bool], dt: float) -> tuple[float, float] | str:
    """A stable dt and an unstable one above it, PRECISION apart, around an expected limit; or why there are none."""
    whole = floor(log(dt) / log1p(PRECISION))

    def at(power: float) -> float:
        return float((1 + PRECISION) ** (whole + power))

    def is_beyond(power: float) -> bool:
        return unstable(at(power))

    low = next((below for below, _ in AROUND if not is_beyond(below)), None)
    high = next((above for _, above in AROUND if is_beyond(above)), None)
    if low is None or high is None:
        (below, above), at_both = AROUND[-1], "stable" if high is None else "unstable"
        return f"no limit between {at(below):.4g} and {at(above):.4g} s: runs are {at_both} at both"
    first, last = bisect(is_beyond, low, high, lambda low, high: high - low <= 1)
    return at(first), at(last)


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
        return np.inf if mode is None else mode_growth(offsets(scheme, rest, dt, mode.shape), mode.left)
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
    grown = np.abs(kept)
    # of those that grow alike the one that turns fastest: slow modes, near 1, are all but one with one another
    alike = kept[grown >= grown.max() - ALIKE]
    fastest = int(np.argmax(values == alike[np.argmax(np.abs(alike - 1))]))
    value = complex(values[fastest])
    left = _left_eigenvector(jacobian, value)
    wrong = len(jacobian) * float(np.finfo(float).eps) * float(np.linalg.norm(jacobian, 2))
    rounding = wrong / max(abs(complex(left.conj() @ modes[:, fastest])), 1e-300)
    return FastestMode(modes[:, fastest].real, left, abs(value) - 1, rounding)


def _left_eigenvector(jacobian: Array, value: complex) -> Array:
    """Of one eigenvalue, by inverse iteration: the inverse of all eigenvectors is nothing where some are alike."""
    shifted = jacobian.T.conj() - np.conj(value) * (1 + 1e-10) * np.eye(len(jacobian))
    vector = np.random.default_rng(0).normal(size=len(jacobian)).astype(complex)
    for _ in range(3):
        vector = np.linalg.solve(shifted, vector)
        vector /= np.linalg.norm(vector)
    return np.asarray(vector)


def offsets(scheme: Scheme, rest: Equilibrium, dt: float, shape: Array) -> Array:
    """How far from rest a run is after every step, the start first, as vectors like the shape it starts in: its rows.

    What falls is looked at in the frame that falls with it. The run ends after STEPS, or once the perturbation is GROWN
    times as large: what comes then says no more.
    """
    # what stops iterating at a velocity that counts as none must be pushed well beyond it
    size = (100 if scheme.iterated else 1) * PERTURBATION * rest.scale
    layout, settled = layout_of(scheme, rest, dt)[0], settled_state(scheme, rest, dt)
    springs = isinstance(rest.motion, SpringMotion) and not rest.contacts
    free_step = scheme.on(SpringMotion(in_falling_frame(rest.system)) if springs else rest.motion)

    def step(state: State, dt: float) -> State:
        return projected(rest.system, free_step(state, dt), 0.0) if rest.contacts else free_step(state, dt)

    run = [layout.state(shape * (size / np.abs(shape).max()), settled)]
    while len(run) <= STEPS and np.abs((run[-1].positions - settled.positions)[rest.free]).max() <= GROWN * size:
        run.append(step(run[-1], dt))
    return (layout.vector(_as_columns(run)) - layout.vector(_as_columns([settled]))).T


def _as_columns(states: Sequence[State]) -> State:
    """States of one run as one state of columns."""
    memory = zip(*(state.memory for state in states), strict=True)
    positions, velocities = ([state.positions for state in states], [state.velocities for state in states])
    return State(0.0, _stacked(positions), _stacked(velocities), tuple(_stacked(each) for each in memory))


def _stacked(arrays: Sequence[Array]) -> Array:
    return np.stack(arrays, axis=-1)
