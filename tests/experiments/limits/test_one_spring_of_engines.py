"""One damped spring at twenty damping ratios: where engines blow up, against closed forms, windows too."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from engines.engine import find as find_engine
from engines.engine import registry, version
from engines.measured_limit import ModeRun, growths_along_modes
from engines.process.isolation import EngineStepper
from engines.process.packages import APART
from experiments.limits.limit_rows import Row, stability_rows
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.layout import layout_of
from reference.theory.measured_mode import fastest_mode_of_step
from reference.theory.rates import rates
from tests.parts import PARTS
from tests.reference.theory.test_one_spring import ACROSS, RATIOS, M, W, explicit, exponential_edges, implicit

#: Measured limits are between two rungs of a ladder of 1 + 1e-4.
PRECISION = 1e-4

#: Growth in a step that is no rounding of a run.
SEEN = 2e-8

#: With critical damping the two rates along the spring are one, of which no mode can be told apart, and a perturbation
#: goes as n r^n in n steps: runs of random ones show a limit where n still wins.
CRITICAL = 5e-3

#: Engines that put rods for springs: these cannot start stretched, and have no damping along a rod.
ON_RODS = ("mujoco_cable", "mujoco_cable_rk4", "mujoco_rope")

#: Those that refuse damping along springs.
REFUSE = ("exudyn_springs_verlet",)


def spring(ratio: float) -> MassSpringSystem:
    """One mass, hanging."""
    return find_scene("spring").system({"damping": 2 * ratio * W * M})


def runge_kutta(ratio: float) -> float:
    """|R(h mu)| = 1, R of fourth order, for both rates along the spring and the pendulum's across it."""
    roots = W * (-ratio + np.array([1, -1]) * np.sqrt(complex(ratio**2 - 1)))

    def excess(h: float) -> float:
        z = h * np.array([*roots, 1j * ACROSS])
        return float(np.abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24).max() - 1)

    steps = np.linspace(1e-4, 0.5, 50_001)
    first = int(np.argmax([excess(h) > 1e-12 for h in steps]))
    return float(brentq(excess, steps[first - 1], steps[first], xtol=1e-12))


def exponential(ratio: float) -> float:
    """The first edge along the spring, or the pendulum's limit."""
    return min([2 / ACROSS, *exponential_edges(ratio)])


#: Where each engine blows up; None: the pendulum that no spring damps grows at any dt, (h w')^2 / 2 in a step.
CLOSED_FORMS = {
    "bullet_softbody": implicit,
    "exudyn_springs": runge_kutta,
    "exudyn_springs_euler": None,
    "mujoco_flex": explicit,
    "mujoco_flex_rk4": runge_kutta,
    "mujoco_tendons": explicit,
    "mujoco_tendons_eulerdamp": explicit,
    "mujoco_tendons_rk4": runge_kutta,
    "mujoco_tendons_implicit": implicit,
    "pymunk_springs": exponential,
    "pymunk_springs_backward": implicit,
}


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Another ratio or two every day, all under --full."""
    if "ratio" in metafunc.fixturenames:
        option = metafunc.config.option
        metafunc.parametrize("ratio", RATIOS if option.full else RATIOS[option.part :: PARTS])


def check_row(row: Row, ratio: float) -> None:
    """Measured as the closed form says."""
    if row.stepper in (*ON_RODS, *REFUSE):
        assert row.outcome == "unsupported"
        return
    assert row.outcome == "done", row.measured.reason
    closed_form = CLOSED_FORMS[row.stepper]
    if closed_form is None:
        assert row.measured.dt is None, f"{row.stepper}: {row.measured.dt}"
        assert "unstable at any dt" in row.measured.reason
        return
    precision = CRITICAL if ratio == 1.0 and closed_form is runge_kutta else PRECISION
    assert row.measured.dt == pytest.approx(closed_form(ratio), rel=precision), row.stepper


@pytest.mark.rotating(3)
def test_engines_blow_up_where_closed_forms_say(ratio: float) -> None:
    """All that are installed, from runs."""
    engines = [EngineStepper(engine) for engine in registry().values() if engine.package not in APART]
    there = [engine for engine in engines if engine.version is not None]
    for row in stability_rows(spring(ratio), there, lambda _: None):
        check_row(row, ratio)


def growths(ratio: float, steps: list[float]) -> list[float]:
    """Of Pymunk's springs in a step, in the mode that grows fastest by the scheme that they are."""
    rest, engine = spring_equilibrium(spring(ratio)), find_engine("pymunk_springs")
    scheme, nothing, runs = find("drift_kick_exponential_damping"), np.zeros_like(rest.state.positions), []
    for dt in steps:
        mode = fastest_mode_of_step(scheme, rest, dt, rates(rest))
        assert mode is not None
        shape = mode.shape * (1e-6 * rest.scale / np.abs(mode.shape).max())
        moved = layout_of(scheme, rest, dt)[0].state(shape, State(0.0, nothing, nothing))
        runs.append(ModeRun(dt, moved.positions, moved.velocities, mode.left))
    at_rest = replace(rest.system, positions=rest.state.positions)
    answer = EngineStepper(engine).isolate(growths_along_modes, engine, at_rest, runs)
    assert not isinstance(answer, Outcome), answer.reason
    found: list[float] = answer["growth"].tolist()
    return found


def check_windows(ratio: float, edges: list[float]) -> None:
    """Unstable between the two edges and beyond the pendulum's limit: looked at on both sides of each."""
    across = 2 / ACROSS
    steps = [edge * side for edge in (*edges, across) for side in (1 - PRECISION, 1 + PRECISION)]
    low, high = (*edges, np.inf)[:2] if edges else (np.inf, np.inf)
    expected = [dt > across or low < dt < high for dt in steps]
    assert [growth > SEEN for growth in growths(ratio, steps)] == expected


def test_pymunks_springs_are_stable_again_in_windows(ratio: float) -> None:
    """Where h^2 w^2 = 2 (1 + e^(h c/m)) has two roots, between the upper one and the pendulum's limit."""
    if version(find_engine("pymunk_springs")) is None:
        pytest.skip("pymunk is not installed")
    check_windows(ratio, exponential_edges(ratio))


def test_windows_fail_on_others() -> None:
    """Shown to fail: edges that are a thousandth off."""
    if version(find_engine("pymunk_springs")) is None:
        pytest.skip("pymunk is not installed")
    with pytest.raises(AssertionError):
        check_windows(0.14, [1.001 * edge for edge in exponential_edges(0.14)])


def test_a_closed_form_of_another_engine_is_caught() -> None:
    """Shown to fail: of implicit damping for explicit."""
    limit = Limit(implicit(0.2))
    with pytest.raises(AssertionError):
        check_row(Row("mujoco_tendons", "engine", spring(0.2), limit, limit), 0.2)
