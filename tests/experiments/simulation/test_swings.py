"""What is made of a mode's run and of a step's eigenvalues, by hand; and which steps tell nothing of a mode."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from experiments.simulation import modes_of_scene
from experiments.simulation.modes_of_scene import STEPS, UNKNOWN, Modes, _measured, _predicted, _swing, modes_of
from reference.obstacles import Circle
from reference.outcome import Outcome
from reference.scenes import Setup, find
from reference.system import MassSpringSystem

DT = 0.01
SYSTEM = find("string").system({"masses": 2})


def test_a_swing_is_told_by_the_angle_and_the_size_of_an_eigenvalue() -> None:
    """Of exp((-2 + 30 i) dt): 30 rad/s, and 2 over their hypotenuse; of two that do not swing the one that lasts."""
    value = np.exp((-2 + 30j) * DT)
    found = _swing([value, value.conjugate()], DT)
    assert (found.frequency, found.damping_ratio) == pytest.approx((30 / (2 * np.pi), 2 / np.hypot(2, 30)))
    creeps, grows = _swing([0.25, 0.5], DT), _swing([0.25, 2.0], DT)
    assert np.isnan([creeps.frequency, grows.frequency]).all()
    assert (creeps.damping_ratio, grows.damping_ratio) == pytest.approx((1.0, -1.0))
    assert _swing([1.0, 0.5], DT).damping_ratio == 0.0
    assert _swing([0.0, 0.0], DT) is UNKNOWN


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"linear": False}, "a step of it is no matrix"),
        ({"one_step": False}, "a step of it is no matrix"),
        ({"iterated": True}, "a step of it is no matrix"),
        ({"needs": "accelerations of one mass"}, "it steps mass after mass"),
        ({"on_rods": True}, "it has rods in place of springs"),
        ({"coupled": 1.0}, "damping acts between modes"),
    ],
)
def test_why_a_step_tells_nothing_of_a_mode_is_told(changed: dict[str, Any], told: str) -> None:
    """Each reason alone."""
    given = {
        "linear": True,
        "one_step": True,
        "iterated": False,
        "needs": "",
        "on_rods": False,
        "coupled": 0.0,
        **changed,
    }
    scheme = SimpleNamespace(name="it", **{name: given[name] for name in ("linear", "one_step", "iterated", "needs")})
    modes = SimpleNamespace(natural=SimpleNamespace(coupled=given["coupled"]), setup=SimpleNamespace(dt=DT))
    found = _predicted(cast(Any, SimpleNamespace(scheme=scheme, on_rods=given["on_rods"])), cast(Any, modes))
    assert isinstance(found, str)
    assert found.startswith(told)


def of(frequency: float, system: MassSpringSystem = SYSTEM) -> Modes:
    """The modes of a string, the first of which is said to have another frequency [Hz]."""
    found = modes_of(Setup("string", SYSTEM, DT, 1.0))
    frequencies = np.array([frequency, *found.natural.frequencies[1:]])
    setup = replace(found.setup, system=system)
    return replace(found, setup=setup, natural=replace(found.natural, frequencies=frequencies))


@pytest.mark.parametrize(("frequency", "steps"), [(1.0, 300), (1e3, 8), (1e-9, STEPS)])
def test_a_mode_is_watched_for_three_periods(frequency: float, steps: int) -> None:
    """Eight steps at least, and STEPS at most; a run that is not done tells its reason, whatever it left."""
    asked: list[int] = []
    left = SimpleNamespace(positions=np.zeros((9, 3, 2)))

    def run(_: object, __: float, count: int) -> Outcome:
        asked.append(count)
        return Outcome("diverged", "it is torn", cast(Any, left))

    assert _measured(cast(Any, SimpleNamespace(run=run)), of(frequency), 0) == (None, "it is torn")
    assert asked == [steps]
    lost = cast(Any, SimpleNamespace(run=lambda *_: Outcome("done", "nothing left")))
    assert _measured(lost, of(frequency), 0) == (None, "nothing left")


def test_what_cannot_be_measured_is_not_run() -> None:
    """What nothing brings back, and what may meet an obstacle."""
    nobody = cast(Any, None)
    assert _measured(nobody, of(0.0), 0) == (None, "nothing brings it back")
    near = replace(SYSTEM, obstacles=(Circle((5.0, 5.0), 1.0),))
    assert _measured(nobody, of(1.0, near), 0) == (None, "with obstacles it is not measured")


def test_a_scene_with_obstacles_is_at_rest_on_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """And it is said about which rest its modes are; of others there is nothing to be said."""
    rest = modes_of(Setup("string", SYSTEM, DT, 1.0)).rest
    monkeypatch.setattr(modes_of_scene, "equilibrium_on_obstacles", lambda _: (rest, "on its circle"))
    near = replace(SYSTEM, obstacles=(Circle((5.0, 5.0), 1.0),))
    assert modes_of(Setup("string", near, DT, 1.0)).about == "on its circle"
    assert modes_of(Setup("string", SYSTEM, DT, 1.0)).about == ""
