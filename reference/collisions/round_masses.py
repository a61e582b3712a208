"""Which masses collide with one another, and how: what a system says of it. The rule is in `impacts`.

Needs NumPy only; of many masses SciPy finds the pairs.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.checked_numbers import in_range, refuse
from reference.errors import InputError
from reference.state import Array

#: From so many masses on a tree finds pairs.
TREE_FROM = 200

#: Nearer by this part of their radii is rounding: what was moved apart is a start, too.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Collisions:
    """Which masses collide, and how.

    Attributes:
        radii: [m], shape (n,), each >= 0; a mass of radius 0 meets nobody.
        restitution: e, the speed at which two part over that at which they met, from 0 to 1.

    Raises:
        InputError: in `checked`, naming the field, the index, the value, and what was expected.
    """

    radii: Array = field(default_factory=lambda: np.zeros(1))
    restitution: float = 0.0

    def checked(self, positions: Array) -> Collisions | None:
        """The same with a radius for each mass; None where no two can meet.

        Raises:
            InputError: also where two masses start in one another.
        """
        radii = np.array(in_range("radii", self.radii, (len(positions),), "m"))
        restitution = in_range("restitution", self.restitution, (), "1")
        refuse("restitution", restitution, restitution > 1, "a number from 0 to 1")
        lonely = restitution > 0 and not radii.any()
        refuse("restitution", restitution, np.asarray(lonely), "radii above zero with it: nothing collides")
        radii.flags.writeable = False
        whole = Collisions(radii, float(restitution))
        if (radii > 0).sum() < 2:
            return None
        near = whole.pairs(positions, 1 - ROUNDING)
        if len(near):
            i, j = near[0].tolist()
            apart = float(np.linalg.norm(positions[j] - positions[i]))
            raise InputError(
                f"radii: masses {i} and {j} start {apart:.6g} m apart: expected {radii[i] + radii[j]:.6g} m or more"
            )
        return whole

    def pairs(self, positions: Array, part: float = 1.0) -> npt.NDArray[np.int64]:
        """The pairs of masses nearer than this part of their radii together, shape (p, 2), rising, i < j."""
        round_ones = np.flatnonzero(self.radii > 0)
        x, r = positions[round_ones], part * self.radii[round_ones]
        if not np.isfinite(x).all():
            return np.zeros((0, 2), dtype=np.int64)
        if len(x) < TREE_FROM:
            i, j = np.triu_indices(len(x), 1)
        else:
            from scipy.spatial import cKDTree

            i, j = cKDTree(x).query_pairs(2 * r.max(), output_type="ndarray").T
        near = ((x[j] - x[i]) ** 2).sum(axis=1) < (r[i] + r[j]) ** 2
        found = round_ones[np.stack([np.minimum(i, j), np.maximum(i, j)], axis=1)[near]]
        return np.asarray(found[np.lexsort(found.T[::-1])])

    def renumbered(self, old: npt.NDArray[np.int64]) -> Collisions:
        """The same with mass old[i] as mass i."""
        return Collisions(self.radii[old], self.restitution)

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers."""
        return {"radii": self.radii.tolist(), "restitution": self.restitution}
