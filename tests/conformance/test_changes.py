"""Parameters that change on the fly change an engine's motion as they change its scheme's (lecture slide 12)."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import CAPABILITIES, Engine
from reference.system import PARAMETERS
from tests.conformance.case import Case
from tests.conformance.cases import CHANGES, EACH, VALUES
from tests.conformance.checks import check_change, require
from tests.conformance.runs import expected, outcome_of

#: What a change of each asks for, of capabilities.
ASKED = {
    "mass": ("masses",),
    "rest_length": ("rest_lengths",),
    "stiffness": ("stiffnesses",),
    "damping": ("damping", "dampings"),
    "gravity": ("tilted gravity",),
}


@pytest.mark.rotating(8)
@pytest.mark.parametrize("case", CHANGES)
def test_a_change_acts_as_in_the_scheme_or_is_refused_by_name(engine: Engine, case: str) -> None:
    """The distance max |x_engine - x_scheme| <= 1e-12 of the size, both with the same changes at the same steps."""
    check_change(engine, CHANGES[case], outcome_of(engine, CHANGES[case]))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", EACH)
def test_what_differs_on_the_fly_is_refused_just_where_a_capability_is_lacking(engine: Engine, name: str) -> None:
    """Where one is, its words are the reason. Else it may be refused all the same: a rigid link has no stiffness."""
    require(engine, "2d")
    outcome = outcome_of(engine, CHANGES[f"{name} of each"])
    lacking = [asked for asked in ASKED[name] if asked not in engine.capabilities]
    assert any(CAPABILITIES[asked] in outcome.reason for asked in ASKED[name]) == bool(lacking), outcome.reason
    assert outcome.ending in (("unsupported",) if lacking else ("done", "diverged", "unsupported"))


def test_every_parameter_is_changed() -> None:
    """No parameter of the reference is left out here."""
    assert set(VALUES) == set(PARAMETERS)


def test_every_change_is_felt() -> None:
    """With every change the scheme's trajectory moves by more than a micrometre: to ignore one would show."""
    for name in (*VALUES, *(f"{name} of each" for name in EACH)):
        case = CHANGES[name]
        changed = expected("kick_drift", case).trajectory
        plain = expected("kick_drift", Case("plain", case.system, case.dt, case.steps)).trajectory
        assert changed is not None
        assert plain is not None
        assert 1e-6 < changed.distance(plain).max() < np.inf
