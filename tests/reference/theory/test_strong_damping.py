"""Limits in steps in which damping drowns all else, against a step that is written so that nothing is lost in it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.limit import Limit
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.schemes.implicit_damping import effective_masses, spring_directions
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory import strong_damping
from reference.theory.definite import Definiteness
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.linearisation import Linearisation
from reference.theory.rates import Rates, rates
from reference.theory.step_map import resisted
from reference.theory.strong_damping import DROWNED, drowned_from, limit_with_rods
from tests.reference.theory.test_rates import free_chain

#: Parts of a limit at which nothing may grow; and rounding of eigenvalues of some twenty numbers of some size.
BELOW, ROUNDING = (*np.geomspace(1e-3, 0.99, 60), 1 - 1e-6), 1e-11

#: How near above a limit growth is seen, which begins as the first power or the square of the distance.
ABOVE = 1e-5


def damped_once(rest: Equilibrium, dt: float) -> Array:
    """What is left of velocities, times the roots of the masses, once springs have been damped as each alone decays.

    (M + E)^-1 M with E = J^T e J and e_j = m_j (exp(dt c_j/m_j) - 1), which may be any number of powers of ten larger
    than M. By the matrix inversion lemma (Golub and Van Loan, *Matrix Computations* (2013), 2.1.4) that is
    1 - L^T (L L^T + 1/e)^-1 L with L = J M^-1/2: of 1/e only what counts is left, however large e.
    """
    system, free = rest.system, ~rest.system.fixed
    number = np.cumsum(free) - 1
    mass, directions = effective_masses(system), spring_directions(system, rest.state)
    lengthening = np.zeros((len(system.springs), *system.positions[free].shape))
    for j, (a, b) in enumerate(system.springs):
        for node, sign in ((a, -1), (b, 1)):
            if free[node]:
                lengthening[j, number[node]] += sign * directions[j] / np.sqrt(system.masses[node])
    rows = lengthening.reshape(len(lengthening), -1)
    decay = np.exp(-dt * system.damping / mass)
    softness = decay / (1 - decay) / mass
    return np.asarray(np.eye(rows.shape[1]) - rows.T @ np.linalg.solve(rows @ rows.T + np.diag(softness), rows))


def excess(rest: Equilibrium, found: Rates, dt: float) -> float:
    """Growth in a step: positions move on by dt v, forces change v, and damping takes its part of it."""
    assert rest.linear is not None
    stiffness = rest.linear.scaled_stiffness.toarray()
    same, damped = np.eye(len(stiffness)), damped_once(rest, dt)
    step = np.block([[same, same], [-dt * dt * damped @ stiffness, damped @ (same - dt * dt * stiffness)]])
    values = resisted(np.linalg.eigvals(step).astype(complex), found.unresisted, dt * found.fastest)
    return float(np.abs(values).max() - 1)


def strongly_damped(seed: int) -> Equilibrium | None:
    """A chain or a string of unequal masses, springs damped strongly or very strongly; None if it has no rest."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 6))
    masses = 0.02 * 10 ** rng.uniform(-1, 1, n)
    words = {"masses": n, "mass": masses.tolist(), "damping": float(10 ** rng.uniform(0, 3))}
    try:
        return spring_equilibrium(find_scene(str(rng.choice(["chain", "string"]))).system(words))
    except SolverError:
        return None


def check(limit: Limit, rest: Equilibrium) -> None:
    """Nothing grows below it and something does above; nothing anywhere, where all steps are said to be stable."""
    found = rates(rest)
    if limit.dt is None:
        assert limit.stable_steps == "any"
        units = (0.1, 1.0, 10.0, 100.0, 1000.0)
        # a pair of eigenvalues, and they are as large as the forces of a step
        assert all(excess(rest, found, unit / found.fastest) < ROUNDING * max(1.0, unit**2) for unit in units)
        return
    assert max(excess(rest, found, part * limit.dt) for part in BELOW) < ROUNDING
    assert excess(rest, found, (1 + ABOVE) * (limit.at_most or limit.dt)) > ROUNDING


