"""The tables [[angular_springs]] of scene files: three masses, how stiff their angle is, and at which it rests."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from reference.errors import InputError
from reference.springs.angular import AngularSprings
from reference.system import MassSpringSystem


class AngularTable(msgspec.Struct, forbid_unknown_fields=True):
    """One of the tables [[angular_springs]]."""

    masses: tuple[int, int, int]
    stiffness: float
    rest_angle: float | None = None


def angular_springs_of(system: MassSpringSystem, tables: Sequence[AngularTable]) -> AngularSprings:
    """The scene's own angular springs, and those of the tables besides; the system checks them.

    Raises:
        InputError: for a rest angle that is not a number, which the system takes for the angle at the start.
    """
    for j, table in enumerate(tables):
        if table.rest_angle is not None and np.isnan(table.rest_angle):
            raise InputError(f"angular_springs[{j}].rest_angle = nan: expected a finite number [rad]")
    own = system.angular_springs or AngularSprings()
    count = len(own.masses)
    rest_angles = [np.nan if table.rest_angle is None else table.rest_angle for table in tables]
    return AngularSprings(
        np.concatenate([own.masses, np.array([table.masses for table in tables], dtype=np.int64)]),
        np.concatenate([own.stiffness[:count], [table.stiffness for table in tables]]),
        np.concatenate([own.rest_angles[:count], rest_angles]),
    )
