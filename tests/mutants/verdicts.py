"""Whether the tests near a mutant notice it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from threading import Event
from typing import Literal

from tests.mutants.mutations import Mutant
from tests.mutants.near import Imports, engines_of
from tests.mutants.project_copy import ProjectCopy, TestRun

#: What is found of a mutant. Timed out counts as killed; not covered as survived.
Verdict = Literal["killed", "timed out", "survived", "not covered"]

#: What the nearest tests take together that run first, and all that run at all [s on a processor].
FIRST, ALL = 8.0, 45.0

#: A mutant is given this many times what its tests take without it, and this much besides [s on a processor].
TIMES, BESIDES = 3.0, 20.0


@dataclass
class Judge:
    """Runs the tests near mutants, in a copy of the project for each worker.

    Attributes:
        root: of the project.
        failing: test files that fail without any mutant, with the end of what they print. They judge nothing.
    """

    root: Path
    failing: dict[str, str] = field(default_factory=dict)
    _runs: dict[tuple[str, tuple[str, ...]], TestRun] = field(default_factory=dict)

    def verdicts(
        self, mutants: Sequence[Mutant], workers: int, told: Callable[[Mutant, Verdict], None]
    ) -> list[Verdict]:
        """One for each mutant, told as they are found."""
        imports, stop = Imports(self.root), Event()
        with TemporaryDirectory(prefix="mutants-") as folder:
            copies: SimpleQueue[ProjectCopy] = SimpleQueue()
            for i in range(workers):
                copies.put(ProjectCopy(self.root, Path(folder) / str(i), stop))

            def judged(mutant: Mutant) -> Verdict:
                copy = copies.get()
                try:
                    verdict = self._verdict(copy, mutant, imports.near(mutant.file))
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

    def _verdict(self, copy: ProjectCopy, mutant: Mutant, near: Sequence[str]) -> Verdict:
        options = tuple(f"--engine={name}" for name in engines_of(mutant.file))
        verdict: Verdict = "not covered"
        for batch, used in self._batches(copy, near, options):
            with copy.mutated(mutant):
                run = copy.run(batch, options, TIMES * used + BESIDES)
            if not run.passed:
                return "killed" if run.in_time else "timed out"
            verdict = "survived"
        return verdict

    def _batches(
        self, copy: ProjectCopy, near: Sequence[str], options: tuple[str, ...]
    ) -> Iterator[tuple[list[str], float]]:
        """The nearest tests up to FIRST, then the others up to ALL; with what each batch takes [s]."""
        batch: list[str] = []
        used, total, limit = 0.0, 0.0, FIRST
        for test in near:
            run = self._unmutated(copy, test, options)
            if not run.passed or total + run.used > ALL:
                continue
            batch.append(test)
            used, total = used + run.used, total + run.used
            if total >= limit:
                yield batch, used
                batch, used, limit = [], 0.0, ALL
        if batch:
            yield batch, used

    def _unmutated(self, copy: ProjectCopy, test: str, options: tuple[str, ...]) -> TestRun:
        """What comes of a test file without any mutant: what takes long is tried again, as it may have compiled."""
        key = (test, options)
        if key not in self._runs:
            run = copy.run([test], options, 3 * ALL)
            self._runs[key] = copy.run([test], options, ALL) if run.passed and run.used > FIRST else run
            if not run.passed and run.in_time:
                self.failing[test] = run.said
        return self._runs[key]
