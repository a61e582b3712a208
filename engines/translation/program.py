"""What snippets are made of: a system written out, in Python or JavaScript; and the run of one. Needs NumPy only."""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from reference.state import Array
from reference.system import MassSpringSystem


def written(system: MassSpringSystem, dt: float, steps: int, settings: Sequence[Mapping[str, float]]) -> str:
    """A system and what is typed for each of its springs, as lines of Python; three numbers to a position."""
    lines = [f"{name} = {values}" for name, values in _numbers(system, settings).items()]
    return "\n".join([f"dt, steps = {dt!r}, {steps}  # a mass of None is fixed", *lines]) + "\n"


def written_in_javascript(
    system: MassSpringSystem, dt: float, steps: int, settings: Sequence[Mapping[str, float]]
) -> str:
    """The same as lines of JavaScript."""
    lines = [f"const {name} = {json.dumps(values)};" for name, values in _numbers(system, settings).items()]
    return "\n".join([f"const dt = {dt!r}, steps = {steps}; // a mass of null is fixed", *lines]) + "\n"


def _numbers(system: MassSpringSystem, settings: Sequence[Mapping[str, float]]) -> dict[str, list[Any]]:
    """By the name of a variable. A fixed mass is None."""
    return {
        "gravity": [float(x) for x in [*system.gravity, 0.0, 0.0][:3]],
        "positions": [[float(x) for x in [*row, 0.0, 0.0][:3]] for row in system.positions],
        "masses": [None if fixed else float(m) for m, fixed in zip(system.masses, system.fixed, strict=True)],
        "springs": system.springs.tolist(),
        "rest_lengths": system.rest_lengths.tolist(),
        **{name: [float(of_spring[name]) for of_spring in settings] for name in settings[0]},
    }


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


def run_by_node(snippet: str) -> Array:
    """The same of a snippet in JavaScript, which prints them: by Node, with what npm has installed beside this Python.

    Raises:
        RuntimeError: with the end of what it said, where it failed.
    """
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "node_modules").symlink_to(Path(sys.prefix) / "node_modules")
        file = Path(folder) / "snippet.mjs"
        file.write_text(snippet, encoding="utf-8")
        done = subprocess.run(["node", file], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr.strip()[-200:])
    return np.array(json.loads(done.stdout), dtype=float)
