"""Damped oscillators for a stepper to step once: a mass on a spring along a line, about its rest.

Displaced by x, or moving at v, a mass comes to (x1, v1) in a step of h: two such steps give the matrix that multiplies
(x, h v). It is linear, as along a line a spring's force is, as long as no mass passes its anchor.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from reference.derivation.fit import Samples
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.state import Array
from reference.stepper import Stepper
from reference.system import MassSpringSystem

#: The step [s], and how far masses are displaced [m]: powers of two, so that rounding is only the stepper's. In single
#: precision a position's rounding is less of a larger displacement; no mass passes its anchor in a step.
DT, ASIDE, FAR_ASIDE = 1 / 16, 1 / 32, 1 / 2

#: What gravity is where it cannot be none [m/s^2].
GRAVITY = 9.81

#: How many oscillators are stepped: a third of them checks what the others are fitted by. More, where that are too few.
FEW, MANY = 40, 160

#: Rounding of a step matrix's entries, as a multiple of the relative rounding of the numbers.
ROUNDINGS = 100


class Run(NamedTuple):
    """What a stepper is to run: a system, for so many steps of dt [s]."""

    system: MassSpringSystem
    dt: float
    steps: int = 1


#: Runs a stepper on many systems at one go.
Runs = Callable[[Sequence[Run]], list[Outcome]]


def runs_of(stepper: Stepper) -> Runs:
    """The stepper's own `run_each`, where it has a way that costs less than run after run."""
    own: Runs | None = getattr(stepper, "run_each", None)
    return own or (lambda runs: [stepper.run(r.system, r.dt, r.steps) for r in runs])


def samples(damped: bool, dragged: bool, count: int) -> Samples:
    """Oscillators to step: a up to 2, b and d up to 1, multiples of 1/64."""
    random = np.random.default_rng(7)
    a, b, d = (random.integers(1, most, count) / 64 for most in (128, 64, 64))
    return Samples(a, b if damped else 0 * b, d if dragged else 0 * d)


def matrices_at(runs: Runs, at: Samples) -> Array:
    """Step matrices, shape (n, 2, 2), in the way that the stepper can.

    Raises:
        Unsupported: where it cannot, with its reason.
    """
    try:
        return side_by_side(runs, at)
    except Unsupported:
        return one_by_one(runs, at)


def oscillator(
    a: float, b: float, d: float, x: float = 0.0, v: float = 0.0, dt: float = DT, gravity: float = 0.0
) -> MassSpringSystem:
    """A mass of 1 kg on a spring of 1 m to a fixed mass, displaced by x [m], moving at v [m/s]."""
    return MassSpringSystem(
        positions=np.array([[0.0], [-1.0 - x]]),
        velocities=np.array([[0.0], [-v]]),
        springs=np.array([[0, 1]]),
        masses=np.array([1.0, 1.0]),
        rest_lengths=np.array([1.0]),
        stiffness=np.array([a / dt**2]),
        damping=np.array([b / dt]),
        drag=d / dt,
        gravity=np.array([gravity]),
        fixed=np.array([True, False]),
    )


def one_by_one(runs: Runs, at: Samples, dt: float = DT, aside: float = ASIDE) -> Array:
    """Step matrices, shape (n, 2, 2), every oscillator in a system of its own.

    Raises:
        Unsupported: where the stepper cannot step one, with its reason.
    """
    return _matrices(_rows_one_by_one(runs, at, dt, 1, aside))


def by_difference(runs: Runs, at: Samples, dt: float = DT, aside: float = ASIDE) -> Array:
    """The same under gravity, for who knows no other: of each also a step from where it is not displaced is taken away.

    Raises:
        Unsupported: where the stepper cannot step one, with its reason.
    """
    return _matrices(_rows_one_by_one(runs, at, dt, 1, aside, -GRAVITY))


