"""Coefficients of implicit multistep methods, of schemes and of files as users write them; numbers with roots."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import in_this_process
from reference.derivation.explanation import explain
from reference.derivation.implicit import implicit_multistep
from reference.derivation.irrational import irrational
from reference.derivation.multistep import Multistep
from reference.derivation.seen import slopes_of
from reference.schemes.catalogue import find
from report.derived import name_line, sections

#: Methods of two steps, solved by iteration as users would; the first step is another method's.
FILE = """
before = None


def step(f, y, t, dt):
    global before
    old = (y, f(y)) if before is None else before
    new = y + dt * f(y)
    for _ in range(80):
        if before is None:
            new = y + dt * f(new)
        else:
            new = {formula}
    before = (y, f(y))
    return new
"""
BDF2 = "4 / 3 * y - 1 / 3 * old[0] + 2 / 3 * dt * f(new)"
ADAMS_MOULTON = "y + dt / 12 * (5 * f(new) + 8 * f(y) - old[1])"


def file(folder: Path, formula: str) -> OwnStepper:
    """It as a stepper of this process."""
    path = folder / "mine.py"
    path.write_text(FILE.format(formula=formula), encoding="utf-8")
    return OwnStepper(own_stepper(str(path)).engine, isolate=in_this_process)


@pytest.mark.parametrize(
    ("formula", "alpha", "beta", "order"),
    [
        (BDF2, ("4/3", "-1/3"), ("2/3", "0", "0"), 2),
        (ADAMS_MOULTON, ("1", "0"), ("5/12", "2/3", "-1/12"), 3),
        (BDF2.replace("2 / 3 * dt", "dt / 2"), ("4/3", "-1/3"), ("1/2", "0", "0"), 0),
    ],
)
def test_coefficients_are_read_off_a_row_of_steps(
    formula: str, alpha: tuple[str, ...], beta: tuple[str, ...], order: int, tmp_path: Path
) -> None:
    """As the formula has them (HNW III.1: BDF2, Adams-Moulton of two steps); a wrong one as it is: of order 0."""
    found = slopes_of(file(tmp_path, formula), []).multistep
    assert found == Multistep(tuple(map(Fraction, alpha)), tuple(map(Fraction, beta)))
    assert (found.order, found.explicit) == (order, False)


def test_the_catalogues_own_is_derived_and_told() -> None:
    """BDF2, from springs that turn; methods of one step, and those of other forms, have none."""
    bdf2 = implicit_multistep(find("bdf2"))
    assert str(bdf2) == "y1 = 4 y0/3 - y-1/3 + 2 h f(y1)/3"
    assert [implicit_multistep(find(name)) for name in ("newmark", "hht", "backward_euler", "heun")] == [None] * 4


@pytest.mark.rotating(5)
def test_a_file_is_told_as_what_it_is(tmp_path: Path) -> None:
    """Not as its first step, which is backward Euler's."""
    found = explain(file(tmp_path, ADAMS_MOULTON))
    assert found.tableau is None
    assert (found.order, found.explicit, found.document["one_step"]) == (3, False, False)
    assert "an implicit multistep method of 2 steps and order 3" in name_line(found)
    assert "Derived: the multistep method" in dict(sections(found))


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (1 - 2**0.5 / 2, "1 - sqrt(2)/2"),
        (0.5 + 3**0.5 / 6, "1/2 + sqrt(3)/6"),
        ((296 - 169 * 6**0.5) / 1800, "37/225 - 169 sqrt(6)/1800"),
        (-(2 ** (1 / 3)) / (2 - 2 ** (1 / 3)), "-1/3 - 2 cbrt(2)/3 - cbrt(4)/3"),
        (1 - 2**0.5 / 2 + 1e-12, None),
        (35 / 384, None),
    ],
)
def test_numbers_with_roots_are_told_where_they_are_that_to_rounding(x: float, text: str | None) -> None:
    """Of SDIRK, Gauss, Radau IIA of three stages (its a12), Yoshida; none a little off, none of a fraction."""
    assert irrational(x) == text


def test_chance_gives_no_roots() -> None:
    """Of 300 random numbers none: one in a hundred thousand is expected."""
    assert not any(irrational(float(x)) for x in np.random.default_rng(2).uniform(-2, 2, 300))
