"""Single steps: what names a stepper in single precision, one whose motion multiplies rounding, one with contacts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from reference.changes import Change
from reference.forces import SpringMotion
from reference.identification import TOLERANCE, identify, identify_all
from reference.identification.single_steps import identify_steps, steps_of
from reference.obstacles import project_out
from reference.outcome import Outcome, outcome_of
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.state import Array, State, Trajectory
from reference.stepper import SchemeStepper, catalogued
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.identified import Recorded
from tests.reference.test_identification_rounding import SLOW, STRING, nudged

#: How a stepper rounds its numbers after every step.
Rounding = Callable[[Array], Array]


def single(values: Array) -> Array:
    """To single precision: a part in 2^24."""
    return values.astype(np.float32).astype(np.float64)


def coarse(values: Array) -> Array:
    """To a part in 2^16: more than single precision rounds."""
    return np.asarray(np.round(values * 2.0**16) / 2.0**16)


@dataclass(frozen=True)
class Rounded:
    """A scheme whose state is rounded after every step; it says that it is in single precision."""

    scheme: Scheme
    rounding: Rounding = single
    name: str = "rounded"
    kind: str = "engine"
    version: str | None = None
    precision: str = "single"

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """Step after step."""
        step = self.scheme.on(SpringMotion(system))
        states = [system.start]
        for _ in range(steps):
            end = step(states[-1], dt)
            states.append(State(end.time, self.rounding(end.positions), self.rounding(end.velocities)))
        return outcome_of(system, Trajectory.of(states))


@pytest.mark.rotating(8)
@pytest.mark.parametrize("dt", [1e-4, 1e-3, 5e-3])
@pytest.mark.parametrize("name", ["euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "rk4"])
def test_steppers_in_single_precision_are_named(name: str, dt: float) -> None:
    """To half a unit in the last place of 2 m, 1.2e-7 m, times the few operations of a step; the next is far off.

    At steps of 0.1 ms all schemes do the same to 1e-7 m: it is asked for longer ones.
    """
    system = find_scene("string").system({})
    found = identify(Rounded(find(name)), system, dt, 100)
    assert found.identified_as == name
    assert found.by_single_steps
    assert found.error < 5e-7
    # of methods as accurate as RK4, the wide catalogue has some that are nearer in single precision
    others = [m.error for m in found.ranking if m.scheme in schemes() and m.scheme not in (name, *found.ties)]
    assert all(error > 10 * found.tolerance for error in others)
    # RK4 and the 3/8 rule do the same to this rounding at 5 ms, too
    assert bool(found.told_apart_by) == (dt < 5e-3 or name == "rk4")


def test_a_wider_tolerance_is_no_way_out() -> None:
    """Over 500 steps rounding takes the trajectory 1e6 tolerances from its own scheme's."""
    system = find_scene("string").system({})
    mine = Rounded(find("heun")).run(system, 1e-3, 500).trajectory
    right = SchemeStepper(find("heun")).run(system, 1e-3, 500).trajectory
    assert mine is not None
    assert right is not None
    assert mine.distance(right).max() > 1e6 * TOLERANCE * system.size


@pytest.mark.parametrize(
    "stranger",
    [
        Rounded(find("heun"), coarse),
        Rounded(wrong.heun_of_the_wrong_pair),
        Rounded(wrong.verlet_with_one_force),
        Rounded(wrong.kick_drift_kicked_twice),
    ],
    ids=["coarse", "pair", "force", "kick"],
)
def test_what_is_more_than_single_precision_is_not_named(stranger: Rounded) -> None:
    """Rounded 256 times as coarsely, or another scheme."""
    found = identify(stranger, find_scene("string").system({}), 5e-3, 100)
    assert found.identified_as is None
    assert found.reason.startswith("nearest ")


def by_euler(system: MassSpringSystem, steps: int = 280) -> Outcome:
    """A run by Euler with steps of 2 ms, which multiplies rounding to more than 1e-9 m."""
    return SchemeStepper(find("euler")).run(system, SLOW, steps)


def test_a_motion_that_multiplies_rounding_is_named_by_single_steps() -> None:
    """Begun an ulp or two aside the trajectory leaves Euler's by 1e-9 m and more; every single step is Euler's."""
    run = Recorded(by_euler(nudged(STRING)))
    found = identify(run, STRING, SLOW, 280)
    assert (found.identified_as, found.compared) == ("euler", "single steps")
    assert found.error < 1e-14


