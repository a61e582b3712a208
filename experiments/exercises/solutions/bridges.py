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


def moved(random: np.random.Generator, bridge: dict[str, Any], turn: float) -> dict[str, Any]:
    """The bridge elsewhere: below height 0, turned so that its supports are at two heights, its members' ends mixed.

    Args:
        turn: by how much it is turned [rad].
    """
    c, s = np.cos(turn), np.sin(turn)
    joints = bridge["joints"] @ np.array([[c, s], [-s, c]]) + random.uniform(-9.0, -7.0, 2)
    members = bridge["members"].copy()
    swapped = random.random(len(members)) < 0.5
    members[swapped] = members[swapped, ::-1]
    return {**bridge, "joints": joints, "members": members}


def turned_about(bridge: dict[str, Any], member: int, rightwards: bool) -> dict[str, Any]:
    """The bridge with one member's ends in this order: from left to right, or from right to left."""
    members = bridge["members"].copy()
    a, b = members[member]
    if (bridge["joints"][b, 0] > bridge["joints"][a, 0]) != rightwards:
        members[member] = b, a
    return {**bridge, "members": members}
