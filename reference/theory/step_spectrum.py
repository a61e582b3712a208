"""The first limit of any step at all: from the eigenvalues of its Jacobian, dt by dt, from short steps on.

For steps with no structure that would tell more: those that write what they still read, that stop iterating early, that
look back at earlier steps. A step that is short enough does as the motion does. So where all modes decay there is a
limit, above the dt from which the search starts; and where a mode neither decays nor grows, it is how growth falls
with dt that tells: as a power of dt, it is there at any dt.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.bisection import bisect
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.limit import Limit
from reference.schemes.catalogue import Scheme, find
from reference.state import Array, State
from reference.theory.definite import Definiteness
from reference.theory.equilibria import Equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.numerical_range import polygon
from reference.theory.oscillators import growth_of_oscillators
from reference.theory.rates import Rates
from reference.theory.step_map import TORN_APART, Layout, LinearMotion, layout_of, resisted, step_jacobian
from reference.theory.strong_damping import drowned_from

#: Up to this size of the whole state all eigenvalues of steps are taken, dt by dt; and of a few steps up to the second.
WHOLE_UP_TO, FEW_UP_TO = 260, 700

#: Growth in a step that is no rounding: of a Jacobian that is exact, and of one that is differenced.
EXACT, DIFFERENCED = 1e-11, 1e-8

#: Each dt looked at is so many times the one before; the first limit is found to this part of itself.
RATIO, PRECISION = 1.2, 1e-8

#: Of large systems: where the search begins, as a part of where single oscillators give up, or where the scheme does
#: that this one nearly is; by what it goes on, and to which part of itself the limit is found.
BELOW, NEARLY, LARGE_RATIO, LARGE_PRECISION, SEEN = 0.5, 0.98, 1.1, 1e-7, 1e-6

#: Rounds of iteration that show an eigenvalue well beyond -1.
QUICK = 15

#: Where nothing grows at so many times the slowest mode's 1/w, the search ends.
FARTHEST = 30.0

#: And where it grows still at so many times the step that the search began with.
SHORTEST = 1e-4

#: Steps, in a mode's own 1/w, at which the power is looked at by which its growth falls.
SHORT = (0.2, 0.1, 0.05)

#: The same for motion that nothing resists, whose growth is of a high power and hidden by rounding soon.
HALVED = (1.2, 0.6, 0.3)

#: Schemes that stop their iteration early, by what they would come to; on large systems the search begins there.
CONVERGED = {"drift_kick_sequential_damping": "drift_kick_exponential_damping"}


def first_limit(scheme: Scheme, rest: Equilibrium, found: Rates) -> Limit:
    """The dt above which a scheme's perturbations of an equilibrium grow, looked for from short steps on."""
    unit = 1 / found.fastest
    size = layout_of(scheme, rest, unit)[0].size
    margin = EXACT if isinstance(rest.motion, SpringMotion) and scheme.linear else DIFFERENCED

    def excess(dt: float) -> float:
        return _excess(scheme, rest, dt, found)

    if size <= FEW_UP_TO and (
        (found.unresisted and _unresisted_motion_grows(scheme, rest, found))
        or (found.least_decay <= 0 and _undamped_modes_grow(scheme, rest, found, margin))
    ):
        rate = excess(0.1 * unit)
        return Limit(None, unstable_at_any(rate, 0.1 * unit), rate)
    if size <= WHOLE_UP_TO:
        start = _start(found)
        if scheme.step.__name__ in CONVERGED and isinstance(rest.motion, SpringMotion):
            # up to near the limit of what it comes to, it does as that does
            converged = _of_converged(scheme, Linearisation(rest.motion.system, rest.state), unit)
            start = NEARLY * converged if np.isfinite(converged) else start
        limit = _scan(excess, start, unit, margin, FARTHEST / float(np.abs(found.values).min()))
        phantom = limit.dt is not None and found.unresisted and _is_of_unresisted_motion(scheme, rest, found, limit.dt)
        return _of_unresisted_motion(scheme, rest, found, unit) if phantom else limit
    if scheme.needs == "accelerations of one mass" or not isinstance(rest.motion, SpringMotion):
        reason = f"{size} positions and velocities, which this scheme does not step alike; up to {WHOLE_UP_TO} it is"
        return Limit(None, f"not computed for {reason}")
    return limit_of_large(scheme, Linearisation(rest.motion.system, rest.state), rest)


def unstable_at_any(rate: float, dt: float) -> str:
    """How that is said, with the growth [1] in a step of dt [s]."""
    return f"unstable at any dt: grows by {rate:.2g} of itself in a step of {dt:.2g} s"


