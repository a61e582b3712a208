"""What masses feel of obstacles that they rest on or enter, by differences and by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.obstacles import Box, Circle, Plane, Sphere, project_out
from reference.schemes.catalogue import find
from reference.schemes.constrained import ROPE_KICK_DRIFT
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.contacts import ContactLinearisation, Contacts, curvatures, curving, projection_jacobian
from reference.theory.keeps_to_surfaces import keeps_to_surfaces


def loose(positions: Array, obstacles: tuple[Any, ...], fixed: list[int]) -> MassSpringSystem:
    """Masses without springs; those that are fixed may stand inside."""
    return MassSpringSystem(
        positions=positions,
        springs=np.zeros((0, 2), dtype=int),
        masses=np.arange(1.0, len(positions) + 1),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        gravity=np.zeros(positions.shape[1]),
        fixed=np.isin(np.arange(len(positions)), fixed),
        obstacles=obstacles,
    )


def test_a_step_s_end_on_obstacles_has_the_derivative_of_its_differences() -> None:
    """Masses in a circle, in a floor, in both, in none; inwards and outwards; over (x, dt v) of those that move.

    By central differences of h = 1e-5 m: to h^2 / R^3, and the curvatures' own.
    """
    positions = np.array([[0.0, 5.0], [0.2, 1.0], [-0.6, 0.9], [0.9, -0.1], [0.55, -0.05], [-0.3, 1.05], [4.0, -0.2]])
    velocities = np.array([[0, 0], [0.3, -2], [1.0, 2.0], [0.7, -1.0], [-0.8, -0.6], [-1.0, -2.0], [0.5, 0.9]])
    start = positions + np.array([0.0, 9.0])
    obstacles = (Circle((0.0, 0.5), 0.8), Plane((0.0, 0.0), (0.1, 1.0)))
    system, dt, h = loose(start, obstacles, [0, 5]), 0.05, 1e-5
    free = ~system.fixed

    def end(z: Array) -> Array:
        x, v = positions.copy(), velocities.copy()
        x[free], v[free] = np.split(z.reshape(-1, 2), 2)
        x, v = project_out(obstacles, system.fixed[:, None], x, v / dt)
        return np.concatenate([x[free].ravel(), dt * v[free].ravel()])

    z = np.concatenate([positions[free].ravel(), velocities[free].ravel()])
    expected = np.stack([(end(z + e) - end(z - e)) / (2 * h) for e in h * np.eye(len(z))], axis=1)
    found = projection_jacobian(system, positions, velocities / dt, dt)
    assert found == pytest.approx(expected, abs=1e-6)
    assert np.abs(expected - np.eye(len(z))).max() > 1


@pytest.mark.parametrize(
    ("obstacle", "place", "expected"),
    [
        (Circle((0.0, 0.0), 0.5), [0.3, 0.4], np.array([[0.64, -0.48], [-0.48, 0.36]]) / 0.5),
        (Sphere((0.0, 0.0, 1.0), 2.0), [0.0, 0.0, 3.0], np.diag([0.5, 0.5, 0.0])),
        (Plane((0.0, 0.0), (0.6, 0.8)), [0.1, 0.2], np.zeros((2, 2))),
        (Box((0.0, 0.0), (1.0, 2.0)), [1.0, 0.5], np.zeros((2, 2))),
    ],
)
def test_how_surfaces_curve(obstacle: Any, place: list[float], expected: Array) -> None:
    """(1 - n n^T) / R of what is round, with R the distance from its centre; nothing of what is flat."""
    assert curvatures(obstacle, np.array([place]), 1e-3)[0] == pytest.approx(expected, abs=1e-9)


#: Mass 1 rests on the floor, masses 2 and 3 on the circle; of mass 0, which is fixed, nobody asks.
FLOOR_AND_ROUND = (Plane((0.0, -3.0), (0.0, 1.0)), Circle((0.0, 0.0), 0.5))
PLACES = np.array([[9.0, 9.0], [2.0, -3.0], [0.0, 0.5], [0.5, 0.0]])
ON_BOTH = Contacts(
    np.array([1, 2, 3]), np.array([0, 1, 1]), np.array([[0.0, 1.0], [0.0, 1.0], [1.0, 0.0]]), np.array([7.0, 3.0, 4.0])
)


def test_what_is_flat_is_told_by_what_presses() -> None:
    """Whatever else there is, in whatever order."""
    system = loose(PLACES, FLOOR_AND_ROUND, [0])
    for on, flat in (([0], True), ([1], False), ([0, 1], False), ([1, 0], False), ([0, 0], True), ([], True)):
        count = len(on)
        contacts = Contacts(np.arange(count), np.array(on, dtype=int), np.zeros((count, 2)), np.ones(count))
        assert contacts.flat(system) == flat
        assert len(contacts) == count


def test_forces_of_contacts_times_how_their_surfaces_curve() -> None:
    """N / R along the surface: 3 N and 4 N on 0.5 m, each on its own mass; of the floor nothing."""
    system = loose(PLACES, FLOOR_AND_ROUND, [0])
    assert curving(system, PLACES, ON_BOTH).toarray() == pytest.approx(np.diag([0, 0, 6.0, 0, 0, 8.0]), abs=1e-8)


def test_moves_and_matrices_along_surfaces() -> None:
    """One direction of each mass: to the side on the floor and on top, up and down beside the circle."""
    system = loose(PLACES, FLOOR_AND_ROUND, [0])
    found = ContactLinearisation(system, system.start, contacts=ON_BOTH)
    tangents = np.abs(found.tangents.toarray())
    assert tangents == pytest.approx(np.eye(6)[:, [0, 2, 5]], abs=1e-12)
    assert found.mass == pytest.approx([2.0, 3.0, 4.0])
    # a load on something round that is pushed to the side comes down: the stiffness is less than none
    assert found.stiffness.toarray() == pytest.approx(np.diag([0.0, -6.0, -8.0]), abs=1e-8)
    assert found.on_masses(np.array([9.0, 1.0, 2.0, 3.0])).toarray() == pytest.approx(np.diag([1.0, 2.0, 3.0]))
    assert np.abs(found.moves(np.array([0.1, 0.2, 0.3]))) == pytest.approx([0.1, 0.0, 0.2, 0.0, 0.0, 0.3])


def test_in_a_corner_there_is_no_move_and_twice_the_same_contact_bars_one() -> None:
    """Of two masses: one between floor and wall, one on two floors at the same height."""
    system = loose(np.array([[0.0, 0.0], [1.0, 0.0]]), (Plane((0.0, 0.0), (0.0, 1.0)),), [])
    normals = np.array([[0.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    contacts = Contacts(np.array([0, 0, 1, 1]), np.zeros(4, dtype=int), normals, np.ones(4))
    found = ContactLinearisation(system, system.start, contacts=contacts).tangents.toarray()
    assert np.abs(found) == pytest.approx(np.array([[0.0], [0.0], [1.0], [0.0]]), abs=1e-12)


@pytest.mark.parametrize(
    ("name", "keeps"),
    [
        ("kick_drift", True),
        ("leapfrog_drift_kick_drift", True),
        ("heun", False),
        ("rk4", False),
        ("backward_euler", False),
        ("implicit_midpoint", False),
        ("euler", False),
        ("drift_kick", False),
        ("bdf2", False),
        ("kick_drift_truncated_damping", False),
        ("xpbd_jacobi", False),
        ("rope_kick_drift", False),
    ],
)
def test_which_schemes_step_along_a_surface_as_without_it(name: str, keeps: bool) -> None:
    """Those of one step that take the force once, before the masses enter the floor: no stage sees springs inside.

    Euler's first step from rest leads nowhere; what is not linear, remembers, or steps rods is not asked.
    """
    assert keeps_to_surfaces(ROPE_KICK_DRIFT if name == "rope_kick_drift" else find(name)) == keeps
