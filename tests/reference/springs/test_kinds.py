"""What springs have besides stiffness and damping, of three springs of which no two have the same."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.errors import InputError, SolverError
from reference.scenes import find as find_scene
from reference.springs.kinds import KINDS, NonlinearSprings, with_kinds
from reference.springs.nonlinear_law import tangent_system

INF = np.inf


def law(**fields: Any) -> NonlinearSprings:
    """Of numbers or lists."""
    return NonlinearSprings(**{name: np.array(value) for name, value in fields.items()})


@pytest.mark.parametrize(
    ("fields", "asked", "may_break", "may_open"),
    [
        ({"tension_only": [False, True, False]}, ["tension_only"], [False] * 3, [False] * 3),
        ({"compression_only": [False, True, False]}, ["compression_only"], [False] * 3, [False, True, False]),
        ({"hardening": [0.0, 0.0, 2.0]}, ["hardening"], [False] * 3, [False] * 3),
        ({"largest_force": [3.0, INF, INF]}, ["largest_force"], [False] * 3, [False] * 3),
        ({"breaking_force": [INF, INF, 3.0]}, ["breaking_force"], [False, False, True], [False, False, True]),
        ({"breaking_stretch": [INF, 0.5, INF]}, ["breaking_stretch"], [False, True, False], [False, True, False]),
        (
            {"compression_only": [True, False, False], "breaking_force": [INF, 3.0, INF]},
            ["compression_only", "breaking_force"],
            [False, True, False],
            [True, True, False],
        ),
    ],
)
def test_what_one_spring_has_of_three(
    fields: dict[str, Any], asked: list[str], may_break: list[bool], may_open: list[bool]
) -> None:
    """Which kinds any has, which springs can break, and which leave their masses alone at any length."""
    found = law(**fields).checked(3)
    assert found is not None
    assert found.asked == asked
    assert found.may_break.tolist() == may_break
    assert found.may_open.tolist() == may_open
    assert found.breaks == any(may_break)
    written = {name: [None if v == INF else v for v in fields[name]] for name in asked}
    assert found.to_dict() == written
    assert not any(getattr(found, name).flags.writeable for name in KINDS)


def test_what_it_was_made_from_stays_as_it_was() -> None:
    """Neither shared nor made read-only."""
    hardening = np.array([1.0, 2.0, 3.0])
    found = NonlinearSprings(hardening=hardening).checked(3)
    hardening[0] = 7.0
    assert found is not None
    assert found.hardening.tolist() == [1.0, 2.0, 3.0]


def test_parts_of_a_law_by_hand() -> None:
    """Some of its springs; the same with one of them linear; with two linear ones listed after them."""
    whole = law(hardening=[1.0, 0.0, 3.0], breaking_force=[5.0, 6.0, INF], tension_only=[False, True, False]).checked(3)
    assert whole is not None
    assert whole.of([2, 0]).hardening.tolist() == [3.0, 1.0]
    assert whole.of(slice(1, 2)).to_dict() == {"tension_only": [True], "breaking_force": [6.0]}
    without = whole.without([1])
    assert without is not None
    assert without.to_dict() == {"hardening": [1.0, 0.0, 3.0], "breaking_force": [5.0, None, None]}
    assert whole.breaking_force.tolist() == [5.0, 6.0, INF]
    assert whole.without([0, 1, 2]) is None
    assert whole.followed_by_linear(2).to_dict() == {
        "tension_only": [False, True, False, False, False],
        "hardening": [1.0, 0.0, 3.0, 0.0, 0.0],
        "breaking_force": [5.0, 6.0, None, None, None],
    }


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        (
            {"tension_only": [False, True, True], "compression_only": [True, False, True]},
            "tension_only and compression_only of spring 2: expected one of the two",
        ),
        (
            {"hardening": [0.0, 1.0, 0.0], "largest_force": [2.0, 3.0, INF]},
            "hardening and largest_force of spring 1: expected one of the two",
        ),
        ({"breaking_force": [1.0, 0.0, 2.0]}, "breaking_force[1] = 0: expected a number > 0 [N]"),
        ({"breaking_stretch": [1.0, 2.0, -1.0]}, "breaking_stretch[2] = -1: expected a number > 0 [m]"),
        ({"largest_force": [1.0, INF, 2e50]}, "largest_force[2] = 2e+50: expected a number of at most 1e+50 [N]"),
        ({"largest_force": ["strong"]}, "expected numbers [N]"),
        ({"hardening": [0.0, -1.0, 0.0]}, "hardening[1] = -1: expected a number >= 0 [N/m^3]"),
    ],
)
def test_the_first_that_is_wrong_is_named(fields: dict[str, Any], said: str) -> None:
    """By its number, where springs differ."""
    with pytest.raises(InputError) as refused:
        law(**fields).checked(3)
    assert said in str(refused.value)


def test_kinds_are_set_one_after_the_other() -> None:
    """Those of before stay; true and false are written as 1 and 0, and as nothing else."""
    first = with_kinds(None, {"tension_only": [1, 0, 0]})
    both = with_kinds(first, {"hardening": 2.0, "breaking_force": [1.0, 2.0, 3.0]})
    assert first.tension_only.tolist() == both.tension_only.tolist() == [True, False, False]
    assert both.hardening.tolist() == 2.0
    assert both.breaking_force.tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(InputError, match=r"^compression_only\[1\] = 0.5: expected 1 for springs that do, 0 for others"):
        with_kinds(first, {"compression_only": [1.0, 0.5, 1.0]})


@pytest.mark.parametrize(
    ("fields", "stretched", "said"),
    [
        ({"tension_only": "0,1,0"}, 0.0, "spring 1 is at its rest length, where it goes slack"),
        ({"compression_only": "0,0,1"}, 0.0, "spring 2 is at its rest length, where it goes slack"),
        ({"largest_force": "10,1,10"}, 0.005, "spring 1 is at its largest force"),
        ({"largest_force": "10,10,0.9"}, 0.005, "spring 2 is beyond its largest force, which stays as it is"),
    ],
)
def test_the_spring_at_whose_corner_a_system_rests_is_named(
    fields: dict[str, Any], stretched: float, said: str
) -> None:
    """Of three of 200 N/m in a row, all as long as at rest or longer by 5 mm, which pull with 1 N."""
    string = find_scene("string").system({"masses": 3, "stiffness": 200.0, **fields})
    state = string.start
    moved = type(state)(0.0, state.positions + np.arange(4.0)[:, None] * [stretched, 0.0], state.velocities)
    with pytest.raises(SolverError) as refused:
        tangent_system(string, moved)
    assert str(refused.value) == f"no linear motion about this rest: {said}"


def test_a_largest_force_that_is_not_reached_makes_no_difference() -> None:
    """The linear system has the springs' own stiffness, damping and rest lengths."""
    string = find_scene("string").system({"masses": 3, "damping": "0.1,0.2,0.3", "largest_force": "10,20,30"})
    linear = tangent_system(string, string.start)
    assert linear.nonlinear is None
    assert linear.stiffness.tolist() == string.stiffness.tolist()
    assert linear.damping.tolist() == [0.1, 0.2, 0.3]
    assert linear.rest_lengths.tolist() == string.rest_lengths.tolist()
