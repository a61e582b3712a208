"""Scenes of rigid objects: a truss bridge (slides 27-28), and one that stands on loose soil (slide 29). In 2D.

A member is a spring of stiffness EA/L: its axial stiffness EA [N] (Young's modulus times cross-section) over its
length. Joints are hinges, as in the trusses of textbooks; each has half the mass of its members, and the bottom ones
the deck's.

A pinned support is a fixed mass. A roller, which holds one direction only, is a rocker: a strut on a fixed foot, as
long as the bridge is high, that leans aside by u and so gives way by u^2/2L only. Real bridges stand on such rockers,
and to first order it is the textbook's roller. A mass fixed along one axis would be another kind of mass, which every
force, scheme, matrix and engine would have to know.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from reference.errors import InputError
from reference.scenes import scene
from reference.scenes.lattices import DIAGONALS, THREADS, lattice, places, springs_between
from reference.scenes.parameters import PerItem, counted, each, not_below_zero
from reference.state import Array
from reference.system import IntArray, MassSpringSystem

#: Named by who patented them: Warren 1848, Pratt 1844, Howe 1840.
Kind = Literal["warren", "pratt", "howe"]

#: More panels than that are a slip of the finger.
MOST_PANELS = 100_000


@dataclass(frozen=True, eq=False)
class Truss:
    """What is joined to what. The joints of the bottom chord come first, from left to right, then the top's.

    Attributes:
        joints: where they are [m], shape (j, 2), the first at the origin.
        members: the two joints of each, shape (m, 2): bottom chord, top chord, end posts, then what is between.
        panels: how many members the bottom chord has.
    """

    joints: Array
    members: IntArray
    panels: int

    @property
    def lengths(self) -> Array:
        """Of the members [m], shape (m,)."""
        a, b = self.members.T
        return np.asarray(np.linalg.norm(self.joints[b] - self.joints[a], axis=1))

    def masses(self, per_length: float, deck: float, truck: float, truck_position: float) -> Array:
        """What each joint carries [kg], shape (j,): half of its members and of the deck beside it, and of the truck.

        Args:
            per_length: of the members [kg/m]. deck: on the bottom chord [kg/m].
            truck: [kg], shared by the two bottom joints beside it as a beam between them would.
            truck_position: [m] from the first joint.
        """
        mass = np.zeros(len(self.joints))
        np.add.at(mass, self.members, (per_length / 2 * self.lengths)[:, None])
        bottom = self.members[: self.panels]
        np.add.at(mass, bottom, (deck / 2 * self.lengths[: self.panels])[:, None])
        place = self.joints[: self.panels + 1, 0]
        if not place[0] <= truck_position <= place[-1]:
            raise InputError(f"truck_position = {truck_position:g}: expected a number from 0 to {place[-1]:g} [m]")
        j = min(int(np.searchsorted(place, truck_position, side="right")) - 1, self.panels - 1)
        part = (truck_position - place[j]) / (place[j + 1] - place[j])
        mass[[j, j + 1]] += truck * np.array([1 - part, part])
        return mass


def truss(kind: Kind, panels: int, panel: float, height: float) -> Truss:
    """A bridge of triangles: 2 j = m + 3 joints and members, and so statically determinate on a pin and a roller.

    Warren's top joints stand half-way between the bottom ones. Pratt's and Howe's stand above them, with a vertical at
    each; Pratt's diagonals fall towards the middle and are in tension, Howe's rise and are in compression.

    Raises:
        InputError: for lengths that are not > 0, or an odd number of panels where the middle needs a joint.
    """
    for name, length in (("panel", panel), ("height", height)):
        if not length > 0:
            raise InputError(f"{name} = {length:g}: expected a number > 0 [m]")
    counted("panels", panels, 1 if kind == "warren" else 2, MOST_PANELS)
    if kind != "warren" and panels % 2:
        raise InputError(f"panels = {panels}: expected an even number, a {kind} truss is symmetric")
    bottom = np.arange(panels + 1)
    above = bottom[:-1] + 0.5 if kind == "warren" else bottom[1:-1]
    top = panels + 1 + np.arange(len(above))
    chords = [_pairs(bottom[:-1], bottom[1:]), _pairs(top[:-1], top[1:])]
    posts = [_pairs(bottom[[0]], top[[0]]), _pairs(bottom[[-1]], top[[-1]])]
    if kind == "warren":
        between = [_pairs(bottom[1:-1], top[:-1]), _pairs(bottom[1:-1], top[1:])]
    else:
        falling, rising = _pairs(top[:-1], bottom[2:-1]), _pairs(bottom[1:-2], top[1:])
        left, half = (falling, rising) if kind == "pratt" else (rising, falling), panels // 2 - 1
        between = [_pairs(bottom[1:-1], top), left[0][:half], left[1][half:]]
    joints = np.zeros((panels + 1 + len(top), 2))
    joints[:, 0] = panel * np.concatenate([bottom, above])
    joints[top, 1] = height
    return Truss(joints, np.concatenate([*chords, *posts, *between]), panels)


@scene(dt=1e-3, duration=1.0, slides="27-28")
def bridge(
    *,
    kind: Kind = "warren",
    panels: int = 8,
    panel: float = 3.0,
    height: float = 3.0,
    axial_stiffness: PerItem = 5e7,
    mass_per_length: float = 200.0,
    deck: float = 800.0,
    truck: float = 5000.0,
    truck_position: float = 12.0,
    joint_mass: float = 0.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
) -> MassSpringSystem:
    """A truss bridge of stiff springs, pinned at its left end and on a rocker at its right, let go unloaded.

    axial_stiffness EA [N] is one number or one for each member, in the order of `Truss.members`; the rocker, the last
    spring, is as stiff as the stiffest member and weighs nothing that moves. mass_per_length is the members' and deck
    the deck's [kg/m]; the truck [kg] stands at truck_position [m] from the left end. joint_mass [kg], where it is not
    0, is every joint's in place of all these, as textbooks load a truss. damping [N s/m] is along members.
    """
    not_below_zero(mass_per_length=mass_per_length, deck=deck, truck=truck, joint_mass=joint_mass)
    built = truss(kind, panels, panel, height)
    stiffness = each("axial_stiffness", axial_stiffness, len(built.members)) / built.lengths
    end, foot = panels, len(built.joints)
    masses = built.masses(mass_per_length, deck, truck, truck_position)
    if joint_mass:
        masses = np.full(len(masses), joint_mass)
    return MassSpringSystem(
        positions=np.concatenate([built.joints, [[panels * panel, -height]]]),
        springs=np.concatenate([built.members, [[end, foot]]]),
        masses=np.append(masses, masses[end]),
        rest_lengths=np.append(built.lengths, height),
        stiffness=np.append(stiffness, stiffness.max()),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.isin(np.arange(foot + 1), [0, foot]),
    )


@scene(dt=1e-3, duration=1.0, slides="29")
def soil(
    *,
    kind: Kind = "warren",
    panels: int = 6,
    panel: float = 3.0,
    height: float = 3.0,
    axial_stiffness: float = 2e7,
    mass_per_length: float = 200.0,
    deck: float = 400.0,
    truck: float = 5000.0,
    truck_position: float = 9.0,
    damping: float = 1e3,
    rows: int = 5,
    margin: int = 2,
    soil_mass: float = 4000.0,
    soil_stiffness: float = 1e6,
    soil_damping: float = 2e4,
    gravity: float = 9.81,
) -> MassSpringSystem:
    """A truss bridge on a block of loose soil, a soft damped lattice, both let go at once: they settle.

    The soil's cells are squares as wide as a panel, each with both diagonals: `rows` of masses one above the other, the
    lowest fixed, and as many columns as the bridge has joints, with `margin` more on either side. The bridge's two ends
    are masses of its surface. soil_mass [kg], soil_stiffness [N/m], soil_damping [N s/m] are of each mass and spring;
    the others are as for `bridge`.
    """
    not_below_zero(mass_per_length=mass_per_length, deck=deck, truck=truck)
    not_below_zero(soil_mass=soil_mass, soil_stiffness=soil_stiffness, soil_damping=soil_damping)
    built = truss(kind, panels, panel, height)
    counted("margin", margin, least=0)
    ground = lattice(rows=rows, columns=panels + 1 + 2 * margin)
    earth = springs_between(ground, [*THREADS, *DIAGONALS])
    positions = places(ground.shape, (1, 0), 2, panel) - panel * np.array([margin, rows - 1])
    # the bridge's ends are the masses of the soil that they stand on; its other joints are numbered after the soil's
    ends = {0: ground[-1, margin], panels: ground[-1, margin + panels]}
    others = [i for i in range(len(built.joints)) if i not in ends]
    number = np.zeros(len(built.joints), dtype=np.int64)
    number[others] = ground.size + np.arange(len(others))
    number[list(ends)] = list(ends.values())
    carried = built.masses(mass_per_length, deck, truck, truck_position)
    masses = np.concatenate([np.full(ground.size, soil_mass), carried[others]])
    masses[list(ends.values())] += carried[list(ends)]
    a, b = earth.T
    return MassSpringSystem(
        positions=np.concatenate([positions, built.joints[others]]),
        springs=np.concatenate([earth, number[built.members]]),
        masses=masses,
        rest_lengths=np.concatenate([np.linalg.norm(positions[b] - positions[a], axis=1), built.lengths]),
        stiffness=np.concatenate([np.full(len(earth), soil_stiffness), axial_stiffness / built.lengths]),
        damping=np.concatenate([np.full(len(earth), soil_damping), np.full(len(built.members), damping)]),
        gravity=np.array(gravity),
        fixed=np.isin(np.arange(len(masses)), ground[0]),
    )


def _pairs(a: IntArray, b: IntArray) -> IntArray:
    return np.stack([a, b], axis=1)
