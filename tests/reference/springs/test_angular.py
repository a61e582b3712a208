"""Angular springs as they come in: wrong numbers are named, and what is left out is as masses are laid out."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.springs.angular import AngularSprings
from reference.springs.angular_law import forces_on_masses
from reference.springs.bending import with_bending
from reference.system import MassSpringSystem
from tests.reference.springs.test_angular_law import CORNERS, angular_of, three


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"masses": [[0, 1, 3]]}, "angular_springs[0].masses = [0, 1, 3]: expected masses from 0 to 2"),
        ({"masses": [[0, 1, 0]]}, "angular_springs[0].masses = [0, 1, 0]: expected three different masses"),
        ({"masses": [[0, 1]]}, "angular_springs.masses has shape (1, 2)"),
        ({"stiffness": -1.0}, "angular_springs.stiffness = -1: expected a number >= 0 [N m/rad]"),
        ({"rest_angles": 90.0}, "angular_springs[0].rest_angle = 90: expected a number from -2 pi to 2 pi [rad]"),
        ({"rest_angles": np.inf}, "angular_springs[0].rest_angle = inf: expected a finite number [rad]"),
    ],
)
def test_a_wrong_number_is_named(given: dict[str, Any], said: str) -> None:
    """With its field, value, and what was expected."""
    values = {name: np.array(value) for name, value in {"masses": [[0, 1, 2]], "stiffness": 1.0, **given}.items()}
    with pytest.raises(InputError) as refused:
        replace(three(CORNERS["plane"]), angular_springs=AngularSprings(**values))
    assert str(refused.value).startswith(said)


def test_what_has_no_angle_or_no_plane_is_refused() -> None:
    """Two masses in one place; along a line; in space in line and to rest bent."""
    with pytest.raises(InputError, match="expected the last mass apart from the middle one"):
        replace(three(CORNERS["plane"]), rest_lengths=np.array([1.0, 0.0]), positions=np.diag([1.0, 0.0, 0.0])[:, :2])
    with pytest.raises(InputError, match="along a line nothing bends"):
        find_scene("chain").system({"angular_stiffness": 1.0})
    with pytest.raises(InputError, match="no certain plane"):
        three(CORNERS["space, in line"], rest_angles=np.array(2.0))


@pytest.mark.parametrize(
    ("masses", "rest_angles", "said"),
    [
        ([[0, 1, 2], [1, 2, 3]], 1.0, "[1].masses = [1, 2, 3]: expected the last mass apart from the middle one"),
        ([[0, 1, 2], [3, 2, 1]], 1.0, "[1].masses = [3, 2, 1]: expected the first mass apart from the middle one"),
        ([[0, 1, 2], [0, 1, 5]], 1.0, "[1].masses = [0, 1, 5]: expected masses from 0 to 4"),
        ([[0, 1, 2], [0, -1, 2]], 1.0, "[1].masses = [0, -1, 2]: expected masses from 0 to 4"),
        ([[0, 1, 2], [2, 1, 2]], 1.0, "[1].masses = [2, 1, 2]: expected three different masses"),
        ([[0, 1, 2], [1, 0, 2]], [1.0, -0.1], "[1].rest_angle = -0.1: expected a number from 0 to pi [rad]"),
        ([[0, 1, 2], [1, 0, 2]], [1.0, 3.1417], "[1].rest_angle = 3.1417: expected a number from 0 to pi [rad]"),
        ([[0, 1, 2], [0, 1, 4]], [1.0, 3.0], "[1].rest_angle = 3: expected masses that are in line to rest in line (3"),
        ([[0, 1, 2], [1, 0, 4]], [1.0, 1.0], "[1].rest_angle = 1: expected masses that are in line to rest in line (0"),
    ],
)
def test_the_first_wrong_one_is_named_by_its_number(masses: Any, rest_angles: Any, said: str) -> None:
    """Of two in space of which the second is wrong: two of the five masses start in one place, three are in line."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 0], [2, 0, 0]]),
        springs=np.zeros((0, 2), dtype=int),
        masses=np.array(1.0),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
    )
    with pytest.raises(InputError) as refused:
        replace(system, angular_springs=AngularSprings(np.array(masses), np.array(1.0), np.array(rest_angles)))
    assert str(refused.value).startswith(f"angular_springs{said}")


@pytest.mark.parametrize(("written", "kept"), [(1.0, 1.0), (3.1416, np.pi), (0.0, 0.0), (3.14, 3.14)])
def test_a_rest_angle_in_space_is_kept_and_is_half_a_turn_at_most(written: float, kept: float) -> None:
    """Of masses that are not in line."""
    assert angular_of(three(CORNERS["space"], rest_angles=np.array(written))).rest_angles.tolist() == [kept]


@pytest.mark.parametrize("written", [3.14159, 3.1416])
def test_half_a_turn_in_six_digits_is_half_a_turn(written: float) -> None:
    """Masses in line in space rest as they are laid out: the rest angle is pi, and no force is left."""
    system = three(CORNERS["space, in line"], rest_angles=np.array(written))
    assert angular_of(system).rest_angles == pytest.approx([np.pi], abs=1e-12)
    assert not np.abs(forces_on_masses(angular_of(system), system.positions)).max() > 1e-12


@pytest.mark.parametrize("stiffness", [[[], [0.0]], "stiff", float("nan"), -1.0, [1.0, 2.0]], ids=str)
def test_stiffness_that_is_none_is_refused(stiffness: Any) -> None:
    """In one line that names it; zero and nothing leave the system as it was."""
    string = find_scene("string").system({})
    with pytest.raises(InputError, match=r"bending = |angular_springs\.stiffness"):
        with_bending(string, stiffness)
    assert with_bending(string, 0.0) is string
    assert with_bending(string, []) is string
