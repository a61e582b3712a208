"""How far known trajectories are from a run's, and which of them it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from reference.identification.result import Identification, Match
from reference.outcome import Outcome, first_diverged_frame
from reference.state import Trajectory
from reference.system import MassSpringSystem

#: A deviation counts as rounding up to this part of the system's size.
TOLERANCE = 1e-12

#: Deviations below this part of the size are one as good as the other: the simpler scheme is named.
NOISE = 1e-14

#: A run that blows up is compared while no spring is longer than this many times its length.
STRETCH = 3.0


def identify_run(
    name: str, outcome: Outcome, system: MassSpringSystem, known: Mapping[str, Trajectory], tolerance: float = TOLERANCE
) -> Identification:
    """Rank the known trajectories by their distance from a run's, and name the nearest if it is within the tolerance.

    Args:
        name: of the stepper that made the run.
        known: trajectories by scheme, the simplest first: of several that are as good as the best, that one is named.
        tolerance: as a part of the system's size.
    """
    limit = tolerance * system.size
    if outcome.trajectory is None:
        return Identification(name, (), limit, outcome.reason)
    frames = comparable_frames(outcome, system)
    if frames < 2:
        return Identification(name, (), limit, "it blew up in its first step")
    errors = {scheme: largest_distance(outcome.trajectory, run, frames) for scheme, run in known.items()}
    return Identification(name, ranked(errors, limit, NOISE * system.size), limit)


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
    assert outcome.trajectory is not None
    if outcome.ending != "diverged":
        return len(outcome.trajectory)
    return first_diverged_frame(system, outcome.trajectory, STRETCH)


def largest_distance(one: Trajectory, other: Trajectory, frames: int) -> float:
    """Of any mass at any of the first frames [m]."""
    return float(one.distance(other)[:frames].max())


def ranked(errors: Mapping[str, float], limit: float, noise: float) -> tuple[Match, ...]:
    """Schemes by their errors [m], nearest first; those within noise of the best stay in their order.

    >>> ranked({"euler": 2.0, "heun": 3e-15, "rk4": 1e-15}, 1e-12, 1e-14)[0].scheme
    'heun'
    """
    as_good_as_best = min(limit, max(noise, 10 * min(errors.values(), default=0.0)))
    nearest_first = sorted(errors, key=lambda scheme: 0.0 if errors[scheme] <= as_good_as_best else errors[scheme])
    return tuple(Match(scheme, errors[scheme]) for scheme in nearest_first)
