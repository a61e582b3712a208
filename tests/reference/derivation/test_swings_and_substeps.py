"""Step matrices of rods, by their small swings; and of steps that are made of several."""

from __future__ import annotations

import numpy as np
import pytest

from reference.derivation.explanation import explain
from reference.derivation.fit import Samples
from reference.derivation.near import nearest_known
from reference.derivation.oscillators import runs_of
from reference.derivation.step_matrix import step_matrix
from reference.derivation.swings import swing_matrices
from reference.errors import Unsupported
from reference.motion import Motion
from reference.schemes.catalogue import Scheme, find
from reference.schemes.constrained import COMPLIANCE
from reference.schemes.textbook import euler, kick_drift
from reference.state import State
from reference.stepper import SchemeStepper, catalogued
from reference.theory.oscillators import step_matrices
from report.derived import matrix_lines, sections


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("name", ["kick_drift", "heun", "velocity_verlet"])
def test_a_pendulums_small_swings_are_an_oscillators(name: str) -> None:
    """Q'' = -(g/L) q - (Cd/m) q': the scheme's own function, given these linearised, at other a and d."""
    found = step_matrix(runs_of(catalogued()[f"pendulum_{name}"]))
    assert found.of_swings
    assert found.exact
    h, a, d = 0.5, 0.7, 0.3
    expected = step_matrices(find(name), h, np.ones(1), np.array([a / h**2]), np.zeros(1), d / h)[0]
    np.testing.assert_allclose(found.at(np.array(a), np.array(0.0), np.array(d)), expected, atol=1e-12)


def test_another_schemes_swings_are_others() -> None:
    """Euler's are not kick-drift's: the check above would fail."""
    at = Samples(np.array([0.7]), np.zeros(1), np.zeros(1))
    one, other = (swing_matrices(runs_of(catalogued()[f"pendulum_{name}"]), at) for name in ("euler", "kick_drift"))
    assert np.abs(one - other).max() == pytest.approx(0.7, abs=1e-9)  # m11 is 1 - a, not 1


def test_a_rope_gives_way_as_its_rods_do() -> None:
    """To a sideways force a rod is infinitely stiff, but for its compliance: a e of the swing is lost in a step."""
    found = step_matrix(runs_of(catalogued()["rope_kick_drift"]))
    m12 = found.entries[1].numerator
    assert m12[(1, 0, 0, 0, 0)] == pytest.approx(-COMPLIANCE, abs=2e-10)


@pytest.mark.rotating(4, in_turn=True)
def test_what_is_told_of_rods() -> None:
    """Letters of a swing; nothing of springs; that it looks back at nothing."""
    found = explain(catalogued()["pendulum_rk4"])
    assert found.pasts is not None
    assert (found.pasts.one_step, found.order, found.explicit) == (True, 4, None)
    assert matrix_lines(found)[-1].startswith("with a = h^2 g/L, d = h Cd/m, of small swings of a rod")
    assert "Derived: a step of small swings of a rod" in dict(sections(found))


@pytest.mark.rotating(4, in_turn=True)
def test_springs_are_not_taken_for_rods() -> None:
    """Of a stepper whose springs give way there are no swings of rods: it knows no line, and is stiff."""

    def across(motion: Motion, state: State, dt: float) -> State:
        if state.positions.shape[1] == 1:
            raise Unsupported("it cannot do motion along a line")
        return kick_drift(motion, state, dt)

    with pytest.raises(Unsupported, match="along a line"):
        step_matrix(runs_of(SchemeStepper(Scheme(across, 1))))


def in_parts(count: int, step: Scheme) -> Scheme:
    """So many steps of dt over that number."""

    def parts(motion: Motion, state: State, dt: float) -> State:
        for _ in range(count):
            state = step.step(motion, state, dt / count)  # type: ignore[arg-type]
        return state

    return Scheme(parts, step.order)


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize(("count", "name"), [(6, "kick_drift"), (20, "kick_drift"), (8, "drift_kick"), (10, "euler")])
def test_sub_steps_are_counted_and_are_the_schemes(count: int, name: str) -> None:
    """As many as there are, each the scheme's; together the step that was measured."""
    whole = step_matrix(runs_of(SchemeStepper(in_parts(count, find(name)))))
    one = step_matrix(runs_of(SchemeStepper(find(name))))
    assert whole.substeps == count
    assert whole.text() == one.text()
    at = whole.samples
    np.testing.assert_allclose(whole.at(at.a, at.b, at.d), whole.measured, atol=1e-11)
    assert nearest_known(None, None, whole) == f"its step is {count} of h/{count}, each with the step matrix of {name}"


def test_parts_that_differ_are_no_sub_steps() -> None:
    """Two of kick-drift and one of Euler, of unequal lengths: one large formula, and no small ones."""

    def uneven(motion: Motion, state: State, dt: float) -> State:
        return euler(motion, kick_drift(motion, kick_drift(motion, state, 0.25 * dt), 0.25 * dt), 0.5 * dt)

    assert step_matrix(runs_of(SchemeStepper(Scheme(uneven, 1)))).substeps == 1
