"""Up to which dt is each stepper stable, predicted and measured?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engines.engine import Engine
from engines.measured_limit import limit_of_engine
from engines.process.isolation import EngineStepper
from experiments.experiment import Experiment, Result, Table
from experiments.runs.runner import current
from experiments.runs.side_by_side import Progress
from experiments.runs.steppers import all_steppers
from reference.errors import InputError, SolverError
from reference.identification import Identification, candidates_for, identify_run
from reference.limit import Limit
from reference.measured_stability import GROWN, PUSH, mode_growth
from reference.outcome import Outcome
from reference.pendulum import why_no_pendulum
from reference.scenes import find
from reference.schemes.catalogue import Scheme
from reference.state import Array, State, Trajectory
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of, pendulum_equilibrium, spring_equilibrium
from reference.theory.limits import fastest_rate, find_limit, stability_limit
from reference.theory.step_map import step_jacobian

#: An engine's limit, and the spectral radii of its step below and above it.
Measured = tuple[Limit, tuple[float, float] | None]

#: The cases of spring damping [N s/m] and drag [N s/m] that the report shows.
CASES: tuple[Mapping[str, float], ...] = ({}, {"damping": 0.1}, {"damping": 0.5}, {"drag": 0.1})

#: Measured limits are found to this part of themselves.
PRECISION = 1e-4

#: How many steps a scheme's mode is watched, and what it shows of growth beyond rounding and what is not linear.
MODE_STEPS, MODE_MARGIN = 200, 1e-8

#: An engine is identified from this many steps, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 200


@dataclass(frozen=True)
class Row:
    """One stepper on one system: predicted and measured limit, each with the reason where there is none.

    Attributes:
        radii: spectral radii of an engine's own step, measured at 0.99 and 1.01 of its measured limit.
    """

    stepper: str
    kind: str
    system: MassSpringSystem
    predicted: Limit
    measured: Limit
    outcome: str = "done"
    radii: tuple[float, float] | None = None

    @property
    def relative_difference(self) -> float | None:
        """(measured - predicted) / predicted."""
        if self.predicted.dt is None or self.measured.dt is None:
            return None
        return (self.measured.dt - self.predicted.dt) / self.predicted.dt

    @property
    def document(self) -> dict[str, Any]:
        """The row as the command line's JSON has it."""
        reasons = {"predicted": self.predicted.reason, "measured": self.measured.reason}
        if self.predicted.reason == self.measured.reason:
            reasons = {"predicted and measured": self.predicted.reason}
        return {
            "stepper": self.stepper,
            "damping": float(self.system.damping.max()),
            "drag": self.system.drag,
            "predicted_dt_s": self.predicted.dt,
            "measured_dt_s": self.measured.dt,
            "relative_difference": self.relative_difference,
            "outcome": self.outcome,
            "reason": "; ".join(f"{word}: {reason}" for word, reason in reasons.items() if reason),
        }


def stability_rows(system: MassSpringSystem, steppers: Sequence[Stepper], progress: Progress) -> list[Row]:
    """Predicted and measured limits of schemes and engines on one system, about its equilibrium.

    What an engine's limit should be is predicted from the scheme it is identified with, on this very system.

    Raises:
        SolverError: if the system has no equilibrium.
    """
    rest = spring_equilibrium(system)
    dt = 1 / fastest_rate(rest)
    with current().threads() as pool:
        engines = [s for s in steppers if isinstance(s, EngineStepper)]
        measured = {s.name: pool.submit(measure_engine, s, system, rest, dt) for s in engines}
        moved = {s.name: s.run(system, 0.1 * dt, IDENTIFYING_STEPS) for s in engines}
        seen = [(s, moved[s.name]) for s in engines]
        known = candidates_for(seen, system, 0.1 * dt, IDENTIFYING_STEPS) if engines else {}
        rows = []
        for stepper in steppers:
            progress(stepper.name)
            if isinstance(stepper, SchemeStepper):
                rows.append(_scheme_row(stepper, system, rest))
            elif isinstance(stepper, EngineStepper):
                outcome = moved[stepper.name]
                rows.append(_engine_row(stepper, system, rest, outcome, known, measured[stepper.name]))
            else:
                none = Limit(None, "stability is of schemes and engines; identify says which scheme this is")
                rows.append(Row(stepper.name, stepper.kind, system, none, none, "unsupported"))
    return rows


