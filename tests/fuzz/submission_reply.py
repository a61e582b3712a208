"""What a submission's process leaves: right answers in the right form, damaged as bytes or as what they say.

Whatever it is, the checker reads it and comes to a verdict: it is taken as an answer, or refused as a whole.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np

from experiments.exercises.exercise import exercises, find
from experiments.exercises.process import child
from experiments.exercises.process.reply import read
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.findings import clean
from experiments.exercises.verdict.judge import verdict_on

if TYPE_CHECKING:
    from tests.fuzz.doors import Enter

#: Things that nobody means.
ODD: tuple[Any, ...] = (
    None,
    True,
    0,
    -1,
    2**70,
    1e308,
    float("nan"),
    "",
    "\ud800",
    "x" * 5_000,
    [],
    [[]],
    {},
    {"values": []},
    {"fields": 1},
    {"dtype": "<f8", "shape": [10**12]},
)

#: What the sandbox says of itself; no submission can write there.
MARK = child.READY + child.pack({"layers": ["limits"], "missing": []})

#: Kinds of arrays, some of which cannot be handed over.
KINDS = ("<f8", ">f8", "<f4", "<i8", "|b1", "<U3", "<c16")


def make(random: Random) -> tuple[str, bytes]:
    """An exercise, and a reply to its questions."""
    name = random.choice([e.name for e in exercises().values()])
    catalogue = catalogue_of(find(name), "example\0" if find(name).keyed else "example", None)
    answers = [
        {
            "values": [list(step) for step in right],
            "overwritten": False,
            "again": list(right[0]),
        }
        for right in catalogue.right
    ]
    names = [question.function for question in catalogue.questions]
    reply: Any = {"names": names, "answers": answers}
    for _ in range(random.choice((0, 1, 1, 2, 4))):
        reply = _changed(random, reply)
    try:
        data = child.pack(reply)
    except (ValueError, TypeError, RecursionError):  # what the child itself could not hand over
        data = struct.pack("<Q", 2) + b"[]"
    return name, _damaged(random, data) if random.random() < 0.3 else data


def _changed(random: Random, value: Any) -> Any:
    """The same, one thing in it another."""
    if isinstance(value, dict) and value and random.random() < 0.9:
        key = random.choice([*value])
        how = random.random()
        if how < 0.1:
            return {name: part for name, part in value.items() if name != key}
        if how < 0.2:
            return {**value, random.choice(("score", "error", "again", "modified", "walls")): _odd(random)}
        return {**value, key: _changed(random, value[key])}
    if isinstance(value, list) and value and random.random() < 0.9:
        i = random.randrange(len(value))
        how = random.random()
        if how < 0.1:
            return value[:i] + value[i + 1 :]
        if how < 0.2:
            return [*value, value[i]]
        return [*value[:i], _changed(random, value[i]), *value[i + 1 :]]
    return _array(random, value) if isinstance(value, np.ndarray) and random.random() < 0.7 else _odd(random)


def _array(random: Random, array: Any) -> Any:
    """Another array: numbers that are none, another kind, another shape."""
    if array.dtype.kind == "U":
        return np.array(array.ravel()[:1], dtype="<U5")
    changed = np.array(array.real, dtype=float)
    how = random.randrange(4)
    if how == 0 and changed.size:
        changed.flat[random.randrange(changed.size)] = random.choice((np.nan, np.inf, 0.0, 1e300, -1e-300))
        return changed
    if how == 1:
        with np.errstate(all="ignore"):
            return np.nan_to_num(changed).astype(random.choice(KINDS))
    if how == 2:
        return changed.reshape(-1)[: random.randrange(changed.size + 1)]
    return changed[None] if random.random() < 0.5 else np.zeros(random.choice(((), (0,), (1, 1, 1), (2, 0))))


def _odd(random: Random) -> Any:
    """Of ODD, or an array."""
    return random.choice(ODD) if random.random() < 0.8 else np.zeros((2, 2), random.choice(KINDS))


def _damaged(random: Random, data: bytes) -> bytes:
    """Bytes cut off, turned, or put in."""
    i = random.randrange(len(data))
    how = random.randrange(4)
    if how == 0:
        return data[:i]
    if how == 1:
        return data[:i] + bytes([random.randrange(256)]) + data[i + 1 :]
    if how == 2:
        return data[:i] + random.randbytes(random.randrange(20)) + data[i:]
    return random.choice((child.READY, child.CLOSED)) + data


@contextmanager
def opened(folder: Path) -> Iterator[Enter]:
    """The checker, as it reads replies."""
    yield enter


def enter(made: tuple[str, bytes]) -> str:
    """The verdict on a reply: right answers alone are right."""
    name, data = made
    exercise = find(name)
    catalogue = catalogue_of(exercise, "example\0" if exercise.keyed else "example", None)
    reply = read(MARK, data, len(catalogue.questions))
    verdict = verdict_on(catalogue, reply)
    told = " ".join(f"{finding.name} {finding.words} {finding.hint}" for finding in verdict.findings)
    told.encode("utf-8")
    if verdict.right and not all(verdict.passed):
        return "right, and not all questions passed"
    if clean(told[:100]) != told[:100].replace("\n", " ") and "\x1b" in told:
        return "a control character is told"
    return "taken" if reply.ended == "done" else "refused"
