"""The first limit of steps of large systems that have no structure to certify it by: an eigenvalue that passes -1.

The Jacobian of such a step is never made: a step of the linearised motion, or of a small perturbation, is its product
with a vector. Such schemes are near relations of one whose limit is certified, and give up near to where that does:
the search begins there, in the direction in which that one gives up. Where the relation says nothing, single
oscillators with the frequencies and the damping of the system tell where to begin.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.errors import SolverError
from reference.limit import Limit
from reference.schemes.catalogue import Scheme, find
from reference.schemes.implicit_damping import effective_masses
from reference.state import Array, State
from reference.theory.definite import Definiteness, lowest_eigenvector
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import Layout, layout_of
from reference.theory.linearisation import Linearisation
from reference.theory.numerical_range import polygon
from reference.theory.oscillators import growth_of_oscillators
from reference.theory.outermost import Outermost
from reference.theory.strong_damping import drowned_from

#: Schemes whose limit is certified and near, by the name of those that they are near to.
RELATIVES = {"drift_kick_sequential_damping": "drift_kick_exponential_damping", "velocity_verlet": "kick_drift"}

#: Where the search begins, as a part of where the relative gives up, or single oscillators do.
NEARLY, BELOW = 0.97, 0.5

#: Each dt looked at is so many times the one before; the limit is found to this part of itself.
RATIO, PRECISION = 1.04, 1e-7

#: The same in a subspace of moves, and the part of it below at which another eigenvalue is looked for.
CLOSE, SHORT = 1e-9, 1e-4

#: Growth of single oscillators that is no rounding.
SEEN = 1e-6

#: Parts of a limit at which steps are run, twice so many of them; and by what the second half of a run multiplies what
#: grows: motion that nothing resists is at most doubled.
BEFORE, RUN, GROWS = (0.2, 0.28, 0.39, 0.5, 0.65, 0.8, 0.95), 800, 4.0

#: Damping is gentle where h c/m is less: there an iteration that stops early has come to what it comes to.
GENTLE = 0.5

#: Rounds of iteration that show an eigenvalue well beyond -1, and that tell where it is.
QUICK, ROUNDS = 12, 150


def limit_of_large(scheme: Scheme, linear: Linearisation, rest: Equilibrium, unit: float) -> Limit:
    """The dt above which an eigenvalue of the step lies beyond -1.

    Args:
        unit: about as long as the fastest motion lasts [s].
    """
    near, direction = _relative(scheme, linear, unit)
    if scheme.linear and np.isfinite(near):
        found = _near_a_relative(scheme, linear, rest, unit, near)
        if found is not None:
            return _unless_it_grows_before(scheme, rest, found)
    start = _start(direction, linear)

    def beyond(dt: float, rounds: int = ROUNDS) -> float:
        return past_minus_one(scheme, rest, dt, rounds, start)

    low, last = NEARLY * near, 4 * near
    if not np.isfinite(near) or beyond(low, QUICK) > 0:
        expected = _of_single_oscillators(scheme, linear)
        low, last = BELOW * expected, 2 * expected
        if not np.isfinite(expected) or beyond(low, QUICK) > 0:
            return Limit(None, "not computed: neither single oscillators nor a scheme near to it tell where to look")
    high = RATIO * low
    while not beyond(high, QUICK) > 0:
        low, high = high, RATIO * high
        if high > last:
            return Limit(None, f"not computed: stable at {low:.4g} s, where it was to be unstable")
    from scipy.optimize import brentq

    return Limit(float(brentq(beyond, low, high, xtol=PRECISION * low)))


def _unless_it_grows_before(scheme: Scheme, rest: Equilibrium, limit: float) -> Limit:
    """The limit; none where steps well below it let perturbations grow, as one that stops iterating early may.

    Looked for where damping is strong, in runs of the perturbed step: growth of half a hundredth in a step, or more.
    """
    system = rest.system
    strong = limit * float((system.damping / effective_masses(system)).max(initial=0.0)) > GENTLE
    for dt in [part * limit for part in BEFORE] if scheme.iterated and strong else []:
        layout, product = _perturbed_step(scheme, rest, dt)
        z = np.random.default_rng(0).normal(size=layout.size)
        sizes = []
        for _ in range(2):
            for _ in range(RUN):
                z = product(z).ravel()
            sizes.append(float(np.abs(z).max()))
        if not sizes[1] < GROWS * sizes[0]:
            return Limit(None, f"not computed: perturbations grow in steps of {dt:.4g} s, as it stops iterating early")
    return Limit(limit)


def _near_a_relative(
    scheme: Scheme, linear: Linearisation, rest: Equilibrium, unit: float, near: float
) -> float | None:
    """The limit [s] where it is next to the relative's; None where it is not found there."""
    from scipy.optimize import brentq

    definite = relative_of(scheme, linear, unit)
    assert definite is not None  # there is a limit of it
    outermost = Outermost(lambda dt, z: _perturbed_step(scheme, rest, dt)[1](z), definite, near)
    low, high = NEARLY * near, RATIO * NEARLY * near
    try:
        if not outermost.beyond(low) < 0 < outermost.beyond(high):
            return None
        limit = float(brentq(outermost.beyond, low, high, xtol=CLOSE * low))
    except SolverError:
        return None
    # and another one, in no move of the subspace, would be seen by an iteration that starts from all moves
    return None if past_minus_one(scheme, rest, (1 - SHORT) * limit, QUICK) > 0 else limit


