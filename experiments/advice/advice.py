"""With which dt should a scene be run in each engine? Measured, predicted and tried.

An engine's limit is measured, from small perturbations of the scene at rest, and predicted, from the scheme the engine
is identified with there. The advice is a step a tenth below the limit, and it is tried: the scene itself is run with
it, and with a step a tenth above the limit the perturbations have to grow.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import floor, log10

from engines.measured_limit import limit_of_engine_near
from engines.process.isolation import EngineStepper
from experiments.limits.perturbed import perturbed, rest_of_engine, rest_of_scheme
from experiments.runs.claims import claimed
from experiments.runs.comparison import too_slow
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.changes import whole_steps
from reference.errors import InputError, SolverError
from reference.identification import Identification, identify_all
from reference.limit import Limit
from reference.outcome import Outcome
from reference.pendulum import PendulumMotion, why_no_pendulum
from reference.scenes import Setup
from reference.schemes.catalogue import find
from reference.stepper import SchemeStepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import fastest_rate, find_limit, growth

#: The advised step, and the one that is to be unstable, as parts of the limit.
ADVISED, REFUTED = 0.9, 1.1

#: How often the step is halved where the scene itself needs shorter ones than perturbations of its rest do.
HALVINGS = 6

#: How many steps an engine is identified from, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 40

#: Limits are predicted and measured to this part of themselves.
PREDICTION, MEASUREMENT = 1e-4, 1e-3

#: What is solved to 1e-8 m/s only has the limits of what is solved to the end.
SOLVED = {"kick_drift_truncated_damping": "kick_drift_implicit_damping"}


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
    """

    engine: str
    scheme: str | None
    predicted: Limit
    measured: Limit
    own: Outcome
    advised: float | None = None
    confirmed: Outcome | None = None

    @property
    def limit(self) -> float | None:
        """The largest stable step [s], measured."""
        return self.measured.dt

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
        identified, predicted = _predicted(rest, able, progress)
        progress("measured limits, and advised steps tried")

        def advised(e: EngineStepper) -> Advice:
            return _advice(e, setup, rest, identified[e.name].identified_as, predicted[e.name], own[e.name])

        found = {advice.engine: advice for advice in pool.map(advised, able)}
    return [found.get(e.name) or _without_limit(e.name, own[e.name], own[e.name].reason) for e in engines]


def _without_limit(engine: str, own: Outcome, reason: str) -> Advice:
    return Advice(engine, None, Limit(None, reason), Limit(None, reason), own)


def rest_of(system: MassSpringSystem) -> Equilibrium:
    """Where a system is at rest: without obstacles, and without weight where nothing holds it.

    Raises:
        SolverError: if it comes to no rest.
        InputError: if there is nothing in it that could be unstable.
    """
    if not len(system.springs) or system.fixed.all():
        raise InputError("there is no spring that could move a mass, and so any step is stable")
    alone = replace(system, obstacles=())
    rest = spring_equilibrium(alone if system.fixed.any() else replace(alone, gravity=0 * system.gravity))
    if fastest_rate(rest) == 0:
        raise InputError("no spring and no drag moves a mass, and so any step is stable")
    return rest


def rounded_down(dt: float) -> float:
    """A step that is easy to say: two figures, and not longer [s]."""
    unit = 10.0 ** (floor(log10(dt)) - 1)
    return float(f"{floor(dt / unit * (1 + 1e-12)) * unit:.2g}")


def _predicted(
    rest: Equilibrium, engines: Sequence[EngineStepper], progress: Progress
) -> tuple[Mapping[str, Identification], Mapping[str, Limit]]:
    """What engines are identified as on the system at rest, and the limits that follow; each scheme's once."""
    system = rest.motion.system  # type: ignore[attr-defined]
    dt = 0.1 / fastest_rate(rest)
    progress("identification")
    with current().threads() as pool:
        runs = list(pool.map(lambda engine: engine.run(system, dt, IDENTIFYING_STEPS), engines))
    seen = list(zip(engines, runs, strict=True))
    each = identify_all(seen, system, dt, IDENTIFYING_STEPS).each
    identified = {found.stepper: found for found in each}
    limits: dict[str, Limit] = {}
    for name in dict.fromkeys(found.identified_as for found in identified.values()):
        if name is not None:
            progress(f"predicted limit of {name}")
            limits[name] = predict(stepper_named(name), system, rest)
    predicted = {
        found.stepper: limits.get(found.identified_as or "", Limit(None, f"not identified; {found.reason}"))
        for found in each
    }
    return identified, predicted


def predict(named: SchemeStepper, system: MassSpringSystem, rest: Equilibrium) -> Limit:
    """A scheme's limit about a rest, or why it is not known."""
    scheme = find(SOLVED[named.name]) if named.name in SOLVED else named.scheme
    about = rest_of_scheme(named, system, rest)
    if isinstance(about, Limit):
        return about
    unit = 1 / fastest_rate(about)
    return find_limit(lambda dt: growth(scheme, about, dt) - 1, unit, precision=PREDICTION)


def _advice(
    engine: EngineStepper, setup: Setup, rest: Equilibrium, scheme: str | None, predicted: Limit, own: Outcome
) -> Advice:
    system = rest.motion.system  # type: ignore[attr-defined]
    about = rest_of_engine(engine.engine, system, rest)
    if isinstance(about, Outcome):
        return Advice(engine.name, scheme, predicted, Limit(None, about.reason), own)
    asked = (predicted.dt, 1 / fastest_rate(about), MEASUREMENT, REFUTED)
    measured = engine.isolate(
        limit_of_engine_near, engine.engine, *perturbed(system, about), *asked, time_limit=2 * engine.time_limit
    )
    if isinstance(measured, Outcome):
        return Advice(engine.name, scheme, predicted, Limit(None, measured.reason), own)
    if measured.dt is None:
        return Advice(engine.name, scheme, predicted, measured, own)
    limit = min(measured.dt, predicted.dt or measured.dt)  # perturbations may grow too slowly to be seen
    dt, confirmed = _tried(engine, setup, own, rounded_down(ADVISED * limit))
    return Advice(engine.name, scheme, predicted, measured, own, dt, confirmed)


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
