"""What snippets are made of: a system written out as Python, and the run of a snippet. Needs NumPy only."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from reference.state import Array
from reference.system import MassSpringSystem


def written(system: MassSpringSystem, dt: float, steps: int, settings: Sequence[Mapping[str, float]]) -> str:
    """A system and what is typed for each of its springs, as lines of Python; three numbers to a position."""
    positions = [[float(x) for x in [*row, 0.0, 0.0][:3]] for row in system.positions]
    lines = [
        f"dt, steps = {dt!r}, {steps}",
        f"gravity = {[float(x) for x in [*system.gravity, 0.0, 0.0][:3]]}",
        f"positions = {positions}",
        f"masses = {[None if fixed else float(m) for m, fixed in zip(system.masses, system.fixed, strict=True)]}"
        "  # None: fixed",
        f"springs = {system.springs.tolist()}",
        f"rest_lengths = {system.rest_lengths.tolist()}",
    ]
    lines += [f"{name} = {[float(of_spring[name]) for of_spring in settings]}" for name in settings[0]]
    return "\n".join(lines) + "\n"


#: The end of every snippet: how much longer than at rest the first spring is.
ELONGATION = """

def elongation(place):
    (a, b), rest = springs[0], rest_lengths[0]
    return sum((p - q) ** 2 for p, q in zip(place(b), place(a))) ** 0.5 - rest
"""


def run(snippet: str) -> Array:
    """The elongations [m] that a snippet leaves, shape (steps + 1,): run in the process that this is called in."""
    names: dict[str, Any] = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(snippet, "snippet", "exec"), names)
    return np.array(names["elongations"], dtype=float)
