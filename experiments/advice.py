"""With which dt should a scene be run in each engine? What a report of somebody's own scene says.

An engine's limit is measured, from small pushes about the scene at rest, and predicted, from the scheme the engine is
identified with there. The advice is a step a tenth below the limit, and it is tried: the scene itself is run with it,
and with a step a tenth above the limit the pushes have to grow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import floor, log10

from engines.isolation import EngineStepper
from engines.limits import growths_of_engine
from experiments.experiment import Result, Table
from experiments.runner import current
from experiments.runs import Progress
from experiments.stability import Row, at_rest_and_pushed, rest_of_engine, stability_rows
from experiments.steppers import all_steppers
from reference.changes import whole_steps
from reference.outcome import Outcome
from reference.probe import SEEN, STEPS
from reference.scenes import Setup
from reference.stability import spring_equilibrium
from reference.system import MassSpringSystem

#: The advised step, and the one that is to be unstable, as parts of the limit.
ADVISED, REFUTED = 0.9, 1.1

#: Where the scene itself needs shorter steps than pushes about its rest do, this often the step is halved.
HALVINGS = 6


@dataclass(frozen=True)
class Advice:
    """What there is to say of one engine.

    Attributes:
        row: its predicted and measured limit.
        own: how the scene ended with the dt it was given.
        advised: the step to use [s]; None where there is none.
        confirmed: how the scene ended with it.
        grows: whether pushes grow at REFUTED of the limit; None where that was not looked at.
    """

    row: Row
    own: Outcome
    advised: float | None
    confirmed: Outcome | None
    grows: bool | None

    @property
    def limit(self) -> float | None:
        """The largest stable step [s], measured."""
        return self.row.measured.dt


def advise(setup: Setup, progress: Progress) -> list[Advice]:
    """What there is to say of every installed engine, for a scene and its dt.

    Raises:
        SolverError: if the scene, left to itself, comes to no rest.
    """
    engines = [s for s in all_steppers().values() if isinstance(s, EngineStepper) and s.version is not None]
    still = at_rest(setup.system)
    rows = {row.stepper: row for row in stability_rows(still, engines, progress)}
    progress("advised steps tried")
    with current().threads() as pool:
        found = pool.map(lambda engine: _advice(engine, setup, still, rows[engine.name]), engines)
        return list(found)


def at_rest(system: MassSpringSystem) -> MassSpringSystem:
    """The system whose stability is asked for: without obstacles, and without weight where nothing holds it."""
    alone = replace(system, obstacles=())
    return alone if system.fixed.any() else replace(alone, gravity=0 * system.gravity)


def rounded_down(dt: float) -> float:
    """A step that is easy to say: two figures, and not longer [s]."""
    unit = 10.0 ** (floor(log10(dt)) - 1)
    return float(f"{floor(dt / unit * (1 + 1e-12)) * unit:.2g}")


def _advice(engine: EngineStepper, setup: Setup, still: MassSpringSystem, row: Row) -> Advice:
    own = _run(engine, setup, setup.dt)
    if row.outcome != "done" or row.measured.dt is None:
        return Advice(row, own, None, None, None)
    dt = rounded_down(ADVISED * row.measured.dt)
    confirmed = _run(engine, setup, dt)
    for _ in range(HALVINGS):
        if confirmed.ending != "diverged":
            break
        dt = rounded_down(dt / 2)
        confirmed = _run(engine, setup, dt)
    return Advice(row, own, dt, confirmed, _grows(engine, still, REFUTED * row.measured.dt))


def _run(engine: EngineStepper, setup: Setup, dt: float) -> Outcome:
    """How the scene ends with a dt, without what it did on the way."""
    outcome = engine.run(setup.system, dt, max(1, round(setup.duration / dt)), setup.changes)
    return replace(outcome, trajectory=None)


def _grows(engine: EngineStepper, still: MassSpringSystem, dt: float) -> bool | None:
    rest = rest_of_engine(engine.engine, still, spring_equilibrium(still))
    if isinstance(rest, Outcome):
        return None
    x, pushed = at_rest_and_pushed(still, rest)
    answer = engine.isolate(growths_of_engine, engine.engine, [(x, pushed, dt)], STEPS)
    return None if isinstance(answer, Outcome) else bool(answer["growth"][0] > SEEN)


def result_of(setup: Setup, found: Sequence[Advice]) -> Result:
    """Advice as findings, the most important first, and a table."""
    columns = ["engine", "at the scene's dt", "margin", "predicted limit [s]", "measured limit [s]"]
    columns += ["advised dt [s]", "the scene with it", "pushes at 1.1 of the limit", "reason"]
    rows = [_table_row(setup, advice) for advice in found]
    failures = [f"{a.row.stepper}: {a.own.ending}, {a.own.reason}" for a in found if a.own.ending != "done"]
    return Result(findings(setup, found), [Table("advice", columns, rows)], {"advice": found, "setup": setup}, failures)


def _table_row(setup: Setup, advice: Advice) -> list[object]:
    margin = None if advice.limit is None else advice.limit / setup.dt
    confirmed = advice.confirmed.ending if advice.confirmed else None
    grows = {None: None, True: "grow", False: "do not grow"}[advice.grows]
    reason = advice.own.reason or advice.row.measured.reason
    row = advice.row
    limits = [row.predicted.dt, row.measured.dt]
    return [row.stepper, advice.own.ending, margin, *limits, advice.advised, confirmed, grows, reason]


def findings(setup: Setup, found: Sequence[Advice]) -> list[str]:
    """A sentence for every engine that can take the scene; then those that cannot, with the reason."""
    able = [advice for advice in found if advice.row.outcome == "done" or advice.own.ending != "unsupported"]
    others = [advice for advice in found if advice not in able]
    sentences = [_overall(setup, able), *(sentence(setup, advice) for advice in able)]
    return [*sentences, *(f"{advice.row.stepper} cannot take this scene: {advice.own.reason}." for advice in others)]


def sentence(setup: Setup, advice: Advice) -> str:
    """What one engine does at the scene's dt, and what to use."""
    name, dt, limit = advice.row.stepper, setup.dt, advice.limit
    if limit is None:
        ended = (
            "runs to its end" if advice.own.ending == "done" else f"ends as {advice.own.ending}: {advice.own.reason}"
        )
        return f"{name}, at dt = {dt:g} s, {ended}; no limit was measured ({advice.row.measured.reason})."
    use = f"use dt = {advice.advised:g} s or less" if advice.advised else "no step is known to be safe"
    if dt > limit:
        return f"{name} at dt = {dt:g} s blows up: it is {dt / limit:.2f} times the limit, {limit:.3g} s; {use}."
    if advice.own.ending != "done":
        said = f"{name} at dt = {dt:g} s ends as {advice.own.ending}, though the limit at rest is {limit:.3g} s"
        return f"{said} ({advice.own.reason}): {use}."
    if ADVISED * limit < dt:
        return f"{name} at dt = {dt:g} s is stable, but only just, by {limit / dt - 1:.1%}: {use}."
    return f"{name} at dt = {dt:g} s is stable with margin {limit / dt:.2f}: its limit is {limit:.3g} s."


def _overall(setup: Setup, able: Sequence[Advice]) -> str:
    limited = [advice for advice in able if advice.limit is not None]
    if not able:
        return "No installed engine can take this scene."
    if not limited:
        return "For no engine was a limit measured."
    stable = [a for a in limited if setup.dt <= (a.limit or 0) and a.own.ending == "done"]
    steps = [advice.advised for advice in limited if advice.advised]
    start = (
        f"At dt = {setup.dt:g} s {len(stable)} of {len(limited)} engine settings with a limit are stable on this scene"
    )
    return f"{start}; dt = {min(steps):g} s is safe in all of them." if steps else f"{start}."


def answer(setup: Setup, progress: Progress) -> Result:
    """`advise`, as findings and a table. Raises as it does; InputError for a dt or duration that makes no sense."""
    whole_steps(setup.dt, setup.duration)
    return result_of(setup, advise(setup, progress))
