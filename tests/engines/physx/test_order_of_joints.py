"""In which order PhysX goes through joints of meshes in space: by single steps from its own states."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.process.available import available_version, how_to_install
from engines.process.isolation import EngineStepper
from reference.scenes import find as find_scene
from reference.stepper import stepper_named

#: Meshes whose order matters, over ten steps of a sixtieth of a second.
MESHES = {
    "cloth": find_scene("cloth").system({"rows": 4, "columns": 5, "pinned": "edge", "shear": 10.0, "bend": 2.0}),
    "jello": find_scene("jello").system({"across": 3, "high": 3, "deep": 3}),
}
DT, STEPS = 1 / 60, 10

#: Of each solver, what the claimed scheme is in other orders.
OTHERS = {
    "physx_joints": "soft_constraints_cold(drag_first=True, order={}, substeps=1, sweeps=10)",
    "physx_joints_tgs": "temporal_gauss_seidel(damping_as_stiffness=True, order={})",
}


def off(scheme: str, solver: str, mesh: str) -> float:
    """How far the scheme is from the engine after a step from each state that this came to, at most [m]."""
    system = MESHES[mesh]
    run = EngineStepper(find_engine(solver)).run(system, DT, STEPS).trajectory
    assert run is not None
    known = stepper_named(scheme)
    apart = []
    for k in range(STEPS):
        begun = replace(system, positions=run.positions[k], velocities=run.velocities[k])
        made = known.run(begun, DT, 1).trajectory
        assert made is not None
        apart.append(np.abs(made.positions[1] - run.positions[k + 1]).max())
    return float(max(apart))


@pytest.mark.parametrize("solver", OTHERS)
@pytest.mark.parametrize("mesh", MESHES)
def test_joints_are_gone_through_from_the_newest_on(solver: str, mesh: str) -> None:
    """To rounding of single precision, 6e-8 of a metre; in other orders, and as they were made, 1e-4 m and more."""
    if available_version("sapien") is None:
        pytest.skip(how_to_install("sapien"))
    claim = find_engine(solver).identified_as["plain"]
    assert off(claim, solver, mesh) < 2e-7
    for order in ("fixed_last", "colours", "made"):
        assert off(OTHERS[solver].format(order), solver, mesh) > 5e-5
