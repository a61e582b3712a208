"""Which scenes does every engine take, and what is each engine there?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite, why
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import installed_engines
from reference.changes import whole_steps
from reference.identification import Identification, identify_all
from reference.outcome import Outcome
from reference.scenes import Scene, scenes
from reference.state import Trajectory
from reference.stepper import Stepper, catalogued
from reference.system import MassSpringSystem

#: How many steps an engine takes of a scene, and one that takes long on so many masses.
STEPS, FEWER = 100, 25

#: A mass this near to an obstacle, as a part of the system's size, touches it.
TOUCH = 1e-6

#: The scheme the scenes are shown with, and how many of its states are kept.
SHOWN_BY, STATES = "heun", 60

#: How often a dt is halved for a scene that diverges with its own.
HALVINGS = 6


#: Engines with what each did on a scene.
Outcomes = list[tuple[Stepper, Outcome]]


@dataclass(frozen=True)
class Run:
    """What an engine did on a scene, and which scheme it was there."""

    scene: Scene
    system: MassSpringSystem
    stepper: Stepper
    outcome: Outcome
    identification: Identification

    @property
    def met_obstacle(self) -> bool:
        """Whether a free mass touched anything."""
        trajectory = self.outcome.trajectory
        if trajectory is None:
            return False
        free = trajectory.positions[:, ~self.system.fixed]
        return any(float(o.signed_distances(free)[0].min()) <= TOUCH * self.system.size for o in self.system.obstacles)


@dataclass(frozen=True)
class Shown:
    """How a scene moves, from a run that is done.

    Attributes:
        motion: by SHOWN_BY, from start to end, `thinned`; None where no dt was short enough.
        dt: its step [s].
        failures: of longer ones, the scene's own first, how they ended.
    """

    system: MassSpringSystem
    motion: Trajectory | None
    dt: float
    failures: tuple[str, ...] = ()


def run(progress: Progress) -> Result:
    """All engines on all scenes; and how each scene moves, by the reference."""
    runs: list[Run] = []
    motions: dict[str, Shown] = {}
    for scene, outcomes in _by_engines(progress):
        progress(f"{scene.name}, which schemes the engines are")
        runs += _identified(scene, outcomes)
        progress(f"{scene.name}, {SHOWN_BY}")
        motions[scene.name] = shown(scene)
    return result_of(runs, motions)


def _by_engines(progress: Progress) -> Iterator[tuple[Scene, Outcomes]]:
    """Every scene with what every engine did on it. While one is worked on, the engines are at the next."""

    def outcomes(scene: Scene) -> Outcomes:
        setup = scene.setup({})

        def run_of(engine: Stepper) -> Outcome:
            return engine.run(setup.system, setup.dt, steps_of(engine, setup.system), setup.changes)

        return list(side_by_side(installed_engines(), run_of, lambda engine: progress(f"{scene.name}, {engine}")))

    first, *others = scenes().values()
    with current().threads(1) as ahead:
        scene, coming = first, ahead.submit(outcomes, first)
        for following in others:
            done, last = coming.result(), scene
            scene, coming = following, ahead.submit(outcomes, following)
            yield last, done
        yield scene, coming.result()


def steps_of(stepper: Stepper, system: MassSpringSystem) -> int:
    """How many steps a stepper takes: fewer from half the masses on that it says are the most for interactive use."""
    most = getattr(stepper, "interactive_up_to", None)
    return STEPS if most is None or 2 * len(system.masses) < most else FEWER


def _identified(scene: Scene, outcomes: Outcomes) -> Iterator[Run]:
    setup = scene.setup({})
    found = identify_all(outcomes, setup.system, setup.dt, STEPS, setup.changes).each
    for (stepper, outcome), identification in zip(outcomes, found, strict=True):
        yield Run(scene, setup.system, stepper, outcome, identification)


def shown(scene: Scene, dt: float | None = None) -> Shown:
    """A scene's motion with its own dt [s] or another; where that diverges, with the half of it, and so on."""
    failures: list[str] = []
    for halvings in range(HALVINGS + 1):
        setup = scene.setup({}, (dt or scene.dt) / 2**halvings)
        steps = whole_steps(setup.dt, setup.duration)
        outcome = catalogued()[SHOWN_BY].run(setup.system, setup.dt, steps, setup.changes)
        if outcome.ending == "done" and outcome.trajectory is not None:
            return Shown(setup.system, thinned(outcome.trajectory), setup.dt, tuple(failures))
        failures.append(f"{SHOWN_BY} on {scene.name}, dt = {setup.dt:g} s: {outcome.ending}, {outcome.reason}")
    return Shown(setup.system, None, setup.dt, tuple(failures))


