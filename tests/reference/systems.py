"""Systems that many tests of the reference share."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from reference.obstacles import Plane
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find, schemes
from reference.system import MassSpringSystem

#: For property tests: compiled kernels make the first example slow, so there is no deadline.
property_test = settings(deadline=None, max_examples=50)

#: Any random generator's seed.
seeds = st.integers(0, 2**32 - 1)

#: The catalogue's right schemes, those of engines among them, and its deliberately incorrect ones.
WHOLE_STATE = [s for s in schemes().values() if s.kind != "in_place"]
IN_PLACE = [s for s in schemes().values() if s.kind == "in_place"]

#: Schemes that stop iterating early, and yet keep momentum: each of their impulses is equal and opposite.
BY_IMPULSES = [find("kick_drift_truncated_damping"), find("drift_kick_sequential_damping")]

#: The right schemes of which momentum and the order of springs can be asked: what stops early may keep neither.
SOLVED = [s for s in WHOLE_STATE if not s.iterated or s in BY_IMPULSES]

#: The schemes that do not solve to rounding, and how far their solver goes [m/s].
SOLVED_TO = {find("kick_drift_truncated_damping"): 1e-8}


def label(value: Any) -> str:
    """What a parametrised test is called by: a scheme's, listing's or function's name."""
    return str(getattr(value, "name", getattr(value, "__name__", value)))


def with_fields(system: MassSpringSystem, **fields: Any) -> MassSpringSystem:
    """The system with some of its fields set otherwise, numbers and lists in place of arrays included."""
    return replace(system, **fields)


def moving_string(masses: int = 4, seed: int = 1, **parameters: Any) -> MassSpringSystem:
    """A string at an angle, 5 % stretched and thrown: every mode moves, along the springs and across."""
    string = find_scene("string").system({"masses": masses, "angle": 30.0, **parameters})
    velocities = 0.3 * np.random.default_rng(seed).normal(size=string.positions.shape)
    velocities[0] = 0.0
    return replace(string, positions=1.05 * string.positions, velocities=velocities)


def free_string(damping: float = 0.0) -> MassSpringSystem:
    """A moving string of six unequal masses with nothing that holds it: no fixed mass, no gravity, no drag."""
    string = moving_string(5, gravity=0.0, damping=damping)
    velocities = np.random.default_rng(2).normal(size=string.positions.shape)
    masses = np.linspace(0.01, 0.04, 6)
    return with_fields(string, fixed=False, velocities=velocities, masses=masses)


def random_mesh(seed: int, masses: int, dimension: int, anchors: int = 1) -> MassSpringSystem:
    """A connected mesh with random springs, parameters and velocities; the first `anchors` masses are fixed."""
    rng = np.random.default_rng(seed)
    # On a jittered grid, so that no two masses are near each other.
    side = 4 if dimension > 1 else masses
    cells = rng.permutation(side**dimension)[:masses]
    corners = np.stack(np.unravel_index(cells, (side,) * dimension), axis=1)
    chain = {(i, i + 1) for i in range(masses - 1)}
    others = {tuple(sorted(rng.choice(masses, 2, replace=False).tolist())) for _ in range(masses)}
    springs = sorted(chain | others, key=lambda _: rng.random())
    fixed = np.arange(masses) < anchors
    velocities = rng.normal(size=(masses, dimension))
    velocities[fixed] = 0.0
    return MassSpringSystem(
        positions=0.2 * (corners + rng.uniform(-0.2, 0.2, corners.shape)),
        springs=np.array(springs),
        masses=rng.uniform(0.01, 0.1, masses),
        rest_lengths=rng.uniform(0.1, 0.4, len(springs)),
        stiffness=rng.uniform(10.0, 300.0, len(springs)),
        damping=rng.uniform(0.0, 0.2, len(springs)),
        drag=float(rng.uniform(0.0, 0.1)),
        gravity=rng.normal(size=dimension),
        velocities=velocities,
        fixed=fixed,
    )


#: Random meshes in 1D, 2D and 3D with one fixed mass, and with none.
meshes = st.builds(random_mesh, seed=seeds, masses=st.integers(2, 8), dimension=st.sampled_from([1, 2, 3]))
free_meshes = st.builds(
    random_mesh, seed=seeds, masses=st.integers(2, 8), dimension=st.sampled_from([1, 2, 3]), anchors=st.just(0)
)


def two_on_a_floor(damping: float) -> MassSpringSystem:
    """Two unequal masses beside a fixed one, that come to rest on a floor 1 cm below; damped between the first two."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([1.0, 0.1, 0.3]),
        rest_lengths=np.array(0.5),
        stiffness=np.array([50.0, 80.0]),
        damping=np.array([damping, 0.0]),
        gravity=np.array([0.0, -9.81]),
        fixed=np.array([True, False, False]),
        obstacles=(Plane((0.0, -0.01), (0.0, 1.0)),),
    )
