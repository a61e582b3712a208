"""Identification: a stepper in, out comes the catalogued scheme that reproduces its trajectory to rounding.

A stepper and a scheme that do the same arithmetic in another order differ by rounding only, about 1e-15 of the system's
size over some hundred steps; two different schemes differ by many orders of magnitude more. So the ranking of the
catalogue by largest deviation has a cliff in it, and a name is given only to what stands on the far side.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reference.changes import Change
from reference.outcome import Outcome, first_torn, outcome_of
from reference.state import Trajectory
from reference.stepper import Stepper, catalogued
from reference.system import MassSpringSystem

#: A deviation counts as rounding up to this part of the system's size.
TOLERANCE = 1e-12

#: A motion that multiplies rounding may deviate by what it makes of a push of PUSH of the size, but not by more than
#: AMPLIFIED: a push is what steps in another order add up to, and some to spare.
PUSH, AMPLIFIED = 1e-14, 1e-9

#: Deviations below this part of the size are one as good as the other: the simpler scheme is named.
NOISE = 1e-14

#: Systems of more masses than that are large: not every scheme is followed on them to the end.
LARGE = 50

#: Schemes that differ at all differ by far more than rounding after so many steps.
FIRST_STEPS = 10

#: A run that blows up is compared while no spring is longer than this many times its length.
STRAIN = 3.0


@dataclass(frozen=True)
class Match:
    """How far a catalogued scheme is from the stepper: the largest distance of any mass at any time [m]."""

    scheme: str
    error: float


@dataclass(frozen=True)
class Identification:
    """What a stepper was found to be.

    Attributes:
        stepper: its name.
        ranking: the catalogue, nearest first.
        tolerance: up to which a scheme is named [m].
        reason: why there is no ranking, where there is none.
    """

    stepper: str
    ranking: tuple[Match, ...]
    tolerance: float
    reason: str = ""

    @property
    def identified_as(self) -> str | None:
        """The scheme, or None if none is within the tolerance."""
        return self.ranking[0].scheme if self.matches else None

    @property
    def matches(self) -> tuple[Match, ...]:
        """All schemes within the tolerance: on this system they cannot be told apart."""
        return tuple(m for m in self.ranking if m.error <= self.tolerance)

    @property
    def error(self) -> float:
        """The nearest scheme's deviation [m]; infinite without a ranking."""
        return self.ranking[0].error if self.ranking else np.inf

    def __str__(self) -> str:
        if not self.ranking:
            return f"{self.stepper}: not identified; {self.reason}"
        nearest = self.ranking[0]
        if self.identified_as is None:
            return f"{self.stepper}: not identified; nearest {nearest.scheme} at {nearest.error:.2g} m"
        return f"{self.stepper} is {nearest.scheme}, to {nearest.error:.2g} m"


def identify(
    stepper: Stepper, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()
) -> Identification:
    """Run a stepper and the catalogue, and say which scheme it is.

    Args:
        dt: the step [s].
        steps: how many; a few hundred tell schemes apart well and keep rounding small.
    """
    outcome = stepper.run(system, dt, steps, changes)
    known = candidates_for([(stepper, outcome)], system, dt, steps, changes)
    return identify_by_rounding(stepper.name, outcome, system, known, dt, steps, changes)


def candidates(
    system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()
) -> dict[str, Trajectory]:
    """The trajectories of all catalogued schemes that can step the system, the simplest scheme first."""
    outcomes = {name: stepper.run(system, dt, steps, changes) for name, stepper in catalogued().items()}
    return {name: outcome.trajectory for name, outcome in outcomes.items() if outcome.trajectory is not None}


