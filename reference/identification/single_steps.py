"""Single steps: each from a state that the stepper itself came to, and compared with the state it came to next.

Where a motion multiplies rounding, or a stepper rounds to single precision, whole trajectories part though the scheme
is the same. One step multiplies nothing: it is off by the rounding of that step, and another scheme is off by far more
where the step is long for the system. A multistep scheme needs earlier steps, and cannot be compared so.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reference.changes import Change, changes_by_step
from reference.errors import InputError, SolverError, Unsupported
from reference.identification.ranking import ranked, tells_velocities
from reference.identification.result import Identification, Match
from reference.identification.scale import ROUNDING, Precision, fastest_rate_bound, scale
from reference.motion import Equations
from reference.simulate import projected
from reference.springs.breaking import breaks_of
from reference.state import State, Trajectory
from reference.stepper import SchemeStepper
from reference.system import BoolArray, MassSpringSystem

#: A step may be off by so many roundings of its largest coordinate; where h w > 1, of what a force makes of them.
ROUNDINGS = 32

#: A step is long enough to tell schemes apart where it is at least this part of 1 / the fastest rate.
LONG = 0.25

#: All schemes are tried from so many states at most, evenly spread; the nearest from all, up to so many masses times
#: states.
STATES, ALL_UP_TO = 40, 1_000_000

#: A scheme whose step is off by so many tolerances is not tried from further states where another one is right.
FAR = 100

#: A mass this near to an obstacle, as a part of the scale, may have touched it.
TOUCH = 1e-6


@dataclass(frozen=True, eq=False)
class Steps:
    """Steps of a stepper to be compared.

    Attributes:
        run: its trajectory.
        systems: the system at each step compared, by the number of the step.
        touching: whether steps were left out, as a mass touches an obstacle in them.
    """

    run: Trajectory
    systems: Mapping[int, MassSpringSystem]
    touching: bool

    @property
    def dt(self) -> float:
        """The step [s]."""
        return float(self.run.times[1] - self.run.times[0])

    def spread(self, most: int) -> Steps:
        """So many of them at most, evenly spread, the first and the last among them."""
        numbers = list(self.systems)
        chosen = np.unique(np.linspace(0, len(numbers) - 1, min(most, len(numbers))).astype(int)).tolist()
        return replace(self, systems={numbers[i]: self.systems[numbers[i]] for i in chosen})


def steps_of(run: Trajectory, system: MassSpringSystem, changes: Sequence[Change] = ()) -> Steps:
    """Which steps of a run can be compared.

    Those between states that are numbers, away from obstacles, and from where no mass moves further in a step than the
    system is large: of what turns faster than that, rounding leaves nothing.
    """
    dt = float(run.times[1] - run.times[0])
    finite = np.isfinite(run.positions).all(axis=(1, 2)) & np.isfinite(run.velocities).all(axis=(1, 2))
    with np.errstate(invalid="ignore"):
        slow = dt * np.abs(run.velocities).max(axis=(1, 2)) <= system.scale
    near = _near_obstacles(run, system)
    usable = np.flatnonzero((slow & finite & ~near)[:-1] & (finite & ~near)[1:])
    changes = (*changes, *breaks_of(system, run, dt, changes))
    wanted, systems, pending = set(usable.tolist()), {}, changes_by_step(changes, dt)
    for i in range(len(run) - 1):
        for change in pending.get(i, ()):
            system = system.with_parameter(change.parameter, change.value)
        if i in wanted:
            systems[i] = system
    return Steps(run, systems, bool(near.any()))


def identify_steps(
    name: str, steps: Steps, catalogue: Mapping[str, SchemeStepper], precision: Precision
) -> Identification:
    """Rank schemes by how far one step of theirs is from the stepper's, at most; errors are those at the start's scale.

    A scheme that cannot be the nearest is given up at the first step that shows it: its error is the least it has.

    Args:
        catalogue: the schemes, the simplest first; those that cannot step the system so are left out.
    """
    start = steps.run.frames(slice(1))
    length = scale(next(iter(steps.systems.values())), start) if steps.systems else 1.0
    compared = "single steps away from obstacles" if steps.touching else "single steps"
    tolerance = ROUNDINGS * ROUNDING[precision] * length
    if not steps.systems or not tells_velocities(steps.run):
        tells = tells_velocities(steps.run)
        why = "no single step can be compared" if tells else "it tells no velocities to begin single steps with"
        why += ": a mass touches an obstacle in all of them, and contacts are its own" if steps.touching else ""
        return Identification(name, (), tolerance, why, compared=compared)
    some, whole = (steps.spread(most) for most in (STATES, max(STATES, ALL_UP_TO // steps.run.positions.shape[1])))
    matches = (_match(scheme, stepper, some, length, FAR * tolerance) for scheme, stepper in catalogue.items())
    tried = [match for match in matches if match is not None]
    near = [_match(m.scheme, catalogue[m.scheme], whole, length) if m.error <= tolerance else m for m in tried]
    tried = [match for match in near if match is not None]
    result = Identification(name, ranked(tried, tolerance, tolerance), tolerance, compared=compared)
    if result.matches:
        return result
    ranking = ranked(_nearest(tried, catalogue, some, length), tolerance, tolerance)
    result = replace(result, ranking=ranking)
    memory = any(not stepper.scheme.one_step for stepper in catalogue.values())
    words = "no scheme of the catalogue can take single steps here"
    if ranking:
        words = f"nearest {ranking[0].scheme} at {ranking[0].error:.2g} m a step"
    return result.without_name(words + ("; multistep schemes are not compared so" if memory else ""))


def _nearest(
    tried: Sequence[Match], catalogue: Mapping[str, SchemeStepper], steps: Steps, length: float
) -> list[Match]:
    """The same, of which those that were given up have gone on for as long as they may be the nearest."""
    found: dict[str, Match | None] = {match.scheme: match for match in tried}
    least = np.inf
    for match in sorted(tried, key=lambda m: m.error):
        given_up = match.steps < len(steps.systems)
        if given_up and match.error <= least:
            found[match.scheme] = _match(match.scheme, catalogue[match.scheme], steps, length, least)
        now = found[match.scheme]
        least = least if now is None else min(least, now.error)
    return [match for match in found.values() if match is not None]


def _match(name: str, stepper: SchemeStepper, steps: Steps, length: float, enough: float = np.inf) -> Match | None:
    """How far single steps of a scheme are off, relative to each step's scale; None where it cannot take them.

    Args:
        enough: steps that come after one that is off by more are left out.
    """
    if not stepper.scheme.one_step:
        return None
    x, v = steps.run.positions, steps.run.velocities
    off, count = (0.0, 0.0), 0
    try:
        for i, state in _stepped(stepper, steps):
            # a force rounds as its springs' lengths do: k / m times as much, in a step times h^2
            stiff = max(1.0, (steps.dt * fastest_rate_bound(steps.systems[i])) ** 2)
            with np.errstate(over="ignore", invalid="ignore"):
                own = max(float(np.abs(x[i : i + 2]).max()), steps.dt * float(np.abs(v[i + 1]).max()), length) * stiff
                apart = np.abs(state.positions - x[i + 1]).max(), steps.dt * np.abs(state.velocities - v[i + 1]).max()
            here = [length * float(a) / own if np.isfinite(a) else np.inf for a in apart]
            off, count = (max(off[0], here[0]), max(off[1], here[1])), count + 1
            if max(off) > enough:
                break
    except (InputError, SolverError, Unsupported, np.linalg.LinAlgError):
        return None
    return Match(name, *off, count)


def _stepped(stepper: SchemeStepper, steps: Steps) -> Iterator[tuple[int, State]]:
    """One step of a scheme from each of the states, by the state's number.

    The last is the first: a motion that has come far tells schemes apart sooner than its start does.
    """
    motion: Equations | None = None
    before: MassSpringSystem | None = None
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for i, system in reversed(list(steps.systems.items())):
            if motion is None or system is not before:
                motion, before = stepper.equations(system), system
                step = stepper.scheme.on(motion)
            time = float(steps.run.times[i])
            state = motion.state_of(State(time, steps.run.positions[i], steps.run.velocities[i]))
            end = projected(system, step(state, steps.dt), time + steps.dt)
            yield i, motion.trajectory([end]).states()[0]


def _near_obstacles(run: Trajectory, system: MassSpringSystem) -> BoolArray:
    """In which frames a free mass touches an obstacle, or two masses that collide one another."""
    near = np.zeros(len(run), dtype=bool)
    reach = TOUCH * system.scale
    for obstacle in system.obstacles:
        with np.errstate(all="ignore"):
            distance = obstacle.signed_distances(run.positions[:, ~system.fixed])[0]
        near |= (distance <= reach).any(axis=(1, 2))
    if system.collisions is not None:
        near |= np.array([len(system.collisions.pairs(x, 1 + TOUCH)) > 0 for x in run.positions])
    return near
