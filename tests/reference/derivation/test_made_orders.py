"""Orders of runs that are made here, by their errors; and difference equations, by matrices and by hand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.difference_equation import DifferenceEquation, difference_equation
from reference.derivation.formula import ONE, Formula
from reference.derivation.nonlinear_order import END_OF_ONE, END_OF_TWO, nonlinear_order, order_of_two_masses
from reference.derivation.oscillators import ASIDE, Run, Runs
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.state import Trajectory
from tests.reference.derivation.test_made_runs import kick_drift, runs_of

# --- Orders ---


def ending(errors: Callable[[float], float], steps: int = 0) -> Runs:
    """Runs that end beside the true end by errors of a dt [m]; of so many steps more than were asked for."""

    def runs(asked: Sequence[Run]) -> list[Outcome]:
        found = []
        for system, dt, n in asked:
            end = (END_OF_ONE if len(system.masses) == 2 else END_OF_TWO).copy()
            end[1, 0] += errors(dt)
            end[-1, 1] -= errors(dt) / 2
            x = np.stack([system.positions] * (n + steps) + [end])
            found.append(Outcome("done", "", Trajectory(dt * np.arange(n + steps + 1.0), x, np.zeros_like(x))))
        return found

    return runs


@pytest.mark.parametrize(
    ("errors", "order"),
    [
        (lambda dt: dt, 1),
        (lambda dt: dt**2, 2),
        (lambda dt: dt**1.75, 2),
        (lambda dt: dt**2.25, 2),
        (lambda dt: dt**1.65, None),
        (lambda dt: dt**2.35, None),
        (lambda dt: 1.0, 0),
        (lambda dt: 1e-13, None),  # rounding tells nothing
        (lambda dt: dt**2 if dt > 0.03 else 1e-13, 2),  # by what is above it
        (lambda dt: dt**2 if dt < 0.05 else dt / 32, 2),  # at the shortest
        (lambda dt: np.nan if dt < 0.02 else dt, None),
    ],
)
def test_an_order_is_told_within_three_tenths(errors: Callable[[float], float], order: int | None) -> None:
    """By the largest error of any mass and axis, at the shortest steps that tell."""
    assert nonlinear_order(ending(errors), False, False) == order
    assert order_of_two_masses(ending(errors)) == order


def test_a_run_that_does_not_come_to_its_end_tells_no_order() -> None:
    """One that has another number of steps; none; a stepper that cannot."""

    def cannot(asked: Sequence[Run]) -> list[Outcome]:
        raise Unsupported("not across")

    assert nonlinear_order(ending(lambda dt: dt**2, 1), False, False) is None
    assert nonlinear_order(lambda asked: [Outcome("crashed", "gone")] * len(asked), False, False) is None
    assert nonlinear_order(cannot, False, False) is None


# --- Difference equations ---


def test_a_matrix_has_the_difference_equation_of_its_trace_and_determinant() -> None:
    """X1 = T x0 - D x-1 (Cayley and Hamilton); of one that refuses damping without it."""
    found = difference_equation(runs_of(kick_drift))
    assert found.text() == ["1", "-2 + b + d + a", "1 - b - d"]
    assert (found.damped, found.dragged, found.explicit, found.order, found.of_fast) == (True, True, True, 2, None)
    undamped = difference_equation(runs_of(kick_drift, lambda system: "no damping" if system.damping.any() else ""))
    assert (undamped.damped, undamped.dragged) == (False, True)

    def but_for_one(asked: Sequence[Run]) -> list[Outcome]:
        outcomes = runs_of(kick_drift)(asked)
        for outcome in outcomes:
            assert outcome.trajectory is not None
            steps = np.arange(len(outcome.trajectory))
            outcome.trajectory.positions[:, 1, 0] += 1e-3 * ASIDE * np.sin(steps**2)
        return outcomes

    with pytest.raises(Unsupported, match="its positions follow no linear equation of up to 8 steps back"):
        difference_equation(but_for_one)
    with pytest.raises(Unsupported, match=r"^not now$"):
        difference_equation(runs_of(kick_drift, lambda system: "not now"))


def test_orders_of_difference_equations_by_hand() -> None:
    """Of x1 - 2 x0 + x-1 + a (beta x1 + (1 - 2 beta) x0 + beta x-1): Numerov's 4 at beta = 1/12, else 2."""
    a = (1, 0, 0, 0, 0)

    def of(beta: Fraction, middle: Fraction) -> DifferenceEquation:
        side = Formula({ONE: Fraction(1), a: beta}) if beta else Formula({ONE: Fraction(1)})
        return DifferenceEquation((side, Formula({ONE: Fraction(-2), a: middle}), side), False, False)

    orders = {Fraction(1, 12): 4, Fraction(1, 4): 2, Fraction(0): 2}
    assert {beta: of(beta, 1 - 2 * beta).order for beta in orders} == orders
    assert of(Fraction(1, 4), Fraction(1, 3)).order == 0
    assert [of(beta, 1 - 2 * beta).explicit for beta in orders] == [False, False, True]
    assert of(Fraction(1, 4), Fraction(1, 2)).of_fast == pytest.approx(1.0, abs=1e-7)
    assert (of(Fraction(1, 4), Fraction(1, 2)).real_axis, of(Fraction(0), Fraction(1)).of_fast) == (None, None)
    # stable to h w = 2 where explicit, and to sqrt(6) of Numerov's
    for beta, limit in ((Fraction(0), 2.0), (Fraction(1, 12), 6**0.5)):
        assert of(beta, 1 - 2 * beta).imaginary_axis[0][1] == pytest.approx(limit, rel=1e-6)
