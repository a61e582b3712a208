"""What tests of submissions share: time enough, however busy the machine is, and one class with bad files."""

from __future__ import annotations

from functools import partial

import pytest

from experiments.exercises.process import sandbox
from tests.experiments.exercises import here


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """A submission has an hour by the clock unless a test says otherwise; seconds of computing are limited as ever."""
    monkeypatch.setattr(sandbox, "Limits", partial(sandbox.Limits, wall_clock=3600.0))


@pytest.fixture
def trusted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs run in this process, for tests of what is made of their answers: much quicker than in the sandbox."""
    monkeypatch.setattr(sandbox, "run", here.run)