def checked(seeds: range) -> int:
    """How many of these systems have a limit in steps that damping drowns: all are right."""
    drowned = 0
    for seed in seeds:
        rest = strongly_damped(seed)
        if rest is None:
            continue
        limit = stability_limit(find("drift_kick_exponential_damping"), rest)
        check(limit, rest)
        drowned += limit.dt is not None and "drown" in limit.note
    return drowned


@pytest.mark.rotating(3, in_turn=True)
def test_limits_in_drowned_steps_are_those_of_a_step_that_loses_nothing() -> None:
    """Some systems; `--full` has many."""
    assert checked(range(6)) > 0


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("part", [0.9, 1.1])
def test_a_limit_that_is_off_is_caught(part: float) -> None:
    """Shown to fail: ten per cent too short or too long."""
    rest = strongly_damped(1)
    assert rest is not None
    limit = stability_limit(find("drift_kick_exponential_damping"), rest)
    assert limit.dt is not None
    with pytest.raises(AssertionError):
        check(Limit(part * limit.dt), rest)


def test_many_more_drowned_steps(request: pytest.FixtureRequest) -> None:
    """Two hundred, under --full."""
    if not request.config.getoption("--full"):
        pytest.skip("--full looks at 200 systems")
    assert checked(range(200)) > 30


def held_by_a_rod(damping: float, **more: Any) -> Definiteness:
    """A chain along a line of a fixed mass and three of 1 kg, on 7, 10 and 40 N/m, the first spring damped strongly."""
    system = MassSpringSystem(
        positions=np.arange(4.0)[:, None],
        springs=np.array([[0, 1], [1, 2], [2, 3]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array([7.0, 10.0, 40.0]),
        damping=np.array([damping, 0.0, 0.0]),
        gravity=np.zeros(1),
        fixed=np.arange(4) == 0,
        **more,
    )
    return Definiteness(find("drift_kick_exponential_damping"), Linearisation(system, system.start), 0.1)


def test_beyond_a_drowned_spring_the_limit_is_that_of_what_it_holds() -> None:
    """The first mass stays where it is; the others swing with the w of [[50, -40], [-40, 40]]: 2 over the faster one.

    Drowned from h c/m = 18 on, with the m of a spring to a fixed mass.
    """
    definite = held_by_a_rod(1e4)
    fastest = float(np.sqrt(np.linalg.eigvalsh(np.array([[50.0, -40.0], [-40.0, 40.0]]))[-1]))
    assert drowned_from(definite) == pytest.approx(DROWNED / 1e4, rel=1e-12)
    assert limit_with_rods(definite, 0.01) == pytest.approx(2 / fastest, rel=1e-8)


def test_where_rods_hold_all_masses_nothing_is_unstable() -> None:
    """However long the step; and where nothing is damped nothing drowns."""
    definite = held_by_a_rod(1e4)
    whole = definite.with_system(definite.linear.system.with_parameter("damping", 1e4))
    assert limit_with_rods(whole, 0.01) == np.inf
    assert drowned_from(definite.with_system(definite.linear.system.with_parameter("damping", 0.0))) == np.inf


def test_the_slowest_swing_is_that_of_springs() -> None:
    """Of a free chain sqrt(k/m), its fall left out; without any spring's stiffness there is none."""
    chain = free_chain()
    free = Definiteness(find("kick_drift"), Linearisation(chain, chain.start), 0.1)
    assert strong_damping._slowest(free) == pytest.approx(np.sqrt(160.0), rel=1e-9)
    loose = chain.with_parameter("stiffness", 0.0)
    assert strong_damping._slowest(free.with_system(loose)) == np.inf


@pytest.mark.parametrize("size", [1.0, 1e6])
def test_moves_that_change_no_length(size: float) -> None:
    """Of six coordinates and two rods four are left, orthonormal and across both."""
    rods = np.random.default_rng(2).normal(size=(2, 6)) * size
    found = strong_damping._without_change(rods.T @ rods)
    assert found.shape == (6, 4)
    assert found.T @ found == pytest.approx(np.eye(4), abs=1e-12)
    assert rods @ found == pytest.approx(np.zeros((2, 4)), abs=1e-9 * size)
    assert strong_damping._without_change(np.zeros((3, 3))).shape == (3, 3)
