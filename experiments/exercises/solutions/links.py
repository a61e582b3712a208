"""The forces on a string whose masses hang one below the other, right ones and, with other parameters, wrong ones.

The physics is that of slides 4-5 and 9-10, in one dimension or two: mass i hangs by spring i below mass i - 1, the
first below the anchor. Written for small strings, in NumPy; the tests hold it against `reference.forces`.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from reference.state import Array, Slope, State


def forces(
    x: Array,
    v: Array,
    string: Any,
    *,
    elastic: float = 1.0,
    gravity: float = 1.0,
    weight: str = "m g",
    drag: float = 1.0,
    friction: str = "c v",
    rest: float = 1.0,
    length: str = "root",
    direction: str = "unit",
    slack: bool = False,
    anchor: str = "own",
    last: str = "free",
    sides: str = "both",
    below: str = "own",
    skipped: int | None = None,
    divided: bool = False,
) -> Array:
    """The force on every mass [N], shape (n, d): its springs, its weight, its drag.

    Args:
        x: positions [m], shape (n, d). v: velocities [m/s].
        string: masses [kg], stiffness [N/m], rest_lengths [m], each (n,); drag [N s/m], gravity [m/s^2], anchor (d,).
    """
    upper = np.vstack([string.anchor if anchor != "origin" else np.zeros_like(string.anchor), x[:-1]])
    if anchor.startswith("second"):
        upper[1:2] = string.anchor
    k, rest_lengths = string.stiffness, rest * string.rest_lengths

    def force_of(low: Array, high: Array, k: Array, rest_lengths: Array) -> Array:
        return elastic * _spring_force(low, high, k, rest_lengths, length, direction, slack)

    above = force_of(x, upper, k, rest_lengths)
    # the spring below mass i is the spring above mass i + 1, or what a mistake takes it for
    under = {
        "own": lambda: above[1:],
        "above": lambda: force_of(x[1:], x[:-1], k[:-1], rest_lengths[:-1]),
        "stiffness of above": lambda: force_of(x[1:], x[:-1], k[:-1], rest_lengths[1:]),
        "rest length of above": lambda: force_of(x[1:], x[:-1], k[1:], rest_lengths[:-1]),
        "own side": lambda: -force_of(x[:-1], x[1:], k[1:], rest_lengths[1:]),
    }[below]()
    if anchor == "second, from above":
        under = force_of(x[1:], x[:-1], k[1:], rest_lengths[1:])
    if anchor == "missing":
        above[0] = 0.0
    total = above.copy() if sides != "below" else np.zeros_like(above)
    if sides != "above":
        total[:-1] += under if sides == "same" else -under
    if last in ("wraps", "ring") and len(x) > 1:
        (closing,) = force_of(x[-1:], x[:1], k[:1], rest_lengths[:1])
        total[-1] += closing
        total[0] -= closing * (last == "ring")
    if last == "rolls":
        total[-1] -= above[0]
    total = total - gravity * _weights(string, weight, x.shape) - drag * _friction(string, v, friction)
    if skipped is not None:
        total[skipped] = 0.0
    return np.asarray(total / string.masses[:, None] if divided else total)


def _weights(string: Any, weight: str, shape: tuple[int, ...]) -> Array:
    """Downwards, shape (n, d)."""
    one, axes = np.ones_like(string.masses), np.arange(shape[1])
    mass = {"g": one, "none": np.zeros_like(one)}.get(weight, string.masses)
    gravity = 9.81 if weight == "m 9.81" else string.gravity
    along = {"both axes": axes >= 0, "along x": axes == 0}.get(weight, axes == shape[1] - 1)
    return np.asarray(np.outer(mass * gravity, along))


def _friction(string: Any, v: Array, friction: str) -> Array:
    """Along the velocity, shape (n, d)."""
    m, speed = string.masses[:, None], np.linalg.norm(v, axis=1)[:, None]
    return np.asarray(string.drag * {"c v": v, "m c v": m * v, "c v^2": speed * v, "c |v|": np.abs(v)}[friction])


def _spring_force(
    x: Array, upper: Array, k: Array, rest_lengths: Array, length: str, direction: str, slack: bool
) -> Array:
    """The force of each spring on its lower mass, shape (n, d)."""
    separation = upper - x
    square = (separation**2).sum(axis=1)
    # in one dimension the length may come out negative: that of a mass above its anchor
    lengths = {
        "root": np.sqrt(square),
        "square": square,
        "sum": np.abs(separation).sum(axis=1),
        "signed": separation[:, 0],
        "y": -separation[:, 0],
    }[length]
    force = k * (np.maximum(lengths - rest_lengths, 0.0) if slack else lengths - rest_lengths)
    if length in ("signed", "y") and direction == "unit":
        return np.asarray(force[:, None])
    if direction == "sloppy":
        return np.asarray(force[:, None] * separation)
    if direction == "rest length":
        return np.asarray(force[:, None] * separation / rest_lengths[:, None])
    if direction == "each axis":
        elongation = np.abs(separation) - rest_lengths[:, None]
        elongation = np.maximum(elongation, 0.0) if slack else elongation
        return np.asarray(k[:, None] * elongation * np.sign(separation))
    if direction == "degrees":
        angle = np.degrees(np.arctan2(separation[:, 1], separation[:, 0]))
        return np.asarray(force[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    unit = separation / lengths[:, None]
    if direction == "swapped":
        unit = unit[:, ::-1]
    return np.asarray(force[:, None] * unit)


class LinkMotion:
    """The equations of motion of links, for the schemes of `reference.schemes`, with all parameters of `forces`."""

    def __init__(self, string: Any, inertia: str = "divided", **parameters: Any) -> None:
        self._string, self._inertia, self._parameters = string, inertia, parameters

    def acceleration(self, state: State) -> Array:
        """Of all masses [m/s^2]."""
        total = forces(state.positions, state.velocities, self._string, **self._parameters)
        power = {"divided": -1, "forgotten": 0, "multiplied": 1}[self._inertia]
        return np.asarray(total * self._string.masses[:, None] ** power)

    def acceleration_of(self, i: int, state: State) -> Array:
        """Of one."""
        return np.asarray(self.acceleration(state)[i])

    def slope(self, state: State) -> Slope:
        """Of the whole state."""
        return Slope(1.0, state.velocities, self.acceleration(state))


def random_string(random: np.random.Generator, count: int) -> tuple[Array, Array, dict[str, Any]]:
    """A string in motion: positions, velocities, and what it is made of. No two numbers of it are alike.

    Springs are some tenths longer or shorter than at rest, and everything moves, so that no term of a force vanishes.
    """
    rest_lengths = random.uniform(0.1, 0.2, count)
    string = {
        "masses": random.uniform(0.02, 0.06, count),
        "stiffness": random.uniform(40.0, 80.0, count),
        "rest_lengths": rest_lengths,
        "drag": float(random.uniform(0.02, 0.05)),
        "gravity": 9.81,
        "anchor": random.uniform(0.1, 0.3, 2),
    }
    lengths = rest_lengths * random.uniform(1.1, 1.4, count) * random.choice([1.0, 0.7], count)
    angles = random.uniform(-2.6, -0.5, count)
    steps = lengths[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return string["anchor"] + np.cumsum(steps, axis=0), random.uniform(-1.0, 1.0, (count, 2)), string


def namespace(fields: dict[str, Any]) -> SimpleNamespace:
    """A string as students see it."""
    return SimpleNamespace(**fields)
