"""Limits of large steps, looked for in a few moves: against all eigenvalues, of systems on which both can be had."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.theory import large_steps
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.large_steps import limit_of_large
from reference.theory.limits import stability_limit
from reference.theory.rates import fastest_rate
from reference.theory.runge_kutta import first_limits_along, stability_polynomial, stable_along

#: A subspace's limit is bisected to 1e-9 of itself, that of all eigenvalues to 1e-8 where growth is more than 1e-11: an
#: eigenvalue that passes -1 grows as fast as dt, or faster.
PRECISION = 3e-8


def cloth(damping: float, side: int = 5) -> Equilibrium:
    """Of 25 masses, or of another square, that hangs by an edge, with damping that differs from spring to spring."""
    system = find_scene("cloth").system({"rows": side, "columns": side, "pinned": "edge", "damping": damping})
    uneven = np.random.default_rng(0).uniform(0.5, 1.5, len(system.springs))
    return spring_equilibrium(replace(system, damping=damping * uneven))


def check_limit(scheme: Scheme, rest: Equilibrium, expected: float | None) -> None:
    """In a few moves."""
    assert rest.linear is not None
    assert expected is not None
    limit = limit_of_large(scheme, rest.linear, rest, 1 / fastest_rate(rest))
    assert limit.dt == pytest.approx(expected, rel=PRECISION)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("damping", [0.002, 0.02])
@pytest.mark.parametrize("name", ["velocity_verlet", "drift_kick_sequential_damping"])
def test_a_few_moves_give_the_limit_of_all_eigenvalues(name: str, damping: float) -> None:
    """The same number by Davidson's method and by bisection of dense eigenvalues."""
    rest = cloth(damping)
    check_limit(find(name), rest, stability_limit(find(name), rest).dt)


def test_a_limit_of_a_few_moves_fails_on_its_relative() -> None:
    """Shown to fail: the limit of kick-drift, from which the search for Verlet's begins, is another one."""
    rest = cloth(0.02)
    with pytest.raises(AssertionError):
        check_limit(find("velocity_verlet"), rest, stability_limit(find("kick_drift"), rest).dt)


@pytest.mark.parametrize(("part", "told"), [(1.0, True), (1.05, False)])
def test_a_limit_above_which_another_move_grows_is_not_told(
    part: float, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Few moves that miss the one that grows first would give a limit that is too long: all moves show that one."""
    scheme, rest = find("velocity_verlet"), cloth(0.02, side=3)
    limit = stability_limit(scheme, rest).dt
    assert limit is not None
    assert rest.linear is not None
    seen = part * limit
    misses = SimpleNamespace(beyond=lambda dt: dt - seen)
    monkeypatch.setattr(large_steps, "Outermost", lambda *_: misses)
    found = large_steps._near_a_relative(scheme, rest.linear, rest, 1 / fastest_rate(rest), seen)
    assert found == (pytest.approx(seen, rel=PRECISION) if told else None)


@pytest.mark.parametrize("name", ["euler", "heun", "rk4"])
def test_limits_along_many_angles_are_those_along_each(name: str) -> None:
    """Also on the axes, where powers of s cancel: the same roots, of many polynomials at once."""
    polynomial = stability_polynomial(find(name))
    assert polynomial is not None
    angles = np.concatenate([[np.pi / 2, np.pi], np.linspace(np.pi / 2, np.pi, 200)[1:-1]])
    directions = [1j, -1 + 0j, *np.exp(1j * angles[2:])]
    expected = [stable_along(polynomial, complex(direction))[0][1] for direction in directions]
    assert first_limits_along(polynomial, angles) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("damping", "told"), [(3.57, False), (0.1, True)])
def test_a_limit_below_which_perturbations_grow_is_not_told(damping: float, told: bool) -> None:
    """Springs damped one after another, strongly, are unstable from 75 ms on: 0.24 s, near their relative's, is none.

    On a chain of three, where all eigenvalues can be had (`test_strong_drag`); gently damped they are stable up to it.
    """
    system = find_scene("chain").system({"masses": 3, "mass": [0.0716, 6.93, 3.63], "damping": damping})
    rest, scheme = spring_equilibrium(system), find("drift_kick_sequential_damping")
    near = 0.2428 if damping > 1 else stability_limit(scheme, rest).dt
    assert near is not None
    limit = large_steps._unless_it_grows_before(scheme, rest, near)
    assert (limit.dt == near) == told
    assert limit.reason.startswith("not computed: perturbations grow in steps of") != told
