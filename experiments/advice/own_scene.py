"""What a report says of a user's own scene: which dt to use, how engines move it, what it is made of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from experiments.advice import wording as advice_words
from experiments.advice.accuracy import accurate_steps, table
from experiments.advice.accuracy import sentences as accuracy_words
from experiments.advice.advice import Advice
from experiments.divergence import result_of
from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import compare
from experiments.runs.progress import Progress
from experiments.runs.steppers import installed_engines
from experiments.scenes import thinned
from reference.changes import whole_steps
from reference.scenes import Setup
from reference.state import Array, Trajectory
from reference.stepper import catalogued

#: The scheme that shows how the scene moves.
SHOWN_BY = "rk4"

#: Where it blows up with the scene's own dt, these parts of that are tried.
SHORTER = (1, 4, 16, 64)


def experiments_of(setup: Setup) -> list[Experiment]:
    """The questions to a scene, the one about dt first."""
    found: list[Result | Exception] = []

    def ask(progress: Progress) -> Result:
        if not found:
            try:
                found.append(advice_words.answer(setup, progress))
            except Exception as error:  # raised below: whoever asks again does not wait for it again
                found.append(error)
        if isinstance(found[0], Exception):
            raise found[0]
        return found[0]

    questions = [
        ("advice", "Which dt", f"With which dt is {setup.name} stable, in each engine?", ask),
        (
            "motion",
            "The motion compared",
            "How far is each engine from the true motion?",
            lambda p: moved(setup, ask(p), p),
        ),
        ("own_scene", "The scene", "What is it made of, and where does it end?", lambda _: made_of(setup)),
    ]
    if not len(setup.system.springs):  # there is nothing that engines could do in different ways
        del questions[1]
    return [Experiment(name, title, question, "", run) for name, title, question, run in questions]


def moved(setup: Setup, advised: Result, progress: Progress) -> Result:
    """All engines that can take the scene against its true motion; with the advised dt where none survives its own."""
    found: Sequence[Advice] = advised.data["advice"]
    able = [advice.engine for advice in found if advice.own.ending != "unsupported"]
    survive = any(advice.own.ending == "done" for advice in found)
    steps = [advice.advised for advice in found if advice.advised]
    dt = setup.dt if survive or not steps else min(steps)
    at = Setup(setup.name, setup.system, dt, setup.duration, setup.changes)
    compared = compare(at, [engine for engine in installed_engines() if engine.name in able], progress)
    result, accurate = result_of(compared), accurate_steps(compared, found)
    start = f"With dt = {dt:g} s, {'its own' if survive or not steps else 'as none comes to its end with its own'}. "
    first, *others = result.findings
    findings = [start + first, *accuracy_words(accurate, dt), *others]
    tables = [*result.tables, table(accurate)] if accurate else result.tables
    return Result(findings, tables, result.data, result.failures)


def made_of(setup: Setup) -> Result:
    """The scene's parameters and changes in a table, and its motion by the reference."""
    system = setup.system
    rows: list[list[object]] = [
        ["masses", len(system.masses), ""],
        ["of them fixed", int(system.fixed.sum()), ""],
        ["springs", len(system.springs), ""],
        ["mass of one", _range(system.masses), "kg"],
        ["rest length", _range(system.rest_lengths), "m"],
        ["stiffness", _range(system.stiffness), "N/m"],
        ["damping along springs", _range(system.damping), "N s/m"],
        ["drag on every mass", f"{system.drag:g}", "N s/m"],
        ["gravity", ", ".join(f"{g:g}" for g in system.gravity), "m/s^2"],
        ["obstacles", ", ".join(obstacle.kind for obstacle in system.obstacles) or "none", ""],
        ["dt", f"{setup.dt:g}", "s"],
        ["duration", f"{setup.duration:g}", "s"],
        *_changes(setup),
    ]
    shown, dt = _motion(setup)
    end = f"after {shown.times[-1]:g} s, by {SHOWN_BY} with dt = {dt:g} s"
    finding = f"{setup.name} has {len(system.masses)} masses and {len(system.springs)} springs; it is shown {end}."
    return Result([finding], [Table("scene", ["what", "value", "unit"], rows)], {"system": system, "motion": shown})


def _range(values: Array) -> str:
    if not len(values):
        return "none"
    low, high = float(np.min(values)), float(np.max(values))
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _changes(setup: Setup) -> list[list[object]]:
    """Each parameter that changes on the fly, when for the first and the last time."""
    rows: list[list[object]] = []
    for name in dict.fromkeys(change.parameter for change in setup.changes):
        times = sorted(change.time for change in setup.changes if change.parameter == name)
        count = f"{len(times)} times, from {times[0]:g} to {times[-1]:g}" if len(times) > 1 else f"at {times[0]:g}"
        rows.append([f"{name} changes", count, "s"])
    return rows


def _motion(setup: Setup) -> tuple[Trajectory, float]:
    """By the reference; and the step [s], as much shorter than its own as it takes to live."""
    for shorter in SHORTER:
        dt = setup.dt / shorter
        outcome = catalogued()[SHOWN_BY].run(setup.system, dt, whole_steps(dt, setup.duration), setup.changes)
        if outcome.ending == "done" and outcome.trajectory is not None:
            return thinned(outcome.trajectory), dt
    return Trajectory.of([setup.system.start]), dt
