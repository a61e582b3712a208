"""Advice on dt: engines confirm it when run with it, and refute it beyond the limit; odd scenes are told plainly."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.engine import registry
from engines.measured_limit import growths_along_modes, limit_of_engine
from engines.process.isolation import EngineStepper, run_engine
from experiments.advice import advice as advice_module
from experiments.advice.advice import ADVISED, REFUTED, Advice, _left_out, advise, rest_of, rounded_down
from experiments.advice.wording import result_of
from experiments.limits.perturbed import perturbed
from reference.limit import Limit
from reference.measured_stability import random_growth
from reference.outcome import Outcome
from reference.scenes import Setup, find
from reference.system import MassSpringSystem
from tests.conformance.doctored import Doctored, KickDrift
from tests.engines.process.misbehaving import Misbehaving, Segfaults

#: Scenes a user might write, small: a stiff rope, a heavy net, a soft jello.
WRITTEN: Mapping[str, tuple[str, Mapping[str, Any], float]] = {
    "stiff rope": ("string", {"masses": 4, "stiffness": 5000.0, "mass": 0.05, "damping": 0.2}, 1e-3),
    "heavy net": ("cloth", {"rows": 3, "columns": 3, "mass": 0.05, "drag": 0.01}, 5e-3),
    "soft jello": ("jello", {"across": 2, "high": 2, "deep": 2, "stiffness": 20.0, "diagonals": 20.0}, 2e-2),
}

#: Two kinds of engines: explicit ones that take all scenes; the slow ones and those of planes are in the full report.
ASKED = ("mujoco_tendons", "mujoco_tendons_rk4")


class TwiceAsFar(KickDrift):
    """Goes two dt in a step: its limit is half of what is predicted of kick-drift, its rest the same."""

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        super().__init__(system, 2 * dt)


def setup_of(name: str) -> Setup:
    """A scene by its name above, for a tenth of a second."""
    scene, settings, dt = WRITTEN[name]
    return replace(find(scene).setup(settings, dt), duration=0.2)


def engine_of(name: str) -> EngineStepper:
    """An engine by name."""
    from engines.engine import find as find_engine

    return EngineStepper(find_engine(name))


@np.errstate(over="ignore", invalid="ignore")
def perturbations_grow(engine: EngineStepper, system: MassSpringSystem, dt: float) -> bool:
    """Whether a thousand steps by the engine make a small perturbation of rest ten times as large."""
    rest = rest_of(system)
    at_rest, start = perturbed(rest.motion.system, rest)  # type: ignore[attr-defined]
    outcome = run_engine(engine.engine, start, dt, 1000)
    assert outcome.trajectory is not None
    offsets = outcome.trajectory.positions - at_rest
    return bool(random_growth(offsets) == np.inf or np.abs(offsets[-1]).max() > 10 * np.abs(offsets[0]).max())


@cache
def of_the_stiff_rope() -> Advice:
    """The advice for the first of the scenes, for the first of the engines."""
    (advice,) = advise(setup_of("stiff rope"), [engine_of(ASKED[0])], lambda _: None)
    return advice


@cache
def of_the_honest() -> Advice:
    """The advice for the same scene, for an engine in this process whose limit is said to be 1 ms."""
    (advice,) = advise(setup_of("stiff rope"), [measuring(1e-3)], lambda _: None)
    return advice


def check_advice(engine: EngineStepper, setup: Setup, limit: float, advised: float) -> None:
    """The engine comes to the scene's end with the advised dt; perturbations grow at 1.1 of the limit, not at 0.9."""
    steps = max(1, round(setup.duration / advised))
    assert run_engine(engine.engine, setup.system, advised, steps).ending == "done"
    assert not perturbations_grow(engine, setup.system, ADVISED * limit)
    assert perturbations_grow(engine, setup.system, REFUTED * limit)


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", WRITTEN)
def test_the_engine_itself_confirms_and_refutes(name: str) -> None:
    """Run here, without what the advice was made by; predicted and measured limits agree to a part in 500."""
    setup = setup_of(name)
    engines = [engine_of(asked) for asked in ASKED]
    for engine, advice in zip(engines, advise(setup, engines, lambda _: None), strict=True):
        assert advice.limit is not None, advice.measured.reason
        assert advice.advised is not None
        assert advice.predicted.dt == pytest.approx(advice.limit, rel=2e-3)
        assert advice.confirmed is not None
        assert advice.confirmed.ending == "done"
        assert advice.grows is True
        check_advice(engine, setup, advice.limit, advice.advised)


def test_advice_for_another_limit_is_caught() -> None:
    """Shown to fail: of a limit twice too long the engine refutes the advice, of one half as long it confirms 1.1."""
    setup, engine = setup_of("stiff rope"), engine_of("mujoco_tendons")
    advice = of_the_stiff_rope()
    assert advice.limit is not None
    for wrong in (2 * advice.limit, advice.limit / 2):
        with pytest.raises(AssertionError):
            check_advice(engine, setup, wrong, 0.9 * wrong)


@pytest.mark.rotating(7)
def test_an_engine_with_another_limit_is_seen() -> None:
    """Two dt in a step halve the limit of kick-drift; what is predicted for others is not said of it."""
    setup = setup_of("stiff rope")
    engines = [EngineStepper(Doctored()), EngineStepper(Doctored(TwiceAsFar))]
    honest, liar = advise(setup, engines, lambda _: None)
    assert honest.limit is not None
    assert liar.limit is not None
    assert liar.scheme is None
    assert liar.predicted.dt is None
    assert liar.limit == pytest.approx(honest.limit / 2, rel=5e-3)
    check_advice(engines[1], setup, liar.limit, rounded_down(ADVISED * liar.limit))


