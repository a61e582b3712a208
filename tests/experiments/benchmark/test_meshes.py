"""The meshes that speed is measured on: counted by hand; and the memory that Linux tells."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from experiments.benchmark import meshes
from experiments.benchmark.meshes import CLOTH, JELLO, cases, cloth_on_a_sphere, lattice, string, triangles


@pytest.mark.parametrize(("rows", "columns"), [(3, 3), (4, 6)])
def test_a_cloth_has_the_springs_it_should(rows: int, columns: int) -> None:
    """Along the axes, across both ways, and two along; each at its rest length, 0.1 m from mass to mass."""
    found = lattice((rows, columns), CLOTH)
    along = (rows - 1) * columns + rows * (columns - 1)
    bending = (rows - 2) * columns + rows * (columns - 2)
    across = 2 * (rows - 1) * (columns - 1)
    lengths = np.round(found.rest_lengths, 9).tolist()
    assert len(found.masses) == rows * columns
    assert [lengths.count(length) for length in (0.1, 0.141421356, 0.2)] == [along, across, bending]
    assert len(lengths) == along + across + bending == len({frozenset(pair) for pair in found.springs.tolist()})
    a, b = found.positions[found.springs.T]
    assert np.linalg.norm(b - a, axis=1) == pytest.approx(found.rest_lengths, rel=1e-12)
    assert np.flatnonzero(found.fixed).tolist() == [0]


def test_a_jello_joins_every_mass_to_its_26_neighbours() -> None:
    """The one inside a block of three to all others, and those at a corner to seven."""
    found = lattice((3, 3, 3), JELLO)
    ends = np.bincount(found.springs.ravel(), minlength=27)
    assert ends[13] == 26
    assert ends[[0, 2, 6, 8, 18, 20, 24, 26]].tolist() == [7] * 8


def test_triangles_fill_their_hull() -> None:
    """Of n masses, h of them on the hull, there are 3 n - 3 - h sides (Euler), 6 at a mass in the mean of many."""
    from scipy.spatial import ConvexHull

    by_rows, at_random = triangles(500), triangles(500, at_random=True)
    hull = len(ConvexHull(by_rows.positions).vertices)
    assert len(by_rows.springs) == len(at_random.springs) == 3 * 500 - 3 - hull
    near, far = (np.median(np.ptp(mesh.springs, axis=1)) for mesh in (by_rows, at_random))
    assert near < 25 < 100 < far


def test_the_cloth_lies_on_the_sphere() -> None:
    """Level, its middle at the top of a sphere half as wide as the cloth, everything else outside."""
    found = cloth_on_a_sphere(5)
    (sphere,) = found.obstacles
    assert np.ptp(found.positions, axis=0) == pytest.approx([0.4, 0.0, 0.4])
    gaps = np.linalg.norm(found.positions - sphere.centre, axis=1) - sphere.radius  # type: ignore[attr-defined]
    assert sphere.radius == pytest.approx(0.1)  # type: ignore[attr-defined]
    assert gaps[12] == pytest.approx(0.0, abs=1e-15)
    assert np.delete(gaps, 12).min() > 0


def test_a_case_is_as_large_as_its_name_says() -> None:
    """Those that are made quickly."""
    made = cases()
    sizes = {name: len(made[name]().masses) for name in ("string 20", "string 200", "cloth 30 x 30", "jello 10^3")}
    # the mass that holds a string comes on top
    assert sizes == {"string 20": 21, "string 200": 201, "cloth 30 x 30": 900, "jello 10^3": 1000}
    assert (string(20).damping > 0).all()
    assert string(20).drag > 0


def test_memory_is_what_linux_says_in_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line of a file as it writes it, in kB of 1024 bytes; 0 where there is no such line."""
    status = tmp_path / "status"
    status.write_text("Name:\tpython\nVmHWM:\t    2048 kB\nVmRSS:\t    1000 kB\n", encoding="ascii")
    monkeypatch.setattr(meshes, "STATUS", status)
    assert [meshes._memory(line) for line in ("VmHWM", "VmRSS", "VmSwap")] == [2048 * 1024, 1000 * 1024, 0]
    monkeypatch.setattr(meshes, "STATUS", tmp_path / "nowhere")
    assert meshes.peak_per_mass("string 20") is None


def test_triangles_are_measured_in_both_numberings(monkeypatch: pytest.MonkeyPatch) -> None:
    """By rows, unless at random is said."""
    monkeypatch.setattr(meshes, "triangles", lambda masses, at_random=False: (masses, at_random))
    found = {name: made() for name, made in cases().items() if name.startswith("triangles")}
    assert found == {
        "triangles 300,000": (300_000, False),
        "triangles 300,000, numbered at random": (300_000, True),
    }
    monkeypatch.undo()
    by_rows, strewn = triangles(400), triangles(400, at_random=True)
    assert np.array_equal(by_rows.positions, triangles(400, False).positions)
    apart = [np.abs(np.diff(found.positions[:, 0])).mean() for found in (by_rows, strewn)]
    assert apart[0] < 0.5 * apart[1]
