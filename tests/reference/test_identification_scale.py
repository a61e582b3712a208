"""Tolerances are parts of a length that is never zero; velocities count as well as positions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.identification import identify, identify_run
from reference.identification.scale import fastest_rate_bound
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from tests.reference.identified import DT, Recorded
from tests.reference.systems import random_mesh


def one_mass(place: tuple[float, float] = (0.5, 1.0)) -> MassSpringSystem:
    """A mass on no spring."""
    return MassSpringSystem(
        positions=np.array([place]),
        springs=np.zeros((0, 2), dtype=int),
        masses=np.ones(1),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
    )


def test_a_mass_alone_falls_as_galilei_says() -> None:
    """x0 - g t^2 / 2, to rounding of 1 m: the solver's tolerance is a part of a length that is not zero."""
    true = exact(one_mass(), DT, 50)
    assert true.positions[:, 0, 1] == pytest.approx(1.0 - 9.81 * true.times**2 / 2, abs=1e-14)


@pytest.mark.parametrize("place", [(0.5, 1.0), (0.0, 0.0)])
def test_a_mass_alone_is_identified_though_an_ulp_off(place: tuple[float, float]) -> None:
    """Its system has no size; where it is, or 1 m, is what rounding is a part of."""
    system = one_mass(place)
    run = SchemeStepper(find("kick_drift")).run(system, DT, 50).trajectory
    assert run is not None
    nudged = Recorded(Outcome("done", "", replace(run, positions=run.positions + 1.1e-16)))
    found = identify(nudged, system, DT, 50)
    assert found.tolerance > 1e-13
    assert found.matches
    assert {"kick_drift", "backward_euler"} <= {match.scheme for match in found.matches}
    off = Recorded(Outcome("done", "", replace(run, positions=run.positions + 1e-9)))
    assert not identify(off, system, DT, 50).matches


def test_far_from_the_origin_positions_round_by_more() -> None:
    """At 1e6 m by 1e-10 m, a hundred of what a string of 1 m has for its tolerance; it is still Heun."""
    string = find_scene("string").system({"masses": 3})
    far = replace(string, positions=string.positions + 2.0**20)
    run = SchemeStepper(find("heun")).run(far, DT, 20).trajectory
    assert run is not None
    noise = 2e-10 * np.random.default_rng(0).uniform(-1, 1, run.positions.shape)
    known = {"heun": run}
    outcome = Outcome("done", "", replace(run, positions=run.positions + noise))
    assert identify_run("it", outcome, far, known).identified_as == "heun"
    near = {"heun": replace(run, positions=run.positions - 2.0**20)}
    outcome = Outcome("done", "", replace(run, positions=run.positions - 2.0**20 + noise))
    assert identify_run("it", outcome, string, near).identified_as is None


def test_the_same_positions_with_other_velocities_are_another_scheme() -> None:
    """Beeman's method has the positions of velocity Verlet, and velocities with h a/3 and h a'/6 of the last two.

    v = (x - x') / h + h (2 a + a') / 6, with x' and a' of a step before (Beeman, J. Comput. Phys. 20 (1976)).
    """
    system = find_scene("string").system({"masses": 3})
    run = SchemeStepper(find("velocity_verlet")).run(system, DT, 50).trajectory
    assert run is not None
    a = np.gradient(run.velocities, DT, axis=0)
    beeman = run.velocities.copy()
    beeman[1:] = np.diff(run.positions, axis=0) / DT + DT * (2 * a[1:] + a[:-1]) / 6
    beeman[:, system.fixed] = 0.0
    outcome = Outcome("done", "", replace(run, velocities=beeman))
    assert identify(Recorded(outcome), system, DT, 50).identified_as is None
    found = identify_run("recorded", outcome, system, {"velocity_verlet": run})
    assert found.identified_as is None
    assert found.ranking[0].scheme == "velocity_verlet"
    assert (found.ranking[0].positions, found.ranking[0].velocities > found.tolerance) == (0.0, True)
    assert "by its velocities times the step; its positions are the same to 0 m" in found.reason
    silent = np.concatenate([beeman[:1], np.full_like(beeman[1:], np.nan)])
    by_positions = Outcome("done", "", replace(run, velocities=silent))
    told_by_positions = identify_run("recorded", by_positions, system, {"velocity_verlet": run})
    assert told_by_positions.identified_as == "velocity_verlet"


@pytest.mark.parametrize("seed", range(10))
def test_the_bound_on_rates_holds_and_is_near(seed: int) -> None:
    """At least the largest frequency sqrt(k / m) of each spring alone with its ends, 1/m = 1/m_a + 1/m_b."""
    system = replace(random_mesh(seed, 6, 2), damping=np.zeros(1), drag=0.0)
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    alone = np.sqrt(system.stiffness * inverse[system.springs].sum(axis=1)).max()
    assert alone <= fastest_rate_bound(system) <= 4 * alone
    assert fastest_rate_bound(one_mass()) == 0.0
