"""Experiments from their first to their last run, with runs that take no time: what is asked of whom, and in order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.process.isolation import EngineStepper
from experiments import barrier, cost, drape, stability
from experiments.barrier import ALONG, INWARDS, OWN, PRINTED, Slide
from experiments.benchmark.timing import Speeds, Timing
from reference.changes import Change
from reference.errors import SolverError
from reference.lecture.slide_17 import CircleAsMeant
from reference.obstacles import Circle
from reference.outcome import Outcome
from reference.scenes import find
from reference.schemes.catalogue import find as find_scheme
from reference.state import Trajectory
from reference.stepper import SchemeStepper, catalogued
from reference.system import MassSpringSystem
from tests.conformance.doctored import Doctored


def nobody(_: str) -> None:
    """Nobody is told."""


def test_the_drape_is_asked_of_all_cloths_and_of_engines_on_coarse_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each by its length, its spacing and its sample, which come back with what was found; a failure has its reason."""
    engines = [SimpleNamespace(name="one"), SimpleNamespace(name="other")]
    looked: list[tuple[float, ...]] = []

    def answer(function: object, *asked: Any) -> dict[str, Any] | Outcome:
        *by, length, spacing, sample = asked
        assert (function is drape.hung_in) == bool(by)
        if by and by[0].name == "other" and length == drape.ENGINE_LENGTHS[-1]:
            return Outcome("crashed", "killed")
        return {"coefficient": 10 * length + spacing + 100 * sample, "by name": by[0].name if by else None}

    monkeypatch.setattr(drape, "import_beforehand", lambda _: None)
    monkeypatch.setattr(drape, "answer", answer)
    monkeypatch.setattr(drape, "cloth", lambda *asked: (looked.append(asked), 0.5))
    monkeypatch.setattr(drape, "able", lambda system: engines if system is None else [])
    monkeypatch.setattr(drape, "result_of", lambda cloths, failures: (cloths, failures))
    cloths, failures = drape.run(nobody)
    assert looked == [(drape.ENGINE_LENGTHS[0], drape.COARSE, 0)]
    for one in cloths:
        assert one["coefficient"] == 10 * one["length"] + one["spacing"] + 100 * one["sample"]
        assert one["by"] == (one["by name"] or "kick_drift")
    found = [(one["by"], one["length"], one["spacing"], one["sample"]) for one in cloths]
    samples, ours = range(drape.SAMPLES), "kick_drift"
    expected = [(ours, c, drape.SPACING, i) for c in drape.LENGTHS for i in samples]
    expected += [(ours, c, a, i) for c in drape.OTHER_LENGTHS for a in drape.OTHERS for i in samples]
    expected += [(by, c, drape.COARSE, 0) for by in (ours, "one", "other") for c in drape.ENGINE_LENGTHS]
    assert found == expected[:-1]
    assert failures == [f"other, bending length {drape.ENGINE_LENGTHS[-1]:g} m: crashed, killed"]


@dataclass(frozen=True)
class Asked:
    """A stepper that remembers what it was asked, and leaves the system where it is."""

    name: str
    asked: list[tuple[MassSpringSystem, float, int]]
    outcome: Outcome | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """Two states of it."""
        self.asked.append((system, dt, steps))
        still = np.array([system.positions] * 2)
        return self.outcome or Outcome("done", "", Trajectory(np.array([0.0, dt]), still, np.zeros_like(still)))


