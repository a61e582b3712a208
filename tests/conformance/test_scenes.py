"""The lecture's meshes in every engine: each that can take one steps it as the scheme that it is known to be."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest

from engines.engine import Engine, demands
from engines.process.isolation import EngineStepper
from reference.identification import candidates, identify_run
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.system import MassSpringSystem
from tests.conformance import doctored
from tests.conformance.doctored import Doctored

DT, STEPS = 1e-3, 200

#: The scenes, small: springs between fixed masses, crossing springs and members of all lengths are in them all. The
#: truss of equal members, on equal joints, asks the least of an engine.
SCENES: dict[str, tuple[str, dict[str, Any]]] = {
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


@cache
def known(scene: str) -> tuple[MassSpringSystem, dict[str, Trajectory]]:
    """A small one of that scene, and the whole catalogue's trajectories of it."""
    name, settings = SCENES[scene]
    system = find(name).system(settings)
    return system, candidates(system, DT, STEPS)


def check_identified(engine: Engine, scene: str, outcome: Outcome) -> None:
    """To 1e-9 m and better, over 200 steps: rounding is 1e-14 m of a bridge, and rods that hold one another lose more.

    Euler's scheme, which blows up, multiplies rounding by what it multiplies the motion.
    """
    system, trajectories = known(scene)
    assert outcome.ending == "done", outcome.reason
    found = identify_run(engine.name, outcome, system, trajectories)
    case = next((what for what in ("damping", "drag") if what in demands(system)), "plain")
    assert engine.identified_as[case] in [m.scheme for m in found.matches or found.ranking[:1]]
    assert found.error < 1e-9


@pytest.mark.parametrize("scene", SCENES)
def test_scenes_are_stepped_as_by_a_known_scheme(engine: Engine, scene: str) -> None:
    """Or the engine says that it cannot, and what."""
    system, _ = known(scene)
    outcome = EngineStepper(engine).run(system, DT, STEPS)
    if outcome.ending == "unsupported":
        assert outcome.reason
        return
    check_identified(engine, scene, outcome)


@pytest.mark.parametrize("scene", SCENES)
def test_an_engine_with_slightly_stiffer_springs_is_seen(scene: str) -> None:
    """By a millionth; and the honest one passes."""
    system, _ = known(scene)
    honest, stranger = Doctored(doctored.KickDrift), Doctored(doctored.StifferByAMillionth)
    check_identified(honest, scene, EngineStepper(honest).run(system, DT, STEPS))
    with pytest.raises(AssertionError):
        check_identified(stranger, scene, EngineStepper(stranger).run(system, DT, STEPS))
