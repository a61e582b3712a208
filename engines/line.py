"""Systems along a line in engines, which know the plane and space: as the same motion up and down the plane.

What is straight stays so in an engine: across the line every force is zero times a number. Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Callable

from engines.engine import Engine, Simulation, refuse_beyond
from reference.line import on_line, parameter_in_plane, system_in_plane, value_in_plane
from reference.state import Array
from reference.system import MassSpringSystem, Value


def started(engine: Engine, system: MassSpringSystem, dt: float) -> Simulation:
    """A system in an engine, ready for its first step of dt [s]: what everybody but an adapter starts engines by.

    Raises:
        Unsupported: as `Engine.start` does.
    """
    if system.dimension != 1:
        return engine.start(system, dt)
    refuse_beyond(engine, system)
    return SimulationOnLine(engine.start(system_in_plane(system), dt))


class SimulationOnLine:
    """A system along a line, inside an engine that steps it up and down the plane: a Simulation."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self.step = simulation.step

    def bare_step(self) -> Callable[[], object]:
        """The engine's own."""
        return self._simulation.bare_step()

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s] along the line, each (n, 1), as new arrays."""
        positions, velocities = self._simulation.state()
        return on_line(positions), on_line(velocities)

    def change(self, parameter: str, value: Value) -> None:
        """Set a parameter on the fly, as on the line."""
        self._simulation.change(parameter_in_plane(parameter), value_in_plane(parameter, value))
