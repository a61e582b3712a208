"""Masses that collide with one another: round, without friction, losing a part of the speed at which they meet.

At the end of every step, after obstacles, pairs of masses nearer to one another than their two radii together are
looked at one after the other, in the order of their numbers, each as the ones before have left it:

    they are moved apart along the line between their centres until they touch, the lighter one further, so that their
    common centre stays where it is;
    if they approach at the speed w along that line, an impulse leaves them the speed e w apart, e the restitution.

So momentum is kept to rounding, and energy too of what is elastic, e = 1 (Newton's law of impact; Goldsmith, *Impact*,
1). One that is moved may be pushed into a third: so all is done again, in the reverse order and then in this one, until
none overlap, and at most ROUNDS times; what is left of a pile is for the next step. A mass that comes further in a step
than it and another are wide may pass through it.

The functions at the end are compiled: they are loops over numbers.
"""

from __future__ import annotations

import numpy as np

from reference.collisions.round_masses import ROUNDING, Collisions
from reference.jit import array, compiled
from reference.state import Array
from reference.system import IntArray

#: How often pairs are looked at in a step.
ROUNDS = 20


def collide(collisions: Collisions, inverse_masses: Array, x: Array, v: Array) -> tuple[Array, Array]:
    """Positions [m] and velocities [m/s] after all pairs that touch have been looked at, as new arrays.

    Args:
        inverse_masses: [1/kg], zero of fixed masses, shape (n,).
    """
    pairs = collisions.pairs(x)
    x, v = np.array(x, np.float64, order="C"), np.array(v, np.float64, order="C")
    for count in range(ROUNDS):
        if not len(pairs):
            break
        ordered = np.ascontiguousarray(pairs[::-1] if count % 2 else pairs)
        _part_all(ordered, collisions.radii, inverse_masses, collisions.restitution, x, v)
        pairs = collisions.pairs(x, 1 - ROUNDING)
    return x, v


def part(i: int, j: int, radii: Array, inverse: Array, restitution: float, x: Array, v: Array) -> None:
    """Move masses i and j apart, and let them bounce, in place. Two in one place part along the last axis."""
    both = inverse[i] + inverse[j]
    squares = 0.0
    for axis in range(x.shape[1]):
        squares += (x[j, axis] - x[i, axis]) ** 2
    distance = np.sqrt(squares)
    overlap = radii[i] + radii[j] - distance
    if overlap <= 0.0 or both == 0.0:
        return
    approach = 0.0
    for axis in range(x.shape[1]):
        normal = 1.0 if axis == x.shape[1] - 1 else 0.0
        if distance > 0.0:
            normal = (x[j, axis] - x[i, axis]) / distance
        approach += (v[j, axis] - v[i, axis]) * normal
    impulse = -(1.0 + restitution) * approach / both if approach < 0.0 else 0.0
    for axis in range(x.shape[1]):
        normal = 1.0 if axis == x.shape[1] - 1 else 0.0
        if distance > 0.0:
            normal = (x[j, axis] - x[i, axis]) / distance
        x[i, axis] -= overlap * inverse[i] / both * normal
        x[j, axis] += overlap * inverse[j] / both * normal
        v[i, axis] -= impulse * inverse[i] * normal
        v[j, axis] += impulse * inverse[j] * normal


def part_all(pairs: IntArray, radii: Array, inverse: Array, restitution: float, x: Array, v: Array) -> None:
    """One pair after the other."""
    for k in range(len(pairs)):
        part(pairs[k, 0], pairs[k, 1], radii, inverse, restitution, x, v)


KINDS = {
    **dict.fromkeys(("i", "j"), "int64"),
    "pairs": array(2, "int64"),
    **dict.fromkeys(("radii", "inverse"), array(1)),
    "restitution": "float64",
    **dict.fromkeys(("x", "v"), array(2, written=True)),
}

*_, _part_all = compiled(part, part_all, kinds=KINDS)
