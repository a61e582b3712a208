"""Rates of modes against closed forms: one mass along a line, a free chain, and what nothing resists."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory import rates as module
from reference.theory.equilibria import Equilibrium, pendulum_equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.rates import NEAREST, Rates, fastest_rate, rates


def free_chain(**more: Any) -> MassSpringSystem:
    """Three masses of 0.5 kg on two springs of 80 N/m along a line, held nowhere: w^2 = 0, k/m and 3 k/m."""
    fields: dict[str, Any] = {
        "positions": np.array([[0.0], [1.0], [2.0]]),
        "springs": np.array([[0, 1], [1, 2]]),
        "masses": np.array(0.5),
        "rest_lengths": np.array(1.0),
        "stiffness": np.array(80.0),
        "gravity": np.zeros(1),
        **more,
    }
    return MassSpringSystem(**fields)


def rest(system: MassSpringSystem) -> Equilibrium:
    """Where it is."""
    return spring_equilibrium(system)


def test_undamped_modes_swing() -> None:
    """+- i w, and the two zeros of what goes on as it is begun."""
    found = rates(rest(free_chain()))
    w = np.sqrt([160.0, 480.0])
    assert np.sort(found.values.imag) == pytest.approx(np.sort([*w, *-w]), rel=1e-12)
    assert not found.values.real.any()
    assert (found.unresisted, found.all, found.least_decay) == (2, True, 0.0)
    assert found.fastest == fastest_rate(rest(free_chain())) == pytest.approx(np.sqrt(480), rel=1e-12)


@pytest.mark.parametrize(("c", "drag"), [(0.6, 0.0), (0.0, 0.4), (0.6, 0.4), (30.0, 0.0), (30.0, 0.4)])
def test_damped_modes_are_roots_of_their_quadratics(c: float, drag: float) -> None:
    """mu^2 + (c n + Cd)/m mu + k n/m = 0 with n = 1 and 3; with n = 0 the zeros, and the rate -Cd/m."""
    found = rates(rest(free_chain(damping=np.array(c), drag=drag)))
    expected = [root for n in (1, 3) for root in np.roots([1, (n * c + drag) / 0.5, n * 160.0])]
    expected += [-drag / 0.5] if drag else []
    assert np.sort_complex(found.values) == pytest.approx(np.sort_complex(np.array(expected)), rel=1e-9)
    assert found.unresisted == (1 if drag else 2)
    assert found.least_decay == pytest.approx(-max(np.real(expected)), rel=1e-9)
    assert found.fastest == pytest.approx(np.abs(expected).max(), rel=1e-9)


def check_some_of_all(found: Rates, every: Rates) -> None:
    """Each is one of all, of which there are as many conjugates, and among them is the fastest that swings or decays.

    To 1e-9 of itself; its real part to a thousandth, where it is all but lost beside the frequency: 1e-9 of it.
    """
    assert (found.all, found.unresisted, every.all) == (False, 0, True)
    assert len(found.values) >= NEAREST
    assert np.abs(every.values).max() == pytest.approx(found.fastest, rel=1e-4)
    for value in found.values:
        nearest = every.values[np.argmin(np.abs(every.values - value))]
        assert value == pytest.approx(nearest, rel=1e-9)
        assert value.real == pytest.approx(nearest.real, rel=1e-3)
        assert value.conj() in found.values


LARGE = [{}, {"damping": np.array(0.6), "drag": 0.4}, {"damping": np.array(30.0)}]


@pytest.mark.parametrize("more", LARGE, ids=str)
def test_of_large_systems_some_of_the_fastest_and_slowest_are_the_same(
    monkeypatch: pytest.MonkeyPatch, more: dict[str, Any]
) -> None:
    """By iteration, of a chain of thirty masses that nothing holds."""
    n = 30
    chain = free_chain(
        positions=np.arange(n)[:, None] * 1.0,
        springs=np.stack([np.arange(n - 1), np.arange(1, n)], axis=1),
        masses=np.linspace(0.3, 0.9, n),
        **more,
    )
    every = rates(rest(chain))
    monkeypatch.setattr(module, "ALL_UP_TO", 10)
    monkeypatch.setattr(module, "QUICK_UP_TO", 10)
    if more:
        check_some_of_all(rates(rest(chain)), every)
    assert fastest_rate(rest(chain)) == pytest.approx(every.fastest, rel=1e-6)


@pytest.mark.parametrize("damping", [1e-9, 1e-3, 0.1, 5.0])
def test_of_a_large_cloth_rates_and_limits_are_true(monkeypatch: pytest.MonkeyPatch, damping: float) -> None:
    """Damped weakly or strongly along its springs, hardly across them: no limit is above the one of all modes."""
    at_rest = rest(find_scene("cloth").system({"rows": 6, "columns": 7, "damping": damping}))
    every = rates(at_rest)
    true = {name: stability_limit(find(name), at_rest, every) for name in ("euler", "heun", "rk4")}
    monkeypatch.setattr(module, "ALL_UP_TO", 10)
    some = rates(at_rest)
    check_some_of_all(some, every)
    for name, expected in true.items():
        found = stability_limit(find(name), at_rest, some)
        assert expected.dt is not None
        assert found.stable_steps in ("up to a limit", "unknown")
        if found.dt is not None:
            assert found.dt <= (1 + 1e-8) * expected.dt <= (1 + 2e-8) * (found.at_most or found.dt)
        else:
            assert expected.dt <= float(found.reason.partition("unstable above ")[2].partition(" s")[0]) * (1 + 1e-3)


def test_of_a_long_chain_the_fastest_is_found_where_modes_crowd() -> None:
    """w^2 = 4 k/m sin^2((2 j - 1) pi / (2 (2 n + 1))), j = 1 to n, and g = w^2 c / k: mu = -g/2 + i sqrt(w^2 - g^2/4).

    Of 700 masses that springs of k = 50 N/m hold, the fastest hundred are within two per cent: iteration from outside
    had not ended after minutes. Neighbours differ by 1e-5 of themselves.
    """
    n, k, m, c = 700, 50.0, 0.1, 0.5
    chain = free_chain(
        positions=np.arange(n + 1)[:, None] * 1.0,
        springs=np.stack([np.arange(n), np.arange(1, n + 1)], axis=1),
        masses=np.full(n + 1, m),
        stiffness=np.array(k),
        damping=np.array(c),
        fixed=np.arange(n + 1) == 0,
    )
    square = 4 * k / m * np.sin((2 * np.arange(1, n + 1) - 1) * np.pi / (2 * (2 * n + 1))) ** 2
    found = rates(rest(chain))
    assert not found.all
    assert found.fastest == pytest.approx(np.sqrt(square.max()), rel=1e-5)
    for value in found.values:
        mode = np.argmin(np.abs(square - abs(value) ** 2))
        assert abs(value) ** 2 == pytest.approx(square[mode], rel=1e-6)
        assert -2 * value.real == pytest.approx(square[mode] * c / k, rel=1e-6)


def test_where_iteration_finds_nothing_a_bound_stands_for_the_fastest(monkeypatch: pytest.MonkeyPatch) -> None:
    """As with the chain above, of which no eigenvalue is found; no limit is then said not to be there."""
    import scipy.sparse.linalg as sparse

    def none(*_: object, **__: object) -> None:
        raise sparse.ArpackNoConvergence("none of %d", np.zeros(0), np.zeros((120, 0)))

    at_rest = rest(find_scene("cloth").system({"rows": 6, "columns": 7, "damping": 0.01}))
    fastest = rates(at_rest).fastest
    monkeypatch.setattr(module, "ALL_UP_TO", 10)
    monkeypatch.setattr(sparse, "eigs", none)
    found = rates(at_rest)
    assert len(found.values) == 0
    assert fastest <= found.fastest < 1.5 * fastest
    assert stability_limit(find("euler"), at_rest, found).stable_steps == "unknown"
    limit = stability_limit(find("rk4"), at_rest, found)
    assert (limit.certainty, limit.at_most) == ("between", None)
    assert limit.note.startswith("at least ")
    assert limit.dt == pytest.approx(2 * np.sqrt(2) / fastest, rel=0.1)


def on_a_line(**fields: Any) -> Equilibrium:
    """Two masses beside a fixed one, on two springs in a row, without weight."""
    given: dict[str, Any] = {
        "positions": np.array([[0.0], [1.0], [2.0]]),
        "springs": np.array([[0, 1], [1, 2]]),
        "rest_lengths": np.array(1.0),
        "fixed": np.array([True, False, False]),
        "gravity": np.zeros(1),
        **fields,
    }
    return rest(MassSpringSystem(**given))


def test_what_a_dashpot_alone_holds_drifts_to_rest() -> None:
    """A mass M on nothing but a damper c to a mass m on a spring k: one eigenvalue is zero, not two.

    The others are the roots of mu^3 + (c/m + c/M) mu^2 + k/m mu + c k/(m M). Euler's limit is the least
    -2 Re mu/|mu|^2; velocity Verlet, with velocities of damping half a step old, has one too.
    """
    m, big, k, c = 0.1, 0.3, 50.0, 3.0
    at_rest = on_a_line(masses=np.array([1.0, m, big]), stiffness=np.array([k, 0.0]), damping=np.array([0.0, c]))
    found, expected = rates(at_rest), np.roots([1.0, c / m + c / big, k / m, c * k / (m * big)])
    assert found.unresisted == 1
    assert np.sort_complex(found.values) == pytest.approx(np.sort_complex(expected), rel=1e-9)
    limit = (-2 * expected.real / np.abs(expected) ** 2).min()
    assert stability_limit(find("euler"), at_rest).dt == pytest.approx(limit, rel=1e-9)
    for name, dt in (("velocity_verlet", 0.05), ("leapfrog_kick_drift_kick", 0.1), ("stormer_verlet", 0.05)):
        assert stability_limit(find(name), at_rest).dt == pytest.approx(dt, rel=1e-6)


def test_a_heavy_mass_on_a_soft_spring_is_resisted() -> None:
    """Of k = 1e-2 N/m and 1e4 kg beside 1e4 N/m and 1 kg: w^2 of 1e-6 beside 1e4, and decay of 5e-14/s.

    The limit is the fast mode's, 2/w and 2 sqrt(2)/w: of 1e4 (1 + 1e-6) /s^2, as the soft spring adds to it.
    """
    springs = {"stiffness": np.array([1e4, 1e-2]), "damping": np.array([1e-6, 1e-9])}
    at_rest = on_a_line(masses=np.array([1.0, 1.0, 1e4]), **springs)
    found = rates(at_rest)
    assert (found.unresisted, len(found.values)) == (0, 4)
    assert np.abs(found.values).min() == pytest.approx(1e-3, rel=1e-5)
    fastest = np.sqrt(1e4 + 1e-2)
    for name, times in (("kick_drift", 2.0), ("velocity_verlet", 2.0), ("rk4", 2 * np.sqrt(2))):
        assert stability_limit(find(name), at_rest).dt == pytest.approx(times / fastest, rel=1e-7)


def test_motion_that_nothing_resists_may_decay_in_short_steps_and_grow_in_longer_ones() -> None:
    """A chain that nothing holds, damped on one side, by Heun link by link: to 1.757990 ms, by 40 digits.

    In steps of 1 ms that motion decays by 2.1e-10, in steps of 1.8 ms it grows by 7e-11.
    """
    springs = {"stiffness": np.array([50.0, 80.0]), "damping": np.array([0.1, 0.0])}
    free = on_a_line(masses=np.array([1.0, 2.0, 3.0]), fixed=np.zeros(3, dtype=bool), **springs)
    assert stability_limit(find("heun_link_by_link"), free).dt == pytest.approx(1.757990e-3, rel=1e-6)


def test_of_other_equations_by_eulers_step() -> None:
    """A pendulum of one rod: w^2 = g/l about hanging; its mass's drag decays at Cd/2m."""
    system = find_scene("string").system({"masses": 1, "mass": 0.2, "drag": 0.3, "angle": 90.0, "rest_length": 0.5})
    found = rates(pendulum_equilibrium(system))
    assert found.values.real == pytest.approx(np.full(2, -0.75), rel=1e-5)
    assert np.sort(found.values.imag) == pytest.approx(np.sqrt(9.81 / 0.5 - 0.75**2) * np.array([-1, 1]), rel=1e-5)
    assert (found.unresisted, found.all) == (0, True)


