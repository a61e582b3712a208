"""First-order instability: the fastest mode grows as predicted, and is what blows the string up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments import first_order_instability as instability
from experiments.first_order_instability import DT, Fate, fastest_mode, fate, mode_sizes, perturbed, predicted_factor
from reference.motion import Motion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import State, Trajectory
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.equilibrium import hanging_string
from reference.theory.exact import exact
from reference.theory.limits import growth
from reference.theory.modes import squared_frequencies
from report.figures import draw
from tests import wrong
from tests.reference.systems import label


def string(drag: float = 0.02, masses: int = 10) -> MassSpringSystem:
    """The default string."""
    return find_scene("string").system({"drag": drag, "masses": masses})


def stability_function(order: int, z: complex) -> complex:
    """Of Runge-Kutta methods with as many stages as their order: the exponential series up to there."""
    return complex(sum(z**k / np.prod(np.arange(1, k + 1)) for k in range(order + 1)))


def check_growth(measured: float, order: int, drag: float) -> None:
    """|R(h l)|, l = -Cd/(2m) + i (w^2 - (Cd/2m)^2)^(1/2), w the frequency of the fastest mode by its formula.

    A perturbation of 1e-9 m is measured to 2e-16 of the 1.4 m that the string hangs: 2e-7 of itself, which the fit over
    500 steps divides by as many; the size wobbles by Cd/(2 m w) = 0.0025 (0.01 at most here) with the swing, of which
    the fit leaves some 1e-6.
    """
    frequency = 2 * np.sqrt(200.0 / 0.02) * np.sin(19 / 42 * np.pi)
    decay = drag / (2 * 0.02)
    z = DT * complex(-decay, np.sqrt(frequency**2 - decay**2))
    assert measured == pytest.approx(abs(stability_function(order, z)), abs=1e-6)


def check_predicted(scheme: Scheme, order: int, drag: float) -> None:
    """The same |R(h l)|, to the rounding of a step's Jacobian: predicted and measured are of one mode."""
    frequency = 2 * np.sqrt(200.0 / 0.02) * np.sin(19 / 42 * np.pi)
    decay = drag / (2 * 0.02)
    z = DT * complex(-decay, np.sqrt(frequency**2 - decay**2))
    assert predicted_factor(string(drag), scheme) == pytest.approx(abs(stability_function(order, z)), abs=1e-11)


METHODS = [("euler", 1), ("heun", 2), ("rk4", 4)]


@pytest.mark.parametrize("drag", [0.0, 0.02, 0.1])
@pytest.mark.parametrize(("name", "order"), METHODS)
def test_a_push_grows_as_the_stability_function_says(name: str, order: int, drag: float) -> None:
    """Measured, and predicted."""
    check_growth(perturbed(string(drag), find(name)), order, drag)


@pytest.mark.parametrize("drag", [0.0, 0.02, 0.1])
@pytest.mark.parametrize(("name", "order"), METHODS)
def test_what_is_predicted_is_the_growth_of_the_same_mode(name: str, order: int, drag: float) -> None:
    """Of the fastest, by its stability function, whether it grows or dies away."""
    check_predicted(find(name), order, drag)


def test_the_growth_factor_of_the_whole_step_is_another_quantity() -> None:
    """That of all modes, and no less than 1 - 1e-6: Heun multiplies the fastest mode by 1 - 3.2e-4."""
    whole = growth(find("heun"), spring_equilibrium(string()), DT)
    assert abs(whole - predicted_factor(string(), find("heun"))) > 1e-4


@pytest.mark.parametrize(
    ("scheme", "order"), [(wrong.heun_without_half, 2), (find("heun"), 1), (find("rk4"), 2)], ids=label
)
def test_the_predicted_growth_fails_on_other_integrators(scheme: Scheme, order: int) -> None:
    """Each multiplies the mode by something else."""
    with pytest.raises(AssertionError):
        check_predicted(scheme, order, 0.02)


