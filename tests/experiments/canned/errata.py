"""Remarks on listings, with the orders of schemes and the barrier's two rules around a circle."""

from __future__ import annotations

import math

import numpy as np

from experiments import errata
from experiments.experiment import Result

STEPS = [1e-3, 5e-4, 2.5e-4, 1.25e-4]

#: By scheme: the error with the first of STEPS [m], and the order.
ORDERS = {
    "euler": (4e-4, 1.0),
    "euler_in_place": (5e-4, 1.0),
    "heun": (1e-6, 2.0),
    "heun_link_by_link": (1e-4, 1.0),
    "heun_aliased": (2e-4, 1.0),
}

#: The largest stable dt of Heun and of Heun link by link [s].
LIMITS = (4e-3, 6e-3)


def usual() -> Result:
    """Errors that fall as their orders say; projected keeps 1 m/s, printed -cos(2 angle) of it."""
    orders = {
        name: (STEPS, [error * (step / STEPS[0]) ** order for step in STEPS], order)
        for name, (error, order) in ORDERS.items()
    }
    angles = np.linspace(0, 2 * math.pi, 9)
    remarks: list[errata.Remark] = [
        ("11", "the listing headed incorrect", "distance from slide 7, 500 steps", 0.0, "m"),
        *(("7-11", "link by link", f"order of {name}", order, "") for name, (_, order) in ORDERS.items()),
        ("7-11", "link by link", "largest stable dt, heun", LIMITS[0], "s"),
        ("7-11", "link by link", "largest stable dt, heun_link_by_link", LIMITS[1], "s"),
    ]
    return errata.result_of(remarks, orders, (angles, -np.cos(2 * angles), np.ones(9)))
