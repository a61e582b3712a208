"""The crash list: what breaks an engine breaks it in a process of its own, and has a name there."""

from __future__ import annotations

import pytest

from engines import crash_cases as module
from engines.crash_cases import FINE, NO_NUMBER, TIME_LIMIT, Breach, breaks, crash_list, ending, numbers
from engines.engine import installed_version, registry
from engines.process.isolation import isolated
from experiments.engine_versions import baseline
from reference.outcome import Outcome
from tests.engines.process import misbehaving

PACKAGES = sorted({engine.package for engine in registry().values()})
BREACHES = [breach for package in PACKAGES for breach in crash_list(package).values()]


@pytest.mark.parametrize("breach", BREACHES, ids=lambda breach: f"{breach.package}, {breach.name}")
def test_what_becomes_of_the_engine_is_as_in_the_baseline(breach: Breach) -> None:
    """In the version that is installed here."""
    version = installed_version(breach.package)
    if version is None:
        pytest.skip(f"{breach.package} is not installed")
    kept = baseline.read(breach.package).get(version)
    if kept is None:
        pytest.skip(f"{breach.package} {version} is not in the baseline")
    found = ending(isolated(breach.task, time_limit=TIME_LIMIT))
    assert found == kept[breach.package][f"crash list: {breach.name}"]


@pytest.mark.parametrize("breach", BREACHES, ids=lambda breach: f"{breach.package}, {breach.name}")
def test_every_way_is_told_in_a_sentence(breach: Breach) -> None:
    """It begins with a capital and ends with a full stop."""
    assert breach.summary[0].isupper()
    assert breach.summary.endswith(".")


def test_an_ending_is_the_signals_name_or_the_exception_or_what_was_answered() -> None:
    """Real ones, in processes of their own."""
    assert ending(isolated(misbehaving.segfault)) == "SIGSEGV"
    assert ending(isolated(misbehaving.abort)) == "SIGABRT"
    assert ending(isolated(misbehaving.hang, time_limit=1.0)) == "hangs"
    assert ending(isolated(misbehaving.divide)).startswith("refused: ZeroDivisionError: mass 3 is zero")
    assert ending(FINE) == FINE
    assert ending(Outcome("crashed", "ended with exit code 3 and no answer")) == "ended with exit code 3 and no answer"


def test_numbers_are_told_from_what_is_none() -> None:
    """NaN and infinity are no numbers."""
    assert numbers([0.0, 1e300]) == FINE
    assert numbers([0.0, float("nan")]) == numbers([float("inf")]) == NO_NUMBER


def test_any_file_can_enter_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """By package; a package that nobody knows to break has an empty list."""
    monkeypatch.setattr(module, "_LIST", {})

    @breaks("spring")
    def a_spring_too_far() -> str:
        """Pull."""
        return FINE

    assert list(crash_list("spring")) == ["a spring too far"]
    assert crash_list("spring")["a spring too far"].task is a_spring_too_far
    assert crash_list("rope") == {}
