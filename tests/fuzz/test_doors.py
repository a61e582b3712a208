"""Each door in small, and the runner: what it counts is what happened. `make soak` lets thousands through."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

import pytest

from tests.fuzz import runner
from tests.fuzz.__main__ import main
from tests.fuzz.doors import DOORS, Enter, door
from tests.fuzz.runner import inputs, run

#: Inputs of each door in the ordinary tests: some seconds of them.
FEW = {
    "live_message": 200,
    "scene_file": 200,
    "mesh_file": 200,
    "command_line": 60,
    "store": 30,
    "submission_reply": 200,
}


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", DOORS)
def test_wild_inputs_are_taken_or_refused_in_a_line(name: str, tmp_path: Path) -> None:
    """Nothing else happens; of files, rows and commands both do, or nothing would be shown."""
    report = run(name, FEW[name], 0, tmp_path)
    assert report.findings == {}
    assert report.endings["taken"] > 0.05 * FEW[name]
    assert name == "live_message" or report.endings["refused"] > 0.05 * FEW[name]


@pytest.mark.parametrize("name", DOORS)
def test_a_seed_always_makes_the_same(name: str) -> None:
    """And seeds differ."""
    first, again = list(map(repr, inputs(name, range(20)))), list(map(repr, inputs(name, range(20))))
    assert first == again
    assert len({*first}) > 15


def crash(_: Any) -> str:
    """As nothing should end."""
    raise ZeroDivisionError("by chance")


def hang(_: Any) -> str:
    """As nothing should go on."""
    while True:
        pass


def eat(_: Any) -> str:
    """More than anything should take."""
    held = bytearray(300 * 2**20)
    held[:: 2**12] = b"x" * len(held[:: 2**12])
    return "taken"


@pytest.mark.parametrize(
    ("enter", "said"),
    [
        (crash, "ZeroDivisionError: by chance"),
        (hang, "takes more than 0.2 s of the processor"),
        (eat, "MiB"),
        (lambda _: "a traceback", "a traceback"),
    ],
)
def test_what_must_not_happen_is_a_finding_with_its_seed(
    enter: Enter, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An exception, a hang, too much memory, what a door says itself; the others go on, and the exit code is 1."""
    fake = ModuleType("fake")

    @contextmanager
    def opened(_: Path) -> Iterator[Enter]:
        yield lambda made: enter(made) if made == 3 else "taken"

    make: Callable[[Random], int] = lambda random: 3 if random.random() == Random(7).random() else 0  # noqa: E731
    fake.make, fake.opened = make, opened  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "tests.fuzz.store", fake)
    monkeypatch.setattr(runner, "SECONDS", 0.2 if enter is hang else 60.0)
    monkeypatch.setattr(runner, "MEMORY", 200 * 2**20)
    report = run("store", 5, 5, tmp_path)
    assert [*report.findings] == [7]
    assert said in report.findings[7]
    assert report.endings == {"taken": 4}
    assert main(["--door", "store", "--count", "5", "--seed", "5"]) == 1
    assert "store: 4 taken, 0 refused, 1 findings" in capsys.readouterr().out
    assert main(["--door", "store", "--count", "2"]) == 0


def test_the_peak_of_memory_is_of_one_input() -> None:
    """What was held and given back is forgotten before the next."""
    if not Path("/proc/self/clear_refs").exists():
        pytest.skip("only Linux says how much was held")
    eat(None)
    high = runner.most_memory()
    runner.forget_most_memory()
    time.sleep(0)
    assert runner.most_memory() < high - 100 * 2**20


def test_every_door_is_one() -> None:
    """With what a door has."""
    for name in DOORS:
        assert callable(door(name).make)
        assert callable(door(name).opened)
