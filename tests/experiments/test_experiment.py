"""The registry of experiments: each under its own name, in the order they are shown; a taken name is refused."""

from __future__ import annotations

from dataclasses import replace

import pytest

from experiments import order
from experiments.experiment import NAMES, experiments, find
from reference.errors import InputError


def test_experiments_are_in_the_order_of_their_names() -> None:
    """And each is called what its module is."""
    assert [*experiments()] == [*NAMES]
    assert [experiment.name for experiment in experiments().values()] == [*NAMES]


def test_a_name_that_is_taken_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one line, with the module that has it: the second would hide the first."""
    monkeypatch.setattr(order, "EXPERIMENT", replace(order.EXPERIMENT, name="maps"))
    with pytest.raises(InputError, match=r"experiment 'maps' is taken by experiments\.maps: expected another name"):
        experiments()


def test_an_unknown_name_is_refused_with_a_suggestion() -> None:
    """As for every unknown name."""
    with pytest.raises(InputError, match=r"unknown experiment 'ordr': did you mean 'order'\?"):
        find("ordr")
