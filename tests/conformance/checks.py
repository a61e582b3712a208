"""What every engine must pass: small functions that raise AssertionError, and what they need."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from engines.engine import CAPABILITIES, Engine, demands
from reference.identification import TOLERANCE, amplified, identify_run
from reference.outcome import Outcome
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from tests.conformance.children import Look, answer_of, look_on, run_all
from tests.conformance.strings import Case

#: Schemes that stop before their equations are solved, and the scheme that solves them.
EXACT_SOLVE = {"kick_drift_truncated_damping": "kick_drift_implicit_damping"}


def outcomes(engine: Engine, cases: Sequence[Case]) -> list[Outcome]:
    """How each case ends."""
    return answer_of(run_all, engine, cases)


def claimed(engine: Engine, case: Case) -> str:
    """The scheme an engine claims to be on a case.

    With both damping and drag that is the less simple of its two claims: the one that comes later in the catalogue.
    Without the damping, or without the drag, it must reduce to the other one.
    """
    systems = [case.system]
    for change in case.changes:
        systems.append(systems[-1].with_parameter(change.parameter, change.value))
    asked = {"damping": any(s.damping.any() for s in systems), "drag": any(s.drag > 0 for s in systems)}
    claims = [engine.identified_as[what] for what, needed in asked.items() if needed] or [engine.identified_as["plain"]]
    return max(claims, key=list(catalogued()).index)


@cache
def expected(scheme: str, case: Case) -> Outcome:
    """How the case ends for a scheme of the catalogue."""
    return catalogued()[scheme].run(case.system, case.dt, case.steps, case.changes)


@cache
def rounding(scheme: str, case: Case) -> float:
    """What a scheme makes of rounding on a case (`reference.identification.amplified`), as a part of the size.

    On the default string against 80-bit arithmetic RK4, which there multiplies a push by 2e7 in ten steps of 0.02 s, is
    itself off by 2e-11 of the size.
    """
    trajectory = expected(scheme, case).trajectory
    assert trajectory is not None
    return amplified(catalogued()[scheme], trajectory, case.system, case.dt, case.steps, case.changes)


def swings_rods(engine: Engine) -> bool:
    """Whether links are rods for an engine, by the equations of the scheme it claims to be."""
    return catalogued()[engine.identified_as["plain"]].on_rods


def supported(engine: Engine, cases: Sequence[Case]) -> list[Case]:
    """The cases whose systems ask for no more than the engine's capabilities."""
    return [case for case in cases if engine.capabilities.issuperset(demands(case.system))]


def require(engine: Engine, capability: str) -> None:
    """Skip the test where an engine lacks a capability."""
    if capability not in engine.capabilities:
        pytest.skip(f"{engine.name} lacks {capability!r}: {CAPABILITIES[capability]}")


def check_follows(
    engine: Engine, case: Case, outcome: Outcome, tolerance: float = TOLERANCE, scheme: str | None = None
) -> None:
    """The engine's trajectory is that of the scheme it claims to be, and both end in the same way.

    max over time and masses of |x_engine - x_scheme| <= tolerance times the system's size. The scheme does the same
    arithmetic in another order: some 1e-16 of the positions per step, adding up and swinging with the system. Where
    the motion amplifies rounding so much that it may pass the tolerance, what it makes of rounding is allowed.

    Args:
        tolerance: as a part of the system's size.
        scheme: in place of the one claimed.
    """
    scheme = scheme or claimed(engine, case)
    right = expected(scheme, case)
    assert outcome.trajectory is not None, f"{engine.name}, {case.name}: {outcome.ending}, {outcome.reason}"
    assert right.trajectory is not None
    allowed = max(tolerance, rounding(scheme, case))
    found = identify_run(engine.name, outcome, case.system, {scheme: right.trajectory}, allowed)
    assert found.identified_as == scheme, f"{case.name}: {found}; tolerance {found.tolerance:.2g} m"
    assert outcome.ending == right.ending, f"{engine.name}, {case.name}: {outcome.ending}; {scheme}: {right.ending}"


def check_capability(engine: Engine, case: Case, outcome: Outcome) -> None:
    """A system within an engine's capabilities is stepped as claimed; one beyond is refused, with what is lacking."""
    lacking = [name for name in demands(case.system) if name not in engine.capabilities]
    if not lacking:
        check_follows(engine, case, outcome)
        return
    assert outcome.ending == "unsupported", f"{engine.name} lacks {lacking}, but ended as {outcome.ending}"
    assert any(CAPABILITIES[name] in outcome.reason for name in lacking), outcome.reason


def check_change(engine: Engine, case: Case, outcome: Outcome) -> None:
    """Parameters changed on the fly change the engine's trajectory as they do the scheme's, or are refused by name.

    A system beyond the engine's capabilities is refused before anything changes.
    """
    if not supported(engine, [case]):
        check_capability(engine, case, outcome)
        return
    if outcome.ending == "unsupported":
        named = [change.parameter for change in case.changes]
        assert any(name in outcome.reason or name.replace("_", " ") in outcome.reason for name in named), outcome.reason
        return
    check_follows(engine, case, outcome)


def looks(engine: Engine, systems: Sequence[MassSpringSystem]) -> list[Look]:
    """What the engine's simulations of systems say of their states."""
    return answer_of(look_on, engine, systems)


def check_state(system: MassSpringSystem, seen: Look) -> None:
    """The state at the start is the system's, to rounding; every answer is an array of its own.

    Rounding: 1e-14 of the largest position or velocity. An engine with coordinates of its own (nested bodies,
    rotations) adds up one number per link.
    """
    for answer in (seen.first, seen.second):
        for found, meant in zip(answer, (system.positions, system.velocities), strict=True):
            assert found.shape == meant.shape
            assert np.abs(found - meant).max() <= 1e-14 * np.abs(meant).max()
    changed = [not np.array_equal(after, before) for after, before in zip(seen.stepped, seen.second, strict=True)]
    assert any(changed), "a step changed neither positions nor velocities"
    for kept, second in zip(seen.kept, seen.second, strict=True):
        assert np.array_equal(kept, second), "a step changed an array that had been handed out"
