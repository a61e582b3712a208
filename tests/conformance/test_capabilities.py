"""An engine does what it says it can, and refuses the rest by name."""

from __future__ import annotations

from functools import cache

import pytest

from engines.capability_cases import for_each_capability
from engines.engine import CAPABILITIES, Engine, demands, find
from reference.outcome import Outcome
from reference.stepper import catalogued
from tests.conformance.checks import check_capability, outcomes
from tests.conformance.strings import Case

CASES = {name: Case(name, system, 1e-3, 200) for name, system in for_each_capability().items()}


@cache
def runs(engine: str) -> dict[str, Outcome]:
    """How all cases end for an engine."""
    return dict(zip(CASES, outcomes(find(engine), list(CASES.values())), strict=True))


@pytest.mark.parametrize("capability", CASES)
def test_a_capability_is_kept_or_its_lack_is_said(engine: Engine, capability: str) -> None:
    """A system that asks for it is stepped as claimed, to 1e-12 of its size; or `unsupported` says what is lacking."""
    check_capability(engine, CASES[capability], runs(engine.name)[capability])


@pytest.mark.parametrize("capability", CAPABILITIES)
def test_there_is_a_system_that_asks_for_every_capability(capability: str) -> None:
    """And it asks for at most one other."""
    asked = demands(CASES[capability].system)
    assert capability in asked
    assert len(asked) <= 2


def test_an_engine_declares_known_capabilities_and_catalogued_schemes(engine: Engine) -> None:
    """Its claims cover the plain case and every kind of damping it can do."""
    assert engine.capabilities <= set(CAPABILITIES)
    assert set(engine.identified_as.values()) <= set(catalogued())
    assert set(engine.identified_as) == {"plain"} | ({"damping", "drag"} & engine.capabilities)


def test_an_engine_says_what_its_numbers_mean_and_what_was_chosen(engine: Engine) -> None:
    """Its semantics name stiffness, damping and drag; its settings are on record."""
    assert all(word in engine.semantics for word in ("stiffness", "damping", "drag"))
    assert engine.settings
