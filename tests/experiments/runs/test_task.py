"""A task's key says everything that decides its result, and nothing else."""

from __future__ import annotations

import importlib.util
import math
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from functools import partial
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from engines.engine import registry
from engines.process.isolation import run_engine
from engines.pymunk.springs import PymunkSprings
from experiments.runs import task as task_module
from experiments.runs.task import Task, digest
from reference.changes import Change
from reference.collisions.round_masses import Collisions
from reference.obstacles import Circle
from reference.springs.angular import AngularSprings
from reference.springs.kinds import NonlinearSprings
from tests.experiments.runs import tasks
from tests.experiments.runs.tasks import STRING, numbered, stepped
from tests.reference.systems import property_test
from tests.report.commands.terminal import python

#: Any number, NaN and infinity among them, and any word.
scalars = st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary()
things = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3)
)

CHANGES = (Change(0.1, "drag", 0.05), Change(0.2, "gravity", 1.6))


@dataclass(frozen=True)
class Pair:
    """A dataclass."""

    a: Any
    b: Any


@dataclass(frozen=True)
class Twin:
    """Another dataclass with the same fields."""

    a: Any
    b: Any


def run_task(**changed: Any) -> Task:
    """A task of an engine; with something changed."""
    arguments = {"engine": PymunkSprings(), "system": STRING, "dt": 1e-3, "steps": 10, "changes": CHANGES} | changed
    return Task(stepped, tuple(arguments.values()))


def other(value: Any) -> Any:
    """A value that differs from another in one place, as little as can be."""
    if isinstance(value, np.ndarray) and value.dtype == bool:
        return np.concatenate([value[:-1], ~value[-1:]])
    if isinstance(value, np.ndarray) and value.dtype.kind == "i":
        return value[:, ::-1]
    if isinstance(value, np.ndarray):
        changed = value.copy()
        changed.flat[-1] = np.nextafter(changed.flat[-1], np.inf)
        return changed
    if isinstance(value, tuple):
        return (*value, Circle((0.0, -9.0), 0.1))
    return math.nextafter(value, math.inf)


# --- Digests ---


@property_test
@given(things, things)
def test_what_differs_has_another_digest(one: Any, another: Any) -> None:
    """And what does not has the same: `repr` tells kinds, order, NaN and signs of zero apart."""
    assert (digest(one) == digest(another)) == (canonical(one) == canonical(another))


def canonical(thing: Any) -> str:
    """What tells things apart: as they are written, mappings in the order of their keys."""
    if isinstance(thing, dict):
        return "{" + ", ".join(f"{key!r}: {canonical(thing[key])}" for key in sorted(thing)) + "}"
    if isinstance(thing, list):
        return "[" + ", ".join(map(canonical, thing)) + "]"
    return repr(thing)


LOOK_ALIKES = [
    ([1, [2]], [[1], 2]),
    ([[], []], [[[]]]),
    (["ab", "c"], ["a", "bc"]),
    ("1", 1),
    (1, 1.0),
    (1, True),
    (0.0, -0.0),
    ("", None),
    ("None", None),
    (b"ab", [97, 98]),
    (b"ab", "ab"),
    ({"a": 1}, ["mapping", ("a", 1)]),
    ({"a": 1}, [("a", 1)]),
    ({"a": 1, "b": 2}, {"a": 2, "b": 1}),
    ({1: 0}, {"1": 0}),
    ({1, 2}, ["set", 1, 2]),
    ({1, 2}, [1, 2]),
    (Pair(1, 2), Twin(1, 2)),
    (Pair(1, 2), Pair(2, 1)),
    (Pair(1, 2), {"a": 1, "b": 2}),
    (np.zeros(3), np.zeros(3, np.float32)),
    (np.zeros(3), np.zeros((3, 1))),
    (np.zeros((2, 3)), np.zeros((3, 2))),
    (np.zeros(1), -np.zeros(1)),
    (np.zeros(2, "<i8"), np.zeros(2, ">i8")),
    (np.zeros(2), [0.0, 0.0]),
    (np.zeros(()), 0.0),
    (stepped, numbered),
    (stepped, f"{stepped.__module__}.{stepped.__qualname__}"),
    (Pair, Twin),
]


