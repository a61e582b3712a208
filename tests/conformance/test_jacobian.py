"""The Jacobian of an engine's own step has the spectral radius that theory gives the scheme it is identified with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import Engine
from engines.isolation import isolated
from engines.jacobian import own_jacobian, spectral_radius, step_jacobian
from reference import catalogue
from reference.outcome import Outcome
from reference.scenes import find
from reference.stability import growth, spring_equilibrium
from reference.system import MassSpringSystem

#: Differences by pushes of 8e-7 m are themselves good to 1e-9. But an engine may solve to 1e-8 m/s only, which is 3e-4
#: of a push in 0.02 s; so much of the radius is allowed, and schemes differ by far more.
TOLERANCE = 3e-4

#: Damped and at a dt [s] where the fastest mode turns by about half a radian a step.
DT, CASE = 2.5e-3, {"masses": 4, "damping": 0.05}


def hanging() -> MassSpringSystem:
    """The string at rest."""
    system = find("string").system(CASE)
    return replace(system, positions=spring_equilibrium(system).state.positions)


def radii(engine: Engine, system: MassSpringSystem, dt: float) -> tuple[float, float | None]:
    """By differences, and by the engine's own derivatives where it has them. Runs in the engine's process."""
    own = own_jacobian(engine, system, dt)
    return spectral_radius(step_jacobian(engine, system, dt)), None if own is None else spectral_radius(own)


def check_radius(measured: float, scheme: str, dt: float) -> None:
    """Max |eigenvalue of J| of engine and scheme agree; without damping both are 1 and nothing would be shown."""
    predicted = growth(catalogue.find(scheme), spring_equilibrium(find("string").system(CASE)), dt)
    assert measured == pytest.approx(predicted, rel=TOLERANCE)


def test_an_engines_step_has_the_radius_of_its_scheme(engine: Engine) -> None:
    """At a dt twice beyond the limit of most, where the radius is far from 1 and differs from scheme to scheme."""
    if not {"stretched", "velocities", "damping"} <= engine.capabilities:
        pytest.skip(f"{engine.name} cannot start stretched, in motion and damped")
    dt = 8 * DT
    found = isolated(radii, engine, hanging(), dt)
    assert not isinstance(found, Outcome), found
    by_differences, own = found
    scheme = engine.identified_as["damping"]
    check_radius(by_differences, scheme, dt)
    if own is not None:
        check_radius(own, scheme, dt)


def test_the_check_tells_schemes_apart() -> None:
    """The radius of drift-kick with implicit damping is not that of explicit damping."""
    rest = spring_equilibrium(find("string").system(CASE))
    implicit = growth(catalogue.find("drift_kick_implicit_damping"), rest, 8 * DT)
    assert np.isfinite(implicit)
    with pytest.raises(AssertionError):
        check_radius(implicit, "kick_drift", 8 * DT)
