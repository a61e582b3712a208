"""The tables [[pulls]] of scene files: which mass is pulled, and with which force."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from reference.errors import InputError
from reference.state import Array
from reference.system import MassSpringSystem


class PullTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[pulls]]."""

    mass: int
    force: float | list[float]


def pulls_of(system: MassSpringSystem, tables: Sequence[PullTable]) -> Array:
    """The forces on all masses [N]: the scene's own, and those of the tables besides.

    Raises:
        InputError: for a mass that there is none of, or another number of numbers.
    """
    n, d = system.positions.shape
    pulls = system.pulls.copy()
    for k, table in enumerate(tables):
        force = np.atleast_1d(np.asarray(table.force, dtype=float))
        if not 0 <= table.mass < n:
            raise InputError(f"pulls[{k}].mass = {table.mass}: expected a mass from 0 to {n - 1}")
        if len(force) != d:
            raise InputError(f"pulls[{k}].force has {len(force)} numbers: expected {d}, one for each axis [N]")
        pulls[table.mass] += force
    return pulls
