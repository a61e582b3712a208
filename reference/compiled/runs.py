"""Runs: springs in a row that join masses in a row, as lattices have them, and the blocks that a cache holds.

Springs k, k + 1, ... of a lattice join masses a and b, a + 1 and b + 1, ...: what is gathered and scattered one by one
on any mesh is then read and written in a row, which a processor does for many at a time. What ends a run is told below.

Masses are taken in blocks of BLOCK in a row. A spring is computed with the block of its lower mass, and its force kept
only until the block of its higher mass has been summed: places for forces are used again and again, block after block,
like the pages of a calendar, so that they stay in the cache. Once a block is summed, no later spring looks at its
masses: they may be moved at once.

Blocks are shared out among chunks, which may be done at the same time. Springs from one chunk to another are computed
before, each with places of their own. So neither the blocks nor the chunks change a bit of the result.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.forces import springs_of_masses
from reference.jit import compiled
from reference.state import Array
from reference.system import BoolArray, IntArray, MassSpringSystem

#: How many masses in a row are a block.
BLOCK = 1024

#: From this many springs on, which no cache holds, it pays to find runs (`springlab run speed` shows where).
RUNS_FROM = 100_000

#: Runs are long enough at this many springs in the mean: a lattice of 20 masses a row has them.
LONG = 16


def has_runs(system: MassSpringSystem) -> bool:
    """Whether a system is large enough, and its springs in the mean long enough in a row, for loops over runs."""
    s = len(system.springs)
    return s >= RUNS_FROM and int(_begins(system, np.arange(s)).sum()) * LONG <= s


def runs_of(system: MassSpringSystem, chunks: int = 1) -> dict[str, Any]:
    """The lists and arrays that loops over runs need of a system, by the loops' names.

    Args:
        chunks: into how many parts the blocks are shared out.
    """
    lists, place = _runs(system, chunks)
    axes = range(system.dimension)
    return {
        **lists,
        **_sums(system, place),
        **{f"force{i}": np.zeros(place.max(initial=0) + 1) for i in axes},
        **{f"sum{i}": np.zeros((chunks, BLOCK)) for i in axes},
    }


def _runs(system: MassSpringSystem, chunks: int) -> tuple[dict[str, Any], IntArray]:
    """The springs run by run, and where each spring's force has its place."""
    blocks = -(-len(system.masses) // BLOCK)
    edges = np.arange(chunks + 1) * blocks // chunks
    home, reach = _homes(system.springs, edges)
    order = np.argsort(home, kind="stable")
    home = home[order]
    of_block = np.searchsorted(home, np.arange(blocks + 2))
    place = (_places(of_block, edges, reach) - of_block[:-1])[home] + np.arange(len(order))
    begins = _begins(system, order)
    begins[of_block[of_block < len(order)]] = True
    run = np.flatnonzero(begins)
    lists = {
        "run_a": system.springs[order[run], 0],
        "run_b": system.springs[order[run], 1],
        "run_place": place[run],
        "run_spring": np.append(run, len(order)),
        "block_runs": np.searchsorted(run, of_block),
        "edges": edges,
        "rest_length": system.rest_lengths[order],
        "stiffness": system.stiffness[order[run]],
        "damping": system.damping[order[run]],
    }
    place_of = np.empty_like(place)
    place_of[order] = place
    return lists, place_of


def _begins(system: MassSpringSystem, order: IntArray) -> BoolArray:
    """Which springs, taken in an order, begin a run: all that do not go on one mass further with the same numbers."""
    begins = np.zeros(len(order), dtype=bool)
    begins[:1] = True
    for ends in system.springs.T:
        begins[1:] |= np.diff(ends[order]) != 1
    for number in (system.stiffness, system.damping):
        begins[1:] |= np.diff(number[order]) != 0
    return begins


def _homes(springs: IntArray, edges: IntArray) -> tuple[IntArray, int]:
    """The block each spring is computed with, those between chunks after all; and over how many blocks others reach."""
    a, b = springs.T // BLOCK
    low, high = np.minimum(a, b), np.maximum(a, b)
    chunk = np.repeat(np.arange(len(edges) - 1), np.diff(edges))
    crossing = chunk[low] != chunk[high]
    reach = int((high - low)[~crossing].max(initial=0))
    return np.where(crossing, edges[-1], low), reach


def _places(of_block: IntArray, edges: IntArray, reach: int) -> IntArray:
    """Where each block's forces begin, those between chunks behind all others: used again after `reach` more blocks."""
    width = int(np.diff(of_block[:-1]).max(initial=0))
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
