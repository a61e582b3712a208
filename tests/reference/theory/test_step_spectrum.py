"""First limits of steps that have no structure to tell them by, where hardly anything is damped."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.limit import Limit
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.system import MassSpringSystem
from reference.theory import step_spectrum
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.rates import Rates, rates


@pytest.mark.parametrize("damping", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize(
    ("name", "power", "part"),
    [("euler_in_place", 1, 0.5), ("heun_link_by_link", 3, 0.125), ("adams_bashforth_2", 3, 0.25)],
)
def test_an_oscillator_hardly_damped_has_the_limit_that_growth_by_a_power_of_dt_gives(
    name: str, power: int, part: float, damping: float
) -> None:
    """A mode w decays by g h in a step and grows by `part` (w h)^(power + 1): h w = (g / w / part)^(1 / power).

    Euler |1 + i w h| = 1 + (w h)^2 / 2; Heun 1 + (w h)^4 / 8; Adams-Bashforth of two steps 1 + (w h)^4 / 4, by their
    characteristic polynomials. What is left out is smaller by (w h)^2 and g / w: at most 2 in a hundred.
    Here w = 100 1/s and g is 25 times the damping. Were growth seen from 1e-11 on only, this were wrong a hundredfold.
    """
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": damping}))
    limit = stability_limit(find(name), rest).dt
    g, w = 25 * damping, 100.0
    expected = (g / w / part) ** (1 / power) / w
    assert limit == pytest.approx(expected, rel=2 * (expected * w) ** 2 + 1e-6)


@pytest.mark.parametrize("name", ["euler_in_place", "heun_aliased"])
def test_in_place_limits_are_in_proportion_to_damping_however_little_it_is(name: str) -> None:
    """On a chain, where they lose an order: growth by dt^2 against decay by g dt, down to g / w = 3e-11."""
    limits = [
        stability_limit(
            find(name), spring_equilibrium(find_scene("chain").system({"masses": 3, "damping": damping}))
        ).dt
        for damping in (1e-5, 1e-6, 1e-7)
    ]
    assert None not in limits
    assert limits == pytest.approx([limits[0], 0.1 * limits[0], 0.01 * limits[0]], rel=1e-6)  # type: ignore[operator, arg-type]


def test_in_place_euler_of_one_mass_is_euler_where_nothing_resists_a_motion() -> None:
    """One mass amid a string without tension: along it h < g/w^2, across it nothing pulls, and nothing grows.

    Growth beyond the limit is a ten-millionth in a step: that is no rounding of the motion across.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        damping=np.array(0.05),
        drag=0.0,
        gravity=np.array(0.0),
        fixed=np.array([True, False, True]),
    )
    limit = stability_limit(find("euler_in_place"), spring_equilibrium(system))
    assert limit.dt == pytest.approx(0.1 / 200, rel=1e-5)


@pytest.mark.parametrize("damping", [1e-3, 1e-7, 1e-9])
def test_rounding_of_what_is_remembered_is_no_growth(damping: float) -> None:
    """Verlet by positions on 100 1/s, hardly damped: 2/w, be the damping ever so small."""
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": damping}))
    assert stability_limit(find("stormer_verlet"), rest).dt == pytest.approx(0.02, rel=1e-6)


@pytest.mark.parametrize(
    ("powers", "expected"),
    [((2.0, 2.0), True), ((1.1, 1.0), True), ((1.5, 0.7), False), ((0.7, 1.5), False), ((3.0, 1.5), False)],
)
def test_growth_falls_as_a_power_of_dt_where_each_halving_says_the_same_power(
    powers: tuple[float, float], expected: bool
) -> None:
    """From 1 on, at steps each half the last: a power of 1 or more in both, the same one; and none of rounding."""
    grown = [1.0, 2.0 ** -powers[0], 2.0 ** -(powers[0] + powers[1])]
    assert step_spectrum._falls_as_a_power(grown, 0.0) == expected
    assert not step_spectrum._falls_as_a_power(grown, grown[-1])


@pytest.mark.parametrize(
    ("values", "start"),
    [
        ([10j, -10j, 3j, -3j], 1e-3),
        ([-200.0, -1.0], 5e-5),
        ([-1e-3 + 10j, -1e-3 - 10j, -1 + 5j, -1 - 5j], 2e-6),
        ([-1 + 5j, -1 - 5j, -1e-3 + 10j, -1e-3 - 10j, 2j, -2j], 2e-6),
    ],
)
def test_the_search_starts_where_every_step_is_right(values: list[complex], start: float) -> None:
    """A hundredth of the fastest 1/w; or a tenth of -2 Re mu / |mu|^2, where Euler lets a mode grow, of the first."""
    found = Rates(np.array(values, dtype=complex), 0, True)
    assert step_spectrum._start(find("kick_drift"), found, 1.0, linear=True) == pytest.approx(start, rel=1e-4)


