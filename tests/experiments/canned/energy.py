"""Energies that stay, grow and decay, and momenta that are kept and lost."""

from __future__ import annotations

import numpy as np

from experiments import energy
from experiments.energy import DURATION, Row
from experiments.experiment import Result
from reference.outcome import Outcome
from reference.state import Array
from reference.stepper import catalogued
from reference.theory.energy_trend import EnergyTrend
from tests.experiments.canned.steppers import SCHEME_OF, Named

TIMES = np.linspace(0, DURATION, 501)

#: The largest error at the end, by kind, as a part of what there is to give away.
LARGEST: dict[EnergyTrend, float] = {"bounded": 0.02, "growing": 0.5, "decaying": 0.1}

#: When Euler's string is torn [s].
TORN = 4.0


def errors(kind: EnergyTrend, size: float = 1.0) -> Array:
    """Of every time: to and fro, or on and on."""
    largest = size * LARGEST[kind]
    if kind == "bounded":
        return largest * np.sin(2 * np.pi * TIMES)
    return (largest if kind == "growing" else -largest) * TIMES / DURATION


def row(
    name: str,
    predicted: EnergyTrend,
    measured: EnergyTrend,
    momenta: tuple[float, float] | None = (1e-16, 2e-16),
    engine: str | None = None,
    size: float = 1.0,
) -> Row:
    """A scheme, or an engine that is this scheme; with the errors of its momentum and its angular momentum."""
    scheme = catalogued()[name]
    free = Outcome("done") if momenta else Outcome("unsupported", f"{name} does not fly")
    return Row(
        stepper=scheme if engine is None else Named(engine),
        scheme=scheme,
        alike=name,
        predicted=predicted,
        measured=measured,
        times=TIMES,
        errors=errors(measured, size),
        outcome=Outcome("done"),
        momentum=None if momenta is None else momenta[0],
        angular_momentum=None if momenta is None else momenta[1],
        free_outcome=free,
    )


def torn() -> Row:
    """Euler, which comes no further than TORN, with an error of 100 times what there is."""
    many = TIMES <= TORN
    known = row("euler", "growing", "growing", (1e-16, 1e-1))
    known = Row(**{**vars(known), "times": TIMES[many], "errors": 100 * TIMES[many] / TORN})
    return Row(**{**vars(known), "outcome": Outcome("diverged", "spring 1 is torn")})


def crashed() -> Row:
    """An engine that left nothing."""
    none, why = np.zeros(0), Outcome("crashed", "SIGSEGV")
    return Row(Named("Segfaults"), None, None, None, None, none, none, why, None, None, why)


def rows() -> list[Row]:
    """Each kind; an engine; one that is not as predicted, on rods; one in place; one torn; one crashed."""
    return [
        row("kick_drift", "bounded", "bounded"),
        row("kick_drift", "bounded", "bounded", engine="pymunk_springs"),
        row("rk4", "decaying", "decaying", (2e-16, 5e-8)),
        row("pendulum_kick_drift", "bounded", "growing", None, size=0.1),
        row("heun_link_by_link", "growing", "growing", (3e-2, 4e-2)),
        torn(),
        crashed(),
    ]


def usual() -> Result:
    """Of these rows."""
    return energy.result_of(rows())


def full() -> Result:
    """All schemes and engines, with energies of their own."""
    kinds: tuple[EnergyTrend, ...] = ("bounded", "growing", "decaying")
    schemes = [row(name, kinds[i % 3], kinds[i % 3], size=0.7**i) for i, name in enumerate(catalogued())]
    engines = [row(scheme, "bounded", "bounded", engine=name) for name, scheme in SCHEME_OF.items()]
    return energy.result_of([*schemes, *engines])


def nobody() -> Result:
    """No stepper."""
    return energy.result_of([])
