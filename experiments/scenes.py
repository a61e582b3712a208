"""Which scenes does every engine take, and what is each engine there?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import installed_engines
from reference.identification import LARGE, Identification, candidates_for, identify_run
from reference.outcome import Outcome
from reference.scenes import Scene, Setup, scenes
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate
from reference.state import Trajectory
from reference.stepper import Stepper, catalogued, stepper_named
from reference.system import MassSpringSystem

#: How many steps every engine takes of a scene, and how near a scheme must be for it to be identified [m].
STEPS, NEAR = 100, 1e-9

#: For how many steps a run that no engine's scheme is near to is compared with the whole catalogue: on a mesh of rods
#: STEPS would take minutes.
FIRST = 20

#: A mass this near to an obstacle, as a part of the system's size, touches it.
TOUCH = 1e-6

#: The scheme the scenes are shown with, and how many of its states are kept.
SHOWN_BY, STATES = "heun", 60


@dataclass(frozen=True)
class Run:
    """What an engine did on a scene, and which scheme it was there, compared over some steps."""

    scene: Scene
    system: MassSpringSystem
    stepper: Stepper
    outcome: Outcome
    identification: Identification
    compared: int

    @property
    def met_obstacle(self) -> bool:
        """Whether a free mass touched anything."""
        trajectory = self.outcome.trajectory
        if trajectory is None:
            return False
        free = trajectory.positions[:, ~self.system.fixed]
        return any(float(o.signed_distances(free)[0].min()) <= TOUCH * self.system.size for o in self.system.obstacles)

    @property
    def is_identified(self) -> bool:
        """Whether a scheme is as near as it should be."""
        return self.identification.error <= NEAR


def run(progress: Progress) -> Result:
    """All engines on all scenes; and how each scene moves, by the reference."""
    runs: list[Run] = []
    motions: dict[str, tuple[MassSpringSystem, Trajectory]] = {}
    for name, scene in scenes().items():
        runs += _runs(scene, lambda engine, name=name: progress(f"{name}, {engine}"))  # type: ignore[misc]
        progress(f"{name}, {SHOWN_BY}")
        setup = scene.setup({})
        motions[name] = setup.system, motion(setup)
    return result_of(runs, motions)


def _runs(scene: Scene, progress: Progress) -> Iterator[Run]:
    setup = scene.setup({})
    system, changes = setup.system, setup.changes
    engines = installed_engines()
    outcomes = list(side_by_side(engines, lambda s: s.run(system, scene.dt, STEPS, changes), progress))
    claimed = {name: stepper_named(name) for stepper in engines for name in stepper.claims}
    large = len(system.masses) > LARGE
    in_order = {**catalogued(), **claimed}
    tried = [c for name, c in in_order.items() if name in claimed and not (large and c.on_rods)]
    moved = [outcome for _, outcome in outcomes if outcome.trajectory is not None]
    known = _known(tried, moved, setup)
    found = {s.name: identify_run(s.name, outcome, system, known) for s, outcome in outcomes}
    begun = [(s, _beginning(o)) for s, o in outcomes if o.trajectory is not None and found[s.name].error > NEAR]
    short = candidates_for(begun, system, scene.dt, FIRST, changes).whole if begun else {}
    for stepper, outcome in begun:
        found[stepper.name] = identify_run(stepper.name, outcome, system, short)
    strangers = {stepper.name for stepper, _ in begun}
    for stepper, outcome in outcomes:
        compared = FIRST if stepper.name in strangers else STEPS
        yield Run(scene, system, stepper, outcome, found[stepper.name], compared)


def _known(steppers: Sequence[Stepper], runs: Sequence[Outcome], setup: Setup) -> dict[str, Trajectory]:
    """Of these schemes the trajectories that some run follows; which one does not is seen in the first steps."""
    known: dict[str, Trajectory] = {}
    system, changes = setup.system, setup.changes
    for stepper in steppers:
        runs = [run for run in runs if identify_run("", run, system, known).error > NEAR]
        begun = stepper.run(system, setup.dt, FIRST, changes).trajectory if runs else None
        if begun is None:
            continue
        if any(identify_run("", _beginning(run), system, {"": begun}).error <= NEAR for run in runs):
            whole = stepper.run(system, setup.dt, STEPS, changes).trajectory
            known |= {} if whole is None else {stepper.name: whole}
    return known


def _beginning(outcome: Outcome) -> Outcome:
    """What there was of a run after the first steps."""
    assert outcome.trajectory is not None
    return replace(outcome, trajectory=outcome.trajectory.frames(slice(FIRST + 1)))


def motion(setup: Setup) -> Trajectory:
    """A scene's motion by the reference, from its start to its end, `thinned`."""
    return thinned(simulate(setup.system, find_scheme(SHOWN_BY), setup.dt, setup.duration, setup.changes))


