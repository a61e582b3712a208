"""Steps that are wrong in what they are, not in a coefficient: dt forgotten, the pair exchanged, rounded, iterated."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from engines.own.stepper import look_at, own_stepper, stepper_of
from reference.derivation.explanation import CONTRADICTION, IN_SINGLE, SWAPPED, explain
from reference.derivation.oscillators import DT, runs_of
from reference.derivation.step_matrix import step_matrix
from reference.errors import InputError, Unsupported
from reference.state import Array

F = Callable[..., Array]


def forgets(a: F, x: Array, v: Array, dt: float) -> tuple[Array, Array]:
    """Kick-drift without dt in the drift."""
    v = v + dt * a(x, v)
    return x + v, v


def kick_drift(a: F, x: Array, v: Array, dt: float) -> tuple[Array, Array]:
    """As it should be."""
    v = v + dt * a(x, v)
    return x + dt * v, v


def exchanged(a: F, x: Array, v: Array, dt: float) -> tuple[Array, Array]:
    """The same, returned in the other order."""
    x, v = kick_drift(a, x, v, dt)
    return v, x


def single(f: F, y: Array, t: float, dt: float) -> Any:
    """Explicit Euler in single precision."""
    return y.astype(np.float32) + np.float32(dt) * f(y, t).astype(np.float32)


def euler(f: F, y: Array, t: float, dt: float) -> Array:
    """The same in double."""
    return y + dt * f(y, t)


def midpoint(f: F, y: Array, t: float, dt: float) -> Array:
    """Implicit midpoint: k = f(y + h k/2), by sixty iterations."""
    k = f(y, t)
    for _ in range(60):
        k = f(y + dt / 2 * k, t + dt / 2)
    return y + dt * k


def untimed(f: F, y: Array, t: float, dt: float) -> Array:
    """Ralston's method; f is told no time."""
    k1 = f(y)
    return y + dt * (k1 / 4 + 3 * f(y + 2 / 3 * dt * k1) / 4)


def nothing(f: F, y: Array, t: float, dt: float) -> Array:
    """The state as it was."""
    return y


def changes(f: F, y: Array, t: float, dt: float) -> Array:
    """Euler at the steps of the recording, 1/4 and 1/8 s, and another below 3e-3 s."""
    return y + dt * f(y, t) * (1.0 if dt > 3e-3 else 1.01)


def lost(f: F, y: Array, t: float, dt: float) -> Array:
    """No numbers."""
    return y * np.nan


def test_dt_forgotten_is_seen_at_two_steps() -> None:
    """X' = x + v: in (x, h v) its entry is 1/h. Kick-drift's matrix has a = h^2 k/m alone."""
    assert step_matrix(runs_of(stepper_of(forgets))).only_at == DT
    assert step_matrix(runs_of(stepper_of(kick_drift))).only_at is None
    assert explain(stepper_of(forgets)).follows is None


def test_position_and_velocity_exchanged() -> None:
    """From rest at -1 m it comes to 0 m at -1 m/s: no linear step about rest does."""
    found = explain(stepper_of(exchanged))
    assert SWAPPED in found.reasons
    assert found.matrix is None


@pytest.mark.rotating(4, in_turn=True)
def test_single_precision_is_told_by_its_numbers() -> None:
    """Numbers of 24 bits, from a system whose own are not: by chance one in 2^58."""
    assert IN_SINGLE in explain(stepper_of(single)).reasons
    assert IN_SINGLE not in explain(stepper_of(euler)).reasons


@pytest.mark.rotating(4, in_turn=True)
def test_stages_of_an_iteration_that_has_converged() -> None:
    """A = 1/2, b = 1."""
    tableau = explain(stepper_of(midpoint)).tableau
    assert tableau is not None
    assert tableau.text() == {"a": [["1/2"]], "b": ["1"], "c": ["1/2"]}


def test_where_no_time_is_told_c_is_the_sums_of_rows() -> None:
    """C = (0, 2/3), and nothing to remark."""
    found = explain(stepper_of(untimed))
    assert found.tableau is not None
    assert found.tableau.text()["c"] == ["0", "2/3"]
    assert found.remarks == ()


def test_a_step_that_changes_nothing_is_no_rod() -> None:
    """Its matrix is the identity."""
    with pytest.raises(Unsupported, match="changes nothing"):
        step_matrix(runs_of(stepper_of(nothing)))


@pytest.mark.rotating(4, in_turn=True)
def test_a_method_by_its_tableau_that_moves_otherwise_is_a_contradiction() -> None:
    """Its tableau is Euler's, its steps on the string are not."""
    assert CONTRADICTION in explain(stepper_of(changes)).reasons
    assert CONTRADICTION not in explain(stepper_of(euler)).reasons


@pytest.mark.rotating(7, in_turn=True)
def test_nan_is_not_taken_for_chance_or_writing() -> None:
    """NaN is unequal to itself: a step that returns it does the one thing only."""
    found = stepper_of(lost)
    assert look_at(found.engine) == ("lost returns NaN or infinity",)
    assert explain(found).failed
    assert not explain(stepper_of(euler)).failed


def test_a_c_file_has_its_step_by_that_name(tmp_path: Path) -> None:
    """FILE.c:step may be said; no other name."""
    file = tmp_path / "mine.c"
    file.write_text("", encoding="utf-8")
    assert own_stepper(f"{file}:step").engine == own_stepper(str(file)).engine
    with pytest.raises(InputError):
        own_stepper(f"{file}:other")
