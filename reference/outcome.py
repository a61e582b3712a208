"""How a run ended: one of five words, always with its reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Literal

import numpy as np

from reference.changes import Change
from reference.lengths import lengths, spring_lengths
from reference.pulls import is_pull, place_of_pull
from reference.springs.angular_law import energy_of_bends
from reference.springs.nonlinear_law import energy_of_springs
from reference.state import Array, Trajectory
from reference.system import BREAK, FIELDS, BoolArray, MassSpringSystem

#: Every run ends as one of these.
Ending = Literal["done", "diverged", "crashed", "timed out", "unsupported"]

#: How many times as long, as far or as fast as it may be something is when a run has blown up.
RATIO = 100.0

#: How many springs and masses in frames are looked at at once.
AT_ONCE = 1_000_000


@dataclass(frozen=True)
class Outcome:
    """How a run ended and what it left.

    Attributes:
        ending: one of the five words.
        reason: one line; empty only when done.
        trajectory: what there is of it: all when done, up to the blow-up when diverged, else None.
    """

    ending: Ending
    reason: str = ""
    trajectory: Trajectory | None = None


def outcome_of(system: MassSpringSystem, trajectory: Trajectory, changes: Sequence[Change] = ()) -> Outcome:
    """The outcome of a run that came to its end: done, or diverged. Args: changes: of parameters on the way."""
    reason = blow_up(system, trajectory, changes=changes)
    return Outcome("diverged", reason, trajectory) if reason else Outcome("done", "", trajectory)


def blow_up(
    system: MassSpringSystem, trajectory: Trajectory, ratio: float = RATIO, changes: Sequence[Change] = ()
) -> str | None:
    """Says when and how a trajectory has left physics behind, or None if it has not.

    It has where a position or velocity is not a finite number, and where one of these is over `ratio` times what it may
    be: a spring's length, by its natural length (`first_diverged_frame`); how far a mass has come, by what flight, free
    fall and all springs end to end allow; the speed of all, by the energy that they were given. Engines' safety nets
    (resets, clamps, sleep) do not hide these, nor do rods, which keep their lengths at any speed.
    """
    frame = first_blown_up_frame(system, trajectory, ratio, changes)
    if frame == len(trajectory):
        return None
    time = f"{trajectory.times[frame]:.6g} s"
    for name, values in (("position", trajectory.positions[frame]), ("velocity", trajectory.velocities[frame])):
        lost = ~np.isfinite(values).all(axis=1)
        if lost.any():
            return f"the {name} of mass {np.argmax(lost)} is not a number at t = {time}"
    stretch = _stretch_ratios(system, trajectory.frames([0, frame]), changes)[1]
    if (stretch > ratio).any():
        return f"spring {np.argmax(stretch)} is over {ratio:g} times its length at t = {time}"
    begin = trajectory.frames([0, frame])
    distance = _distance_ratios(system, begin, _natural_lengths(system, begin, changes), changes)[1]
    if (distance > ratio).any():
        return f"mass {np.argmax(distance)} is over {ratio:g} times as far as it could have come at t = {time}"
    return f"the energy is over {ratio**2:g} times what the system was given at t = {time}"


def first_blown_up_frame(
    system: MassSpringSystem, trajectory: Trajectory, ratio: float = RATIO, changes: Sequence[Change] = ()
) -> int:
    """The first frame that `blow_up` tells of; where there is none, their number."""

    def blown_up(part: Trajectory) -> BoolArray:
        with np.errstate(over="ignore", invalid="ignore"):
            length = spring_lengths(part.positions, system.springs)
        natural = _natural_lengths(system, part, changes)
        told = [
            ~(np.isfinite(part.positions) & np.isfinite(part.velocities)).all(axis=(1, 2)),
            (length > ratio * natural).any(axis=1),
            (_distance_ratios(system, part, natural, changes) > ratio).any(axis=1),
            _energy_ratios(system, part, length, natural, changes) > ratio**2,
        ]
        return np.asarray(np.any(np.array(told), axis=0))

    # a few frames at a time, so that what is computed of each spring and mass does not fill the memory
    many = max(1, AT_ONCE // max(1, len(system.springs) + len(system.masses)))
    for begin in range(0, len(trajectory), many):
        # the start comes first in every part, as all is told by it
        told = blown_up(trajectory.frames([0, *range(begin, min(begin + many, len(trajectory)))]))[1:]
        if told.any():
            return begin + _first(told)
    return len(trajectory)


def first_diverged_frame(system: MassSpringSystem, trajectory: Trajectory, stretch_ratio: float) -> int:
    """The first frame with a position that is not finite or a spring beyond a stretch ratio; else their number.

    A stretch ratio is a spring's length over its natural length: the longer of its rest length and its length at the
    start.
    """
    lost = ~np.isfinite(trajectory.positions).all(axis=(1, 2))
    return _first(np.asarray(lost | (_stretch_ratios(system, trajectory) > stretch_ratio).any(axis=1)))


def _first(told: BoolArray) -> int:
    """The first of the frames that are told; where there is none, their number."""
    return int(np.argmax(told)) if told.any() else len(told)


def _stretch_ratios(system: MassSpringSystem, trajectory: Trajectory, changes: Sequence[Change] = ()) -> Array:
    """Stretch ratio: length over natural length, of every spring in every frame, shape (m, s)."""
    with np.errstate(over="ignore", invalid="ignore"):
        length = spring_lengths(trajectory.positions, system.springs)
        return np.asarray(length / _natural_lengths(system, trajectory, changes))


def _natural_lengths(system: MassSpringSystem, trajectory: Trajectory, changes: Sequence[Change] = ()) -> Array:
    """Of every spring the longer of its rest length and its length at the start [m], shape (s,).

    One without rest length is as long as its force lets it be: at least as long as the system is large. Infinite of
    those that may be of any length: they only push, or break.
    """
    natural = np.maximum(system.rest_lengths, spring_lengths(trajectory.positions[0], system.springs))
    if not system.rest_lengths.all():
        natural = np.where(system.rest_lengths > 0, natural, np.maximum(natural, system.scale))
    if system.nonlinear is not None:
        natural = np.where(system.nonlinear.may_open, np.inf, natural)
    return np.where(_may_break(system, changes), np.inf, natural)


def _may_break(system: MassSpringSystem, changes: Sequence[Change]) -> BoolArray:
    """Which springs can break on the way, or are to, shape (s,)."""
    named = [np.atleast_1d(change.value) for change in changes if change.parameter == BREAK]
    springs = np.arange(len(system.springs))
    may = np.isin(springs, np.concatenate(named)) if named else np.zeros(len(springs), dtype=bool)
    return np.asarray(may if system.nonlinear is None else may | system.nonlinear.may_break)


def _distance_ratios(
    system: MassSpringSystem, trajectory: Trajectory, natural: Array, changes: Sequence[Change]
) -> Array:
    """How far every mass is from its start, over how far it could have come, in every frame, shape (m, n).

    What nothing holds comes as far as it flies and falls, v t + g t^2/2; masses on springs not much further from one
    another than all springs end to end.

    Args:
        natural: of every spring [m], shape (s,).
    """
    t = trajectory.times
    fastest = np.linalg.norm(trajectory.velocities[0], axis=1).max(initial=0.0)
    reach = system.size + natural[np.isfinite(natural)].sum() or 1.0
    pull = _strongest_pulls(system, changes).sum() / _least_mass(system, changes)
    allowed = reach + fastest * t + (np.linalg.norm(_most(system, "gravity", changes)) + pull) * t**2 / 2
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(lengths(trajectory.positions - trajectory.positions[0]) / allowed[:, None])


def _energy_ratios(
    system: MassSpringSystem, trajectory: Trajectory, length: Array, natural: Array, changes: Sequence[Change]
) -> Array:
    """Kinetic and elastic energy over all that a system can have been given, in every frame, shape (m,).

    That is what both were at the start, what gravity and pulls do at most on the way, sum (m g + F) |x - x0|, and
    what would stretch every spring to twice its natural length and bend every angular one by 1 rad, a scale for what
    starts at rest. Zero where all of that
    is zero.

    Args:
        length: of every spring in every frame [m], shape (m, s). natural: that of every spring [m], shape (s,).
    """
    x, y = trajectory.positions, trajectory.positions[0]
    mass, stiffness = _most(system, "mass", changes), _most(system, "stiffness", changes)
    gravity = np.linalg.norm(_most(system, "gravity", changes))
    v = trajectory.velocities
    stiffest = system.with_parameter("stiffness", stiffness.tolist())
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        elastic = energy_of_springs(stiffest, length - system.rest_lengths)
        bent, of_a_radian = _bent(system, x)
        # of what breaks only what it had at the start: it may be of any length afterwards
        kept = elastic[:, ~_may_break(system, changes)].sum(axis=1)
        energy = 0.5 * np.einsum("mnd,mnd,n->m", v, v, mass) + kept + bent
        given = 0.5 * mass @ (v[0] ** 2).sum(axis=1) + elastic[0].sum() + bent[0] + of_a_radian
        given += energy_of_springs(stiffest, np.where(np.isfinite(natural), natural, system.rest_lengths)).sum()
        given = given + lengths(x - y) @ (gravity * mass + _strongest_pulls(system, changes))
        return np.where(given > 0, energy / given, 0.0)


def _bent(system: MassSpringSystem, x: Array) -> tuple[Array, float]:
    """The energy of all angular springs in every frame [J], shape (m,); and what it would be with all bent by 1 rad."""
    angular = system.angular_springs
    if angular is None:
        return np.zeros(len(x)), 0.0
    return energy_of_bends(angular, x).sum(axis=1), float(angular.stiffness.sum()) / 2


def _most(system: MassSpringSystem, parameter: str, changes: Sequence[Change]) -> Array:
    """The largest size that a parameter ever has, each of its numbers."""
    first = np.asarray(getattr(system, FIELDS.get(parameter, parameter)))
    later = [np.asarray(change.value) for change in changes if change.parameter == parameter]
    return np.asarray(reduce(np.maximum, (np.abs(value) for value in later), np.abs(first)))


def _strongest_pulls(system: MassSpringSystem, changes: Sequence[Change]) -> Array:
    """No less than the strongest pull that every mass ever has [N], shape (n,)."""
    most = np.abs(system.pulls)
    for change in changes:
        if is_pull(change.parameter):
            place = place_of_pull(change.parameter, most)
            most[place] = max(most[place], np.abs(change.value).item())
    return lengths(most)


def _least_mass(system: MassSpringSystem, changes: Sequence[Change]) -> float:
    """The smallest mass that there ever is [kg]."""
    later = [float(np.min(change.value)) for change in changes if change.parameter == "mass"]
    return min(float(system.masses.min()), *later) if later else float(system.masses.min())
