"""Schemes run along their fastest mode blow up where theory says; other schemes elsewhere."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
import springlab

from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.theory import measured_mode
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.measured_mode import (
    SEEN,
    STEPS,
    fastest_mode_of_step,
    measured_mode_growth,
    measured_mode_limit,
    offsets,
)
from reference.theory.rates import rates
from tests import wrong
from tests.reference.systems import free_string, label, with_fields
from tests.reference.theory.test_random_systems import random_system

#: Measured to 1e-5 of itself, where growth of 1e-8 in a step is seen: a limit met by a pair of eigenvalues on the unit
#: circle, which grow as the root of the excess, is seen to about 1e-4.
TOLERANCE = 1e-4

#: Spring damping [N s/m] and drag [N s/m].
CASES: tuple[Mapping[str, float], ...] = ({}, {"damping": 0.1}, {"damping": 0.5}, {"drag": 0.1})

BY_THEORY = [s for s in schemes().values() if s.kind in ("scheme", "in_place")]


def string_at_rest(case: Mapping[str, float]) -> Equilibrium:
    """The default string of three masses, hanging."""
    return spring_equilibrium(find_scene("string").system({"masses": 3, **case}))


def check_measured_as_predicted(scheme: Scheme, run: Scheme, rest: Equilibrium) -> None:
    """|measured - predicted| < 1e-4 predicted, or neither has a limit: theory's eigenvalues against a run."""
    predicted = stability_limit(scheme, rest)
    measured = measured_mode_limit(run, rest, predicted, rates(rest))
    assert (predicted.dt is None) == (measured.dt is None)
    if predicted.dt is not None and measured.dt is not None:
        assert abs(measured.dt - predicted.dt) < TOLERANCE * predicted.dt


@pytest.mark.rotating(4)
@pytest.mark.parametrize("case", CASES, ids=str)
@pytest.mark.parametrize("scheme", BY_THEORY, ids=label)
def test_schemes_blow_up_where_predicted(scheme: Scheme, case: Mapping[str, float]) -> None:
    """In every case of damping and drag that the report shows."""
    check_measured_as_predicted(scheme, scheme, string_at_rest(case))


@pytest.mark.parametrize("scheme", ["kick_drift", "rk4"])
def test_what_falls_freely_blows_up_where_predicted(scheme: str) -> None:
    """A string that nothing holds: its perturbation is measured in the frame that falls with it.

    In the laboratory's frame the fall alone, g t^2 / 2 = 5 m in a second, is 1e6 times the perturbation.
    """
    rest = spring_equilibrium(with_fields(free_string(), gravity=np.array([0.0, -9.81])))
    check_measured_as_predicted(find(scheme), find(scheme), rest)
    mode = fastest_mode_of_step(find(scheme), rest, 1e-3, rates(rest))
    assert mode is not None
    seen = np.array([*offsets(find(scheme), rest, 1e-3, mode.shape)])
    assert len(seen) == STEPS + 1
    assert np.abs(seen).max() < 2 * np.abs(seen[0]).max()


@pytest.mark.rotating(3)
def test_a_window_of_stability_is_measured_where_it_is_predicted() -> None:
    """One spring whose damping ratio is near 0.24: stable, unstable, and stable again between two edges.

    Runs just outside them grow, and in their middle do not; each edge is bisected to 1e-5 of itself.
    """
    rest = spring_equilibrium(find_scene("spring").system({"damping": 0.95}))
    scheme = find("drift_kick_exponential_damping")
    predicted = stability_limit(scheme, rest)
    measured = measured_mode_limit(scheme, rest, predicted, rates(rest))
    assert len(predicted.windows) == 1
    assert np.array(measured.windows) == pytest.approx(np.array(predicted.windows), rel=TOLERANCE)


def test_a_scheme_that_steps_twice_too_far_is_caught() -> None:
    """Heun without its half has another limit than Heun: the check of limits fails on it."""
    with pytest.raises(AssertionError):
        check_measured_as_predicted(find("heun"), wrong.heun_without_half, string_at_rest({"drag": 0.1}))


def check_only_the_mode(scheme: Scheme, left_of: Scheme) -> None:
    """A run along a mode z is its eigenvalue's powers: in the left eigenvector, l z_n = mu^n l z_0, to 1e-4.

    The perturbation is the real part of the mode: of a pair of modes l picks one out. What is not linear is of the
    perturbation's size, 1e-6, in each of 200 steps.
    """
    rest, dt = string_at_rest({"drag": 0.1}), 1e-3
    mode = fastest_mode_of_step(left_of, rest, dt, rates(rest))
    assert mode is not None
    part = np.array([*offsets(scheme, rest, dt, mode.shape)]) @ mode.left.conj()
    assert len(part) == STEPS + 1
    assert part[1:] / part[:-1] == pytest.approx(part[1] / part[0], rel=1e-4)


@pytest.mark.parametrize("name", ["kick_drift", "heun", "rk4"])
def test_a_run_along_a_mode_stays_in_it(name: str) -> None:
    """Of three schemes below their limits."""
    check_only_the_mode(find(name), find(name))


def test_the_mode_of_another_scheme_is_not_kept() -> None:
    """Euler's left eigenvector does not tell modes of kick-drift apart."""
    with pytest.raises(AssertionError):
        check_only_the_mode(find("kick_drift"), find("euler"))


