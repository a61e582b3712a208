"""The page of derived formulas: what is derived now, of every scheme and engine, and all of it the catalogue's."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.engine import registry
from reference.derivation.difference_equation import difference_equation
from reference.derivation.multistep import Multistep
from reference.derivation.oscillators import runs_of
from reference.derivation.seen import NOTHING
from reference.derivation.step_matrix import step_matrix
from reference.derivation.tableau import Tableau
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import Scheme, find
from reference.schemes.structural import hht
from reference.state import Array, State
from reference.stepper import SchemeStepper
from report.derived_table import FILE, _alike, _order, _same, _table, engine_rows, line_of, row_of, steppers
from report.listings import stepper_rows
from tests import wrong

PAGE = FILE.read_text(encoding="utf-8")


@pytest.mark.rotating(8)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", steppers())
def test_a_schemes_row_is_what_is_derived(name: str) -> None:
    """Now, word for word."""
    assert line_of(row_of(name)) in PAGE.splitlines()


def test_every_scheme_and_engine_has_a_row_and_none_is_another_than_the_catalogues() -> None:
    """A row that is not says so in bold; one that has nothing says why."""
    rows = [line for line in PAGE.splitlines() if line.startswith("| `")]
    names = [line.split("`")[1] for line in rows]
    assert names == [*steppers(), *registry()]
    assert rows[len(steppers()) :] == [line_of(row) for row in engine_rows()]
    assert not [row for row in rows if "**" in row]


def test_all_that_is_listed_is_in_the_table() -> None:
    """As `springlab list` has it."""
    assert {str(name) for name, *_ in stepper_rows().rows} <= set(steppers())


def test_a_mistake_is_told_in_the_table() -> None:
    """Heun without its half, held against Heun."""
    wrongly = step_matrix(runs_of(SchemeStepper(wrong.heun_without_half)))
    assert _same(find("heun"), wrongly, None) == "**no**"
    assert _same(wrong.heun_without_half, wrongly, None) == "yes"


@pytest.mark.parametrize(
    ("linear", "off", "same"),
    [(True, 0.5, "yes"), (True, 2.0, "**no**"), (False, 2.0, "yes"), (False, 500.0, "yes"), (False, 2000.0, "**no**")],
)
def test_what_is_linear_is_held_to_a_billionth_and_other_things_to_a_millionth(
    linear: bool, off: float, same: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of which differences are taken about a rest. Theory has another matrix at each oscillator."""
    monkeypatch.setattr("report.derived_table._by_theory", lambda scheme, a, b, d: np.diag([a, b + d]))
    monkeypatch.setattr("report.derived_table.A", (1.0, 2.0))
    monkeypatch.setattr("report.derived_table.B", (3.0, 5.0))

    def at(a: Array, b: Array, d: Array) -> Array:
        return np.array([np.diag([a[0] + 1e-9 * off * (a[0] == 2.0), b[0] + d[0]])])

    matrix: Any = SimpleNamespace(damped=True, dragged=True, at=at)
    scheme: Any = SimpleNamespace(linear=linear)
    assert _same(scheme, matrix, None) == same
    assert _alike(np.full((2, 2), 1e-9), np.zeros((2, 2)), 1e-9)


def test_a_mistake_in_what_is_remembered_is_told() -> None:
    """HHT that loses a part of the acceleration it keeps, held against HHT; its first step is the same."""

    def forgetful(motion: MotionOfSprings, state: State, dt: float) -> State:
        end = hht(motion, state, dt)
        return end.remembering(0.9 * end.memory[0])

    mine = Scheme(forgetful, 2, "wide_scheme", implicit=True, linear=False, one_step=False)
    runs = runs_of(SchemeStepper(mine))
    matrix, difference = step_matrix(runs), difference_equation(runs)
    assert _same(find("hht"), matrix, difference) == "**no**"
    assert _same(mine, matrix, difference) == "yes"


def test_matrices_are_held_against_each_other_entry_by_entry() -> None:
    """The largest difference counts; of what remembers the roots, beside zeros, by whatever the first is multiplied."""
    one = np.array([[1.0, 2.0], [3.0, 4.0]])
    for place in ((0, 0), (0, 1), (1, 0), (1, 1)):
        other = one.copy()
        other[place] += 2e-9
        assert (_alike(other, one, 1e-9), _alike(other, one, 3e-9)) == (False, True)
    swung = np.array([[0.5, 1.0, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 0.0]])  # z^3 - z^2 + 3 z/4
    polynomial = np.array([2.0, -2.0, 1.5])
    assert _alike(polynomial, swung, 1e-9)
    assert _alike(np.array([1.0, -1.0, 0.75, 0.0, 0.0]), swung, 1e-9)
    for i in (1, 2):
        assert not _alike(polynomial + 1e-5 * np.eye(3)[i], swung, 1e-9)
    assert not _alike(np.array([2.0, -2.0, 1.5, 1e-5]), swung, 1e-9)


def test_orders_are_those_of_what_tells_most() -> None:
    """A tableau's, a multistep method's, a difference equation's, a step matrix's without damping; else none."""
    matrix = step_matrix(runs_of(SchemeStepper(find("heun"))))
    tableau = Tableau(((Fraction(0),),), (Fraction(1),), (Fraction(0),))
    bdf3 = Multistep(*(tuple(map(Fraction, row.split())) for row in ("18/11 -9/11 2/11", "6/11 0 0 0")))
    assert _order(NOTHING, None, None) == "-"
    assert _order(NOTHING, matrix, None) == "2"
    assert _order(NOTHING._replace(multistep=bdf3), matrix, None) == "3"
    assert _order(NOTHING._replace(multistep=bdf3, tableau=tableau), matrix, None) == "1"


def test_a_table_has_a_line_below_its_head() -> None:
    """Bars within cells do not end them."""
    assert _table(["a", "b"], [["1", "x | y"]]) == ["| a | b |", "| --- | --- |", "| 1 | x \\| y |"]


def test_one_sub_step_too_few_is_told() -> None:
    """Three of XPBD held against its five."""
    three = step_matrix(runs_of(SchemeStepper(find("xpbd_gauss_seidel(substeps=3)"))))
    assert three.substeps == 3
    assert _same(find("xpbd_gauss_seidel"), three, None) == "**no**"
    assert _same(find("xpbd_gauss_seidel"), replace(three, substeps=5), None) == "yes"
