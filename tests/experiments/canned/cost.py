"""Costs by hand: a scheme's kernel, a scheme in Python, and engines that are schemes at other prices."""

from __future__ import annotations

import numpy as np

from experiments import cost
from experiments.benchmark.timing import Speeds
from experiments.cost import ANCHOR, DTS, DURATION, MASSES, MORE_MASSES, Cost, Point
from experiments.experiment import Result
from tests.experiments.canned.steppers import SCHEME_OF, Named

#: The step of the anchor's kernel on ten masses [s]: on more it takes longer in proportion.
STEP = 1e-7

#: The error with the largest dt [m], and the order, by scheme.
ERRORS = {"kick_drift": (3e-2, 1), "drift_kick": (3e-2, 1), "heun": (2e-3, 2), "rk4": (4e-6, 4), "euler": (5e-2, 1)}
ERRORS |= {"velocity_verlet": (1e-3, 2), "pendulum_kick_drift": (3e-2, 1), "pendulum_rk4": (4e-6, 4)}
ERRORS |= {"rope_kick_drift": (3e-2, 1)}


def priced(name: str, runs_as: str, slower: float, scheme: str | None, sizes: int = len(MASSES)) -> Cost:
    """A stepper whose steps take so many times the anchor's, on so many sizes of string."""
    error, order = ERRORS[scheme or "euler"]
    points = [
        Point(dt, round(DURATION / dt) * slower * STEP, error * (dt / DTS[0]) ** order if dt < DTS[0] else np.inf)
        for dt in DTS
    ]
    sizes_tried = (*MASSES, *MORE_MASSES)[:sizes]
    reason = "" if sizes >= len(MASSES) else "a step would take some 1 s"
    speeds = Speeds([slower * STEP * n / MASSES[0] for n in sizes_tried], reason)
    return Cost(Named(name, "engine" if runs_as == "engine" else "scheme"), runs_as, scheme, points, speeds)


def costs() -> list[Cost]:
    """The anchor, two other schemes; two engines that are the anchor, one that is rk4, a stranger; one that failed."""
    return [
        priced(ANCHOR, "kernel", 1.0, ANCHOR, 8),
        priced("rk4", "kernel", 4.0, "rk4", 8),
        priced("heun", "Python", 200.0, "heun", 0),
        priced("mujoco_tendons", "engine", 30.0, ANCHOR),
        priced("bullet_softbody", "engine", 90.0, ANCHOR, 3),
        priced("mujoco_flex_rk4", "engine", 50.0, "rk4"),
        Cost(Named("Segfaults"), "engine", None, [], Speeds([]), "crashed, killed by SIGSEGV"),
    ]


def usual() -> Result:
    """Of these."""
    return cost.result_of(costs())


def full() -> Result:
    """All engines."""
    engines = [priced(name, "engine", 30.0 + i, scheme) for i, (name, scheme) in enumerate(SCHEME_OF.items())]
    schemes = [
        priced(name, "kernel", 1.0 + i, name, 8) for i, name in enumerate(("kick_drift", "heun", "rk4", "euler"))
    ]
    return cost.result_of([*schemes, *engines])
