"""Strings that become a pendulum as 1/k, and a cable that is that pendulum."""

from __future__ import annotations

from experiments import stiff_limit
from experiments.experiment import Result

STIFFNESSES = (2e2, 2e3, 2e4, 2e5, 2e6)


def usual(cable: float | None = 80.0, power: float = -1.0) -> Result:
    """Distances of 100/k [m] from the pendulum, and of so many from the cable; None where that did not run."""
    rows = [[k, 100 * k**power, None if cable is None else cable * k**power] for k in STIFFNESSES]
    failures = [] if cable is not None else ["mujoco_cable_rk4: unsupported, mujoco is not installed"]
    return stiff_limit.result_of(rows, None if cable is None else 3e-9, failures)
