"""The formulas that are derived, as lines; and what is said of orders, calls and places, of explanations by hand."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from reference.derivation.consequences import Consequences
from reference.derivation.difference_equation import DifferenceEquation
from reference.derivation.fit import Samples
from reference.derivation.formula import ONE, Formula, Monomial, Terms
from reference.derivation.multistep import Multistep
from reference.derivation.over_dts import OverDts
from reference.derivation.pasts import Pasts
from reference.derivation.step_matrix import StepMatrix
from reference.derivation.tableau import Tableau
from reference.derivation.updates import Coefficient, Symbol, Updates
from report.derived import difference_lines, matrix_lines, name_line, property_lines, sections
from tests.report.test_derived_words import HEUN, explained, seen

F = Fraction
A: Monomial = (1, 0, 0, 0, 0)
B: Monomial = (0, 1, 0, 0, 0)
D: Monomial = (0, 0, 1, 0, 0)
E: Monomial = (0, 0, 0, 1, 0)
DECAY: Monomial = (0, 0, 0, 0, 1)


def one() -> Formula:
    """1, nothing else."""
    return Formula({ONE: F(1)})


def over(below: Terms) -> Formula:
    """1 over that."""
    return Formula({ONE: F(1)}, below)


def matrix(m12: Formula, m22: Formula, damped: bool = False, dragged: bool = False, **fields: Any) -> StepMatrix:
    """With m11 = 1 and m21 = -a."""
    at = Samples(np.zeros(1), np.zeros(1), np.zeros(1))
    return StepMatrix((one(), m12, Formula({A: F(-1)}), m22), damped, dragged, at, np.zeros((1, 2, 2)), **fields)


#: Divided by 1 + b + d.
BY_BOTH = over({ONE: F(1), B: F(1), D: F(1)})

#: Of which everything follows, of order 1, or 2 without damping.
FOLLOWS = Consequences(((0.0, 2.0),), ((0.0, 1.5),), 1, 2, True, False, ("damping",), ((0.5, 1.25, 0.875),))

A_IS, B_IS = "a = h^2 k/m", "b = h c/m"


@pytest.mark.parametrize(
    ("found", "lines"),
    [
        (
            matrix(BY_BOTH, one(), True, True),
            ["x' = x + (1/(1 + g)) h v", "h v' = (-a) x + h v", f"with {A_IS}, g = h (c + Cd)/m"],
        ),
        (  # not of the sum alone
            matrix(BY_BOTH, over({ONE: F(1), D: F(1)}), True, True),
            [
                "x' = x + (1/(1 + b + d)) h v",
                "h v' = (-a) x + (1/(1 + d)) h v",
                f"with {A_IS}, {B_IS}, d = h Cd/m",
            ],
        ),
        (  # neither of damping nor of drag, though it was looked at with both
            matrix(one(), one(), True, True),
            ["x' = x + h v", "h v' = (-a) x + h v", f"with {A_IS}"],
        ),
        (
            matrix(Formula({ONE: F(-1)}), Formula({E: F(1)}), damped=True),
            ["x' = x - h v", "h v' = (-a) x + (E) h v", f"with {A_IS}, E = exp(-b); without drag"],
        ),
        (
            matrix(one(), Formula({DECAY: F(1)}), dragged=True),
            ["x' = x + h v", "h v' = (-a) x + (D) h v", f"with {A_IS}, D = exp(-d); without damping"],
        ),
        (
            matrix(one(), one(), only_at=0.0625),
            [
                "x' = x + h v",
                "h v' = (-a) x + h v",
                f"with {A_IS}; without damping and drag; at h = 0.0625 s only: h stands in it by itself",
            ],
        ),
        (
            matrix(one(), Formula({B: F(1, 2)}), damped=True, substeps=3),
            [
                "x' = x + s v",
                "s v' = (-a) x + (b/2) s v",
                "with a = s^2 k/m, b = s c/m, s = h/3: a step of h is 3 of these; without drag",
            ],
        ),
        (
            matrix(one(), Formula({D: F(1)}), dragged=True, of_swings=True),
            [
                "x' = x + h v",
                "h v' = (-a) x + (d) h v",
                "with a = h^2 g/L, d = h Cd/m, of small swings of a rod of length L: x is its angle, v its rate",
            ],
        ),
    ],
)
def test_a_step_matrix_is_two_lines_and_what_its_letters_mean(found: StepMatrix, lines: list[str]) -> None:
    """With g = b + d where it asks for that sum alone; of a sub-step; of a rod; at one h only."""
    assert matrix_lines(explained()) == []
    assert matrix_lines(explained(matrix=found)) == lines
    title = "small swings of a rod" if found.of_swings else "the damped oscillator"
    assert sections(explained(matrix=found))[0][0].startswith(f"Derived: a step of {title}")


@pytest.mark.parametrize(
    ("found", "lines"),
    [
        (  # Verlet's two steps
            DifferenceEquation((one(), Formula({ONE: F(-2), A: F(1)}), one()), False, False),
            ["x1 = (2 - a) x0 - x[-1]", f"with {A_IS}; without damping and drag"],
        ),
        (  # nothing of the step before the last
            DifferenceEquation(
                (Formula({ONE: F(1), A: F(1, 2)}), Formula({ONE: F(-1)}), Formula({}), Formula({A: F(-1)})),
                False,
                False,
            ),
            ["(1 + a/2) x1 = x0 + (a) x[-2]", f"with {A_IS}; without damping and drag"],
        ),
        (
            DifferenceEquation((one(), Formula({B: F(-1), D: F(-1)}), Formula({A: F(1)})), True, True),
            ["x1 = (g) x0 + (-a) x[-1]", f"with {A_IS}, g = h (c + Cd)/m"],
        ),
        (
            DifferenceEquation((one(), Formula({B: F(-1)}), Formula({A: F(1)})), True, False),
            ["x1 = (b) x0 + (-a) x[-1]", f"with {A_IS}, {B_IS}; without drag"],
        ),
    ],
)
def test_a_difference_equation_is_a_line_and_what_its_letters_mean(found: DifferenceEquation, lines: list[str]) -> None:
    """The newest position to the left, the others with their signs turned."""
    assert difference_lines(explained()) == []
    assert difference_lines(explained(difference=found)) == lines
    assert ("Derived: what an oscillator's positions obey, step after step", lines) in sections(
        explained(difference=found)
    )


def told(begin: str, **fields: Any) -> list[str]:
    """The properties that begin so."""
    return [line for line in property_lines(explained(**fields)) if line.startswith(begin)]


X, V = {Symbol("x", 0): Coefficient(F(1), 0)}, {Symbol("v", 0): Coefficient(F(1), 0)}
REMEMBERS = Pasts(False, True, 0.25)
ADAMS = Multistep((F(1), F(0)), (F(0), F(3, 2), F(-1, 2)))
#: Of changing rule.
CHANGES = OverDts("heun", (), (0.5,), ("euler",), (1.0,))


def test_orders_are_told_with_where_they_were_seen() -> None:
    """By a matrix with its damping and drag; on a spring that turns; by a difference equation; among masses."""
    damped = matrix(one(), Formula({B: F(1)}), damped=True)
    assert told("Order", matrix=damped, follows=FOLLOWS, nonlinear_order=3) == [
        "Order 2 without damping: 2 on the oscillator, 1 with damping; "
        "3 measured on a spring that turns, without damping"
    ]
    both = replace(damped, dragged=True)
    assert told("Order", matrix=both, follows=FOLLOWS) == [
        "Order 2 without damping: 2 on the oscillator, 1 with damping and drag, as drag is not in it"
    ]
    in_it = matrix(one(), BY_BOTH, True, True)
    assert told("Order", matrix=in_it, follows=FOLLOWS) == [
        "Order 2 without damping: 2 on the oscillator, 1 with damping and drag"
    ]
    assert told("Order", matrix=matrix(one(), one()), follows=FOLLOWS) == [
        "Order 2 without damping: 2 on the oscillator"
    ]
    swings = replace(matrix(one(), Formula({D: F(1)}), dragged=True), of_swings=True)
    assert told("Order", matrix=swings, follows=FOLLOWS) == ["Order 2 without damping: 2 on small swings, 1 with drag"]
    verlet = DifferenceEquation((one(), Formula({ONE: F(-2), A: F(1)}), one()), False, False)
    assert told("Order", pasts=REMEMBERS, difference=verlet, nonlinear_order=4, follows=FOLLOWS) == [
        "Order 2 without damping: 2 on the oscillator, by its difference equation; "
        "4 measured on a spring that turns, without damping, its first steps included"
    ]
    assert told("Order", nonlinear_order=2, order_among_masses=1) == [
        "Order 2 without damping: 2 measured on a spring that turns, without damping",
        "Order 1 among several masses, measured on two that move one another, without damping: "
        "what is derived above, of one mass, does not show that",
    ]
    assert told("Order", seen=seen(multistep=ADAMS)) == ["Order 2, by its coefficients"]
    assert told("No order", seen=seen(adapts=True)) != []
    assert told("No order") == []


def test_an_order_by_a_tableau_is_told_with_the_condition_that_fails() -> None:
    """Where it is taken at other times than its sums; where it is nearly of a higher; at which dt."""
    condition = "of order 3, sum b_i a_ij c_j is 0, not 1/6"
    assert told("Order", seen=seen(tableau=HEUN)) == [f"Order 2, by the conditions on its tableau: {condition}"]
    untimed = replace(HEUN, c=(F(0), F(1, 2)))
    assert told("Order", seen=seen(tableau=untimed)) == [
        f"Order 2 where slopes do not depend on time, by the conditions on its tableau: {condition}"
    ]
    rough = Tableau(HEUN.a, (F(1, 2), 0.5 + 1e-9), HEUN.c)
    assert told("Order", seen=seen(tableau=rough))[0].endswith("; to six digits it is of order 2")
    updates = Updates(((X, V), (X, V)), (F(0), F(1)), (X, V))
    assert told("Order", seen=seen(tableau=HEUN, updates=updates), held=CHANGES)[0].startswith(
        "Order 2, by the conditions on its tableau, at dt = 0.25 and 0.125 s: "
    )
    words = name_line(explained(seen=seen(tableau=untimed)))
    assert words.endswith("of 2 stages and order 2 where slopes do not depend on time")


def test_slopes_are_counted_with_one_that_the_step_before_left() -> None:
    """And where they were seen, if that is not the same at every dt."""
    updates = Updates(((X, V), (X, V)), (F(0), F(1)), (X, V))
    assert told("Slopes", seen=seen(updates=updates)) == ["Slopes or forces taken in a step: 2"]
    assert told("Slopes", seen=seen(updates=replace(updates, reused=True))) == [
        "Slopes or forces taken in a step: 2, one of them that of the step before"
    ]
    assert told("Slopes", seen=seen(updates=updates), held=CHANGES) == [
        "Slopes or forces taken in a step: 2, at dt = 0.25 and 0.125 s"
    ]
    assert dict(sections(explained(seen=seen(updates=updates))))["Derived: the update formulas"][-2:] == [
        "x' = x",
        "v' = v",
    ]


def test_what_follows_from_a_step_matrix() -> None:
    """Limits by damping or drag, and under gravity of a rod; symplectic or not; what is implicit; periods."""
    damped = matrix(one(), over({ONE: F(1), B: F(1)}), damped=True)
    assert list(property_lines(explained(matrix=damped, follows=FOLLOWS))) == [
        "Implicit: equations are solved",
        "Order 2 without damping: 2 on the oscillator, 1 with damping",
        "Stable up to h w = 2 without damping",
        "Stable up to h c/m = 1.5 without stiffness",
        "Symplectic, and not reversible, without damping",
        "Implicit in damping",
        "At h w = 0.5: period x 1.25000, amplitude x 0.875 in a period",
    ]
    dragged = replace(damped, damped=False, dragged=True, of_swings=True)
    other = replace(FOLLOWS, symplectic=False, reversible=True, implicit=())
    lines = list(property_lines(explained(matrix=dragged, follows=other)))
    assert "Stable up to h Cd/m = 1.5 without gravity" in lines
    assert "Not symplectic, and reversible, without damping" in lines
    assert not [line for line in lines if line.startswith("Implicit")]


def test_limits_of_what_remembers_are_its_difference_equations() -> None:
    """Verlet in positions, with drag: stable to h w = 2; its matrix, of a first step, says nothing of it."""
    verlet = DifferenceEquation(
        (one(), Formula({ONE: F(-2), A: F(1), D: F(1)}), Formula({ONE: F(1), D: F(-1)})), False, True
    )
    damped = matrix(one(), Formula({B: F(1)}), damped=True)
    lines = list(property_lines(explained(pasts=REMEMBERS, difference=verlet, matrix=damped, follows=FOLLOWS)))
    assert "Stable up to h w = 2 without damping" in lines
    assert "Stable up to h Cd/m = 2 without stiffness" in lines
    assert not [line for line in lines if line.startswith(("Symplectic", "At h w"))]
    assert not [line for line in lines if "infinitely fast" in line]
    solved = DifferenceEquation(
        (Formula({ONE: F(1), A: F(1)}), Formula({ONE: F(-2)}), Formula({ONE: F(1), A: F(1, 4)})), False, False
    )
    said = told("What swings infinitely fast", pasts=REMEMBERS, difference=solved)
    assert said == ["What swings infinitely fast is multiplied by 0.5 in a step"]


def test_a_name_that_holds_at_other_dt_is_told_and_one_that_does_not_is_no_property() -> None:
    """What changes is said beside the name, and that no limits follow; what is seen at one h only says so itself."""
    assert told("It is heun", held=OverDts("heun", (0.1,))) == ["It is heun at dt = 0.1 s, too"]
    assert told("it", held=CHANGES) == []
    assert told("No limits", held=CHANGES, follows=FOLLOWS) == [
        "No limits of stability follow, as its rule is another at another dt"
    ]
    only = matrix(one(), one(), only_at=0.0625)
    assert told("No limits", matrix=only) == []
    assert told("Stable", matrix=only, follows=FOLLOWS) == []


def test_what_is_seen_of_oscillators_is_marked_with_their_dt_and_what_is_seen_of_slopes_with_theirs() -> None:
    """Of one stepper both are told, each where it was derived."""
    updates = Updates(((X, V),), (F(0),), (X, V))
    damped = matrix(one(), over({ONE: F(1), B: F(1)}), damped=True)
    lines = list(property_lines(explained(matrix=damped, follows=FOLLOWS, seen=seen(updates=updates), held=CHANGES)))
    assert lines == [
        "Explicit: no equations are solved",
        "Slopes or forces taken in a step: 1, at dt = 0.25 and 0.125 s",
        "Order 2 without damping: 2 on the oscillator, 1 with damping, at dt = 0.0625 s",
        "No limits of stability follow, as its rule is another at another dt",
        "Symplectic, and not reversible, without damping, at dt = 0.0625 s",
        "Implicit in damping, at dt = 0.0625 s",
        "At h w = 0.5: period x 1.25000, amplitude x 0.875 in a period, at dt = 0.0625 s",
    ]


def test_headings_say_at_which_dt_and_that_it_is_one_masss() -> None:
    """Slopes are read off at two dt, the step matrix at another; and a multistep method has its formula."""
    updates = Updates(((X, V),), (F(0),), (X, V))
    titles = [
        title
        for title, _ in sections(
            explained(
                seen=seen(updates=updates, tableau=HEUN, multistep=ADAMS), held=CHANGES, matrix=matrix(one(), one())
            )
        )
    ]
    assert [title for title in titles if title.startswith("Derived")] == [
        "Derived: a step of the damped oscillator, at dt = 0.0625 s",
        "Derived: the update formulas, at dt = 0.25 and 0.125 s",
        "Derived: the multistep method, at dt = 0.25 and 0.125 s",
        "Derived: the Butcher tableau, at dt = 0.25 and 0.125 s",
    ]
    found = dict(sections(explained(seen=seen(multistep=ADAMS))))
    assert found["Derived: the multistep method"] == ["y1 = y0 + 3 h f(y0)/2 - h f(y-1)/2"]
    lower = [title for title, _ in sections(explained(seen=seen(tableau=HEUN), order_among_masses=1))]
    assert "Derived: the Butcher tableau, as one mass shows it" in lower
    # of one that iterates its slopes are read off at those, too
    iterating = sections(explained(seen=seen(tableau=HEUN, iterates=True), held=CHANGES))
    assert iterating[0][0] == "Derived: the Butcher tableau, at dt = 0.25 and 0.125 s"
    outside = sections(explained(seen=seen(tableau=HEUN), held=CHANGES))
    assert outside[0][0] == "Derived: the Butcher tableau, at dt = 0.0625 s"


def test_a_multistep_method_without_a_name() -> None:
    """Explicit or not; of how many steps."""
    kind = "mine is not in the catalogue: {} multistep method of 2 steps and order {}"
    assert name_line(explained(seen=seen(multistep=ADAMS))) == kind.format("an explicit", 2)
    bdf = Multistep((F(4, 3), F(-1, 3)), (F(2, 3), F(0), F(0)))
    assert name_line(explained(seen=seen(multistep=bdf))) == kind.format("an implicit", 2)
