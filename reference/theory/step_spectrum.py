"""The first limit of any step at all: from the eigenvalues of its Jacobian, dt by dt, from short steps on.

For steps with no structure that would tell more: those that write what they still read, that stop iterating early, that
look back at earlier steps. A step that is short enough does as the motion does. So where all modes decay there is a
limit, above the dt from which the search starts; and where a mode neither decays nor grows, it is how growth falls
with dt that tells: as a power of dt, it is there at any dt.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.limit import Limit
from reference.schemes.catalogue import Scheme
from reference.theory.equilibria import Equilibrium
from reference.theory.first_growth import Search, first_growth, hidden
from reference.theory.large_steps import limit_of_large, relative_of
from reference.theory.layout import layout_of
from reference.theory.rates import UNDAMPED, Rates, rates
from reference.theory.step_increments import growth_of, increments_of_modes, is_exact, step_increments
from reference.theory.step_map import TORN_APART, Complex, is_resisted, step_jacobian
from reference.theory.unresisted import Remainder, remainder
from reference.theory.windows import looked_to, windows_of

#: Up to this size of the whole state all eigenvalues of steps are taken, dt by dt; and of a few steps up to the second.
WHOLE_UP_TO, FEW_UP_TO = 260, 700

#: Growth in a step of the fastest 1/w that is no rounding: of exact increments, of a Jacobian, of differences.
EXACT, LINEAR, DIFFERENCED = 1e-12, 1e-11, 1e-8

#: In steps shorter than this part of the fastest 1/w differences tell nothing: positions move too little.
SHORTEST_DIFFERENCED = 1e-3

#: Steps shorter than this part of the fastest 1/w round what is remembered no less than one that is so long.
REMEMBERED = 0.1

#: Growth and decay larger than this are told from rounding without more ado.
FINE = 1e-9

#: The first limit is found to this part of itself: of exact Jacobians, and of differenced ones.
PRECISION, ROUGH = 1e-8, 1e-7

#: Where nothing grows at so many times the slowest mode's 1/w, the search ends.
FARTHEST = 30.0

#: Steps, in a mode's own 1/w, at which the power is looked at by which its growth falls.
SHORT = (0.2, 0.1, 0.05)

#: The same for motion that nothing resists, whose growth is of a high power and hidden by rounding soon.
HALVED, MOST_HALVED = (1.2, 0.6, 0.3), 16


def first_limit(scheme: Scheme, rest: Equilibrium, found: Rates) -> Limit:
    """The dt above which a scheme's perturbations of an equilibrium grow, looked for from short steps on."""
    unit = 1 / found.fastest
    size = layout_of(scheme, rest, unit)[0].size
    # rounding in an iteration tears motion that nothing resists, which is no growth of it
    torn = scheme.iterated and found.unresisted > 0
    linear = rest.linear_motion is not None and scheme.linear
    exact, precision = is_exact(scheme, rest) and not torn, PRECISION if linear else ROUGH
    margin = DIFFERENCED if torn or not linear else EXACT if exact else LINEAR
    left = remainder(scheme, rest) if found.unresisted and size <= FEW_UP_TO else None

    def excess(dt: float) -> float:
        return _excess(scheme, rest, dt, found, left)

    def rounding(dt: float) -> float:
        """Of growth in a step of dt [s]: that of increments that are exact falls with dt."""
        # beyond the fastest mode's 1/w, positions and dt x velocities are of different sizes, and so is rounding
        least = (0.0 if scheme.one_step else REMEMBERED) if exact else 1.0
        return margin * max(least, dt / unit)

    loose = _growth_of_unresisted(scheme, rest, found, left) if found.unresisted and size <= FEW_UP_TO else []
    loose_decays = min(loose, default=0.0) < -EXACT
    if size <= FEW_UP_TO and (
        (loose and not loose_decays and _falls_as_a_power(loose[: len(HALVED)], EXACT if left else TORN_APART))
        or (found.least_decay <= 0 and _undamped_modes_grow(scheme, rest, found, margin))
    ):
        rate = excess(0.1 * unit)
        if rate <= rounding(0.1 * unit):
            return Limit(None, f"not computed: growth is seen in no step of {0.1 * unit:.2g} s, and may be in others")
        return Limit(None, unstable_at_any(rate, 0.1 * unit), rate)
    if size <= WHOLE_UP_TO:
        slowest = float(np.abs(found.values).min())
        # slower decay is never seen in a step
        decays = found.least_decay > UNDAMPED * found.fastest
        stays = left is not None and left.velocities > 0 and not loose_decays
        search = Search(excess, rounding, precision, decays and not stays)
        limit = first_growth(search, _start(scheme, found, slowest, linear), unit, FARTHEST / slowest)
        if limit.dt is not None and not decays and found.least_decay > 0 and _grows_undamped(scheme, rest):
            return Limit(None, hidden(limit.dt))
        if scheme.implicit and (unsolved := _not_solved(scheme, rest, limit.dt)):
            return Limit(None, unsolved)
        torn_apart = limit.dt is not None and found.unresisted and left is None
        if torn_apart and _is_of_unresisted_motion(scheme, rest, found, limit.dt or 0.0):
            return _of_unresisted_motion(scheme, rest, found, unit)
        return _with_windows(scheme, rest, unit, limit, search.is_growth)
    if scheme.needs == "accelerations of one mass" or rest.linear is None:
        reason = f"{size} positions and velocities, which this scheme does not step alike; up to {WHOLE_UP_TO} it is"
        return Limit(None, f"not computed for {reason}")
    return limit_of_large(scheme, rest.linear, rest, unit)