@pytest.mark.parametrize(
    ("scheme", "order"),
    [
        (wrong.heun_without_half, 2),
        (wrong.heun_of_the_wrong_pair, 2),
        (find("velocity_verlet"), 4),
        (wrong.explicit_in_place_of_backward, 1),
        (wrong.stepped(wrong.damping_turned, find("euler")), 1),
        (wrong.stepped(wrong.one_sided, find("heun")), 2),
        (find("heun"), 1),
        (find("heun_link_by_link"), 2),
    ],
    ids=label,
)
def test_the_growth_fails_on_other_integrators(scheme: Scheme, order: int) -> None:
    """Each multiplies the mode by something else, or mixes it with others."""
    with pytest.raises(AssertionError):
        check_growth(perturbed(string(), scheme), order, 0.02)


@pytest.mark.parametrize("masses", [1, 2, 3, 10])
def test_the_fastest_mode_is_that_of_the_assembled_springs(masses: int) -> None:
    """Its frequency is the largest of K q = w^2 M q, to rounding; with a mass more it is another."""
    system = string(masses=masses)
    largest = np.sqrt(squared_frequencies(system, hanging_string(system))[-1])
    assert fastest_mode(system)[1] == pytest.approx(largest, rel=1e-9)
    assert fastest_mode(string(masses=masses + 1))[1] != pytest.approx(largest, rel=1e-4)


def swung(system: MassSpringSystem, number: int, size: float, phase: float) -> tuple[Trajectory, Trajectory]:
    """A hanging string in its mode of that number along itself, and at rest: by the formula for all of them."""
    rest = hanging_string(system)
    n = len(system.springs)
    angle = (2 * number - 1) * np.pi / (2 * n + 1)
    shape = size * np.sin(angle * np.arange(n + 1))
    frequency = 2 * np.sqrt(200.0 / 0.02) * np.sin(angle / 2)
    moved = replace(rest, positions=rest.positions.copy(), velocities=rest.velocities.copy())
    moved.positions[:, 1] += np.cos(phase) * shape
    moved.velocities[:, 1] -= frequency * np.sin(phase) * shape
    return Trajectory.of([moved]), Trajectory.of([rest])


@pytest.mark.parametrize("phase", [0.0, 1.0, np.pi / 2])
def test_the_size_of_the_fastest_mode_is_what_is_in_it(phase: float) -> None:
    """All of it at any phase of its swing, and nothing of the other modes, which are orthogonal: to rounding of 1 m."""
    system = string()
    assert mode_sizes(system, *swung(system, 10, 1e-3, phase)) == pytest.approx([1e-3], rel=1e-10)
    for other in range(1, 10):
        assert mode_sizes(system, *swung(system, other, 1e-3, phase)) == pytest.approx([0.0], abs=1e-13)


def euler_in_halves(motion: Motion, state: State, dt: float) -> State:
    """Euler, twice with half the step: its fastest mode grows by half the rate."""
    halfway = state + dt / 2 * motion.slope(state)
    return halfway + dt / 2 * motion.slope(halfway)


@pytest.fixture(scope="module")
def fates() -> dict[str, Fate]:
    """Euler's, Heun's, and that of a doctored Euler."""
    system = string()
    true = exact(system, DT, round(instability.DURATION / DT))
    schemes = [find("euler"), find("heun"), Scheme(euler_in_halves, 1, "scheme")]
    return {scheme.name: fate(system, scheme, true) for scheme in schemes}


def check_blow_up(found: Fate) -> None:
    """The fastest mode of the swinging string grows at Euler's predicted rate, and tears it apart.

    Within a tenth of the rate: the swinging string is not the hanging one, tension and shape change meanwhile.
    """
    euler = growth(find("euler"), spring_equilibrium(string()), DT)
    assert found.predicted == pytest.approx(euler, abs=1e-9)
    assert found.swinging is not None
    assert np.log(found.swinging) == pytest.approx(np.log(euler), rel=0.1)
    assert found.distance[-1] > string().size


