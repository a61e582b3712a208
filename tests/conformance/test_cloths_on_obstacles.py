"""Cloths on obstacles in every engine that takes them: contacts are not identified, but held against the reference."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import Engine
from engines.process.isolation import EngineStepper
from reference.conserved import energy
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from tests.conformance import doctored
from tests.conformance.doctored import Doctored

DT, STEPS = 1e-3, 400

#: As large as they are shown, but of fewer masses: MuJoCo's implicit tendons take time with the cube of their number.
SCENES = {name: {"rows": 8, "columns": 8, "rest_length": 0.077} for name in ("falling_cloth", "tablecloth")}


def check_as_the_reference(name: str, outcome: Outcome) -> None:
    """How deep, what energy, what shape.

    A mass comes to an obstacle with 2 m/s at most, and is inside by 2 mm when a step finds it there. Energy is lost;
    gained is at most a hundredth of weight times size. Heights from the lowest mass to the highest are those of
    kick-drift to a tenth of the size: contacts differ in what they leave of a velocity, and cloth multiplies it. (On
    the sphere Bullet is 20 to 30 mm off, by the mesh, and MuJoCo 1 to 2; a cloth that falls through is 0.3 m off.)
    """
    system = find_scene(name).system(SCENES[name])
    assert outcome.trajectory is not None, outcome.reason
    (obstacle,) = system.obstacles
    motion = outcome.trajectory
    assert obstacle.signed_distances(motion.positions)[0].min() > -2e-3
    energies = [energy(system, state) for state in motion.states()]
    assert max(energies) - energies[0] < 0.01 * system.masses.sum() * 9.81 * system.size
    known = simulate(system, find("kick_drift"), DT, DT * STEPS).positions[-1, :, 1]
    assert np.abs(np.sort(motion.positions[-1, :, 1]) - np.sort(known)).max() < system.size / 10


@pytest.mark.parametrize("name", SCENES)
def test_a_cloth_on_an_obstacle_is_as_in_the_reference(engine: Engine, name: str) -> None:
    """Or the engine says that it cannot."""
    outcome = EngineStepper(engine).run(find_scene(name).system(SCENES[name]), DT, STEPS)
    if outcome.ending == "unsupported":
        assert outcome.reason
        return
    check_as_the_reference(name, outcome)


@pytest.mark.parametrize("name", SCENES)
def test_the_check_passes_an_honest_engine_and_not_one_that_passes_through(name: str) -> None:
    """It is inside at once."""
    system = find_scene(name).system(SCENES[name])
    check_as_the_reference(name, EngineStepper(Doctored()).run(system, DT, STEPS))
    with pytest.raises(AssertionError):
        check_as_the_reference(name, EngineStepper(Doctored(doctored.PassesThrough)).run(system, DT, STEPS))
