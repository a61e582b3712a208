"""What both versions of Box2D ask of springs: a frequency and a damping ratio, and a length that is not too short."""

from __future__ import annotations

import numpy as np

from engines.engine import LINEAR_SPRINGS, Engine, refuse_beyond
from reference.errors import Unsupported
from reference.system import IntArray, MassSpringSystem

#: Box2D's "linear slop" [m]: what is shorter has no direction (2.3), or is made as long as that (3).
SHORTEST = 0.005

#: All but the third dimension, obstacles, and springs that are not linear.
ABLE = LINEAR_SPRINGS - {"3d"}


def check(engine: Engine, system: MassSpringSystem) -> None:
    """Raise Unsupported for what Box2D would take for something else."""
    refuse_beyond(engine, system)
    if (system.rest_lengths < SHORTEST).any():
        raise Unsupported(f"{engine.name} has no springs shorter than {SHORTEST} m")
    if (system.stiffness[moving(system)] <= 0).any():
        raise Unsupported(f"{engine.name} takes a spring without stiffness for a rigid rod")


def moving(system: MassSpringSystem) -> IntArray:
    """The springs that move anything: those between two fixed masses are left out."""
    return np.flatnonzero(~system.fixed[system.springs].all(axis=1))
