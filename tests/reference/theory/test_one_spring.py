"""One damped spring at twenty damping ratios: every scheme's first limit against its closed form, windows too."""

from __future__ import annotations

import numpy as np
import pytest

from reference.limit import Limit
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from tests import wrong

#: w = sqrt(k/m) = 100/s, m = 0.02 kg; across the spring a pendulum, w^2 = g/L with L = L0 + m g/k.
W, M = 100.0, 0.02
ACROSS = float(np.sqrt(9.81 / (0.125 + M * 9.81 / 200.0)))

RATIOS = (0.01, 0.02, 0.05, 0.08, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2, 0.22, 0.24, 0.26, 0.3, 0.4, 0.5, 0.7, 0.9, 1.0, 1.5)

#: Certified limits are bracketed to 1e-9 of themselves, others bisected to 1e-8.
PRECISION = 2e-8


def limit_of(scheme: Scheme, ratio: float) -> Limit:
    """The predicted limit of one mass on a spring, hanging."""
    return stability_limit(scheme, spring_equilibrium(find_scene("spring").system({"damping": 2 * ratio * W * M})))


def explicit(ratio: float) -> float:
    """h^2 w^2 + 2 g h = 4 with g = c/m = 2 zeta w: Jury's condition at -1."""
    return float(2 * (np.sqrt(ratio**2 + 1) - ratio) / W)


def implicit(ratio: float) -> float:
    """h^2 w^2 = 4 + 2 g h along the spring; across it h w' = 2, whichever is first."""
    return min(float(2 * (np.sqrt(ratio**2 + 1) + ratio) / W), 2 / ACROSS)


def exponential_edges(ratio: float) -> list[float]:
    """Where h^2 w^2 = 2 (1 + e^(h c/m)) along the spring [s], rising: none, or two."""
    h = np.linspace(1e-4, 60.0, 20_001) / W
    excess = (h * W) ** 2 - 2 * (1 + np.exp(2 * ratio * W * h))
    (crossings,) = np.nonzero(excess[:-1] * excess[1:] < 0)
    return [_newton(float(h[i]), ratio) for i in crossings]


def _newton(h: float, ratio: float) -> float:
    for _ in range(30):
        e = np.exp(2 * ratio * W * h)
        h -= ((h * W) ** 2 - 2 * (1 + e)) / (2 * h * W**2 - 4 * ratio * W * e)
    return float(h)


def check_limit(scheme: Scheme, ratio: float, expected: float) -> None:
    """The first limit is the closed form's."""
    assert limit_of(scheme, ratio).dt == pytest.approx(expected, rel=PRECISION)


@pytest.mark.parametrize("ratio", RATIOS)
def test_explicit_damping(ratio: float) -> None:
    """Kick-drift and drift-kick: sqrt(zeta^2 + 1) - zeta of 2/w."""
    check_limit(find("kick_drift"), ratio, explicit(ratio))
    check_limit(find("drift_kick"), ratio, explicit(ratio))


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("name", ["kick_drift_implicit_damping", "drift_kick_implicit_damping"])
def test_implicit_damping(name: str, ratio: float) -> None:
    """sqrt(zeta^2 + 1) + zeta of 2/w, or the pendulum's."""
    check_limit(find(name), ratio, implicit(ratio))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("ratio", RATIOS)
def test_exponential_damping_with_its_window(ratio: float) -> None:
    """Unstable between the two edges; a window from the upper one to where the pendulum gives up, if that is later."""
    edges, across = exponential_edges(ratio), 2 / ACROSS
    limit = limit_of(find("drift_kick_exponential_damping"), ratio)
    assert limit.dt == pytest.approx(min([across, *edges]), rel=PRECISION)
    if len(edges) == 2 and edges[1] < across and limit.dt < across:
        assert len(limit.windows) == 1
        assert limit.windows[0] == pytest.approx((edges[1], across), rel=1e-6)
    else:
        assert limit.windows == ()


def dragged(name: str, drag: float, weak: float = 0.0) -> Limit:
    """Of a mass along a line under drag [N s/m]; with a light one that hangs on it by a spring of `weak` [N/m]."""
    light = [[0.3]] if weak else []
    system = MassSpringSystem(
        positions=np.array([[0.0], [-0.1], *light]),
        springs=np.array([[0, 1], [1, 2]][: 2 if weak else 1]),
        masses=np.array([1.0, M, 3e-6][: 3 if weak else 2]),
        rest_lengths=np.array(0.1),
        stiffness=np.array([M * W**2, weak][: 2 if weak else 1]),
        damping=np.array(0.0),
        drag=drag,
        gravity=np.array(0.0),
        fixed=np.array([True, False, False][: 3 if weak else 2]),
    )
    return stability_limit(find(name), spring_equilibrium(system))