def thinned(whole: Trajectory) -> Trajectory:
    """About STATES states of a trajectory, the first and the last of them too."""
    last = len(whole) - 1
    kept = [round(i * last / STATES) for i in range(STATES + 1)] if last > STATES else list(range(last + 1))
    return whole.frames(kept)


def result_of(runs: list[Run], motions: Mapping[str, tuple[MassSpringSystem, Trajectory]]) -> Result:
    """Runs and motions as findings and a table."""
    failures = [
        f"{r.stepper.name} on {r.scene.name}: {r.outcome.ending}, {r.outcome.reason}"
        for r in runs
        if r.outcome.ending not in ("done", "unsupported")
    ]
    return Result(_findings(runs), [_table(runs)], {"motions": motions}, failures)


def _table(runs: list[Run]) -> Table:
    columns = ["scene", "slides", "masses", "springs", "stepper", "outcome", "identified as", "deviation [m]"]
    columns += ["over [steps]", "reason"]
    rows = [
        [
            *(r.scene.name, r.scene.slides, len(r.system.masses), len(r.system.springs), r.stepper.name),
            *(r.outcome.ending, r.identification.ranking[0].scheme if r.is_identified else None),
            *(finite(r.identification.error), None if r.outcome.trajectory is None else r.compared, r.outcome.reason),
        ]
        for r in runs
    ]
    return Table("scenes", columns, rows)


def _findings(runs: list[Run]) -> list[str]:
    moved = [r for r in runs if r.outcome.trajectory is not None]
    free = [r for r in moved if not r.met_obstacle]
    named = [r for r in free if r.is_identified]
    if not named:
        return ["No engine ran on any scene that could be identified."]
    worst = max(named, key=lambda r: r.identification.error)
    briefly = sum(r.compared < STEPS for r in named)
    found = [
        f"Of {len(free)} engine runs of {STEPS} steps that meet no obstacle, {len(named)} are a scheme of the "
        f"catalogue to {NEAR:g} m; the worst of them, {worst.stepper.name} on {worst.scene.name}, is "
        f"{worst.identification.error:.1e} m from {worst.identification.ranking[0].scheme}."
        + (f" {briefly} of them were compared for {FIRST} steps only." if briefly else "")
    ]
    strangers = [r for r in free if not r.is_identified]
    if strangers:
        found.append(f"Not identified: {', '.join(map(_stranger, strangers))}.")
    contact = [r for r in moved if r.met_obstacle]
    if contact:
        alike = sum(r.is_identified and r.compared == STEPS for r in contact)
        found.append(
            f"Of {len(contact)} engine runs that meet an obstacle {alike} are a scheme with the reference's rule to "
            "the end: engines have contacts of their own."
        )
    lacking = Counter(
        r.outcome.reason.removeprefix(f"{r.stepper.name} cannot do ") for r in runs if r.outcome.ending == "unsupported"
    )
    if lacking:
        reasons = "; ".join(f"{reason} ({times})" for reason, times in lacking.most_common())
        found.append(f"{lacking.total()} of {len(runs)} runs are unsupported, for {reasons}.")
    return found


def _stranger(run: Run) -> str:
    ranking = run.identification.ranking
    where = f"{run.stepper.name} on {run.scene.name}"
    return f"{where}, {ranking[0].error:.1e} m from {ranking[0].scheme}" if ranking else where


EXPERIMENT = Experiment(
    name="scenes",
    title="Every scene in every engine",
    question="Which scenes does every engine take, and which scheme is it there?",
    slides="2-29",
    run=run,
)
