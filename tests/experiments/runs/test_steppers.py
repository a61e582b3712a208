"""Which steppers are run where none is named."""

from __future__ import annotations

import pytest

from engines.process.isolation import EngineStepper
from engines.process.packages import APART
from experiments.runs.steppers import all_steppers, steppers_here


@pytest.mark.parametrize("made", [False, True])
def test_engines_of_environments_are_run_once_these_are_made(made: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """All others are always there: of an engine beside the lab it is told that it is missing."""
    monkeypatch.setattr(EngineStepper, "version", property(lambda stepper: "1.0" if made else None))
    every = all_steppers()
    apart = {name for name, s in every.items() if isinstance(s, EngineStepper) and s.engine.package in APART}
    assert apart
    assert set(steppers_here()) == (set(every) if made else set(every) - apart)
