"""Step matrices: derived from steps on springs, and held against what linear theory makes of each scheme's function."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from reference.derivation.oscillators import Run, runs_of
from reference.derivation.step_matrix import step_matrix
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.schemes.catalogue import Scheme, find, schemes
from reference.stepper import SchemeStepper, catalogued
from reference.theory.oscillators import step_matrices
from tests import wrong
from tests.reference.systems import label

#: As textbooks have them.
WRITTEN = {
    "euler": [["1", "1"], ["-a", "1 - b - d"]],
    "kick_drift": [["1 - a", "1 - b - d"], ["-a", "1 - b - d"]],
    "backward_euler": [
        ["(1 + b + d)/(1 + b + d + a)", "1/(1 + b + d + a)"],
        ["-a/(1 + b + d + a)", "1/(1 + b + d + a)"],
    ],
    "kick_drift_implicit_drag": [["(1 + d - a)/(1 + d)", "(1 - b)/(1 + d)"], ["-a/(1 + d)", "(1 - b)/(1 + d)"]],
    "drift_kick_exponential_damping": [["1", "1"], ["-a E", "E - d E - a E"]],
}


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.linear], ids=label)
def test_formulas_are_those_of_the_linearised_step(scheme: Scheme) -> None:
    """Of x'' = -k/m x - (c + Cd)/m x': the formulas at other a, b and d against the scheme's own function on matrices.

    The two have nothing in common but that function: one is fitted to steps of springs, the other is given the
    linearised equations. Formulas of fractions are exact, so only rounding is left.
    """
    found = step_matrix(runs_of(SchemeStepper(scheme)))
    assert found.exact
    a, b = np.array([0.7, 1.9, 3.3]), np.array([0.2, 0.05, 0.9])
    for i in range(3):
        expected = step_matrices(scheme, 0.5, np.ones(1), a[i : i + 1] / 0.25, b[i : i + 1] / 0.5, 0.3 / 0.5)[0]
        np.testing.assert_allclose(found.at(a[i], b[i], np.array(0.3)), expected, atol=1e-12)


@pytest.mark.parametrize("name", WRITTEN)
def test_they_are_written_as_in_textbooks(name: str) -> None:
    """Low powers of h first, small fractions."""
    assert step_matrix(runs_of(catalogued()[name])).text() == WRITTEN[name]


@pytest.mark.parametrize(
    ("pretender", "name"),
    [
        (wrong.heun_without_half, "heun"),
        (wrong.verlet_with_one_force, "velocity_verlet"),
        (wrong.rk4_equally_weighted, "rk4"),
        (wrong.kick_drift_kicked_twice, "kick_drift"),
        (wrong.kick_drift_gaining_energy, "kick_drift"),
    ],
    ids=label,
)
def test_a_mistake_shows_in_the_formulas(pretender: Scheme, name: str) -> None:
    """Also one of a part in a million."""
    right, mistaken = (step_matrix(runs_of(SchemeStepper(s))) for s in (find(name), pretender))
    assert mistaken.text() != right.text()


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize(
    "name", ["soft_constraints_cold(substeps=1, single=True)", "soft_constraints_cold(single=True)"]
)
def test_formulas_are_seen_through_single_precision(name: str) -> None:
    """Those of the same scheme in double precision, as far as damping and drag are in them, sub-steps counted."""
    seen = step_matrix(runs_of(SchemeStepper(find(name))), "single")
    same = step_matrix(runs_of(SchemeStepper(find(name).with_parameters(single=False))))
    assert (seen.text(), seen.substeps) == (same.text(), same.substeps)


@pytest.mark.rotating(3, in_turn=True)
def test_few_digits_make_no_decimals() -> None:
    """Where coefficients in single precision are no fractions, nothing is told: a polynomial goes through anything."""
    with pytest.raises(Unsupported, match="to the digits of single precision"):
        step_matrix(runs_of(SchemeStepper(find("soft_constraints_relaxed(single=True)"))), "single")


@pytest.mark.rotating(3, in_turn=True)
def test_why_there_is_no_damping_is_told() -> None:
    """Of a stepper that refuses damping but not drag, the reason; of one that refuses both, in one; else nothing."""
    all_of_it = runs_of(SchemeStepper(find("heun")))

    def undamped(asked: Sequence[Run]) -> list[Outcome]:
        if any(run.system.damping.any() for run in asked):
            raise Unsupported("its springs have no damping")
        return all_of_it(asked)

    def without_both(asked: Sequence[Run]) -> list[Outcome]:
        if any(run.system.damping.any() or np.any(run.system.drag) for run in asked):
            raise Unsupported("nothing resists")
        return all_of_it(asked)

    found = step_matrix(undamped)
    assert (found.damped, found.dragged) == (False, True)
    assert found.left_out == ("no damping in its step matrix: its springs have no damping",)
    assert step_matrix(without_both).left_out == ("no damping and no drag in its step matrix: nothing resists",)
    assert step_matrix(all_of_it).left_out == ()
