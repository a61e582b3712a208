"""The Jacobian of an engine's own step has the spectral radius that theory gives the scheme it is identified with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import Engine
from engines.process.isolation import isolated
from engines.step_jacobian import own_jacobian, step_jacobian
from reference.growth_factor import growth_factor
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of
from reference.theory.limits import growth

#: Differences by perturbations of 8e-7 m are themselves good to 1e-9. But an engine may solve to 1e-8 m/s only, which is
#: 3e-4 of a perturbation in 0.02 s: as much of the growth factor is allowed, and schemes differ by far more.
TOLERANCE = 3e-4

#: Damped and at a dt [s] where the fastest mode turns by about half a radian a step.
DT, CASE = 2.5e-3, {"masses": 4, "damping": 0.05}


def resting(scheme: str) -> tuple[Equilibrium, float]:
    """The string at rest, on springs or rods; and a dt [s] beyond the limit of most, as rods swing more slowly."""
    stepper = catalogued()[scheme]
    return equilibrium_of(stepper.equations, find("string").system(CASE)), (40 if stepper.on_rods else 8) * DT


def radii(engine: Engine, system: MassSpringSystem, dt: float) -> tuple[float, float | None]:
    """By differences, and by the engine's own derivatives where it has them. Runs in the engine's process."""
    own = own_jacobian(engine, system, dt)
    return growth_factor(step_jacobian(engine, system, dt)), None if own is None else growth_factor(own)


def check_radius(measured: float, scheme: str) -> None:
    """Max |eigenvalue of J| of engine and scheme agree; without damping both are 1 and nothing would be shown."""
    predicted = growth(catalogued()[scheme].scheme, *resting(scheme))
    assert measured == pytest.approx(predicted, rel=TOLERANCE)


def test_an_engines_step_has_the_radius_of_its_scheme(engine: Engine) -> None:
    """At a dt up to twice beyond the limit of most, where the radius is far from 1, and another for each scheme."""
    if not {"stretched", "velocities", "damping"} <= engine.capabilities:
        pytest.skip(f"{engine.name} cannot start stretched, in motion and damped")
    scheme = engine.identified_as["damping"]
    rest, dt = resting(scheme)
    system = replace(find("string").system(CASE), positions=rest.state.positions)
    found = isolated(radii, engine, system, dt)
    assert not isinstance(found, Outcome), found
    by_differences, own = found
    check_radius(by_differences, scheme)
    if own is not None:
        check_radius(own, scheme)


def test_the_check_tells_schemes_apart() -> None:
    """The radius of drift-kick with implicit damping is not that of explicit damping."""
    implicit = growth(catalogued()["drift_kick_implicit_damping"].scheme, *resting("drift_kick_implicit_damping"))
    assert np.isfinite(implicit)
    with pytest.raises(AssertionError):
        check_radius(implicit, "kick_drift")
