"""Drape: coefficients of cloths in their columns, means in the sentences."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.drape import COARSE, DENSITY, LENGTHS, PATIENCE, SPACING, result_of
from tests.experiments.canned import drape
from tests.experiments.canned.drape import AMPLITUDE, cloth, coefficient
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_each_number_in_its_column() -> None:
    """Rigidity is weight times the bending length cubed."""
    rows = records(drape.usual())
    for row in rows[: 2 * len(LENGTHS)]:
        length = row["bending length [m]"]
        assert row["rigidity [N m]"] == pytest.approx(DENSITY * 9.81 * length**3)
        assert row["drape coefficient [1]"] == pytest.approx(coefficient(length) + 0.01 * row["sample"])
        assert (row["folds"], row["their amplitude [m]"]) == (6, pytest.approx(AMPLITUDE))
    assert (rows[-1]["stepper"], rows[-1]["spacing [m]"], rows[-1]["drape coefficient [1]"]) == (
        "an_engine",
        COARSE,
        0.25,
    )


def test_the_first_sentence_goes_from_the_limpest_to_the_stiffest() -> None:
    """Means of two pieces, which differ by a hundredth."""
    said = finding(drape.usual(), "rises from")
    low, high = (coefficient(c) + 0.005 for c in (LENGTHS[0], LENGTHS[-1]))
    assert numbers(said) == pytest.approx([low, high, 1e3 * LENGTHS[0], 1e3 * LENGTHS[-1], 0.01], abs=0.006)
    assert "at every step" in said


def test_a_coefficient_that_falls_is_counted() -> None:
    """One of five steps."""
    cloths = [dict(one) for one in drape.usual().data["cloths"]]
    for one in cloths:
        if one["length"] == LENGTHS[3] and one["spacing"] == SPACING:
            one["coefficient"] = 0.01
    assert "but for 1 of 5 steps" in finding(result_of(cloths), "rises from")


def test_engines_are_compared_with_the_reference_on_the_same_cloth() -> None:
    """0.25 with 0.30."""
    said = finding(drape.usual(), "Engines on the same cloths")
    assert numbers(said) == pytest.approx([1e3 * COARSE, 0.05])
    assert "an_engine" in said
    assert not [said for said in drape.usual(engine=False).findings if "Engines" in said]


def test_the_mesh_is_said_to_matter_by_its_means() -> None:
    """Of each spacing that there is, the finest first."""
    other = cloth("kick_drift", 0.017, 0.012, 0, 0.40)
    said = finding(result_of([*drape.usual().data["cloths"], other]), "The mesh matters")
    assert numbers(said) == pytest.approx([17, coefficient(0.017) + 0.005, 7.5, 0.40, 12], abs=0.006)
    assert in_order(said, "7.5 mm", "0.40 at 12 mm")


def test_folds_are_the_least_and_the_most() -> None:
    """Six here."""
    assert numbers(finding(drape.usual(), "folds")) == [6, 6]


def test_cloths_without_folds_are_counted() -> None:
    """Two of all are round: 6 to 6 folds is not said of those."""
    cloths = [dict(one) for one in drape.usual().data["cloths"]]
    for one in cloths[:2]:
        one["outline"] = np.full_like(one["outline"], 0.1)
    alike = sum(one["spacing"] == SPACING for one in cloths)
    assert numbers(finding(result_of(cloths), "folds")) == [6, 6, 2, alike, 1]
    for one in cloths:
        one["outline"] = np.full_like(one["outline"], 0.1)
    assert numbers(finding(result_of(cloths), "folds")) == []


def test_cloths_that_still_move_are_counted() -> None:
    """Two, of which the faster is told; they are no cloths at rest, however long one has waited."""
    cloths = [dict(one) for one in drape.usual().data["cloths"]]
    cloths[0]["speed"], cloths[3]["speed"] = 2e-3, 0.03
    assert numbers(finding(result_of(cloths), "still move")) == [2, len(cloths), PATIENCE, 30, 1]
    assert not [said for said in drape.usual().findings if "still move" in said]


def test_without_a_cloth_there_is_a_sentence() -> None:
    """And no traceback."""
    assert len(result_of([], ["kick_drift: crashed"]).findings) == 1


def test_the_widest_scatter_is_told_whichever_cloth_it_is_of() -> None:
    """Of the second stiffest, in the middle of the table."""
    cloths = [dict(one) for one in drape.usual().data["cloths"]]
    wide = [one for one in cloths if one["length"] == LENGTHS[1] and one["spacing"] == SPACING]
    wide[0]["coefficient"] -= 0.02
    assert numbers(finding(result_of(cloths), "rises from"))[-1] == pytest.approx(0.03)
