"""What an engine either steps as its scheme or refuses, in groups: scenes, cloths, capabilities, changes on the fly."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from engines.capability_cases import for_each_capability
from reference.changes import Change
from reference.scenes import find
from tests.conformance.case import Case

#: The step of all of them [s].
DT = 1e-3

#: The scenes, small: springs between fixed masses, crossing springs and members of all lengths are in them all. The
#: truss of equal members, on equal joints, asks the least of an engine.
_SMALL: Mapping[str, tuple[str, dict[str, Any]]] = {
    "oscillator": ("oscillator", {"damping": 0.1, "velocity": 1.0}),
    "cloth": ("cloth", {"rows": 4, "columns": 5, "pinned": "edge"}),
    "uneven cloth": ("cloth", {"rows": 4, "columns": 5, "pinned": "edge", "shear": 10.0, "bend": 2.0}),
    "flag": ("flag", {"rows": 4, "columns": 4}),
    "jello": ("jello", {"across": 3, "high": 3, "deep": 3}),
    "jello of tetrahedra": ("jello", {"across": 3, "high": 3, "deep": 3, "cells": "tetrahedra", "diagonals": 60.0}),
    "equal truss": (
        "bridge",
        {"panels": 4, "truck": 0.0, "truck_position": 0.0, "height": 0.75**0.5 * 3, "joint_mass": 2e3},
    ),
    "bridge": ("bridge", {"kind": "pratt", "panels": 4, "truck_position": 4.0}),
    "soil": ("soil", {"panels": 2, "rows": 3, "margin": 1, "truck_position": 2.0}),
}

SCENES = {name: Case(name, find(scene).system(settings), DT, 200) for name, (scene, settings) in _SMALL.items()}

#: Cloths that fall on an obstacle, as large as they are shown, but of fewer masses: MuJoCo's implicit tendons take time
#: with the cube of their number.
CLOTHS = {
    name: Case(name, find(name).system({"rows": n, "columns": n, "rest_length": length}), DT, 400)
    for name, n, length in (("falling_cloth", 8, 0.077), ("tablecloth", 7, 0.09))
}

CAPABILITIES = {name: Case(name, system, DT, 200) for name, system in for_each_capability().items()}

#: By parameter, two changes: at 0.05 s and at 0.1 s.
VALUES = {
    "mass": (0.03, 0.015),
    "rest_length": (0.13, 0.12),
    "stiffness": (120.0, 300.0),
    "damping": (0.3, 0.0),
    "drag": (0.05, 0.0),
    "gravity": (1.62, 24.8),
}

#: Parameters that can be another number for each mass, spring or axis.
EACH = [name for name in VALUES if name != "drag"]


def of_each(name: str, step: int) -> tuple[float, ...]:
    """A value for each mass, spring or axis, another at every step; masses and springs all differ."""
    if name == "gravity":
        return 3.0 * np.sin(0.1 * step), -9.81 + 2.0 * np.cos(0.13 * step)
    least, most = sorted(VALUES[name])
    count = 11 if name == "mass" else 10
    return tuple(least + (most - least) * (0.5 + 0.4 * np.sin(0.05 * step + np.arange(count))))


def _two(name: str) -> Case:
    """The string with a parameter that changes twice."""
    changes = [Change(time, name, value) for time, value in zip((0.05, 0.1), VALUES[name], strict=True)]
    return Case(name, find("string").system({}), DT, 200, changes)


def _at_every_step(name: str) -> Case:
    """The string with a parameter that is another for each, and at every one of a hundred steps."""
    changes = [Change(DT * step, name, of_each(name, step)) for step in range(100)]
    return Case(f"{name} of each", find("string").system({}), DT, 100, changes)


def _driven(scene: str) -> Case:
    """The beginning of a scene that something drives."""
    setup = find(scene).setup({"panels": 4}, DT, 0.2)
    return Case(scene, setup.system, setup.dt, 200, setup.changes)


_CHANGES = [
    *(_two(name) for name in VALUES),
    Case(
        "several at once",
        find("string").system({"damping": 0.05, "drag": 0.02}),
        DT,
        200,
        [Change(0.05, "mass", 0.03), Change(0.05, "gravity", 1.62), Change(0.1, "drag", 0.05)],
    ),
    Case(
        "along a line",
        find("chain").system({"masses": 5}),
        DT,
        200,
        [Change(0.05, "gravity", 1.62), Change(0.08, "gravity", [3.0]), Change(0.1, "mass", 0.03)],
    ),
    Case(
        "springs broken",
        find("string").system({}),
        DT,
        200,
        [Change(0.05, "break", 4), Change(0.1, "break", (7, 9))],
    ),
    *(_at_every_step(name) for name in EACH),
    *(_driven(scene) for scene in ("crossing", "earthquake")),
]

CHANGES = {case.name: case for case in _CHANGES}

#: All of them, as `refusals.toml` has them.
GROUPS: Mapping[str, Mapping[str, Case]] = {
    "scenes": SCENES,
    "cloths": CLOTHS,
    "capabilities": CAPABILITIES,
    "changes": CHANGES,
}
