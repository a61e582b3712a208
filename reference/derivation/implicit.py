"""Tableaux of steppers that solve equations: the points they come to in the end are the stages.

Where it asked last before it was done, and at what it asked for those slopes, satisfy y1 = y0 + h sum b_i f(P_i) and
P_i = y0 + h sum a_ij f(P_j): with enough unknowns that is many equations for few coefficients, and what is left of
them tells whether these points are the stages at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache, partial
from itertools import combinations

import numpy as np

from reference.derivation.formula import Number
from reference.derivation.multistep import Multistep, multistep_of
from reference.derivation.recording import ROW
from reference.derivation.small_fractions import fraction_or_itself
from reference.derivation.tableau import Tableau
from reference.forces import SpringMotion
from reference.schemes.catalogue import Scheme
from reference.state import Array, Slope, State
from reference.system import MassSpringSystem

#: Points nearer to one another than this part of their size are one stage, as far as its equation is solved.
ONE_STAGE = 1e-6

#: A difference that no Jacobian is made of; in so many unknowns at most do points differ that one is made of.
ROUNDING, VARIED = 1e-12, 2

#: So many points before one, for each unknown, are looked at for the one it is varied from: stages squared.
BEFORE = 10

#: Of the points asked, so many of the last can be stages; and so many stages are tried.
LAST, MOST_STAGES = 8, 3

#: What may be left of the equations, as a part of a step's change; and how far a coefficient may be off.
LEFT, OFF = 1e-8, 1e-8

#: Coefficients that are smaller and no fractions are what is left of a solver's iterations, not a method's.
GHOST = 1e-5

#: To what part the conditions on such a tableau are known.
KNOWN_TO = 1e-7


def tableau_by_points(
    start: Array,
    end: Array,
    h: float,
    points: Sequence[Array],
    slopes: Sequence[Array],
    parts: Sequence[float] | None = None,
) -> Tableau | None:
    """The tableau of the fewest stages that a step satisfies; None where it satisfies none.

    Args:
        start: y0, all unknowns in a row; end: y1.
        points: all P that it asked at, in order; slopes: f there.
        parts: at what parts of h it said that it asked, where it says so: else they follow from a.
    """
    groups = _groups(points)
    # iterates that have all but converged look like a Jacobian's differences: the better of the two ways is taken
    unvaried = [next((i for i in reversed(group) if not _differenced(points, i)), None) for group in groups]
    found_last = [i for i in unvaried if i is not None], [group[-1] for group in groups]
    # the slope at the start may be asked for once only, before all others
    ways = [[*way[:-LAST][:1], *way[-LAST:]] for way in found_last]
    for stages in range(1, MOST_STAGES + 1):
        found: list[tuple[float, Tableau]] = []
        for kept in ways:
            for chosen in reversed(list(combinations(kept, stages))):
                matrix = h * np.stack([slopes[i] for i in chosen], axis=1)
                changes = np.stack([end, *(points[i] for i in chosen)], axis=1) - start[:, None]
                coefficients: Array = np.asarray(np.linalg.lstsq(matrix, changes, rcond=None)[0])
                left = float(np.abs(matrix @ coefficients - changes).max() / np.abs(matrix).max())
                told = [_told(parts, groups, i) for i in chosen] if parts is not None else None
                tableau = _tableau(coefficients.T, told) if left <= LEFT else None
                if tableau is not None:
                    found.append((left, tableau))
        if found:
            return min(found, key=lambda item: item[0])[1]
    return None


def _told(parts: Sequence[float], groups: Sequence[Sequence[int]], i: int) -> list[float]:
    """At which parts of h it was asked at the stage of a point: an end of one solve may be where another begins."""
    return [parts[j] for group in groups if i in group for j in group]


def _off(on: float, part: float) -> float:
    return abs(part - on)


def _tableau(rows: Array, told: Sequence[Sequence[float]] | None) -> Tableau | None:
    """Of b and the rows of a, and the parts of h it told; None where a coefficient is a solver's noise."""
    b, *a = [tuple(fraction_or_itself(c, OFF) for c in row) for row in rows]
    if any(c and abs(float(c)) < GHOST for row in (b, *a) for c in row):
        return None
    c: list[Number] = [sum(row, start=Fraction(0)) for row in a]
    if told is not None:
        nearest = [min(of_one, key=partial(_off, float(on))) for of_one, on in zip(told, c, strict=True)]
        c = [fraction_or_itself(part, OFF) for part in nearest]
    return Tableau(tuple(a), b, tuple(c), KNOWN_TO)


