"""Files as strangers write them: what is said of each is right, and no more than is known."""

from __future__ import annotations

from pathlib import Path

import pytest

from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import in_this_process
from reference.derivation.consequences import FAR
from reference.derivation.explanation import Explanation, explain
from report.derived import property_lines

pytestmark = pytest.mark.rotating(7)

LOBATTO = """
import numpy as np
A = np.array([[0, 0, 0], [5 / 24, 1 / 3, -1 / 24], [1 / 6, 2 / 3, 1 / 6]])


def step(f, y, t, dt):
    first = f(y, t)
    k = [first, first, first]
    for _ in range(60):
        k = [first] + [f(y + dt * sum(A[i][j] * k[j] for j in range(3)), t + (0, 0.5, 1)[i] * dt) for i in (1, 2)]
    return y + dt * (k[0] / 6 + 2 * k[1] / 3 + k[2] / 6)
"""

SDIRK = """
g = 1 - 2**-0.5


def step(f, y, t, dt):
    k1 = f(y, t)
    for _ in range(60):
        k1 = f(y + dt * g * k1, t + g * dt)
    k2 = k1
    for _ in range(60):
        k2 = f(y + dt * ((1 - g) * k1 + g * k2), t + dt)
    return y + dt * ((1 - g) * k1 + g * k2)
"""

WRONG_TIME = """
def step(f, y, t, dt):
    new = y + dt * f(y, t)
    for _ in range(80):
        new = y + dt * f(new, {time})
    return new
"""

ROSENBROCK = """
import numpy as np


def step(f, y, t, dt):
    n, here = len(y), f(y, t)
    by = np.array([(f(y + 1e-6 * e, t) - f(y - 1e-6 * e, t)) / 2e-6 for e in np.eye(n)]).T
    return y + dt * np.linalg.solve(np.eye(n) - dt * by, here)
"""

ADAPTIVE = """
from scipy.integrate import solve_ivp


def step(f, y, t, dt):
    return solve_ivp(lambda s, z: f(z, s), (t, t + dt), y, rtol=1e-6, atol=1e-9).y[:, -1]
"""

TWO_ITERATIONS = """
def step(f, y, t, dt):
    new = y + dt * f(y, t)
    for _ in range(2):
        new = y + dt / 2 * (f(y, t) + f(new, t + dt))
    return new
"""

TRIPS = """
calls = 0


def step(a, x, v, dt):
    global calls
    calls += 1
    v = v + dt * a(x, v) * (1 if calls < {after} else 0.5)
    return x + dt * v, v
"""

RALSTON = """
def step(f, y, t, dt):
    k1 = f(y, t)
    k2 = f(y + 0.4 * dt * k1, t + 0.4 * dt)
    k3 = f(y + dt * (0.29697761 * k1 + 0.15875964 * k2), t + 0.45573725 * dt)
    k4 = f(y + dt * (0.21810040 * k1 - 3.05096516 * k2 + 3.83286476 * k3), t + dt)
    return y + dt * (0.17476028 * k1 - 0.55148066 * k2 + 1.20553560 * k3 + 0.17118478 * k4)
"""


def told(folder: Path, text: str) -> Explanation:
    """Of a file with this in it."""
    path = folder / "mine.py"
    path.write_text(text, encoding="utf-8")
    return explain(OwnStepper(own_stepper(str(path)).engine, isolate=in_this_process))


def test_a_slope_that_is_asked_for_once_is_a_stage(tmp_path: Path) -> None:
    """Lobatto IIIA of three stages (Hairer and Wanner 1996, IV.5): its first is explicit, before all iterations."""
    found = told(tmp_path, LOBATTO)
    assert found.tableau is not None
    text = found.tableau.text()
    assert text["a"] == [["0", "0", "0"], ["5/24", "1/3", "-1/24"], ["1/6", "2/3", "1/6"]]
    assert (text["c"], found.order, found.remarks) == (["0", "1/2", "1"], 4, ())


def test_limits_follow_from_a_tableau_with_roots(tmp_path: Path) -> None:
    """SDIRK of two stages with 1 - sqrt(2)/2 is L-stable (Hairer and Wanner 1996, IV.6); no fractions in its matrix."""
    found = told(tmp_path, SDIRK)
    assert found.tableau is not None
    assert found.tableau.text()["b"] == ["sqrt(2)/2", "1 - sqrt(2)/2"]
    assert found.matrix is None
    assert found.limits == (((0.0, FAR),), ((0.0, FAR),))
    assert "Stable without damping at any dt, where its equations are solved" in list(property_lines(found))


@pytest.mark.parametrize(
    ("time", "remarks"),
    [("t", ("slope 1 is taken 1 of a step on, and is told the time 0 of it on",)), ("t + dt", ())],
)
def test_a_wrong_time_is_told_of_implicit_ones(time: str, remarks: tuple[str, ...], tmp_path: Path) -> None:
    """Backward Euler, whose iterations converge on soft springs only: its matrix is seen there."""
    found = told(tmp_path, WRONG_TIME.format(time=time))
    assert found.remarks == remarks
    assert found.matrix is not None
    assert found.matrix.text()[1][1] == "1/(1 + b + d + a)"
    assert found.matrix.softer < 1
    assert found.follows is None
    assert "its step matrix was seen with a up to 0.25" in found.reason


def test_a_differenced_jacobian_hides_digits_not_the_formula(tmp_path: Path) -> None:
    """Rosenbrock-Euler on an oscillator is backward Euler, to the digits of its differences."""
    found = told(tmp_path, ROSENBROCK)
    assert found.matrix is not None
    assert found.matrix.text()[1][0] == "-a/(1 + b + d + a)"
    assert "to about 1e-9 only" in found.reason


def test_steps_of_its_own_are_told_as_such(tmp_path: Path) -> None:
    """SciPy's solver in a step: more times than an iteration has, and fewer where slopes are gentle."""
    found = told(tmp_path, ADAPTIVE)
    assert "it makes steps of its own" in found.reason
    assert "it adapts its steps" in found.reason
    assert "a step is an oscillator's true motion" in found.reason
    assert found.order is None
    (order,) = (line for line in property_lines(found) if "rder" in line)
    assert order.startswith("No order in dt")


def test_slopes_that_are_taken_twice_are_one_stage(tmp_path: Path) -> None:
    """Two rounds of the trapezoid: three different slopes of five; of second order, as two corrections are."""
    found = told(tmp_path, TWO_ITERATIONS)
    assert found.tableau is not None
    assert found.tableau.text() == {
        "a": [["0", "0", "0"], ["1", "0", "0"], ["1/2", "1/2", "0"]],
        "b": ["1/2", "0", "1/2"],
        "c": ["0", "1", "1"],
    }
    assert (found.document["slope_evaluations"], found.order) == (5, 2)


@pytest.mark.parametrize(("after", "one_step"), [(900, False), (10**6, True)])
def test_a_counter_is_seen_as_far_as_is_looked(after: int, one_step: bool, tmp_path: Path) -> None:
    """After 900 calls in a run, not after a million: how far was looked is said."""
    found = told(tmp_path, TRIPS.format(after=after))
    assert found.document["one_step"] is one_step
    assert any("1000 steps in a row" in line or "after 999 others" in line for line in property_lines(found))


def test_a_method_of_eight_digits_is_told_with_its_order_to_six(tmp_path: Path) -> None:
    """Ralston's fourth-order method (1962), by its decimals: exactly it is of first order."""
    found = told(tmp_path, RALSTON)
    assert found.order == 1
    assert any("to six digits it is of order 4" in line for line in property_lines(found))
