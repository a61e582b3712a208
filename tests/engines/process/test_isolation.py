"""Whatever a process does, its caller gets an outcome with its name, in time, and nothing else happens to it."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from engines.engine import find as find_engine
from engines.process import isolation
from engines.process.isolation import TIME_LIMIT, EngineStepper, first_step, isolated
from engines.process.packages import APART
from reference.outcome import Outcome
from reference.scenes import find
from tests.engines.process import misbehaving
from tests.engines.process.misbehaving import Misbehaving

STRING = find("string").system({"masses": 3})

#: [s], for what must hang; everything else ends long before its limit of 60 s.
PATIENCE = 0.3

#: Meshes that Bullet does not survive: a triangle with no area, one with a corner twice, one with a corner that is not
#: there.
NO_AREA = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"
CORNER_TWICE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n"
CORNER_NOWHERE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 100\n"

needs_bullet = pytest.mark.skipif(importlib.util.find_spec("pybullet") is None, reason="pybullet is not installed")


@pytest.mark.parametrize(
    ("task", "arguments", "reason"),
    [
        (misbehaving.segfault, (), "killed by SIGSEGV"),
        (misbehaving.abort, (), "killed by SIGABRT; it said: no iterations: cannot go on"),
        (misbehaving.leave, (0,), "ended with exit code 0 and no answer"),
        (misbehaving.leave, (3,), "ended with exit code 3 and no answer"),
        (misbehaving.exit_politely, (), "ended with exit code 0 and no answer"),
        (misbehaving.divide, (), "ZeroDivisionError: mass 3 is zero and cannot be divided by"),
        (misbehaving.die_in_mid_sentence, (), "killed by SIGKILL"),
        pytest.param(misbehaving.load_in_bullet, (NO_AREA,), "killed by SIGSEGV", marks=needs_bullet),
        pytest.param(misbehaving.load_in_bullet, (CORNER_TWICE,), "killed by SIGSEGV", marks=needs_bullet),
    ],
)
def test_a_crash_is_an_outcome_that_names_its_cause(
    task: Callable[..., Outcome], arguments: tuple[Any, ...], reason: str
) -> None:
    """In one line, without a trajectory."""
    outcome = isolated(task, *arguments)
    assert outcome.ending == "crashed"
    assert outcome.reason.startswith(reason)
    assert "\n" not in outcome.reason
    assert outcome.trajectory is None


def test_a_crash_is_noticed_though_a_child_of_the_process_lives_on() -> None:
    """The child holds the pipe open until the process is done with: waiting for the pipe alone would time out."""
    outcome = isolated(misbehaving.crash_and_leave_a_child)
    assert (outcome.ending, outcome.reason) == ("crashed", "killed by SIGABRT")


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize(
    ("task", "arguments"),
    [
        (misbehaving.hang, ()),
        (misbehaving.sleep, ()),
        pytest.param(misbehaving.load_in_bullet, (CORNER_NOWHERE,), marks=needs_bullet),
    ],
)
def test_a_hang_is_timed_out(task: Callable[..., Outcome], arguments: tuple[Any, ...]) -> None:
    """When the time limit is up, and it is named."""
    outcome = isolated(task, *arguments, time_limit=PATIENCE)
    assert (outcome.ending, outcome.reason) == ("timed out", "no answer within 0.3 s")


@pytest.mark.rotating(3, in_turn=True)
def test_a_process_that_shouts_is_heard_out() -> None:
    """20 MB of output neither block the process nor come back whole: the reason stays one short line."""
    assert isolated(misbehaving.shout, 0).ending == "done"
    outcome = isolated(misbehaving.shout, 4)
    assert outcome.ending == "crashed"
    assert outcome.reason.startswith("ended with exit code 4 and no answer; it said: words without end")
    assert len(outcome.reason) < 500


def test_an_answer_that_cannot_travel_is_a_crash() -> None:
    """The reason says what could not be pickled."""
    outcome = isolated(misbehaving.answer_what_no_pickle_can_hold)
    assert outcome.ending == "crashed"
    assert "pickle" in outcome.reason


def test_a_process_works_in_a_folder_of_its_own_that_is_removed(tmp_path: Path) -> None:
    """What an engine writes into its working folder (MuJoCo writes a log there) is nobody else's."""
    here = os.getcwd()
    outcome = isolated(misbehaving.leave_a_file)
    assert outcome.ending == "done"
    assert Path(outcome.reason) != Path(here)
    assert not Path(outcome.reason).exists()
    assert os.getcwd() == here


