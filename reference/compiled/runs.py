"""Runs: springs in a row that join masses in a row, as lattices have them, and the blocks that a cache holds.

Springs k, k + 1, ... of a lattice join masses a and b, a + 1 and b + 1, ...: what is gathered and scattered one by one
on any mesh is then read and written in a row, which a processor does for many at a time. What ends a run is told below.

Masses are taken in blocks of BLOCK in a row. A spring is computed with the block of its lower mass, and its force kept
only until the block of its higher mass has been summed: places for forces are used again and again, block after block,
like the pages of a calendar, so that they stay in the cache. Once a block is summed, no later spring looks at its
masses: they may be moved at once.

Blocks are shared out among chunks, which may be done at the same time. Springs from one chunk to another are computed
before, each with places of their own. So neither the blocks nor the chunks change a bit of the result.

Large meshes without runs have blocks too: see `mesh_loops`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.forces import springs_of_masses
from reference.jit import compiled
from reference.state import Array
from reference.system import BoolArray, IntArray, MassSpringSystem

#: How many masses in a row are a block.
BLOCK = 1024

#: From this many springs on, which no cache holds, blocks pay (`springlab run speed` shows where).
LARGE = 100_000

#: Runs are long enough at this many springs in the mean: a lattice of 20 masses a row has them.
LONG = 16


def is_large(system: MassSpringSystem) -> bool:
    """Whether a system is large enough for blocks."""
    return len(system.springs) >= LARGE


def has_runs(system: MassSpringSystem) -> bool:
    """Whether its springs are in the mean long enough in a row for loops over runs."""
    s = len(system.springs)
    return int(_begins(system, np.arange(s)).sum()) * LONG <= s


def runs_of(system: MassSpringSystem, chunks: int = 1) -> dict[str, Any]:
    """The lists and arrays that loops over runs need of a system, by the loops' names; chunks as in `blocks_of`."""
    blocks = blocks_of(system, chunks)
    begins = _begins(system, blocks.order)
    begins[blocks.first[blocks.first < len(begins)]] = True
    run = np.flatnonzero(begins)
    return {
        "run_a": system.springs[blocks.order[run], 0],
        "run_b": system.springs[blocks.order[run], 1],
        "run_place": blocks.place[blocks.order[run]],
        "run_spring": np.append(run, len(begins)),
        "block_runs": np.searchsorted(run, blocks.first),
        "rest_length": system.rest_lengths[blocks.order],
        "stiffness": system.stiffness[blocks.order[run]],
        "damping": system.damping[blocks.order[run]],
        **_sums(system, blocks.place),
        **blocks.arrays(system.dimension),
    }


@dataclass(frozen=True, eq=False)
class Blocks:
    """In which order springs are taken, and where their forces have their places.

    Attributes:
        order: of the springs: block by block, and those that are computed before the blocks.
        first: where in that order each block's springs begin, those before, and what is behind all.
        first_place: of each block's forces.
        place: of each spring's force.
        edges: at which block each chunk begins, and the end of the last.
    """

    order: IntArray
    first: IntArray
    first_place: IntArray
    place: IntArray
    edges: IntArray

    def arrays(self, dimension: int) -> dict[str, Any]:
        """The chunks, and room for forces and sums."""
        places, chunks = self.place.max(initial=0) + 1, len(self.edges) - 1
        forces = {f"force{i}": np.zeros(places) for i in range(dimension)}
        return {"edges": self.edges, **forces, **{f"sum{i}": np.zeros((chunks, BLOCK)) for i in range(dimension)}}


def blocks_of(system: MassSpringSystem, chunks: int, near: float = 1.0) -> Blocks:
    """The blocks of a system.

    Args:
        chunks: into how many parts they are shared out.
        near: the part of the springs that places are kept for; those that reach further are computed before.
    """
    blocks = -(-len(system.masses) // BLOCK)
    edges = np.arange(chunks + 1) * blocks // chunks
    home, reach = _homes(system.springs, edges, near)
    order = np.argsort(home, kind="stable")
    home = home[order]
    first = np.searchsorted(home, np.arange(blocks + 2))
    place = np.empty_like(order)
    first_place = _places(first, edges, reach)
    place[order] = (first_place - first[:-1])[home] + np.arange(len(order))
    return Blocks(order, first, first_place, place, edges)


def _begins(system: MassSpringSystem, order: IntArray) -> BoolArray:
    """Which springs, taken in an order, begin a run: all that do not go on one mass further with the same numbers."""
    begins = np.zeros(len(order), dtype=bool)
    begins[:1] = True
    for ends in system.springs.T:
        begins[1:] |= np.diff(ends[order]) != 1
    for number in (system.stiffness, system.damping):
        begins[1:] |= np.diff(number[order]) != 0
    return begins


def _homes(springs: IntArray, edges: IntArray, near: float) -> tuple[IntArray, int]:
    """The block each spring is computed with, those computed before after all; over how many blocks others reach."""
    a, b = springs.T // BLOCK
    low, high = np.minimum(a, b), np.maximum(a, b)
    chunk = np.repeat(np.arange(len(edges) - 1), np.diff(edges))
    within = np.sort((high - low)[chunk[low] == chunk[high]])
    reach = int(within[int(near * (len(within) - 1))]) if len(within) else 0
    before = (chunk[low] != chunk[high]) | (high - low > reach)
    return np.where(before, edges[-1], low), reach


def _places(first: IntArray, edges: IntArray, reach: int) -> IntArray:
    """Where each block's forces begin, those computed before behind all others: used again after `reach` more."""
    width = int(np.diff(first[:-1]).max(initial=0))
    chunk = np.repeat(np.arange(len(edges) - 1), np.diff(edges))
    turn = (np.arange(edges[-1]) - edges[chunk]) % (reach + 1)
    return np.append(chunk * (reach + 1) + turn, (len(edges) - 1) * (reach + 1)) * width


def _sums(system: MassSpringSystem, place: IntArray) -> dict[str, IntArray | Array]:
    """Masses in a row whose springs' forces are in a row, in their springs' order: what each such row adds up."""
    first, spring, sign = springs_of_masses(system)
    n, where = len(system.masses), place[spring]
    goes_on = np.zeros(n, dtype=bool)
    _write_which_go_on(first, where, sign, BLOCK, goes_on)
    row, count = np.flatnonzero(~goes_on), np.diff(first)
    kept = np.repeat(~goes_on, count)
    return {
        "row_mass": np.append(row, n),
        "row_entry": np.concatenate([[0], np.cumsum(count[row])]),
        "entry_place": where[kept],
        "entry_sign": sign[kept],
        "block_rows": np.searchsorted(row, np.append(np.arange(0, n, BLOCK), n)),
    }


def which_go_on(first: IntArray, where: IntArray, sign: Array, block: int, goes_on: BoolArray) -> None:
    """Write for each mass whether it goes on with the row of the one before: each force one place further."""
    for i in range(1, len(goes_on)):
        count = first[i + 1] - first[i]
        alike = i % block != 0 and count == first[i] - first[i - 1]
        if alike:
            for entry in range(first[i], first[i + 1]):
                before = entry - count
                alike = alike and where[entry] == where[before] + 1 and sign[entry] == sign[before]
        goes_on[i] = alike


(_write_which_go_on,) = compiled(which_go_on)
