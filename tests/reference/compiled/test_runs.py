"""Loops in blocks: the bits of the scheme's function, whatever the runs, the blocks, the chunks and the threads.

Their text is run by Python itself, which refuses to go beyond an array; once compiled, by one thread and by two.
"""

from __future__ import annotations

import os
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from experiments.benchmark.meshes import CLOTH, JELLO, lattice
from reference.compiled import kernels, mesh_loops, runs
from reference.compiled.mesh_loops import MeshLoops
from reference.compiled.run_loops import RunLoops
from reference.forces import springs_of_masses
from reference.obstacles import Plane
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.system import IntArray, MassSpringSystem
from tests.reference.compiled.test_loops_interpreted import interpreted
from tests.reference.systems import moving_string, random_mesh

DT, STEPS = 1e-3, 3


def moving(system: MassSpringSystem, **fields: Any) -> MassSpringSystem:
    """With masses that are unequal and move, the fixed ones excepted."""
    rng = np.random.default_rng(5)
    velocities = rng.normal(size=system.positions.shape) * ~system.fixed[:, None]
    return replace(system, velocities=velocities, masses=rng.uniform(0.01, 0.05, len(system.masses)), **fields)


CLOTH_2D = moving(lattice((7, 5), CLOTH))
WIDE = lattice((30, 40), CLOTH)
SYSTEMS = {
    "cloth": CLOTH_2D,
    "jello on the ground": moving(lattice((4, 3, 3), JELLO), obstacles=(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),)),
    "string": moving_string(20, damping=0.05, drag=0.02),
    "springs named from the other end": CLOTH_2D.with_ends_swapped(),
    "springs in no order": random_mesh(3, 7, 2, anchors=2),
    "no springs": replace(
        random_mesh(3, 7, 2), **dict.fromkeys(("rest_lengths", "stiffness", "damping"), 1.0), springs=[]
    ),
}


#: Each by loops over runs, and by loops over lists; without springs there is one run, of none.
KINDS = [
    (name, kind) for name in SYSTEMS for kind in (RunLoops, MeshLoops) if (name, kind) != ("no springs", MeshLoops)
]


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small systems are taken for large ones, of three chunks where there are threads, in blocks of four masses."""
    for name, value in {"LARGE": 0, "LONG": 0, "BLOCK": 4}.items():
        monkeypatch.setattr(runs, name, value)
    monkeypatch.setattr(os, "cpu_count", lambda: 3)


@pytest.fixture
def by_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is compiled."""
    monkeypatch.setattr(kernels, "compiled", interpreted)


def check_same_bits(system: MassSpringSystem, scheme: str, threads: int, kind: type[RunLoops] = RunLoops) -> None:
    """Loops of a kind, with fresh blocks, end where the scheme's function ends."""
    if kind is MeshLoops:
        runs.LONG = len(system.springs) + 1
    kernel = kernels.Kernel(system, find(scheme), threads)
    assert type(kernel._loops) is kind
    kernel.advance(DT, STEPS)
    positions, velocities = kernel.state()
    end = simulate(system, find(scheme), DT, STEPS * DT)
    assert positions.tolist() == end.positions[-1].tolist()
    assert velocities.tolist() == end.velocities[-1].tolist()


@pytest.mark.rotating(3)
@pytest.mark.usefixtures("by_python")
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("scheme", ["euler", "kick_drift", "velocity_verlet", "heun", "rk4"])
@pytest.mark.parametrize(("name", "kind"), KINDS)
def test_blocks_give_the_bits_of_the_schemes_function(
    name: str, kind: type[RunLoops], scheme: str, threads: int
) -> None:
    """Also where a stage moves the very masses that springs of later blocks lie beside, and where runs are short."""
    check_same_bits(SYSTEMS[name], scheme, threads, kind)


@pytest.mark.rotating(5)
@pytest.mark.parametrize(
    ("name", "scheme", "threads", "kind"),
    [("jello on the ground", "heun", 1, RunLoops), ("cloth", "euler", 2, RunLoops), ("cloth", "heun", 1, MeshLoops)],
)
def test_compiled_blocks_give_the_bits_of_the_schemes_function(
    name: str, scheme: str, threads: int, kind: type[RunLoops]
) -> None:
    """In blocks as large as they are of large systems, and in ones that end within rows of the lattice."""
    for block in (4, 1024):
        runs.BLOCK = block
        check_same_bits(SYSTEMS[name], scheme, threads, kind)


@pytest.mark.usefixtures("by_python")
@pytest.mark.parametrize("kind", [RunLoops, MeshLoops])
def test_same_bits_fail_on_a_sum_in_another_order(monkeypatch: pytest.MonkeyPatch, kind: type[RunLoops]) -> None:
    """Of each mass's springs, taken from the last to the first."""

    def backwards(system: MassSpringSystem) -> Any:
        first, spring, sign = springs_of_masses(system)
        order = np.concatenate([np.arange(b, a, -1) - 1 for a, b in pairwise(first)])
        return first, spring[order], sign[order]

    for file in (runs, mesh_loops):
        monkeypatch.setattr(file, "springs_of_masses", backwards)
    with pytest.raises(AssertionError, match="At index"):
        check_same_bits(CLOTH_2D, "heun", 1, kind)


