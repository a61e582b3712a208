"""Growth told from distances made by hand; which systems are swept at once, and in what they differ."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.limits import measured_growth
from experiments.limits.measured_growth import SWEPT_STEPS, _at_rest, _growth, _stripes, _varied, swept_growth
from reference.compiled.sweep import CHUNK
from reference.measured_stability import GROWN
from reference.scenes import find

#: After every chunk of steps of a run.
STEPS = CHUNK * np.arange(1, SWEPT_STEPS // CHUNK + 1)


@pytest.mark.parametrize("rate", [1e-3, 1e-5, 0.0, -1e-3])
def test_slow_growth_is_that_of_a_power_of_a_step(rate: float) -> None:
    """Logarithmic, in a step: distances of exp(rate n), beside one that stays; quarters are 0.75 of the run apart."""
    distances = np.stack([np.exp(rate * STEPS), np.full(len(STEPS), 2.0)], axis=1)
    assert _growth(distances, 1.0) == pytest.approx([rate, 0.0], rel=0.02, abs=1e-12)


def test_what_leaves_is_told_by_when_it_does() -> None:
    """From the start to the first chunk after which it is out of reach; infinities and what is no number, too."""
    late = np.ones(len(STEPS))
    late[5:] = 10 * GROWN
    lost, endless = np.ones(len(STEPS)), np.ones(len(STEPS))
    lost[2:], endless[3:] = np.nan, np.inf
    found = _growth(np.stack([late, lost, endless], axis=1), 0.5)
    assert found[0] == pytest.approx(np.log(20 * GROWN) / (6 * CHUNK))
    assert found[1:] == pytest.approx(np.log(2e300) / (np.array([3, 4]) * CHUNK))


def test_what_comes_to_the_border_has_not_left() -> None:
    """GROWN times the start is still within reach; a little more is not."""
    border = np.ones((len(STEPS), 2))
    border[-1] = [GROWN, 1.001 * GROWN]
    inside, outside = _growth(border, 1.0)
    assert outside == pytest.approx(np.log(1.001 * GROWN) / (len(STEPS) * CHUNK))
    assert inside != pytest.approx(outside, rel=1e-3)


def test_points_are_swept_with_those_of_as_many_masses(monkeypatch: pytest.MonkeyPatch) -> None:
    """In stripes, in their order; where no number of masses is given, all together."""
    points: list[Any] = [{"masses": n, "dt": 0.1} for n in (3.0, 4.0, 3.0, 3.0, 4.0, 3.0)]
    monkeypatch.setattr(measured_growth, "STRIPE", 3)
    assert list(_stripes(points)) == [[0, 2, 3], [5], [1, 4]]
    assert list(_stripes([{"dt": 0.1}, {"dt": 0.2}])) == [[0, 1]]


def test_systems_differ_in_what_is_varied() -> None:
    """Of each the free masses' and springs' own; what is the same of all is left out."""
    string = find("string")
    one, two = (
        string.system({"masses": 2, "stiffness": k, "mass": m, "gravity": 5.0}) for k, m in ((100, 0.1), (200, 0.3))
    )
    assert {name: values.tolist() for name, values in _varied([one, two]).items()} == {
        "mass": [0.1, 0.3],
        "stiffness": [100, 200],
    }
    damped = (string.system({"masses": 2, "damping": c, "drag": 2 * c, "rest_length": 1 + c}) for c in (0.0, 0.5))
    varied = _varied(list(damped))
    assert {name: varied[name].tolist() for name in ("damping", "drag", "rest_length")} == {
        "damping": [0, 0.5],
        "drag": [0, 1],
        "rest_length": [1, 1.5],
    }
    heavy = _varied([string.system({"masses": 2, "gravity": g}) for g in (1.0, 3.0)])
    assert {name: values.tolist() for name, values in heavy.items()} == {"gravity": [1, 3]}


def plane() -> Any:
    """Of dt and stiffness."""
    return SimpleNamespace(
        parameters=lambda point: {name: value for name, value in point.items() if name != "dt"},
        system=lambda point: find("string").system({"masses": 2, "stiffness": point["stiffness"]}),
        step=lambda point: point["dt"],
    )


def test_points_that_differ_in_dt_alone_share_their_rest() -> None:
    """Where the string hangs at rest: straight down, each spring longer by what hangs on it."""
    first, second, third = _at_rest(plane(), [{"dt": 0.1, "stiffness": k} for k in (100, 200, 100)])
    assert first[0] is third[0]
    assert first[0] is not second[0]
    for system, rest in (first, second):
        below = system.masses[1:].sum() * 9.81 - np.array([0.0, system.masses[1] * 9.81])
        lengths = system.rest_lengths + below / system.stiffness
        assert np.linalg.norm(np.diff(rest, axis=0), axis=1) == pytest.approx(lengths)


def test_many_points_are_swept_by_all_threads_and_progress_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few by one; each point has its own growth, in whatever stripe it is."""
    asked: list[Any] = []

    def swept(scheme: object, systems: Any, dt: Any, threads: int | None) -> Any:
        asked.append((len(systems), threads))
        return dt * 10

    monkeypatch.setattr(measured_growth, "_growth_of_sweep", swept)
    monkeypatch.setattr(measured_growth, "STRIPE", 2)
    monkeypatch.setattr(measured_growth, "THREADS_FROM", 4)
    told: list[str] = []
    points = [{"dt": 0.1 * (i + 1), "stiffness": 100.0} for i in range(3)]
    assert swept_growth("scheme", plane(), points, told.append) == pytest.approx([1, 2, 3])  # type: ignore[arg-type]
    assert (asked, told) == ([(2, 1), (1, 1)], ["2 of 3 runs", "3 of 3 runs"])
    asked.clear()
    swept_growth("scheme", plane(), [*points, points[0]], told.append)  # type: ignore[arg-type]
    assert asked == [(2, None), (2, None)]


def test_a_fixed_mass_says_nothing_of_the_others() -> None:
    """What is varied is the mass of those that move, whatever holds them."""
    system = find("string").system({"masses": 2})
    held = [replace(system, masses=np.array([9.0, m, m])) for m in (0.02, 0.03)]
    assert {name: values.tolist() for name, values in _varied(held).items()} == {"mass": [0.02, 0.03]}
    held = [replace(system, masses=np.array([m, 0.02, 0.02])) for m in (8.0, 9.0)]
    assert _varied(held) == {}
