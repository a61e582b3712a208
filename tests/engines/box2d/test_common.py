"""What Box2D would take for something else is refused: here without the engine, which need not be installed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.box2d.common import SHORTEST, check
from engines.engine import find
from reference.errors import Unsupported
from reference.scenes.strings import string


def test_springs_shorter_than_its_slop_are_refused_and_longer_ones_are_not() -> None:
    """Box2D's linear slop is 5 mm: a shorter spring it steps with another length, which would be no spring of ours."""
    system = string()
    shorter = np.where(np.arange(len(system.springs)) == 3, 0.0049, 0.0051)
    assert SHORTEST == 0.005
    check(find("box2d_3_joints"), replace(system, rest_lengths=np.full(len(system.springs), 0.0051)))
    with pytest.raises(Unsupported, match=r"shorter than 0\.005 m"):
        check(find("box2d_3_joints"), replace(system, rest_lengths=shorter))
