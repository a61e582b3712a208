"""The crash cases: what breaks an engine breaks it in a process of its own, and has a name there."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from engines import crash_cases as module
from engines.crash_cases import FINE, NOT_FINITE, TIME_LIMIT, CrashCase, crash_case, crash_cases, ending, numbers
from engines.engine import installed_version, registry
from engines.process.isolation import isolated
from experiments.engine_versions import baseline
from reference.errors import InputError
from reference.outcome import Outcome
from tests.engines.process import misbehaving

PACKAGES = sorted({engine.package for engine in registry().values()})
CASES = [case for package in PACKAGES for case in crash_cases(package).values()]

#: So long one may be at it of which is known that it hangs [s]: `springlab versions --check` waits for it in full.
HANG = 2.0


@pytest.mark.rotating(8)
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.package}, {case.name}")
def test_what_becomes_of_the_engine_is_as_in_the_baseline(case: CrashCase) -> None:
    """In the version that is installed here."""
    version = installed_version(case.package)
    if version is None:
        pytest.skip(f"{case.package} is not installed")
    kept = baseline.read(case.package).get(version)
    if kept is None:
        pytest.skip(f"{case.package} {version} is not in the baseline")
    expected = kept[case.package][f"crash list: {case.name}"]
    time_limit = HANG if expected == "hangs" else TIME_LIMIT
    assert ending(isolated(case.function, time_limit=time_limit)) == expected


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.package}, {case.name}")
def test_every_way_is_told_in_a_sentence(case: CrashCase) -> None:
    """It begins with a capital and ends with a full stop."""
    assert case.summary[0].isupper()
    assert case.summary.endswith(".")


@pytest.mark.rotating(3)
def test_an_ending_is_the_signals_name_or_the_exception_or_what_was_answered() -> None:
    """Real ones, in processes of their own."""
    assert ending(isolated(misbehaving.segfault)) == "SIGSEGV"
    assert ending(isolated(misbehaving.abort)) == "SIGABRT"
    assert ending(isolated(misbehaving.hang, time_limit=1.0)) == "hangs"
    assert ending(isolated(misbehaving.divide)).startswith("refused: ZeroDivisionError: mass 3 is zero")
    assert ending(FINE) == FINE
    assert ending(Outcome("crashed", "ended with exit code 3 and no answer")) == "ended with exit code 3 and no answer"


def test_finite_numbers_are_told_from_others() -> None:
    """NaN and infinity are not finite."""
    assert numbers([0.0, 1e300]) == FINE
    assert numbers([0.0, float("nan")]) == numbers([float("inf")]) == NOT_FINITE


@pytest.fixture
def on_trial() -> Iterator[None]:
    """Cases may be entered: afterwards all is as it was before."""
    with module._CASES.as_it_is():
        yield


def a_spring_too_far() -> str:
    """Pull."""
    return FINE


@pytest.mark.usefixtures("on_trial")
def test_any_file_can_enter_its_own() -> None:
    """By package; a package that nobody has broken has none."""
    crash_case("spring")(a_spring_too_far)
    assert list(crash_cases("spring")) == ["a spring too far"]
    assert crash_cases("spring")["a spring too far"].function is a_spring_too_far
    assert crash_cases("rope") == {}


@pytest.mark.usefixtures("on_trial")
def test_a_name_that_is_taken_is_refused_within_a_package() -> None:
    """The first stays; another package may have the same name."""
    crash_case("spring")(a_spring_too_far)
    with pytest.raises(InputError, match=r"crash case 'spring: a spring too far' is taken by tests"):
        crash_case("spring")(a_spring_too_far)
    crash_case("rope")(a_spring_too_far)
    assert list(crash_cases("rope")) == ["a spring too far"]
