"""An engine does what it says it can, and refuses the rest by name."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import get_args

import pytest

from engines.engine import CAPABILITIES, LAWS, Engine, Precision, demands, precision, registry
from reference.stepper import stepper_named
from tests.conformance.cases import CAPABILITIES as CASES
from tests.conformance.checks import check_capability
from tests.conformance.refusals import refused_as_expected
from tests.conformance.runs import outcome_of


@pytest.mark.rotating(7)
@pytest.mark.parametrize("capability", CASES)
def test_a_capability_is_kept_or_its_lack_is_said(engine: Engine, capability: str) -> None:
    """A system that asks for it is stepped as claimed, to 1e-12 of its size; or `unsupported` says what is lacking."""
    case = CASES[capability]
    outcome = outcome_of(engine, case)
    check_capability(engine, case, outcome)
    refused_as_expected(engine, "capabilities", case, outcome)


@pytest.mark.parametrize("capability", CAPABILITIES)
def test_there_is_a_system_that_asks_for_every_capability(capability: str) -> None:
    """And it asks for at most one other, beside the plane."""
    asked = demands(CASES[capability].system)
    assert capability in asked
    assert len({*asked} - {"2d"}) <= 2


@pytest.mark.parametrize("law", LAWS)
def test_springs_that_are_not_linear_move_otherwise(law: str) -> None:
    """So an engine that steps them as if they were linear does not keep the capability."""
    case = CASES[law]
    linear = replace(case.system, nonlinear=None)
    runs = [stepper_named("kick_drift").run(s, case.dt, case.steps).trajectory for s in (case.system, linear)]
    assert runs[0] is not None
    assert runs[1] is not None
    assert runs[0].distance(runs[1]).max() > 1e-3


@pytest.mark.parametrize("kind", [*LAWS, "angular springs", "pulls", "no rest length", "collisions"])
def test_every_kind_of_spring_is_stepped_by_engines_of_two_packages(kind: str) -> None:
    """To rounding, which the tests above hold them to; the others refuse it."""
    assert len({engine.package for engine in registry().values() if kind in engine.capabilities}) >= 2


@pytest.mark.parametrize("declared", registry().values(), ids=lambda engine: engine.name)
def test_an_engine_declares_known_capabilities_and_catalogued_schemes(declared: Engine) -> None:
    """Its claims cover the plain case and every kind of damping it can do, each by the name the catalogue gives it.

    So a parameter is named where it is not as the scheme has it, and only there. Installed or not: nothing is run.
    """
    assert declared.capabilities <= set(CAPABILITIES)
    for claims in (declared.identified_as, *getattr(declared, "formerly", {}).values()):
        for claim in claims.values():
            assert stepper_named(claim).name == claim
        assert set(claims) == {"plain"} | ({"damping", "drag"} & declared.capabilities)


@pytest.mark.parametrize("declared", registry().values(), ids=lambda engine: engine.name)
def test_an_engine_says_what_its_numbers_mean_and_what_was_chosen(declared: Engine) -> None:
    """Its semantics name stiffness, damping and drag, in SI units; its settings are on record, and its precision."""
    assert all(word in declared.semantics for word in ("stiffness", "damping", "drag"))
    units = {"k": "N/m", "c": "N s/m", "Cd": "N s/m", "drag": "N s/m"}
    for name, unit in re.findall(r"(\w+) \[([^\]]+)\]", declared.semantics):
        assert unit == units[name]
    assert declared.settings
    assert precision(declared) in get_args(Precision)
