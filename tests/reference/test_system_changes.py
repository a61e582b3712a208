"""What is changed in a system on the fly: that and nothing else, by hand, in a copy that cannot be written to."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.collisions.round_masses import Collisions
from reference.errors import InputError
from reference.obstacles import Plane
from reference.springs.angular import AngularSprings
from reference.springs.kinds import NonlinearSprings
from reference.system import MassSpringSystem, check_parameter


def bent_wire() -> MassSpringSystem:
    """Five round masses in the plane on four springs, of which no two numbers are alike."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.3], [2.1, -0.2], [3.0, 0.5], [4.2, 0.1]]),
        springs=np.array([[0, 1], [2, 1], [2, 3], [3, 4]]),
        masses=np.array([0.1, 0.2, 0.3, 0.4, 0.5]),
        rest_lengths=np.array([0.9, 1.1, 1.2, 1.3]),
        stiffness=np.array([10.0, 20.0, 30.0, 40.0]),
        damping=np.array([0.1, 0.2, 0.3, 0.4]),
        drag=np.array(0.05),  # type: ignore[arg-type]
        gravity=np.array([0.5, -9.0]),
        velocities=np.array([[0.0, 0.0], [0.1, 0.2], [0.3, 0.4], [0.5, 0.6], [0.7, 0.8]]),
        fixed=np.array([True, False, False, False, False]),
        obstacles=(Plane((0.0, -1.0), (0.0, 1.0)),),
        nonlinear=NonlinearSprings(hardening=np.array([1.0, 2.0, 3.0, 4.0])),
        collisions=Collisions(np.array([0.01, 0.02, 0.03, 0.04, 0.05]), 0.5),
        pulls=np.array([[0.0, 0.0], [0.0, 0.0], [1.0, -2.0], [0.0, 0.0], [0.0, 3.0]]),
        angular_springs=AngularSprings(np.array([[0, 1, 2], [1, 2, 3], [2, 3, 4]]), np.array([0.7, 0.8, 0.9])),
    )


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("hold", [3.0], {"fixed": [True, False, False, True, False]}),
        ("hold", 4, {"fixed": [True, False, False, False, True]}),
        ("release", [0.0, 2.0], {"fixed": [False] * 5}),
        ("pull.2.y", 5.0, {"pulls": [[0.0, 0.0], [0.0, 0.0], [1.0, 5.0], [0.0, 0.0], [0.0, 3.0]]}),
        ("pull.1.x", [4.0], {"pulls": [[0.0, 0.0], [4.0, 0.0], [1.0, -2.0], [0.0, 0.0], [0.0, 3.0]]}),
        (
            "break",
            [1.0, 3.0],
            {
                "stiffness": [10.0, 0.0, 30.0, 0.0],
                "damping": [0.1, 0.0, 0.3, 0.0],
                "broken": [False, True, False, True],
                "nonlinear": {"hardening": [1.0, 0.0, 3.0, 0.0]},
                "angular_springs.stiffness": [0.0, 0.0, 0.0],
            },
        ),
        (
            "break",
            0,
            {
                "stiffness": [0.0, 20.0, 30.0, 40.0],
                "damping": [0.0, 0.2, 0.3, 0.4],
                "broken": [True, False, False, False],
                "nonlinear": {"hardening": [0.0, 2.0, 3.0, 4.0]},
                "angular_springs.stiffness": [0.0, 0.8, 0.9],
            },
        ),
        ("mass", [0.5, 0.4, 0.3, 0.2, 0.1], {"masses": [0.5, 0.4, 0.3, 0.2, 0.1]}),
        ("gravity", 2.0, {"gravity": [0.0, -2.0]}),
    ],
)
def test_what_changes_and_what_does_not(name: str, value: Any, expected: dict[str, Any]) -> None:
    """In a copy: the system that it is set on stays as it was, and no array that is shared can be written to."""
    system = bent_wire()
    before = system.to_dict()
    changed = system.with_parameter(name, value)
    assert system.to_dict() == before
    after = changed.to_dict()
    apart = {key: after[key] for key in after if after[key] != before.get(key)}
    if "angular_springs" in apart:
        bends = apart.pop("angular_springs")
        apart["angular_springs.stiffness"] = bends["stiffness"]
        assert {**bends, "stiffness": None} == {**before["angular_springs"], "stiffness": None}
    assert apart == expected
    arrays = [
        a
        for part in (changed, changed.angular_springs, changed.nonlinear, changed.collisions)
        for a in vars(part).values()
    ]
    assert not any(array.flags.writeable for array in arrays if isinstance(array, np.ndarray))


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("hold", [0.0, 5.0], "hold[1] = 5: expected a mass from 0 to 4"),
        ("release", [-1.0], "release = -1: expected a mass from 0 to 4"),
        ("hold", [1.5, 2.0], "hold[0] = 1.5: expected a mass from 0 to 4"),
        ("break", [3.0, 4.0], "break[1] = 4: expected a spring from 0 to 3"),
        ("break", [2.0, 1.0, 2.0], "break[2] = 2: expected every number once"),
        ("pull.1.x", [1.0, 2.0], "pull.1.x has 2 numbers: expected one [N]"),
        ("pull.1.x", float("inf"), "pull.1.x = inf: expected a finite number [N]"),
        ("radii", 0.1, "parameter 'radii': it cannot change on the fly"),
        ("hardening", 0.1, "parameter 'hardening': it cannot change on the fly"),
    ],
)
def test_what_cannot_be_changed_is_refused(name: str, value: Any, message: str) -> None:
    """By name, place, value, and what was expected."""
    with pytest.raises(InputError) as refused:
        bent_wire().with_parameter(name, value)
    assert str(refused.value).startswith(message)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("mass", [0.1, 0.2, 0.3, 0.4, 0.5]),
        ("rest_length", [0.9, 1.1, 1.2, 1.3]),
        ("gravity", [0.5, -9.0]),
        ("drag", [0.05]),
        ("pull.2.y", [-2.0]),
        ("pull.4.x", [0.0]),
    ],
)
def test_the_numbers_of_a_parameter(name: str, expected: list[float]) -> None:
    """As they are, one for each, or the one there is."""
    assert bent_wire().numbers_of(name).tolist() == expected