def measuring(limit: float) -> EngineStepper:
    """The honest engine, done in this process, whose limit is measured as it is told [s]."""

    def here(task: Callable[..., Any], *arguments: Any, time_limit: float = 0.0) -> Any:
        if task is growths_along_modes:  # nothing is told by modes: it is measured at random then
            return {"growth": np.zeros(len(arguments[-1]))}
        return Limit(limit, grows_beyond=True) if task is limit_of_engine else task(*arguments)

    return EngineStepper(Doctored(), isolate=here)


@pytest.mark.rotating(2, in_turn=True)
@pytest.mark.parametrize("times", [1.08, 0.5])
def test_the_advised_step_is_below_the_shorter_of_both_limits(times: float) -> None:
    """Predicted and measured, whichever that is: where perturbations grow slowly, the measured one is too long."""
    setup = setup_of("stiff rope")
    honest = of_the_honest()
    assert honest.predicted.dt is not None
    measured = times * honest.predicted.dt
    (advice,) = advise(setup, [measuring(measured)], lambda _: None)
    assert (advice.predicted.dt, advice.measured.dt) == (honest.predicted.dt, measured)
    assert advice.advised == rounded_down(ADVISED * min(honest.predicted.dt, measured))


def test_a_step_beyond_the_limit_is_said_to_blow_up() -> None:
    """With what to use instead; and just below the limit it says so."""
    setup = setup_of("stiff rope")
    engine = engine_of("mujoco_tendons")
    advice = of_the_stiff_rope()
    assert advice.limit is not None
    assert any("is stable with margin" in finding for finding in result_of(setup, [advice]).findings)
    beyond = replace(setup, dt=1.5 * advice.limit)
    (finding,) = [f for f in result_of(beyond, advise(beyond, [engine], lambda _: None)).findings if "blows up" in f]
    assert f"use dt = {advice.advised:g} s or less" in finding
    just = replace(setup, dt=0.97 * advice.limit)
    assert any("only just" in finding for finding in result_of(just, [advice]).findings)


def test_scenes_that_have_no_limit_are_told_in_a_sentence() -> None:
    """One free mass; and a mass that nothing moves."""
    lone = MassSpringSystem(
        positions=np.zeros((1, 2)), velocities=np.ones((1, 2)), masses=np.ones(1), springs=np.zeros((0, 2), int),
        rest_lengths=np.zeros(0), stiffness=np.zeros(0), damping=np.zeros(0), drag=0.0, gravity=np.zeros(2),
        fixed=np.zeros(1, bool),
    )  # fmt: skip
    setup = Setup("lone", lone, 1e-3, 0.01)
    result = result_of(setup, advise(setup, [EngineStepper(Doctored())], lambda _: None))
    assert "any step is stable" in result.findings[0]


@pytest.mark.rotating(2, in_turn=True)
def test_an_engine_that_crashes_is_told_with_its_reason() -> None:
    """And the others have their advice."""
    setup = setup_of("stiff rope")
    engines = [EngineStepper(Misbehaving(Segfaults)), EngineStepper(Doctored())]
    result = result_of(setup, advise(setup, engines, lambda _: None))
    assert any("crashes" in finding for finding in result.findings)
    assert any("SIGSEGV" in failure for failure in result.failures)
    assert "1 of 1" in result.findings[0]
    assert any(finding.startswith("KickDrift") for finding in result.findings)


def test_steps_are_rounded_down_to_two_figures() -> None:
    """Never up."""
    assert [rounded_down(dt) for dt in (0.0129, 0.1, 0.00099999, 3.0)] == [0.012, 0.1, 0.00099, 3.0]


def test_a_rope_is_asked_on_any_mesh_and_a_pendulum_on_strings_only() -> None:
    """Rods in the masses' own coordinates take a triangle; the angles of a cable do not."""
    triangle = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]]),
        springs=np.array([[0, 1], [1, 2], [0, 2]]),
        masses=np.ones(3),
        rest_lengths=np.array([3.0, 4.0, 5.0]),
        stiffness=np.full(3, 100.0),
        fixed=np.array([True, False, False]),
    )
    assert _left_out(EngineStepper(registry()["mujoco_rope"]), triangle) is None
    left_out = _left_out(EngineStepper(registry()["mujoco_cable"]), triangle)
    assert left_out is not None
    assert "expected a string in 2D" in left_out.reason


@pytest.mark.parametrize(("scheme", "reasoned"), [("kick_drift", True), ("pendulum_rk4", False), (None, False)])
def test_reasons_are_of_schemes_that_step_the_scenes_own_springs(
    scheme: str | None, reasoned: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not of rods, nor of nobody."""
    setup = setup_of("stiff rope")
    predictions = SimpleNamespace(of_engine=lambda _: Limit(None, "none"))
    found = SimpleNamespace(identified_as=scheme, ties=["other"])
    monkeypatch.setattr(advice_module, "measure_engine", lambda *_: Limit(None, "not measured"))
    monkeypatch.setattr(advice_module, "reasons_of", lambda *_: "reasons")
    told = advice_module._advice(EngineStepper(Doctored()), setup, predictions, found, Outcome("done"))  # type: ignore[arg-type]
    assert told.reasons == ("reasons" if reasoned else None)
    assert (told.scheme, told.ties, told.advised) == (scheme, ("other",), None)


def test_who_takes_long_is_left_out_with_the_reason_and_no_way_around() -> None:
    """The report has no --stepper."""
    slow = EngineStepper(Doctored())
    object.__setattr__(slow.engine, "interactive_up_to", 2)
    left_out = _left_out(slow, find("string").system({"masses": 3}))
    assert left_out is not None
    assert left_out.reason == "left out: with more than 2 masses it takes long, here are 4"
