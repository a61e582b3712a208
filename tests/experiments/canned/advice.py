"""Advice on a scene of 1 ms: engines with longer and shorter limits, without one, and not able to take it."""

from __future__ import annotations

from experiments.advice import wording
from experiments.advice.advice import Advice
from experiments.experiment import Result
from reference.changes import Change
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import Setup, find

SETUP = Setup("mine", find("string").system({"masses": 2}), 1e-3, 0.5)

DONE, DIVERGED = Outcome("done"), Outcome("diverged", "spring 1 is over 100 times its length")

NO_SCHEME = Limit(None, "no scheme of the catalogue is this near")


def advised(
    engine: str, scheme: str | None, predicted: float | None, measured: float, own: Outcome, step: float | None
) -> Advice:
    """An engine with a measured limit [s], and the step [s] that it is advised."""
    limit = NO_SCHEME if predicted is None else Limit(predicted)
    return Advice(engine, scheme, limit, Limit(measured, grows_beyond=True), own, step, DONE if step else DIVERGED)


#: Predicted limits are not the measured ones: whoever takes one for the other is seen.
STABLE = advised("mujoco_tendons", "kick_drift", 4.0e-3, 4.4e-3, DONE, 3.6e-3)
TOO_LONG = advised("pymunk_springs", "drift_kick", 0.5e-3, 0.55e-3, DIVERGED, 0.45e-3)
ONLY_JUST = advised("bullet_softbody", None, None, 1.05e-3, DONE, 0.94e-3)
CABLE = advised("mujoco_cable", "pendulum_kick_drift", 40e-3, 41e-3, DONE, 36e-3)
UNMEASURED = Advice("exudyn_springs", "rk4", Limit(2e-3), Limit(None, "it has its own step"), DONE)
CRASHED = Advice("Segfaults", None, NO_SCHEME, Limit(None, "it crashed"), Outcome("crashed", "killed by SIGSEGV"))
CANNOT = Advice("mujoco_flex", None, NO_SCHEME, NO_SCHEME, Outcome("unsupported", "mujoco_flex cannot do planes"))

FOUND = (STABLE, TOO_LONG, ONLY_JUST, CABLE, UNMEASURED, CRASHED, CANNOT)


def usual() -> Result:
    """All of them."""
    return wording.result_of(SETUP, FOUND)


def only(*found: Advice, dt: float = SETUP.dt, changes: tuple[Change, ...] = ()) -> Result:
    """Some, on the scene with this dt [s]."""
    return wording.result_of(Setup(SETUP.name, SETUP.system, dt, SETUP.duration, changes), found)
