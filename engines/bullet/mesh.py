"""What Bullet's deformable bodies are made of: a mesh of triangles, whose sides are the springs.

A system is springs only, so triangles are found that have them for sides. Three springs that close a triangle are one,
and a tetrahedron is four. All must hang together side by side: where they do not, Bullet loads the mesh for ever.

Where springs cannot be reached so, as in a string, each gets a triangle with a third corner that all have in common: an
apex, pinned at such a height above the plane that the springs to it give no force (`APEX`).

Bullet's other kind of spring, for bending, joins all nodes two sides apart that no side joins, with a stiffness of its
own.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from engines.engine import Unsupported
from reference.system import BoolArray, MassSpringSystem

#: Height of the apex over the plane, in lengths of the system. The length of a spring to the apex is then the height,
#: as long as nothing goes further than 2^26 lengths: the rest is lost in rounding. With a power of two for the height,
#: the direction times the length is exact too, and the spring's force is exactly zero.
APEX = 2.0**80

#: The smaller number first.
Pair = tuple[int, int]
Triangle = tuple[int, int, int]


@dataclass(frozen=True)
class Mesh:
    """What is handed to Bullet.

    Attributes:
        nodes: how many masses; the apex, where there is one, is the node after the last.
        triangles: their corners, of which n is the apex.
        stiffness: k [N/m] of the edges.
        bending: k [N/m] of the springs between nodes two edges apart; 0 for none.
    """

    nodes: int
    triangles: list[Triangle]
    stiffness: float
    bending: float

    @property
    def has_apex(self) -> bool:
        """Whether some triangle has the apex for a corner."""
        return any(corner == self.nodes for triangle in self.triangles for corner in triangle)

    def obj(self) -> str:
        """The mesh in the text format OBJ.

        The nodes are scattered: Bullet crashes on a triangle without area while it loads one, though not later, and
        three points scattered in space are as good as never in a row. Where they really are is said afterwards, in
        double precision.
        """
        scattered = np.random.default_rng(0).uniform(0.0, 1.0, (self.nodes + self.has_apex, 3))
        corners = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in scattered]
        return "\n".join(corners + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in self.triangles]) + "\n"


def mesh_of(system: MassSpringSystem) -> Mesh:
    """The mesh whose springs are those of a system.

    Raises:
        Unsupported: with the spring or the mass that Bullet has no mesh for.
    """
    _refuse_what_is_no_mesh(system)
    n, edges = len(system.masses), bending_apart(system)
    if edges is None:
        edges = np.ones(len(system.springs), dtype=bool)
    pairs = sorted_pairs(system, edges)
    triangles, beyond = side_by_side(pairs)
    if beyond and system.dimension == 3 and system.damping.any():
        # a spring to the apex would damp all motion along it
        a, b = min(beyond)
        raise Unsupported(
            "bullet_softbody cannot do damping in three dimensions unless triangles of springs, side by side, have all "
            f"springs for sides: the one between masses {a} and {b} is not reached"
        )
    if beyond:
        _refuse_pieces(pairs, n)
        triangles = [(a, b, n) for a, b in pairs]
    bending = float(system.stiffness[~edges][0]) if not edges.all() else 0.0
    return Mesh(n, triangles, float(system.stiffness[edges][0]), bending)


def side_by_side(pairs: Sequence[Pair]) -> tuple[list[Triangle], set[Pair]]:
    """Triangles that have pairs for sides, from the first on one beside the other; and the pairs not reached.

    Each brings in a side, so there are fewer of them than of pairs.
    """
    neighbours = _neighbours(pairs)
    beyond, triangles = set(pairs), []
    reached = deque(next(([(a, b)] for a, b in pairs if neighbours[a] & neighbours[b]), []))
    beyond.difference_update(reached)
    while reached:
        a, b = reached.popleft()
        for c in sorted(neighbours[a] & neighbours[b]):
            new = beyond & {_pair(a, c), _pair(b, c)}
            if new:
                triangles.append((a, b, c))
                beyond -= new
                reached.extend(sorted(new))
    return triangles, beyond


def bending_apart(system: MassSpringSystem) -> BoolArray | None:
    """Which springs are sides, where all others are as Bullet's springs for bending, shape (s,); None where not so.

    With an apex there are none: all nodes are two sides apart by way of it.
    """
    kinds = np.unique(system.stiffness)
    if len(kinds) != 2:
        return None
    for kind in kinds:
        edges = np.asarray(system.stiffness == kind)
        sides = sorted_pairs(system, edges)
        if not side_by_side(sides)[1] and two_apart(sides) == set(sorted_pairs(system, ~edges)):
            return edges
    return None


def two_apart(pairs: Sequence[Pair]) -> set[Pair]:
    """All pairs of nodes that two pairs join, but no one does."""
    neighbours = _neighbours(pairs)
    return {(a, c) for a in neighbours for b in neighbours[a] for c in neighbours[b] - neighbours[a] if a < c}


def sorted_pairs(system: MassSpringSystem, chosen: BoolArray) -> list[Pair]:
    """The masses each of the chosen springs joins, the smaller number first."""
    return [(a, b) for a, b in np.sort(system.springs[chosen], axis=1).tolist()]


def apex_height(system: MassSpringSystem) -> float:
    """APEX times a length the system keeps within, to the next power of two [m]."""
    reach = float(np.abs(system.positions).max() + system.rest_lengths.sum())
    return float(2.0 ** np.ceil(np.log2(APEX * reach)))


def _refuse_what_is_no_mesh(system: MassSpringSystem) -> None:
    if len(system.springs) == 0:
        raise Unsupported("bullet_softbody cannot do a system without springs")
    pairs, counts = np.unique(np.sort(system.springs, axis=1), axis=0, return_counts=True)
    if (counts > 1).any():
        a, b = pairs[np.argmax(counts > 1)]
        raise Unsupported(f"bullet_softbody cannot do two springs between the same masses: {a} and {b}")
    alone = np.setdiff1d(np.arange(len(system.masses)), system.springs)
    if len(alone):
        raise Unsupported(f"bullet_softbody cannot do masses on no spring: mass {alone[0]} is on none")


def _refuse_pieces(pairs: Sequence[Pair], nodes: int) -> None:
    neighbours = _neighbours(pairs)
    found, waiting = {0}, [0]
    while waiting:
        new = neighbours[waiting.pop()] - found
        found |= new
        waiting.extend(new)
    if len(found) < nodes:
        other = min(set(range(nodes)) - found)
        raise Unsupported(f"bullet_softbody cannot do several pieces: no springs lead from mass 0 to mass {other}")


def _neighbours(pairs: Sequence[Pair]) -> dict[int, set[int]]:
    neighbours: dict[int, set[int]] = {}
    for a, b in pairs:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    return neighbours


def _pair(a: int, b: int) -> Pair:
    return (a, b) if a < b else (b, a)
