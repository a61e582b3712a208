"""Which tests call a function is written down, and a mutant of it is shown to these."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.mutants.calls import KEPT, ROOT, Calls, away, function_at, kept
from tests.mutants.mutations import mutants
from tests.mutants.test_mutants import SOURCE, project
from tests.mutants.verdicts import Judge

__all__ = ["project"]

NESTED = """
A = 1

class Spring:
    b = 2

    @property
    def force(self):
        def law(x):
            return [
                x for x in (1, 2)
            ]
        return law

try:
    def late():
        return 3
except NameError:
    pass
"""

#: Of which one notices a quotient in place of the product, and one does not.
FAR = """from reference.springs import force


def test_six():
    assert force(3.0, 2.0) == 6.0


def test_one():
    assert force(1.0, 1.0) == 1.0
"""


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("A = 1", ""),
        ("b = 2", ""),
        ("def force(self):", "Spring.force"),
        ("x for x in (1, 2)", "Spring.force.<locals>.law"),
        ("return law", "Spring.force"),
        ("return 3", "late"),
    ],
)
def test_the_function_at_a_line_is_the_innermost(line: str, name: str) -> None:
    """By its qualified name, as Python has it; a class's own lines are in none."""
    number = next(i for i, text in enumerate(NESTED.splitlines(), start=1) if text.strip() == line)
    assert function_at(NESTED, number) == name


def test_the_quickest_are_kept() -> None:
    """Of equally quick ones those that come first by name; of a file's own tests and of others as many."""
    tests = {f"tests/far/test_t.py::t{i:03}": 0.5 for i in range(2 * KEPT)} | {"tests/far/test_t.py::z": 0.1}
    own = {"tests/a/test_b.py::slow": 9.0, "tests/a/test_b_more.py::slow": 8.0, "tests/a/test_c.py::slow": 7.0}
    found = [name.partition("::")[2] for name in kept("a/b.py", tests | own)]
    assert found == ["z", *(f"t{i:03}" for i in range(KEPT - 1)), "slow", "slow", "slow"]


@pytest.mark.parametrize(
    ("test", "steps"),
    [("tests/a/test_b.py", 0), ("tests/a/test_b_more.py", 0), ("tests/a/test_c.py", 1), ("tests/test_b.py", 2)],
)
def test_tests_of_a_files_own_come_first(test: str, steps: int) -> None:
    """Those in files named after it, then those of its folder."""
    assert away("a/b.py", f"{test}::test_anything[a::b]") == steps
    calls = Calls({"a/b.py::f": {"tests/x/test_y.py::one": 0.1, f"{test}::two": 0.2}})
    (mutant, *_) = mutants("a/b.py", "def f(a, b):\n    return a + b\n")
    names = [name.partition("::")[2] for name, _ in calls.of(mutant, "def f(a, b):\n    return a + b\n")]
    assert names == (["two", "one"] if steps < 2 else ["one", "two"])


@pytest.mark.rotating(3, in_turn=True)
def test_what_tests_call_is_written_down(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By pytest itself, with the plug-in: bisection is called by its own test, and not by that of the springs' law."""
    law, bisection = "tests/reference/springs/test_linear_law.py", "tests/reference/test_bisection.py"
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    environment.pop("PYTEST_XDIST_WORKER", None)
    words = ["-q", "-p", "no:xdist", "-p", "no:cacheprovider", "-p", "tests.mutants.calls", "-x"]
    subprocess.run([sys.executable, "-m", "pytest", *words, law, bisection], env=environment, cwd=ROOT, check=True)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    calls = Calls.kept()
    called = calls.tests["reference/bisection.py::bisect"]
    assert {test.partition("::")[0] for test in called} == {bisection}
    source = (ROOT / "reference/bisection.py").read_text(encoding="utf-8")
    mutant = next(mutant for mutant in mutants("reference/bisection.py", source) if mutant.line > 10)
    assert dict(calls.of(mutant, source)) == called


@pytest.mark.rotating(3, in_turn=True)
def test_a_mutant_is_shown_to_those_that_call_it(project: Path) -> None:
    """What they do not notice is shown to the tests near; and a test that is no more judges nothing."""
    (project / "tests" / "reference" / "test_springs.py").write_text("def test_nothing():\n    pass\n")
    (project / "tests" / "test_far.py").write_text(FAR)
    quotient = next(m for m in mutants("reference/springs.py", SOURCE) if m.after == "return stiffness / stretch")
    for test, verdict in (("test_six", "killed"), ("test_one", "survived"), ("test_gone", "survived")):
        judge = Judge(project, Calls({"reference/springs.py::force": {f"tests/test_far.py::{test}": 0.1}}))
        assert judge.verdicts([quotient], 1, lambda *_: None) == [verdict], test
