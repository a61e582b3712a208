"""Runs of engines and of schemes: each is made once in a session, whoever asks for it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache

from engines.engine import Engine
from experiments.runs.task import digest
from reference.identification import amplified
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import stepper_named
from tests.conformance.case import Case
from tests.conformance.children import result_of, run_all

#: How runs of engines ended, by the digest of engine, system, dt, steps and changes.
_ENDED: dict[str, Outcome] = {}


def outcomes(engine: Engine, cases: Sequence[Case]) -> list[Outcome]:
    """How each case ends for an engine. One process runs all that have not been run."""
    keys = [digest(engine, _digest_of(case)) for case in cases]
    new = {key: case for key, case in zip(keys, cases, strict=True) if key not in _ENDED}
    if new:
        _ENDED.update(zip(new, result_of(run_all, engine, [*new.values()]), strict=True))
    return [_ENDED[key] for key in keys]


@cache
def _digest_of(case: Case) -> str:
    return digest(case.system, case.dt, case.steps, case.changes)


def outcome_of(engine: Engine, case: Case) -> Outcome:
    """How a case ends for an engine."""
    return outcomes(engine, [case])[0]


@cache
def expected(scheme: str, case: Case) -> Outcome:
    """How a case ends for a scheme of the catalogue, by its name."""
    return stepper_named(scheme).run(case.system, case.dt, case.steps, case.changes)


def trajectories(case: Case, schemes: Iterable[str]) -> dict[str, Trajectory]:
    """Of these schemes, those that can step a case, in the order given, and what they make of it."""
    ends = {scheme: expected(scheme, case).trajectory for scheme in schemes}
    return {scheme: trajectory for scheme, trajectory in ends.items() if trajectory is not None}


@cache
def rounding(scheme: str, case: Case) -> float:
    """What a scheme makes of rounding on a case (`reference.identification.amplified`), as a part of the size.

    On the default string against 80-bit arithmetic RK4, which there multiplies a perturbation by 2e7 in ten steps of
    0.02 s, is itself off by 2e-11 of the size.
    """
    trajectory = expected(scheme, case).trajectory
    assert trajectory is not None
    return amplified(stepper_named(scheme), trajectory, case.system, case.dt, case.steps, case.changes)
