"""Recorded runs: what a stepper did, quantised, for the page to lay over its own lanes.

So engines are seen where they cannot run. Places are whole numbers of a quantum, from an offset, and between frames the
page goes in a straight line. By how much that is off at most, of all steps of the run, is measured and told there.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from reference.changes import whole_steps
from reference.errors import Unsupported
from reference.scenes import Setup
from reference.state import Array

#: The longest time of a recording [s], how many numbers it has at most, and the largest of them.
LONGEST, NUMBERS, MOST = 4.0, 100_000, 32_000


@dataclass(frozen=True)
class Recording:
    """A run to be recorded.

    Attributes:
        stepper: a scheme or an engine.
        name: what a link calls it.
        parameters: of the system, set otherwise, one number for all.
        dt: the step [s]; the scene's own where None.
        duration: how long [s]; the scene's own where None.
    """

    stepper: str
    name: str = ""
    parameters: Mapping[str, float] = field(default_factory=dict)
    dt: float | None = None
    duration: float | None = None


def recording_data(recording: Recording, setup: Setup) -> dict[str, Any]:
    """The run as the page reads it.

    Raises:
        InputError: for an unknown stepper.
        Unsupported: where it cannot run the scene, or does not come to its end, with the reason.
    """
    from experiments.runs.steppers import find_steppers

    system = setup.system
    for name, value in recording.parameters.items():
        system = system.with_parameter(name, value)
    dt = setup.dt if recording.dt is None else recording.dt
    duration = min(setup.duration if recording.duration is None else recording.duration, LONGEST)
    (stepper,) = find_steppers([recording.stepper])
    outcome = stepper.run(system, dt, whole_steps(dt, duration), setup.changes)
    if outcome.trajectory is None or outcome.ending != "done":
        raise Unsupported(f"{recording.stepper} is not recorded: {outcome.ending}, {outcome.reason}")
    places = outcome.trajectory.positions
    each = -(-places.size // NUMBERS)
    offset, quantum, whole = quantised(places[::each])
    return {
        "name": recording.name or recording.stepper,
        "stepper": recording.stepper,
        "dt": dt,
        "every": each * dt,
        "quantum": quantum,
        "error": largest_error(places, offset + quantum * whole, each),
        "offset": offset.tolist(),
        "frames": base64.b64encode(whole.astype("<i2").tobytes()).decode(),
    }


def quantised(places: Array) -> tuple[Array, float, Array]:
    """Places (frames, n, d) [m] as an offset (d,), a quantum [m], and whole numbers; off by half a quantum at most."""
    offset = (places.min(axis=(0, 1)) + places.max(axis=(0, 1))) / 2
    quantum = float(np.abs(places - offset).max(initial=0.0)) / MOST or 1.0
    return offset, quantum, np.rint((places - offset) / quantum)


def largest_error(places: Array, frames: Array, each: int) -> float:
    """How far places (steps, n, d) [m] are at most from straight lines between frames, one for each so many steps."""
    steps = np.arange(min(len(places), (len(frames) - 1) * each + 1))
    before = np.minimum(steps // each, max(len(frames) - 2, 0))
    part = (steps / each - before)[:, None, None]
    after = frames[np.minimum(before + 1, len(frames) - 1)]
    shown = frames[before] + part * (after - frames[before])
    return float(np.linalg.norm(shown - places[steps], axis=-1).max(initial=0.0))
