"""The limits every textbook has: on the real axis, where motion decays, and on the imaginary, where it swings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.equilibrium import equilibrium
from reference.theory.limits import stability_limit
from tests import wrong
from tests.reference.systems import random_mesh

#: A limit is bisected to 1e-7 of itself (`limits.PRECISION`), and its eigenvalue differenced to 1e-9: ten times that.
TOLERANCE = 1e-6

#: The real root of |R(-z)| = 1 for R of classic Runge-Kutta, 1 + z + z^2/2 + z^3/6 + z^4/24: z = -2.785293563405282.
RK4_REAL = float(-min(r.real for r in np.roots([1 / 24, 1 / 6, 1 / 2, 1, 0]) if abs(r.imag) < 1e-12))


def one_mass(stiffness: float, drag: float) -> Equilibrium:
    """A mass of 1 kg where it is at rest: x'' = -stiffness x - drag x' along the spring."""
    scene = {"mass": 1.0, "stiffness": stiffness, "drag": drag, "gravity": 0.0, "stretch": 0.0}
    system = find_scene("spring").system(scene)
    return Equilibrium(SpringMotion(system), system.start, ~system.fixed, 0.125)


def check_limit(scheme: Scheme, rest: Equilibrium, expected: float) -> None:
    """The dt beyond which R(dt lambda) leaves the unit circle, with lambda = -1/s or +-i/s."""
    assert stability_limit(scheme, rest).dt == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize(("name", "limit"), [("euler", 2.0), ("heun", 2.0), ("rk4", RK4_REAL)])
def test_limits_on_the_real_axis(name: str, limit: float) -> None:
    """Of v' = -v: Euler |1 - z| < 1, Heun |1 - z + z^2/2| < 1, rk4 to the root of its polynomial, 2.785294."""
    assert pytest.approx(2.785294, abs=1e-6) == RK4_REAL
    check_limit(find(name), one_mass(0.0, 1.0), limit)


@pytest.mark.parametrize(("name", "limit"), [("rk4", 2 * np.sqrt(2)), ("kick_drift", 2.0), ("drift_kick", 2.0)])
def test_limits_on_the_imaginary_axis(name: str, limit: float) -> None:
    """Of x'' = -x: rk4 2 sqrt(2) = 2.828427, the semi-implicit Eulers 2."""
    check_limit(find(name), one_mass(1.0, 0.0), limit)


@pytest.mark.parametrize("scheme", [wrong.heun_of_the_wrong_pair, wrong.rk4_equally_weighted], ids=lambda s: s.name)
def test_limits_on_the_axes_fail_on_wrong_schemes(scheme: Scheme) -> None:
    """The wrong pair of slopes, and equal weights, have limits elsewhere."""
    with pytest.raises(AssertionError):
        check_limit(scheme, one_mass(0.0, 1.0), 2.0 if scheme.order == 2 else RK4_REAL)


@pytest.mark.parametrize("seed", [1, 3, 5])
def test_motion_that_nothing_resists_hides_no_limit(seed: int) -> None:
    """A mesh that can turn freely about its anchors has an eigenvalue 1 twice; kick-drift's limit is 2/w all the same.

    w is the mesh's highest frequency, from the eigenvalues of its stiffness, solved apart.
    """
    from reference.theory.modes import squared_frequencies

    mesh = random_mesh(seed, 5, 3, anchors=2)
    mesh = replace(mesh, damping=np.zeros(len(mesh.springs)), drag=0.0)
    highest = np.sqrt(squared_frequencies(mesh, equilibrium(mesh)).max())
    check_limit(find("kick_drift"), spring_equilibrium(mesh), 2 / highest)
