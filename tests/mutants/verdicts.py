"""Whether the tests that call what a mutant changes, and those near it, notice it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from threading import Event
from typing import Literal

from tests.mutants.calls import Calls
from tests.mutants.ending import TestRun
from tests.mutants.mutations import Mutant
from tests.mutants.near import Imports, engines_of
from tests.mutants.project_copy import ProjectCopy

#: What is found of a mutant. Timed out counts as killed; not covered as survived.
Verdict = Literal["killed", "timed out", "survived", "not covered"]
MISSED: tuple[Verdict, ...] = ("survived", "not covered")

#: What all tests of a mutant take together at most; a file that takes longer judges none [s on a processor].
ALL = 45.0

#: A test file is given this many times what it takes without a mutant, and this much besides [s on a processor].
TIMES, BESIDES = 3.0, 20.0


@dataclass
class Judge:
    """Runs the tests near mutants, in a copy of the project for each worker.

    Attributes:
        root: of the project.
        calls: which tests call which of its functions, as far as that is known.
        failing: test files that fail without any mutant, with the end of what they print. They judge nothing.
    """

    root: Path
    calls: Calls = field(default_factory=Calls)
    failing: dict[str, str] = field(default_factory=dict)
    _runs: dict[tuple[str, tuple[str, ...]], TestRun] = field(default_factory=dict)

    def verdicts(
        self, mutants: Sequence[Mutant], workers: int, told: Callable[[Mutant, Verdict], None]
    ) -> list[Verdict]:
        """One for each mutant, told as they are found."""
        imports, stop = Imports(self.root), Event()
        with TemporaryDirectory(prefix="mutants-") as folder, ExitStack() as opened:
            Path(folder).chmod(0o755)  # students' programs are run by another user, and must reach theirs
            copies: SimpleQueue[ProjectCopy] = SimpleQueue()
            for i in range(workers):
                copies.put(opened.enter_context(closing(ProjectCopy(self.root, Path(folder) / str(i), stop))))

            def judged(mutant: Mutant) -> Verdict:
                copy = copies.get()
                try:
                    source = (self.root / mutant.file).read_text(encoding="utf-8")
                    verdict = self._by_calls(copy, mutant, self.calls.of(mutant, source))
                    if verdict in MISSED:
                        verdict = self._verdict(copy, mutant, imports.near(mutant.file), verdict)
                finally:
                    copies.put(copy)
                told(mutant, verdict)
                return verdict

            with ThreadPoolExecutor(workers) as pool:
                try:
                    return list(pool.map(judged, mutants))
                except BaseException:
                    stop.set()
                    pool.shutdown(cancel_futures=True)
                    raise

    def _by_calls(self, copy: ProjectCopy, mutant: Mutant, calling: Sequence[tuple[str, float]]) -> Verdict:
        """By tests that call the function, all at once; those that fail without the mutant judge none."""
        tests: list[str] = []
        left = ALL
        for test, seconds in calling:
            left -= seconds
            if left > 0:
                tests.append(test)
        limit = TIMES * (ALL - left) + BESIDES
        while tests:
            run = copy.run_in_fork(tests, mutant, limit) or self._cold(copy, mutant, tests, limit)
            if run.passed:
                return "survived"
            failed = [test for test in tests if _failed(test, run)] or tests
            without = copy.run_in_fork(failed, None, limit) or self._unmutated(copy, failed, ("--all-cases",))
            if without.passed:
                return "killed" if run.in_time else "timed out"
            self.failing |= dict.fromkeys(failed, without.said)
            tests = [test for test in tests if test not in failed]
        return "not covered"

    def _cold(self, copy: ProjectCopy, mutant: Mutant, tests: Sequence[str], limit: float) -> TestRun:
        """Tests in a process that imports everything anew."""
        with copy.mutated(mutant):
            return copy.run(tests, ("--all-cases",), limit)

    def _verdict(self, copy: ProjectCopy, mutant: Mutant, near: Sequence[str], verdict: Verdict) -> Verdict:
        """The nearest test first: what a test does without the mutant is asked only where it fails with it.

        Cases that take turns are all run: what kills a mutant kills it on every day.

        Args:
            verdict: of those before.
        """
        options = ("--all-cases", *(f"--engine={name}" for name in engines_of(mutant.file)))
        left = ALL
        for test in near:
            known = self._runs.get((test, options))
            if known is not None and not (known.passed and known.used <= left):
                continue
            with copy.mutated(mutant):
                run = copy.run([test], options, ALL if known is None else _limit(known))
            if not run.passed:
                run = self._fails_for_it(copy, mutant, test, options, run)
            if run is None:
                continue
            if not run.passed:
                return "killed" if run.in_time else "timed out"
            verdict, left = "survived", left - run.used
            if left <= 0:
                break
        return verdict

    def _fails_for_it(
        self, copy: ProjectCopy, mutant: Mutant, test: str, options: tuple[str, ...], run: TestRun
    ) -> TestRun | None:
        """The run of a test file if it tells of the mutant, again if it had too little time; None if it judges none."""
        without = self._unmutated(copy, [test], options)
        if not without.passed:
            return None
        if run.in_time or _limit(without) <= ALL:
            return run
        with copy.mutated(mutant):
            return copy.run([test], options, _limit(without))

    def _unmutated(self, copy: ProjectCopy, tests: Sequence[str], options: tuple[str, ...]) -> TestRun:
        """What comes of tests without any mutant: what takes long is tried again, as it may have compiled."""
        key = (" ".join(tests), options)
        if key not in self._runs:
            run = copy.run(tests, options, 3 * ALL)
            self._runs[key] = copy.run(tests, options, ALL) if run.passed and run.used > ALL else run
            if not run.passed and run.in_time:
                self.failing[key[0]] = run.said
        return self._runs[key]


def _failed(test: str, run: TestRun) -> bool:
    """Whether a run says of a test that it failed, or could not begin."""
    lines = run.said.splitlines()
    return any(f"{line} ".startswith((f"FAILED {test} ", f"ERROR {test} ")) for line in lines)


def _limit(without: TestRun) -> float:
    """How long a test file may take with a mutant, by what it takes without [s on a processor]."""
    return TIMES * without.used + BESIDES
