"""Tests that are collected once run in forks, each with the functions of one file as another text has them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from threading import Event

import pytest

from tests.mutants.project_copy import ProjectCopy
from tests.mutants.test_mutants import SOURCE, made, project

__all__ = ["project"]

FORCE, STEPS = (f"tests/reference/test_springs.py::test_{name}" for name in ("force", "steps"))

#: What tests of these functions may use of a processor [s].
LIMIT = 20.0


@pytest.fixture
def copy(project: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[ProjectCopy]:
    """Of the project of three functions."""
    with closing(ProjectCopy(project, tmp_path_factory.mktemp("copy"), Event())) as found:
        yield found


@pytest.mark.rotating(3, in_turn=True)
def test_what_is_changed_is_changed_in_one_fork_only(copy: ProjectCopy) -> None:
    """The first test that fails is named; and without the mistake, or one that it does not see, it passes again."""
    springs = made(SOURCE, "reference/springs.py")
    for after, failed in (("return stiffness / stretch", f"FAILED {FORCE}"), ("count = 1", "")):
        run = copy.run_in_fork([STEPS, FORCE], springs[after], LIMIT)
        assert run is not None
        assert (run.passed, run.in_time, run.said) == (not failed, True, failed)
        without = copy.run_in_fork([STEPS, FORCE], None, LIMIT)
        assert without is not None
        assert without.passed


@pytest.mark.rotating(3, in_turn=True)
def test_a_loop_without_end_ends_by_its_limit(copy: ProjectCopy) -> None:
    """After a second of a processor, whatever the clock says."""
    run = copy.run_in_fork([STEPS], made(SOURCE, "reference/springs.py")["count -= 1"], 1.0)
    assert run is not None
    assert (run.passed, run.in_time) == (False, False)


@pytest.mark.rotating(3, in_turn=True)
def test_what_no_function_holds_is_left_to_others(project: Path, copy: ProjectCopy) -> None:
    """A module's own lines have run already; and a test that is no more judges nothing."""
    (constant, *_) = made("answer = 6 * 7\n", "engines/alone.py").values()
    assert copy.run_in_fork([FORCE], constant, LIMIT) is None
    gone = copy.run_in_fork(["tests/test_gone.py::test_it"], None, LIMIT)
    assert gone is not None
    assert gone.passed
