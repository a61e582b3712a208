"""The text of loops over large meshes without runs, and the order in which they take masses and springs.

Blocks, chunks and places are those of `runs`. Masses are renumbered, so that neighbours have numbers close together
(reverse Cuthill-McKee: Cuthill and McKee 1969, George 1971); within a block those of as many springs are a row: a term
is added for each of them, then the next, which a processor does for many at a time. Springs are taken block by block.
Each mass still sums its springs in the order they were given in, so no bit of the result changes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.compiled import runs
from reference.compiled.loops import indented
from reference.compiled.run_loops import RunLoops
from reference.forces import springs_of_masses
from reference.system import IntArray, MassSpringSystem

#: This part of the springs reaches as far as forces are kept for; those that reach further are computed before.
NEAR = 0.99


@dataclass(frozen=True)
class MeshLoops(RunLoops):
    """One kernel's text in the making: each block has one run, of which lists say what its springs join."""

    @property
    def run_lists(self) -> list[str]:
        """Where runs begin, and what each spring joins."""
        return ["ends_a", "ends_b", "run_place", "run_spring"]

    def _run(self) -> list[str]:
        """The springs of a block: n from the first on."""
        force = self._force("x", "v", "a", "b", "begin + t", "rest_length[k]", "stiffness[k]", "damping[k]")
        return ["for t in range(n):", *indented(["k = first + t", "a = ends_a[k]", "b = ends_b[k]", *force])]

    def _entries(self, terms: int) -> str:
        """One for each term of each mass."""
        return f"np.uint64({terms}) * n"

    def _terms(self, terms: int) -> list[str]:
        """Some terms: the first of all masses, then the second of all."""
        starts = [f"e{m} = e + {self._entries(m)}" for m in range(terms)]
        return [
            *starts,
            *self._added([f"entry_sign[e{m} + t] * force{{i}}[entry_place[e{m} + t]]" for m in range(terms)]),
        ]


def numbering(system: MassSpringSystem) -> IntArray:
    """The masses in the order in which loops take them."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    n, springs = len(system.masses), system.springs
    ends = np.concatenate([springs, np.fliplr(springs)]).T
    joined = coo_array((np.ones(2 * len(springs), dtype=np.int8), ends), shape=(n, n)).tocsr()
    order = reverse_cuthill_mckee(joined, symmetric_mode=True).astype(np.int64)
    count = np.bincount(springs.ravel(), minlength=n)[order]
    return order[np.lexsort((count, np.arange(n) // runs.BLOCK))]


def lists_of(system: MassSpringSystem, chunks: int = 1) -> dict[str, Any]:
    """The lists and arrays that the loops need of a system whose masses are in their order, by the loops' names.

    Args:
        chunks: as in `runs.blocks_of`.
    """
    blocks = runs.blocks_of(system, chunks, NEAR)
    ends = {f"ends_{q}": end[blocks.order].astype(np.uint32) for q, end in zip("ab", system.springs.T, strict=True)}
    return {
        **ends,
        "run_place": blocks.first_place,
        "run_spring": blocks.first,
        "block_runs": np.arange(len(blocks.first)),
        "rest_length": system.rest_lengths[blocks.order],
        "stiffness": system.stiffness[blocks.order],
        "damping": system.damping[blocks.order],
        **_sums(system, blocks.place),
        **blocks.arrays(system.dimension),
    }


def _sums(system: MassSpringSystem, place: IntArray) -> dict[str, Any]:
    """Rows of masses in a block with as many springs, and what they add up, term by term."""
    first, spring, sign = springs_of_masses(system)
    n, count = len(system.masses), np.diff(first)
    begins = np.ones(n, dtype=bool)
    begins[1:] = (np.diff(count) != 0) | (np.arange(1, n) % runs.BLOCK == 0)
    row = np.flatnonzero(begins)
    # the entry of term m of the t-th mass of a row of n masses is its m n + t-th
    mass = np.repeat(np.arange(n), count)
    term, row_of = np.arange(len(spring)) - first[mass], (np.cumsum(begins) - 1)[mass]
    size = np.diff(np.append(row, n))
    entry = np.empty_like(spring)
    entry[first[row[row_of]] + term * size[row_of] + mass - row[row_of]] = np.arange(len(spring))
    return {
        "row_mass": np.append(row, n),
        "row_entry": first[np.append(row, n)],
        "entry_place": place[spring[entry]].astype(np.uint32),
        "entry_sign": sign[entry].astype(np.int8),
        "block_rows": np.searchsorted(row, np.append(np.arange(0, n, runs.BLOCK), n)),
    }
