"""How far two answers are apart: 0 where they are the same, infinite where they cannot be compared.

An answer has a list of arrays, its parts, for every step. A difference counts as a fraction of the part's scale: the
largest number that is right in any step.

>>> right = [[np.array([1.0, -2.0])], [np.array([1.5, -4.0])]]  # two steps of one part
>>> scales = scales_of(right)
>>> scales
[4.0]
>>> given = [[np.array([1.0, -2.0])], [np.array([1.5, -3.0])]]
>>> answer_distance(given, right, scales)  # 1 of 4
0.25
>>> answer_distance(given[:1], right, scales)  # a step is missing
inf

A motion that blows up soon has numbers, and rounding errors, far beyond the scale. There a difference counts as a
fraction of the step's own largest number, and the steps after that are not compared.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from experiments.exercises.exercise import Answer
from reference.state import Array

#: A step is compared if its largest number is at most this many times the scale.
LARGEST = 100.0


def scales_of(right: Answer) -> list[float]:
    """The largest right number of each part; 1 where there are only zeros, or words."""
    return [float(_largest(part).max(initial=0.0)) or 1.0 for part in _by_part(right)]


def answer_distance(given: Answer, expected: Answer, scales: Sequence[float]) -> float:
    """The largest difference between the answers to one question.

    Args:
        expected: the answer that may blow up.
        scales: of each part.
    """
    if len(given) != len(expected):
        return np.inf
    parts = _by_part(expected)
    steps = _steps_before_blow_up(parts, scales)
    far = 0.0
    for p, (part, scale) in enumerate(zip(parts, scales, strict=True)):
        arrays = [step[p] for step in given[:steps]]
        if any(array.shape != part.shape[1:] for array in arrays):
            return np.inf
        far = max(far, _distance(np.array(arrays), part[:steps], scale))
    return far


def part_distance(given: Array, expected: Array, scale: float) -> float:
    """The largest difference between two arrays; infinite where their shapes or kinds differ."""
    if given.shape != expected.shape:
        return np.inf
    return _distance(given[None], expected[None], scale)


def _by_part(answer: Answer) -> list[Array]:
    """Of each part one array, its first axis the steps."""
    return [np.array(steps) for steps in zip(*answer, strict=True)]


def _steps_before_blow_up(parts: Sequence[Array], scales: Sequence[float]) -> int:
    """How many steps are compared: the first, and all up to one with a number beyond LARGEST times its scale."""
    if all(len(part) == 1 for part in parts):
        return 1
    too_large = np.any([_largest(part) > LARGEST * scale for part, scale in zip(parts, scales, strict=True)], axis=0)
    later = np.flatnonzero(too_large[1:])
    return int(later[0]) + 1 if len(later) else len(too_large)


def _distance(given: Array, expected: Array, scale: float) -> float:
    """The largest difference between arrays of the same shape, whose first axis is the steps."""
    if given.dtype.kind == "U" or expected.dtype.kind == "U":
        same = given.dtype.kind == expected.dtype.kind and bool((given == expected).all())
        return 0.0 if same else np.inf
    one, other = (array.reshape(len(array), -1).astype(float) for array in (given, expected))
    with np.errstate(all="ignore"):
        # where neither is a finite number there is nothing to compare
        differences = np.where(np.isfinite(one) | np.isfinite(other), np.abs(one - other), 0.0).max(axis=1, initial=0.0)
    sizes = np.maximum(scale, np.minimum(_largest(expected), LARGEST * scale))
    far = float((differences / sizes).max(initial=0.0))
    return far if np.isfinite(far) else np.inf


def _largest(steps: Array) -> Array:
    """The largest number of each step by size; infinite where one is not finite, 0 for words."""
    if steps.dtype.kind == "U":
        return np.zeros(len(steps))
    largest = np.abs(steps.reshape(len(steps), -1).astype(float)).max(axis=1, initial=0.0)
    return np.where(np.isfinite(largest), largest, np.inf)