@pytest.mark.parametrize(("one", "another"), LOOK_ALIKES)
def test_look_alikes_are_told_apart(one: Any, another: Any) -> None:
    """Shown for each on its own and within a collection."""
    assert digest(one) != digest(another)
    assert digest([one], 1) != digest([another], 1)


def test_partial_functions_are_told_apart_by_what_they_are_of() -> None:
    """By function, arguments and keywords."""
    made = [partial(stepped, 1), partial(numbered, 1), partial(numbered, 2), partial(numbered, number=1), numbered]
    assert len({digest(function) for function in made}) == len(made)


SAME = [
    ([1, 2], (1, 2)),
    ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
    ({1: "x", "1": "y"}, {"1": "y", 1: "x"}),
    ({"a", "b", "c"}, frozenset(["c", "a", "b"])),
    (np.float64(0.1), 0.1),
    (np.int64(3), 3),
    (np.arange(6.0).reshape(2, 3), np.asfortranarray(np.arange(6.0).reshape(2, 3))),
    (np.arange(3.0), np.arange(6.0)[::2] / 2),
    (math.nan, float("nan")),
    (STRING, replace(STRING)),
]


@pytest.mark.parametrize(("one", "another"), SAME)
def test_what_is_the_same_has_the_same_digest(one: Any, another: Any) -> None:
    """Whatever order, memory layout or kind of sequence it comes in."""
    assert digest(one) == digest(another)


REFUSED = [
    object(),
    1j,
    iter([1]),
    [1, {"a": object()}],
    Path("here"),
    lambda: 1,
    math.sin,
    STRING.with_parameter,
    np.array([object()]),
    np.array(["2026"], "M8[D]"),
    np.zeros(2, [("a", float)]),
    np.longdouble(1),
    np.zeros(2, np.longdouble),
]


@pytest.mark.parametrize("thing", REFUSED, ids=lambda thing: type(thing).__name__)
def test_what_has_no_digest_is_refused(thing: Any) -> None:
    """Rather than given one that does not say all there is to it."""
    with pytest.raises(TypeError, match="has no digest"):
        digest(thing)


def test_a_function_made_inside_another_is_refused() -> None:
    """Others have the same name."""

    def make(value: int) -> Callable[[], int]:
        def made() -> int:
            return value

        return made

    with pytest.raises(TypeError, match="expected a function or class of a module"):
        digest(make(1))


# --- Keys ---


CHILD = """
from tests.experiments.runs.test_task import run_task
print(run_task().key, run_task().question)
"""


@pytest.mark.rotating(3)
def test_equal_tasks_have_equal_keys_in_every_process(tmp_path: Path) -> None:
    """Though every Python shuffles its sets anew: a set within the engine's capabilities is among what is digested."""
    asked = run_task()
    for _ in range(2):
        said = python("-c", CHILD, folder=tmp_path)
        assert said.out.split() == [asked.key, asked.question], said.err


#: What a plain string has none of.
GIVEN = {
    "nonlinear": NonlinearSprings(hardening=np.array([1.0])),
    "collisions": Collisions(np.array([1e-3])),
    "angular_springs": AngularSprings(np.array([[0, 1, 2]]), np.array([1.0])),
}

CHANGED = {
    **{
        f"system.{f.name}": {"system": replace(STRING, **{f.name: GIVEN.get(f.name) or other(getattr(STRING, f.name))})}
        for f in fields(STRING)
    },
    "dt": {"dt": math.nextafter(1e-3, 1)},
    "steps": {"steps": 11},
    "no changes": {"changes": ()},
    "changes in another order": {"changes": CHANGES[::-1]},
    **{
        f"change.{name}": {"changes": (replace(CHANGES[0], **{name: value}), CHANGES[1])}
        for name, value in (("time", 0.3), ("parameter", "stiffness"), ("value", 0.06))
    },
    "engine": {"engine": registry()["mujoco_tendons"]},
    "engine's settings": {"engine": PymunkSprings(rounds=3)},
}


@pytest.mark.parametrize("what", CHANGED)
def test_whatever_decides_the_result_changes_the_key(what: str) -> None:
    """Every field of the system by its last bit; dt by its last bit; and the question with it."""
    changed = run_task(**CHANGED[what])
    assert changed.key != run_task().key
    assert changed.question != run_task().question