def _grows_undamped(scheme: Scheme, rest: Equilibrium) -> bool:
    """Whether a scheme lets all grow that nothing damps: then what is hardly damped may grow in short steps, unseen."""
    if rest.linear is None or rest.contacts is not None:
        return False
    system = rest.linear.system
    motion = SpringMotion(replace(system, damping=np.zeros_like(system.damping), drag=0.0))
    undamped = replace(rest, motion=motion, by_law=None)
    return first_limit(scheme, undamped, rates(undamped)).growth is not None


def _not_solved(scheme: Scheme, rest: Equilibrium, dt: float | None) -> str:
    """What is said of a limit [s] above which the step's equations are not solved, which is none; else nothing."""
    if dt is None:
        return ""
    try:
        step_jacobian(scheme, rest, (1 + ROUGH) * dt)
    except SolverError as error:
        return f"not computed: stable up to {dt:.3g} s, above which the step's equations were not solved: {error}"
    return ""


def unstable_at_any(rate: float, dt: float) -> str:
    """How that is said, with the growth [1] in a step of dt [s]."""
    return f"unstable at any dt: grows by {rate:.2g} of itself in a step of {dt:.2g} s"


def _with_windows(
    scheme: Scheme, rest: Equilibrium, unit: float, limit: Limit, unstable: Callable[[float], bool]
) -> Limit:
    """With where a scheme that stops its iteration early is stable again: inside windows of what it would come to."""
    if not scheme.iterated or limit.dt is None or rest.linear is None:
        return limit
    relative = relative_of(scheme, rest.linear, unit)
    if relative is None:
        return limit
    windows = tuple(
        (low, high)
        for low, high in windows_of(relative, limit.dt)
        if not any(unstable(low + part * (high - low)) for part in (0.01, 0.5, 0.99))
    )
    return replace(limit, windows=windows, looked_to=looked_to(relative, limit.dt))


