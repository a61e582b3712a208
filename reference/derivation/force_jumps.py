"""Where in a step forces are taken, and with which weights, of a stepper that only steps.

A mass flies towards the other end of its spring from D away and past it: there the spring's force jumps by 2 k L, as it
turns around. A force that is taken where the mass is after c h v jumps at h v = D/c. As h v grows, the new h v then
jumps by 2 a L b, and the new x by 2 a L beta, with a = h^2 k/m: these are b and beta of

    x_i = x + c_i h v + ...,   v' = v + h sum b_i F(x_i)/m,   x' = x + h v + h^2 sum beta_i F(x_i)/m

to first order in a. Between jumps both are straight lines in h v, all of one slope. Forces taken at the start (c = 0)
never jump; their weight is what the line has beside those that do. Three small a are used, and a = 0 is extrapolated.
How far c moves with a tells what earlier forces add to x_i: a L Q_i, of all of them together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.derivation.formula import Number, number
from reference.derivation.oscillators import DT, Run, Runs, end_of
from reference.derivation.small_fractions import fraction_or_itself
from reference.errors import Unsupported
from reference.state import Array
from reference.system import MassSpringSystem

#: L and D [m]; the small a.
LENGTH, ASIDE, SMALL = 1.0, 0.5, (2.0**-14, 2.0**-15, 2.0**-16)

#: Forces are looked for between these c, which no method has; so many masses fly side by side, and c is found so near.
NEAREST, FARTHEST, MASSES, WIDTH = 0.0613, 1.2537, 96, 1e-12

#: A jump of less than this is none; and more forces than this are not told apart.
JUMP, MOST = 1e-3, 12

#: How near numbers are to the fractions they are taken for; and to what they have to add up to.
OFF, SUM = 1e-8, 1e-6


@dataclass(frozen=True)
class Taken:
    """A force that is taken in a step.

    Attributes:
        at: c, at which part of h v.
        in_velocity: b, its weight in the new velocity.
        in_position: beta, its weight in the new position.
        by_earlier: Q, what forces that are taken before it add to where it is taken, as multiples of a L, at the h v at
            which it jumps; 0 at the start.
    """

    at: Number
    in_velocity: Number
    in_position: Number
    by_earlier: float = 0.0

    def text(self) -> dict[str, str]:
        """Its numbers as they are written."""
        return {name: number(getattr(self, name)) for name in ("at", "in_velocity", "in_position")}


def forces_taken(runs: Runs) -> tuple[Taken, ...]:
    """Every force that a step takes, by c; those at one place one by one.

    Raises:
        Unsupported: where the stepper cannot step such masses, with its reason; where the jumps do not add up.
    """
    each = [_jumps(runs, a) for a in SMALL]
    if len({len(jumps) for jumps, _ in each}) != 1:
        raise Unsupported("forces that are taken near one another were not told apart")
    of_each = np.array([jumps for jumps, _ in each]).reshape(len(SMALL), -1, 3)
    jumps = _at_zero(of_each)
    # c moves by c L Q/D times a
    by_earlier = _slope_at_zero(of_each[:, :, 0]) * ASIDE / (LENGTH * jumps[:, 0])
    sum_b, sum_beta, sum_bc = _at_zero(np.array([line for _, line in each]))
    if abs(jumps[:, 0] @ jumps[:, 1] - sum_bc) > SUM:
        raise Unsupported(f"a force is taken where none was looked for, beyond c = {NEAREST:g} to {FARTHEST:g}")
    start = np.array([[0.0, sum_b - jumps[:, 1].sum(), sum_beta - jumps[:, 2].sum()]])
    rows = zip(np.concatenate([start, jumps]).tolist(), [0.0, *by_earlier.tolist()], strict=True)
    found = [
        Taken(fraction_or_itself(c, OFF), fraction_or_itself(b, OFF), fraction_or_itself(beta, OFF), q)
        for (c, b, beta), q in rows
    ]
    return tuple(taken for taken in found if taken.in_velocity or taken.in_position)


def _at_zero(values: Array) -> Array:
    """From values at a, a/2 and a/4: at a = 0, but for a^3."""
    whole, half, quarter = values
    return np.asarray((whole - 6 * half + 8 * quarter) / 3)


def _slope_at_zero(values: Array) -> Array:
    """From the same: by how much it rises with a, at a = 0."""
    whole, half, quarter = values
    return np.asarray((-2 * whole + 10 * half - 8 * quarter) / SMALL[0])


def _jumps(runs: Runs, a: float) -> tuple[list[tuple[float, float, float]], tuple[float, float, float]]:
    """Of every jump c, b and beta; and sum b, sum beta and sum b c from the line before the first."""
    grid = np.linspace(FARTHEST, NEAREST, MASSES)
    levels = _ends(runs, grid, a)
    s = 1 / grid
    slopes = np.diff(levels, axis=0) / np.diff(s)[:, None]
    slope = np.median(slopes, axis=0)
    at_rest = (levels - np.outer(s, slope))[0]  # where all are still before the other end
    sums = -at_rest / (1 - ASIDE / LENGTH)
    cells = _cells(grid, levels - np.outer(s, slope))
    while cells and cells[0][0] - cells[0][1] > WIDTH:
        wide = cells[0][0] - cells[0][1]
        inner = max(3, min(MASSES // len(cells), int(wide / WIDTH)))  # nearer, one may hit the other end itself
        grids = [np.linspace(low, high, inner) for low, high in cells]
        ends = _ends(runs, np.concatenate(grids), a).reshape(len(cells), inner, 2)
        cells = [cell for g, e in zip(grids, ends, strict=True) for cell in _cells(g, e - np.outer(1 / g, slope))]
        if len(cells) > MOST:
            raise Unsupported(f"its force jumps more than {MOST} times")
    across = _ends(runs, np.array(cells).ravel(), a).reshape(-1, 2, 2) if cells else np.zeros((0, 2, 2))
    heights = (across[:, 1] - across[:, 0]) / 2
    found = [((c + next_c) / 2, float(b), float(beta)) for (c, next_c), (b, beta) in zip(cells, heights, strict=True)]
    return sorted(found), (float(sums[0]), float(sums[1]), float(-slope[0] * LENGTH / ASIDE))


def _cells(grid: Array, levels: Array) -> list[tuple[float, float]]:
    """Between which neighbours there is a jump."""
    there = (np.abs(np.diff(levels, axis=0)) > JUMP).any(axis=1)
    return [(float(grid[i]), float(grid[i + 1])) for i in np.flatnonzero(there)]


def _ends(runs: Runs, parts: Sequence[float] | Array, a: float) -> Array:
    """What a step adds to h v, and to x beyond h v, over a L, of masses that come to the other end after c h v."""
    c = np.asarray(parts, float)
    n, moving = len(c), ASIDE / c
    place, speed = np.zeros((2 * n, 1)), np.zeros((2 * n, 1))
    place[1::2, 0], speed[1::2, 0] = -ASIDE, moving / DT
    system = MassSpringSystem(
        positions=place,
        velocities=speed,
        springs=np.arange(2 * n).reshape(n, 2),
        masses=np.ones(2 * n),
        rest_lengths=np.array(LENGTH),
        stiffness=np.full(n, a / DT**2),
        gravity=np.zeros(1),
        fixed=np.arange(2 * n) % 2 == 0,
    )
    (outcome,) = runs([Run(system, DT)])
    x, v = end_of(outcome)
    begun = speed[1::2, 0] * DT
    added = np.stack([v[1::2, 0] * DT - begun, (x[1::2, 0] + ASIDE) - begun], axis=1)
    return np.asarray(added / (a * LENGTH))
