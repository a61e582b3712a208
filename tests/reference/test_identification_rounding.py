"""Identification where the motion multiplies rounding: as much is allowed as the scheme itself makes of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.identification import (
    AMPLIFIED,
    TOLERANCE,
    Identification,
    identify_by_rounding,
)
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.identified import Recorded

#: By Euler with steps of 2 ms, which multiplies what it makes of rounding: by 200 steps 1e-10 m, by 300 more than 1e-7.
STRING, SLOW = find_scene("string").system({}), 2e-3


def by_rounding(stepper: Stepper, steps: int) -> Identification:
    """What a run on the default string is found to be, among Euler and Heun."""
    known = {name: catalogued()[name].run(STRING, SLOW, steps).trajectory for name in ("euler", "heun")}
    assert None not in known.values()
    outcome = stepper.run(STRING, SLOW, steps)
    return identify_by_rounding(stepper.name, outcome, STRING, known, SLOW, steps)  # type: ignore[arg-type]


def nudged_euler(steps: int) -> Recorded:
    """A run by Euler that begins with its masses an ulp or two aside."""
    return Recorded(SchemeStepper(find("euler")).run(nudged(STRING), SLOW, steps))


def test_what_the_motion_makes_of_rounding_is_allowed() -> None:
    """Over 1e-12 of the size, and yet Euler: its own step takes a push of rounding as far."""
    found = by_rounding(nudged_euler(200), 200)
    assert found.error > TOLERANCE * STRING.size
    assert found.identified_as == "euler"
    assert found.error <= found.tolerance <= AMPLIFIED * STRING.size


def test_what_is_more_than_rounding_is_not_allowed_where_rounding_is_multiplied_too() -> None:
    """Springs stronger by a part in 1e9 are multiplied alike, and stay beyond what rounding can be."""
    stranger = SchemeStepper(wrong.stepped(wrong.slightly_stronger, find("euler")))
    found = by_rounding(stranger, 200)
    assert found.ranking[0].scheme == "euler"
    assert found.identified_as is None


def test_where_nothing_is_left_of_the_motion_nothing_is_identified() -> None:
    """Rounding multiplied beyond 1e-9 of the size says nothing of a scheme."""
    found = by_rounding(nudged_euler(280), 280)
    assert found.error > AMPLIFIED * STRING.size
    assert found.identified_as is None


def nudged(system: MassSpringSystem) -> MassSpringSystem:
    """Its free masses an ulp or two of their positions aside."""
    aside = np.random.default_rng(1).uniform(-2e-16, 2e-16, system.positions.shape)
    return replace(system, positions=system.positions + np.where(system.fixed[:, None], 0.0, aside))
