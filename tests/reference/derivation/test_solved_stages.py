"""Stages of steppers that solve them by Newton's iteration: a Jacobian's differences and what is left are none."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from engines.own.stepper import OwnStepper, stepper_of
from reference.derivation.oscillators import runs_of
from reference.derivation.seen import beside_steps, slopes_of
from reference.derivation.tableau import Tableau
from reference.state import Array

S3, G = np.sqrt(3), 1 - 1 / np.sqrt(2)


def newton(f: Callable[[Array], Array], k: Array) -> Array:
    """The root of f near k, to rounding, by a Jacobian of forward differences."""
    for _ in range(20):
        left, n = f(k), len(k)
        jacobian = np.empty((n, n))
        for i in range(n):
            by = 1e-7 * max(1, abs(k[i]))
            jacobian[:, i] = (f(k + by * np.eye(n)[i]) - left) / by
        off = np.linalg.solve(jacobian, left)
        k = k - off
        if np.abs(off).max() < 1e-14 * max(1, np.abs(k).max()):
            break
    return k


def gauss(f: Any, y: Array, t: float, dt: float) -> Array:
    """Gauss' method of two stages (Hairer and Wanner 1996, table IV.5.1), both solved for together."""
    n = len(y)

    def left(k: Array) -> Array:
        a, b = k[:n], k[n:]
        first = f(y + dt * (a / 4 + (1 / 4 - S3 / 6) * b), t)
        return k - np.concatenate([first, f(y + dt * ((1 / 4 + S3 / 6) * a + b / 4), t)])

    k = newton(left, np.tile(f(y, t), 2))
    return y + dt * (k[:n] + k[n:]) / 2


def sdirk(f: Any, y: Array, t: float, dt: float) -> Array:
    """Alexander's method of order 2 (1977): one stage after the other."""
    first = newton(lambda k: k - f(y + dt * G * k, t + G * dt), f(y, t))
    second = newton(lambda k: k - f(y + dt * ((1 - G) * first + G * k), t + dt), first)
    return y + dt * ((1 - G) * first + G * second)


def stepper(step: Any) -> OwnStepper:
    """Of a function."""
    made = stepper_of(step)
    assert isinstance(made, OwnStepper)
    return made


@pytest.mark.parametrize(
    ("step", "a", "b", "order"),
    [
        (gauss, [[1 / 4, 1 / 4 - S3 / 6], [1 / 4 + S3 / 6, 1 / 4]], [1 / 2, 1 / 2], 4),
        (sdirk, [[G, 0], [1 - G, G]], [1 - G, G], 2),
    ],
    ids=["gauss", "sdirk"],
)
def test_stages_solved_by_newton_are_the_textbooks(step: Any, a: Any, b: Any, order: int) -> None:
    """No third stage, and every coefficient to 1e-9: the equations are solved to 1e-14 of slopes of about 1."""
    reasons: list[str] = []
    found = slopes_of(stepper(step), reasons).tableau
    assert found is not None
    assert np.array(found.a, float) == pytest.approx(np.array(a), abs=1e-9)
    assert np.array(found.b, float) == pytest.approx(np.array(b), abs=1e-9)
    assert (found.order, found.symplectic) == (order, order == 4)
    assert reasons == []


def test_a_tableau_that_steps_contradict_is_not_told() -> None:
    """Euler's steps beside backward Euler's tableau, as it would come of points that are no stages; its own is kept."""
    one, within = Fraction(1), 1e-7

    def euler(f, y, t, dt):  # type: ignore[no-untyped-def]
        return y + dt * f(y, t)

    runs = runs_of(stepper(euler))
    seen = slopes_of(stepper(euler), [])
    for a, kept in ((Fraction(0), True), (one, False)):
        reasons: list[str] = []
        beside = beside_steps(seen._replace(tableau=Tableau(((a,),), (one,), (a,), within)), runs, reasons)
        assert (beside.tableau is not None, len(reasons)) == (kept, 0 if kept else 1)
