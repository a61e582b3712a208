"""Engines on a string of three: how far each is from the true motion, and from its scheme."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from experiments import divergence
from experiments.experiment import Result
from experiments.runs.comparison import Comparison, Run
from reference.identification import Identification, Match
from reference.outcome import Outcome
from reference.scenes import Setup, find
from tests.experiments.canned.steppers import SCHEME_OF, Named

SETUP = Setup("string", find("string").system({"masses": 3}), 1e-3, 0.02)

#: The distance from the true motion at the end, by scheme [m].
ERRORS: Mapping[str | None, float] = {
    "euler": 5e-3,
    "kick_drift": 4e-3,
    "drift_kick": 3e-3,
    "velocity_verlet": 1e-5,
    "rk4": 1e-8,
    "pendulum_kick_drift": 0.25,
    "pendulum_rk4": 0.24,
    "rope_kick_drift": 0.22,
    None: 2e-3,
}

#: The distance from its scheme at the end [m].
DEVIATION = 2e-15


def ran(name: str, scheme: str | None, error: float | None = None, deviation: float = DEVIATION) -> Run:
    """An engine whose distance from the true motion grows with time, and that from its scheme with its square root."""
    times = np.linspace(0, 1, 21)
    ranking = (Match(scheme or "kick_drift", deviation if scheme else 1e-6),)
    errors = (ERRORS[scheme] if error is None else error) * times
    apart = None if scheme is None else deviation * np.sqrt(times)
    why = "" if scheme else "nearest kick_drift at 1e-06 m"
    return Run(Named(name), Outcome("done"), Identification(name, ranking, 1e-12, why), errors, apart)


def failed(name: str, outcome: Outcome) -> Run:
    """An engine that left nothing."""
    return Run(Named(name), outcome, Identification(name, (), 1e-12, outcome.reason), None, None)


def of(*runs: Run) -> Result:
    """The experiment's answer for some runs."""
    return divergence.result_of(Comparison(SETUP, None, runs))


def usual() -> Result:
    """One identified, one not, one that crashed."""
    crash = Outcome("crashed", "killed by SIGSEGV; 3 masses, 20 steps")
    return of(ran("KickDrift", "kick_drift"), ran("StifferByAMillionth", None), failed("Segfaults", crash))


def full() -> Result:
    """All engines, and one that is no scheme."""
    return of(*(ran(name, scheme) for name, scheme in SCHEME_OF.items()), ran("stranger", None))


def not_installed() -> Result:
    """All unsupported."""
    why = Outcome("unsupported", "no-such-engine is not installed")
    return of(failed("Still", why), failed("Segfaults", why))
