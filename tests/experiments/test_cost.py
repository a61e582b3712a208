"""Costs: times by a clock that the tests wind, errors by the true motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.engine import version
from engines.process.isolation import EngineStepper
from experiments import cost
from experiments.benchmark.timing import Speeds, Timing
from experiments.cost import ANCHOR, DTS, MASSES, Cost, Point
from reference.compiled.kernels import advance, arrays_of, loops_for
from reference.compiled.loops import Loops
from reference.forces import SpringMotion
from reference.pendulum import PendulumMotion
from reference.schemes.catalogue import Scheme, find
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from report.figures import draw
from tests import wrong
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.reference.systems import label


def points_of(scheme: Scheme) -> list[Point]:
    """Its runs with all of DTS, in no time."""
    ends = [advance(cost.string(), scheme, dt, round(cost.DURATION / dt)).positions for dt in DTS]
    return cost.points([Timing(0.0, end) for end in ends], SpringMotion)


def check_order(scheme: Scheme) -> None:
    """Between the two smallest steps the error falls as dt to the order.

    The next term of the error is of relative size dt w, w = 4 1/s for the swings that matter: 0.05 is ample.
    """
    *_, larger, smaller = points_of(scheme)
    assert np.log2(larger.error / smaller.error) == pytest.approx(scheme.order, abs=0.05)


def test_every_kernel_that_is_timed_is_compiled_beforehand() -> None:
    """Strings of all sizes have no other loops than those of the sizes that are compiled, side by side, before."""

    def texts(sizes: tuple[int, ...]) -> set[str]:
        return {loops_for(find("heun"), cost.string(masses)).text() for masses in sizes}

    assert texts(cost.COMPILED_FOR) == texts((*cost.MASSES, *cost.MORE_MASSES))
    assert texts(cost.COMPILED_FOR[1:]) != texts(cost.MORE_MASSES)


@pytest.mark.parametrize("name", ["kick_drift", "drift_kick", "heun", "velocity_verlet", "rk4"])
def test_errors_fall_with_dt_as_the_order_says(name: str) -> None:
    """E(dt) / E(dt/2) = 2^order. Explicit Euler is left out: at these steps it grows, as it should."""
    check_order(find(name))


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "scheme",
    [
        wrong.heun_without_half,
        wrong.heun_of_the_wrong_pair,
        wrong.verlet_with_one_force,
        wrong.rk4_equally_weighted,
        wrong.kick_drift_kicked_twice,
    ],
    ids=label,
)
def test_the_order_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """They lose an order, or converge to nothing."""
    with pytest.raises(AssertionError):
        check_order(scheme)


def test_who_has_blown_up_has_no_error() -> None:
    """Euler at dt = 8 ms is beyond all bounds; at 0.5 ms it is not."""
    first, *_, last = points_of(find("euler"))
    assert first.error == np.inf
    assert last.error < 1e-2


def test_rigid_segments_are_compared_with_rods() -> None:
    """The pendulum's own end has no error; taken for a string of springs it is over a centimetre off."""
    end = cost.true_end(PendulumMotion)
    timings = [Timing(0.0, end)] * len(DTS)
    assert {p.error for p in cost.points(timings, PendulumMotion)} == {0.0}
    assert min(p.error for p in cost.points(timings, SpringMotion)) > 1e-2


def test_the_kernel_that_is_timed_takes_the_steps_it_is_told_to(monkeypatch: pytest.MonkeyPatch) -> None:
    """In 3 and 4 steps it leaves the bits of `kernels.advance` in 7; in 6 it does not."""
    arrays: dict[str, Any] = {}

    def keep(system: MassSpringSystem, loops: Loops) -> dict[str, Any]:
        arrays.update(arrays_of(system, loops))
        return arrays

    monkeypatch.setattr(cost, "arrays_of", keep)
    run = cost.kernel(cost.string(), find("heun"), 1e-3)
    run(3)
    run(4)
    seven, six = (advance(cost.string(), find("heun"), 1e-3, n, threads=1).positions[:, 0] for n in (7, 6))
    assert arrays["x0"].tolist() == seven.tolist()
    assert arrays["x0"].tolist() != six.tolist()


def made_up(name: str, seconds: float, error: float, runs_as: str = "kernel", identified_as: str | None = None) -> Cost:
    """A stepper whose steps all take so long [s], and whose runs all have that error [m]."""
    found = [Point(dt, round(cost.DURATION / dt) * seconds, error) for dt in DTS]
    return Cost(catalogued()[name], runs_as, identified_as or name, found, Speeds([seconds] * len(MASSES)))


def test_an_engine_that_crashes_or_is_not_there_is_a_failure_and_not_drawn() -> None:
    """With its reason; the figure shows the others."""
    crashed = cost.engine(EngineStepper(Misbehaving(Segfaults)))
    absent = cost.engine(EngineStepper(Misbehaving(Segfaults, package="no-such-engine")))
    result = cost.result_of([made_up(ANCHOR, 1e-7, 1e-2), crashed, absent])
    assert "SIGSEGV" in result.failures[0]
    assert result.failures[1] == "Segfaults: unsupported, no-such-engine is not installed"
    picture = draw("cost", result)
    assert "kick_drift" in picture.alt
    assert "Segfaults" not in picture.alt


@pytest.mark.parametrize(("name", "scheme"), [("pymunk_springs", "drift_kick"), ("mujoco_tendons_rk4", "rk4")])
def test_an_engine_ends_where_its_scheme_does(name: str, scheme: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error is the scheme's to 1e-4 of it (rounding, against errors down to 1e-9 m), and no other scheme's."""
    engine = find_engine(name)
    if version(engine) is None:
        pytest.skip(f"{engine.package} is not installed")
    monkeypatch.setattr(cost, "MASSES", (10,))
    errors = [p.error for p in cost.engine(EngineStepper(engine)).points]
    assert errors == pytest.approx([p.error for p in points_of(find(scheme))], rel=1e-4)
    assert errors != pytest.approx([p.error for p in points_of(find("kick_drift"))], rel=1e-4)
