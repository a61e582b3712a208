"""The lecture's own algorithms, executed: Heun on a string, as loops and as whole arrays (slides 7-11); a barrier (17).

Bailey, *Modeling the World as a Mesh of Springs* (2021). The mathematics is the lecture's, the code is ours: a string
of links below an anchor at (x0, y0), link i hanging by spring i. Each link's derivatives come from a function of their
own that reads an array of links, because which array it reads is what slides 7 and 11 are about.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from reference.changes import Change, changes_by_step
from reference.line import parameter_in_plane, system_in_plane, trajectory_on_line, value_in_plane
from reference.obstacles import Circle
from reference.outcome import Outcome, outcome_of
from reference.registry import summary_of
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem


@dataclass
class Links:
    """The array of links: lists of one number per link (or NumPy arrays), in m and m/s."""

    x: list[float]
    y: list[float]
    vx: list[float]
    vy: list[float]

    def copy(self) -> Links:
        """Links of their own with the same numbers."""
        return Links(list(self.x), list(self.y), list(self.vx), list(self.vy))


@dataclass(frozen=True)
class StringConstants:
    """What the lecture's program holds as constants: anchor [m], and for each link K [N/m], D0 [m], mass [kg]."""

    x0: float
    y0: float
    stiffness: list[float]
    rest_length: list[float]
    mass: list[float]
    gravity: float
    drag: float
    #: x, y and radius [m] of each circle.
    circles: Sequence[tuple[float, float, float]] = ()

    @classmethod
    def of(cls, system: MassSpringSystem) -> StringConstants:
        """The constants of a string."""
        x0, y0 = system.positions[0].tolist()
        springs = (system.stiffness.tolist(), system.rest_lengths.tolist())
        circles = [(c.centre[0], c.centre[1], c.radius) for c in system.obstacles if isinstance(c, Circle)]
        return cls(x0, y0, *springs, system.masses[1:].tolist(), -float(system.gravity[1]), system.drag, circles)


#: (vx, vy, ax, ay) of one link.
Derivatives = tuple[float, float, float, float]


def derivatives(links: Links, i: int, string: StringConstants, next_spring: bool = True) -> Derivatives:
    """The derivatives of link i, read from an array of links (slides 9-10).

    Args:
        next_spring: False for what the printed function does up to its first closing brace: no spring below.
    """
    force_x, force_y = 0.0, -string.mass[i] * string.gravity
    above = (string.x0, string.y0) if i == 0 else (links.x[i - 1], links.y[i - 1])
    pull_x, pull_y = _pull(links, i, *above, string.stiffness[i], string.rest_length[i])
    force_x, force_y = force_x + pull_x, force_y + pull_y
    if next_spring and i + 1 < len(links.x):
        below = (links.x[i + 1], links.y[i + 1])
        pull_x, pull_y = _pull(links, i, *below, string.stiffness[i + 1], string.rest_length[i + 1])
        force_x, force_y = force_x + pull_x, force_y + pull_y
    force_x -= string.drag * links.vx[i]
    force_y -= string.drag * links.vy[i]
    return links.vx[i], links.vy[i], force_x / string.mass[i], force_y / string.mass[i]


def _pull(links: Links, i: int, x: float, y: float, stiffness: float, rest_length: float) -> tuple[float, float]:
    """The force on link i of a spring to (x, y) (slide 5)."""
    dx, dy = x - links.x[i], y - links.y[i]
    length = sqrt(dx * dx + dy * dy)
    force = stiffness * (length - rest_length)
    return force * (dx / length), force * (dy / length)


def force_from_next(y: Sequence[float], i: int, stiffness: float, rest_length: float, printed: bool) -> float:
    """The force on mass i of the spring to mass i + 1 below it, in one dimension (slide 4), along y upwards [N].

    Args:
        y: heights of the masses [m], falling.
        printed: with the sign of D0 as it is printed, else with the one the geometry asks for.
    """
    sign = -1.0 if printed else 1.0
    return stiffness * (y[i + 1] - y[i] + sign * rest_length)


