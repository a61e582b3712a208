"""Which schemes are stable at any dt term by term, and which are not."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.theory.definite import Definiteness
from reference.theory.equilibria import spring_equilibrium
from reference.theory.linearisation import Linearisation


def of_string(scheme: str, damping: float) -> Definiteness:
    """S(h) of a scheme on the hanging string."""
    system = find_scene("string").system({"masses": 4, "damping": damping, "drag": 0.1})
    return Definiteness(find(scheme), Linearisation(system, spring_equilibrium(system).state), 0.01)


@pytest.mark.parametrize("damping", [0.0, 0.5])
@pytest.mark.parametrize(
    ("scheme", "stable"), [("backward_euler", True), ("implicit_midpoint", True), ("kick_drift", False)]
)
def test_who_is_stable_at_any_dt_by_theory_has_no_negative_term(scheme: str, stable: bool, damping: float) -> None:
    """And S itself is not negative, however long the step; kick-drift's is, beyond 2/w."""
    definite = of_string(scheme, damping)
    assert definite.never_negative == stable
    least = min(np.linalg.eigvalsh(np.asarray(definite.matrix(dt))).min() for dt in (1e-3, 1.0, 1e3))
    assert (least >= -1e-6) == stable
