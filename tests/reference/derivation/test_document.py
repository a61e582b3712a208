"""What an explanation says in its properties and as JSON, of explanations made by hand."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from reference.derivation.consequences import FAR, Consequences
from reference.derivation.difference_equation import DifferenceEquation
from reference.derivation.explanation import OF_ONE_MASS, OF_RODS, OF_SPRINGS, Explanation, first_limit
from reference.derivation.fit import Samples
from reference.derivation.formula import ONE, Formula
from reference.derivation.multistep import Multistep
from reference.derivation.of_schemes import updates_of_scheme
from reference.derivation.over_dts import OverDts
from reference.derivation.pasts import Pasts
from reference.derivation.seen import NOTHING
from reference.derivation.step_matrix import StepMatrix
from reference.derivation.tableau import Tableau
from reference.identification import Identification, Match
from reference.schemes.catalogue import find

F = Fraction
A = (1, 0, 0, 0, 0)

#: m11 = 1 - a/2, and m22 over 1 + a.
SOLVED = StepMatrix(
    (
        Formula({ONE: F(1), A: F(-1, 2)}),
        Formula({ONE: F(1)}),
        Formula({A: F(-1)}),
        Formula({ONE: F(1)}, {ONE: F(1), A: F(1)}),
    ),
    True,
    False,
    Samples(np.zeros(1), np.zeros(1), np.zeros(1)),
    np.zeros((1, 2, 2)),
)
PLAIN = replace(SOLVED, entries=(*SOLVED.entries[:3], Formula({ONE: F(1)})))
FOLLOWS = Consequences(((0.0, 2.0),), ((0.0, FAR),), 1, 2, True, False, (), ())
HEUN = Tableau(((F(0), F(0)), (F(1), F(0))), (F(1, 2), F(1, 2)), (F(0), F(1)))
MIDPOINT = Tableau(((F(1, 2),),), (F(1),), (F(1, 2),))
BDF2 = Multistep((F(4, 3), F(-1, 3)), (F(2, 3), F(0), F(0)))
VERLET = DifferenceEquation((Formula({ONE: F(1)}), Formula({ONE: F(-2), A: F(1)}), Formula({ONE: F(1)})), False, False)
REMEMBERS, FORGETS = Pasts(False, True, 0.25), Pasts(True, True, 0.0)


def explained(**fields: Any) -> Explanation:
    """Of a stepper that is Heun by its motion."""
    return Explanation("mine", Identification("mine", (Match("heun", 1e-15),), 1e-12), **fields)


@pytest.mark.parametrize(
    ("fields", "explicit", "order", "symplectic"),
    [
        ({}, None, None, None),
        ({"matrix": PLAIN}, True, None, None),
        ({"matrix": SOLVED, "follows": FOLLOWS}, False, 2, True),
        ({"matrix": replace(PLAIN, of_swings=True), "follows": FOLLOWS, "nonlinear_order": 1}, None, 1, True),
        ({"matrix": SOLVED, "follows": FOLLOWS, "pasts": FORGETS, "nonlinear_order": 3}, False, 2, True),
        # of one that remembers the matrix tells nothing
        ({"matrix": PLAIN, "follows": FOLLOWS, "pasts": REMEMBERS}, True, None, None),
        ({"matrix": PLAIN, "follows": FOLLOWS, "pasts": REMEMBERS, "difference": VERLET}, True, 2, None),
        # a tableau goes before all others
        ({"seen": NOTHING._replace(tableau=MIDPOINT), "matrix": PLAIN, "nonlinear_order": 1}, False, 2, True),
        ({"seen": NOTHING._replace(tableau=HEUN), "matrix": SOLVED, "follows": FOLLOWS}, True, 2, False),
        ({"seen": NOTHING._replace(multistep=BDF2), "matrix": PLAIN, "nonlinear_order": 1}, False, 2, None),
        ({"seen": NOTHING._replace(updates=updates_of_scheme(find("kick_drift"))), "matrix": SOLVED}, True, None, None),
    ],
)
def test_what_is_known_best_goes_first(
    fields: dict[str, Any], explicit: bool | None, order: int | None, symplectic: bool | None
) -> None:
    """Tableaus before coefficients, these before formulas, these before the step matrix; None of what nothing tells."""
    found = explained(**fields)
    assert (found.explicit, found.order, found.symplectic) == (explicit, order, symplectic)
    document = found.document
    assert (document["explicit"], document["order"], document["symplectic"]) == (explicit, order, symplectic)


def test_an_order_is_that_of_masses_together_where_it_is_lower() -> None:
    """Lower, not as high; and then the reason says so."""
    for among, order, lower in ((1, 1, True), (2, 2, False), (3, 2, False)):
        found = explained(nonlinear_order=2, order_among_masses=among)
        assert (found.order, found.lower_among_masses, OF_ONE_MASS in found.reason) == (order, lower, lower)


def test_limits_are_those_of_what_tells_all_steps() -> None:
    """The matrix of one step; the difference equation of what remembers; a tableau's; none where the rule changes."""
    assert explained().limits == (None, None)
    assert explained(follows=FOLLOWS).limits == (((0.0, 2.0),), ((0.0, FAR),))
    assert explained(follows=FOLLOWS, pasts=REMEMBERS).limits == (None, None)
    imaginary, real = explained(follows=FOLLOWS, pasts=REMEMBERS, difference=VERLET).limits
    assert imaginary is not None
    assert imaginary[0][1] == pytest.approx(2.0, rel=1e-9)
    assert real is None
    imaginary, real = explained(seen=NOTHING._replace(tableau=HEUN)).limits
    assert imaginary is not None
    assert real is not None
    assert (imaginary[0][1], real[0][1]) == pytest.approx((0.0, 2.0), abs=1e-6)
    assert explained(follows=FOLLOWS, matrix=replace(PLAIN, only_at=0.0625)).limits == (None, None)
    assert [first_limit(windows) for windows in (None, ((0.0, FAR),), ((0.0, 1 / 3), (1.0, 2.0)))] == [
        None,
        "unlimited",
        0.333333333,
    ]


