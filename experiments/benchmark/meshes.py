"""The meshes that speed is measured on, and the memory that a process needs for them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import product
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from reference.compiled.kernels import Kernel
from reference.obstacles import Sphere
from reference.scenes import find
from reference.schemes import catalogue
from reference.system import MassSpringSystem

#: From this many masses on, a process's memory is that of the system.
LARGE = 100_000

#: Neighbours a mass of a mesh is joined to: along the axes, across, and (cloth) two along, for bending.
CLOTH = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 0), (0, 2))
JELLO = tuple(o for o in product((-1, 0, 1), repeat=3) if o > (0, 0, 0))


def lattice(shape: Sequence[int], offsets: Sequence[tuple[int, ...]], spacing: float = 0.1) -> MassSpringSystem:
    """A block of masses on a lattice, each joined to its neighbours at the offsets; the first corner is fixed."""
    index = np.arange(np.prod(shape)).reshape(shape)
    pairs = []
    for offset in offsets:
        here = tuple(slice(max(0, -o), s - max(0, o)) for o, s in zip(offset, shape, strict=True))
        there = tuple(slice(max(0, o), s + min(0, o)) for o, s in zip(offset, shape, strict=True))
        pairs.append(np.column_stack([index[here].ravel(), index[there].ravel()]))
    springs = np.concatenate(pairs)
    positions = spacing * np.indices(shape).reshape(len(shape), -1).T.astype(float)
    lengths = np.linalg.norm(positions[springs[:, 1]] - positions[springs[:, 0]], axis=1)
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=np.array(0.02),
        rest_lengths=lengths,
        stiffness=np.array(200.0),
        damping=np.array(0.05),
        drag=0.02,
        fixed=np.arange(len(positions)) == 0,
    )


def cloth_on_a_sphere(n: int) -> MassSpringSystem:
    """The cloth of n x n masses lying level in space, its middle touching a sphere half as wide as the cloth."""
    flat = lattice((n, n), CLOTH)
    level = np.insert(flat.positions, 1, 0.0, axis=1)
    radius = float(np.ptp(flat.positions[:, 0])) / 4
    x, y, z = level.mean(axis=0)
    return MassSpringSystem(
        positions=level,
        springs=flat.springs,
        masses=flat.masses,
        rest_lengths=flat.rest_lengths,
        stiffness=flat.stiffness,
        damping=flat.damping,
        drag=flat.drag,
        fixed=flat.fixed,
        obstacles=(Sphere((x, y - radius, z), radius),),
    )


def triangles(masses: int, at_random: bool = False) -> MassSpringSystem:
    """Masses strewn over a square, joined by a Delaunay triangulation; numbered by rows 0.4 m wide, or at random."""
    from scipy.spatial import Delaunay

    places = 0.1 * np.sqrt(masses) * np.random.default_rng(0).uniform(size=(masses, 2))
    if not at_random:
        places = places[np.lexsort((places[:, 1], places[:, 0] // 0.4))]
    corners = Delaunay(places).simplices
    sides = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [0, 2]]]), axis=1)
    springs = np.unique(sides, axis=0)
    return MassSpringSystem(
        positions=places,
        springs=springs,
        masses=np.array(0.02),
        rest_lengths=np.linalg.norm(places[springs[:, 1]] - places[springs[:, 0]], axis=1),
        stiffness=np.array(200.0),
        damping=np.array(0.05),
        drag=0.02,
        fixed=np.arange(masses) == 0,
    )


def string(masses: int) -> MassSpringSystem:
    """The default string with a number of masses, damped in both ways."""
    return find("string").system({"masses": masses, "damping": 0.05, "drag": 0.02})


def cases() -> dict[str, Callable[[], MassSpringSystem]]:
    """The meshes, by name."""
    strings = {f"string {n}": lambda n=n: string(n) for n in (20, 200, 2_000, 100_000, 1_000_000)}
    cloths = {f"cloth {n} x {n}": lambda n=n: lattice((n, n), CLOTH) for n in (30, 300, 1000)}
    jellos = {f"jello {n}^3": lambda n=n: lattice((n, n, n), JELLO) for n in (10, 50)}
    spheres = {f"cloth {n} x {n} on a sphere": lambda n=n: cloth_on_a_sphere(n) for n in (1000,)}
    sheets = {
        "triangles 300,000": lambda: triangles(300_000),
        "triangles 300,000, numbered at random": lambda: triangles(300_000, at_random=True),
    }
    return {**strings, **cloths, **spheres, **jellos, **sheets}


#: What Linux says of a process.
STATUS = Path("/proc/self/status")


def peak_per_mass(name: str) -> float | None:
    """The most memory per mass [bytes] of a case of LARGE or more, in a new process; None outside Linux."""
    if not STATUS.exists():
        return None
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_own_peak_per_mass, (name,))


def _own_peak_per_mass(name: str) -> float:
    """In this very process, less what it has before: Python, NumPy, Numba."""
    Kernel(string(20), catalogue.find("heun"), 1).advance(1e-5, 1)
    before = _memory("VmRSS")
    system = cases()[name]()
    Kernel(system, catalogue.find("heun"), 1).advance(1e-5, 2)
    return (_memory("VmHWM") - before) / len(system.masses)


def _memory(line: str) -> int:
    """A line of it, in bytes."""
    found = re.search(rf"{line}:\s+(\d+) kB", STATUS.read_text(encoding="ascii"))
    return 1024 * int(found[1]) if found else 0
