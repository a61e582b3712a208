"""The wide catalogue: each scheme is the textbook's, by what is derived of it, has its order, and is found by name."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.consequences import consequences
from reference.derivation.implicit import implicit_tableau
from reference.derivation.nonlinear_order import nonlinear_order
from reference.derivation.of_schemes import tableau_of_scheme, updates_of_scheme
from reference.derivation.oscillators import runs_of
from reference.derivation.pasts import pasts
from reference.derivation.step_matrix import step_matrix
from reference.derivation.updates import in_words
from reference.identification import identify
from reference.schemes.catalogue import Scheme, find, schemes, wide_schemes
from reference.stepper import SchemeStepper, stepper_named
from tests.reference.systems import free_string, label, moving_string

WIDE = list(wide_schemes().values())

#: b, and the rows of a below the first, of HNW and the papers that the docstrings cite.
TABLEAUX = {
    "explicit_midpoint": ("0 1", "1/2"),
    "ralston": ("1/4 3/4", "2/3"),
    "rk3": ("1/6 2/3 1/6", "1/2", "-1 2"),
    "ssprk3": ("1/6 1/6 2/3", "1", "1/4 1/4"),
    "bogacki_shampine": ("2/9 1/3 4/9", "1/2", "0 3/4"),
    "rk4_three_eighths": ("1/8 3/8 3/8 1/8", "1/3", "-1/3 1", "1 -1 1"),
    "dormand_prince": (
        "35/384 0 500/1113 125/192 -2187/6784 11/84",
        "1/5",
        "3/40 9/40",
        "44/45 -56/15 32/9",
        "19372/6561 -25360/2187 64448/6561 -212/729",
        "9017/3168 -355/33 46732/5247 49/176 -5103/18656",
    ),
}

#: Of those that are given as formulas: the end of a step.
FORMULAS = {
    "adams_bashforth_2": ["x' = x + 3 h f1.x/2 - h f1.x[-1]/2", "v' = v + 3 h f1.v/2 - h f1.v[-1]/2"],
    "beeman": ["x' = x + h v + 2 h^2 a1/3 - h^2 a1[-1]/6", "v' = v + 5 h a1/6 + h a2/3 - h a1[-1]/6"],
    "leapfrog_kick_drift_kick": ["x' = x + h v + h^2 a1/2", "v' = v + h a1/2 + h a2/2"],
    "leapfrog_drift_kick_drift": ["x' = x + h v + h^2 a1/2", "v' = v + h a1"],
    "stormer_verlet": ["x' = 2 x - x[-1] + h^2 a1", "v' = h^-1 x - h^-1 x[-1] + h a1 + h a2/2"],
}


@pytest.mark.parametrize("name", TABLEAUX)
def test_tableaux_are_the_textbooks(name: str) -> None:
    """To the fraction, read off the scheme's own function."""
    tableau = tableau_of_scheme(find(name))
    assert tableau is not None
    b, *rows = ([Fraction(word) for word in words.split()] for words in TABLEAUX[name])
    assert list(tableau.b) == b
    assert [list(row[: i + 1]) for i, row in enumerate(tableau.a[1:])] == rows
    assert tableau.explicit
    assert tableau.times_at_odds == ()


@pytest.mark.parametrize("name", FORMULAS)
def test_formulas_are_the_textbooks(name: str) -> None:
    """Also of those that look back, once they have a past."""
    assert in_words(updates_of_scheme(find(name)))[-2:] == FORMULAS[name]


def test_implicit_ones_have_their_stages() -> None:
    """Newmark with 1/4 and 1/2 is the trapezoidal rule; Radau IIA has c = 1/3, 1 and order 3."""
    trapezoid, radau = implicit_tableau(find("newmark")), implicit_tableau(find("radau_iia"))
    assert trapezoid is not None
    assert trapezoid.text()["a"] == [["0", "0"], ["1/2", "1/2"]]
    assert radau is not None
    assert radau.text() == {"a": [["5/12", "-1/12"], ["3/4", "1/4"]], "b": ["3/4", "1/4"], "c": ["1/3", "1"]}


@pytest.mark.parametrize("scheme", WIDE, ids=label)
def test_each_has_its_order(scheme: Scheme) -> None:
    """Error ~ h^p, on a spring that turns, without damping; of Dormand and Prince's too small: by its tableau."""
    tableau = tableau_of_scheme(scheme) or implicit_tableau(scheme)
    assert tableau is None or tableau.order == scheme.order
    measured = nonlinear_order(runs_of(SchemeStepper(scheme)), False, False)
    assert measured == scheme.order or (measured is None and tableau is not None)


@pytest.mark.parametrize("scheme", WIDE, ids=label)
def test_each_is_one_step_or_not_as_it_says(scheme: Scheme) -> None:
    """By the same step with another past."""
    assert pasts(runs_of(SchemeStepper(scheme)), "double", True, True).one_step is scheme.one_step


@pytest.mark.parametrize("scheme", WIDE, ids=label)
def test_each_keeps_momentum_and_does_not_mind_numbering(scheme: Scheme) -> None:
    """Nothing holds the string: sum m v stays; masses in another order move alike. To rounding, solvers to 1e-9."""
    system = free_string(0.4)
    run = SchemeStepper(scheme).run(system, 1e-3, 20).trajectory
    assert run is not None
    momentum = (system.masses[:, None] * run.velocities).sum(axis=1)
    np.testing.assert_allclose(momentum, momentum[:1].repeat(len(momentum), 0), atol=1e-11)
    order = np.random.default_rng(1).permutation(len(system.masses))
    back = np.argsort(order)
    other = type(system)(
        positions=system.positions[order],
        velocities=system.velocities[order],
        springs=back[system.springs],
        masses=system.masses[order],
        rest_lengths=system.rest_lengths,
        stiffness=system.stiffness,
        damping=system.damping,
        gravity=system.gravity,
    )
    moved = SchemeStepper(scheme).run(other, 1e-3, 20).trajectory
    assert moved is not None
    np.testing.assert_allclose(moved.positions, run.positions[:, order], atol=1e-11)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scheme", WIDE, ids=label)
def test_each_is_named(scheme: Scheme) -> None:
    """On a string with damping and drag, where no scheme is another's; of two alike the simplest is named."""
    system = moving_string(3, damping=0.4, drag=0.05)
    found = identify(stepper_named(scheme.name), system, 1e-3, 40)
    assert found.identified_as == scheme.name
    assert found.ties == ()


def test_symplectic_compositions_are_stable_up_to_their_limit() -> None:
    """Forest and Ruth's: h w = 1.5734 (McLachlan and Atela, Nonlinearity 5, 1992); leapfrogs: 2."""
    found = {
        name: consequences(step_matrix(runs_of(stepper_named(name))))
        for name in ("forest_ruth", "yoshida_4", "leapfrog_drift_kick_drift")
    }
    assert all(each.symplectic and each.reversible for each in found.values())
    assert found["forest_ruth"].imaginary_axis[0][1] == pytest.approx(1.5734, abs=1e-4)
    assert found["leapfrog_drift_kick_drift"].imaginary_axis[0][1] == pytest.approx(2.0, abs=1e-9)


def test_none_is_run_where_nobody_asks() -> None:
    """They are not among those that commands and experiments run by themselves."""
    assert not set(wide_schemes()) & set(schemes())
    assert all(scheme.kind == "wide_scheme" for scheme in WIDE)
