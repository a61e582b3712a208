"""Constant forces on single masses: how a parameter names one, `pull.MASS.AXIS`, as pull.3.y."""

from __future__ import annotations

import re

from reference.errors import InputError
from reference.state import Array

#: What the names of such parameters begin with; their unit; the axes in their order.
PULL, UNIT, AXES = "pull.", "N", "xyz"


def is_pull(parameter: str) -> bool:
    """Whether a parameter is meant to be a pull."""
    return parameter == PULL[:-1] or parameter.startswith(PULL)


def place_of_pull(parameter: str, pulls: Array) -> tuple[int, int]:
    """Which mass is pulled, and along which axis. Along a line the axis is x.

    Args:
        pulls: of the system [N], shape (n, d).

    Raises:
        InputError: for a mass or an axis that there is none of.
    """
    n, d = pulls.shape
    axes = AXES[:d]
    found = re.fullmatch(r"pull\.([0-9]{1,9})\.([xyz])", parameter)
    if found is None or int(found[1]) >= n or found[2] not in axes:
        raise InputError(
            f"parameter {parameter!r}: expected pull.MASS.AXIS with a mass from 0 to {n - 1} and an axis of "
            f"{', '.join(axes)}, as pull.{n - 1}.{axes[-1]}"
        )
    return int(found[1]), axes.index(found[2])