def test_euler_blows_up_by_its_fastest_mode(fates: dict[str, Fate]) -> None:
    """As predicted by the spectral radius of its step."""
    check_blow_up(fates["euler"])


@pytest.mark.parametrize("name", ["heun", "euler_in_halves"])
def test_others_at_the_same_step_do_not(fates: dict[str, Fate], name: str) -> None:
    """Heun's fastest mode dies away; that of Euler in halves grows, but not so fast."""
    with pytest.raises(AssertionError):
        check_blow_up(replace(fates[name], predicted=fates["euler"].predicted))


def test_heun_swings_on(fates: dict[str, Fate]) -> None:
    """Its distance from the true motion stays what its order makes it: 1e-3 of the string's length at most."""
    heun = fates["heun"]
    assert heun.predicted < 1
    assert heun.swinging is None
    assert heun.distance.max() < 1e-3


def test_findings_and_figure_are_made_from_the_fates(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another scheme and drag, other sentences: here nothing grows, and nobody is said to."""
    monkeypatch.setattr(instability, "SCHEMES", ("rk4",))
    monkeypatch.setattr(instability, "DURATION", 0.3)
    result = instability.run(lambda _: None)
    said = " ".join(result.findings)
    (only,) = result.data["fates"]
    assert (
        f"rk4 is predicted to multiply the fastest mode by {only.predicted:.5f} in a step, so that it dies away" in said
    )
    assert f"measured: {only.perturbed:.5f}" in said
    assert "swinging" not in said
    assert "euler" not in said
    assert [result.tables[0].rows[0][i] for i in (3, 5)] == [None, None]
    assert "rk4" in draw("first_order_instability", result).alt
    gone = replace(only, distance=np.where(np.arange(len(only.distance)) > 200, np.inf, only.distance))
    lost = replace(result, data={**result.data, "fates": [gone]})
    assert "rk4 not a finite number" in draw("first_order_instability", lost).alt


def test_the_string_is_held_by_a_mass_that_says_nothing() -> None:
    """The frequency is that of the masses that move."""
    system = find_scene("string").system({"masses": 3})
    held = replace(system, masses=np.array([50.0, *system.masses[1:]]))
    assert fastest_mode(held)[1] == fastest_mode(system)[1]


def test_growth_is_fitted_to_the_last_rise_before_it_is_large() -> None:
    """By a twentieth in a step, after it was small twice, up to where it is large first; and not what comes after."""
    low, high = instability.GROWING
    rise = low * 1.05 ** np.arange(round(np.log(high / low) / np.log(1.05)) + 3)
    before = np.array([0.1 * low, 3 * low, 0.5 * low])
    sizes = np.concatenate([before, rise[1:], [0.1 * low, 9 * high, 5 * high]])
    assert instability._fit(sizes) == pytest.approx(1.05, rel=1e-9)
    assert instability._fit(sizes[:20]) is None


def test_a_mode_is_measured_as_far_as_the_motion_goes() -> None:
    """One that blew up ends before the true motion does."""
    system = find_scene("string").system({"masses": 3})
    whole = simulate(system, find("heun"), DT, 10 * DT)
    sizes = mode_sizes(system, whole.frames(slice(4)), simulate(system, find("euler"), DT, 10 * DT))
    assert len(sizes) == 4
    assert sizes[0] == 0.0
    assert (sizes[1:] > 0).all()


def test_of_a_mode_that_creeps_the_larger_of_two_factors_is_predicted() -> None:
    """Euler's are 1 + dt u, with u of u^2 + (Cd/m) u + w^2 = 0: here two real ones, far from one another."""
    system = find_scene("string").system({"masses": 2, "drag": 20.0})
    rates = np.roots([1.0, 20.0 / system.masses[-1], fastest_mode(system)[1] ** 2])
    factors = np.abs(1 + DT * rates)
    assert factors.max() > 1.5 * factors.min()
    assert predicted_factor(system, find("euler")) == pytest.approx(factors.max(), rel=1e-5)
