"""The parts of a system and what each carries, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.springs.angular import AngularSprings
from reference.system import MassSpringSystem
from reference.theory.parts import falling_velocities, loads, parts_of


def masses(springs: list[list[int]], **fields: Any) -> MassSpringSystem:
    """Six unequal masses in the plane, the first of them fixed, under a gravity of (1, -10) m/s^2."""
    made: dict[str, Any] = {
        "positions": np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 0.0], [4.0, 1.0], [5.0, 0.0]]),
        "springs": np.array(springs),
        "masses": np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        "rest_lengths": np.array(1.0),
        "stiffness": np.array(1.0),
        "gravity": np.array([1.0, -10.0]),
        "fixed": np.arange(6) == 0,
        **fields,
    }
    return MassSpringSystem(**made)


@pytest.mark.parametrize("first", [[0, 1], [1, 0]])
def test_a_part_is_held_whichever_end_of_a_spring_is_fixed(first: list[int]) -> None:
    """Masses 1 and 3 hang on the fixed one; 2 and 5 on one another; 4 on nothing."""
    parts = parts_of(masses([first, [3, 1], [2, 5]]))
    assert parts.of_mass[0] == -1
    assert parts.of_mass[1] == parts.of_mass[3]
    assert parts.of_mass[2] == parts.of_mass[5]
    assert len(set(parts.of_mass.tolist())) == 4
    assert parts.held[parts.of_mass[[1, 2, 4]]].tolist() == [True, False, False]
    assert parts.loose.tolist() == [2, 4, 5]


def test_springs_without_stiffness_hold_nothing_and_bends_do() -> None:
    """A part is joined by an angular spring's three masses as by springs; not by one without stiffness."""
    springs = {"stiffness": np.array([1.0, 0.0])}
    assert parts_of(masses([[0, 1], [1, 2]], **springs)).loose.tolist() == [2, 3, 4, 5]
    for kappa, loose in ((1.0, [5]), (0.0, [2, 3, 4, 5])):
        bend = AngularSprings(np.array([[4, 3, 1], [1, 2, 3]]), np.array(kappa))
        assert parts_of(masses([[0, 1], [1, 2]], angular_springs=bend, **springs)).loose.tolist() == loose


def test_a_held_part_carries_its_weight_and_a_loose_one_what_drag_makes_unequal() -> None:
    """M g; without drag nothing; with it (m - mean m) g: of 3 and 6 kg, -1.5 and 1.5 times g."""
    springs = [[1, 0], [3, 1], [2, 5]]
    g = np.array([1.0, -10.0])
    found = loads(masses(springs), parts_of(masses(springs)))
    assert found == pytest.approx(np.outer([0.0, 2.0, 0.0, 4.0, 0.0, 0.0], g))
    dragged = masses(springs, drag=0.5)
    assert loads(dragged, parts_of(dragged)) == pytest.approx(np.outer([0.0, 2.0, -1.5, 4.0, 0.0, 1.5], g))
    assert falling_velocities(dragged) == pytest.approx(np.outer([0.0, 0.0, 9.0, 0.0, 10.0, 9.0], g))
    assert not falling_velocities(masses(springs)).any()


def test_a_pull_on_a_loose_part_is_shared_by_its_masses() -> None:
    """9 N on the 3 kg of 9 kg: 3 N of it are its own, and 6 N the other's, which the spring has to carry."""
    pulls = np.zeros((6, 2))
    pulls[2], pulls[1], pulls[0] = [9.0, 0.0], [0.0, 4.0], [7.0, 7.0]
    still = masses([[0, 1], [2, 5]], gravity=np.zeros(2), pulls=pulls)
    found = loads(still, parts_of(still))
    assert found.tolist() == [[0.0, 0.0], [0.0, 4.0], [6.0, 0.0], [0.0, 0.0], [0.0, 0.0], [-6.0, 0.0]]
    dragged = masses([[0, 1], [2, 5]], pulls=pulls, drag=0.1)
    with pytest.raises(SolverError, match="a mass is pulled, and with drag, that nothing holds"):
        loads(dragged, parts_of(dragged))


@pytest.mark.parametrize("damper", [[1, 2], [2, 1]])
def test_a_damper_alone_between_parts_creeps(damper: list[int]) -> None:
    """It is named; within one part, and where nothing weighs, it does not."""
    fields = {"stiffness": np.array([1.0, 1.0, 0.0]), "damping": np.array([0.0, 0.5, 0.5])}
    creeping = masses([[0, 1], [1, 3], damper], **fields)
    with pytest.raises(SolverError, match="spring 2 has damping and no stiffness"):
        loads(creeping, parts_of(creeping))
    for fine in (masses([[0, 1], [1, 3], [3, 1]], **fields), masses([[0, 1], [1, 3], damper], gravity=0.0, **fields)):
        assert loads(fine, parts_of(fine))[0].tolist() == [0.0, 0.0]


def test_a_damper_alone_between_what_is_held_lets_it_come_to_rest() -> None:
    """Between two parts that hang on the fixed mass by springs of their own, or from one to the fixed mass itself."""
    fields = {"stiffness": np.array([1.0, 1.0, 0.0]), "damping": np.array([0.0, 0.5, 0.5])}
    for damper in ([1, 2], [2, 1], [0, 2], [1, 0]):
        hung = masses([[0, 1], [0, 2], damper], **fields)
        assert loads(hung, parts_of(hung))[1:3].tolist() == [[2.0, -20.0], [3.0, -30.0]]
    for damper, drag in (([1, 4], 0.0), ([4, 0], 0.0), ([3, 4], 0.1)):
        creeping = masses([[0, 1], [0, 2], damper], drag=drag, **fields)
        with pytest.raises(SolverError, match="spring 2 has damping and no stiffness"):
            loads(creeping, parts_of(creeping))
    falling = masses([[0, 1], [0, 2], [3, 4]], **fields)
    assert not loads(falling, parts_of(falling))[3:].any()