def test_the_barrier_is_asked_of_each_rule_and_the_string_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Slides with every step by the lecture's rule, as meant and as printed, and by engines; failures are told once."""
    names = {*barrier.SCHEMES, *barrier.MEANT, "lecture_barrier"}
    known = {name: Asked(name, []) for name in names}
    lost = Asked("lost", [], Outcome("crashed", "killed"))
    monkeypatch.setattr(barrier, "all_steppers", lambda: known)
    monkeypatch.setattr(barrier, "able", lambda: [lost])
    monkeypatch.setattr(barrier, "side_by_side", lambda steppers, task, _: [(s, task(s)) for s in steppers])
    monkeypatch.setattr(barrier, "measure", lambda system, motion: Slide(None, motion.times[1], 0.0, 0.0))
    monkeypatch.setattr(barrier, "result_of", lambda *given: given)
    slides, string, strings, failures = barrier.run(nobody)  # type: ignore[misc]
    keys = [*((n, INWARDS) for n in barrier.SCHEMES), *((n, ALONG) for n in barrier.MEANT)]
    assert list(slides) == [*keys, ("lecture_barrier", PRINTED), ("lost", OWN)]
    for key, found in slides.items():
        assert found == (
            [None] * len(barrier.STEPS) if key[1] == OWN else [Slide(None, dt, 0.0, 0.0) for dt in barrier.STEPS]
        )
    assert failures == ["lost: crashed, killed", "lost, string: crashed, killed"]
    assert list(strings) == [*barrier.SCHEMES, "lecture_barrier"]
    scene = find("barrier")
    for system, dt, steps in known["heun"].asked:
        (obstacle,) = system.obstacles
        if len(system.masses) == 2:
            assert steps * dt == pytest.approx(barrier.DURATION, abs=dt)
            assert dt in barrier.STEPS
            assert isinstance(obstacle, Circle)
        else:
            assert (dt, steps) == (scene.dt, round(scene.duration / scene.dt))
            assert len(system.masses) == len(string.masses)
    meant = [isinstance(system.obstacles[0], CircleAsMeant) for system, *_ in known["heun"].asked]
    assert sum(meant) == ("heun" in barrier.MEANT) * len(barrier.STEPS)


def test_a_mass_that_touches_and_leaves_is_measured_by_hand() -> None:
    """Pushed sideways in the second of four steps, 1 mm inside before it leaves and 2 mm after, then well away."""
    system = barrier.slope(Circle((0.0, 0.0), 1.0))
    radii = np.array([1.0, 0.999, 1.0, 0.998, 1.5])
    angles = np.array([0.1, 0.2, 0.3, 0.4, 0.5])
    positions = np.array([system.positions] * 5)
    positions[:, 1] = radii[:, None] * np.column_stack([np.sin(angles), np.cos(angles)])
    velocities = np.zeros_like(positions)
    velocities[2:, 1, 0] = 1.0
    motion = Trajectory(np.arange(5) * 1e-3, positions, velocities)
    found = barrier.measure(system, motion)
    assert (found.angle, found.last) == (pytest.approx(0.3), pytest.approx(0.3))
    assert found.depth == pytest.approx(1e-3)
    height = positions[2, 1, 1] - positions[0, 1, 1]
    stretch = [np.linalg.norm(positions[i, 1] - system.positions[0]) - system.rest_lengths[0] for i in (0, 2)]
    elastic = 0.5 * system.stiffness[0] * (stretch[1] ** 2 - stretch[0] ** 2)
    assert found.gained == pytest.approx(0.02 * 9.81 * height + 0.5 * 0.02 + elastic)
    stays = replace(motion, positions=np.concatenate([positions[:4], positions[3:4]]))
    assert barrier.measure(system, stays).angle is None
    assert barrier.measure(system, stays).last == pytest.approx(0.4)
    assert barrier.measure(system, stays).depth == pytest.approx(2e-3)
    never = replace(motion, velocities=np.zeros_like(velocities))
    assert (barrier.measure(system, never).angle, barrier.measure(system, never).last) == (None, pytest.approx(0.5))


def test_engines_that_take_a_circle_are_able(monkeypatch: pytest.MonkeyPatch) -> None:
    """Others are not asked."""
    can, cannot = (EngineStepper(Doctored(capabilities=frozenset(c))) for c in ({"circle", "2d"}, {"2d"}))
    monkeypatch.setattr(barrier, "installed_engines", lambda: [cannot, can])
    assert barrier.able() == [can]


def test_costs_are_of_right_schemes_and_engines(monkeypatch: pytest.MonkeyPatch) -> None:
    """Kernels of those that are compiled are made beforehand, on a large and a small string."""
    engine = EngineStepper(Doctored())
    here = {name: catalogued()[name] for name in ("heun", "backward_euler", "euler_in_place")} | {"engine": engine}
    compiled: list[tuple[object, ...]] = []
    monkeypatch.setattr(cost, "steppers_here", lambda: here)
    monkeypatch.setattr(cost, "import_beforehand", lambda _: None)
    monkeypatch.setattr(cost, "why_not_compiled", lambda scheme: None if scheme.name == "heun" else "it is not")
    monkeypatch.setattr(cost, "isolated", lambda *asked: compiled.append(asked))
    monkeypatch.setattr(cost, "engine", lambda stepper: ("engine", stepper.name))
    monkeypatch.setattr(cost, "scheme", lambda stepper: ("scheme", stepper.name))
    monkeypatch.setattr(cost, "result_of", list)
    found = cost.run(nobody)
    assert found == [("scheme", "heun"), ("scheme", "backward_euler"), ("engine", engine.name)]
    sizes = (cost.MORE_MASSES[-1], cost.MASSES[0])
    assert sorted(compiled, key=str) == sorted(((cost.compile_kernel, "heun", n) for n in sizes), key=str)
    assert sizes[0] > max(cost.MASSES) > sizes[1]


