"""Angular springs: which masses they bend at, how stiff they are, and at which angle they rest.

The law that follows from it is in `angular_law`. Needs NumPy only.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.checked_numbers import in_range, shaped
from reference.checked_springs import BoolArray, IntArray
from reference.errors import InputError
from reference.springs.angles import angles_between, arms_of
from reference.state import Array

#: Nearer to a straight line than this [rad] three masses have no plane in which they could bend.
IN_LINE = 1e-9

#: So far from half a turn [rad] a rest angle in space is taken for it: as written with six digits.
AS_WRITTEN = 1e-5

#: The fields, with their units.
UNITS = {"stiffness": "N m/rad", "rest_angles": "rad"}


@dataclass(frozen=True, eq=False)
class AngularSprings:
    """What resists bending at a mass: a torque proportional to the change of the angle there. It has no damping.

    One number stands for all of them. One that bent between springs has no stiffness once such a spring is broken.

    Attributes:
        masses: three masses a, b, c each, shape (k, 3): the angle is at b, from a to c.
        stiffness: [N m/rad], shape (k,), each >= 0.
        rest_angles: [rad], shape (k,); in the plane counter-clockwise from a to c, from -2 pi to 2 pi, and in space
            from 0 to pi. Not a number where it is the angle at the start. Of masses in line in space one that is in
            line to within 1e-5 is the angle at the start, so that 3.14159 is half a turn.

    Raises:
        InputError: in `checked`, naming the field, the index, the value, and what was expected.
    """

    masses: IntArray = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    stiffness: Array = field(default_factory=lambda: np.zeros(1))
    rest_angles: Array = field(default_factory=lambda: np.full(1, np.nan))

    def checked(self, positions: Array) -> AngularSprings | None:
        """The same with one number for each, read-only, rest angles of the start filled in; None where there are none.

        Raises:
            InputError: also where two of the masses start in one place; along a line; and where three in line are to
                bend in space, in no certain plane.
        """
        masses = _checked_masses(self.masses, len(positions))
        count, dimension = len(masses), positions.shape[1]
        if count == 0:
            return None
        if dimension == 1:
            raise InputError("angular_springs: expected a scene in the plane or in space; along a line nothing bends")
        stiffness = in_range("angular_springs.stiffness", self.stiffness, (count,), UNITS["stiffness"])
        first, last = arms_of(positions, masses)
        for name, arm in (("first", first), ("last", last)):
            together = ~arm.any(axis=-1)
            if together.any():
                j = int(np.argmax(together))
                raise InputError(
                    f"angular_springs[{j}].masses = {masses[j].tolist()}: expected the {name} mass apart from the "
                    "middle one at the start"
                )
        laid_out = angles_between(first, last)
        given = shaped("angular_springs.rest_angles", np.asarray(self.rest_angles, dtype=float), (count,))
        _refuse_rest_angles(given, dimension)
        rest_angles = np.where(np.isnan(given), laid_out % (2 * np.pi), given)
        if dimension == 3:
            straight = np.minimum(laid_out, np.pi - laid_out) < IN_LINE
            bad = straight & (np.abs(rest_angles - laid_out) > AS_WRITTEN)
            in_line = "3.14159" if laid_out[np.argmax(bad)] > 1 else "0"
            expected = f"masses that are in line to rest in line ({in_line}), as there is no certain plane to bend in"
            refuse_rest_angles(rest_angles, bad, expected)
            rest_angles = np.where(straight, laid_out, np.minimum(rest_angles, np.pi))
        whole = AngularSprings(masses, np.array(stiffness), rest_angles)
        for array in vars(whole).values():
            array.flags.writeable = False
        return whole

    def renumbered(self, new_of_old: IntArray) -> AngularSprings:
        """The same with mass i as mass new_of_old[i]."""
        return AngularSprings(new_of_old[self.masses], self.stiffness, self.rest_angles)

    def without_broken_arms(self, springs: IntArray, broken: BoolArray) -> AngularSprings:
        """The same with no stiffness where an arm's masses were joined by springs, and all of these are broken.

        Args:
            springs: the two masses each joins, shape (s, 2).
            broken: which of them are gone, shape (s,).
        """
        pairs = np.sort(springs, axis=1).tolist()
        parted = {tuple(pair) for pair, gone in zip(pairs, broken, strict=True) if gone}
        parted -= {tuple(pair) for pair, gone in zip(pairs, broken, strict=True) if not gone}
        stiffness = self.stiffness.copy()
        for j, (a, b, c) in enumerate(self.masses.tolist()):
            if (min(a, b), max(a, b)) in parted or (min(b, c), max(b, c)) in parted:
                stiffness[j] = 0.0
        stiffness.flags.writeable = False
        return AngularSprings(self.masses, stiffness, self.rest_angles)

    def to_dict(self) -> dict[str, Any]:
        """Plain lists."""
        return {name: getattr(self, name).tolist() for name in ("masses", *UNITS)}


def _checked_masses(value: npt.ArrayLike, count: int) -> IntArray:
    masses = np.asarray(value)
    if masses.size == 0:
        return np.zeros((0, 3), dtype=np.int64)
    if masses.ndim != 2 or masses.shape[1] != 3 or not np.issubdtype(masses.dtype, np.integer):
        raise InputError(f"angular_springs.masses has shape {masses.shape}: expected (k, 3) whole numbers")
    for j, three in enumerate(masses.tolist()):
        if not all(0 <= i < count for i in three):
            raise InputError(f"angular_springs[{j}].masses = {three}: expected masses from 0 to {count - 1}")
        if len(set(three)) < 3:
            raise InputError(f"angular_springs[{j}].masses = {three}: expected three different masses")
    return np.array(masses, dtype=np.int64)


def _refuse_rest_angles(given: Array, dimension: int) -> None:
    """Those that are given, in their range."""
    known = np.where(np.isnan(given), 0.0, given)
    refuse_rest_angles(known, ~np.isfinite(known), f"a finite number [{UNITS['rest_angles']}]")
    least, most, said = (0.0, np.pi, "0 to pi") if dimension == 3 else (-2 * np.pi, 2 * np.pi, "-2 pi to 2 pi")
    expected = f"a number from {said} [{UNITS['rest_angles']}]; 180 degrees are 3.14159 rad"
    refuse_rest_angles(known, (known < least) | (known > most + AS_WRITTEN), expected)


def refuse_rest_angles(rest_angles: Array, bad: BoolArray, expected: str) -> None:
    """Refuse the first that is bad, with the number of its spring. Raises InputError."""
    if bad.any():
        j = int(np.argmax(bad))
        raise InputError(f"angular_springs[{j}].rest_angle = {rest_angles[j]:.6g}: expected {expected}")
