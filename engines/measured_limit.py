"""How a perturbation grows in an engine, and up to which dt it does not: measured, in the engine's own process.

Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from engines.engine import Engine, Unsupported
from engines.line import started
from engines.step_jacobian import step_jacobian
from reference.growth_factor import growth_factor
from reference.limit import Limit
from reference.measured_stability import GROWN, SEEN, STEPS, measured_limit, mode_growth, random_growth
from reference.outcome import Outcome
from reference.state import Array
from reference.system import BoolArray, MassSpringSystem

#: Below and above its limit, as parts of it, an engine's step is looked at.
BELOW, ABOVE = 0.99, 1.01

#: The part of a limit at which perturbations are to grow.
BEYOND = 1.1

#: How many steps a mode is watched.
MODE_STEPS = 300


def limit_of_engine(
    engine: Engine,
    rest: Array,
    perturbed: MassSpringSystem,
    dt: float,
    precision: float,
    expected: float | None = None,
) -> Limit | Outcome:
    """Run an engine again and again until its limit is found; then look at its step there.

    Args:
        rest: where all masses are at rest [m], shape (n, d).
        perturbed: the system with its masses moved a little from there.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
        expected: the limit [s] of the scheme that the engine was identified with: it is looked at first.

    Returns:
        The limit, and whether perturbations grow at BEYOND of it; with the growth factors of the engine's step at BELOW
        and ABOVE of it where the engine can start stretched and in motion.
    """

    def growth(h: float, steps: int) -> float:
        return growth_of_engine(engine, rest, perturbed, h, steps)

    try:
        limit = measured_limit(growth, dt, precision, expected)
        if limit.dt is None:
            return limit
        found, factors = limit.dt, None
        if {"stretched", "velocities"} <= engine.capabilities:
            below, above = (_growth_factor(engine, rest, perturbed, part * found) for part in (BELOW, ABOVE))
            factors = (below, above)
        return replace(limit, factors=factors, grows_beyond=growth(BEYOND * found, STEPS) > SEEN)
    except Unsupported as error:
        return Outcome("unsupported", str(error))


@dataclass(frozen=True, eq=False)
class ModeRun:
    """One run along a mode that theory chose.

    Attributes:
        dt: the step [s].
        positions, velocities: the perturbation of rest [m], [m/s], shape (n, d).
        left: the left eigenvector that tells the mode from others, over the free masses' coordinates and dt x their
            velocities.
    """

    dt: float
    positions: Array
    velocities: Array
    left: Array


def growths_along_modes(engine: Engine, rest: MassSpringSystem, runs: Sequence[ModeRun]) -> dict[str, Array] | Outcome:
    """The "growth" of a mode in a step of an engine, in each of the runs; NaN where it tells no velocities.

    Args:
        rest: the system at rest, or falling steadily: then a run from there is subtracted from each.
    """
    try:
        return {"growth": np.array([_growth_along(engine, rest, run) for run in runs])}
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def _growth_along(engine: Engine, rest: MassSpringSystem, run: ModeRun) -> float:
    positions, velocities = rest.positions + run.positions, rest.velocities + run.velocities
    moved = started(engine, replace(rest, positions=positions, velocities=velocities), run.dt)
    still = started(engine, rest, run.dt) if falls(rest) else None
    free, size = ~rest.fixed, float(np.abs(run.positions).max())
    offsets = [_offset(run.positions, run.velocities, run.dt, free)]
    for _ in range(MODE_STEPS):
        moved.step()
        x, v = moved.state()
        base_x, base_v = rest.positions, np.zeros_like(v)
        if still is not None:
            still.step()
            base_x, base_v = still.state()
        offsets.append(_offset(x - base_x, v - base_v, run.dt, free))
        if not np.abs(x - base_x).max() <= GROWN * size:
            break
    return mode_growth(np.array(offsets), run.left)


def falls(system: MassSpringSystem) -> bool:
    """Whether a mass that springs do not join to a fixed one is pulled anywhere: there is weight."""
    held, (a, b) = system.fixed.copy(), system.springs[system.stiffness > 0].T
    for _ in range(len(held)):
        joined = held[a] | held[b]
        held[a[joined]] = held[b[joined]] = True
    return bool(system.gravity.any() and not held.all())


def _offset(x: Array, v: Array, dt: float, free: BoolArray) -> Array:
    return np.concatenate([x[free].ravel(), dt * v[free].ravel()])


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
    still = started(engine, replace(perturbed, positions=rest), dt) if falls(perturbed) else None
    begun = perturbed.positions - rest
    offsets, far = [begun], GROWN * np.linalg.norm(begun)
    for _ in range(steps):
        simulation.step()
        if still is not None:
            still.step()
        offsets.append(simulation.state()[0] - (rest if still is None else still.state()[0]))
        if not np.linalg.norm(offsets[-1]) <= far:  # nor where it is not finite: the rest would say no more
            break
    return random_growth(np.array(offsets))


def _growth_factor(engine: Engine, rest: Array, system: MassSpringSystem, dt: float) -> float:
    """Of the engine's own step about rest."""
    return growth_factor(step_jacobian(engine, replace(system, positions=rest), dt))