def _scheme_row(stepper: SchemeStepper, system: MassSpringSystem, rest: Equilibrium) -> Row:
    if stepper.on_rods:
        rest = equilibrium_of(stepper.equations, system)
    predicted, measured = stability_limit(stepper.scheme, rest), measure_scheme(stepper.scheme, rest)
    return Row(stepper.name, stepper.kind, system, predicted, measured)


def measure_scheme(scheme: Scheme, rest: Equilibrium) -> Limit:
    """The dt up to which a scheme, run from a push along its fastest-growing mode, does not let it grow."""
    return find_limit(lambda dt: _growth_of_mode(scheme, rest, dt), 1 / fastest_rate(rest), MODE_MARGIN, PRECISION / 10)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _growth_of_mode(scheme: Scheme, rest: Equilibrium, dt: float) -> float:
    """Run a scheme MODE_STEPS steps from a push along the mode that its Jacobian says grows fastest."""
    try:
        jacobian = step_jacobian(scheme, rest, dt)
        if not np.isfinite(jacobian).all():
            return np.inf
        values, modes = np.linalg.eig(jacobian)
        fastest = int(np.argmax(np.abs(values)))
        left = np.linalg.inv(modes)[fastest].conj()
        push = modes[:, fastest].real
        count, shape = len(push) // 2, rest.state.positions[rest.free].shape
        push *= PUSH * rest.scale / np.abs(push).max()
        x, v = rest.state.positions.copy(), rest.state.velocities.copy()
        x[rest.free] += push[:count].reshape(shape)
        v[rest.free] += push[count:].reshape(shape) / dt
        state, offsets, step = State(0.0, x, v), list[Array](), scheme.on(rest.motion)
        while len(offsets) <= MODE_STEPS:
            moved = (state.positions - rest.state.positions)[rest.free]
            offsets.append(np.concatenate([moved, dt * state.velocities[rest.free]], axis=None))
            if not np.abs(moved).max() <= GROWN * PUSH * rest.scale:  # the rest would say no more
                break
            state = step(state, dt)
    except (SolverError, np.linalg.LinAlgError):
        return np.inf
    return mode_growth(np.array(offsets), left)


def _engine_row(
    stepper: EngineStepper,
    system: MassSpringSystem,
    rest: Equilibrium,
    outcome: Outcome,
    known: Mapping[str, Trajectory],
    measurement: Future[Measured | Outcome],
) -> Row:
    identification = identify_run(stepper.name, outcome, system, known)
    predicted = _predict(identification, system, rest)
    answer = measurement.result()
    if isinstance(answer, Outcome):
        return Row(stepper.name, stepper.kind, system, predicted, Limit(None, answer.reason), answer.ending)
    measured, radii = answer
    return Row(stepper.name, stepper.kind, system, predicted, measured, radii=radii)


def _predict(identification: Identification, system: MassSpringSystem, rest: Equilibrium) -> Limit:
    """The limit of the scheme an engine was identified with."""
    if identification.identified_as is None:
        return Limit(None, identification.reason or str(identification).partition(": ")[2])
    named = catalogued()[identification.identified_as]
    about = rest_of_scheme(named, system, rest)
    return about if isinstance(about, Limit) else stability_limit(named.scheme, about)


def rest_of_scheme(named: SchemeStepper, system: MassSpringSystem, rest: Equilibrium) -> Equilibrium | Limit:
    """Where a scheme's system is at rest, with rods if it steps rods; where there is none, no limit and why."""
    try:
        return equilibrium_of(named.equations, system) if named.on_rods else rest
    except (InputError, SolverError) as error:
        return Limit(None, f"{named.name} has no rest to be predicted about: {error}")