@pytest.mark.usefixtures("by_python")
@pytest.mark.parametrize("threads", [1, 2])
def test_same_bits_fail_where_a_place_is_used_again_too_early(monkeypatch: pytest.MonkeyPatch, threads: int) -> None:
    """One block before the last that needs the force in it."""
    homes = runs._homes

    def nearer(springs: IntArray, edges: IntArray, near: float) -> tuple[IntArray, int]:
        home, reach = homes(springs, edges, near)
        return home, reach - 1

    monkeypatch.setattr(runs, "_homes", nearer)
    with pytest.raises(AssertionError):
        check_same_bits(CLOTH_2D, "heun", threads)


@pytest.mark.usefixtures("by_python")
def test_same_bits_fail_where_springs_between_chunks_are_not_computed_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """Euler moves a chunk's masses before the next chunk looks at them."""
    text = RunLoops.text
    before = "springs(block_runs[blocks], block_runs[blocks + 1],"

    def late(loops: RunLoops) -> str:
        return text(loops).replace(f"        {before}", f"        if step > 0: {before}")

    monkeypatch.setattr(RunLoops, "text", late)
    with pytest.raises(AssertionError):
        check_same_bits(CLOTH_2D, "euler", 2)


# --- Which systems, and what is found in them ---


def test_a_row_of_a_lattice_is_one_run() -> None:
    """A cloth of one block: of springs along the other axis one run for all, of the others one for each row."""
    runs.BLOCK = 64
    found = runs.runs_of(CLOTH_2D)
    rows = {(1, 0): 1, (0, 1): 7, (1, 1): 6, (1, -1): 6, (2, 0): 1, (0, 2): 7}
    assert len(found["run_a"]) == sum(rows.values())
    assert found["run_spring"][-1] == len(CLOTH_2D.springs)


def test_forces_are_kept_for_as_few_blocks_as_springs_reach() -> None:
    """In a long narrow cloth of 4 masses a row springs reach 8 masses, 2 blocks: 3 blocks of 6 springs a mass."""
    long = lattice((200, 4), CLOTH)
    assert len(runs.runs_of(long)["force0"]) <= 3 * 4 * 6
    assert len(long.springs) > 3000


@pytest.mark.parametrize(
    ("system", "wanted"),
    [
        (WIDE, True),
        (WIDE.renumbered(np.random.default_rng(0).permutation(1200)), False),
        (lattice((200, 6), CLOTH), False),
        (replace(WIDE, stiffness=1.0 + np.arange(len(WIDE.springs))), False),
    ],
    ids=["a cloth", "numbered at random", "narrow", "each spring another"],
)
def test_long_runs_are_found_in_lattices(
    monkeypatch: pytest.MonkeyPatch, system: MassSpringSystem, wanted: bool
) -> None:
    """Of 16 springs and more in the mean, alike but for their rest lengths."""
    monkeypatch.setattr(runs, "LONG", 16)
    assert runs.has_runs(system) is wanted


def test_small_systems_have_no_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are in the cache anyway."""
    monkeypatch.setattr(runs, "LARGE", len(WIDE.springs))
    assert isinstance(kernels.loops_for(find("heun"), WIDE), RunLoops)
    monkeypatch.setattr(runs, "LARGE", len(WIDE.springs) + 1)
    assert not isinstance(kernels.loops_for(find("heun"), WIDE), RunLoops)


def test_springs_that_reach_far_are_computed_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """One spring from the first mass of a long cloth to its last: room for 2 more, in place of room for all."""
    long = lattice((200, 4), CLOTH)
    one_more = {name: np.append(getattr(long, name), 1.0) for name in ("rest_lengths", "stiffness", "damping")}
    tied = replace(long, springs=np.vstack([long.springs, [0, 799]]), **one_more)
    assert runs.blocks_of(tied, 1, near=0.99).place.max() <= 3 * 4 * 6 + 1
    assert runs.blocks_of(tied, 1).place.max() > len(long.springs)


def test_numbering_brings_neighbours_together() -> None:
    """A narrow cloth numbered at random: then springs reach 4 rows of it at most, in blocks of 4 masses."""
    order = np.random.default_rng(1).permutation(800)
    mixed = lattice((200, 4), CLOTH).renumbered(order)
    found = mixed.renumbered(mesh_loops.numbering(mixed))
    assert np.abs(np.diff(mixed.springs)).max() > 700
    assert np.abs(np.diff(found.springs)).max() <= 4 * 4 + 4