def test_a_crash_leaves_no_process_and_the_next_run_is_well() -> None:
    """After every kind of failure the next process still answers."""
    for task in (misbehaving.segfault, misbehaving.abort, misbehaving.exit_politely):
        assert isolated(task).ending == "crashed"
        assert isolated(misbehaving.fine) == Outcome("done")


@pytest.mark.parametrize(
    ("simulation", "ending", "reason"),
    [
        (misbehaving.Segfaults, "crashed", "killed by SIGSEGV"),
        (misbehaving.Hangs, "timed out", "no answer within 0.3 s"),
        (misbehaving.GoesToNan, "diverged", "the position of mass 2 is not a number at t = 0.003 s"),
        (misbehaving.Raises, "crashed", "ZeroDivisionError: mass 3 is zero"),
        (misbehaving.Still, "done", ""),
    ],
)
def test_an_engine_that_fails_is_a_stepper_with_that_outcome(
    simulation: type[misbehaving.Still], ending: str, reason: str
) -> None:
    """Nothing an engine does is raised."""
    limit = PATIENCE if ending == "timed out" else TIME_LIMIT
    outcome = EngineStepper(Misbehaving(simulation), limit).run(STRING, 1e-3, 10)
    assert outcome.ending == ending
    assert outcome.reason.startswith(reason)


def test_a_run_that_diverges_keeps_its_trajectory_up_to_there() -> None:
    """The start, two good steps, and the one that is not a number."""
    outcome = EngineStepper(Misbehaving(misbehaving.GoesToNan)).run(STRING, 1e-3, 10)
    assert outcome.trajectory is not None
    assert len(outcome.trajectory) == 4


@pytest.mark.rotating(3, in_turn=True)
def test_a_process_whose_numba_has_threads_leaves_nothing_to_complain_of() -> None:
    """Python names semaphores that are left behind, on standard error, when the program ends."""
    program = (
        "from tests.engines.process import used; from engines.process.isolation import isolated; "
        "print(isolated(used.start_threads))"
    )
    root = str(Path(__file__).parents[3])
    environment = {**os.environ, "PYTHONPATH": root}
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, env=environment, cwd=root)
    assert int(said.stdout) >= 1
    assert said.stderr == ""


def test_the_first_step_in_each_environment_has_a_limit_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """That of its package, as kernels compile: once in every environment, of other versions too; others have none."""
    asked: list[tuple[str, str, float]] = []

    class Supervisor:
        def __init__(self, python: Path | None) -> None:
            self.python = str(python)

        def run(self, function: Callable[..., Any], arguments: tuple[Any, ...], time_limit: float, _: float) -> float:
            asked.append((self.python, function.__name__, time_limit))
            return 0.0

    monkeypatch.setattr(isolation, "supervisor", Supervisor)
    monkeypatch.setattr(isolation, "_STARTED", set())
    newton, tendons = find_engine("newton_vbd"), find_engine("mujoco_tendons")
    for engine, python in ((newton, "1.7"), (newton, "1.7"), (newton, "1.8"), (tendons, "3.2")):
        isolated(misbehaving.leave, engine, python=Path(python))
    own = APART["newton"].start_up
    assert own > TIME_LIMIT
    runs = [(python, "leave", TIME_LIMIT) for python in ("1.7", "1.7", "1.8", "3.2")]
    started = [("1.7", first_step.__name__, own), ("1.8", first_step.__name__, own)]
    assert asked == [started[0], runs[0], runs[1], started[1], *runs[2:]]