def measure_engine(
    stepper: EngineStepper, system: MassSpringSystem, rest: Equilibrium, dt: float, precision: float = PRECISION
) -> Measured | Outcome:
    """An engine's limit, measured in a process of its own, from random pushes about the equilibrium it can have."""
    if stepper.version is None:
        return Outcome("unsupported", f"{stepper.engine.package} is not installed")
    own_rest = rest_of_engine(stepper.engine, system, rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    still, pushed = at_rest_and_pushed(system, own_rest)
    answer = stepper.isolate(
        limit_of_engine, stepper.engine, still, pushed, dt, precision, time_limit=2 * stepper.time_limit
    )
    if isinstance(answer, Outcome):
        return answer
    below, above = answer["radius_below"], answer["radius_above"]
    return Limit(answer["dt"], answer["reason"]), None if below is None or above is None else (below, above)


def rest_of_engine(engine: Engine, system: MassSpringSystem, rest: Equilibrium) -> Equilibrium | Outcome:
    """The equilibrium an engine can be started at: with stretched springs, or as rods for one that has no others."""
    named = catalogued().get(engine.identified_as.get("plain", ""))
    on_rods = named is not None and named.on_rods
    if "stretched" in engine.capabilities and not on_rods:
        return rest
    reason = why_no_pendulum(system)
    if reason:
        return Outcome("unsupported", f"{engine.name} cannot hang at rest: {reason}")
    return pendulum_equilibrium(system)


def at_rest_and_pushed(system: MassSpringSystem, rest: Equilibrium) -> tuple[Array, MassSpringSystem]:
    """Where all masses are at rest, and the system with every free mass (or angle) pushed a little, at random."""
    x = rest.state.positions.copy()
    push = np.random.default_rng(0).standard_normal(x[rest.free].shape)
    x[rest.free] += PUSH * rest.scale * push
    states = [rest.state, State(0.0, x, np.zeros_like(x))]
    still, pushed = rest.motion.trajectory(states).positions
    return still, replace(system, positions=pushed, velocities=np.zeros_like(pushed))


def run(progress: Progress) -> Result:
    """The limits of schemes and engines on the string, in every case.

    Engines' own schemes are left out: their limits are what the engines' are predicted to be.
    """
    steppers = [s for s in all_steppers().values() if s.kind in ("scheme", "in_place", "engine")]
    rows = []
    for case in CASES:
        label = ", ".join(f"{name} {value:g}" for name, value in case.items()) or "undamped"
        system = find("string").system(case)
        rows += stability_rows(system, steppers, lambda what, label=label: progress(f"{label}, {what}"))  # type: ignore[misc]
    return result_of(rows)


def result_of(rows: Sequence[Row]) -> Result:
    """Rows as findings and a table."""
    documents = [row.document for row in rows]
    columns = ["stepper", "damping [N s/m]", "drag [N s/m]", "predicted dt [s]", "measured dt [s]"]
    columns += ["relative difference", "outcome", "reason"]
    columns += ["engine's own spectral radius at 0.99 of it", "at 1.01"]
    undone = [f"{d['stepper']}: {d['outcome']}, {d['reason']}" for d in documents if d["outcome"] != "done"]
    failures = list(dict.fromkeys(undone))  # the same in several cases is said once
    table = Table("stability", columns, [[*row.document.values(), *(row.radii or (None, None))] for row in rows])
    return Result(_findings(rows), [table], {"rows": rows}, failures)


def _findings(rows: Sequence[Row]) -> list[str]:
    compared = [row for row in rows if row.relative_difference is not None]
    if not compared:
        return ["No stepper has a limit here that could be both predicted and measured."]
    worst = max(compared, key=lambda row: abs(row.relative_difference or 0.0))
    apart = abs(worst.relative_difference or 0.0)
    sentences = [
        f"{len(compared)} limits were predicted and measured: they agree to {apart:.1e} of themselves or better (the "
        f"widest apart is {worst.stepper})."
    ]
    never = sorted({row.stepper for row in rows if row.predicted.growth is not None})
    if never:
        sentences.append(f"Unstable at any dt in at least one of the cases, however small: {', '.join(never)}.")
    return sentences


EXPERIMENT = Experiment(
    name="stability",
    title="Stability limits",
    question="Up to which dt is each stepper stable, predicted and measured?",
    slides="15",
    run=run,
)