@pytest.mark.parametrize("what", [np.nan, np.inf])
def test_a_step_of_which_one_derivative_is_no_number_grows_without_end(
    what: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the search, and where single modes are followed."""
    rest = spring_equilibrium(find_scene("oscillator").system({}))
    jacobian = np.diag([0.5, 0.5])
    jacobian[0, 1] = what
    monkeypatch.setattr(step_spectrum, "step_increments", lambda *_: jacobian)
    monkeypatch.setattr(step_spectrum, "step_jacobian", lambda *_: jacobian)
    assert step_spectrum._excess(find("kick_drift"), rest, 1e-3, rates(rest), None) == np.inf
    assert step_spectrum._growth_of_mode(find("kick_drift"), rest, 100j, 1e-3) == np.inf


def test_the_growth_of_a_mode_is_that_of_the_eigenvalue_next_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of e^(h mu), among others that are larger."""
    rest = spring_equilibrium(find_scene("oscillator").system({}))
    turn, scale = np.exp(0.3j), 1.01
    pair = scale * np.array([[turn.real, -turn.imag], [turn.imag, turn.real]])
    jacobian = np.block([[pair, np.zeros((2, 2))], [np.zeros((2, 2)), np.diag([-2.0, 0.1])]])
    monkeypatch.setattr(step_spectrum, "step_jacobian", lambda *_: jacobian)
    assert step_spectrum._growth_of_mode(find("kick_drift"), rest, 30j, 0.01) == pytest.approx(0.01, rel=1e-9)


def test_windows_of_what_an_iteration_would_come_to_are_kept_where_it_is_stable_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of three windows one in which it is unstable near an end, one in the middle; and only of steps that iterate."""
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": 0.1}))
    monkeypatch.setattr(step_spectrum, "windows_of", lambda *_: ((2.0, 3.0), (4.0, 5.0), (6.0, 7.0)))
    monkeypatch.setattr(step_spectrum, "looked_to", lambda *_: 9.0)
    monkeypatch.setattr(step_spectrum, "relative_of", lambda scheme, *_: "one" if scheme.order == 1 else None)
    limit, iterated = Limit(1.0), find("kick_drift_truncated_damping")

    def kept(scheme: Scheme, limit: Limit) -> Limit:
        return step_spectrum._with_windows(scheme, rest, 0.01, limit, lambda dt: 4.95 < dt < 5 or 6.4 < dt < 6.6)

    found = kept(iterated, limit)
    assert (found.windows, found.looked_to) == (((2.0, 3.0),), 9.0)
    assert kept(find("kick_drift"), limit) is limit
    assert kept(iterated, Limit(None, "stable at any dt")).windows == ()
    assert kept(replace(iterated, order=2), limit) is limit


@pytest.mark.parametrize(("masses", "drag", "damping"), [((0.1, 0.3), 1e-11, 0.0), ((100.0, 1e-4), 1e-11, 1e-9)])
def test_no_limit_is_told_where_growth_may_have_begun_unseen(
    masses: tuple[float, float], drag: float, damping: float
) -> None:
    """Two masses hardly damped: schemes that let all grow that nothing damps have limits of 4.4e-6 s and less.

    There growth and decay are 1e-16 in a step, and what is seen of growth begins at 2e-5 s. (Limits by 80 digits.)
    Velocity Verlet, without growth where nothing damps, has the limit 2/w to what damping adds.
    """
    rest = spring_equilibrium(
        MassSpringSystem(
            positions=np.array([[0.0], [1.0], [2.0]]),
            springs=np.array([[0, 1], [1, 2]]),
            masses=np.array([1.0, *masses]),
            rest_lengths=np.array(1.0),
            stiffness=np.array([50.0, 80.0]),
            damping=np.array([0.0, damping]),
            drag=drag,
            gravity=np.zeros(1),
            fixed=np.array([True, False, False]),
        )
    )
    for name in ("adams_bashforth_2", "euler_in_place", "heun_link_by_link"):
        found = stability_limit(find(name), rest)
        assert (found.dt, found.stable_steps) == (None, "unknown")
        assert found.reason.startswith("not computed: growth is seen at")
    assert stability_limit(find("velocity_verlet"), rest).dt == pytest.approx(2 / rates(rest).fastest, rel=1e-6)