def thinned(whole: Trajectory) -> Trajectory:
    """About STATES states of a trajectory, the first and the last of them too."""
    last = len(whole) - 1
    kept = [round(i * last / STATES) for i in range(STATES + 1)] if last > STATES else list(range(last + 1))
    return whole.frames(kept)


def result_of(runs: list[Run], motions: Mapping[str, Shown]) -> Result:
    """Runs and motions as findings and a table; what has no motion that is done is not shown."""
    failures = [
        f"{r.stepper.name} on {r.scene.name}: {r.outcome.ending}, {r.outcome.reason}"
        for r in runs
        if r.outcome.ending not in ("done", "unsupported")
    ]
    failures += [failure for shown in motions.values() for failure in shown.failures]
    seen = {name: (s.system, s.motion) for name, s in motions.items() if s.motion is not None}
    data = {"motions": seen, "dts": {name: motions[name].dt for name in seen}}
    return Result([*_findings(runs), *_explosions(motions)], [_table(runs)], data, failures)


def _explosions(motions: Mapping[str, Shown]) -> list[str]:
    """Which scenes are shown with a shorter dt than their own, and which not at all."""
    return [
        f"{SHOWN_BY} does not come to the end of {name} with the scene's own dt: "
        + ("none that was tried is short enough." if s.motion is None else f"it is shown with dt = {s.dt:g} s.")
        for name, s in motions.items()
        if s.failures
    ]


def _table(runs: list[Run]) -> Table:
    columns = ["scene", "slides", "masses", "springs", "stepper", "steps", "outcome", "identified as"]
    columns += ["deviation [m]", "compared by", "ties with", "reason"]
    rows = [
        [
            *(r.scene.name, r.scene.slides, len(r.system.masses), len(r.system.springs), r.stepper.name),
            *(steps_of(r.stepper, r.system), r.outcome.ending),
            *(r.identification.identified_as, finite(r.identification.error)),
            r.identification.compared if r.identification.ranking else None,
            *(", ".join(r.identification.ties), why(r.outcome, r.identification)),
        ]
        for r in runs
    ]
    return Table("scenes", columns, rows)


def _findings(runs: list[Run]) -> list[str]:
    moved = [r for r in runs if r.outcome.trajectory is not None]
    free = [r for r in moved if not r.met_obstacle]
    named = [r for r in free if r.identification.identified_as]
    if not named:
        return ["No engine ran on any scene that could be identified."]
    whole = [r for r in named if not r.identification.by_single_steps]
    fewer = sum(steps_of(r.stepper, r.system) == FEWER for r in free)
    steps = f"{STEPS} steps" + (f" ({fewer} of them of {FEWER}, as they take long)" if fewer else "")
    found = [f"Of {len(free)} engine runs of {steps} that meet no obstacle, {len(named)} are identified."]
    if whole:
        worst = max(whole, key=lambda r: r.identification.error)
        found.append(
            f"Of {len(whole)} of them the whole trajectory is that of a scheme of the catalogue; the worst, "
            f"{worst.stepper.name} on {worst.scene.name}, is {worst.identification.error:.1e} m from "
            f"{worst.identification.identified_as}."
        )
    if len(whole) < len(named):
        stepwise = max((r for r in named if r.identification.by_single_steps), key=lambda r: r.identification.error)
        found.append(
            f"{len(named) - len(whole)} multiply rounding, and are identified by single steps from states of their "
            f"own: each is the scheme's to {stepwise.identification.error:.1e} m."
        )
    tied = sum(bool(r.identification.ties) for r in named)
    if tied:
        found.append(
            f"In {tied} of them other schemes do the same there: the simplest is named, and the table has all."
        )
    strangers = [r for r in free if not r.identification.identified_as]
    if strangers:
        found.append(f"Not identified: {', '.join(map(_stranger, strangers))}.")
    contact = [r for r in moved if r.met_obstacle]
    if contact:
        alike = sum(bool(r.identification.identified_as) and not r.identification.by_single_steps for r in contact)
        away = sum(bool(r.identification.identified_as) and r.identification.by_single_steps for r in contact)
        found.append(
            f"Of {len(contact)} engine runs that meet an obstacle {alike} are a scheme with the reference's rule to "
            f"the end, and {away} a scheme in the steps in which they touch nothing: engines have contacts of their "
            "own."
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
