"""What a step makes of one spring, against closed forms: eigenvalues back to k and c, matrices, limits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from engines.translation.translation import Spring
from experiments.translation import oscillation
from experiments.translation.oscillation import (
    grows,
    largest_stable_dt,
    spring_of_step,
    spring_of_values,
    step_matrix,
    system_of,
)
from reference.errors import SolverError

#: 100 N/m between 0.5 kg and 2 kg, which are together as 0.4 kg.
BETWEEN = Spring(100.0, 0.3, 0.5, 2.0)
HELD = Spring(100.0, 0.3, 0.5)


def flow(k: float, c: float, mass: float, dt: float) -> np.ndarray:
    """What m r'' + c r' + k r = 0 does to (r, dt r') in dt."""
    return np.asarray(expm(np.array([[0.0, 1.0], [-k * dt**2 / mass, -c * dt / mass]])))


@pytest.mark.parametrize(("k", "c"), [(100.0, 0.0), (100.0, 0.3), (100.0, 40.0), (3.0, 0.0)])
@pytest.mark.parametrize("spring", [HELD, BETWEEN], ids=["held", "between"])
def test_a_step_that_does_what_a_spring_does_is_that_spring(k: float, c: float, spring: Spring) -> None:
    """Swinging, and creeping; by the mass that moves on it, whatever is remembered besides."""
    step = flow(k, c, spring.effective_mass, 0.01)
    assert spring_of_step(step, spring, 0.01) == (pytest.approx(k), pytest.approx(c, abs=1e-9))
    remembering = np.zeros((3, 3))
    remembering[1:, 1:] = step
    remembering[0, 0] = 1e-3
    assert spring_of_step(remembering, spring, 0.01) == (pytest.approx(k), pytest.approx(c, abs=1e-9))


@pytest.mark.parametrize(
    "values", [(0.5, -0.2), (-0.5, -0.2), (0.5, 0.0), (1e-13, 0.5), (np.nan, 0.5), (np.inf, 0.5), (-1.0, 0.5)]
)
def test_what_no_spring_does_is_none(values: tuple[float, float]) -> None:
    """Turned over in every step, gone in one, or no number at all."""
    assert spring_of_values(np.array(values, dtype=complex), 1.0, 0.1) is None
    assert spring_of_values(np.array([0.5, 0.2], dtype=complex), 1.0, 0.1) is not None


@pytest.mark.parametrize("spring", [HELD, BETWEEN], ids=["held", "between"])
def test_the_matrix_of_kick_drift_is_as_by_hand(spring: Spring) -> None:
    """By v' = v - h (k r + c v)/m, r' = r + h v': of the elongation and dt times its rate."""
    h, mass = 0.02, spring.effective_mass
    a, b = h**2 * spring.stiffness / mass, h * spring.damping / mass
    assert step_matrix("kick_drift", spring, h) == pytest.approx(np.array([[1 - a, 1 - b], [-a, 1 - b]]), abs=1e-12)


def test_the_system_is_a_stretched_spring_at_rest() -> None:
    """Along the first axis, without gravity; its first end is held, or the other mass."""
    for spring, fixed, masses in ((HELD, True, [0.5, 0.5]), (BETWEEN, False, [2.0, 0.5])):
        system = system_of(spring, 2)
        assert system.positions.tolist() == [[0, 0], [1.1, 0]]
        assert system.fixed.tolist() == [fixed, False]
        assert system.masses.tolist() == masses
        assert (system.stiffness.tolist(), system.damping.tolist(), system.rest_lengths.tolist()) == ([100], [0.3], [1])
        assert not system.gravity.any()


def test_the_largest_step_is_that_of_theory() -> None:
    """Of kick-drift (h w)^2 + 2 h c/m = 4; of two free masses by their effective one; backward Euler has none."""
    for spring in (HELD, BETWEEN, Spring(100.0, 0.0, 0.5), Spring(100.0, 30.0, 0.5)):
        w2, gamma = spring.stiffness / spring.effective_mass, spring.damping / spring.effective_mass
        limit = (-gamma + np.sqrt(gamma**2 + 4 * w2)) / w2
        assert largest_stable_dt("kick_drift", spring) == pytest.approx(limit, rel=2e-7)
        assert not grows("kick_drift", spring, 0.999 * limit)
        assert grows("kick_drift", spring, 1.001 * limit)
    assert largest_stable_dt("backward_euler", HELD) is None


def test_a_step_without_a_solution_grows(monkeypatch: pytest.MonkeyPatch) -> None:
    """And so does one that is no number; growth by rounding is none."""

    def fails(scheme: str, spring: Spring, dt: float) -> np.ndarray:
        raise SolverError("no solution")

    monkeypatch.setattr(oscillation, "step_matrix", fails)
    assert grows("any", HELD, 0.1)
    for number, found in ((1 + 1e-10, False), (1 + 1e-8, True), (-1.1, True), (np.nan, True), (0.5, False)):
        monkeypatch.setattr(oscillation, "step_matrix", lambda *_, number=number: np.diag([0.5, number]))
        assert grows("any", HELD, 0.1) == found
