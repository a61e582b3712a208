"""What Box2D would take for something else is refused: here without the engine, which need not be installed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.box2d.common import SHORTEST, check, moving
from engines.engine import find
from reference.errors import Unsupported
from reference.scenes.strings import string
from reference.system import MassSpringSystem


def test_springs_shorter_than_its_slop_are_refused_and_longer_ones_are_not() -> None:
    """Box2D's linear slop is 5 mm: a shorter spring it steps with another length, which would be no spring of ours."""
    system = string()
    shorter = np.where(np.arange(len(system.springs)) == 3, 0.0049, 0.0051)
    assert SHORTEST == 0.005
    check(find("box2d_3_joints"), replace(system, rest_lengths=np.full(len(system.springs), 0.0051)))
    with pytest.raises(Unsupported, match=r"shorter than 0\.005 m"):
        check(find("box2d_3_joints"), replace(system, rest_lengths=shorter))


def test_only_springs_between_two_fixed_masses_move_nothing() -> None:
    """One end that is free is enough, whichever; of those between fixed masses it is not asked how stiff they are."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2], [2, 3], [3, 0]]),
        masses=np.ones(4),
        rest_lengths=np.ones(4),
        stiffness=np.array([0.0, 1.0, 1.0, 1.0]),
        fixed=np.array([True, True, False, False]),
    )
    assert moving(system).tolist() == [1, 2, 3]
    check(find("box2d_3_joints"), system)
    for spring in (1, 2, 3):
        soft = replace(system, stiffness=np.where(np.arange(4) == spring, 0.0, system.stiffness))
        with pytest.raises(Unsupported, match="without stiffness"):
            check(find("box2d_3_joints"), soft)
