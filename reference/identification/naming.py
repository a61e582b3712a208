"""Which scheme steppers are: their runs among the catalogue's, and more where that does not name one scheme.

Where several schemes match, the system is pushed, if a push tells them apart; what still ties is told. Where none does,
rounding that the motion multiplies is allowed for; then single steps are compared (`single_steps`), which is also how a
stepper in single precision is named.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from reference.changes import Change
from reference.identification.amplification import AMPLIFIED, amplified
from reference.identification.bits import BITS, same_bits
from reference.identification.pushes import Push, lacking, pushes
from reference.identification.ranking import TOLERANCE, identify_run
from reference.identification.result import Identification, Match
from reference.identification.scale import fastest_rate_bound, precision_of
from reference.identification.search import (
    FEWEST_STEPS,
    FIRST_STEPS,
    LARGE,
    Candidates,
    candidates_for,
    catalogue_with,
)
from reference.identification.single_steps import LONG, STATES, identify_steps, steps_of
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import SchemeStepper, Stepper, stepper_named
from reference.system import MassSpringSystem

#: Runs a stepper again: what `Stepper.run` does, or the same elsewhere.
Again = Callable[[Stepper, MassSpringSystem, float, int], Outcome]


@dataclass(frozen=True)
class Identified:
    """What steppers were found to be.

    Attributes:
        each: in the order of the runs.
        known: the catalogue's trajectories on the system, to the end, those that are named among them.
    """

    each: tuple[Identification, ...]
    known: Mapping[str, Trajectory]


def run_again(stepper: Stepper, system: MassSpringSystem, dt: float, steps: int) -> Outcome:
    """By the stepper itself."""
    return stepper.run(system, dt, steps)


def identify(
    stepper: Stepper, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()
) -> Identification:
    """Run a stepper and the catalogue, and say which scheme it is.

    Args:
        dt: the step [s].
        steps: how many; a few hundred tell schemes apart well and keep rounding small.
    """
    outcome = stepper.run(system, dt, steps, changes)
    (found,) = identify_all([(stepper, outcome)], system, dt, steps, changes).each
    return found


def identify_all(
    runs: Sequence[tuple[Stepper, Outcome]],
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
    again: Again = run_again,
) -> Identified:
    """Say which schemes steppers are, from their runs on a system; they are run again only where that is needed.

    Args:
        runs: each with who made it.
        again: how a stepper is run again, on a system that is pushed.
    """
    known = candidates_for(runs, system, dt, steps, changes)
    naming = _Naming(system, dt, steps, changes, known, again)
    each = tuple(naming.of(stepper, outcome) for stepper, outcome in runs)
    whole = dict(known.whole)
    for name in {found.identified_as for found in each} - {None, *whole}:
        # named by single steps, though no run followed it
        trajectory = stepper_named(str(name)).trajectory(system, dt, steps, changes)
        whole |= {} if trajectory is None else {str(name): trajectory}
    return Identified(each, whole)


def identify_by_rounding(
    name: str,
    outcome: Outcome,
    system: MassSpringSystem,
    known: Mapping[str, Trajectory],
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> Identification:
    """As `identify_run`; where nothing is within the tolerance, that is what the nearest scheme makes of rounding."""
    found = identify_run(name, outcome, system, known)
    if found.identified_as is not None or not found.error <= AMPLIFIED * system.scale:
        return found
    nearest = stepper_named(found.ranking[0].scheme)
    allowed = min(AMPLIFIED, amplified(nearest, known[nearest.name], system, dt, steps, changes))
    return identify_run(name, outcome, system, known, max(TOLERANCE, allowed))


def scheme_of(stepper: Stepper, identification: Identification) -> SchemeStepper | None:
    """What theory knows a stepper as: a scheme is itself, another is what it was identified as, if it was."""
    if isinstance(stepper, SchemeStepper):
        return stepper
    named = identification.identified_as
    return None if named is None else stepper_named(named)


class _Naming:
    """All that steppers on one system share: the catalogue's runs on it, and on it as it is pushed."""

    def __init__(
        self,
        system: MassSpringSystem,
        dt: float,
        steps: int,
        changes: Sequence[Change],
        known: Candidates,
        again: Again,
    ) -> None:
        self._system, self._dt, self._steps, self._changes = system, dt, steps, changes
        self._known, self._again = known, again
        self._pushes = list(pushes(system, dt))
        self._few = FEWEST_STEPS if len(system.masses) > LARGE else FIRST_STEPS
        self._pushed: dict[tuple[int, str], Trajectory | None] = {}
        self._same: dict[tuple[str, str], str] = {}

    def of(self, stepper: Stepper, outcome: Outcome) -> Identification:
        """What a stepper is, from its run."""
        if outcome.trajectory is None:
            return identify_run(stepper.name, outcome, self._system, {})
        if precision_of(stepper) == "single":
            same = self._bit_for_bit(stepper, outcome.trajectory)
            return self._by_single_steps(stepper, outcome.trajectory) if same is None else same
        found = self._known.identify(stepper.name, outcome, self._system)
        if not found.matches and found.ranking and found.ranking[0].scheme in self._known.whole:
            by_rounding = identify_by_rounding(
                stepper.name, outcome, self._system, self._known.whole, self._dt, self._steps, self._changes
            )
            found = by_rounding if by_rounding.matches else found
        if found.matches:
            return self._told_apart(stepper, found)
        by_steps = self._by_single_steps(stepper, outcome.trajectory)
        if by_steps.identified_as:
            return by_steps
        nothing = not by_steps.ranking and by_steps.compared == "single steps"
        words = "" if nothing else f"; by {by_steps.compared}, {by_steps.reason}"
        return found.without_name(found.reason + words)

    def _bit_for_bit(self, stepper: Stepper, run: Trajectory) -> Identification | None:
        """The scheme that a stepper claims to be, in single precision, where every bit of its run is that scheme's.

        Its start is left out: what a stepper is given in double precision it rounds first.
        """
        for claim in getattr(stepper, "claims", ()):
            known = stepper_named(claim)
            if not known.scheme.parameters.get("single"):
                continue
            found = known.trajectory(self._system, self._dt, self._steps, self._changes)
            if found is not None and len(run) > 1 and same_bits(found, run):
                return Identification(stepper.name, (Match(claim, 0.0, 0.0, len(run) - 1),), 0.0, compared=BITS)
        return None

    def _told_apart(self, stepper: Stepper, found: Identification) -> Identification:
        """Of the schemes that match, the one that a pushed stepper is; or those that it still may be."""
        names = [match.scheme for match in found.matches]
        if len(names) == 1:
            return found
        for push in [] if self._cannot_be_told(names) else self._pushes:
            runs = {name: run for name in names if (run := self._on(push, name)) is not None}
            outcome = self._again(stepper, push.system, push.dt, self._few)
            if not runs or outcome.trajectory is None:
                continue
            pushed = identify_run(stepper.name, outcome, push.system, runs)
            return self._with_reasons(_narrowed(found, pushed, push.words), push)
        if len(names) > 1 and len(names) == len({m.scheme for m in found.ranking}):
            return found.without_name(f"all {len(names)} schemes that can step it do the same here")
        return self._with_reasons(found, self._pushes[0])

    def _by_single_steps(self, stepper: Stepper, run: Trajectory) -> Identification:
        """What a stepper is by single steps: from its own states, and where its dt is short, from those at a longer."""
        precision = precision_of(stepper)
        catalogue = catalogue_with(getattr(stepper, "claims", ()), self._system)
        steps = steps_of(run, self._system, self._changes)
        found = identify_steps(stepper.name, steps, catalogue, precision)
        long = self._dt * fastest_rate_bound(self._system) >= LONG
        names = [match.scheme for match in found.matches]
        if not names or (long and self._cannot_be_told(names)):
            return self._tied(found)
        catalogue = {name: catalogue[name] for name in names}
        for push in self._pushes:
            outcome = self._again(stepper, push.system, push.dt, STATES)
            if outcome.trajectory is None or not _has_step(outcome.trajectory, push.dt):
                continue
            longer = identify_steps(stepper.name, steps_of(outcome.trajectory, push.system), catalogue, precision)
            return self._tied(replace(longer, compared=found.compared, told_apart_by=push.words))
        return self._tied(found) if long else found.without_name("its steps are too short to tell schemes apart")

    def _tied(self, found: Identification) -> Identification:
        if len(found.matches) > 1 and len(found.matches) == len(found.ranking):
            return found.without_name(f"all {len(found.matches)} schemes that can step it do the same in single steps")
        return self._with_reasons(found, self._pushes[0])

    def _with_reasons(self, found: Identification, push: Push) -> Identification:
        """The same, with what the system lacks that its ties differ in."""
        named = found.identified_as
        if named is None:
            return found
        reasons = {tie: self._differ_by(named, tie, push) for tie in found.ties}
        return replace(found, same_without={tie: reason for tie, reason in reasons.items() if reason})

    def _differ_by(self, one: str, other: str, push: Push) -> str:
        if (one, other) not in self._same:
            lacks = []
            for lack, with_it in lacking(push):
                runs = {name: run for name in (one, other) if (run := self._run(with_it, name)) is not None}
                if len(runs) == 2 and not self._all_same(with_it, runs):
                    lacks.append(lack)
            self._same[one, other] = " and ".join(lacks)
        return self._same[one, other]

    def _on(self, push: Push, name: str) -> Trajectory | None:
        key = (self._pushes.index(push), name)
        if key not in self._pushed:
            self._pushed[key] = self._run(push, name)
        return self._pushed[key]

    def _run(self, push: Push, name: str) -> Trajectory | None:
        return stepper_named(name).trajectory(push.system, push.dt, self._few)

    def _cannot_be_told(self, names: Sequence[str]) -> bool:
        """Whether these schemes do the same when the system is pushed, too."""
        push = self._pushes[0]
        runs = {name: run for name in names if (run := self._on(push, name)) is not None}
        return len(runs) == len(names) and self._all_same(push, runs)

    def _all_same(self, push: Push, runs: Mapping[str, Trajectory]) -> bool:
        """Whether these schemes cannot be told apart."""
        first = next(iter(runs.values()))
        whole = min(map(len, runs.values())) > self._few
        outcome = Outcome("done" if whole else "diverged", "", first)
        return len(identify_run("", outcome, push.system, runs).matches) == len(runs)


def _narrowed(found: Identification, pushed: Identification, words: str) -> Identification:
    """What matches on the system itself and when it is pushed; the larger of the two errors."""
    errors = {match.scheme: match for match in found.matches}
    both = [max(match, errors[match.scheme], key=lambda m: m.error) for match in pushed.ranking]
    seen = {match.scheme for match in both}
    rest = [match for match in found.ranking if match.scheme not in seen and match.error > found.tolerance]
    tolerance = max(found.tolerance, pushed.tolerance)
    narrowed = replace(found, ranking=(*both, *rest), tolerance=tolerance, told_apart_by=words)
    if pushed.matches:
        return narrowed
    same = len(found.matches)
    return narrowed.without_name(f"{same} schemes do the same here; after {words}, {pushed.reason}")


def _has_step(run: Trajectory, dt: float) -> bool:
    return len(run) > 1 and abs(run.times[1] - run.times[0] - dt) <= 1e-9 * dt
