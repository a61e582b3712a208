"""With which dt should a scene be run in each engine? Measured, predicted and tried.

An engine's limit is measured, from small perturbations of the scene at rest, and predicted, from the scheme the engine
is identified with there. The advice is a step a tenth below the limit, and it is tried: the scene itself is run with
it, and with a step a tenth above the limit the perturbations have to grow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, floor, log10

from engines.process.isolation import EngineStepper
from experiments.advice.reasons import Reasons, reasons_of
from experiments.limits.engine_limit import measure_engine
from experiments.limits.predictions import Predictions, named
from experiments.runs.claims import claimed
from experiments.runs.comparison import too_slow
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.changes import whole_steps
from reference.errors import InputError, SolverError
from reference.identification import Identification
from reference.limit import Limit
from reference.outcome import Outcome
from reference.pendulum import PendulumMotion, why_no_pendulum
from reference.scenes import Setup
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.rates import fastest_rate

#: The advised step, and the one that is to be unstable, as parts of the limit.
ADVISED, REFUTED = 0.9, 1.1

#: Frames in a second.
FRAMES = 60

#: How often the step is halved where the scene itself needs shorter ones than perturbations of its rest do.
HALVINGS = 6

#: How many steps an engine is identified from, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 40


@dataclass(frozen=True)
class Advice:
    """What there is to say of one engine.

    Attributes:
        engine: its name.
        scheme: what it was identified as on this scene; None where it was not.
        predicted, measured: its limits, each with the reason where there is none; of the measured one, whether
            perturbations grow at REFUTED of it.
        own: how the scene ended with the dt it was given.
        advised: the step to use [s]; None where there is none.
        confirmed: how the scene ended with it.
        reasons: why the limit is where it is, by theory; None where no scheme is known.
        ties: other schemes that match it as well, on this scene and pushed.
    """

    engine: str
    scheme: str | None
    predicted: Limit
    measured: Limit
    own: Outcome
    advised: float | None = None
    confirmed: Outcome | None = None
    reasons: Reasons | None = None
    ties: tuple[str, ...] = ()

    @property
    def limit(self) -> float | None:
        """The largest stable step [s], measured."""
        return self.measured.dt

    @property
    def safe(self) -> float | None:
        """The step [s] that advice is taken from: the measured limit, or the predicted one where that is shorter.

        Perturbations may grow too slowly to be seen. Where no limit was measured and one is certified, it is that one.
        """
        if self.measured.dt is None:
            return self.predicted.dt if self.predicted.certainty == "certified" else None
        return min(self.measured.dt, self.predicted.dt or self.measured.dt)

    @property
    def substeps(self) -> int | None:
        """How many steps a frame of 1/60 s takes, each at most ADVISED of the limit; None without a limit."""
        return None if self.safe is None else ceil(1 / (FRAMES * ADVISED * self.safe))

    @property
    def grows(self) -> bool | None:
        """Whether perturbations grow at REFUTED of the limit; None where that was not looked at."""
        return self.measured.grows_beyond

    @property
    def on_rods(self) -> bool:
        """Whether the engine puts rods for the springs: what it steps is not quite the scene."""
        return self.scheme is not None and stepper_named(self.scheme).on_rods


def advise(setup: Setup, engines: Sequence[EngineStepper], progress: Progress) -> list[Advice]:
    """What there is to say of engines, for a scene and its dt.

    Raises:
        InputError: for a dt or duration that makes no sense.
    """
    whole_steps(setup.dt, setup.duration)
    with current().threads() as pool:
        progress("the scene at its own dt")
        ran = pool.map(lambda engine: _run(engine, setup, setup.dt), engines)
        own = {engine.name: outcome for engine, outcome in zip(engines, ran, strict=True)}
        try:
            rest = rest_of(setup.system)
        except (SolverError, InputError) as error:
            return [_without_limit(engine.name, own[engine.name], str(error)) for engine in engines]
        able = [engine for engine in engines if own[engine.name].ending != "unsupported"]
        predictions = Predictions(replace(setup.system, obstacles=()), rest)
        progress("identification")
        runs = pool.map(lambda engine: predictions.identifying_run(engine, IDENTIFYING_STEPS), able)
        identified = predictions.identified(zip(able, runs, strict=True), IDENTIFYING_STEPS)
        for name, found in identified.items():
            progress(f"predicted limit of {name}")
            predictions.of_engine(found)
        progress("measured limits, and advised steps tried")

        def advised(e: EngineStepper) -> Advice:
            return _advice(e, setup, predictions, identified[e.name], own[e.name])

        told = {advice.engine: advice for advice in pool.map(advised, able)}
    return [told.get(e.name) or _without_limit(e.name, own[e.name], own[e.name].reason) for e in engines]


def _without_limit(engine: str, own: Outcome, reason: str) -> Advice:
    return Advice(engine, None, Limit(None, reason), Limit(None, reason), own)


def rest_of(system: MassSpringSystem) -> Equilibrium:
    """Where a system is at rest: without obstacles; what nothing holds, in the frame that falls with it.

    Raises:
        SolverError: if it comes to no rest.
        InputError: if there is nothing in it that could be unstable.
    """
    if system.fixed.all():
        raise InputError("no mass can move, and so any step is stable")
    rest = spring_equilibrium(replace(system, obstacles=()))
    if fastest_rate(rest) == 0:
        raise InputError("no spring and no drag moves a mass, and so any step is stable")
    return rest


def rounded_down(dt: float) -> float:
    """A step that is easy to say: two figures, and not longer [s]."""
    unit = 10.0 ** (floor(log10(dt)) - 1)
    return float(f"{floor(dt / unit * (1 + 1e-12)) * unit:.2g}")


def _advice(
    engine: EngineStepper, setup: Setup, predictions: Predictions, found: Identification, own: Outcome
) -> Advice:
    scheme, predicted = named(found), predictions.of_engine(found)
    measured = measure_engine(engine, predictions, scheme, predicted)
    known = Advice(engine.name, found.identified_as, predicted, _limit(measured), own, ties=tuple(found.ties))
    if scheme is not None and not scheme.on_rods:
        known = replace(known, reasons=reasons_of(scheme.scheme, predictions, predicted, setup.dt))
    if known.safe is None:
        return known
    dt, confirmed = _tried(engine, setup, own, rounded_down(ADVISED * known.safe))
    return replace(known, advised=dt, confirmed=confirmed)


def _limit(measured: Limit | Outcome) -> Limit:
    return Limit(None, measured.reason) if isinstance(measured, Outcome) else measured


def _tried(engine: EngineStepper, setup: Setup, own: Outcome, dt: float) -> tuple[float | None, Outcome]:
    """The step with which the scene comes to its end, from a dt on by halving; None where it never does."""
    works = setup.dt if own.ending == "done" else 0.0
    confirmed = _run(engine, setup, dt)
    for _ in range(HALVINGS):
        if confirmed.ending != "diverged":
            break
        if dt > works > dt / 2:
            return works, own
        dt = rounded_down(dt / 2)
        confirmed = _run(engine, setup, dt)
    return (dt if confirmed.ending == "done" else None), confirmed


def _run(engine: EngineStepper, setup: Setup, dt: float) -> Outcome:
    """How the scene ends with a dt, without what it did on the way."""
    left_out = _left_out(engine, setup.system)
    if left_out:
        return left_out
    outcome = engine.run(setup.system, dt, max(1, round(setup.duration / dt)), setup.changes)
    return replace(outcome, trajectory=None)


def _left_out(engine: EngineStepper, system: MassSpringSystem) -> Outcome | None:
    """An engine that would take minutes, or whose rods are a pendulum's where none hangs, is not asked."""
    slow = too_slow(engine, system)
    if slow:
        return replace(slow, reason=slow.reason.partition(";")[0])
    scheme = claimed(engine.engine)
    hangs = scheme is not None and scheme.equations is PendulumMotion
    reason = why_no_pendulum(replace(system, obstacles=())) if hangs else None
    return Outcome("unsupported", f"{engine.name} puts rods for springs: {reason}") if reason else None
