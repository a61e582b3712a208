"""The compiled loop over springs against the formula for all springs at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.assembly import spring_blocks
from reference.block_loops import blocks_by_loop
from reference.forces import SpringMotion
from reference.scenes import scenes
from reference.state import State
from reference.system import MassSpringSystem
from tests.reference.test_no_rest_length import thrown

#: Sums of three squares may be taken in another order.
ROUNDING = 1e-14


def moved(system: MassSpringSystem) -> State:
    """The system's start, with every mass moved and thrown otherwise."""
    rng = np.random.default_rng(1)
    shape = system.positions.shape
    return State(0.0, system.positions + 0.01 * system.size * rng.normal(size=shape), rng.normal(size=shape))


@pytest.mark.parametrize("name", list(scenes()))
def test_it_is_the_formula_of_all_springs_at_once(name: str) -> None:
    """On every scene, in two and three dimensions, with springs that are slack, harden or resist bending."""
    system = scenes()[name].setup({}).system
    state = moved(system)
    for blocks, expected in zip(SpringMotion(system).jacobians(state), spring_blocks(system, state), strict=True):
        for found, right in ((blocks.springs, expected.springs), (blocks.angles, expected.angles)):
            assert np.abs(found - right).max() <= ROUNDING * np.abs(right).max()
        assert np.array_equal(blocks.masses, expected.masses)


def test_a_spring_without_length_has_its_stiffness_in_all_directions() -> None:
    """df/dx = k 1 where its rest length is zero too: it is divided by 1 there, and its damper has no direction."""
    system = thrown(damping=3.0)
    by_position, by_velocity = blocks_by_loop(system, system.start)
    assert by_position.springs == pytest.approx(system.stiffness[0] * np.eye(2)[None], rel=1e-15)
    assert not by_velocity.springs.any()


def test_a_spring_without_length_that_should_have_one_has_no_derivative() -> None:
    """It has no direction, and so no number."""
    apart = np.array([[0.0, 0.0], [0.1, 0.0]])
    system = replace(thrown(damping=3.0), positions=apart, rest_lengths=np.array([0.1]))
    met = State(0.0, np.zeros((2, 2)), system.start.velocities)
    assert not np.isfinite(blocks_by_loop(system, met)[0].springs).any()
