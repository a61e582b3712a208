"""In which order a solver goes through the springs of a system: where it stops early, the order is part of the scheme.

Those of ORDERS are

    made        as they are numbered
    reversed    the last made first
    colours     springs that share no moving mass are of one colour; colour after colour, each in the order made
    apart       the same, of springs that share no mass at all
    fixed_last  colours of springs between moving masses; then those to fixed ones, the first colour of them last
    newest_first  colours of springs between moving masses, begun with the last made; then those to fixed ones, the
                last made first, as PhysX has them
    from_fixed  those nearest to a fixed mass along springs first, as Jolt puts them (up to 128 masses)
    island      as Box2D 2 walks from body to body: the newest first, along the newest joints first
"""

from __future__ import annotations

from heapq import heappop, heappush

import numpy as np

from reference.errors import unknown_name
from reference.system import BoolArray, IntArray, MassSpringSystem

ORDERS = ("made", "reversed", "colours", "apart", "fixed_last", "newest_first", "from_fixed", "island")


def in_order(system: MassSpringSystem, order: str) -> IntArray:
    """The numbers of the springs, in the order they are solved in, shape (s,); those between fixed masses left out.

    Raises:
        InputError: for an order that is none of ORDERS.
    """
    if order not in ORDERS:
        raise unknown_name("order of springs", order, ORDERS)
    moves = ~system.fixed[system.springs].all(axis=1)
    made = np.flatnonzero(moves)
    if order == "island":
        return np.array(_island(system), dtype=np.int64)
    if order == "from_fixed":
        return _from_fixed(system, made)
    if order in ("reversed", "newest_first"):
        made = made[::-1]
    if order == "newest_first":
        to_fixed = system.fixed[system.springs[made]].any(axis=1)
        first = made[~to_fixed]
        made = np.concatenate([first[np.argsort(_colours(system, first, system.fixed), kind="stable")], made[to_fixed]])
    if order in ("colours", "apart", "fixed_last"):
        held = np.zeros_like(system.fixed) if order == "apart" else system.fixed
        to_fixed = system.fixed[system.springs[made]].any(axis=1) & (order == "fixed_last")
        first, last = made[~to_fixed], made[to_fixed]
        # the colours of the last are counted downwards from the last colour there is
        parts = ((first, _colours(system, first, held)), (last, -_colours(system, last, held)))
        made = np.concatenate([springs[np.argsort(colours, kind="stable")] for springs, colours in parts])
    return np.ascontiguousarray(made, dtype=np.int64)


def _from_fixed(system: MassSpringSystem, made: IntArray) -> IntArray:
    """By the nearer end's distance from a fixed mass, along springs, in single precision; then by its number."""
    ends = system.springs[made]
    x = system.positions.astype(np.float32)
    gap = x[ends[:, 1]] - x[ends[:, 0]]
    lengths = np.sqrt((gap * gap).sum(axis=1, dtype=np.float32))
    springs: list[list[tuple[int, np.float32]]] = [[] for _ in system.masses]
    for (a, b), length in zip(ends.tolist(), lengths, strict=True):
        springs[a].append((b, length))
        springs[b].append((a, length))
    distance = np.where(system.fixed, np.float32(0), np.float32(np.inf))
    to_visit = [(np.float32(0), i) for i in np.flatnonzero(system.fixed).tolist()]
    while to_visit:  # Dijkstra's algorithm
        so_far, at = heappop(to_visit)
        for other, length in springs[at] if so_far <= distance[at] else []:
            if so_far + length < distance[other]:
                distance[other] = so_far + length
                heappush(to_visit, (distance[other], other))
    return made[np.lexsort((made, ends.min(axis=1), distance[ends].min(axis=1)))]


def _colours(system: MassSpringSystem, made: IntArray, held: BoolArray) -> IntArray:
    """Greedy: each spring has the first colour that no spring before it has on one of its masses that are not held."""
    taken: list[set[int]] = [set() for _ in system.masses]
    colours = []
    for j in made.tolist():
        ends = [i for i in system.springs[j].tolist() if not held[i]]
        used = set().union(*(taken[i] for i in ends))
        colour = next(c for c in range(len(used) + 1) if c not in used)
        colours.append(colour)
        for i in ends:
            taken[i].add(colour)
    return np.array(colours, dtype=np.int64)


def _island(system: MassSpringSystem) -> list[int]:
    """Depth first, from the last mass on; a fixed mass is an end of the walk (b2World::Solve of Box2D 2)."""
    springs: list[list[tuple[int, int]]] = [[] for _ in system.masses]
    for j, (a, b) in enumerate(system.springs.tolist()):
        springs[a].insert(0, (j, b))
        springs[b].insert(0, (j, a))
    found: dict[int, None] = {}
    seen = np.zeros(len(system.masses), dtype=bool)
    for seed in reversed(range(len(system.masses))):
        stack = [] if seen[seed] else [seed]
        while stack:
            at = stack.pop()
            for j, other in [] if system.fixed[at] else springs[at]:
                if j not in found:
                    found[j] = None
                    if not seen[other]:
                        seen[other] = True
                        stack.append(other)
    return list(found)
