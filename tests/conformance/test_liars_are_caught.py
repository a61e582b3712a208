"""The suite's own checks, shown to pass an honest engine and to fail on every liar of `doctored`."""

from __future__ import annotations

from dataclasses import replace

import pytest

from engines.capability_cases import for_each_capability
from tests.conformance import doctored, test_default_string
from tests.conformance.case import Case
from tests.conformance.cases import CAPABILITIES, CHANGES, EACH
from tests.conformance.checks import check_capability, check_change, check_follows, check_state, looks
from tests.conformance.doctored import Doctored, KickDrift
from tests.conformance.runs import outcome_of, outcomes
from tests.conformance.strings import random_strings

HONEST = Doctored()

DEFAULT = test_default_string.CASES
TOO_LARGE_A_STEP = Case("too large a step", DEFAULT["plain"].system, 0.02, 200)


def follows(engine: Doctored, cases: list[Case]) -> None:
    """check_follows on all cases."""
    for case, outcome in zip(cases, outcomes(engine, cases), strict=True):
        check_follows(engine, case, outcome)


@pytest.mark.rotating(3, in_turn=True)
def test_the_honest_engine_follows_its_scheme_everywhere() -> None:
    """On the default string with and without damping and drag, at too large a step, and on all random strings."""
    follows(HONEST, [*DEFAULT.values(), TOO_LARGE_A_STEP, test_default_string.QUIET, *random_strings(on_rods=False)])


@pytest.mark.rotating(2)
@pytest.mark.parametrize(
    ("liar", "case"),
    [
        (doctored.Euler, DEFAULT["plain"]),
        (doctored.StifferByAMillionth, DEFAULT["plain"]),
        (doctored.StifferByAMillionth, DEFAULT["damping 0.5, drag 0.02"]),
        (doctored.ForgetsDrag, DEFAULT["drag 0.02"]),
        (doctored.ForgetsDrag, DEFAULT["damping 0.5, drag 0.02"]),
        (doctored.ResetsSilently, TOO_LARGE_A_STEP),
        (doctored.FallsAsleep, test_default_string.QUIET),
    ],
)
def test_identification_fails_on(liar: type[KickDrift], case: Case) -> None:
    """The check of the default string refuses the liar."""
    with pytest.raises(AssertionError):
        follows(Doctored(liar), [case])


@pytest.mark.parametrize("liar", [doctored.Euler, doctored.StifferByAMillionth, doctored.ForgetsDrag])
def test_the_random_strings_fail_on(liar: type[KickDrift]) -> None:
    """Not one string with drag is passed for an engine that lies about it, nor any at all for the other two."""
    cases = [case for case in random_strings(on_rods=False) if case.system.drag]
    for case, outcome in zip(cases, outcomes(Doctored(liar), cases), strict=True):
        with pytest.raises(AssertionError):
            check_follows(Doctored(liar), case, outcome)


@pytest.mark.rotating(3, in_turn=True)
def test_the_honest_engine_changes_on_the_fly_and_the_liar_is_caught() -> None:
    """The check of changes refuses an engine that ignores them, whatever the parameter."""
    for name, case in CHANGES.items():
        liar = Doctored(doctored.IgnoresChanges)
        check_change(HONEST, case, outcome_of(HONEST, case))
        with pytest.raises(AssertionError, match=name):
            check_change(liar, case, outcome_of(liar, case))


def test_an_engine_that_takes_one_number_for_each_as_one_for_all_is_caught() -> None:
    """Whatever the parameter; it passes where there is one number only."""
    liar = Doctored(doctored.ChangesAllAlike)
    for name in EACH:
        case = CHANGES[f"{name} of each"]
        with pytest.raises(AssertionError):
            check_change(liar, case, outcome_of(liar, case))
        plain = CHANGES[name]
        check_change(liar, plain, outcome_of(liar, plain))


def test_a_capability_an_engine_only_says_it_has_is_caught() -> None:
    """The check of capabilities passes the honest engine, and refuses one that gives all masses the same mass."""
    case = CAPABILITIES["masses"]
    for engine in (HONEST, replace(HONEST, capabilities=HONEST.capabilities - {"masses"})):
        check_capability(engine, case, outcome_of(engine, case))
    liar = Doctored(doctored.OneMassForAll)
    with pytest.raises(AssertionError):
        check_capability(liar, case, outcome_of(liar, case))


def test_a_lack_that_is_not_said_is_caught() -> None:
    """The check of capabilities refuses an engine that steps what it should refuse."""
    case = CAPABILITIES["damping"]
    engine = replace(HONEST, capabilities=HONEST.capabilities - {"damping"}, refuses=False)
    with pytest.raises(AssertionError, match="lacks"):
        check_capability(engine, case, outcome_of(engine, case))


def test_the_check_of_states_fails_on_views_and_on_a_wrong_start() -> None:
    """It passes the honest engine; it refuses one that hands out its memory, and one that starts at rest."""
    system = for_each_capability()["velocities"]
    check_state(system, *looks(HONEST, [system]))
    for liar in (doctored.HandsOutItsMemory, doctored.StartsAtRest):
        with pytest.raises(AssertionError):
            check_state(system, *looks(Doctored(liar), [system]))