def _start(found: Rates) -> float:
    """A dt [s] short enough: a hundredth of the fastest 1/w, or a tenth of where Euler's step would let a mode grow."""
    damped = found.values[found.values.real < 0]
    eulers = float((-2 * damped.real / np.abs(damped) ** 2).min(initial=np.inf))
    return min(1e-2 / found.fastest, 0.1 * eulers)


def _undamped_modes_grow(scheme: Scheme, rest: Equilibrium, found: Rates, margin: float) -> bool:
    """Whether a mode that nothing damps grows in steps as short as one likes: its growth falls as a power of dt only.

    The slowest and the fastest of them are followed, at steps of their own length and of the fastest motion's: of all
    eigenvalues of a step the one next to e^(h mu) is the mode's.
    """
    undamped = np.unique(found.values[(found.values.real == 0) & (found.values.imag > 0)])
    looked_at = [
        (complex(mu), unit)
        for mu in dict.fromkeys([*undamped[:1].tolist(), *undamped[-1:].tolist()])
        for unit in dict.fromkeys([1 / abs(mu), 1 / found.fastest])
    ]
    return any(
        _falls_as_a_power([_growth_of_mode(scheme, rest, mu, part * unit) for part in SHORT], margin)
        for mu, unit in looked_at
    )


def _is_of_unresisted_motion(scheme: Scheme, rest: Equilibrium, found: Rates, dt: float) -> bool:
    """Whether what grows above a limit is motion that nothing resists: it does below, too, hidden by rounding."""
    values = np.linalg.eigvals(step_jacobian(scheme, rest, 1.001 * dt))
    others = values[np.argsort(np.abs(values - 1), kind="stable")[found.unresisted :]]
    return bool(np.abs(others).max(initial=0.0) < 1 + TORN_APART)


def _of_unresisted_motion(scheme: Scheme, rest: Equilibrium, found: Rates, dt: float) -> Limit:
    values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
    rate = float(np.abs(values[np.argsort(np.abs(values - 1), kind="stable")[: found.unresisted]]).max() - 1)
    return Limit(None, f"{unstable_at_any(rate, dt)}; it is motion that nothing resists", rate)


def _unresisted_motion_grows(scheme: Scheme, rest: Equilibrium, found: Rates) -> bool:
    """Whether motion that nothing resists grows: in a step that moves one mass before another sees it, springs do."""

    def grown(dt: float) -> float:
        values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
        nearest = values[np.argsort(np.abs(values - 1), kind="stable")[: found.unresisted]]
        return float(np.abs(nearest).max() - 1)

    return _falls_as_a_power([grown(part / found.fastest) for part in HALVED], TORN_APART)


def _falls_as_a_power(grown: list[float], margin: float) -> bool:
    """Whether growth at steps each half the last falls as a power of dt, and is more than rounding at all of them."""
    if min(grown) <= margin:
        return False
    powers = np.log2(np.array(grown[:-1]) / np.array(grown[1:]))
    return bool((powers > 0.9).all() and np.ptp(powers) < 1.0)


def _growth_of_mode(scheme: Scheme, rest: Equilibrium, mu: complex, dt: float) -> float:
    """Growth of a mode in a step of dt [s]."""
    jacobian = step_jacobian(scheme, rest, dt)
    if not np.isfinite(jacobian).all():
        return np.inf
    values = np.linalg.eigvals(jacobian)
    return float(np.abs(values[np.argmin(np.abs(values - np.exp(dt * mu)))]) - 1)


def _scan(excess: Callable[[float], float], start: float, unit: float, margin: float, last: float) -> Limit:
    """From a short step on, each a little longer, to the first at which perturbations grow, or to the last."""

    def unstable(dt: float) -> bool:
        # beyond the fastest mode's 1/w, positions and dt x velocities are of different sizes, and so is rounding
        return excess(dt) > margin * max(1.0, dt / unit)

    dt = start
    while unstable(dt):
        dt /= 2 if start > 1e-2 * unit else 10
        if dt < SHORTEST * start:
            return Limit(None, f"no stable step was found, down to {dt:.3g} s")
    while not unstable(RATIO * dt):
        dt *= RATIO
        if dt > last:
            return Limit(None, f"stable at any dt that was looked at, up to {dt:.3g} s")
    low, high = bisect(unstable, dt, RATIO * dt, lambda low, high: high - low <= PRECISION * low)
    return Limit((low + high) / 2)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _excess(scheme: Scheme, rest: Equilibrium, dt: float, found: Rates) -> float:
    """By how much of itself the worst perturbation grows in a step [1], motion that nothing resists left out."""
    try:
        jacobian = step_jacobian(scheme, rest, dt)
    except SolverError:
        return np.inf
    if not np.isfinite(jacobian).all():
        return np.inf
    values = resisted(np.linalg.eigvals(jacobian).astype(complex), found.unresisted, dt * found.fastest)
    return float(np.abs(values).max(initial=0.0) - 1)


