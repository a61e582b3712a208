"""How a push grows in an engine, and up to which dt it does not: measured in the engine's process. Needs NumPy only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypedDict

import numpy as np

from engines.engine import Engine, Unsupported
from engines.step_jacobian import step_jacobian
from reference.growth_factor import growth_factor
from reference.measured_stability import GROWN, SEEN, STEPS, limit_near, measured_limit, random_growth
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem

#: Below and above its limit, as parts of it, an engine's step is looked at.
BELOW, ABOVE = 0.99, 1.01


class FoundLimit(TypedDict):
    """What is found of an engine's limit, in plain numbers.

    Attributes:
        dt: the limit [s], or None with the reason.
        radius_below, radius_above: the spectral radii of the engine's step at BELOW and ABOVE of the limit; None
            where the engine cannot start stretched and in motion.
    """

    dt: float | None
    reason: str
    radius_below: float | None
    radius_above: float | None


def limit_of_engine(
    engine: Engine, still: Array, pushed: MassSpringSystem, dt: float, precision: float
) -> FoundLimit | Outcome:
    """Run an engine again and again until its limit is found; then look at its step there.

    Args:
        still: where all masses are at rest [m], shape (n, d).
        pushed: the system with its masses pushed a little from there.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
    """
    try:
        limit, reason = measured_limit(
            lambda h, steps: growth_of_engine(engine, still, pushed, h, steps), dt, precision
        )
        below = above = None
        if limit is not None and {"stretched", "velocities"} <= engine.capabilities:
            rest = replace(pushed, positions=still)
            below, above = (growth_factor(step_jacobian(engine, rest, f * limit)) for f in (BELOW, ABOVE))
        return {"dt": limit, "reason": reason, "radius_below": below, "radius_above": above}
    except Unsupported as error:
        return Outcome("unsupported", str(error))


class NearLimit(TypedDict):
    """An engine's limit, and whether pushes grow beyond it, in plain numbers.

    Attributes:
        dt: the limit [s], or None with the reason.
        grows: whether pushes grow at so many times the limit; None where there is none.
    """

    dt: float | None
    reason: str
    grows: bool | None


def limit_of_engine_near(
    engine: Engine,
    still: Array,
    pushed: MassSpringSystem,
    expected: float | None,
    dt: float,
    precision: float,
    beyond: float,
) -> NearLimit | Outcome:
    """As `limit_of_engine`, in a few runs where the limit is where theory expects it; and what is beyond it.

    Args:
        expected: the predicted limit [s]; None where there is none.
        beyond: at so many times the limit pushes are to be looked at too.
    """

    def growth(h: float, steps: int) -> float:
        return growth_of_engine(engine, still, pushed, h, steps)

    try:
        limit, reason = limit_near(growth, expected, dt, precision)
        grows = None if limit is None else growth(beyond * limit, STEPS) > SEEN
        return {"dt": limit, "reason": reason, "grows": grows}
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def growths_of_engine(
    engine: Engine, cases: Sequence[tuple[Array, MassSpringSystem, float]], steps: int
) -> dict[str, Array] | Outcome:
    """The "growth" of pushes in an engine, per step: of each case of rest positions, pushed system, and dt [s]."""
    try:
        return {"growth": np.array([growth_of_engine(engine, *case, steps) for case in cases])}
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def growth_of_engine(engine: Engine, still: Array, pushed: MassSpringSystem, dt: float, steps: int) -> float:
    """What becomes of a push in an engine, per step."""
    simulation = engine.start(pushed, dt)
    offsets = [pushed.positions - still]
    far = GROWN * np.linalg.norm(offsets[0])
    for _ in range(steps):
        simulation.step()
        offsets.append(simulation.state()[0] - still)
        if not np.linalg.norm(offsets[-1]) <= far:  # nor where it is no number: the rest would say no more
            break
    return random_growth(np.array(offsets))
