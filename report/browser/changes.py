"""What changes on the way, as the page reads it: a few changes by their times, and tables of what is driven.

A truck that crosses and ground that shakes change a parameter at every step: that is a table, a row for each step. It
is made with the scene's own dt, so that at this dt the page's steps are the reference's to the bit. A row is what a
parameter is through a step, as in its middle; at another dt the page goes in straight lines between these middles.
"""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from reference.changes import Change
from reference.errors import Unsupported
from reference.scenes import Setup
from reference.system import BREAK, HELD

#: What can change on the fly there.
CHANGES = ("mass", "rest_length", "stiffness", "damping", "drag", "gravity", *HELD, BREAK)

#: A parameter that changes more often than that has a table.
MOST_CHANGES = 50

#: The most numbers of a table.
MOST_NUMBERS = 200_000


def often(changes: Sequence[Change]) -> frozenset[str]:
    """The parameters that change all the time."""
    counted = Counter(change.parameter for change in changes)
    return frozenset(name for name, count in counted.items() if count > MOST_CHANGES)


def changes_data(changes: Sequence[Change]) -> list[Mapping[str, Any]]:
    """Changes but for those of what is driven. Raises Unsupported where something changes as the page does not know."""
    driven = often(changes)
    few = [change for change in changes if change.parameter not in driven]
    for change in few:
        _refuse_unknown(change.parameter)
    return [{"time": change.time, "parameter": change.parameter, "value": _plain(change.value)} for change in few]


def drives_data(setup: Setup) -> list[dict[str, Any]]:
    """A table of each parameter that changes all the time: which of its numbers do, and what they are step by step.

    Raises:
        Unsupported: with the reason, for what the page does not know, and where a table would be too large.
    """
    return [_table(setup, parameter) for parameter in sorted(often(setup.changes))]


def _table(setup: Setup, parameter: str) -> dict[str, Any]:
    _refuse_unknown(parameter)
    own = tuple(change for change in setup.changes if change.parameter == parameter)
    systems = replace(setup, changes=own).systems_at(range(1, setup.steps + 1))
    rows = np.array([system.numbers_of(parameter) for system in systems])
    columns = np.flatnonzero((rows != setup.system.numbers_of(parameter)).any(axis=0))
    table = rows[:, columns]
    if table.size > MOST_NUMBERS:
        raise Unsupported(
            f"{parameter} changes at {len(table):,} steps, {len(columns)} numbers each: the page takes at most "
            f"{MOST_NUMBERS:,} in all; expected a shorter duration or a longer dt"
        )
    return {
        "parameter": parameter,
        "dt": setup.dt,
        "ground": parameter == "gravity" and setup.ground_moves,
        "columns": columns.tolist(),
        "rows": base64.b64encode(table.astype("<f8").tobytes()).decode(),
    }


def _refuse_unknown(parameter: str) -> None:
    if parameter not in CHANGES:
        raise Unsupported(f"changes of {parameter}: the page does not know them; `springlab live` does")


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, Sequence) else float(value)
