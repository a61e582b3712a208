"""The Jacobian of an engine's own step has the growth factor that theory gives the scheme it claims to be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import Engine, precision
from engines.process.isolation import interpreter_for, isolated
from engines.step_jacobian import own_jacobian, step_jacobian
from reference.growth_factor import growth_factor
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of
from reference.theory.limits import growth

#: Differences by perturbations of 8e-7 m are themselves good to 1e-9. But an engine may solve to 1e-8 m/s only, which
#: is 3e-4 of a perturbation in 0.02 s: as much of the growth factor is allowed, and schemes differ by far more.
TOLERANCE = 3e-4

#: Damped and at a dt [s] where the fastest mode turns by about half a radian a step.
DT, CASE = 2.5e-3, {"masses": 4, "damping": 0.05}


def resting(scheme: str) -> tuple[Equilibrium, float]:
    """The string at rest, on springs or distance constraints, which swing more slowly; a dt [s] beyond most limits."""
    stepper = stepper_named(scheme)
    return equilibrium_of(stepper.equations, find("string").system(CASE)), (40 if stepper.on_rods else 8) * DT


def factors(engine: Engine, system: MassSpringSystem, dt: float) -> tuple[float, float | None]:
    """By differences, and by the engine's own derivatives where it has them. Runs in the engine's process."""
    own = own_jacobian(engine, system, dt)
    return growth_factor(step_jacobian(engine, system, dt)), None if own is None else growth_factor(own)


#: And an engine's own derivatives, which are differences of second order.
OWN_TOLERANCE = 1e-8


def check_factor(measured: float, scheme: str, tolerance: float = TOLERANCE) -> None:
    """Max |eigenvalue of J| of engine and scheme agree; without damping both are 1 and nothing would be shown."""
    predicted = growth(stepper_named(scheme).scheme, *resting(scheme))
    assert measured == pytest.approx(predicted, rel=tolerance)


@pytest.mark.rotating(3)
def test_an_engines_step_has_the_growth_factor_of_its_scheme(engine: Engine) -> None:
    """At a dt up to twice beyond the limit of most, where the factor is far from 1, and another for each scheme."""
    if precision(engine) == "single":
        pytest.skip("of perturbations of 8e-7 m single precision leaves nothing")
    if not {"2d", "stretched", "velocities", "damping"} <= engine.capabilities:
        pytest.skip(f"{engine.name} cannot start stretched, in motion and damped in the plane")
    scheme = engine.identified_as["damping"]
    rest, dt = resting(scheme)
    system = replace(find("string").system(CASE), positions=rest.state.positions)
    if interpreter_for((engine,)) is not None:
        jacobian = isolated(step_jacobian, engine, system, dt)
        assert not isinstance(jacobian, Outcome), jacobian
        check_factor(growth_factor(jacobian), scheme)
        return
    found = isolated(factors, engine, system, dt)
    assert not isinstance(found, Outcome), found
    by_differences, own = found
    check_factor(by_differences, scheme)
    if own is not None:
        check_factor(own, scheme, OWN_TOLERANCE)


def test_the_check_tells_schemes_apart() -> None:
    """The growth factor of drift-kick with implicit damping is not that of explicit damping."""
    implicit = growth(stepper_named("drift_kick_implicit_damping").scheme, *resting("drift_kick_implicit_damping"))
    assert np.isfinite(implicit)
    with pytest.raises(AssertionError):
        check_factor(implicit, "kick_drift")
