"""Which steppers are run where none is named."""

from __future__ import annotations

import pytest

from engines.process.isolation import EngineStepper
from engines.process.packages import APART
from experiments.runs.steppers import all_steppers, installed_engines, steppers_here


@pytest.mark.parametrize("made", [False, True])
def test_engines_of_environments_are_run_once_these_are_made(made: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """All others are always there: of an engine beside the lab it is told that it is missing."""
    monkeypatch.setattr(EngineStepper, "version", property(lambda stepper: "1.0" if made else None))
    every = all_steppers()
    apart = {name for name, s in every.items() if isinstance(s, EngineStepper) and s.engine.package in APART}
    assert apart
    assert set(steppers_here()) == (set(every) if made else set(every) - apart)


def test_engines_that_are_here_are_those_that_have_a_version(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whichever are installed: these in their order, no others and no schemes."""
    engines = [s.name for s in all_steppers().values() if isinstance(s, EngineStepper)]
    here = engines[1::2]
    monkeypatch.setattr(EngineStepper, "version", property(lambda stepper: "1.0" if stepper.name in here else None))
    assert [stepper.name for stepper in installed_engines()] == here
