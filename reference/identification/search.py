"""Which of the catalogue's trajectories a run is compared with: all of them, or on a large system those it can be."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from reference.changes import Change
from reference.identification.ranking import identify_run
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import SchemeStepper, Stepper, catalogued, stepper_named
from reference.system import MassSpringSystem

#: Systems of more masses than that are large: not every scheme is followed on them to the end.
LARGE = 50

#: Schemes that differ at all differ by far more than rounding after this many steps.
FIRST_STEPS = 10


def candidates(
    system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = (), claims: Iterable[str] = ()
) -> dict[str, Trajectory]:
    """The trajectories of all catalogued schemes that can step the system, the simplest scheme first.

    Args:
        claims: schemes with parameters, by name, that are to be among them: what an engine says it is.
    """
    outcomes = {name: stepper.run(system, dt, steps, changes) for name, stepper in _catalogue(claims).items()}
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
    claims = [claim for stepper, _ in runs for claim in getattr(stepper, "claims", ())]
    if len(system.masses) <= LARGE:
        return candidates(system, dt, steps, changes, claims)
    catalogue = _catalogue(claims)
    own = {s.name: run.trajectory for s, run in runs if catalogue.get(s.name) == s and run.trajectory is not None}
    unknown = [run for stepper, run in runs if stepper.name not in own and run.trajectory is not None]
    search = _Search(system, own, lambda name, n: catalogue[name].run(system, dt, min(steps, n), changes).trajectory)
    for name in catalogue:
        unknown = [run for run in unknown if not search.has(run)]
        if not unknown:
            break
        search.try_first_steps(name, unknown, steps)
    for run in unknown:
        search.follow_nearest(run, steps)
    return {name: search.followed[name] for name in catalogue if name in search.followed}


class _Search:
    """What is known of the catalogue on a large system, while it is being found out.

    Args:
        followed: the trajectories that have been made to the end, by scheme.
        make: the trajectory of a scheme for a number of steps at most; None where it cannot step the system.
    """

    def __init__(
        self,
        system: MassSpringSystem,
        followed: Mapping[str, Trajectory],
        make: Callable[[str, int], Trajectory | None],
    ) -> None:
        self._system, self._make = system, make
        self.followed = dict(followed)
        self._begun: dict[str, Trajectory] = {}

    def has(self, run: Outcome) -> bool:
        """Whether a run is one of those that were followed."""
        return _is_one_of(self.followed, run, self._system)

    def try_first_steps(self, name: str, runs: Sequence[Outcome], steps: int) -> None:
        """Run a scheme for a few steps, and to the end if some run is still with it."""
        begun = None if name in self.followed else self._make(name, FIRST_STEPS)
        if begun is None:
            return
        self._begun[name] = begun
        if any(_is_one_of({name: begun}, _beginning(run), self._system) for run in runs):
            self._follow(name, steps)

    def follow_nearest(self, run: Outcome, steps: int) -> None:
        """Run the scheme to the end that is nearest to a run in its first steps."""
        nearest = identify_run("run", _beginning(run), self._system, self._begun).ranking[:1]
        for match in nearest:
            if match.scheme not in self.followed:
                self._follow(match.scheme, steps)

    def _follow(self, name: str, steps: int) -> None:
        whole = self._make(name, steps)
        if whole is not None:
            self.followed[name] = whole


def _catalogue(claims: Iterable[str]) -> dict[str, SchemeStepper]:
    """The catalogue, and after it the schemes with parameters that somebody claims to be."""
    known = dict(catalogued())
    return known | {name: stepper_named(name) for name in claims if name not in known}


def _is_one_of(known: Mapping[str, Trajectory], run: Outcome, system: MassSpringSystem) -> bool:
    return identify_run("run", run, system, known).identified_as is not None


def _beginning(run: Outcome) -> Outcome:
    """What a run had done after the first steps."""
    assert run.trajectory is not None
    return replace(run, trajectory=run.trajectory.frames(slice(FIRST_STEPS + 1)))