def side_by_side(runs: Runs, at: Samples, dt: float = DT, aside: float = ASIDE) -> Array:
    """The same, all oscillators in one system: drag is one number there, and masses differ instead.

    Raises:
        Unsupported: where the stepper cannot step that, with its reason.
    """
    return _matrices(_rows_side_by_side(runs, at, dt, 1, aside))


def rows_of_steps(runs: Runs, at: Samples, steps: int) -> Array:
    """Displacements over the first one after so many steps in a row, shape (2, steps + 1, n).

    Those of oscillators that are let go displaced, and of those that set out from rest.

    Raises:
        Unsupported: where the stepper cannot step them, with its reason.
    """
    try:
        return _rows_side_by_side(runs, at, DT, steps)[..., 0]
    except Unsupported:
        return _rows_one_by_one(runs, at, DT, steps)[..., 0]


def _matrices(rows: Array) -> Array:
    return rows[:, -1].transpose(1, 2, 0)


def _rows_one_by_one(
    runs: Runs, at: Samples, dt: float, steps: int, aside: float = ASIDE, gravity: float = 0.0
) -> Array:
    """(x, h v) over the first one of all steps, shape (2, steps + 1, n, 2), of both beginnings."""
    cases = list(zip(at.a.tolist(), at.b.tolist(), at.d.tolist(), strict=True))
    ways = ((aside, 0.0), (0.0, aside / dt), *([(0.0, 0.0)] if gravity else []))
    begun = [oscillator(*case, x, v, dt, gravity) for x, v in ways for case in cases]
    found = [row_of(outcome, steps) for outcome in runs([Run(system, dt, steps) for system in begun])]
    rows = np.stack([np.stack([-1.0 - x[:, 1, 0], -dt * v[:, 1, 0]], axis=1) for x, v in found], axis=1)
    rows = rows.reshape(steps + 1, len(ways), len(cases), 2).swapaxes(0, 1) / aside
    return rows[:2] - rows[2:] if gravity else rows


def _rows_side_by_side(runs: Runs, at: Samples, dt: float, steps: int, aside: float = ASIDE) -> Array:
    """The same of all oscillators in one system."""
    n = len(at.a)
    dragged = bool(at.d.any())
    mass = 1 / at.d if dragged else np.ones(n)
    system = MassSpringSystem(
        positions=np.tile([[0.0], [-1.0]], (n, 1)),
        springs=np.arange(2 * n).reshape(n, 2),
        masses=np.repeat(mass, 2),
        rest_lengths=np.array(1.0),
        stiffness=at.a * mass / dt**2,
        damping=at.b * mass / dt,
        drag=1 / dt if dragged else 0.0,
        gravity=np.zeros(1),
        fixed=np.arange(2 * n) % 2 == 0,
    )
    moved = np.where(system.fixed, 0.0, -aside)[:, None]
    begun = [
        replace(system, positions=system.positions + moved),
        replace(system, velocities=moved / dt),
    ]
    found = [row_of(outcome, steps) for outcome in runs([Run(s, dt, steps) for s in begun])]
    return np.stack([np.stack([-1.0 - x[:, 1::2, 0], -dt * v[:, 1::2, 0]], axis=2) for x, v in found]) / aside


def end_of(outcome: Outcome) -> tuple[Array, Array]:
    """Where a run of a step has come to. Raises Unsupported, with its reason, where it has not."""
    x, v = row_of(outcome, 1)
    return x[-1], v[-1]


def row_of(outcome: Outcome, steps: int) -> tuple[Array, Array]:
    """Positions and velocities at all steps of a run. Raises Unsupported, with its reason, where it ended before."""
    run = outcome.trajectory
    if run is None or len(run) < steps + 1:
        raise Unsupported(outcome.reason or "it tells no velocities")
    for what, ends in (("positions", run.positions[-1]), ("velocities", run.velocities[-1])):
        if not np.isfinite(ends).all():
            raise Unsupported(outcome.reason or f"it tells no {what}")
    return run.positions, run.velocities