def _differenced(points: Sequence[Array], i: int) -> bool:
    """Whether a point is another's but for few unknowns: a Jacobian was made of differences there.

    Iterates that have all but converged may differ in few unknowns, too, by rounding.
    """
    before = points[max(0, i - BEFORE * len(points[i])) : i]
    if not before:
        return False
    apart = np.count_nonzero(np.abs(np.stack(before) - points[i]) > ROUNDING, axis=1)
    return bool(((apart > 0) & (apart <= VARIED)).any())


def _groups(points: Sequence[Array]) -> list[list[int]]:
    """The points, in order, those together that are one stage; groups in the order of their last."""
    groups: list[list[int]] = []
    size = max(float(np.abs(p).max()) for p in points) if points else 1.0
    for i in range(len(points) - 1, -1, -1):
        near = (group for group in groups if np.abs(points[i] - points[group[0]]).max() <= ONE_STAGE * size)
        group = next(near, None)
        if group is None:
            groups.append([i])
        else:
            group.append(i)
    return [group[::-1] for group in groups[::-1]]


@cache
def implicit_tableau(scheme: Scheme) -> Tableau | None:
    """The tableau of a scheme that is given the springs and solves its equations; None where it has none."""
    if scheme.needs != "springs" or not scheme.one_step:
        return None
    system = _strong_spring_net()
    motion = _Recording(system)
    h = 0.05
    end = scheme.on(motion)(motion.start, h)
    return tableau_by_points(_row(motion.start), _row(end), h, motion.points, motion.slopes)


@cache
def implicit_multistep(scheme: Scheme) -> Multistep | None:
    """The coefficients of a scheme that is given the springs and looks back; None where it has none."""
    if scheme.needs != "springs" or scheme.one_step:
        return None
    motion = _Recording(_strong_spring_net())
    h, states = 0.01, [motion.start]
    advance = scheme.on(motion)
    for _ in range(ROW):
        states.append(advance(states[-1], h))
    rates = [np.concatenate([s.velocities, SpringMotion.acceleration(motion, s)], axis=None) for s in states]
    return multistep_of(h, [_row(s) for s in states], rates)


class _Recording(SpringMotion):
    """Springs that keep where they were asked for accelerations."""

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(system)
        self.points: list[Array] = []
        self.slopes: list[Array] = []

    def acceleration(self, state: State, /, damping: bool = True) -> Array:
        """As springs do."""
        found = super().acceleration(state, damping)
        self.points.append(_row(state))
        self.slopes.append(np.concatenate([state.velocities, found], axis=None))
        return found

    def slope(self, state: State, /) -> Slope:
        """As springs do."""
        return Slope(1.0, state.velocities, self.acceleration(state))


def _row(state: State) -> Array:
    return np.concatenate([state.positions, state.velocities], axis=None)


def _strong_spring_net() -> MassSpringSystem:
    """Ten masses, all different, that stretch and turn their springs a good deal in a step."""
    random = np.random.default_rng(5)
    n = 10
    springs = np.array([[i, j] for i in range(n) for j in (i + 1, i + 2) if j < n])
    return MassSpringSystem(
        positions=np.stack([np.arange(n) * 0.5, random.uniform(-0.4, 0.4, n)], axis=1),
        velocities=random.uniform(-2, 2, (n, 2)),
        springs=springs,
        masses=random.uniform(0.5, 1.5, n),
        rest_lengths=random.uniform(0.4, 0.9, len(springs)),
        stiffness=random.uniform(50, 150, len(springs)),
        damping=random.uniform(0.5, 2, len(springs)),
        drag=0.4,
    )
