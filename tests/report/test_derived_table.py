"""The page of derived formulas: what is derived now, of every scheme and engine, and all of it the catalogue's."""

from __future__ import annotations

import pytest

from reference.derivation.oscillators import runs_of
from reference.derivation.step_matrix import step_matrix
from reference.schemes.catalogue import find
from reference.stepper import SchemeStepper
from report.derived_table import FILE, _same, engine_rows, line_of, row_of, schemes
from tests import wrong

PAGE = FILE.read_text(encoding="utf-8")


@pytest.mark.rotating(8)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", schemes())
def test_a_schemes_row_is_what_is_derived(name: str) -> None:
    """Now, word for word."""
    assert line_of(row_of(name)) in PAGE.splitlines()


def test_every_scheme_and_engine_has_a_row_and_none_is_another_than_the_catalogues() -> None:
    """A row that is not says so in bold."""
    rows = [line for line in PAGE.splitlines() if line.startswith("| `")]
    assert [line.split("`")[1] for line in rows[: len(schemes())]] == list(schemes())
    assert rows[len(schemes()) :] == [line_of(row) for row in engine_rows()]
    assert not [row for row in rows if "**" in row]


def test_a_mistake_is_told_in_the_table() -> None:
    """Heun without its half, held against Heun."""
    wrongly = step_matrix(runs_of(SchemeStepper(wrong.heun_without_half)))
    assert _same(find("heun"), wrongly) == "**no**"
    assert _same(wrong.heun_without_half, wrongly) == "yes"
