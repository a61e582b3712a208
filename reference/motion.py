"""What a scheme knows of the system it advances: its equations of motion x'' = a(x, v), and nothing else."""

from __future__ import annotations

from typing import Protocol

from reference.state import Array, Slope, State, Trajectory


class Motion(Protocol):
    """Equations of motion: those of a mesh of springs (`forces.SpringMotion`) or of a pendulum (`pendulum`)."""

    @property
    def start(self) -> State:
        """The state at time zero."""

    def acceleration(self, state: State) -> Array:
        """X'' at a state, the shape of its positions."""

    def slope(self, state: State) -> Slope:
        """(1, x', x''): the rate of change of the whole state."""

    def trajectory(self, states: list[State]) -> Trajectory:
        """The states of a run, told as positions and velocities of the masses."""
