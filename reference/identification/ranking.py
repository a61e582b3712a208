"""How far known trajectories are from a run's, and which of them it is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from reference.identification.result import Identification, Match
from reference.identification.scale import scale
from reference.outcome import Outcome, first_diverged_frame
from reference.state import Trajectory
from reference.system import MassSpringSystem

#: A deviation counts as rounding up to this part of the run's scale.
TOLERANCE = 1e-12

#: Deviations below this part of the scale are one as good as the other: the simpler scheme is named.
NOISE = 1e-14

#: A run that blows up is compared while no spring is longer than this many times its length.
STRETCH = 3.0

#: Trajectories that were begun only, with the number of steps they were asked for.
Begun = Mapping[str, tuple[int | None, Trajectory]]


def identify_run(
    name: str,
    outcome: Outcome,
    system: MassSpringSystem,
    known: Mapping[str, Trajectory],
    tolerance: float = TOLERANCE,
) -> Identification:
    """Rank the known trajectories by their distance from a run's, and name the nearest if it is within the tolerance.

    Positions and velocities are compared, the latter times the step: what a scheme makes of the same positions with
    other velocities is another scheme.

    Args:
        name: of the stepper that made the run.
        known: trajectories by scheme, the simplest first: of several that are as good as the best, that one is named.
        tolerance: as a part of the run's scale (`scale`).
    """
    return _identified(name, outcome, system, {n: (None, run) for n, run in known.items()}, tolerance)


def identify_first_steps(name: str, outcome: Outcome, system: MassSpringSystem, begun: Begun) -> Identification:
    """As `identify_run`, each by its first steps."""
    return _identified(name, outcome, system, begun, TOLERANCE)


def _identified(
    name: str,
    outcome: Outcome,
    system: MassSpringSystem,
    known: Mapping[str, tuple[int | None, Trajectory]],
    tolerance: float,
) -> Identification:
    """By so many steps of each; None is by all there are."""
    limit = tolerance * system.scale
    if outcome.trajectory is None:
        return Identification(name, (), limit, outcome.reason)
    frames = comparable_frames(outcome, system)
    if frames < 2:
        return Identification(name, (), limit, "it blew up in its first step")
    run = outcome.trajectory
    length = scale(system, run.frames(slice(frames)))
    limit = tolerance * length
    parts = {steps: run if steps is None else run.frames(slice(steps + 1)) for steps, _ in known.values()}
    matches = [match(n, parts[m], other, min(len(parts[m]), frames)) for n, (m, other) in known.items()]
    found = Identification(name, ranked(matches, limit, NOISE * length), limit)
    return found if found.matches else found.without_name(why_none(found))


def why_none(found: Identification) -> str:
    """What there is to say where nothing is within the tolerance."""
    if not found.ranking:
        return "no scheme of the catalogue can step this system"
    nearest = found.ranking[0]
    words = f"nearest {nearest.scheme} at {nearest.error:.2g} m"
    if nearest.positions <= found.tolerance:
        words += f", by its velocities times the step; its positions are the same to {nearest.positions:.2g} m"
    return words


def identify_beginning(
    name: str, outcome: Outcome, system: MassSpringSystem, known: Mapping[str, Trajectory]
) -> Identification:
    """As `identify_run`, by the beginning of a run: as much of it as is known of the longest of the trajectories."""
    if outcome.trajectory is None:
        return identify_run(name, outcome, system, known)
    begun = outcome.trajectory.frames(slice(max(map(len, known.values()))))
    return identify_run(name, replace(outcome, trajectory=begun), system, known)


def comparable_frames(outcome: Outcome, system: MassSpringSystem) -> int:
    """How many frames of a run are compared: all, or those before it blew up."""
    run = outcome.trajectory
    assert run is not None
    if outcome.ending != "diverged":
        return len(run)
    frames = first_diverged_frame(system, run, STRETCH)
    lost = ~np.isfinite(run.velocities).all(axis=(1, 2))
    return min(frames, int(np.argmax(lost))) if tells_velocities(run) and lost.any() else frames


def tells_velocities(run: Trajectory) -> bool:
    """Whether there are any after the start: an engine that does not tell gives what is not a number."""
    return len(run) < 2 or not bool(np.isnan(run.velocities[1:]).all())


def match(scheme: str, run: Trajectory, other: Trajectory, frames: int) -> Match:
    """How far a scheme's trajectory is from a run's in the first frames; velocities as far as they are told."""
    positions = float(run.distance(other)[:frames].max())
    if not tells_velocities(run) or len(run) < 2:
        return Match(scheme, positions, 0.0, frames - 1)
    dt = float(run.times[1] - run.times[0])
    velocities = dt * float(run.velocity_difference(other)[:frames].max())
    return Match(scheme, positions, velocities, frames - 1)


def ranked(matches: Iterable[Match], limit: float, noise: float) -> tuple[Match, ...]:
    """Schemes by their errors [m], nearest first; those within noise of the best stay in their order.

    >>> ranked([Match("euler", 2.0), Match("heun", 3e-15), Match("rk4", 1e-15)], 1e-12, 1e-14)[0].scheme
    'heun'
    """
    listed = list(matches)
    as_good_as_best = min(limit, max(noise, 10 * min((m.error for m in listed), default=0.0)))
    return tuple(sorted(listed, key=lambda m: 0.0 if m.error <= as_good_as_best else m.error))
