"""What Exudyn's solvers are, whatever they are called: Euler's own Euler, and a Verlet that takes damping late."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

import pytest

from engines.engine import CAPABILITIES, version
from engines.exudyn.springs import ExudynSprings
from engines.process.isolation import EngineStepper, isolated, run_engine
from reference.forces import SpringMotion
from reference.identification import TOLERANCE, identify_run
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.stepper import catalogued
from reference.system import MassSpringSystem

DT, STEPS = 1e-3, 200
PLAIN, DAMPED = find("string").system({}), find("string").system({"damping": 0.05, "drag": 0.02})

RK4, EULER = ExudynSprings("exudyn_springs", "RK44"), ExudynSprings("exudyn_springs_euler", "ExplicitEuler")

pytestmark = pytest.mark.skipif(version(RK4) is None, reason="exudyn is not installed")


@dataclass(frozen=True)
class UnrestrainedVerlet(ExudynSprings):
    """Velocity Verlet that is given damping and drag nevertheless."""

    capabilities: frozenset[str] = frozenset(CAPABILITIES)  # type: ignore[assignment]


VERLET = UnrestrainedVerlet("exudyn_springs_verlet", "VelocityVerlet")


def check_is(engine: ExudynSprings, system: MassSpringSystem, known: Trajectory) -> None:
    """The engine's trajectory is a known one: max |x_engine - x| <= 1e-12 of the size, as everywhere."""
    found = identify_run(engine.name, EngineStepper(engine).run(system, DT, STEPS), system, {"known": known}, TOLERANCE)
    assert found.identified_as == "known", str(found)


def by_scheme(name: str, system: MassSpringSystem) -> Trajectory:
    """The trajectory of a scheme of the catalogue."""
    trajectory = catalogued()[name].run(system, DT, STEPS).trajectory
    assert trajectory is not None
    return trajectory


def by_half_steps(system: MassSpringSystem) -> Trajectory:
    """Velocity Verlet whose accelerations are taken at the velocities w half a step before, and kept for the next step.

    w = v + h/2 a, x' = x + h w, a' = a(x', w), v' = w + h/2 a': the w alone make kick-drift with explicit damping.
    """
    motion, state = SpringMotion(system), system.start
    kept, states = motion.acceleration(state), [state]
    for _ in range(STEPS):
        moved = state.kick(DT / 2 * kept).drift(DT)
        kept = motion.acceleration(moved)
        state = moved.kick(DT / 2 * kept)
        states.append(state)
    return Trajectory.of(states)


@pytest.mark.parametrize("system", [PLAIN, DAMPED], ids=["plain", "damped"])
def test_its_explicit_euler_is_eulers(system: MassSpringSystem) -> None:
    """A step is x' = x + h v, v' = v + h a(x, v); what others call Euler is semi-implicit, and not that."""
    check_is(EULER, system, by_scheme("euler", system))
    for other in ("kick_drift", "drift_kick"):
        with pytest.raises(AssertionError):
            check_is(EULER, system, by_scheme(other, system))


def test_its_verlet_takes_damping_half_a_step_late() -> None:
    """Undamped it is velocity Verlet; damped it is one with a memory, and so no scheme: why it claims no damping."""
    check_is(VERLET, PLAIN, by_scheme("velocity_verlet", PLAIN))
    check_is(VERLET, PLAIN, by_half_steps(PLAIN))
    check_is(VERLET, DAMPED, by_half_steps(DAMPED))
    with pytest.raises(AssertionError):
        check_is(VERLET, DAMPED, by_scheme("velocity_verlet", DAMPED))


def files_left(engine: ExudynSprings, system: MassSpringSystem) -> list[str]:
    """What a run leaves in the folder it works in, and whether anything was printed there."""
    outcome = run_engine(engine, system, DT, STEPS)
    assert outcome.ending == "done"
    return [f"{entry.name}: {entry.stat().st_size}" for entry in os.scandir() if entry.stat().st_size]


@pytest.mark.parametrize("setting", [RK4, VERLET], ids=["rk4", "verlet"])
def test_it_writes_and_prints_nothing(setting: ExudynSprings) -> None:
    """No solution file, no warning, neither for 600 masses nor for a solver that Exudyn calls unfinished."""
    left = isolated(files_left, setting, find("string").system({"masses": 600}))
    assert not isinstance(left, Outcome), left
    assert left == []


def test_a_change_leaves_the_state_where_it_is_to_the_last_bit() -> None:
    """Though the solver begins anew: a parameter set to the value it has changes nothing of what follows."""
    moving = replace(PLAIN, velocities=0.1 * PLAIN.positions * ~PLAIN.fixed[:, None])
    same = isolated(change_to_the_same, RK4, moving)
    assert same is True, same


def change_to_the_same(engine: ExudynSprings, system: MassSpringSystem) -> bool:
    """Whether two simulations of a system stay equal where in one of them the stiffness is set to what it is."""
    one, other = engine.start(system, DT), engine.start(system, DT)
    for step in range(STEPS):
        if step % 50 == 10:
            one.change("stiffness", float(system.stiffness[0]))
        one.step()
        other.step()
    return all((a == b).all() for a, b in zip(one.state(), other.state(), strict=True))