@pytest.mark.parametrize("c", [1e-6, 1e-10, 1e-12, 1e-15])
def test_modes_that_hardly_decay_have_the_digits_of_their_damping(c: float) -> None:
    """-c n/(2 m), n = 1 and 3, to first order in c: of eigenvalues themselves rounding leaves 1e-15 of the fastest."""
    found = rates(rest(free_chain(damping=np.array(c))))
    assert np.sort(-found.values.real) == pytest.approx(np.repeat([c, 3 * c], 2), rel=1e-6, abs=0)
    assert found.least_decay == pytest.approx(c, rel=1e-6, abs=0)


def test_modes_of_one_frequency_are_told_apart_by_what_damps_them() -> None:
    """Two masses alike on springs alike, damped by 1e-12 and 5e-12 N s/m, decay at c/(2 m) each."""
    system = MassSpringSystem(
        positions=np.array([[0.0], [1.0], [3.0], [4.0]]),
        springs=np.array([[0, 1], [2, 3]]),
        masses=np.array(0.5),
        rest_lengths=np.array(1.0),
        stiffness=np.array(80.0),
        damping=np.array([1e-12, 5e-12]),
        fixed=np.array([True, False, True, False]),
        gravity=np.zeros(1),
    )
    found = rates(rest(system))
    assert np.sort(-found.values.real) == pytest.approx([1e-12, 1e-12, 5e-12, 5e-12], rel=1e-9, abs=0)


def test_what_dampers_do_not_see_does_not_decay() -> None:
    """Two masses on three springs, that in the middle damped: the mode in which both move alike keeps on."""
    system = MassSpringSystem(
        positions=np.array([[0.0], [1.0], [2.0], [3.0]]),
        springs=np.array([[0, 1], [1, 2], [2, 3]]),
        masses=np.array(0.3),
        rest_lengths=np.array(1.0),
        stiffness=np.array([70.0, 11.0, 70.0]),
        damping=np.array([0.0, 0.1, 0.0]),
        fixed=np.array([True, False, False, True]),
        gravity=np.zeros(1),
    )
    found = rates(rest(system))
    assert np.sort(found.values.real) == pytest.approx([-1 / 3, -1 / 3, 0.0, 0.0], rel=1e-12, abs=0)
