"""Which tests call which functions of the lab: a plug-in of pytest that writes it down, and what reads it.

    python -m pytest --all-cases --numprocesses auto --dist loadfile -p tests.mutants.calls

What a mutant changes is first shown to the tests of its own file that call the function it is in, then to others that
do, the quickest first. What runs in other processes, or is compiled, is not seen here; the tests near the file are for
that.
"""

from __future__ import annotations

import ast
import json
import os
import sys
import threading
from collections import defaultdict
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from types import CodeType, FrameType

import pytest

from reference.cache import cache_folder
from tests.mutants.mutations import Mutant

ROOT = Path(__file__).parents[2]
ROOMS = tuple(f"{ROOT / room}{os.sep}" for room in ("reference", "engines", "experiments", "report"))

#: So many quick tests of a function are kept of each process: of its file's own, of its folder's, and of others.
KEPT = 30

#: Tests, by name, with how long they take [s].
Tests = dict[str, float]


@dataclass
class Calls:
    """Who calls what.

    Attributes:
        tests: by file and the function's qualified name, those that call it.
    """

    tests: dict[str, Tests] = field(default_factory=dict)

    @classmethod
    def kept(cls) -> Calls:
        """What was written down last: nothing, if nothing was."""
        found: dict[str, Tests] = defaultdict(dict)
        for file in sorted(cache_folder("calls").glob("*.json")):
            for function, tests in json.loads(file.read_text(encoding="utf-8")).items():
                found[function] |= tests
        return cls(found)

    def of(self, mutant: Mutant, source: str) -> list[tuple[str, float]]:
        """Tests that call the function a mutant is in, or where it is in none, any of its file; its own first."""
        name = function_at(source, mutant.line)
        called = self.tests.get(f"{mutant.file}::{name}", {}) if name else self._of_file(mutant.file)
        return sorted(called.items(), key=lambda entry: (away(mutant.file, entry[0]), _quickness(entry)))

    def _of_file(self, file: str) -> Tests:
        found: Tests = {}
        for function, tests in self.tests.items():
            if function.partition("::")[0] == file:
                found |= tests
        return found


def kept(file: str, tests: Mapping[str, float]) -> Tests:
    """KEPT of the tests of a function in a file, the quickest: of the file's own, of its folder's, and of others."""
    groups: dict[int, list[tuple[str, float]]] = defaultdict(list)
    for test, seconds in sorted(tests.items(), key=_quickness):
        groups[away(file, test)].append((test, seconds))
    return dict(entry for group in groups.values() for entry in group[:KEPT])


def away(file: str, test: str) -> int:
    """How far a test is from a file: 0 in a test file named after it, 1 in the folder that mirrors its own, else 2."""
    source, tests = PurePosixPath(file), PurePosixPath(test.partition("::")[0])
    if tests.parent != "tests" / source.parent:
        return 2
    return 0 if tests.stem.startswith(f"test_{source.stem}") else 1


def _quickness(entry: tuple[str, float]) -> tuple[float, str]:
    return entry[1], entry[0]


def function_at(source: str, line: int) -> str:
    """The qualified name of the function or method that a line is in, the innermost; nothing for a line in none."""

    def within(body: Sequence[ast.AST], above: str) -> str:
        for node in body:
            if not isinstance(node, ast.stmt | ast.ExceptHandler | ast.match_case):
                continue
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.lineno <= line <= (node.end_lineno or 0):
                name = f"{above}{node.name}"
                is_class = isinstance(node, ast.ClassDef)
                return within(node.body, f"{name}." if is_class else f"{name}.<locals>.") or ("" if is_class else name)
            if found := within(list(ast.iter_child_nodes(node)), above):
                return found
        return ""

    return within(ast.parse(source).body, "")


class Recorder:
    """Follows the calls of a session's tests; at its end they are in the user's cache.

    Args:
        worker: the name of the process, for its file.
    """

    def __init__(self, worker: str) -> None:
        self._worker = worker
        self._seen: dict[int, CodeType] = {}
        self._calls: dict[str, Tests] = defaultdict(dict)
        self._ended: dict[str, tuple[bool, float]] = {}

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, object, object]:
        """One test with its fixtures."""
        self._seen.clear()
        threading.settrace(self._called)
        sys.settrace(self._called)
        try:
            return (yield)
        finally:
            sys.settrace(None)
            threading.settrace(None)  # type: ignore[arg-type]
            passed, seconds = self._ended.pop(item.nodeid, (False, 0.0))
            if passed:
                self._write_down(item.nodeid, seconds)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """How a part of a test ended."""
        passed, seconds = self._ended.get(report.nodeid, (True, 0.0))
        self._ended[report.nodeid] = passed and report.passed, seconds + report.duration

    def pytest_sessionfinish(self) -> None:
        """What was seen, into a file."""
        calls = {function: kept(function.partition("::")[0], tests) for function, tests in self._calls.items()}
        (cache_folder("calls") / f"{self._worker}.json").write_text(json.dumps(calls), encoding="utf-8")

    def _called(self, frame: FrameType, event: str, arg: object) -> None:
        """Python calls this with each function that begins."""
        code = frame.f_code
        self._seen[id(code)] = code

    def _write_down(self, test: str, seconds: float) -> None:
        for code in list(self._seen.values()):  # threads that a test has left go on
            if code.co_filename.startswith(ROOMS):
                file = Path(code.co_filename).relative_to(ROOT).as_posix()
                # what stands in brackets within a function is of that function
                name = code.co_qualname.partition(".<locals>.<")[0]
                self._calls[f"{file}::{name}"][test] = round(seconds, 3)


def pytest_configure(config: pytest.Config) -> None:
    """Follow the tests where they run: in the workers, where there are some."""
    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    if worker or not getattr(config.option, "numprocesses", None):
        config.pluginmanager.register(Recorder(worker or "alone"), "calls")