def relative_of(scheme: Scheme, linear: Linearisation, unit: float) -> Definiteness | None:
    """S(h) of the scheme that this one is near to; None where there is none."""
    name = RELATIVES.get(scheme.step.__name__)
    return None if name is None else Definiteness(find(name), linear, unit)


def _relative(scheme: Scheme, linear: Linearisation, unit: float) -> tuple[float, Array | None]:
    """The limit [s] of the scheme that this one is near to, and the direction in which that one gives up.

    Infinite where it has none, or there is no such scheme.
    """
    definite = relative_of(scheme, linear, unit)
    if definite is None:
        return np.inf, None
    limit = definite.first_limit(np.inf if definite.in_proportion else drowned_from(definite))
    return limit, lowest_eigenvector(definite.matrix(limit)) if np.isfinite(limit) else None


def _start(direction: Array | None, linear: Linearisation) -> Array | None:
    """A state (x, dt v) that a step with an eigenvalue near -1 turns round: x and -2 x, so that x + dt v is -x."""
    if direction is None:
        return None
    moves = direction / np.sqrt(linear.mass)
    return np.concatenate([moves, -2 * moves])


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
def past_minus_one(scheme: Scheme, rest: Equilibrium, dt: float, rounds: int, start: Array | None = None) -> float:
    """How far beyond -1 the eigenvalue of a step lies that is furthest that way; negative where it is not beyond.

    Negative, too, where rounds of iteration are too few to tell it from its neighbours: well beyond -1 it has none. The
    moduli of most eigenvalues may be one and hard to tell apart; of 1 - J this one is the outermost.

    Args:
        start: a state near to the one that is turned round, where one is known.
    """
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs

    layout, product = _perturbed_step(scheme, rest, dt)
    noise = np.random.default_rng(0).normal(size=layout.size)
    begin = noise if start is None or len(start) != layout.size else start + 1e-3 * np.abs(start).max() * noise
    operator = LinearOperator((layout.size, layout.size), lambda z: z.ravel() - product(z.ravel()), dtype=float)
    try:
        values = eigs(
            operator,
            1,
            v0=begin,
            tol=1e-8 if scheme.linear else 1e-6,
            which="LM",
            ncv=24,
            maxiter=rounds,
            return_eigenvectors=False,
        )
    except ArpackNoConvergence as error:
        values = error.eigenvalues
    except (SolverError, ValueError):
        return np.inf
    return float(values.real.max(initial=0.0) - 2.0)


def _perturbed_step(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, Callable[[Array], Array]]:
    """How a step answers a small perturbation: linearised where the scheme is linear, else differenced."""
    layout, settled = layout_of(scheme, rest, dt)
    if scheme.linear and rest.linear is not None:
        linear = scheme.on(rest.linear.motion)

        def of_columns(z: Array) -> Array:
            nothing = np.zeros((*rest.state.positions.shape, *z.shape[1:]))
            zero = State(0.0, nothing, nothing, (nothing,) * layout.remembered)
            return layout.vector(linear(layout.state(z, zero), dt)).reshape(z.shape)

        return layout, of_columns
    step, small = scheme.on(rest.motion), 1e-5 * rest.scale

    def product(z: Array) -> Array:
        size = float(np.abs(z).max()) or 1.0
        there, back = (layout.vector(step(layout.state(s * small / size * z, settled), dt))[:, 0] for s in (1, -1))
        return np.asarray((there - back) * (size / (2 * small)))

    return layout, product