def test_a_scheme_s_cost_is_its_kernel_s_or_python_s(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where it is compiled with the speeds on all strings; in Python with none, or with why it diverged."""
    heun = catalogued()["heun"]
    assert isinstance(heun, SchemeStepper)
    monkeypatch.setattr(cost, "points", lambda timings, equations: timings)
    monkeypatch.setattr(cost, "_time_kernel", lambda scheme, dt: ("kernel", dt))
    monkeypatch.setattr(cost, "kernel", lambda system, scheme, dt: len(system.masses) - 1)
    monkeypatch.setattr(cost, "seconds_per_step", lambda masses: 1e-9 * masses)
    monkeypatch.setattr(cost, "string", lambda n: SimpleNamespace(masses=range(n + 1)))
    found = cost.scheme(heun)
    assert (found.runs_as, found.points) == ("kernel", [("kernel", dt) for dt in cost.DTS])
    assert found.speeds.seconds == [1e-9 * n for n in (*cost.MASSES, *cost.MORE_MASSES)]
    monkeypatch.setattr(cost, "why_not_compiled", lambda _: "it is not")
    monkeypatch.setattr(cost, "_time_in_python", lambda scheme, dt: ("Python", dt))
    monkeypatch.setattr(cost, "least", lambda runs: [run() for run in runs])
    found = cost.scheme(heun)
    assert (found.runs_as, found.points) == ("Python", [("Python", dt) for dt in cost.DTS])
    assert found.speeds == Speeds([])

    def diverges(*_: object) -> None:
        raise SolverError("no solution")

    monkeypatch.setattr(cost, "_time_in_python", diverges)
    assert cost.scheme(heun).failure == "diverged, no solution"
    assert cost.scheme(heun).points == []


def test_a_run_in_python_ends_where_its_kernel_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """After the whole duration; the times of a kernel are those of so many steps."""
    monkeypatch.setattr(cost, "seconds_per_step", lambda _: 1e-6)
    steps = round(cost.DURATION / cost.DTS[0])
    ours: Timing = cost._time_kernel(find_scheme("heun"), cost.DTS[0])
    assert ours.seconds == pytest.approx(1e-6 * steps)
    python = cost._time_in_python(find_scheme("heun"), cost.DTS[0])
    assert python.positions == pytest.approx(ours.positions, abs=1e-12)
    assert python.seconds > 0


def test_stability_is_asked_of_four_strings_and_told_by_case(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of schemes, in-place variants and engines; who is at work is told with the string's damping."""
    told: list[str] = []
    here = {
        kind: SimpleNamespace(name=kind, kind=kind) for kind in ("scheme", "in_place", "engine", "lecture", "pendulum")
    }

    def rows(systems: Sequence[MassSpringSystem], steppers: Sequence[Any], tell: Sequence[Any]) -> list[Any]:
        for one in tell:
            one("heun")
        return [([(float(s.damping[0]), s.drag) for s in systems], [s.kind for s in steppers])]

    monkeypatch.setattr(stability, "steppers_here", lambda: here)
    monkeypatch.setattr(stability, "stability_rows_of", rows)
    monkeypatch.setattr(stability, "result_of", lambda found: found)
    ((cases, kinds),) = stability.run(told.append)  # type: ignore[misc]
    default: Mapping[str, float] = {}
    usual = find("string").system(default)
    assert cases == [(case.get("damping", usual.damping[0]), case.get("drag", usual.drag)) for case in stability.CASES]
    assert kinds == ["scheme", "in_place", "engine"]
    assert told == ["undamped, heun", "damping 0.1, heun", "damping 0.5, heun", "drag 0.1, heun"]
