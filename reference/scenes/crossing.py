"""A truck that crosses a bridge: masses of the deck's joints that change on the fly (slide 28).

The two joints beside the truck share its mass as a beam between them would. A joint takes it over, and hands it on,
with the velocity it has itself: what the truck's own motion up and down adds is left out, as is usual where it is slow
(Fryba, *Vibration of Solids and Structures under Moving Loads*, ch. 1).
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace

import numpy as np

from reference.changes import Change, whole_steps
from reference.errors import InputError
from reference.state import Array
from reference.system import IntArray, MassSpringSystem


@dataclass(frozen=True, eq=False)
class Crossing:
    """A truck goes from the first joint of a deck to the last, and is gone: a Drive.

    Attributes:
        truck: its mass [kg].
        speed: [m/s].
        places: of the deck's joints along its way [m], rising, shape (j,); it starts at the first.
        joints: their numbers in the system, shape (j,).
        part: of the shortest way from joint to joint; masses change once it has gone so far, or at the next step.
        parameter: what changes for it.

    Raises:
        InputError: for a truck below zero, or a speed that is not above.
    """

    truck: float
    speed: float
    places: Array
    joints: IntArray
    part: float = 0.01
    parameter: str = "mass"

    def __post_init__(self) -> None:
        if not 0 <= self.truck < np.inf:
            raise InputError(f"truck = {self.truck:g}: expected a finite number >= 0 [kg]")
        if not 0 < self.speed < np.inf:
            raise InputError(f"speed = {self.speed:g}: expected a finite number > 0 [m/s]")

    def position(self, times: Array) -> Array:
        """Of the truck at times [s], shape (m,) [m]."""
        return np.asarray(self.places[0] + self.speed * times)

    def loads(self, positions: Array) -> Array:
        """What each joint carries of a truck at positions [m], shape (m, j) [kg]; nothing of one that is not there."""
        shares = np.eye(len(self.places))
        carried = [np.interp(positions, self.places, share, left=0.0, right=0.0) for share in shares]
        return self.truck * np.stack(carried, axis=1)

    @np.errstate(over="ignore", divide="ignore")
    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """The masses [kg] whenever it has gone on, for where it is half-way to the next time."""
        steps = whole_steps(dt, duration)
        every = max(1, int(min(self.part * np.diff(self.places).min() / (self.speed * dt), steps)))
        begin = np.arange(0, steps, every)
        end = np.minimum(begin + every, steps)
        loads = self.loads(self.position(dt * (begin + end) / 2))
        another = (np.diff(loads, axis=0, prepend=0.0) != 0).any(axis=1)
        masses = np.tile(system.masses, (int(another.sum()), 1))
        masses[:, self.joints] += loads[another]
        times = (dt * begin[another]).tolist()
        return [Change(time, "mass", tuple(row)) for time, row in zip(times, masses.tolist(), strict=True)]


def cambered(system: MassSpringSystem) -> MassSpringSystem:
    """The same system with rest lengths at which it carries its own weight where it starts, at rest.

    Bridges are built so. The springs' tensions are those of the direct stiffness method (McGuire, Gallagher and
    Ziemian, *Matrix Structural Analysis*, ch. 3), the only ones where it is statically determinate.

    Raises:
        InputError: where no tensions can carry it; where a spring would have to have no rest length.
    """
    from scipy.sparse import coo_array, diags_array
    from scipy.sparse.linalg import MatrixRankWarning, spsolve

    a, b = system.springs.T
    separation = system.positions[b] - system.positions[a]
    length = np.linalg.norm(separation, axis=1)
    free = np.repeat(~system.fixed, system.dimension)
    axes = np.arange(system.dimension)
    rows = np.concatenate([a[:, None] * system.dimension + axes, b[:, None] * system.dimension + axes], axis=1)
    directions = np.concatenate([separation, -separation], axis=1) / length[:, None]
    springs = np.repeat(np.arange(len(length)), rows.shape[1])
    along = coo_array(
        (directions.ravel(), (rows.ravel(), springs)), shape=(system.positions.size, len(length))
    ).tocsr()[free]
    weight = (system.masses[:, None] * system.gravity).ravel()[free]
    tensions = np.zeros(len(length))
    matrix = (along @ diags_array(system.stiffness) @ along.T).tocsc()
    if matrix.diagonal().all():
        with warnings.catch_warnings():
            # of a matrix that is singular to rounding nothing comes that is in balance, which is seen below
            warnings.simplefilter("ignore", MatrixRankWarning)
            for _ in range(2):  # once more, for what the first time has rounded
                missing = -weight - along @ tensions
                tensions = tensions + system.stiffness * (along.T @ spsolve(matrix, missing))
    if not np.abs(along @ tensions + weight).max(initial=0.0) <= 1e-9 * np.abs(weight).max(initial=0.0):
        raise InputError(
            "the springs cannot carry the weight where they are: expected a structure that is rigid, with lengths and "
            "stiffnesses that do not differ by more than rounding allows"
        )
    slack = np.divide(tensions, system.stiffness, out=np.zeros_like(tensions), where=system.stiffness > 0)
    return replace(system, rest_lengths=length - slack)
