"""Bridges for students to compute: trusses that stand on a pin and a roller."""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.scenes.trusses import truss


def some_bridge(random: np.random.Generator, panels: int, gravity: float, light: int) -> dict[str, Any]:
    """A Warren bridge, its top a little out of line, with a load of its own at every joint.

    Joints and members are numbered in any order. Where a joint is light the fastest mode is: at a support it so shows
    whether that is held.

    Args:
        light: which bottom joint is, counted from the pin.
    """
    built = truss("warren", panels, float(random.uniform(2, 4)), float(random.uniform(2, 4)))
    count = len(built.joints)
    out_of_line = random.uniform(-0.3, 0.3, (count, 2)) * (built.joints[:, 1:] > 0)
    number = random.permutation(count)
    joints = np.empty((count, 2))
    joints[number] = built.joints + out_of_line
    masses = random.uniform(500, 4000, count)
    masses[number[light]] = random.uniform(50, 100)
    return {
        "joints": joints,
        "members": random.permutation(number[np.asarray(built.members)]),
        "stiffness": random.uniform(1e7, 3e7, len(built.members)),
        "masses": masses,
        "gravity": gravity,
        "pinned": int(number[0]),
        "roller": int(number[panels]),
    }
