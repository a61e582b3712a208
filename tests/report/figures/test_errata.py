"""Two remarks: errors with their orders on the left, the two rules around a circle on the right."""

from __future__ import annotations

import numpy as np
import pytest

from report.figures import look
from tests.experiments.canned.errata import ORDERS, STEPS
from tests.report.figures.artists import data, horizontals, legend, line, marks, text, tick_labels
from tests.report.figures.shown import result, shown


def test_lines_on_the_left_are_the_errors_by_dt() -> None:
    """With their order in the legend."""
    axes = shown("errata").figure.axes[0]
    for i, (name, (_, order)) in enumerate(ORDERS.items()):
        found = line(axes, f"{name}: order {order:.2f}")
        steps, errors, _ = result("errata").data["orders"][name]
        assert data(found) == (steps, errors)
        assert (found.get_color(), found.get_marker()) == tuple(look(i).values())
    assert len(legend(axes)) == len(ORDERS)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("dt [s]", "error after 0.1 s [m]")
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert min(STEPS) > axes.get_xlim()[0] > 0


def test_lines_on_the_right_are_the_two_rules_by_the_place_on_the_circle() -> None:
    """Printed is dashed, -cos(2 angle) here; projected keeps all; each in the colour of its words."""
    axes = shown("errata").figure.axes[1]
    (projected,), (printed,) = marks(axes, linestyle="-"), marks(axes, linestyle="--")
    angles = np.linspace(0, 360, 9)
    assert data(projected) == (pytest.approx(angles), pytest.approx(np.ones(9)))
    assert data(printed) == (pytest.approx(angles), pytest.approx(-np.cos(2 * np.radians(angles))))
    assert text(axes, "projected").get_color() == projected.get_color() != printed.get_color()
    assert text(axes, "as printed").get_color() == printed.get_color()
    for said, curve in ((text(axes, "projected"), projected), (text(axes, "as printed"), printed)):
        assert said.xy == pytest.approx([values[0] for values in data(curve)])
    bottom, top = axes.get_ylim()
    assert -1.5 < bottom == -top < -1.1
    assert tick_labels(axes.xaxis) == {0: "right", 90: "top", 180: "left", 270: "bottom", 360: "right"}
    assert axes.get_ylabel() == "velocity along it that is kept [m/s of 1 m/s]"
    assert horizontals(axes) == [0]


def test_the_words_for_it_have_orders_and_extremes() -> None:
    """Of what is drawn."""
    alt = shown("errata").alt
    assert "heun 2.00, heun_link_by_link 1.00" in alt
    assert "printed rule between -1 and 1 m/s" in alt