def test_a_document_has_all_that_is_known() -> None:
    """As text and numbers; of a rod and of springs, of sub-steps; what stands for the nearest."""
    whole = explained(
        pasts=FORGETS,
        matrix=replace(SOLVED, substeps=3),
        follows=FOLLOWS,
        seen=NOTHING._replace(updates=updates_of_scheme(find("heun")), tableau=HEUN, remarks=("it is rude",)),
        nearest="near",
        reasons=("it is late",),
    ).document
    assert whole["stepper"] == "mine"
    assert (whole["identified_as"], whole["one_step"], whole["deterministic"]) == ("heun", True, True)
    assert (whole["slope_evaluations"], whole["substeps"], whole["substep_scheme"]) == (2, 3, None)
    assert whole["tableau"] == {"a": [["0", "0"], ["1", "0"]], "b": ["1/2", "1/2"], "c": ["0", "1"]}
    assert whole["step_matrix"] == [["1 - a/2", "1"], ["-a", "1/(1 + a)"]]
    assert (whole["step_matrix_of"], whole["reversible"]) == (OF_SPRINGS, False)
    assert whole["stability"] == {"real_axis": "unlimited", "imaginary_axis": 2.0}
    assert (whole["nearest"], whole["changes_with_dt"], whole["reason"]) == ("near", None, "it is rude; it is late")
    assert (whole["multistep"], whole["difference_equation"]) == (None, None)
    other = explained(
        pasts=REMEMBERS,
        matrix=replace(PLAIN, of_swings=True),
        follows=FOLLOWS,
        seen=NOTHING._replace(multistep=BDF2),
        difference=VERLET,
        nearest="near",
        begun="bdf2, begun otherwise",
    ).document
    assert (other["step_matrix_of"], other["one_step"], other["reversible"]) == (OF_RODS, False, None)
    assert other["multistep"] == {"alpha": ["4/3", "-1/3"], "beta": ["2/3", "0", "0"]}
    assert (other["difference_equation"], other["nearest"]) == (["1", "-2 + a", "1"], "bdf2, begun otherwise")
    nothing = explained().document
    assert {name for name, value in nothing.items() if value is not None} == {
        "stepper",
        "identified_as",
        "stability",
        "reason",
    }
    assert nothing["stability"] == {"real_axis": None, "imaginary_axis": None}


def test_rules_that_change_are_listed_by_dt() -> None:
    """With where each thing was derived; a name that is off, and still its name, is no other rule."""
    held = OverDts("heun", (2e-4,), (2e-6, 0.0625), (None, "euler"), (1.0, 1.0))
    found = explained(held=held, matrix=PLAIN, seen=NOTHING._replace(tableau=HEUN, iterates=True))
    assert found.changes_with_dt
    assert found.document["changes_with_dt"] == {
        "step_matrix_at_s": 0.0625,
        "slopes_at_s": [0.25, 0.125],
        "rules": [
            {"dt_s": 2e-6, "identified_as": None},
            {"dt_s": 2e-4, "identified_as": "heun"},
            {"dt_s": 2e-3, "identified_as": "heun"},
            {"dt_s": 0.0625, "identified_as": "euler"},
        ],
    }
    bare = explained(held=held).document["changes_with_dt"]
    assert (bare["step_matrix_at_s"], bare["slopes_at_s"]) == (None, None)
    assert not explained(held=replace(held, named_there=(None, "heun"))).changes_with_dt
    assert not explained(matrix=PLAIN).changes_with_dt
    assert explained(matrix=replace(PLAIN, only_at=0.0625)).changes_with_dt


def test_who_failed_has_neither_name_nor_formulas() -> None:
    """Any of the three is enough."""
    nothing = Identification("mine", (), 1e-12, "it crashed")
    assert Explanation("mine", nothing).failed
    assert not explained().failed
    assert not Explanation("mine", nothing, matrix=PLAIN).failed
    assert not Explanation("mine", nothing, seen=NOTHING._replace(tableau=HEUN)).failed
