"""Cloth with the rigidity of a fabric: the textile laboratory's two tests, a strip that bends and a disc that drapes.

Springs over one mass that are at rest while the cloth is flat hardly keep it flat: bent by an angle t at each mass such
a spring gets shorter by a t^2/4, a being the spacing, and so resists with the third power of the bend: to a small load
not at all. Here they are longer at rest and push with a force P, which the links between neighbours hold with a pull of
P for each spring across them. Flat, all is in balance, and a bend gives a pushing spring way: P a t^2/4 is the energy
of a strip of rigidity

    B = P a^2/2  [N m^2].

A fabric here is a lattice of triangles cut to a disc: such strips in three directions, a sqrt(3)/2 apart. Summed over
directions they are an isotropic plate with Poisson's ratio 1/3 and, per width, the rigidity

    D = (3 sqrt(3)/8) P a  [N m].

Laboratories speak of the bending length c = (D/w)^(1/3) [m], w the weight per area, or per length of a strip: Peirce,
J. Textile Inst. 21 (1930) T377. Drape: Cusick, J. Textile Inst. 56 (1965) T596; BS 5058; ISO 9073-9.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from reference.errors import InputError
from reference.scenes import scene
from reference.scenes.lattices import MOST_MASSES, Offset, springs_between
from reference.scenes.parameters import counted, not_below_zero
from reference.state import Array
from reference.system import IntArray, MassSpringSystem

#: The rest length of a spring that pushes, in spacings; it is 2 long while the cloth is flat.
LONG = 4.0

#: Weight by which the bending length is defined [m/s^2], whatever gravity a cloth is under.
STANDARD_GRAVITY = 9.81

#: Of the lattice: along the rows, and across to both sides.
DIRECTIONS: tuple[Offset, ...] = ((0, 1), (1, 0), (1, -1))


@dataclass(frozen=True)
class Disc:
    """A disc cut out of a lattice of triangles.

    Attributes:
        numbers: of its masses on the lattice, -1 where there is none; two axes at 60 degrees.
        positions: level, about the origin [m], shape (n, 3).
    """

    numbers: IntArray
    positions: Array

    @property
    def triangles(self) -> IntArray:
        """The masses at the corners of every triangle, all in the same turn, shape (t, 3)."""
        grid = self.numbers
        right, up = grid[:-1, 1:], grid[1:, :-1]
        halves = ((grid[:-1, :-1], right, up), (grid[1:, 1:], up, right))
        found = np.concatenate([np.stack(half, axis=-1).reshape(-1, 3) for half in halves])
        return found[(found >= 0).all(axis=1)]


def disc(radius: float, spacing: float, sample: int = 0) -> Disc:
    """A disc of a radius [m], masses a spacing [m] apart. Each sample is cut at another place of the same lattice.

    Raises:
        InputError: for a spacing that makes no disc, or too large a one.
    """
    if not 0 < 2 * spacing <= radius:
        raise InputError(f"spacing = {spacing:g}: expected a number from 0 to {radius / 2:g}, half the radius [m]")
    counted("masses", int(min(2 * pi / sqrt(3) * (radius / spacing) ** 2, 1e18)), 1, MOST_MASSES)
    reach = int(2 * radius / spacing / sqrt(3)) + 2
    along, across = np.meshgrid(*[np.arange(-reach, reach + 1)] * 2)
    shift = np.random.default_rng(sample).uniform(-0.5, 0.5, 2)
    i, j = along + shift[0], across + shift[1]
    x, z = spacing * (i + j / 2), spacing * j * sqrt(3) / 2
    within = np.hypot(x, z) <= radius
    numbers = np.full(within.shape, -1)
    numbers[within] = np.arange(within.sum())
    return Disc(numbers, np.column_stack([x[within], np.zeros(within.sum()), z[within]]))


@scene(dt=2e-4, duration=0.2, slides="18-22")
def drape(
    *,
    radius: float = 0.15,
    support: float = 0.09,
    spacing: float = 0.02,
    density: float = 0.2,
    stiffness: float = 30.0,
    bending_length: float = 0.017,
    drag: float = 0.0014,
    gravity: float = 9.81,
    sample: int = 0,
) -> MassSpringSystem:
    """A round cloth of 30 cm, clamped on a disc of 18 cm, falls into folds: the drape test of textile laboratories.

    A lattice of triangles, level at the start and in balance but for its weight. radius and `support`, that of the disc
    it is clamped on, in [m]; `spacing` of its masses [m]; `density` [kg/m^2]; stiffness [N/m] of the links between
    neighbours; `bending_length` [m], whose third power times density and 9.81 m/s^2 is its rigidity [N m]. `sample`
    says where on the lattice it is cut: its edge is a little other each time, and so are its folds. Clamped are the
    masses on the disc, and those within half a spacing of it: a mass stands for the cloth around it. Folds may pass
    through one another.
    """
    not_below_zero(bending_length=bending_length, sample=sample)
    cut = disc(radius, spacing, sample)
    rigidity = density * STANDARD_GRAVITY * bending_length**3
    springs, lengths, stiffnesses = pushed_flat(cut.numbers, DIRECTIONS, spacing, stiffness, _push(rigidity, spacing))
    return MassSpringSystem(
        positions=cut.positions,
        springs=springs,
        masses=np.array(density * spacing**2 * sqrt(3) / 2),
        rest_lengths=lengths,
        stiffness=stiffnesses,
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.hypot(cut.positions[:, 0], cut.positions[:, 2]) <= support + spacing / 2,
    )


@scene(dt=1e-4, duration=0.2, slides="18-22")
def strip(
    *,
    masses: int = 10,
    length: float = 0.06,
    density: float = 0.005,
    stiffness: float = 300.0,
    bending_length: float = 0.03,
    drag: float = 0.0003,
    gravity: float = 9.81,
) -> MassSpringSystem:
    """A strip of fabric, clamped at one end, bends under its weight: the cantilever test of textile laboratories.

    In the plane, level at the start, of `masses` free masses and two that clamp it. Each stands in the middle of its
    part of the strip: the clamp's edge is at x = 0, half a spacing from either, and the strip's end at x = `length` [m]
    half a spacing beyond the last. `density` is in [kg/m], stiffness [N/m] that of the links, `bending_length` [m] as
    in the scene `drape`, here the third root of rigidity [N m^2] over weight per length.
    """
    counted("masses", masses, 2)
    not_below_zero(bending_length=bending_length)
    spacing = length / (masses + 1)
    push = 2 * density * STANDARD_GRAVITY * bending_length**3 / spacing**2
    springs, lengths, stiffnesses = pushed_flat(np.arange(masses + 2), [(1,)], spacing, stiffness, push)
    along = spacing * (np.arange(masses + 2) - 0.5)
    return MassSpringSystem(
        positions=np.column_stack([along, np.zeros(masses + 2)]),
        springs=springs,
        masses=np.array(density * spacing),
        rest_lengths=lengths,
        stiffness=stiffnesses,
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.arange(masses + 2) < 2,
    )


def pushed_flat(
    numbers: IntArray, directions: Sequence[Offset], spacing: float, stiffness: float, push: float
) -> tuple[IntArray, Array, Array]:
    """Links between neighbours, and springs over one mass that push: springs (s, 2), rest lengths [m], stiffness [N/m].

    Every line of masses is in balance as long as it is straight.

    Args:
        numbers: of the masses on a lattice, -1 where there is none.
        directions: in which it has lines.
        spacing: of masses along lines [m].
        stiffness: of the links [N/m].
        push: of each spring over one mass [N]; 0 for none.

    Raises:
        InputError: if links would have to be shorter at rest than a tenth of the spacing to hold the push.
    """
    if not stiffness * spacing * 0.9 > 2 * push:
        raise InputError(
            f"bending_length: with it springs push with {push:.3g} N, which links of {stiffness:g} N/m over "
            f"{spacing:g} m cannot hold: expected less of it, or more stiffness"
        )
    springs, lengths, stiffnesses = [], [], []
    for direction in directions:
        links, over = (_present(springs_between(numbers, [tuple(n * o for o in direction)])) for n in (1, 2))
        held = np.isin(links[:, 0], over[:, 0]).astype(float) + np.isin(links[:, 1], over[:, 1])
        springs += [links, over] if push else [links]
        lengths += [spacing - held * push / stiffness] + [np.full(len(over), LONG * spacing)] * bool(push)
        stiffnesses += [np.full(len(links), stiffness)]
        stiffnesses += [np.full(len(over), push / ((LONG - 2) * spacing))] * bool(push)
    return np.concatenate(springs), np.concatenate(lengths), np.concatenate(stiffnesses)


def _push(rigidity: float, spacing: float) -> float:
    """The force [N] of springs over one mass that gives a lattice of triangles its rigidity [N m]."""
    return 8 * rigidity / (3 * sqrt(3) * spacing)


def _present(pairs: IntArray) -> IntArray:
    """Those of which neither mass is missing."""
    return pairs[(pairs >= 0).all(axis=1)]