def test_the_function_changes_the_key() -> None:
    """The same arguments for another function are another question."""
    assert Task(run_engine, run_task().arguments).question != run_task().question


def test_the_engines_version_changes_the_key(monkeypatch: pytest.MonkeyPatch) -> None:
    """And the question: another version is another subject."""
    before = run_task()
    keys = before.key, before.question
    monkeypatch.setattr(task_module, "version", lambda engine: "999.0")
    assert run_task().key != keys[0]
    assert run_task().question != keys[1]
    assert run_task().labels["version"] == "999.0"


@pytest.mark.parametrize("package", task_module.COMPUTES_WITH)
def test_the_version_of_what_the_reference_computes_with_changes_the_key(
    monkeypatch: pytest.MonkeyPatch, package: str
) -> None:
    """But not the question: a newer answer to it takes the older one's place."""
    before = run_task()
    keys = before.key, before.question
    told = metadata.version
    monkeypatch.setattr(task_module.metadata, "version", lambda name: "999.0" if name == package else told(name))
    task_module._computer.cache_clear()
    try:
        assert run_task().key != keys[0]
        assert run_task().question == keys[1]
    finally:
        task_module._computer.cache_clear()


@pytest.fixture
def afresh() -> Iterator[Callable[[], None]]:
    """Forgets the digests of sources, which are otherwise read once."""
    task_module._sources.cache_clear()
    yield task_module._sources.cache_clear
    task_module._sources.cache_clear()


@pytest.mark.parametrize("room", ["reference", "engines"])
def test_the_sources_change_the_key(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, afresh: Callable[[], None], room: str
) -> None:
    """One character in any file of the rooms that compute; not the question."""
    folder = Path(getattr(task_module, room).__path__[0])
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
    before = run_task().key
    monkeypatch.setattr(task_module, room, SimpleNamespace(__path__=[str(tmp_path)]))
    afresh()
    assert run_task().key == before
    with max(tmp_path.rglob("*.py")).open("a") as file:
        file.write("#")
    afresh()
    assert run_task().key != before


def test_the_source_of_the_function_changes_the_key(tmp_path: Path, afresh: Callable[[], None]) -> None:
    """Wherever it is written."""
    file = tmp_path / "student.py"
    file.write_text("def function(number):\n    return number\n")
    specification = importlib.util.spec_from_file_location("student", file)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    before = Task(module.function, (1,))
    keys = before.key, before.question
    file.write_text("def function(number):\n    return 2 * number\n")
    afresh()
    after = Task(module.function, (1,))
    assert (after.key != keys[0], after.question == keys[1]) == (True, True)


def test_limits_and_names_for_people_do_not_change_the_key() -> None:
    """They do not decide what a run that comes to its end leaves."""
    before = run_task()
    after = Task(stepped, before.arguments, {"scene": "string"}, time_limit=1.0, memory_limit=2.0)
    assert (after.key, after.question) == (before.key, before.question)


# --- Labels ---


def test_labels_say_what_a_task_is_about() -> None:
    """Engine, version, settings, system, dt and steps come from the arguments, by their names."""
    labels = replace(run_task(), parameters={"masses": 3.0}).labels
    assert labels == {
        "task": "stepped",
        "stepper": "pymunk_springs",
        "version": run_task().labels["version"],
        "settings": {**PymunkSprings().settings, "precision": "double"},
        "system": digest(STRING)[:12],
        "parameters": {"masses": 3.0},
        "dt": 1e-3,
        "steps": 10,
    }


def test_labels_of_a_task_about_something_else_are_none() -> None:
    """But its function has a name."""
    assert {name for name, value in tasks.task().labels.items() if value is not None} == {"task", "parameters"}


def test_labels_are_of_one_run() -> None:
    """A function that makes many runs, each with its own steps, has no number of them."""
    assert run_task(steps=[10, 20]).labels["steps"] is None


def test_labels_are_numbers_that_a_store_can_hold() -> None:
    """NumPy's numbers become Python's, with every bit."""
    labels = run_task(dt=np.float64(0.1), steps=np.int64(7)).labels
    assert (type(labels["dt"]), labels["dt"], type(labels["steps"]), labels["steps"]) == (float, 0.1, int, 7)