def limit_of_large(scheme: Scheme, linear: Linearisation, rest: Equilibrium) -> Limit:
    """Of a system whose whole Jacobian is too large: near where single oscillators like its modes give up.

    Such steps give up where an eigenvalue passes -1. It is followed from steps well below on.
    """
    if scheme.step.__name__ in CONVERGED:
        expected = _of_converged(scheme, linear, 1e-3)
        low, ratio = NEARLY * expected, 1 / NEARLY**2
    else:
        expected = _of_single_oscillators(scheme, linear)
        low, ratio = BELOW * expected, LARGE_RATIO
    if not np.isfinite(expected) or expected == 0:
        return Limit(None, "not computed: single oscillators of its frequencies have no limit, the whole may have one")

    def beyond(dt: float, rounds: int = 200) -> float:
        return past_minus_one(scheme, rest, dt, rounds)

    if beyond(low, QUICK) > 0:
        return Limit(
            None, f"not computed: at {low:.4g} s it is unstable, well below single oscillators' {expected:.4g} s"
        )
    high = ratio * low
    while not beyond(high, QUICK) > 0:
        low, high = high, ratio * high
        if high > 2 * expected:
            return Limit(None, f"not computed: stable at {low:.4g} s, where single oscillators are not")
    from scipy.optimize import brentq

    return Limit(float(brentq(beyond, low, high, xtol=LARGE_PRECISION * low)))


def _of_converged(scheme: Scheme, linear: Linearisation, unit: float) -> float:
    """The limit [s] of what a scheme would come to that stops its iteration early; infinite where there is none."""
    definite = Definiteness(find(CONVERGED[scheme.step.__name__]), linear, unit)
    return definite.first_limit(drowned_from(definite))


def _of_single_oscillators(scheme: Scheme, linear: Linearisation) -> float:
    """The shortest limit [s] of oscillators with the frequencies and dampings that the system's modes can have."""
    corners = polygon(linear)
    edges = [
        (1 - t) * a + t * b
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        for t in (0, 0.25, 0.5, 0.75)
    ]
    squares, damping = np.maximum(np.array(edges).T, 0.0)
    dt = 1e-2 / np.sqrt(squares.max())
    for _ in range(400):
        if growth_of_oscillators(scheme, dt, squares, damping).max() > 1 + SEEN:
            return float(dt)
        dt *= 1.03
    return float(np.inf)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def past_minus_one(scheme: Scheme, rest: Equilibrium, dt: float, rounds: int) -> float:
    """How far beyond -1 the eigenvalue of a step lies that is furthest that way; negative where it is not beyond.

    Negative, too, where rounds of iteration are too few to tell it from its neighbours: well beyond -1 it has none.

    The moduli of most eigenvalues may be one and hard to tell apart; of 1 - J this one is the outermost.
    """
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs

    layout, product = _perturbed_step(scheme, rest, dt)
    start = np.random.default_rng(0).normal(size=layout.size)
    operator = LinearOperator((layout.size, layout.size), lambda z: z.ravel() - product(z.ravel()), dtype=float)
    try:
        values = eigs(operator, 1, v0=start, tol=1e-9, which="LM", ncv=24, maxiter=rounds, return_eigenvectors=False)
    except ArpackNoConvergence as error:
        values = error.eigenvalues
    except (SolverError, ValueError):
        return np.inf
    return float(values.real.max(initial=0.0) - 2.0)


def _perturbed_step(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, Callable[[Array], Array]]:
    """How a step answers a small perturbation: linearised where the scheme is linear, else differenced."""
    layout, settled = layout_of(scheme, rest, dt)
    if scheme.linear and isinstance(rest.motion, SpringMotion):
        linear = scheme.on(LinearMotion(rest.motion.system, rest.state))
        nothing = np.zeros_like(rest.state.positions)
        zero = State(0.0, nothing, nothing, (nothing,) * layout.remembered)
        return layout, lambda z: layout.vector(linear(layout.state(z, zero), dt))[:, 0]
    step, small = scheme.on(rest.motion), 1e-5 * rest.scale

    def product(z: Array) -> Array:
        size = float(np.abs(z).max()) or 1.0
        there, back = (layout.vector(step(layout.state(s * small / size * z, settled), dt))[:, 0] for s in (1, -1))
        return np.asarray((there - back) * (size / (2 * small)))

    return layout, product
