"""The anchor in C: Heun's method, as anything that is compared with it should do it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from experiments.benchmark.meshes import CLOTH, lattice, string
from experiments.benchmark.tuned import TunedHeun, library
from reference.errors import Unsupported
from reference.schemes import catalogue
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem

DT, STEPS = 1e-3, 200


def stirred(system: MassSpringSystem) -> MassSpringSystem:
    """With velocities, masses, stiffness and lengths that differ from one to the next."""
    random = np.random.default_rng(1)
    n, s = len(system.masses), len(system.springs)
    return replace(
        system,
        velocities=np.where(system.fixed[:, None], 0.0, random.normal(scale=0.1, size=system.positions.shape)),
        masses=system.masses * random.uniform(0.8, 1.2, n),
        stiffness=system.stiffness * random.uniform(0.8, 1.2, s),
        rest_lengths=system.rest_lengths * random.uniform(0.95, 1.05, s),
    )


def ends(system: MassSpringSystem, as_string: bool) -> tuple[Array, Array]:
    """Where STEPS steps end in C, and by our own Heun."""
    try:
        tuned = TunedHeun(system, as_string)
    except Unsupported as reason:
        pytest.skip(str(reason))
    assert tuned.advance(DT, STEPS) > 0
    return tuned.positions, simulate(system, catalogue.find("heun"), DT, STEPS * DT).positions[-1]


@pytest.mark.parametrize("as_string", [True, False])
def test_the_string_in_c_is_heuns(as_string: bool) -> None:
    """To the rounding of some hundred steps of motions of a metre; by Euler it is another."""
    system = stirred(string(20))
    begin = system.positions.copy()
    found, expected = ends(system, as_string)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(system.positions, begin)
    euler = simulate(system, catalogue.find("euler"), DT, STEPS * DT).positions[-1]
    assert np.abs(found - euler).max() > 1e-6


@pytest.mark.parametrize(
    ("shape", "offsets"), [((5, 4), CLOTH), ((3, 2, 3), ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)))]
)
def test_a_mesh_in_c_is_heuns(shape: tuple[int, ...], offsets: tuple[tuple[int, ...], ...]) -> None:
    """In the plane and in space, to the same rounding."""
    found, expected = ends(stirred(lattice(shape, offsets)), as_string=False)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def test_a_compiler_that_refuses_the_anchor_is_quoted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the first line of what it says; and where there is none, that is said."""
    compiler = tmp_path / "cc"
    compiler.write_text("#!/bin/sh\necho 'cc: no such processor' >&2\necho more >&2\nexit 1\n")
    compiler.chmod(0o755)
    monkeypatch.setattr("shutil.which", lambda _: str(compiler))
    with pytest.raises(Unsupported, match=r"^the C compiler refused the anchor: cc: no such processor$"):
        library.__wrapped__(2)
    monkeypatch.setattr("shutil.which", lambda _: None)
    with pytest.raises(Unsupported, match="there is no C compiler"):
        library.__wrapped__(2)
