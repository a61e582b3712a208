"""The conformance suite as measurements: what an engine does, one row for each thing that is asked of it.

Nothing in a row depends on how fast a machine is or how it rounds: a trajectory is a scheme's to rounding or it is not,
and limits are kept to the figures that can be measured of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from engines.capability_cases import for_each_capability
from engines.engine import demands
from engines.process.isolation import EngineStepper
from experiments.limits.engine_limit import measure_at_random
from reference.identification import TOLERANCE, Identification, candidates, identify, identify_run
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.stepper import catalogued, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import fastest_rate

#: What was measured: a number, or words.
Value = float | str

#: Cases of the string: what is identified, and whose largest stable dt is measured [N s/m].
IDENTIFIED: Mapping[str, Mapping[str, float]] = {"plain": {}, "damping": {"damping": 0.1}, "drag": {"drag": 0.02}}
LIMITED: Mapping[str, Mapping[str, float]] = {
    "undamped": {},
    "damping 0.1": {"damping": 0.1},
    "drag 0.1": {"drag": 0.1},
}

#: The step [s] and number of steps of a run.
DT, STEPS = 1e-3, 200

#: Limits are measured to this part of themselves, and kept to this number of figures.
PRECISION, FIGURES = 1e-6, 7

#: Off by so much of the size may be a run in single precision of what claims no scheme in single precision.
SINGLE = 5e-4


def measure(stepper: EngineStepper) -> dict[str, Value]:
    """All rows of an engine; a single one where it does not run."""
    first = stepper.run(_string(_scene_for(stepper)), DT, 1)
    if first.ending != "done":
        return {"runs": f"{first.ending}: {first.reason}"}
    # in single precision what rounding does to a run is not told from slow growth
    limited = LIMITED if stepper.precision == "double" else {}
    return {
        "runs": "yes",
        **{f"identified, {case}": _identity(stepper, case) for case in IDENTIFIED},
        **{f"largest stable dt [s], {case}": _limit(stepper, case) for case in limited},
        # whether it can do the plane the rows above say
        **{f"can: {name}": capability(stepper, name) for name in _capability_cases() if name != "2d"},
    }


def identified(stepper: EngineStepper, case: str) -> Identification | Outcome:
    """What a short run of the string identifies it as, in a case of IDENTIFIED; how it ended, if not in a trajectory.

    It is compared with the whole catalogue, and with what it claims to be where that has parameters.
    """
    scene = _scene_for(stepper)
    system = _string(scene, **IDENTIFIED[case])
    if stepper.precision == "single":
        first = stepper.run(system, DT, 1)
        return first if first.trajectory is None else identify(stepper, system, DT, STEPS)
    outcome = stepper.run(system, DT, STEPS)
    if outcome.trajectory is None:
        return outcome
    known = _catalogue(scene, case, tuple(claim for claim in stepper.claims if claim not in catalogued()))
    return identify_run(stepper.name, outcome, system, known)


def _identity(stepper: EngineStepper, case: str) -> str:
    """The scheme it is to rounding; else how far the nearest is."""
    found = identified(stepper, case)
    if isinstance(found, Outcome):
        return f"{found.ending}: {found.reason}"
    if found.identified_as:
        return found.identified_as
    return f"none; nearest {found.ranking[0].scheme} at {found.error:.0e} m"


def _limit(stepper: EngineStepper, case: str) -> Value:
    """Its largest stable dt [s]; else why there is none."""
    system, rest = _hanging(_scene_for(stepper), case)
    limit = measure_at_random(stepper, system, rest, 1 / fastest_rate(rest), PRECISION)
    if isinstance(limit, Outcome):
        return f"{limit.ending}: {limit.reason}"
    return limit.reason if limit.dt is None else float(f"{limit.dt:.{FIGURES}g}")


def capability(stepper: EngineStepper, name: str) -> str:
    """Whether it steps a system by the scheme it claims, or refuses it."""
    engine, system = stepper.engine, _capability_cases()[name]
    outcome = stepper.run(system, DT, STEPS)
    if outcome.ending == "unsupported":
        return f"refused: {outcome.reason}"
    if not engine.capabilities.issuperset(demands(system)):
        return "broken: it is not among its capabilities, yet not refused"
    asked = {"damping": system.damping.any(), "drag": system.drag > 0, "plain": True}
    claim = stepper.identified_as[next(what for what, is_asked in asked.items() if is_asked)]
    exact = stepper.precision == "double" or "single=True" in claim
    tolerance = TOLERANCE if exact else SINGLE
    found = identify_run(engine.name, outcome, system, {claim: _claimed(claim, name)}, tolerance)
    return "kept" if found.identified_as == claim else f"broken: {found}"


def _scene_for(stepper: EngineStepper) -> str:
    """The string, which swings in the plane; for an engine that cannot, the chain that hangs from a point."""
    return "string" if "2d" in stepper.engine.capabilities else "chain"


def _string(scene: str, **settings: float) -> MassSpringSystem:
    return find(scene).system(settings)


@cache
def _catalogue(scene: str, case: str, claims: tuple[str, ...]) -> Mapping[str, Trajectory]:
    return candidates(_string(scene, **IDENTIFIED[case]), DT, STEPS, claims=claims)


@cache
def _hanging(scene: str, case: str) -> tuple[MassSpringSystem, Equilibrium]:
    system = _string(scene, **LIMITED[case])
    return system, spring_equilibrium(system)


@cache
def _capability_cases() -> Mapping[str, MassSpringSystem]:
    return for_each_capability()


@cache
def _claimed(scheme: str, case: str) -> Trajectory:
    trajectory = stepper_named(scheme).run(_capability_cases()[case], DT, STEPS).trajectory
    assert trajectory is not None, f"{scheme} cannot step {case}"
    return trajectory
