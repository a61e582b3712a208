"""MassSpringSystem: what it takes, what it refuses and in which words, and that nobody can change it."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.system import FIELDS, PARAMETERS, MassSpringSystem
from tests.reference.systems import meshes, property_test, random_mesh, seeds

TRIANGLE: dict[str, Any] = {
    "positions": [[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]],
    "springs": [[0, 1], [1, 2]],
    "masses": 0.5,
    "rest_lengths": 1.0,
    "stiffness": 10.0,
}

#: The fields that hold arrays, and others; the last three are in a dictionary only where there is something to say.
OTHERS = ("drag", "obstacles", "nonlinear", "collisions", "angular_springs")
ARRAYS = [f.name for f in dataclasses.fields(MassSpringSystem) if f.name not in OTHERS]

NAN, INF = float("nan"), float("inf")


def system(**fields: Any) -> MassSpringSystem:
    """The triangle with some fields set otherwise."""
    return MassSpringSystem(**{**TRIANGLE, **fields})


# --- What it takes ---


def test_single_numbers_do_for_all() -> None:
    """One per mass, one per spring, and what is left out."""
    plain = system()
    assert plain.masses.tolist() == [0.5] * 3
    assert plain.rest_lengths.tolist() == [1.0] * 2
    assert plain.stiffness.tolist() == [10.0] * 2
    assert plain.damping.tolist() == [0.0] * 2
    assert plain.drag == 0.0
    assert plain.gravity.tolist() == [0.0, -9.81]
    assert plain.velocities.tolist() == [[0.0, 0.0]] * 3
    assert plain.fixed.tolist() == [False] * 3


def test_arrays_are_taken_as_they_are() -> None:
    """One number for each."""
    given_ = system(masses=[1.0, 2.0, 3.0], damping=[0.1, 0.2], fixed=[True, False, True], drag=1)
    assert given_.masses.tolist() == [1.0, 2.0, 3.0]
    assert given_.damping.tolist() == [0.1, 0.2]
    assert given_.fixed.tolist() == [True, False, True]
    assert given_.drag == 1.0
    assert isinstance(given_.drag, float)


@pytest.mark.parametrize(
    ("dimension", "gravity", "expected"),
    [
        (2, 9.81, [0.0, -9.81]),
        (3, 9.81, [0.0, -9.81, 0.0]),
        (2, [1.0, 2.0], [1.0, 2.0]),
        (3, [1.0, 2.0, 3.0], [1.0, 2.0, 3.0]),
        (2, 0.0, [0.0, 0.0]),
        (2, -1.0, [0.0, 1.0]),
        (1, 9.81, [-9.81]),
        (1, [9.81], [9.81]),
        (1, [-9.81], [-9.81]),
        (1, 0.0, [0.0]),
    ],
)
def test_one_number_for_gravity_means_downwards(dimension: int, gravity: Any, expected: list[float]) -> None:
    """Along the second axis, or the one there is; there a list of one number is a vector already."""
    positions = np.arange(3.0 * dimension).reshape(3, dimension)
    assert system(positions=positions, gravity=gravity).gravity.tolist() == expected


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_one_two_and_three_dimensions(dimension: int) -> None:
    """The positions say which."""
    made = random_mesh(1, 5, dimension)
    assert made.dimension == dimension
    assert made.velocities.shape == (5, dimension)
    assert made.vertical_axis == (0 if dimension == 1 else 1)


def test_a_system_may_have_no_springs() -> None:
    """Free masses."""
    assert system(springs=[]).springs.shape == (0, 2)
    assert system(springs=np.zeros((0, 2), dtype=int)).springs.shape == (0, 2)


@property_test
@given(made=meshes)
def test_fields_are_read_only_and_frozen(made: MassSpringSystem) -> None:
    """Arrays refuse to be written, fields to be replaced."""
    for name in ARRAYS:
        array = getattr(made, name)
        assert not array.flags.writeable
        assert array.flags.c_contiguous
        with pytest.raises(ValueError, match="read-only"):
            array[...] = array
    with pytest.raises(dataclasses.FrozenInstanceError):
        made.drag = 1.0  # type: ignore[misc]


def test_it_keeps_copies() -> None:
    """Changing what it was made from does not change it, nor is that made read-only."""
    positions = np.array(TRIANGLE["positions"])
    made = system(positions=positions)
    positions[0] = 7.0
    assert made.positions[0].tolist() == [0.0, 0.0]
    assert positions.flags.writeable


# --- What it refuses ---


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        # Masses.
        ({"masses": [0.5, -0.1, 0.5]}, "masses[1] = -0.1: expected a number > 0 [kg]"),
        ({"masses": [0.5, 0.5, 0.0]}, "masses[2] = 0: expected a number > 0 [kg]"),
        ({"masses": -0.1}, "masses = -0.1: expected a number > 0 [kg]"),
        ({"masses": NAN}, "masses = nan: expected a finite number [kg]"),
        ({"masses": [0.5, NAN, 0.5]}, "masses[1] = nan: expected a finite number [kg]"),
        ({"masses": [0.5, 0.5]}, "masses has shape (2,): expected (3,)"),
        ({"masses": "heavy"}, "masses = 'heavy': expected numbers [kg]"),
        ({"masses": None}, "masses = nan: expected a finite number [kg]"),
        # Springs.
        ({"stiffness": -1.0}, "stiffness = -1: expected a number >= 0 [N/m]"),
        ({"stiffness": [1.0, -2.5]}, "stiffness[1] = -2.5: expected a number >= 0 [N/m]"),
        ({"stiffness": [NAN, 1.0]}, "stiffness[0] = nan: expected a finite number [N/m]"),
        ({"stiffness": INF}, "stiffness = inf: expected a finite number [N/m]"),
        ({"rest_lengths": -0.1}, "rest_lengths = -0.1: expected a number >= 0 [m]"),
        ({"rest_lengths": [1.0, -1.0]}, "rest_lengths[1] = -1: expected a number >= 0 [m]"),
        ({"damping": -0.1}, "damping = -0.1: expected a number >= 0 [N s/m]"),
        ({"damping": [0.0, NAN]}, "damping[1] = nan: expected a finite number [N s/m]"),
        ({"damping": [0.0, 0.0, 0.0]}, "damping has shape (3,): expected (2,)"),
        ({"springs": [[0, 1], [1, 3]]}, "springs[1] = [1, 3]: expected masses from 0 to 2"),
        ({"springs": [[-1, 1], [1, 2]]}, "springs[0] = [-1, 1]: expected masses from 0 to 2"),
        ({"springs": [[0, 1], [2, 2]]}, "springs[1] = [2, 2]: expected two different masses"),
        (
            {"positions": [[0.0, 0.0], [1.0, 0.5], [1.0, 0.5]]},
            "springs[1] = [1, 2]: expected a length > 0, both masses start at [1.0, 0.5]",
        ),
        ({"springs": [[0.0, 1.0], [1.0, 2.0]]}, "springs has shape (2, 2) of float64: expected (s, 2) whole numbers"),
        ({"springs": [0, 1]}, "springs has shape (2,) of int64: expected (s, 2) whole numbers"),
        ({"springs": [[0, 1, 2]]}, "springs has shape (1, 3) of int64: expected (s, 2) whole numbers"),
        ({"springs": [[0, 1], [2]]}, "springs = [[0, 1], [2]]: expected two masses for each spring"),
        # Positions, velocities, gravity, drag, fixed.
        ({"positions": [[0.0, 0.0], [1.0, NAN], [0.0, 2.0]]}, "positions[1, 1] = nan: expected a finite number [m]"),
        ({"positions": np.zeros((3, 4))}, "positions has shape (3, 4): expected (n, 1), (n, 2) or (n, 3) with n >= 1"),
        ({"positions": [1.0, 2.0]}, "positions has shape (2,): expected (n, 1), (n, 2) or (n, 3) with n >= 1"),
        ({"positions": np.zeros((0, 2))}, "positions has shape (0, 2): expected (n, 1), (n, 2) or (n, 3) with n >= 1"),
        ({"positions": [[0.0, 0.0], [1.0]]}, "positions = [[0.0, 0.0], [1.0]]: expected numbers [m]"),
        ({"velocities": [[0.0, 0.0]] * 2}, "velocities has shape (2, 2): expected (3, 2)"),
        (
            {"velocities": [[0.0, 0.0], [0.0, INF], [0.0, 0.0]]},
            "velocities[1, 1] = inf: expected a finite number [m/s]",
        ),
        ({"gravity": [0.0, 0.0, -9.81]}, "gravity has shape (3,): expected (2,)"),
        ({"gravity": [9.81]}, "gravity is a list of one number: expected a number, or one for each of 2 axes"),
        ({"gravity": [0.0, NAN]}, "gravity[1] = nan: expected a finite number [m/s^2]"),
        ({"drag": -0.02}, "drag = -0.02: expected a number >= 0 [N s/m]"),
        ({"drag": NAN}, "drag = nan: expected a finite number [N s/m]"),
        ({"drag": [0.1, 0.2]}, "drag has shape (2,): expected ()"),
        ({"fixed": [True, False]}, "fixed has shape (2,): expected (3,)"),
        ({"fixed": [0, 2]}, "fixed = [0, 2]: expected true or false for each mass"),
        ({"fixed": [[True], [True, False]]}, "fixed = [[True], [True, False]]: expected true or false for each mass"),
        (
            {"fixed": [True, False, False], "velocities": [[1.0, 2.0], [0.0, 0.0], [0.0, 0.0]]},
            "velocities[0] = [1.0, 2.0]: expected zero, mass 0 is fixed",
        ),
        (
            {"fixed": [True, True, True], "velocities": [[0.0, 0.0], [0.0, 2.0], [3.0, 0.0]]},
            "velocities[1] = [0.0, 2.0]: expected zero, mass 1 is fixed",
        ),
    ],
)
def test_bad_input_is_refused_in_one_line(fields: dict[str, Any], message: str) -> None:
    """Field, index, value and what was expected."""
    with pytest.raises(InputError) as refused:
        system(**fields)
    assert str(refused.value) == message


@property_test
@example("pulls", [[], [0.0]])
@example("broken", [[], [0.0]])
@given(
    name=st.sampled_from([f.name for f in dataclasses.fields(MassSpringSystem)]),
    value=st.one_of(
        st.floats(),
        st.integers(),
        st.text(max_size=3),
        st.none(),
        st.booleans(),
        st.lists(st.floats() | st.integers(-5, 5), max_size=4),
        st.lists(st.lists(st.floats() | st.integers(-5, 5), max_size=3), max_size=4),
    ),
)
def test_whatever_it_is_given_it_makes_a_system_or_says_why_not_in_one_line(name: str, value: Any) -> None:
    """Nothing but an InputError, that names the field."""
    message = refusal(name, value)
    if message is None:
        made = system(**{name: value})
        assert np.isfinite(made.positions).all()
        assert (made.masses > 0).all()
    else:
        assert "\n" not in message
        assert message.startswith((name, "springs", "velocities"))


def refusal(name: str, value: Any) -> str | None:
    """What is said to a value of a field, None if it is taken."""
    try:
        system(**{name: value})
    except InputError as error:
        return str(error)
    return None


# --- What it tells ---


def test_size_is_the_widest_extent_or_the_longest_rest_length() -> None:
    """A length to measure errors against, never zero where there is a spring."""
    assert system().size == 2.0
    assert system(rest_lengths=[1.0, 5.0]).size == 5.0
    assert system(springs=[], positions=[[3.0, 3.0]], masses=1.0).size == 0.0


@pytest.mark.parametrize(
    ("fields", "answer"),
    [
        ({"fixed": [True, False, False]}, True),
        ({"fixed": [True, False, False], "springs": [[1, 0], [2, 1]]}, True),
        ({}, False),
        ({"fixed": [False, False, True]}, False),
        ({"fixed": [True, False, True]}, False),
        ({"fixed": [True, False, False], "springs": [[1, 2], [0, 1]]}, False),
        ({"fixed": [True, False, False], "springs": [[0, 1], [0, 2]]}, False),
        ({"fixed": [True, False, False], "springs": [[0, 1], [1, 2], [0, 2]]}, False),
        ({"fixed": [True], "positions": [[0.0, 0.0]], "springs": []}, False),
    ],
)
def test_it_knows_whether_it_is_the_lectures_string(fields: dict[str, Any], answer: bool) -> None:
    """Spring j joins masses j and j + 1, and mass 0 alone is fixed."""
    assert system(**fields).is_string is answer


def test_the_start_is_its_positions_and_velocities_at_time_zero() -> None:
    """As a state."""
    made = random_mesh(1, 5, 3)
    assert made.start.time == 0.0
    assert made.start.positions is made.positions
    assert made.start.velocities is made.velocities


@property_test
@given(made=meshes, seed=seeds)
def test_renumbering_only_changes_numbers(made: MassSpringSystem, seed: int) -> None:
    """Every mass keeps what it has, every spring the masses it joins; back again it is the same system."""
    order = np.random.default_rng(seed).permutation(len(made.masses))
    other = made.renumbered(order)
    assert other.positions.tolist() == made.positions[order].tolist()
    assert other.masses.tolist() == made.masses[order].tolist()
    for (a, b), (i, j) in zip(made.springs.tolist(), other.springs.tolist(), strict=True):
        assert (order[i], order[j]) == (a, b)
    assert other.renumbered(np.argsort(order)).to_dict() == made.to_dict()


def test_renumbering_by_hand() -> None:
    """Mass order[i] becomes mass i."""
    other = system(fixed=[True, False, False]).renumbered([2, 0, 1])
    assert other.positions.tolist() == [[0.0, 2.0], [0.0, 0.0], [1.0, 0.0]]
    assert other.fixed.tolist() == [False, True, False]
    assert other.springs.tolist() == [[1, 2], [2, 0]]


@property_test
@given(made=meshes)
def test_springs_listed_backwards_or_from_their_other_ends_are_the_same_springs(made: MassSpringSystem) -> None:
    """Each keeps its two masses and its parameters."""

    def springs(system: MassSpringSystem) -> list[Any]:
        """What each spring is, in an order of its own."""
        values = np.column_stack([np.sort(system.springs), system.rest_lengths, system.stiffness, system.damping])
        return sorted(values.tolist())

    assert springs(made.with_springs_reversed()) == springs(made)
    assert springs(made.with_ends_swapped()) == springs(made)
    assert made.with_springs_reversed().springs.tolist() == made.springs[::-1].tolist()
    assert made.with_ends_swapped().springs.tolist() == made.springs[:, ::-1].tolist()


@property_test
@given(made=meshes)
def test_a_dictionary_of_plain_values_makes_the_same_system(made: MassSpringSystem) -> None:
    """Through JSON and back, to the bit."""
    document = made.to_dict()
    assert set(document) == {f.name for f in dataclasses.fields(MassSpringSystem)} - {*OTHERS[2:], "pulls", "broken"}
    assert MassSpringSystem(**json.loads(json.dumps(document))).to_dict() == document


@pytest.mark.parametrize("name", PARAMETERS)
def test_every_parameter_is_set_for_all_and_nothing_else_changes(name: str) -> None:
    """One number; the system it is set on stays as it was."""
    made = random_mesh(2, 5, 2)
    before = made.to_dict()
    after = made.with_parameter(name, 0.7).to_dict()
    attribute = {"mass": "masses", "rest_length": "rest_lengths"}.get(name, name)
    assert made.to_dict() == before
    assert {key for key in after if after[key] != before[key]} == {attribute}
    values = np.asarray(after[attribute])
    assert np.unique(np.abs(values[values != 0])).tolist() == [0.7]


@pytest.mark.parametrize("name", [name for name in PARAMETERS if name != "drag"])
def test_a_parameter_is_set_to_one_number_for_each(name: str) -> None:
    """As the field would be; and it cannot be written to."""
    made, field = random_mesh(2, 5, 2), FIELDS.get(name, name)
    values = np.linspace(0.5, 1.0, len(getattr(made, field)))
    changed = made.with_parameter(name, values.tolist())
    assert changed.to_dict() == dataclasses.replace(made, **{field: values}).to_dict()
    with pytest.raises(ValueError, match="read-only"):
        getattr(changed, field)[0] = 1.0


def test_pulls_add_up_and_the_system_they_were_set_in_has_none() -> None:
    """One number of one mass each; what was there stays, and nothing is shared."""
    plain = system()
    one = plain.with_parameter("pull.1.x", 3.0)
    both = one.with_parameter("pull.0.y", -2.0)
    assert not plain.pulls.any()
    assert (one.pulls[1, 0], np.count_nonzero(one.pulls)) == (3.0, 1)
    assert (both.pulls[1, 0], both.pulls[0, 1], np.count_nonzero(both.pulls)) == (3.0, -2.0, 2)
    with pytest.raises(ValueError, match="read-only"):
        both.pulls[0, 0] = 1.0


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("mass", [0.1, 0.0, 0.2], "mass[1] = 0: expected a number > 0 [kg]"),
        ("mass", [0.1, 0.2], "mass has 2 numbers: expected one, or one for each of 3 masses"),
        ("stiffness", [1.0, float("nan")], "stiffness[1] = nan: expected a finite number [N/m]"),
        ("damping", [1.0, 2.0, 3.0], "damping has 3 numbers: expected one, or one for each of 2 springs"),
        ("gravity", [0.0, -1.0, 0.0], "gravity has 3 numbers: expected one, or one for each of 2 axes"),
        ("gravity", [0.0, float("inf")], "gravity[1] = inf: expected a finite number [m/s^2]"),
        ("drag", [0.1, 0.1], "drag has 2 numbers: expected one [N s/m]"),
        ("drag", -0.1, "drag = -0.1: expected a number >= 0 [N s/m]"),
    ],
)
def test_values_that_make_no_sense_are_refused(name: str, value: Any, message: str) -> None:
    """By name, index, value, and what was expected."""
    with pytest.raises(InputError) as refused:
        system().with_parameter(name, value)
    assert str(refused.value) == message


def test_unknown_parameters_are_refused_with_a_suggestion() -> None:
    """By the names of PARAMETERS, not of the fields."""
    with pytest.raises(InputError, match=r"^unknown parameter 'stifness': did you mean 'stiffness'\?$"):
        system().with_parameter("stifness", 1.0)


@pytest.mark.parametrize("angle", [0.0, 30.0, 77.0])
def test_springs_of_a_long_string_are_at_their_rest_lengths(angle: float) -> None:
    """At 1,250 m positions round by 1e-13 m, a part in 1e12 of a spring; a spring off by 1e-9 of it is seen."""
    system = find_scene("string").system({"masses": 10_000, "angle": angle})
    assert not system.off_rest_length.any()
    lengths = system.rest_lengths.copy()
    lengths[[0, 9_999]] *= 1 + 1e-10, 1 - 1e-10
    assert np.flatnonzero(dataclasses.replace(system, rest_lengths=lengths).off_rest_length).tolist() == [0, 9_999]


def test_a_scale_is_never_zero() -> None:
    """The size, the largest coordinate, or 1 m."""
    string = find_scene("string").system({"masses": 2, "rest_length": 0.5})
    assert string.scale == string.size == 1.0
    assert dataclasses.replace(string, positions=string.positions - [7.0, 0.0]).scale == 7.0
    alone = {"springs": np.zeros((0, 2), dtype=int), "rest_lengths": np.zeros(0), "stiffness": np.zeros(0)}
    assert MassSpringSystem(positions=np.zeros((1, 2)), masses=np.ones(1), **alone).scale == 1.0
