"""Errors that fall as powers of dt, of schemes and of engines on their lines."""

from __future__ import annotations

import numpy as np

from experiments import order
from experiments.experiment import Result
from experiments.order import DTS, Row
from reference.outcome import Outcome
from reference.stepper import catalogued
from tests.experiments.canned.steppers import SCHEME_OF, Named

#: The error with the largest dt, by the order [m].
ERRORS = {1: 1e-3, 2: 1e-5, 4: 1e-7}

#: Of which order the fourth stepper is by theory, and which one it shows.
OFF = ("velocity_verlet", 2, 1.5)


def row(name: str, slope: float | None = None, engine: str | None = None, string: str = "drag") -> Row:
    """A scheme, or an engine on its line: an error of C dt^p, p the scheme's order or another slope."""
    scheme = catalogued()[name]
    p = scheme.scheme.order
    errors = ERRORS[p] * (DTS / DTS[0]) ** (p if slope is None else slope)
    stepper = scheme if engine is None else Named(engine)
    return Row(stepper, string, scheme, errors, slice(0, len(DTS)), Outcome("done"))


def stranger() -> Row:
    """An engine that is no scheme: its errors fall no more from some dt on."""
    errors = np.maximum(1e-4 * DTS / DTS[0], 1e-5)
    return Row(Named("stranger"), "drag", None, errors, None, Outcome("done"), "not identified")


def crashed() -> Row:
    """An engine that left nothing."""
    errors = np.full(len(DTS), np.nan)
    return Row(Named("Segfaults"), "drag", None, errors, None, Outcome("crashed", "SIGSEGV"), "SIGSEGV")


def rows() -> list[Row]:
    """Schemes of each order, one that is off, in place, a pendulum; engines with the errors of theirs, and without."""
    schemes = [row(name) for name in ("kick_drift", "heun", "rk4", "euler_in_place", "pendulum_rk4")]
    engines = [row("kick_drift", engine="pymunk_springs"), row("pendulum_rk4", engine="mujoco_cable_rk4")]
    return [*schemes, row("velocity_verlet", OFF[2]), *engines, stranger(), crashed()]


def usual() -> Result:
    """Of these rows."""
    return order.result_of(rows())


def full() -> Result:
    """Every scheme and every engine: many lines of one order lie on one another."""
    schemes = [row(name) for name in catalogued()]
    return order.result_of([*schemes, *(row(scheme, engine=name) for name, scheme in SCHEME_OF.items())])


def nobody() -> Result:
    """No stepper."""
    return order.result_of([])
