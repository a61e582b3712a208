"""A throw-away copy of a project, in which one source file at a time has a mistake and some tests run."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Event

from reference.cache import cache_folder
from tests.mutants.collected_tests import CollectedTests
from tests.mutants.ending import MEMORY, OUT_OF_TIME, TestRun, ended
from tests.mutants.mutations import Mutant

ROOT = Path(__file__).parents[2]

#: What is not copied: nothing of it is a source or a test.
LEFT_OUT = (".git", ".venv*", "results", ".*_cache", ".hypothesis", "__pycache__")

#: What pytest ends with when all is well, and when there is no test.
PASSED, NO_TESTS = 0, 5


class ProjectCopy:
    """A copy of the project at `root` within a folder. Once `stop` is set, all runs in it end."""

    def __init__(self, root: Path, folder: Path, stop: Event) -> None:
        self._root, self._scratch, self._cache = folder / "project", folder / "scratch", folder / "cache"
        self._stop = stop
        self._collected: CollectedTests | None = None
        shutil.copytree(root, self._root, ignore=shutil.ignore_patterns(*LEFT_OUT))
        self._scratch.mkdir()
        # Kernels stand under the digest of their text, so that a mistake in a law or a loop is compiled anew: but not
        # into the user's own cache, which would keep it.
        shutil.copytree(cache_folder("kernels"), self._cache / "springlab" / "kernels")

    @contextmanager
    def mutated(self, mutant: Mutant) -> Iterator[None]:
        """With a mutant's mistake in its file, and no compiled file left of it, before or after."""
        file = self._root / mutant.file
        source = file.read_text(encoding="utf-8")
        try:
            self._write(file, mutant.applied(source))
            yield
        finally:
            self._write(file, source)

    def run(self, tests: Sequence[str], options: Sequence[str], limit: float) -> TestRun:
        """Some test files, in this order, until the first failure or until a process has used its limit [s].

        Raises:
            InterruptedError: once it is to stop.
        """
        if self._stop.is_set():
            raise InterruptedError("stopped")
        pytest = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:randomly", "-p", "no:cacheprovider"]
        limited = ["/bin/sh", "-c", f'ulimit -t {int(limit) + 1} && ulimit -d {MEMORY} && exec "$@"', "sh", *pytest]
        output = self._scratch / "output"
        with output.open("w") as file:
            process = subprocess.Popen(
                [*limited, "--hypothesis-seed=0", *options, *tests],
                cwd=self._root,
                env=self._environment(),
                stdout=file,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                start_new_session=True,
            )
            process.returncode, used = ended(process.pid, self._stop.is_set)
        shutil.rmtree(self._root / ".hypothesis", ignore_errors=True)
        said = "\n".join(output.read_text(errors="replace").splitlines()[-8:])
        passed = process.returncode in (PASSED, NO_TESTS)
        return TestRun(passed, process.returncode not in OUT_OF_TIME, used, said)

    def run_in_fork(self, tests: Sequence[str], mutant: Mutant | None, limit: float) -> TestRun | None:
        """Some tests, by name, in a process that has collected all, until the first failure; None where that cannot be.

        Args:
            tests: their names.
            mutant: what is changed for them, in its file and in memory.
            limit: what they may use of a processor [s].

        Raises:
            InterruptedError: once it is to stop.
        """
        if self._collected is None:
            self._collected = CollectedTests(self._root, self._environment(), self._scratch, self._stop)
        if mutant is None:
            return self._collected.run(tests, None, limit)
        file = self._root / mutant.file
        source = file.read_text(encoding="utf-8")
        with self.mutated(mutant):
            return self._collected.run(tests, (str(file), source, mutant.applied(source)), limit)

    def close(self) -> None:
        """End what runs in it."""
        if self._collected is not None:
            self._collected.close()

    def _write(self, file: Path, text: str) -> None:
        file.write_text(text, encoding="utf-8")
        Path(importlib.util.cache_from_source(str(file))).unlink(missing_ok=True)

    def _environment(self) -> dict[str, str]:
        """The copy's modules, cache and temporary files."""
        return {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(map(str, (self._root, self._root / "report" / "python", ROOT))),
            "XDG_CACHE_HOME": str(self._cache),
            "TMPDIR": str(self._scratch),
        }
