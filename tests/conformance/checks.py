"""What every engine must pass: small functions that raise AssertionError, and what they need."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from engines.engine import CAPABILITIES, Engine, demands, precision
from reference.identification import TOLERANCE, Identification, identify_run
from reference.identification.scale import ROUNDING
from reference.outcome import Outcome
from reference.schemes.catalogue import constraint_schemes
from reference.stepper import catalogued, stepper_named
from reference.system import MassSpringSystem
from tests.conformance.case import Case
from tests.conformance.children import Look, look_on, result_of
from tests.conformance.refusals import refused_as_expected
from tests.conformance.runs import expected, rounding, trajectories

#: Off by so much of the size may be whole runs of engines in single precision.
SINGLE = 5e-4

#: Schemes that stop before their equations are solved, and the scheme that solves them.
EXACT_SOLVE = {"kick_drift_truncated_damping": "kick_drift_implicit_damping"}


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
    order = [*catalogued(), *constraint_schemes()]
    return max(claims, key=lambda claim: order.index(claim.partition("(")[0]))


def tolerance_of(engine: Engine) -> float:
    """How far an engine may be off its scheme, as a part of the size.

    One in single precision that claims a scheme in single precision is to follow it as closely as any: to the bit. Of
    another, whole runs show little: rounding of 6e-8 a step adds up, in a scheme whose velocities are differences of
    positions to 1.5e-4 in 500 steps. What it is is shown by single steps (`test_single_precision`).
    """
    exact = precision(engine) == "double" or "single=True" in engine.identified_as["plain"]
    return TOLERANCE if exact else SINGLE


def on_rods(engine: Engine) -> bool:
    """Whether springs are distance constraints for an engine, by the equations of the scheme it claims to be."""
    return stepper_named(engine.identified_as["plain"]).on_rods


def supported(engine: Engine, cases: Sequence[Case]) -> list[Case]:
    """The cases whose systems ask for no more than the engine's capabilities."""
    return [case for case in cases if engine.capabilities.issuperset(demands(case.system))]


def require(engine: Engine, capability: str) -> None:
    """Skip the test where an engine lacks a capability."""
    if capability not in engine.capabilities:
        pytest.skip(f"{engine.name} lacks {capability!r}: {CAPABILITIES[capability]}")


def check_follows(
    engine: Engine, case: Case, outcome: Outcome, tolerance: float | None = None, scheme: str | None = None
) -> None:
    """The engine's trajectory is that of the scheme it claims to be, and both end in the same way.

    max over time and masses of |x_engine - x_scheme| <= tolerance times the system's size. The scheme does the same
    arithmetic in another order: some 1e-16 of the positions per step, adding up and swinging with the system. Where
    that is not enough, what the motion makes of rounding (`runs.rounding`) is allowed.

    Args:
        tolerance: as a part of the system's size; `tolerance_of` the engine where left out.
        scheme: in place of the one claimed.
    """
    scheme = scheme or claimed(engine, case)
    tolerance = tolerance_of(engine) if tolerance is None else max(tolerance, tolerance_of(engine))
    right = expected(scheme, case)
    assert outcome.trajectory is not None, f"{engine.name}, {case.name}: {outcome.ending}, {outcome.reason}"
    assert right.trajectory is not None
    known = {scheme: right.trajectory}
    found = identify_run(engine.name, outcome, case.system, known, tolerance)
    if found.identified_as is None:
        larger = ROUNDING[precision(engine)] / ROUNDING["double"]
        allowed = max(tolerance, larger * rounding(scheme, case))
        found = identify_run(engine.name, outcome, case.system, known, allowed)
    assert found.identified_as == scheme, f"{case.name}: {found}; tolerance {found.tolerance:.2g} m"
    assert outcome.ending == right.ending, f"{engine.name}, {case.name}: {outcome.ending}; {scheme}: {right.ending}"


def identify_claimed(engine: Engine, case: Case, outcome: Outcome) -> Identification:
    """The scheme claimed, where an engine follows it to rounding: no other is run then. Else the catalogue, ranked."""
    claim = claimed(engine, case)
    found = identify_run(engine.name, outcome, case.system, trajectories(case, [claim]), tolerance_of(engine))
    if found.identified_as is None:
        found = identify_run(engine.name, outcome, case.system, trajectories(case, [*catalogued(), claim]))
    return found


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

    What is refused, and why, is as expected. A system beyond the engine's capabilities is refused before anything
    changes.
    """
    if not refused_as_expected(engine, "changes", case, outcome):
        check_follows(engine, case, outcome)
    elif supported(engine, [case]):
        named = [change.parameter for change in case.changes]
        assert any(name in outcome.reason or name.replace("_", " ") in outcome.reason for name in named), outcome.reason


def looks(engine: Engine, systems: Sequence[MassSpringSystem]) -> list[Look]:
    """What the engine's simulations of systems say of their states."""
    return result_of(look_on, engine, systems)


def check_state(system: MassSpringSystem, seen: Look, rounding: float = 1e-14) -> None:
    """The state at the start is the system's, to rounding; every state handed out is arrays of its own; it can step.

    Rounding: 1e-14 of the largest position or velocity. An engine with coordinates of its own (nested bodies,
    rotations) adds up one number per link.
    """
    for state in (seen.first, seen.second):
        for found, meant in zip(state, (system.positions, system.velocities), strict=True):
            assert found.shape == meant.shape
            assert np.abs(found - meant).max() <= rounding * np.abs(meant).max()
    changed = [not np.array_equal(after, before) for after, before in zip(seen.stepped, seen.second, strict=True)]
    assert any(changed), "a step changed neither positions nor velocities"
    assert all(np.isfinite(numbers).all() for numbers in seen.bare), "the engine's bare step leaves no numbers"
    for kept, second in zip(seen.kept, seen.second, strict=True):
        assert np.array_equal(kept, second), "a step changed an array that had been handed out"
