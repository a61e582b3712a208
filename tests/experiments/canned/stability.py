"""Limits of schemes and engines, undamped and with drag, and what has none."""

from __future__ import annotations

from experiments import stability
from experiments.experiment import Result
from reference.limit import Limit
from reference.scenes import find
from tests.experiments.canned.steppers import SCHEME_OF

UNDAMPED = find("string").system({"masses": 2})
DRAGGED = find("string").system({"masses": 2, "drag": 0.1})

NEVER = Limit(None, "unstable at any dt: grows by 0.001 of itself in a step of 0.001 s", growth=1e-3)
NEVER_SEEN = Limit(None, "unstable at any dt that was tried, down to 1e-09 s")
ALWAYS = Limit(None, "stable at any dt that was tried, up to 100 s")
STRANGER = Limit(None, "not identified; nearest heun at 0.001 m")


def rows() -> list[stability.Row]:
    """A scheme off by a hundredth, an engine by a thousandth, and all that can be said where there is no limit."""
    absent = Limit(None, "no_such_engine is not installed")
    made = []
    for system, longer in ((UNDAMPED, 1.0), (DRAGGED, 2.0)):
        made += [
            stability.Row("kick_drift", "scheme", system, Limit(0.010 * longer), Limit(0.0101 * longer)),
            stability.Row("pymunk_springs", "engine", system, Limit(0.020 * longer), Limit(0.01998 * longer)),
            stability.Row("euler", "scheme", system, NEVER, NEVER_SEEN),
            stability.Row("backward_euler", "scheme", system, ALWAYS, ALWAYS),
            stability.Row("exudyn_springs", "engine", system, Limit(0.03), Limit(None, "it has its own step")),
            stability.Row("mujoco_rope", "engine", system, absent, absent, "unsupported"),
            stability.Row("stranger", "engine", system, STRANGER, NEVER_SEEN),
            stability.Row("exudyn_springs_euler", "engine", system, Limit(0.025), NEVER_SEEN),
        ]
    return made


def usual() -> Result:
    """Of these rows."""
    return stability.result_of(rows())


def full() -> Result:
    """As many rows as there are engines and schemes, in four cases."""
    cases = [find("string").system({"masses": 2, **case}) for case in stability.CASES]
    names = [*SCHEME_OF, *SCHEME_OF.values(), "drift_kick_exponential_damping", "kick_drift_implicit_damping_and_drag"]
    return stability.result_of(
        [stability.Row(name, "scheme", system, Limit(0.01), Limit(0.01)) for system in cases for name in names]
    )