def _start(scheme: Scheme, found: Rates, slowest: float, linear: bool) -> float:
    """A dt [s] short enough: a hundredth of the fastest 1/w, or a tenth of where Euler's step would let a mode grow.

    No shorter than differences allow where a step is not linear, nor than a scheme that remembers: in shorter steps
    what it remembers is all but what it has, and rounding tears the two apart by eps / (h w), w the slowest [1/s].
    """
    unit = 1 / found.fastest
    damped = found.values[found.values.real < 0]
    eulers = float((-2 * damped.real / np.abs(damped) ** 2).min(initial=np.inf))
    start = min(1e-2 * unit, 0.1 * eulers)
    if not linear:
        start = max(start, SHORTEST_DIFFERENCED * unit)
    if not scheme.one_step:
        start = max(start, min(1e-2 * unit, 4 * float(np.finfo(float).eps) / (LINEAR * slowest)))
    return start


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
    by_distance = np.argsort(np.abs(values - 1), kind="stable")
    nearest, others = values[by_distance[: found.unresisted]], values[by_distance[found.unresisted :]]
    fastest = float(np.abs(others).max(initial=0.0))
    return fastest < 1 + TORN_APART and float(np.abs(nearest).max()) > fastest


def _of_unresisted_motion(scheme: Scheme, rest: Equilibrium, found: Rates, dt: float) -> Limit:
    values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
    rate = float(np.abs(values[np.argsort(np.abs(values - 1), kind="stable")[: found.unresisted]]).max() - 1)
    return Limit(None, f"{unstable_at_any(rate, dt)}; it is motion that nothing resists", rate)


def _growth_of_unresisted(scheme: Scheme, rest: Equilibrium, found: Rates, left: Remainder | None) -> list[float]:
    """How motion that nothing resists grows in steps each half the last, down to where that is rounding.

    In a step that moves one mass before another sees it, springs do that.
    """

    def grown(dt: float) -> float:
        if left is not None:
            b = np.linalg.eigvals(left.of(step_increments(scheme, rest, dt))).astype(complex)
            return float(growth_of(b[np.argsort(np.abs(b), kind="stable")[: left.velocities]]).max(initial=-1.0))
        values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
        nearest = values[np.argsort(np.abs(values - 1), kind="stable")[: found.unresisted]]
        return float(np.abs(nearest).max() - 1)

    if left is not None and not left.velocities:
        return []
    seen = [grown(part / found.fastest) for part in HALVED]
    while left is not None and abs(seen[-1]) > EXACT and len(seen) < MOST_HALVED:
        seen.append(grown(HALVED[0] / 2 ** len(seen) / found.fastest))
    return seen


def _falls_as_a_power(grown: list[float], margin: float) -> bool:
    """Whether growth at steps each half the last falls as a power of dt, and is more than rounding at all of them."""
    if min(grown) <= margin:
        return False
    powers = np.log2(np.array(grown[:-1]) / np.array(grown[1:]))
    return bool((powers > 0.9).all() and np.ptp(powers) < 1.0)


def _growth_of_mode(scheme: Scheme, rest: Equilibrium, mu: complex, dt: float) -> float:
    """Growth of a mode in a step of dt [s]; none is seen where the step's equations are not solved."""
    try:
        jacobian = step_jacobian(scheme, rest, dt)
    except SolverError:
        return -np.inf
    if not np.isfinite(jacobian).all():
        return np.inf
    values = np.linalg.eigvals(jacobian)
    return float(np.abs(values[np.argmin(np.abs(values - np.exp(dt * mu)))]) - 1)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _excess(scheme: Scheme, rest: Equilibrium, dt: float, found: Rates, left: Remainder | None) -> float:
    """By how much of itself the worst perturbation grows in a step [1], motion that nothing resists left out."""
    try:
        increments = step_increments(scheme, rest, dt)
    except SolverError:
        return np.inf
    if not np.isfinite(increments).all():
        return np.inf
    unresisted = found.unresisted
    if left is not None:
        increments, unresisted = left.of(increments), left.positions
    whole = _worst(np.linalg.eigvals(increments).astype(complex), unresisted, dt * found.fastest)
    # quotients take longer, and tell more only where growth is next to none, of increments that are exact
    if abs(whole) > FINE or not is_exact(scheme, rest):
        return whole
    return _worst(increments_of_modes(increments), unresisted, dt * found.fastest)


def _worst(b: Complex, unresisted: int, unit: float) -> float:
    return float(growth_of(b[is_resisted(b, unresisted, unit)]).max(initial=-1.0))
