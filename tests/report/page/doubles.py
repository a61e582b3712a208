"""Experiments put in the place of others: with an answer ready, or failing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from experiments.experiment import Experiment, Result, find


def answering(name: str, result: Result) -> Experiment:
    """The experiment of that name, but it has its answer ready."""
    return replace(find(name), run=lambda _: result)


def failing(name: str, error: Exception) -> Experiment:
    """The experiment of that name, but it raises."""

    def run(_: Callable[[str], None]) -> Result:
        raise error

    return replace(find(name), run=run)


def put(patch: pytest.MonkeyPatch, *instead: Experiment) -> None:
    """Put experiments in the place of those of their names, and run them here: a new process would not know them."""
    patch.setattr("report.page.sections.isolated", lambda task, *arguments, **limits: task(*arguments))
    for experiment in instead:
        patch.setattr(f"experiments.{experiment.name}.EXPERIMENT", experiment)