@pytest.mark.parametrize("ratio", [0.01, 0.2, 0.26, 0.5, 1.5])
def test_exponential_drag_has_the_edges_of_exponential_damping_or_none(ratio: float) -> None:
    """Where h^2 w^2 never comes to 2 (1 + e^(h Cd/m)), any step is stable, however long."""
    edges, limit = exponential_edges(ratio), dragged("kick_drift_exponential_drag", 2 * ratio * W * M)
    if edges:
        assert limit.dt == pytest.approx(edges[0], rel=PRECISION)
    else:
        assert limit.dt is None
        assert limit.reason == "stable at any dt"


def test_a_light_mass_that_drag_stops_hides_no_limit_of_a_heavy_one() -> None:
    """Its e^(h Cd/m) leaves no digits, from a fifteenth of the heavy one's limit on; to that one it is as if held."""
    ratio = 0.01
    limit = dragged("kick_drift_exponential_drag", 2 * ratio * W * M, weak=1e-9)
    assert limit.dt == pytest.approx(exponential_edges(ratio)[0], rel=PRECISION)
    assert "drag drowns all else" in limit.note


def test_a_window_whose_end_was_not_met_is_not_said_to_end() -> None:
    """Along a line nothing follows on the spring's window; across it the pendulum ends that, which is told."""
    open_ended = dragged("kick_drift_exponential_drag", 0.5)
    ended = limit_of(find("drift_kick_exponential_damping"), 0.2)
    assert open_ended.remark == "stable again from 0.219 s on, looked at up to 0.72 s"
    assert ended.remark.startswith("stable again from 0.09429 to ")
    assert "looked" not in ended.remark


@pytest.mark.rotating(3)
@pytest.mark.parametrize("ratio", RATIOS[::4])
def test_sequential_damping_of_one_spring_is_exponential(ratio: float) -> None:
    """One spring is damped by one impulse; its Jacobian is differenced, to 1e-8 of growth in a step."""
    edges = exponential_edges(ratio)
    limit, other = (limit_of(find(f"drift_kick_{name}_damping"), ratio) for name in ("sequential", "exponential"))
    assert limit.dt == pytest.approx(min([2 / ACROSS, *edges]), rel=1e-6)
    assert len(limit.windows) == len(other.windows)
    for one, expected in zip(limit.windows, other.windows, strict=True):
        assert one == pytest.approx(expected, rel=1e-6)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("ratio", RATIOS)
def test_rk4(ratio: float) -> None:
    """|R(h mu)| = 1 with mu = w (-zeta + sqrt(zeta^2 - 1)), the other root too, and the pendulum's i w'."""
    roots = W * (-ratio + np.array([1, -1]) * np.sqrt(complex(ratio**2 - 1)))
    h = np.linspace(1e-5, 0.5, 500_001)
    grown = [np.abs(1 + (z := h * mu) + z**2 / 2 + z**3 / 6 + z**4 / 24) > 1 + 1e-14 for mu in (*roots, 1j * ACROSS)]
    first = float(h[np.argmax(np.any(grown, axis=0))])
    assert limit_of(find("rk4"), ratio).dt == pytest.approx(first, rel=2e-4)


def test_strong_damping_by_hand() -> None:
    """K = 1e7 N/m, m = 1 kg: (c + sqrt(c^2 + 4 k m)) / k is 0.0400099975 s with c = 2e5, 0.0100398413 s with 5e4."""
    for damping, expected in ((2e5, 0.0400099975), (5e4, 0.0100398413)):
        system = find_scene("spring").system({"stiffness": 1e7, "mass": 1.0, "damping": damping})
        for name in ("drift_kick_implicit_damping", "kick_drift_implicit_damping_and_drag"):
            limit = stability_limit(find(name), spring_equilibrium(system))
            assert limit.dt == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("scheme", [wrong.kick_drift_kicked_twice, find("drift_kick_implicit_damping")])
def test_explicit_damping_fails_on_others(scheme: Scheme) -> None:
    """Shown to fail."""
    with pytest.raises(AssertionError):
        check_limit(scheme, 0.2, explicit(0.2))


@pytest.mark.parametrize("name", ["euler", "heun", "euler_in_place", "heun_link_by_link", "heun_aliased"])
def test_the_pendulum_that_no_spring_damps_grows_at_any_dt(name: str) -> None:
    """Damping along the spring damps no swing across it: |R(i z)| > 1 for Euler and Heun at any z > 0."""
    limit = limit_of(find(name), 0.2)
    assert limit.dt is None
    assert limit.growth is not None
    assert limit.growth > 0
