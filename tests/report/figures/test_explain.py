"""The stability region: the derived limit and the measured marks agree, and all of it can be read."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference.derivation.consequences import FAR
from reference.derivation.explanation import explain
from reference.derivation.fit import Samples
from reference.state import Array
from reference.stepper import catalogued
from report.figures import COLOURS, Picture
from report.figures import explain as module
from report.figures.explain import draw
from tests.report.figures.artists import cut_off, data, laid_out, line, odd_measures, overlaps, unlabelled


@pytest.mark.rotating(4)
@pytest.mark.parametrize("name", ["rk4", "kick_drift", "backward_euler", "pendulum_heun"])
def test_all_of_it_can_be_read(name: str) -> None:
    """Axes with units, nothing over anything else; also where there is no region."""
    stepper = catalogued()[name]
    figure = laid_out(draw(explain(stepper), stepper).figure)
    assert overlaps(figure) == odd_measures(figure) == cut_off(figure) == []
    assert name == "pendulum_heun" or unlabelled(figure) == []


def test_marks_are_where_kick_drift_grows() -> None:
    """With damping explicit: it grows where h^2 k/m > 4 - 2 h c/m or h c/m > 2 (Jury's conditions by hand)."""
    stepper = catalogued()["kick_drift"]
    (axes,) = draw(explain(stepper), stepper).figure.axes
    for label, grows in (("measured: grows", True), ("measured: does not grow", False)):
        w, b = map(np.array, data(line(axes, label)))
        assert len(w)
        assert ((w**2 > 4 - 2 * b) == grows).all()


def made_up(damped: bool, dragged: bool, of_swings: bool = False) -> Any:
    """An explanation whose step grows where w > 1, or h c/m > 0.5, or h Cd/m > 2."""

    def at(a: Array, b: Array, d: Array) -> Array:
        growth = np.maximum(np.maximum(a, b / 0.5), d / 2)
        return np.stack([np.stack([growth, 0 * a], axis=-1), np.stack([0 * a, 0 * a], axis=-1)], axis=-1)

    matrix = SimpleNamespace(damped=damped, dragged=dragged, of_swings=of_swings, at=at)
    follows = SimpleNamespace(imaginary_axis=((0.0, 1.0), (2.0, 3.0)), real_axis=((0.0, 2.0),))
    return SimpleNamespace(stepper="mine", matrix=matrix, follows=follows, reasons=())


def drawn(explanation: Any, monkeypatch: pytest.MonkeyPatch, spoil: Callable[[Array], Array] = lambda m: m) -> Picture:
    """Where what is measured is what is derived, or that spoilt."""

    def measured(runs: object, samples: Samples) -> Array:
        assert runs == "runs of heun"
        matrices: Array = explanation.matrix.at(samples.a, samples.b, samples.d)
        return spoil(matrices)

    def none(runs: object, samples: Samples) -> Array:
        raise AssertionError("the other is to be measured")

    swings = explanation.matrix.of_swings
    monkeypatch.setattr(module, "runs_of", lambda stepper: f"runs of {stepper.name}")
    monkeypatch.setattr(module, "swing_matrices", measured if swings else none)
    monkeypatch.setattr(module, "matrices_at", none if swings else measured)
    return draw(explanation, catalogued()["heun"])


@pytest.mark.parametrize(
    ("damped", "dragged", "letter", "most"),
    [(True, False, "h c/m [1]", 0.5), (True, True, "h c/m [1]", 0.5), (False, True, "h Cd/m [1]", 2.0)],
)
@pytest.mark.parametrize("of_swings", [False, True])
def test_marks_are_by_the_damping_that_a_step_can_do(
    damped: bool, dragged: bool, letter: str, most: float, of_swings: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The spring's where it has one, or else drag; the plane goes a little beyond both limits."""
    picture = drawn(made_up(damped, dragged, of_swings), monkeypatch)
    (axes,) = picture.figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("h w = h sqrt(k/m) [1]", letter)
    assert (axes.get_xlim(), axes.get_ylim()) == ((0, pytest.approx(1.3)), (0, pytest.approx(2.6)))
    stays, grows = (np.array(data(line(axes, f"measured: {word}"))) for word in ("does not grow", "grows"))
    assert ((stays[0] < 1) & (stays[1] < most)).all()
    assert ((grows[0] > 1) | (grows[1] > most)).all()
    assert stays.shape[1] + grows.shape[1] == 81
    assert len(np.unique(stays[0])) < 9 == len(np.unique(grows[0]))
    assert "81 measured steps 81 agree" in picture.alt
    part = 100 * min(1.0, most / 2.6) / 1.3
    assert f"derived, {part:.0f}% of the plane" in picture.alt
    warm, cold = (line(axes, f"measured: {word}") for word in ("grows", "does not grow"))
    assert warm.get_marker() != cold.get_marker()
    assert (warm.get_color(), cold.get_color()) == (COLOURS[1], COLOURS[0])


def test_without_damping_marks_are_on_the_axis(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a step that can do none; nine different h w."""
    explanation = made_up(False, False)
    explanation.follows.real_axis = None
    (axes,) = drawn(explanation, monkeypatch).figure.axes
    assert axes.get_ylabel() == "no damping: it can do none"
    assert axes.get_ylim() == (0, 1)
    x, y = np.concatenate([np.array(data(line(axes, f"measured: {w}"))) for w in ("grows", "does not grow")], axis=1)
    assert not y.any()
    assert len(np.unique(x)) == 9


def test_how_many_measured_steps_agree_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two that do not grow where it is derived that they do."""

    def spoil(matrices: Array) -> Array:
        growing = np.flatnonzero(matrices[:, 0, 0] > 1)
        return np.where(np.isin(np.arange(81), growing[:2])[:, None, None], 0.5, matrices)

    assert "of 81 measured steps 79 agree with it" in drawn(made_up(True, False), monkeypatch, spoil).alt


@pytest.mark.parametrize(
    ("limit", "shown"), [(0.2, 1.0), (1.0, 1.3), (2.0, 2.6), (3.0, 3.9), (4.0, 5.0), (90.0, 5.0), (FAR, 4.0)]
)
def test_the_plane_goes_somewhat_beyond_the_first_limits(
    limit: float, shown: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By 30 %, at least to 1, at most to 5; to 4 where there is no limit."""
    explanation = made_up(True, False)
    explanation.follows.imaginary_axis = ((0.0, limit), (2 * limit, 3 * limit))
    (axes,) = drawn(explanation, monkeypatch).figure.axes
    assert axes.get_xlim() == (0, pytest.approx(shown))


@pytest.mark.parametrize(("reasons", "said"), [(("first", "second"), "first"), ((), "no step matrix")])
@pytest.mark.parametrize("missing", ["matrix", "follows"])
def test_without_a_step_matrix_it_is_said_why(reasons: tuple[str, ...], said: str, missing: str) -> None:
    """In the picture and in the words for it."""
    explanation = made_up(True, False)
    setattr(explanation, missing, None)
    explanation.reasons = reasons
    picture = draw(explanation, catalogued()["heun"])
    (axes,) = picture.figure.axes
    (text,) = axes.texts
    assert (text.get_text(), text.get_wrap()) == (said, True)
    assert picture.alt == f"No stability region of mine: {said}."