def candidates_for(
    runs: Sequence[tuple[Stepper, Outcome]],
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> dict[str, Trajectory]:
    """The catalogue's trajectories that these runs can be identified with, the simplest scheme first.

    All of them; but the whole catalogue would take minutes on a large system. There a scheme is tried for a few steps
    and followed to the end only if some run is still with it, and once every run has its scheme the search ends. A run
    that has none gets the one that is nearest in those first steps.

    Args:
        runs: each with who made it; what the catalogue's own schemes have made is not made again.
    """
    if len(system.masses) <= LARGE:
        return candidates(system, dt, steps, changes)
    catalogue = catalogued()
    known = {s.name: run.trajectory for s, run in runs if catalogue.get(s.name) == s and run.trajectory is not None}
    unknown = [run for s, run in runs if s.name not in known and run.trajectory is not None]
    beginnings: dict[str, Trajectory] = {}
    for name, stepper in catalogue.items():
        unknown = [run for run in unknown if not _is_one_of(known, run, system)]
        if not unknown:
            break
        begun = None if name in known else stepper.run(system, dt, min(steps, FIRST_STEPS), changes).trajectory
        if begun is not None:
            beginnings[name] = begun
            if any(_is_one_of({name: begun}, _beginning(run), system) for run in unknown):
                known |= _followed(name, system, dt, steps, changes)
    for run in unknown:
        for match in identify_run("", _beginning(run), system, beginnings).ranking[:1]:
            if match.scheme not in known:
                known |= _followed(match.scheme, system, dt, steps, changes)
    return {name: known[name] for name in catalogue if name in known}


def _followed(
    name: str, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change]
) -> dict[str, Trajectory]:
    trajectory = catalogued()[name].run(system, dt, steps, changes).trajectory
    return {} if trajectory is None else {name: trajectory}


def _is_one_of(known: Mapping[str, Trajectory], run: Outcome, system: MassSpringSystem) -> bool:
    return identify_run("", run, system, known).identified_as is not None


def _beginning(run: Outcome) -> Outcome:
    """What a run had done after the first steps."""
    assert run.trajectory is not None
    few = slice(FIRST_STEPS + 1)
    at = run.trajectory
    return replace(run, trajectory=Trajectory(at.times[few], at.positions[few], at.velocities[few]))


def identify_run(
    name: str, outcome: Outcome, system: MassSpringSystem, known: Mapping[str, Trajectory], tolerance: float = TOLERANCE
) -> Identification:
    """Rank the known trajectories by their distance from a run's, and name the nearest if it is within the tolerance.

    Args:
        tolerance: as a part of the system's size.
    """
    limit = tolerance * system.size
    if outcome.trajectory is None:
        return Identification(name, (), limit, outcome.reason)
    frames = len(outcome.trajectory)
    if outcome.ending == "diverged":
        frames = first_torn(system, outcome.trajectory, STRAIN)
    if frames < 2:
        return Identification(name, (), limit, "it blew up in its first step")
    errors = {scheme: float(_distance(outcome.trajectory, known[scheme], frames)) for scheme in known}
    noise = min(limit, max(NOISE * system.size, 10 * min(errors.values(), default=0.0)))
    # Sorting is stable: among those as good as the best, the catalogue's order decides, simplest first.
    nearest_first = sorted(errors, key=lambda scheme: 0.0 if errors[scheme] <= noise else errors[scheme])
    return Identification(name, tuple(Match(s, errors[s]) for s in nearest_first), limit)


def identify_by_rounding(
    name: str,
    outcome: Outcome,
    system: MassSpringSystem,
    known: Mapping[str, Trajectory],
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> Identification:
    """As `identify_run`; where nothing is within the tolerance, that is what the nearest scheme makes of rounding.

    Cloth that buckles, and any scheme that blows up, multiply rounding: two who do the same arithmetic in another order
    then part by more than TOLERANCE. How far is measured (`amplified`), and never allowed beyond AMPLIFIED.
    """
    found = identify_run(name, outcome, system, known)
    if found.identified_as is not None or not found.error <= AMPLIFIED * system.size:
        return found
    nearest = catalogued()[found.ranking[0].scheme]
    allowed = min(AMPLIFIED, amplified(nearest, known[nearest.name], system, dt, steps, changes))
    return identify_run(name, outcome, system, known, max(TOLERANCE, allowed))


def amplified(
    stepper: Stepper,
    trajectory: Trajectory,
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> float:
    """How far a push of all free masses, in random directions, takes a stepper from its trajectory.

    Both the push, up to PUSH, and the distance are parts of the system's size. A stable scheme takes it 2e-14 to 6e-13
    far in some hundred steps on the default string; RK4 that blows up multiplies it by 2e7 in ten steps of 0.02 s.
    """
    push = PUSH * system.size * np.random.default_rng(0).uniform(-1, 1, system.positions.shape)
    pushed = replace(system, positions=system.positions + np.where(system.fixed[:, None], 0.0, push))
    other = stepper.run(pushed, dt, steps, changes).trajectory
    if other is None:
        return 0.0
    return identify_run("", outcome_of(system, trajectory), system, {"pushed": other}).error / system.size


def _distance(one: Trajectory, other: Trajectory, frames: int) -> float:
    return float(one.distance(other)[:frames].max())
