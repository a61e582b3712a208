"""The lecture's meshes in every engine: each that can take one steps it as the scheme that it claims to be."""

from __future__ import annotations

import pytest

from engines.engine import Engine
from reference.outcome import Outcome
from tests.conformance import doctored
from tests.conformance.case import Case
from tests.conformance.cases import SCENES
from tests.conformance.checks import claimed, identify_claimed, tolerance_of
from tests.conformance.doctored import Doctored
from tests.conformance.refusals import refused_as_expected
from tests.conformance.runs import outcome_of


def check_identified(engine: Engine, case: Case, outcome: Outcome) -> None:
    """The scheme that is claimed is followed to rounding, or nearest of the whole catalogue; to 1e-9 m and better.

    Over 200 steps rounding is 1e-14 m of a bridge, and distance constraints that hold one another lose more. Euler's
    scheme, which blows up, multiplies rounding by what it multiplies the motion.
    """
    assert outcome.ending == "done", f"{engine.name}, {case.name}: {outcome.ending}, {outcome.reason}"
    found = identify_claimed(engine, case, outcome)
    assert claimed(engine, case) in [match.scheme for match in found.matches or found.ranking[:1]], str(found)
    assert found.error < max(1e-9, tolerance_of(engine) * case.system.size)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scene", SCENES)
def test_scenes_are_stepped_as_by_a_known_scheme(engine: Engine, scene: str) -> None:
    """Or refused, as the table of refusals has it."""
    case = SCENES[scene]
    outcome = outcome_of(engine, case)
    if not refused_as_expected(engine, "scenes", case, outcome):
        check_identified(engine, case, outcome)


@pytest.mark.rotating(5)
@pytest.mark.parametrize("scene", SCENES)
def test_an_engine_with_slightly_stiffer_springs_is_seen(scene: str) -> None:
    """By a millionth; and the honest one passes."""
    case = SCENES[scene]
    honest, stranger = Doctored(doctored.KickDrift), Doctored(doctored.StifferByAMillionth)
    check_identified(honest, case, outcome_of(honest, case))
    with pytest.raises(AssertionError):
        check_identified(stranger, case, outcome_of(stranger, case))