def test_a_renumbered_wire_by_hand() -> None:
    """Mass order[i] becomes mass i, with its pull, its radius and the bend at it; springs keep their places."""
    other = bent_wire().renumbered([2, 4, 0, 1, 3])
    assert other.masses.tolist() == [0.3, 0.5, 0.1, 0.2, 0.4]
    assert other.velocities.tolist() == [[0.3, 0.4], [0.7, 0.8], [0.0, 0.0], [0.1, 0.2], [0.5, 0.6]]
    assert other.pulls.tolist() == [[1.0, -2.0], [0.0, 3.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]
    assert other.fixed.tolist() == [False, False, True, False, False]
    assert other.springs.tolist() == [[2, 3], [0, 3], [0, 4], [4, 1]]
    assert other.collisions is not None
    assert other.collisions.radii.tolist() == [0.03, 0.05, 0.01, 0.02, 0.04]
    assert other.angular_springs is not None
    assert other.angular_springs.masses.tolist() == [[2, 3, 0], [3, 0, 4], [0, 4, 1]]
    assert other.angular_springs.rest_angles == pytest.approx(bent_wire().angular_springs.rest_angles)  # type: ignore[union-attr]


def test_one_spring_of_it_and_its_springs_backwards() -> None:
    """With what that spring has besides; the masses and what is at them stay."""
    system = bent_wire().with_parameter("break", [3])
    one, backwards = system.of_spring(2), system.with_springs_reversed()
    assert one.springs.tolist() == [[2, 3]]
    assert [one.rest_lengths.item(), one.stiffness.item(), one.damping.item()] == [1.2, 30.0, 0.3]
    assert one.nonlinear is not None
    assert one.nonlinear.hardening.tolist() == [3.0]
    assert not one.broken.any()
    assert system.of_spring(3).broken.tolist() == [True]
    assert backwards.broken.tolist() == [True, False, False, False]
    assert backwards.nonlinear is not None
    assert backwards.nonlinear.hardening.tolist() == [0.0, 3.0, 2.0, 1.0]


def test_lengths_of_a_wire_by_hand() -> None:
    """The wider extent of two, the longest spring, the farthest mass, the shortest rest length."""
    system = bent_wire()
    assert system.size == 4.2
    assert system.scale == 4.2
    assert system.shortest == 0.9
    tall = MassSpringSystem(
        positions=np.array([[-9.0, 1.0], [-9.5, 3.0], [-9.2, 8.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(1.0),
        rest_lengths=np.array([0.0, 2.0]),
        stiffness=np.array(1.0),
    )
    assert (tall.size, tall.scale, tall.shortest) == (7.0, 9.5, 2.0)
    slack = tall.with_parameter("rest_length", [7.5, 0.25])
    assert (slack.size, slack.scale, slack.shortest) == (7.5, 9.5, 0.25)
    assert tall.with_parameter("rest_length", 0.0).shortest == 9.5
    assert tall.off_rest_length.tolist() == [True, True]
    assert not system.slackens.any()


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("mass", 1e-50, None),
        ("mass", 1e50, None),
        ("mass", 0.0, "mass = 0: expected a number > 0 [kg]"),
        ("mass", -1.0, "mass = -1: expected a number > 0 [kg]"),
        ("mass", 0.99e-50, "mass = 9.9e-51: expected a number of at least 1e-50 [kg]"),
        ("stiffness", 0.0, None),
        ("stiffness", 1e-60, None),
        ("stiffness", -1e-60, "stiffness = -1e-60: expected a number >= 0 [N/m]"),
        ("rest_length", -0.5, "rest_length = -0.5: expected a number >= 0 [m]"),
        ("damping", -0.5, "damping = -0.5: expected a number >= 0 [N s/m]"),
        ("drag", -0.5, "drag = -0.5: expected a number >= 0 [N s/m]"),
        ("gravity", -9.81, None),
        ("gravity", np.nan, "gravity = nan: expected a finite number [m/s^2]"),
        ("gravity", -1e50, None),
        ("gravity", -1.01e50, "gravity = -1.01e+50: expected a number of at most 1e+50 [m/s^2]"),
        ("angle", -30.0, None),
        ("angle", np.inf, "angle = inf: expected a finite number"),
    ],
)
def test_a_number_that_a_parameter_cannot_be_is_refused(name: str, value: float, said: str | None) -> None:
    """On both sides of every border; what is no parameter takes any finite number."""
    if said is None:
        check_parameter(name, value)
        return
    with pytest.raises(InputError) as refused:
        check_parameter(name, value)
    assert str(refused.value) == said
