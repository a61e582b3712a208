"""The tables [system] and [mesh] of scene files: a system written out, or its masses and springs from a mesh file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from reference.checked_numbers import refuse_twice
from reference.collisions.round_masses import Collisions
from reference.errors import InputError
from reference.files.mesh_file import read_mesh
from reference.springs.bending import with_bending
from reference.springs.kinds import KINDS, ONE_SIDED, NonlinearSprings
from reference.system import MassSpringSystem

Numbers = float | list[float]

#: What tables say besides the plain fields of a system.
BESIDES = (*KINDS, "radii", "restitution", "angular_stiffness")

#: What is a number for all masses, or for all springs, or a list with one for each.
OF_EACH = {"masses", "radii", "stiffness", "rest_lengths", "damping"}
OF_EACH |= {"hardening", "largest_force", "breaking_force", "breaking_stretch"}

#: One for each mass: its numbers along the axes, or along a line its number.
Vectors = list[float | list[float]]


class SpringsTable(msgspec.Struct, forbid_unknown_fields=True):
    """What the tables [system] and [mesh] may say besides: of springs that are not linear, of masses that collide."""

    tension_only: bool | list[int] = False
    compression_only: bool | list[int] = False
    hardening: Numbers = 0.0
    largest_force: Numbers = float("inf")
    breaking_force: Numbers = float("inf")
    breaking_stretch: Numbers = float("inf")
    radii: Numbers = 0.0
    restitution: float = 0.0
    angular_stiffness: Numbers = 0.0

    def nonlinear(self, count: int) -> NonlinearSprings:
        """The same of so many springs. Raises InputError for the number of a spring that there is none of."""
        given: dict[str, Any] = {name: getattr(self, name) for name in KINDS}
        for name in ONE_SIDED:
            named = given[name]
            for place, j in enumerate(named if isinstance(named, list) else []):
                if not 0 <= j < count:
                    raise InputError(f"{name}[{place}] = {j}: expected a spring from 0 to {count - 1}")
            refuse_twice(name, named if isinstance(named, list) else [])
            given[name] = np.isin(np.arange(count), named) if isinstance(named, list) else np.array(named)
        return NonlinearSprings(**given)


class SystemTable(SpringsTable, kw_only=True):
    """The table [system]."""

    positions: Vectors
    springs: list[list[int]]
    masses: Numbers
    stiffness: Numbers
    rest_lengths: Numbers | None = None
    damping: Numbers = 0.0
    drag: float = 0.0
    gravity: Numbers = 9.81
    velocities: Vectors | None = None
    fixed: list[int] = []

    def system(self, folder: Path | None = None, remarks: list[str] | None = None) -> MassSpringSystem:
        """The system it describes, all of it here. Raises InputError as MassSpringSystem does."""
        n = len(self.positions)
        for place, i in enumerate(self.fixed if n else []):  # of none it is positions that are told
            if not 0 <= i < n:
                raise InputError(f"fixed[{place}] = {i}: expected a mass from 0 to {n - 1}")
        self._refuse_lists_of_one(n)
        values: dict[str, Any] = {name: getattr(self, name) for name in self.__struct_fields__ if name not in BESIDES}
        values["collisions"] = Collisions(np.asarray(self.radii, dtype=float), self.restitution)
        values["nonlinear"] = self.nonlinear(len(self.springs))
        values["fixed"] = np.isin(np.arange(n), self.fixed)
        values["positions"] = _rows("positions", self.positions)
        values["velocities"] = 0.0 if self.velocities is None else _rows("velocities", self.velocities)
        if self.rest_lengths is None:
            values["rest_lengths"] = 1.0
            unstretched = MassSpringSystem(**values)
            a, b = unstretched.springs.T
            with np.errstate(over="ignore"):
                values["rest_lengths"] = np.linalg.norm(unstretched.positions[b] - unstretched.positions[a], axis=1)
        return with_bending(MassSpringSystem(**values), self.angular_stiffness)

    def _refuse_lists_of_one(self, masses: int) -> None:
        """A list has a number for each: of one number for several, others are missing. Raises InputError."""
        counts = {"masses": (masses, "masses"), "radii": (masses, "masses")}
        for name in self.__struct_fields__:
            count, what = counts.get(name, (len(self.springs), "springs"))
            value = getattr(self, name)
            if name in OF_EACH and isinstance(value, list) and len(value) == 1 != count:
                raise InputError(f"{name} = {value}: expected a number for all, or one for each of {count} {what}")


class MeshTable(SpringsTable, kw_only=True):
    """The table [mesh]."""

    file: str
    stiffness: float
    masses: Numbers | None = None
    total_mass: float | None = None
    scale: float = 1.0
    diagonals: bool = False
    damping: float = 0.0
    drag: float = 0.0
    gravity: Numbers = 9.81
    fixed: list[int] = []

    def system(self, folder: Path, remarks: list[str]) -> MassSpringSystem:
        """The system it describes, its file looked for from a folder. Raises InputError, as `read_mesh` too.

        Args:
            remarks: how many springs come of which elements is added to these.
        """
        for name in ("scale", "total_mass"):
            value = getattr(self, name)
            if value is not None and not 0 < value < np.inf:
                raise InputError(f"mesh.{name} = {value:g}: expected a number > 0 [{'m' if name == 'scale' else 'kg'}]")
        if (self.masses is None) == (self.total_mass is None):
            raise InputError("mesh: expected either masses or total_mass")
        mesh = read_mesh(folder / self.file, self.diagonals)
        remarks.append(f"mesh file {self.file}: {mesh.told}")
        names = ("stiffness", "damping", "drag", "gravity", "fixed", *BESIDES)
        shared: dict[str, Any] = {name: getattr(self, name) for name in names}
        with np.errstate(over="ignore"):
            positions = self.scale * mesh.positions
        return SystemTable(
            positions=positions.tolist(),
            springs=mesh.edges.tolist(),
            masses=(self.total_mass or 0.0) / len(mesh.positions) if self.masses is None else self.masses,
            **shared,
        ).system()


def _rows(name: str, vectors: Vectors) -> list[list[float]]:
    """Each mass's numbers as a list. Raises InputError where one has more or fewer than the first."""
    rows = [vector if isinstance(vector, list) else [vector] for vector in vectors]
    for i, row in enumerate(rows):
        if len(row) != len(rows[0]):
            raise InputError(f"{name}[{i}] = {row}: expected {len(rows[0])} numbers, as {name}[0] has")
    return rows