@pytest.mark.parametrize(
    ("expected", "looked_to", "measured"),
    [
        ((2.0, 3.0), np.inf, (2.0, 3.0)),
        ((2.002, 2.99), np.inf, (2.0, 3.0)),
        ((2.0, 2.9), 2.9, (2.0, 2.9)),
        ((2.0, 3.01), 3.01, (2.0, 3.0)),
        ((2.8, 3.5), np.inf, None),
    ],
)
def test_the_ends_of_a_window_are_measured_and_where_no_further_was_looked_it_may_go_on(
    expected: tuple[float, float], looked_to: float, measured: tuple[float, float] | None
) -> None:
    """Of runs that are stable from 2 to 3 s only."""
    found = measured_mode._window(lambda dt: not 2 <= dt <= 3, *expected, looked_to)
    assert found == (None if measured is None else pytest.approx(measured, rel=1e-4))


def test_a_step_of_which_one_derivative_is_no_number_has_no_mode(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where a spring has no direction; the others may be what they like."""
    rest = spring_equilibrium(find_scene("oscillator").system({}))
    found = rates(rest)
    assert fastest_mode_of_step(find("kick_drift"), rest, 1e-3, found) is not None
    jacobian = np.eye(2)
    jacobian[0, 1] = np.nan
    monkeypatch.setattr(measured_mode, "step_jacobian", lambda *_: jacobian)
    assert fastest_mode_of_step(find("kick_drift"), rest, 1e-3, found) is None
    assert measured_mode_growth(find("kick_drift"), rest, 1e-3, found) == np.inf


def test_what_an_iteration_tears_is_no_measured_growth() -> None:
    """A free string stepped by an iteration that stops early: runs are stable there, its torn eigenvalues are not."""
    rest = spring_equilibrium(with_fields(free_string(), damping=np.array(0.1), gravity=np.zeros(2)))
    scheme, found = find("kick_drift_truncated_damping"), rates(rest)
    measured = measured_mode_limit(scheme, rest, stability_limit(scheme, rest), found)
    assert found.unresisted > 0
    assert measured.reason.startswith("not measured: ")
    exact = find("kick_drift_implicit_damping")
    assert measured_mode_limit(exact, rest, stability_limit(exact, rest), found).dt is not None


@pytest.mark.parametrize("name", ["backward_euler", "bdf2", "euler_in_place"])
def test_what_falls_far_is_measured_as_what_does_not(name: str) -> None:
    """Two masses on a spring, along a line: in 120 steps of 0.4 s they fall for kilometres, beside moves of 1e-6 m."""
    at = {"masses": [0.1, 0.2], "stiffness": 50.0, "damping": 0.1}
    falls, floats = (
        spring_equilibrium(springlab.system([[0.0], [0.3]], [[0, 1]], gravity=gravity, **at)) for gravity in (9.81, 0.0)
    )
    scheme = find(name)
    measured = [measured_mode_limit(scheme, r, stability_limit(scheme, r), rates(r)) for r in (falls, floats)]
    assert measured[0] == measured[1]
    assert measured[0].reason.startswith("unstable at" if name == "euler_in_place" else "stable at all of")


@pytest.mark.parametrize(
    ("seed", "name", "why"),
    [
        (132, "heun_link_by_link", "of a mode that is all but one with others"),
        (246, "heun_aliased", f"too slow for a run of {STEPS} steps"),
    ],
)
def test_growth_that_rounding_may_hide_is_not_measured(seed: int, name: str, why: str) -> None:
    """Of systems that nothing holds: runs were off by 1.2e-4 and 6.7e-4 of the limit."""
    rest = spring_equilibrium(random_system(seed))
    scheme, found = find(name), rates(rest)
    limit = stability_limit(scheme, rest, found)
    assert limit.dt is not None
    beyond = fastest_mode_of_step(scheme, rest, 1.0001 * limit.dt, found)
    assert beyond is not None
    assert beyond.growth > SEEN
    assert (100 * beyond.rounding > beyond.growth) == why.startswith("of a mode")
    reason = measured_mode_limit(scheme, rest, limit, found).reason
    assert reason.startswith("not measured: growth at 1.0001 of the predicted limit is ")
    assert reason.endswith(f"a step, {why}")


def test_of_modes_that_stay_as_they_are_the_fastest_is_watched() -> None:
    """A mode of w = 5e-5/s beside one of 21/s: run along the slow one, rounding was growth at 0.9997 of the limit."""
    rest = spring_equilibrium(random_system(14))
    scheme, found = find("drift_kick_sequential_damping"), rates(rest)
    limit = stability_limit(scheme, rest, found)
    assert limit.dt is not None
    assert measured_mode_limit(scheme, rest, limit, found).dt == pytest.approx(limit.dt, rel=TOLERANCE)
    for part in np.linspace(0.9995, 0.9999, 9):
        mode = fastest_mode_of_step(scheme, rest, part * limit.dt, found)
        assert mode is not None
        assert mode.rounding < 1e-12


@pytest.mark.parametrize("name", ["kick_drift", "kick_drift_implicit_drag", "kick_drift_implicit_damping_and_drag"])
def test_where_two_modes_meet_rounding_is_no_growth(name: str) -> None:
    """At -1 on the unit circle: runs showed 1e-8 a step below the limit; 1e-4 of it above there is 3e-2."""
    rest = spring_equilibrium(random_system(48))
    scheme, found = find(name), rates(rest)
    limit = stability_limit(scheme, rest, found)
    assert limit.dt == pytest.approx(2 / found.fastest, rel=1e-9)
    assert measured_mode_limit(scheme, rest, limit, found).dt == pytest.approx(limit.dt, rel=TOLERANCE)
