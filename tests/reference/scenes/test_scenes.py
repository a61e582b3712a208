"""The scenes: what they are, which parameters they take as what, and what they refuse."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.changes import whole_steps
from reference.errors import InputError
from reference.scenes import find, scenes
from reference.system import MassSpringSystem
from tests.reference.systems import label, property_test

ALL = list(scenes().values())

# --- What they are ---


@pytest.mark.parametrize("scene", ALL, ids=label)
def test_every_scene_is_a_system_with_a_step_a_duration_and_a_sentence(scene: Any) -> None:
    """By its defaults; with whole steps."""
    assert isinstance(scene.system({}), MassSpringSystem)
    assert whole_steps(scene.dt, scene.duration) * scene.dt == pytest.approx(scene.duration)
    assert scene.summary
    assert scene.slides
    assert find(scene.name) is scene


@pytest.mark.parametrize("scene", ALL, ids=label)
def test_every_parameter_can_be_given_as_its_default(scene: Any) -> None:
    """As a number and as text it makes the system there is without it."""
    plain = scene.system({}).to_dict()
    assert scene.system(dict(scene.parameters)).to_dict() == plain
    assert scene.system({name: str(value) for name, value in scene.parameters.items()}).to_dict() == plain


@pytest.mark.parametrize("scene", ALL, ids=label)
def test_every_parameter_changes_the_system(scene: Any) -> None:
    """Or what drives it: none is ignored."""

    def made(settings: dict[str, Any]) -> object:
        setup = scene.setup(settings)
        return setup.system.to_dict(), setup.changes

    plain = made({})
    for name, value in scene.parameters.items():
        a_little = 1 if isinstance(value, int) else 0.01
        others = [word for word in scene.choices.get(name, ()) if word != value] or [value + a_little]
        for other in others:
            assert made({name: other}) != plain, name


def test_the_spring_hangs_at_its_stretch() -> None:
    """Slide 2, from its top: anchor at the origin, the mass below, moving upwards."""
    spring = find("spring").system({"rest_length": 0.2, "stretch": 0.05, "velocity": 3.0, "mass": 0.1})
    assert spring.positions.tolist() == [[0.0, 0.0], [0.0, -0.25]]
    assert spring.velocities.tolist() == [[0.0, 0.0], [0.0, 3.0]]
    assert spring.fixed.tolist() == [True, False]
    assert spring.masses[1] == 0.1


def test_the_string_is_the_one_the_engines_were_measured_on() -> None:
    """Ten masses let go horizontally: positions are multiples of 0.125 m to the bit."""
    string = find("string").system({})
    assert string.positions.tolist() == [[i * 0.125, 0.0] for i in range(11)]
    assert string.springs.tolist() == [[i, i + 1] for i in range(10)]
    assert string.masses.tolist() == [0.02] * 11
    assert string.stiffness.tolist() == [200.0] * 10
    assert string.gravity.tolist() == [0.0, -9.81]
    assert not string.velocities.any()
    assert not string.damping.any()
    assert string.drag == 0.0
    assert string.fixed.tolist() == [True] + [False] * 10
    assert string.is_string


@pytest.mark.parametrize(
    ("angle", "tip"),
    [(0.0, [2.0, 0.0]), (90.0, [0.0, -2.0]), (180.0, [-2.0, 0.0]), (270.0, [0.0, 2.0]), (-90.0, [0.0, 2.0])],
)
def test_right_angles_are_exact(angle: float, tip: list[float]) -> None:
    """A string let go straight down has no bit of x."""
    string = find("string").system({"masses": 2, "rest_length": 1.0, "angle": angle})
    assert string.positions[-1].tolist() == tip


@property_test
@given(
    masses=st.integers(1, 30),
    length=st.floats(0.01, 10.0),
    angle=st.floats(-360.0, 360.0),
    x0=st.floats(-10, 10),
    y0=st.floats(-10, 10),
)
def test_the_string_starts_straight_and_unstretched(
    masses: int, length: float, angle: float, x0: float, y0: float
) -> None:
    """At its angle below the horizontal, from its anchor; lengths are right to the rounding of coordinates."""
    parameters = {"masses": masses, "rest_length": length, "angle": angle, "x0": x0, "y0": y0}
    string = find("string").system(parameters)
    assert string.positions[0].tolist() == [x0, y0]
    lengths = np.linalg.norm(np.diff(string.positions, axis=0), axis=1)
    assert np.abs(lengths - length).max() < 1e-15 * (abs(x0) + abs(y0) + masses * length) * 4
    reach = masses * length * np.array([np.cos(np.radians(angle)), -np.sin(np.radians(angle))])
    assert string.positions[-1] - string.positions[0] == pytest.approx(reach, abs=1e-12 * masses * length + 1e-14)


@pytest.mark.parametrize("as_text", [False, True])
def test_one_number_for_each_mass_or_spring(as_text: bool) -> None:
    """As a list in a file, and separated by commas on the command line; the anchor's mass is the first's."""
    lists: dict[str, Any] = {
        "mass": [0.1, 0.2, 0.3],
        "rest_length": [1.0, 2.0, 3.0],
        "stiffness": [10.0, 20.0, 30.0],
        "damping": [0.0, 0.5, 1.0],
    }
    given_ = {name: ",".join(map(str, values)) if as_text else values for name, values in lists.items()}
    string = find("string").system({"masses": 3, **given_})
    assert string.masses.tolist() == [0.1, 0.1, 0.2, 0.3]
    assert string.rest_lengths.tolist() == lists["rest_length"]
    assert string.stiffness.tolist() == lists["stiffness"]
    assert string.damping.tolist() == lists["damping"]
    assert string.positions[:, 0].tolist() == [0.0, 1.0, 3.0, 6.0]


# --- What they refuse ---


@pytest.mark.parametrize(
    ("name", "settings", "message"),
    [
        ("string", {"stifness": 1}, "unknown parameter of scene 'string' 'stifness': did you mean 'stiffness'?"),
        ("spring", {"masses": 3}, "unknown parameter of scene 'spring' 'masses': did you mean 'mass'?"),
        ("string", {"masses": 2.5}, "masses = 2.5: expected a whole number"),
        ("string", {"masses": "many"}, "masses = 'many': expected a whole number"),
        ("string", {"masses": 0}, "masses = 0: expected a whole number from 1 to 10,000,000"),
        ("string", {"masses": -3}, "masses = -3: expected a whole number from 1 to 10,000,000"),
        ("string", {"masses": float("inf")}, "masses = inf: expected a whole number"),
        ("string", {"masses": "nan"}, "masses = 'nan': expected a whole number"),
        ("string", {"masses": 10**29}, "masses = 1e+29: expected a whole number from 1 to 10,000,000"),
        ("string", {"masses": 10**400}, f"masses = {10**400}: expected a whole number"),
        ("string", {"masses": [5]}, "masses = [5]: expected one number"),
        ("string", {"mass": 0.0}, "mass = 0: expected a number > 0 [kg]"),
        ("string", {"mass": "nan"}, "mass = nan: expected a finite number [kg]"),
        ("string", {"mass": [0.1, -0.1] * 5}, "mass = -0.1: expected a number > 0 [kg]"),
        ("string", {"mass": [0.1, 0.2]}, "mass has 2 numbers: expected one, or one for each of 10"),
        ("string", {"mass": []}, "mass has 0 numbers: expected one, or one for each of 10"),
        ("string", {"mass": "0.1,0.2"}, "mass has 2 numbers: expected one, or one for each of 10"),
        ("string", {"stiffness": -1}, "stiffness = -1: expected a number >= 0 [N/m]"),
        ("string", {"stiffness": "stiff"}, "stiffness = 'stiff': expected a number"),
        ("string", {"stiffness": ""}, "stiffness = '': expected a number"),
        ("string", {"stiffness": "1,,2"}, "stiffness = '1,,2': expected a number"),
        ("string", {"stiffness": True}, "stiffness = True: expected a number"),
        ("string", {"stiffness": None}, "stiffness = None: expected a number"),
        ("string", {"rest_length": "-1"}, "rest_length = -1: expected a number > 0 [m]"),
        (
            "string",
            {"rest_length": "0"},
            "rest_length = 0: expected a number > 0 [m], as scenes are laid out by it; "
            "--change 0:rest_length=0 makes it 0 from the start, as does [[changes]] in a scene file",
        ),
        ("string", {"damping": "-0.5"}, "damping = -0.5: expected a number >= 0 [N s/m]"),
        ("string", {"drag": -0.1}, "drag = -0.1: expected a number >= 0 [N s/m]"),
        ("string", {"drag": "0.1,0.2"}, "drag = '0.1,0.2': expected one number"),
        ("string", {"gravity": "inf"}, "gravity = inf: expected a finite number [m/s^2]"),
        ("spring", {"mass": [0.1, 0.2]}, "mass = [0.1, 0.2]: expected one number"),
        ("cloth", {"pinned": "corner"}, "pinned = 'corner': expected one of corners, four_corners, edge"),
        ("cloth", {"pinned": ["edge"]}, "pinned = ['edge']: expected one of corners, four_corners, edge"),
        ("cloth", {"rows": 1}, "rows = 1: expected a whole number from 2 to 2,000,000"),
        ("cloth", {"rows": 2000, "columns": 2000}, "rows x columns = 4,000,000 masses: expected at most 2,000,000"),
        ("cloth", {"bend": -1}, "bend = -1: expected a number >= 0"),
        ("cloth", {"mass": [0.1, 0.2]}, "mass has 2 numbers: expected one, or one for each of 100"),
        ("jello", {"diagonals": "-1"}, "diagonals = -1: expected a number >= 0"),
        ("bridge", {"kind": "pratt", "panels": 5}, "panels = 5: expected an even number, a pratt truss is symmetric"),
        ("bridge", {"panels": 0}, "panels = 0: expected a whole number from 1 to 100,000"),
        ("bridge", {"truck_position": 25}, "truck_position = 25: expected a number from 0 to 24 [m]"),
        ("bridge", {"height": 0}, "height = 0: expected a number > 0 [m]"),
        (
            "bridge",
            {"axial_stiffness": [1e7] * 3},
            "axial_stiffness has 3 numbers: expected one, or one for each of 31",
        ),
        ("soil", {"margin": -1}, "margin = -1: expected a whole number from 0 to 10,000,000"),
        ("soil", {"soil_damping": -1}, "soil_damping = -1: expected a number >= 0"),
        ("spring", {"stretch": -0.125}, "springs[0] = [0, 1]: expected a length > 0, both masses start at [0.0, 0.0]"),
    ],
)
def test_values_that_make_no_sense_are_refused(name: str, settings: dict[str, Any], message: str) -> None:
    """In one line, with the name that was used."""
    with pytest.raises(InputError) as refused:
        find(name).system(settings)
    said = str(refused.value)
    assert said.replace("-0.0", "0.0") == message


def test_unknown_scenes_are_refused_with_a_suggestion() -> None:
    """One letter off."""
    with pytest.raises(InputError, match=r"^unknown scene 'strng': did you mean 'string'\?$"):
        find("strng")


@property_test
@given(
    scene=st.sampled_from(ALL),
    data=st.data(),
    value=st.one_of(
        st.text(max_size=6), st.floats(), st.integers(-(10**6), 10), st.none(), st.lists(st.floats(), max_size=3)
    ),
)
def test_whatever_a_parameter_is_given_it_makes_a_system_or_says_why_not(scene: Any, data: Any, value: Any) -> None:
    """Nothing but an InputError, in one line; also of what changes while it moves."""
    name = data.draw(st.sampled_from(sorted(scene.parameters)))
    message = refusal(lambda: scene.setup({name: value}).check())
    assert message is None or ("\n" not in message and message)


#: What floats can hold and products of them cannot, or not to rounding; and no numbers at all.
EXTREMES = [0.0, 5e-324, 1e-310, 1e-160, 1e-20, 3.4e16, 5.4e16, 1e103, 1e155, 1.7e308, 2.0**63, np.inf, np.nan]


@pytest.mark.rotating(5)
@pytest.mark.parametrize("scene", ALL, ids=label)
def test_an_extreme_value_of_any_parameter_makes_a_system_or_is_refused_by_name(scene: Any) -> None:
    """By the parameter's, or by that of the system's field it goes into; warnings are errors in all tests.

    In fifty steps: what drives a scene changes it at each of them.
    """
    dt = scene.duration / 50
    named = re.compile("|".join([*scene.parameters, *(f.name for f in fields(MassSpringSystem))]))
    for name, default in scene.parameters.items():
        for value in EXTREMES if isinstance(default, float) else (-(2**63), -1, 0, 10**19, 10**400):
            for signed in (value, -value):
                message = refusal(lambda: scene.setup({name: signed}, dt).check())  # noqa: B023 - called at once
                assert message is None or ("\n" not in message and named.search(message)), (name, signed, message)


@pytest.mark.parametrize("scene", ALL, ids=label)
def test_the_border_that_a_refusal_names_is_where_it_is(scene: Any) -> None:
    """What is told to be >= 0 may be 0, as far as it goes, and what is told to be > 0 may not."""
    for name, default in scene.parameters.items():
        below = refusal(lambda: scene.setup({name: type(default)(-1)})) or ""  # noqa: B023 - called at once
        said = re.search(r"= -1: expected a (?:finite )?number (>=?) 0", below)
        if said:
            at_zero = refusal(lambda: scene.setup({name: type(default)(0)})) or ""  # noqa: B023
            assert at_zero.startswith(f"{name} = 0") == (said[1] == ">"), (name, below, at_zero)


def refusal(make: Callable[[], object]) -> str | None:
    """What is said to bad input, None if it is taken."""
    try:
        make()
    except InputError as error:
        return str(error)
    return None