def test_one_step_that_is_not_the_schemes_is_seen() -> None:
    """Of 280 steps one moves a mass by 1e-6 m, away from the states that all schemes are tried from: no name."""
    whole = by_euler(nudged(STRING)).trajectory
    assert whole is not None
    positions = whole.positions.copy()
    positions[123:, 3] += 1e-6
    run = Recorded(Outcome("done", "", replace(whole, positions=positions)))
    assert identify(run, STRING, SLOW, 280).identified_as is None


def test_forces_wrong_by_a_part_in_1e9_are_seen_by_single_steps_too() -> None:
    """The steps are long: a force moves a mass by 1e-3 m in one, and a part in 1e9 of that is far beyond rounding."""
    stranger = SchemeStepper(wrong.stepped(wrong.slightly_stronger, find("euler")))
    found = identify(stranger, STRING, SLOW, 280)
    assert found.identified_as is None
    assert "by single steps, nearest euler at " in found.reason


@dataclass(frozen=True)
class Bouncing:
    """Kick-drift with a contact of its own: what enters an obstacle comes out again at the speed it came in with."""

    name: str = "bouncing"
    kind: str = "engine"
    version: str | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """Step after step."""
        alone, fixed = replace(system, obstacles=()), system.fixed[:, None]
        step = find("kick_drift").on(SpringMotion(alone))
        states = [system.start]
        for _ in range(steps):
            end = step(states[-1], dt)
            x, stopped = project_out(system.obstacles, fixed, end.positions, end.velocities)
            states.append(State(end.time, x, 2 * stopped - end.velocities))
        return outcome_of(system, Trajectory.of(states))


@pytest.mark.rotating(2)
def test_contacts_of_its_own_are_left_out_and_it_is_said() -> None:
    """A drop that bounces is kick-drift where it touches nothing; its trajectory is that of no scheme."""
    scene = find_scene("drop").setup({"across": 2, "high": 2, "deep": 2, "height": 0.02})
    found = identify(Bouncing(), scene.system, scene.dt, 200)
    assert found.identified_as == "kick_drift"
    assert found.compared == "single steps away from obstacles"
    assert "(by single steps away from obstacles)" in str(found)


def test_a_run_that_blows_up_in_its_first_step_is_named_by_it() -> None:
    """There is one state of numbers to begin a step from, the start."""
    system = find_scene("string").system({})
    found = identify(SchemeStepper(find("heun_link_by_link")), system, 0.03, 100)
    assert (found.identified_as, found.compared) == ("heun_link_by_link", "single steps")


def test_multistep_schemes_are_not_compared_so_and_it_is_said() -> None:
    """What they keep of earlier steps no state tells."""
    heun = find("heun")
    catalogue = {"heun": SchemeStepper(heun), "leap": SchemeStepper(replace(heun, one_step=False))}
    system = find_scene("string").system({"masses": 3})
    run = SchemeStepper(find("rk4")).run(system, 1e-3, 20).trajectory
    assert run is not None
    found = identify_steps("it", steps_of(run, system), catalogue, "double")
    assert [match.scheme for match in found.ranking] == ["heun"]
    assert found.reason.endswith("; multistep schemes are not compared so")


def test_who_tells_no_velocities_has_that_for_a_reason() -> None:
    """No step can begin; by positions alone its trajectory can still be compared."""
    system = find_scene("string").system({"masses": 3})
    run = SchemeStepper(find("rk4")).run(system, 1e-3, 20).trajectory
    assert run is not None
    silent = replace(run, velocities=np.concatenate([run.velocities[:1], np.full_like(run.velocities[1:], np.nan)]))
    found = identify_steps("it", steps_of(silent, system), dict(catalogued()), "double")
    assert found.reason == "it tells no velocities to begin single steps with"
    (by_positions,) = identify_all([(Recorded(Outcome("done")), Outcome("done", "", silent))], system, 1e-3, 20).each
    assert by_positions.identified_as == "rk4"


def test_parameters_that_change_are_those_of_each_step() -> None:
    """Stiffness that is halved midway: single steps with the first stiffness alone would be off."""
    system = find_scene("string").system({"masses": 3})
    changes = (Change(5e-3, "stiffness", 100.0),)
    run = SchemeStepper(find("heun")).run(system, 1e-3, 20, changes).trajectory
    assert run is not None
    assert identify_steps("it", steps_of(run, system, changes), dict(catalogued()), "double").identified_as == "heun"
    assert identify_steps("it", steps_of(run, system), dict(catalogued()), "double").identified_as is None
