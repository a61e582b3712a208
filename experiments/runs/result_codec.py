"""What a task answered, as JSON and arrays, and back: how the store keeps it.

An answer is made of numbers, words, None, arrays of numbers, outcomes, limits, lists of such, and mappings of such by
names.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from reference.limit import Limit
from reference.outcome import Outcome
from reference.state import Array, Trajectory

#: In place of an array, an outcome, a limit, or a number that JSON does not know, stands a mapping with one of these
#: alone. No mapping of an answer's own is taken for one: its keys are names, as those of variables are.
ARRAY, OUTCOME, LIMIT, NUMBER = "<array>", "<outcome>", "<limit>", "<number>"


def encode(answer: Any) -> tuple[Any, dict[str, Array]]:
    """An answer as what JSON can hold, and its arrays by name.

    Raises:
        TypeError: for an answer made of anything else.
    """
    arrays: dict[str, Array] = {}
    return _encode(answer, "answer", arrays), arrays


def _encode(value: Any, name: str, arrays: dict[str, Array]) -> Any:
    if value is None or isinstance(value, str | bool | int):
        return value
    if isinstance(value, np.bool_ | np.integer | np.float16 | np.float32 | np.float64):
        return _encode(value.item(), name, arrays)
    if isinstance(value, float):
        return value if math.isfinite(value) else {NUMBER: repr(value)}
    if isinstance(value, np.ndarray) and value.dtype.kind in "biufc":
        arrays[name] = value
        return {ARRAY: name}
    if isinstance(value, Outcome):
        fields = {"ending": value.ending, "reason": value.reason, "trajectory": _fields(value.trajectory)}
        return {OUTCOME: _encode(fields, name, arrays)}
    if isinstance(value, Limit):
        return {LIMIT: _encode(vars(value), name, arrays)}
    if isinstance(value, Mapping):
        return {_named(key): _encode(item, f"{name}.{key}", arrays) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_encode(item, f"{name}.{i}", arrays) for i, item in enumerate(value)]
    raise TypeError(f"an answer with a {type(value).__name__} cannot be kept")


def _named(key: Any) -> str:
    if not (isinstance(key, str) and key.isidentifier()):
        raise TypeError(f"an answer with the key {key!r} cannot be kept: expected a name")
    return key


def _fields(trajectory: Trajectory | None) -> dict[str, Array] | None:
    if trajectory is None:
        return None
    return {"times": trajectory.times, "positions": trajectory.positions, "velocities": trajectory.velocities}


def decode(document: Any, arrays: Mapping[str, Array]) -> Any:
    """The answer that was encoded; a tuple comes back as a list."""
    if isinstance(document, list):
        return [decode(item, arrays) for item in document]
    if not isinstance(document, dict):
        return document
    if ARRAY in document:
        return arrays[document[ARRAY]]
    if NUMBER in document:
        return float(document[NUMBER])
    if OUTCOME in document:
        fields = decode(document[OUTCOME], arrays)
        trajectory = fields["trajectory"]
        return Outcome(fields["ending"], fields["reason"], None if trajectory is None else Trajectory(**trajectory))
    if LIMIT in document:
        return Limit(**{name: _as_tuple(value) for name, value in decode(document[LIMIT], arrays).items()})
    return {key: decode(item, arrays) for key, item in document.items()}


def _as_tuple(value: Any) -> Any:
    """A field of a limit: JSON has its tuples as lists."""
    return tuple(map(_as_tuple, value)) if isinstance(value, list) else value


def arrays_of(document: Any) -> frozenset[str]:
    """The names of the arrays that an encoded answer refers to."""
    if isinstance(document, dict) and ARRAY in document:
        return frozenset({document[ARRAY]})
    parts = document.values() if isinstance(document, dict) else document if isinstance(document, list) else ()
    return frozenset().union(*map(arrays_of, parts))
