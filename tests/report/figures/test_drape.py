"""Drape coefficients by bending length; cloths and their shadows below."""

from __future__ import annotations

from unittest.mock import MagicMock

import numpy as np
import pytest

from experiments.drape import COARSE, LENGTHS, RADIUS, SPACING, SUPPORT, rows_of
from reference.scenes.drape import disc
from report.figures import look
from report.figures.drape import SHOWN, _cloth
from tests.experiments.canned.drape import AMPLITUDE, coefficient
from tests.experiments.canned.reading import numbers, records
from tests.report.figures.artists import data, legend, marks
from tests.report.figures.shown import result, shown


def test_points_are_the_table_in_millimetres_full_for_the_reference() -> None:
    """A marker for each stepper and spacing; hollow for engines."""
    axes = next(a for a in shown("drape").figure.axes if "bending" in a.get_xlabel())
    table = records(result("drape"))
    kinds = {
        f"{by}, {1e3 * spacing:g} mm between masses": (by, spacing)
        for by, spacing in (("kick_drift", SPACING), ("kick_drift", COARSE), ("an_engine", COARSE))
    }
    assert [*legend(axes)] == [*kinds]
    for points, (by, spacing) in zip(axes.collections, kinds.values(), strict=True):
        rows = [row for row in table if (row["stepper"], row["spacing [m]"]) == (by, spacing)]
        expected = [[1e3 * row["bending length [m]"], row["drape coefficient [1]"]] for row in rows]
        assert np.asarray(points.get_offsets()) == pytest.approx(np.array(expected))
        assert (len(points.get_facecolor()) == 0) == (by == "an_engine")
    (means,) = marks(axes, color=look(0)["color"])
    assert data(means) == (
        pytest.approx([1e3 * c for c in LENGTHS]),
        pytest.approx([coefficient(c) + 0.005 for c in LENGTHS]),
    )


def test_axes_have_units() -> None:
    """Bending lengths on a logarithm; coefficients from 0 to 1; shadows as wide as they are."""
    coefficients, *shadows = [a for a in shown("drape").figure.axes if a.name != "3d"][::-1]
    by_label = {a.get_xlabel(): a for a in (coefficients, *shadows)}
    plot, shadow = by_label["bending length [mm]"], by_label["x [mm]"]
    assert plot.get_ylabel() == "drape coefficient, measured [1]"
    assert (plot.get_xscale(), plot.get_ylim()) == ("log", (0, 1))
    assert (shadow.get_ylabel(), shadow.get_aspect()) == ("z [mm]", 1.0)


def test_shadows_are_the_outlines_with_disc_and_flat_cloth() -> None:
    """Of the first sample of three bending lengths; the disc is solid, the cloth dotted; numbers above are theirs."""
    shadows = [a for a in shown("drape").figure.axes if a.get_xlabel() == "x [mm]"]
    for axes, length in zip(shadows, SHOWN, strict=True):
        (outline,) = axes.patches
        reach = np.hypot(*outline.get_xy()[:-1].T)
        assert (reach.min(), reach.max()) == pytest.approx((1e3 * (0.12 - AMPLITUDE), 1e3 * (0.12 + AMPLITUDE)))
        (disc,), (flat,) = marks(axes, linestyle="-"), marks(axes, linestyle=":")
        for circle, radius in ((disc, SUPPORT), (flat, RADIUS)):
            assert np.hypot(*data(circle)) == pytest.approx(np.full(len(data(circle)[0]), 1e3 * radius))
        assert axes.get_title().endswith(" folds of 10 mm")
        assert numbers(axes.get_title()) == pytest.approx([coefficient(length), 6, 1e3 * AMPLITUDE], abs=0.005)


def test_cloths_are_where_their_masses_are() -> None:
    """In millimetres, height upwards."""
    cloths = [a for a in shown("drape").figure.axes if a.name == "3d"]
    assert [numbers(a.get_title()) for a in cloths] == [[pytest.approx(1e3 * c)] for c in SHOWN]
    assert cloths[0].get_xlim() == cloths[0].get_ylim() == pytest.approx((-1e3 * RADIUS, 1e3 * RADIUS))
    one, axes = result("drape").data["cloths"][0], MagicMock()
    _cloth(axes, one)
    (x, z, y), options = axes.plot_trisurf.call_args
    assert np.column_stack([x, y, z]) == pytest.approx(1e3 * one["positions"])
    assert np.array_equal(options["triangles"], disc(RADIUS, SPACING, 0).triangles)
    limits = [getattr(axes, f"set_{name}lim").call_args.args for name in "xyz"]
    for (low, high), values in zip(limits, (x, z, y), strict=True):
        assert low <= values.min() + 1e-9
        assert values.max() - 1e-9 <= high
    spans = [high - low for low, high in limits]
    (box,), _ = axes.set_box_aspect.call_args
    assert np.array(spans) / box == pytest.approx([1e3] * 3)  # nothing is stretched
    assert axes.view_init.call_args.kwargs["elev"] > 15  # from above


def test_the_words_for_it_have_the_means() -> None:
    """Of the reference's samples."""
    for c, mean, _ in rows_of(result("drape").data["cloths"], SPACING):
        assert f"{1e3 * c:g} mm: {mean:.2f}" in shown("drape").alt


def test_cloths_are_shown_in_the_order_of_their_stiffness() -> None:
    """From the limpest of all on."""
    assert list(SHOWN) == sorted({*SHOWN} & {*LENGTHS})
    assert SHOWN[0] == min(LENGTHS)
