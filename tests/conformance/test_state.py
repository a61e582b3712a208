"""What an engine says of its state is the system's at the start, and belongs to whoever asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engines.capability_cases import for_each_capability
from engines.engine import Engine, demands, precision
from tests.conformance.checks import check_state, looks

#: Cases that are looked at in another place, too, and that [m].
MOVED = ("2d", "3d", "masses", "velocities", "mesh")
PLACE = np.array([0.3, -0.7, 0.2])


def test_the_state_at_the_start_is_the_systems_and_every_state_is_arrays_of_its_own(engine: Engine) -> None:
    """To 1e-14 of its largest number, or 1e-7; overwriting one state that was handed out, or a step, changes no other.

    On every system that the engine's capabilities allow: in motion, stretched, in three dimensions, a mesh, free; and
    on some whose fixed mass is not at the origin.
    """
    asked = for_each_capability()
    apart = [replace(s, positions=s.positions + PLACE[: s.dimension]) for s in map(asked.get, MOVED) if s is not None]
    systems = [s for s in [*asked.values(), *apart] if engine.capabilities.issuperset(demands(s))]
    assert systems
    for system, seen in zip(systems, looks(engine, systems), strict=True):
        check_state(system, seen, 1e-14 if precision(engine) == "double" else 1e-7)
