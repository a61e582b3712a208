"""The stability region: the derived limit and the measured marks agree, and all of it can be read."""

from __future__ import annotations

import numpy as np
import pytest

from reference.derivation.explanation import explain
from reference.stepper import catalogued
from report.figures.explain import draw
from tests.report.figures.artists import cut_off, data, laid_out, line, overlaps, unlabelled


@pytest.mark.rotating(4)
@pytest.mark.parametrize("name", ["rk4", "kick_drift", "backward_euler", "pendulum_heun"])
def test_all_of_it_can_be_read(name: str) -> None:
    """Axes with units, nothing over anything else; also where there is no region."""
    stepper = catalogued()[name]
    figure = laid_out(draw(explain(stepper), stepper).figure)
    assert overlaps(figure) == cut_off(figure) == []
    assert name == "pendulum_heun" or unlabelled(figure) == []


def test_marks_are_where_kick_drift_grows() -> None:
    """With damping explicit: it grows where h^2 k/m > 4 - 2 h c/m or h c/m > 2 (Jury's conditions by hand)."""
    stepper = catalogued()["kick_drift"]
    (axes,) = draw(explain(stepper), stepper).figure.axes
    for label, grows in (("measured: grows", True), ("measured: does not grow", False)):
        w, b = map(np.array, data(line(axes, label)))
        assert len(w)
        assert ((w**2 > 4 - 2 * b) == grows).all()
