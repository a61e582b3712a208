"""Cloths on obstacles in every engine that takes them: contacts are not identified, but held against the reference."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import Engine
from reference.conserved import energy
from reference.outcome import Outcome
from tests.conformance import doctored
from tests.conformance.case import Case
from tests.conformance.cases import CLOTHS
from tests.conformance.doctored import Doctored
from tests.conformance.refusals import refused_as_expected
from tests.conformance.runs import expected, outcome_of


def check_as_the_reference(case: Case, outcome: Outcome) -> None:
    """How deep, what energy, what shape.

    A mass comes to an obstacle with 2 m/s at most, and is inside by 2 mm when a step finds it there. Energy is lost;
    gained is at most a hundredth of weight times size. Heights from the lowest mass to the highest are those of
    kick-drift to a tenth of the size: contacts differ in what they leave of a velocity, and cloth multiplies it. (On
    the sphere Bullet is 20 to 30 mm off, by the mesh, and MuJoCo 1 to 2; a cloth that falls through is 0.3 m off.)
    """
    system, reference = case.system, expected("kick_drift", case).trajectory
    assert reference is not None
    assert outcome.trajectory is not None, f"{case.name}: {outcome.ending}, {outcome.reason}"
    (obstacle,) = system.obstacles
    motion = outcome.trajectory
    assert obstacle.signed_distances(motion.positions)[0].min() > -2e-3
    energies = [energy(system, state) for state in motion.states()]
    assert max(energies) - energies[0] < 0.01 * system.masses.sum() * 9.81 * system.size
    heights, right = motion.positions[-1, :, 1], reference.positions[-1, :, 1]
    assert np.abs(np.sort(heights) - np.sort(right)).max() < system.size / 10


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", CLOTHS)
def test_a_cloth_on_an_obstacle_is_as_in_the_reference(engine: Engine, name: str) -> None:
    """Or refused, as the table of refusals has it."""
    case = CLOTHS[name]
    outcome = outcome_of(engine, case)
    if not refused_as_expected(engine, "cloths", case, outcome):
        check_as_the_reference(case, outcome)


@pytest.mark.parametrize("name", CLOTHS)
def test_the_check_passes_an_honest_engine_and_not_one_that_passes_through(name: str) -> None:
    """It is inside at once."""
    case = CLOTHS[name]
    check_as_the_reference(case, outcome_of(Doctored(), case))
    with pytest.raises(AssertionError):
        check_as_the_reference(case, outcome_of(Doctored(doctored.PassesThrough), case))
