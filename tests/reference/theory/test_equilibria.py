"""Systems at rest, ready to be perturbed: what is small, what is free, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.errors import SolverError
from reference.obstacles import Box, Circle, Plane
from reference.scenes import find as find_scene
from reference.theory import rest_on_obstacles
from reference.theory.equilibria import (
    equilibrium_on_obstacles,
    pendulum_equilibrium,
    rope_equilibrium,
    spring_equilibrium,
)

STRING = find_scene("string").system({"masses": 3, "rest_length": [0.2, 0.1, 0.3], "mass": [0.02, 0.03, 0.05]})


def test_perturbations_are_to_be_small_against_the_shortest_spring() -> None:
    """Or, where no spring has a length, the system's extent, wherever it is."""
    assert spring_equilibrium(STRING).scale == 0.1
    assert rope_equilibrium(STRING).scale == 0.1
    assert pendulum_equilibrium(STRING).scale == 1.0
    slinky = find_scene("slinky").system({"masses": 3})
    far = replace(slinky, positions=slinky.positions + 50.0, rest_lengths=np.array(0.0))
    assert spring_equilibrium(far).scale == far.size < far.scale


def test_what_is_free_at_rest() -> None:
    """All masses but the anchor; of a pendulum all its angles, which gravity sets."""
    assert spring_equilibrium(STRING).free.tolist() == [False, True, True, True]
    assert rope_equilibrium(STRING).free.tolist() == [False, True, True, True]
    tilted = pendulum_equilibrium(replace(STRING, gravity=np.array([3.0, -4.0])))
    assert tilted.free.tolist() == [True, True, True]
    assert tilted.state.positions == pytest.approx(np.full(3, np.arctan2(3.0, 4.0)))
    assert rope_equilibrium(STRING).state.positions == pytest.approx(
        np.array([[0.0, 0.0], [0.0, -0.2], [0.0, -0.3], [0.0, -0.6]]), abs=1e-15
    )


def test_only_what_is_pressed_is_a_contact() -> None:
    """A floor that the string hangs down to, and one that it does not reach; in words."""
    floors = [replace(STRING, obstacles=(Plane((0.0, -y), (0.0, 1.0)),)) for y in (0.55, 9.0)]
    pressed, apart = (spring_equilibrium(system) for system in floors)
    assert pressed.contacts is not None
    assert pressed.contacts.masses.tolist() == [3]
    assert apart.contacts is None
    said = [equilibrium_on_obstacles(system)[1] for system in floors]
    assert said == ["about its rest on obstacles, where 1 mass presses", "at its rest no mass presses on an obstacle"]


def test_the_first_spring_that_would_break_at_rest_is_named() -> None:
    """Of three that carry 0.98, 0.78 and 0.49 N, two are too weak."""
    weak = find_scene("chain").system({"masses": 3, "mass": "0.02,0.03,0.05", "breaking_force": "9,0.5,0.3"})
    with pytest.raises(SolverError, match=r"spring 1 would carry 0.7848 N at rest, and breaks there"):
        spring_equilibrium(weak)


@pytest.mark.parametrize(
    ("obstacle", "width"),
    [
        (Circle((0.0, 0.0), 0.3), 0.3),
        (Box((0.0, 0.0), (0.4, 0.1)), 0.1),
        (Box((0.0, 0.0, 0.0), (0.2, 0.4, 0.3)), 0.2),
        (Plane((0.0, 0.0), (0.0, 1.0)), np.inf),
    ],
)
def test_no_step_downhill_leads_through_an_obstacle(obstacle: Box | Circle | Plane, width: float) -> None:
    """The thinnest half of it; of a floor there is no other side."""
    assert rest_on_obstacles._half_width(obstacle) == width
