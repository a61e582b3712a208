"""How a perturbation grows in an engine, and up to which dt it does not: measured, in the engine's own process.

Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from engines.engine import Engine, Unsupported
from engines.line import started
from engines.step_jacobian import step_jacobian
from reference.growth_factor import growth_factor
from reference.limit import Limit
from reference.measured_stability import GROWN, SEEN, STEPS, limit_near, measured_limit, random_growth
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem

#: Below and above its limit, as parts of it, an engine's step is looked at.
BELOW, ABOVE = 0.99, 1.01


def limit_of_engine(
    engine: Engine, rest: Array, perturbed: MassSpringSystem, dt: float, precision: float
) -> Limit | Outcome:
    """Run an engine again and again until its limit is found; then look at its step there.

    Args:
        rest: where all masses are at rest [m], shape (n, d).
        perturbed: the system with its masses moved a little from there.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.

    Returns:
        The limit, with the growth factors of the engine's step at BELOW and ABOVE of it where the engine can start
        stretched and in motion.
    """
    try:
        limit = measured_limit(lambda h, steps: growth_of_engine(engine, rest, perturbed, h, steps), dt, precision)
        if limit.dt is None or not {"stretched", "velocities"} <= engine.capabilities:
            return limit
        below, above = (_growth_factor(engine, rest, perturbed, part * limit.dt) for part in (BELOW, ABOVE))
        return replace(limit, factors=(below, above))
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def limit_of_engine_near(
    engine: Engine,
    rest: Array,
    perturbed: MassSpringSystem,
    expected: float | None,
    dt: float,
    precision: float,
    beyond: float,
) -> Limit | Outcome:
    """As `limit_of_engine`, in a few runs where the limit is where theory expects it; and what is beyond it.

    Args:
        expected: the predicted limit [s]; None where there is none.
        beyond: the part of the limit (over 1) at which it is looked whether perturbations grow.

    Returns:
        The limit, and whether perturbations grow beyond it.
    """

    def growth(h: float, steps: int) -> float:
        return growth_of_engine(engine, rest, perturbed, h, steps)

    try:
        limit = limit_near(growth, expected, dt, precision)
        if limit.dt is None:
            return limit
        return replace(limit, grows_beyond=growth(beyond * limit.dt, STEPS) > SEEN)
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def growths_of_engine(
    engine: Engine, cases: Sequence[tuple[Array, MassSpringSystem, float]], steps: int
) -> dict[str, Array] | Outcome:
    """The "growth" of perturbations in an engine, per step: of cases of rest positions, perturbed system, dt [s]."""
    try:
        return {"growth": np.array([growth_of_engine(engine, *case, steps) for case in cases])}
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def growth_of_engine(engine: Engine, rest: Array, perturbed: MassSpringSystem, dt: float, steps: int) -> float:
    """What becomes of a perturbation in an engine, per step."""
    simulation = started(engine, perturbed, dt)
    offsets = [perturbed.positions - rest]
    far = GROWN * np.linalg.norm(offsets[0])
    for _ in range(steps):
        simulation.step()
        offsets.append(simulation.state()[0] - rest)
        if not np.linalg.norm(offsets[-1]) <= far:  # nor where it is not finite: the rest would say no more
            break
    return random_growth(np.array(offsets))


def _growth_factor(engine: Engine, rest: Array, system: MassSpringSystem, dt: float) -> float:
    """Of the engine's own step about rest."""
    return growth_factor(step_jacobian(engine, replace(system, positions=rest), dt))
