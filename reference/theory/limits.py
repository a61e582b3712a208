"""Stability, predicted: up to which dt perturbations of an equilibrium do not grow under a scheme.

They do not while all eigenvalues of the step map's Jacobian lie within the unit circle (Hairer and Wanner, *Solving
Ordinary Differential Equations II* (1996), IV.2). How that is found depends on what the scheme's own definition shows:

    a step with symmetric matrices      `definite`: certified by the sign of a sparse matrix
    an explicit Runge-Kutta method      `runge_kutta`: its stability polynomial on the eigenvalues of the motion
    an implicit one that sees modes     `unconditional_stability`: whether no oscillator grows, by Routh and Hurwitz
    any other                           `step_spectrum`: eigenvalues of the step itself, dt by dt

The answer is the first limit, from short steps on; where a step is stable again above it, that is told.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.errors import SolverError
from reference.growth_factor import growth_factor
from reference.limit import Limit
from reference.schemes.catalogue import Scheme, find
from reference.theory.definite import Definiteness
from reference.theory.equilibria import Equilibrium
from reference.theory.keeps_to_surfaces import keeps_to_surfaces
from reference.theory.layout import layout_of
from reference.theory.numerical_range import limit_from_below
from reference.theory.rates import Rates, rates
from reference.theory.rates import fastest_rate as fastest_rate
from reference.theory.runge_kutta import stability_polynomial, stable_steps
from reference.theory.step_coefficients import is_quadratic, solves_for_positions
from reference.theory.step_map import step_jacobian
from reference.theory.step_on_obstacles import require_pressed
from reference.theory.step_spectrum import WHOLE_UP_TO, first_limit, unstable_at_any
from reference.theory.strong_damping import drowned_from, limit_with_rods
from reference.theory.unconditional_stability import stable_at_any_dt
from reference.theory.windows import looked_to, windows_of

#: Schemes that stop their iteration early have, to what they leave, the limit of what they would come to.
SOLVED = {"kick_drift_truncated_damping": "kick_drift_implicit_damping"}

#: Steps that solve for positions are differenced on obstacles up to this size of the whole state only: it takes long.
IMPLICIT_UP_TO = 12

#: Up to so many times the fastest 1/w a step is looked at for negative damping.
FAR = 1e6

#: The Runge-Kutta limit of a large system is one value where it is known so nearly from both sides.
AS_GOOD_AS_ONE = 1e-8


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def growth(scheme: Scheme, rest: Equilibrium, dt: float) -> float:
    """The growth factor of a scheme's step."""
    try:
        return growth_factor(step_jacobian(scheme, rest, dt))
    except SolverError:
        return np.inf


def stability_limit(scheme: Scheme, rest: Equilibrium, found: Rates | None = None) -> Limit:
    """The predicted limit of a scheme about an equilibrium: the first dt above which perturbations grow.

    Args:
        found: the eigenvalues of the motion there, where they are known already.

    Raises:
        SolverError: about a rest on obstacles, if the scheme has none there or its step is too large to be looked at.
    """
    found = found or rates(rest)
    if found.fastest == 0:
        return Limit(None, "nothing moves")
    if scheme.name in SOLVED:
        limit = stability_limit(find(SOLVED[scheme.name]), rest, found)
        # what is left undone may move it by more than rounding
        return replace(limit, certainty="computed") if limit.certainty == "certified" else limit
    linear = rest.linear
    if rest.contacts is not None and not (rest.contacts.flat(rest.system) and keeps_to_surfaces(scheme)):
        return _on_obstacles(scheme, rest, found)
    if linear is not None and is_quadratic(scheme, linear.damped, linear.dragged):
        definite = Definiteness(scheme, linear, 1 / found.fastest)
        if definite.decides:
            try:
                return _by_definiteness(definite)
            except SolverError as error:
                return Limit(None, f"not computed: {error}")
    polynomial = stability_polynomial(scheme) if rest.contacts is None else None
    if polynomial is not None:
        return _by_polynomial(polynomial, rest, found)
    if linear is not None and stable_at_any_dt(scheme, linear.damped, linear.dragged):
        return Limit(None, "stable at any dt", certainty="certified")
    return first_limit(scheme, rest, found)


