"""Scenes that something drives: a truck that crosses a bridge (slide 28), and ground that shakes (slide 29). In 2D."""

from __future__ import annotations

from typing import Literal

import numpy as np

from reference.changes import Driven
from reference.errors import InputError
from reference.scenes import scene
from reference.scenes.crossing import Crossing, cambered
from reference.scenes.ground_motion import FrequencySweep, GroundMotion, Law
from reference.scenes.parameters import PerItem, counted
from reference.scenes.trusses import Kind, bridge, soil
from reference.state import Array

#: Of a bridge that a truck crosses: each step's masses are kept.
MOST_PANELS = 100

#: What a bridge stands on.
Ground = Literal["rock", "soil"]

#: Along which axis the ground shakes: along the bridge, or up and down.
Axis = Literal["x", "y"]


@scene(dt=1e-3, duration=1.5, slides="28")
def crossing(
    *,
    kind: Kind = "warren",
    panels: int = 8,
    panel: float = 3.0,
    height: float = 3.0,
    axial_stiffness: PerItem = 5e7,
    mass_per_length: float = 200.0,
    deck: float = 800.0,
    truck: float = 5000.0,
    speed: float = 20.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
) -> Driven:
    """A truck crosses the bridge from left to right.

    Before it comes the bridge is at rest, cambered to carry its own weight. The truck [kg] goes at `speed` [m/s]; the
    other parameters are those of `bridge`.
    """
    counted("panels", panels, most=MOST_PANELS)
    unladen = bridge(
        kind=kind,
        panels=panels,
        panel=panel,
        height=height,
        axial_stiffness=axial_stiffness,
        mass_per_length=mass_per_length,
        deck=deck,
        truck=0.0,
        truck_position=0.0,
        damping=damping,
        drag=drag,
        gravity=gravity,
    )
    joints = np.arange(panels + 1)
    places: Array = panel * joints.astype(float)
    return Driven(cambered(unladen), (Crossing(truck, speed, places, joints),))


@scene(dt=1e-3, duration=2.0, slides="29")
def earthquake(
    *,
    on: Ground = "rock",
    kind: Kind = "warren",
    panels: int = 6,
    panel: float = 3.0,
    height: float = 3.0,
    truck: float = 5000.0,
    damping: float = 1e4,
    gravity: float = 9.81,
    axis: Axis = "x",
    from_frequency: float = 0.5,
    to_frequency: float = 5.0,
    amplitude: float = 1.0,
    shaking: float = 1.8,
    law: Law = "linear",
) -> Driven:
    """The ground shakes under a bridge, on rock or on loose soil, faster and faster.

    It stands at rest before, at its own weight and a truck's in the middle. The ground's acceleration is a sine of an
    amplitude [m/s^2] along the axis x or y; in `shaking` [s] it sweeps from one frequency to the other [Hz]. The others
    are as for `bridge` and `soil`.
    """
    if not 0 < shaking < np.inf:
        raise InputError(f"shaking = {shaking:g}: expected a finite number > 0 [s]")
    build = {"rock": bridge, "soil": soil}[on]
    standing = build(
        kind=kind,
        panels=panels,
        panel=panel,
        height=height,
        truck=truck,
        truck_position=panels * panel / 2,
        damping=damping,
        gravity=gravity,
    )
    sweep = FrequencySweep(from_frequency, to_frequency, amplitude, shaking, law, {"x": (1.0,), "y": (0.0, 1.0)}[axis])
    return Driven(cambered(standing), (GroundMotion(sweep),))
