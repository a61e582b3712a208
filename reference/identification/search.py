"""Which of the catalogue's trajectories a run is compared with: all begin, and those a run is still with go on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from reference.changes import Change
from reference.identification.ranking import Begun, identify_first_steps, identify_run
from reference.identification.result import Identification
from reference.identification.scale import precision_of
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import SchemeStepper, Stepper, catalogued, stepper_named, wide_catalogue
from reference.system import MassSpringSystem

#: Systems of more masses than that are large: there two steps decide which schemes go on, and of those that tie in
#: their first steps the simplest alone is followed to the end.
LARGE = 50

#: Schemes that differ at all differ by far more than rounding after this many steps.
FIRST_STEPS = 10

#: Most differ by as much after so many.
FEWEST_STEPS = 2


def candidates(
    system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = (), claims: Iterable[str] = ()
) -> dict[str, Trajectory]:
    """The trajectories of all catalogued schemes that can step the system, the simplest scheme first.

    Args:
        claims: schemes with parameters, by name, that are to be among them: what an engine says it is.
    """
    left = {
        name: stepper.trajectory(system, dt, steps, changes) for name, stepper in catalogue_with(claims, system).items()
    }
    return {name: trajectory for name, trajectory in left.items() if trajectory is not None}


@dataclass(frozen=True)
class Candidates:
    """What is known of the catalogue, the simplest scheme first.

    Attributes:
        whole: the trajectories that were made to the end, by scheme.
        begun: those of first steps, of all schemes that can step the system, with the number of steps.
    """

    whole: dict[str, Trajectory] = field(default_factory=dict)
    begun: Begun = field(default_factory=dict)

    def identify(self, name: str, outcome: Outcome, system: MassSpringSystem) -> Identification:
        """A run among all of them: those it is with in the first steps, to the end, or the nearest; then the others."""
        first = identify_first_steps(name, outcome, system, self.begun)
        within = {match.scheme for match in first.matches or first.ranking[:1]}
        found = identify_run(name, outcome, system, {n: run for n, run in self.whole.items() if n in within})
        if not found.ranking:
            return first
        seen = {match.scheme for match in found.ranking}
        whole = replace(found, ranking=found.ranking + tuple(m for m in first.ranking if m.scheme not in seen))
        return replace(whole, reason="") if whole.matches else whole


def candidates_for(
    runs: Sequence[tuple[Stepper, Outcome]],
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> Candidates:
    """The catalogue's trajectories that these runs can be identified with.

    Every scheme is tried for a few steps, and followed to the end if some run is still with it. On a large system, of
    those that a run is with the simplest is followed first, and the others only where the run then leaves that one. A
    run that none is with gets the scheme that is nearest in those first steps.

    Args:
        runs: each with who made it; what the catalogue's own schemes have made is not made again.
    """
    claims = [claim for stepper, _ in runs for claim in getattr(stepper, "claims", ())]
    catalogue = catalogue_with(claims, system)
    own = {s.name: run.trajectory for s, run in runs if catalogue.get(s.name) == s and run.trajectory is not None}
    unknown = [run for stepper, run in runs if run.trajectory is not None and precision_of(stepper) == "double"]

    def make(name: str, n: int) -> Trajectory | None:
        if name in own:
            return own[name] if n == steps else own[name].frames(slice(n + 1))
        return catalogue[name].trajectory(system, dt, n, changes)

    search = _Search(system, steps, list(catalogue), make)
    search.try_first_steps(unknown)
    for run in unknown:
        search.follow(run)
    in_order = {name: search.followed[name] for name in catalogue if name in search.followed}
    return Candidates(in_order, search.begun)


class _Search:
    """What is known of the catalogue, while it is being found out.

    Args:
        make: the trajectory of a scheme for a number of steps; None where it cannot step the system.
    """

    def __init__(
        self, system: MassSpringSystem, steps: int, names: Sequence[str], make: Callable[[str, int], Trajectory | None]
    ) -> None:
        self._system, self._steps, self._names, self._make = system, steps, names, make
        self.followed: dict[str, Trajectory] = {}
        self.begun: dict[str, tuple[int | None, Trajectory]] = {}
        self._within: dict[int, list[str]] = {}

    def try_first_steps(self, runs: Sequence[Outcome]) -> None:
        """Every scheme for the fewest steps, and for some more if a run is with it then, or a run is with none."""
        large = len(self._system.masses) > LARGE
        for n in (FEWEST_STEPS, FIRST_STEPS) if large else (FIRST_STEPS,):
            strangers = not all(self._with(run) for run in runs) if self.begun else True
            going_on = self._names if strangers else {name for run in runs for name in self._with(run)}
            for name in self._names if runs else ():
                begun = self._make(name, min(n, self._steps)) if name in going_on else None
                if begun is not None:
                    self.begun[name] = (min(n, self._steps), begun)
            self._within = {}

    def follow(self, run: Outcome) -> None:
        """Make to the end what a run is with: all of that, on a large system the simplest; else what is nearest."""
        within = self._with(run)
        large = len(self._system.masses) > LARGE
        for name in within:
            self._follow(name)
            if large and _is_one_of({name: self.followed[name]}, run, self._system):
                return
        if not within and not _is_one_of(self.followed, run, self._system):
            nearest = identify_first_steps("run", run, self._system, self.begun).ranking[:1]
            for match in nearest:
                self._follow(match.scheme)

    def _with(self, run: Outcome) -> list[str]:
        """The schemes a run is with in the first steps, the simplest first."""
        if id(run) not in self._within:
            found = identify_first_steps("run", run, self._system, self.begun)
            matches = {match.scheme for match in found.matches}
            self._within[id(run)] = [name for name in self._names if name in matches]
        return self._within[id(run)]

    def _follow(self, name: str) -> None:
        if name in self.followed:
            return
        steps, trajectory = self.begun[name]
        whole = trajectory if steps == self._steps else self._make(name, self._steps)
        self.followed[name] = trajectory if whole is None else whole


def catalogue_with(claims: Iterable[str], system: MassSpringSystem) -> dict[str, SchemeStepper]:
    """The catalogue, after it the wide one where the system is small, and the schemes that somebody claims to be."""
    wide = wide_catalogue() if len(system.masses) <= LARGE else {}
    known = {**catalogued(), **wide}
    return known | {name: stepper_named(name) for name in claims if name not in known}


def _is_one_of(known: Mapping[str, Trajectory], run: Outcome, system: MassSpringSystem) -> bool:
    return identify_run("run", run, system, known).identified_as is not None