def _on_obstacles(scheme: Scheme, rest: Equilibrium, found: Rates) -> Limit:
    """Of a step that springs see inside obstacles, or whose end follows a surface that curves."""
    require_pressed(scheme, rest, 1 / found.fastest)
    size, most = layout_of(scheme, rest, 1 / found.fastest)[0].size, WHOLE_UP_TO
    if solves_for_positions(scheme):
        most = IMPLICIT_UP_TO
    if size > most:
        why = f"in this scheme's step springs see masses inside obstacles; up to {most} it is"
        raise SolverError(f"not computed for {size} positions and velocities: {why}")
    return first_limit(scheme, rest, found)


def _by_definiteness(definite: Definiteness) -> Limit:
    """Of a step with symmetric matrices."""
    last = np.inf if definite.in_proportion else drowned_from(definite)
    dt = np.inf if definite.never_negative else definite.first_limit(last)
    # S changes its sign there as well
    negative = definite.negative_damping_from(min((1 + AS_GOOD_AS_ONE) * dt, last, FAR * definite.unit))
    if np.isfinite(negative):
        return Limit(negative, certainty="certified")
    if definite.never_negative:
        return Limit(None, "stable at any dt", certainty="certified")
    if np.isfinite(dt):
        windows = windows_of(definite, dt)
        return Limit(dt, certainty="certified", windows=windows, looked_to=looked_to(definite, dt))
    if np.isinf(last):
        return Limit(None, "stable at any dt", certainty="certified")
    with_rods = limit_with_rods(definite, last)
    drowns = _drowns(definite)
    if with_rods is None:
        return Limit(last, certainty="between", note=f"at least {last:.4g} s: {drowns}")
    return Limit(with_rods, note=drowns) if np.isfinite(with_rods) else Limit(None, "stable at any dt", note=drowns)


def _drowns(definite: Definiteness) -> str:
    """What is said of limits beyond steps in which damping or drag is all but rigid."""
    grows = {"the damping of springs": definite.springs_grow, "drag": definite.drag_grows}
    words = [word for word, is_so in grows.items() if is_so]
    return f"in such steps {' and '.join(words)} drown{'s' if len(words) == 1 else ''} all else in rounding"


def _by_polynomial(polynomial: tuple[float, ...], rest: Equilibrium, found: Rates) -> Limit:
    """Of an explicit Runge-Kutta method."""
    (_, first), *others = stable_steps(polynomial, found.values)
    if first == 0:
        return _never(polynomial, found)
    if found.all or (found.least_decay == 0 and not found.values.real.any()):
        if np.isinf(first):
            return Limit(None, "stable at any dt")
        return Limit(float(first), windows=tuple((float(a), float(b)) for a, b in others))
    assert rest.linear is not None  # of other equations all eigenvalues are known
    below = limit_from_below(polynomial, rest.linear)
    if below >= (1 - AS_GOOD_AS_ONE) * first:
        return Limit(float(first))
    known = f"of {len(rest.linear.mass)} coordinates not all modes are known"
    if below == 0:
        return Limit(None, f"not computed: unstable above {first:.4g} s at the latest; {known}")
    if np.isinf(first):
        return Limit(below, certainty="between", note=f"at least {below:.4g} s: {known}")
    return Limit(below, at_most=float(first), certainty="between")


def _never(polynomial: tuple[float, ...], found: Rates) -> Limit:
    """No step is stable: there is a mode that nothing damps, and the method lets such grow."""
    unit = 0.1 / found.fastest
    multiplied = np.abs(np.polyval(polynomial[::-1], unit * found.values)).max()
    rate = float(multiplied - 1)
    return Limit(None, unstable_at_any(rate, unit), rate)


def explicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with explicit damping, of a mode x'' + gamma x' + omega^2 x = 0: h^2 w^2 + 2 gamma h < 4."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) - gamma) / omega**2)


def implicit_damping_limit(omega: float, gamma: float) -> float:
    """Kick-drift with implicit damping: h^2 w^2 < 4 + 2 gamma h."""
    return float((np.sqrt(gamma**2 + 4 * omega**2) + gamma) / omega**2)
