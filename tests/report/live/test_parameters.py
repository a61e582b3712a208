"""The sliders of the live page: each goes from somewhere above zero, so that it can go by powers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.errors import InputError
from reference.scenes import find, scenes
from reference.system import MassSpringSystem
from report.live.parameters import Slider, own_value, sliders


@pytest.mark.parametrize("scene", sorted(scenes()))
def test_every_scene_s_sliders_can_go_by_powers(scene: str) -> None:
    """From low > 0 to high > low, with the value between; zero only where the left end may mean it."""
    for slider in sliders(find(scene).system({})):
        assert 0 < slider.low < slider.high
        assert slider.low <= slider.value <= slider.high or (slider.value == 0 and slider.zero)


def string(**fields: Any) -> MassSpringSystem:
    """Masses of 0.5 and 2 kg on springs of 100 and 400 N/m, 1 and 2 m long, some of it otherwise."""
    parts: dict[str, Any] = {
        "positions": np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]),
        "springs": np.array([[0, 1], [1, 2]]),
        "masses": np.array([0.5, 2.0, 2.0]),
        "rest_lengths": np.array([1.0, 2.0]),
        "stiffness": np.array([100.0, 400.0]),
        "fixed": np.array([True, False, False]),
    }
    return MassSpringSystem(**{**parts, **fields})


def slider(system: MassSpringSystem, name: str) -> Slider:
    """The one of a parameter."""
    (found,) = [one for one in sliders(system) if one.name == name]
    return found


def test_what_is_not_the_same_of_all_is_moved_by_a_factor() -> None:
    """From a hundredth to a hundred times its own; a number for each is what that means."""
    system = string()
    for name in ("mass", "stiffness", "rest_length"):
        assert slider(system, name) == Slider(name, "", 1.0, 0.01, 100.0, False)
    assert own_value(system, "stiffness", 0.5) == (50.0, 200.0)
    assert own_value(system, "mass", 2.0) == (1.0, 4.0, 4.0)
    with pytest.raises(InputError, match=r"mass times 0: expected a number > 0|mass = 0: expected a number > 0"):
        own_value(system, "mass", 0.0)
    with pytest.raises(InputError, match="stiffness times 0: expected a number > 0"):
        own_value(system, "stiffness", 0.0)


def test_what_is_the_same_of_all_is_moved_in_its_unit() -> None:
    """From a hundredth of its own to a hundred times that."""
    system = string(stiffness=np.array(100.0), masses=np.array(0.5), rest_lengths=np.array(1.0))
    assert slider(system, "stiffness") == Slider("stiffness", "N/m", 100.0, 1.0, 1e4, False)
    assert slider(system, "mass") == Slider("mass", "kg", 0.5, 0.005, 50.0, False)
    assert slider(system, "rest_length") == Slider("rest_length", "m", 1.0, 0.01, 100.0, False)
    assert own_value(system, "stiffness", 3.0) == 3.0
    rounded = string(masses=np.array([0.3, 0.1 + 0.2, 0.3]))
    assert slider(rounded, "mass").unit == "kg"  # they differ by rounding only


def test_springs_without_length_or_stiffness_may_have_some() -> None:
    """Up to the size of the scene, and to 1,000 N/m; without springs nothing of theirs can be moved."""
    loose = string(rest_lengths=np.array(0.0), stiffness=np.array(0.0))
    assert slider(loose, "rest_length") == Slider("rest_length", "m", 0.0, 1e-4 * 3.0, 3.0, True)
    assert slider(loose, "stiffness") == Slider("stiffness", "N/m", 0.0, 0.1, 1000.0, True)
    dust = string(springs=np.zeros((0, 2), np.int64), rest_lengths=np.zeros(0), stiffness=np.zeros(0))
    assert {one.name for one in sliders(dust)} == {"mass", "gravity", "drag"}
    assert slider(dust, "drag").high == pytest.approx(2 * np.sqrt(1.0 * 2.0))  # as on a spring of 1 N/m


@pytest.mark.parametrize("name", ["damping", "drag"])
def test_damping_goes_from_zero_to_what_lets_nothing_swing(name: str) -> None:
    """2 sqrt(k m) of the stiffest spring and the heaviest mass; or as far as it is already, from as little."""
    most = 2 * np.sqrt(400.0 * 2.0)
    none, little, much = (slider(string(**{name: np.array(value)}), name) for value in (0.0, 1e-4, 100.0))
    assert (none.value, none.zero, none.unit) == (0.0, True, "N s/m")
    assert (none.low, none.high) == (pytest.approx(1e-4 * most), pytest.approx(most))
    assert (little.low, little.high) == (1e-4, pytest.approx(most))
    assert (much.low, much.high) == (pytest.approx(1e-4 * most), 100.0)


def test_gravity_is_one_number_where_it_points_downwards() -> None:
    """Upwards or aside, it is a factor of each part; downwards it goes to thrice its own, at least to 30 m/s^2."""
    down = string(gravity=np.array([0.0, -9.81]))
    assert slider(down, "gravity") == Slider("gravity", "m/s^2", 9.81, 0.01, 30.0, True)
    assert slider(string(gravity=np.array([0.0, -20.0])), "gravity").high == 60.0
    assert slider(string(gravity=np.zeros(2)), "gravity").value == 0.0
    for gravity in ([0.0, 9.81], [1.0, -9.81]):
        aside = string(gravity=np.array(gravity))
        assert slider(aside, "gravity").unit == ""
        assert own_value(aside, "gravity", 2.0) == tuple(2 * np.array(gravity))
    space = string(positions=np.zeros((3, 3)) + np.arange(3)[:, None], gravity=np.array([0.0, -3.0, 0.0]))
    assert slider(space, "gravity").value == 3.0