def heun_loops(links: Links, string: StringConstants, dt: float) -> None:
    """Slide 7: all derivatives, then all guesses; all derivatives again, then all links."""
    every = range(len(links.x))
    first = [derivatives(links, i, string) for i in every]
    guess = links.copy()
    for i in every:
        _move_to_guess(guess, links, i, first[i], dt)
    second = [derivatives(guess, i, string) for i in every]
    for i in every:
        _move_on(links, i, first[i], second[i], dt)


def heun_fused_loops(links: Links, string: StringConstants, dt: float) -> None:
    """Slide 11, headed incorrect: each link's guess right after its derivatives, and each link's move too.

    It is correct. The first loop reads `links` and writes `guess`, the second reads `guess` and writes `links`: no
    link ever sees another one advanced, and the arithmetic is that of slide 7 to the bit.
    """
    every = range(len(links.x))
    guess = links.copy()
    first = []
    for i in every:
        first.append(derivatives(links, i, string))
        _move_to_guess(guess, links, i, first[i], dt)
    for i in every:
        _move_on(links, i, first[i], derivatives(guess, i, string), dt)


def heun_with_barrier(links: Links, string: StringConstants, dt: float) -> None:
    """Slides 7 and 17: the circle's "tangential velocity" is a product of components, as it is printed."""
    heun_loops(links, string, dt)
    for centre_x, centre_y, radius in string.circles:
        for i in range(len(links.x)):
            dx, dy = links.x[i] - centre_x, links.y[i] - centre_y
            square = dx * dx + dy * dy
            if square < radius * radius:
                distance = sqrt(square)
                dx, dy = dx / distance, dy / distance
                links.x[i], links.y[i] = centre_x + radius * dx, centre_y + radius * dy
                links.vx[i] *= dy
                links.vy[i] *= -dx


def heun_arrays(links: Links, string: StringConstants, dt: float) -> None:
    """Slide 8: the same with whole arrays in place of the loops (NumPy for the slide's array notation)."""
    x, y, vx, vy = (np.array(values) for values in (links.x, links.y, links.vx, links.vy))
    vx1, vy1, ax1, ay1 = all_derivatives(x, y, vx, vy, string)
    guess = x + dt * vx1, y + dt * vy1, vx + dt * ax1, vy + dt * ay1
    vx2, vy2, ax2, ay2 = all_derivatives(*guess, string)
    links.x = (x + dt * (vx1 + vx2) / 2).tolist()
    links.y = (y + dt * (vy1 + vy2) / 2).tolist()
    links.vx = (vx + dt * (ax1 + ax2) / 2).tolist()
    links.vy = (vy + dt * (ay1 + ay2) / 2).tolist()


def all_derivatives(x: Array, y: Array, vx: Array, vy: Array, string: StringConstants) -> tuple[Array, ...]:
    """The derivatives of all links at once: each link's spring above is the spring below of the link before."""
    dx, dy = np.diff(x, prepend=string.x0), np.diff(y, prepend=string.y0)
    length = np.sqrt(dx * dx + dy * dy)
    force = np.array(string.stiffness) * (length - np.array(string.rest_length))
    mass = np.array(string.mass)
    force_x, force_y = np.zeros_like(x), -mass * string.gravity
    pull_x, pull_y = force * (dx / length), force * (dy / length)
    force_x, force_y = force_x - pull_x, force_y - pull_y
    force_x[:-1] += pull_x[1:]
    force_y[:-1] += pull_y[1:]
    return vx, vy, (force_x - string.drag * vx) / mass, (force_y - string.drag * vy) / mass


def _move_to_guess(guess: Links, links: Links, i: int, slope: Derivatives, dt: float) -> None:
    guess.x[i] = links.x[i] + dt * slope[0]
    guess.y[i] = links.y[i] + dt * slope[1]
    guess.vx[i] = links.vx[i] + dt * slope[2]
    guess.vy[i] = links.vy[i] + dt * slope[3]


def _move_on(links: Links, i: int, first: Derivatives, second: Derivatives, dt: float) -> None:
    links.x[i] += dt * (first[0] + second[0]) / 2
    links.y[i] += dt * (first[1] + second[1]) / 2
    links.vx[i] += dt * (first[2] + second[2]) / 2
    links.vy[i] += dt * (first[3] + second[3]) / 2


@dataclass(frozen=True)
class LectureListing:
    """One of the lecture's listings as a stepper. Only strings can be stepped: that is what the listings are of."""

    name: str
    advance: Callable[[Links, StringConstants, float], None]
    kind: str = "lecture"
    version: str | None = None

    @property
    def summary(self) -> str:
        """The first line of the listing's docstring."""
        return summary_of(self.advance)

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """See reference.stepper.Stepper. A string along a line hangs straight down in the plane."""
        if system.dimension == 1:
            values = [_in_plane(change) for change in changes]
            outcome = self.run(system_in_plane(system), dt, steps, values)
            trajectory = outcome.trajectory
            return outcome if trajectory is None else replace(outcome, trajectory=trajectory_on_line(trajectory))
        pending = changes_by_step(tuple(changes), dt)
        reason = why_no_string(system) or self._why_no_barrier(system)
        if reason:
            return Outcome("unsupported", reason)
        links = Links(*system.positions[1:].T.tolist(), *system.velocities[1:].T.tolist())
        states = [system.start]
        current = system
        try:
            for step in range(steps):
                for change in pending.get(step, ()):
                    current = current.with_parameter(change.parameter, change.value)
                    if why_no_string(current):
                        return Outcome("unsupported", f"{change.parameter} = {change.value}: {why_no_string(current)}")
                with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
                    self.advance(links, StringConstants.of(current), dt)
                states.append(_state((step + 1) * dt, system, links))
        except (OverflowError, ZeroDivisionError) as error:
            return Outcome("diverged", f"{error} at t = {step * dt:.6g} s", Trajectory.of(states))
        return outcome_of(system, Trajectory.of(states), changes)

    def _why_no_barrier(self, system: MassSpringSystem) -> str | None:
        if not all(isinstance(obstacle, Circle) for obstacle in system.obstacles):
            return "the lecture's only barrier is a circle"
        if system.obstacles and self.advance is not heun_with_barrier:
            return "this listing knows no barrier, slide 17's does: lecture_barrier"
        return None


def _in_plane(change: Change) -> Change:
    parameter = parameter_in_plane(change.parameter)
    return replace(change, parameter=parameter, value=value_in_plane(change.parameter, change.value))


def why_no_string(system: MassSpringSystem) -> str | None:
    """Why a system is not the lecture's string, or None if it is."""
    if system.dimension != 2 or not system.is_string:
        return "the lecture's listings step strings only, in 2D and hung at their first mass"
    if system.collisions is not None:
        return "the lecture's masses do not collide with one another"
    if system.pulls.any():
        return "the lecture's listings know no force that pulls on a mass"
    if system.nonlinear is not None:
        return f"the lecture's springs are linear: they have no {', '.join(system.nonlinear.asked)}"
    if system.angular_springs is not None:
        return "the lecture's listings know no springs that resist bending"
    if system.damping.any():
        return "the lecture's listings have drag, but no damping along the springs"
    if system.gravity[0]:
        return "the lecture's listings have gravity along the second axis only"
    return None


def _state(time: float, system: MassSpringSystem, links: Links) -> State:
    positions = np.vstack([system.positions[:1], np.column_stack([links.x, links.y])])
    velocities = np.vstack([system.velocities[:1], np.column_stack([links.vx, links.vy])])
    return State(time, positions, velocities)


def listings() -> Mapping[str, LectureListing]:
    """The lecture's listings by name."""
    known = (
        LectureListing("lecture_heun_loops", heun_loops),
        LectureListing("lecture_heun_arrays", heun_arrays),
        LectureListing("lecture_heun_incorrect", heun_fused_loops),
        LectureListing("lecture_barrier", heun_with_barrier),
    )
    return {listing.name: listing for listing in known}
