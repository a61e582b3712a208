"""The tests of a project, collected once: a process (`fork_server`) that is asked to run some of them."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from threading import Event
from typing import IO, Any

from tests.mutants.ending import OUT_OF_TIME, TestRun
from tests.mutants.fork_server import BROKEN, PASSED, UNCHANGED

#: How pytest is to run: as for mutants elsewhere, and without what a fork cannot share.
OPTIONS = ("-q", "-s", "--tb=no", "--all-cases", "--hypothesis-seed=0")
OPTIONS += ("-p", "no:randomly", "-p", "no:xdist", "-p", "no:cacheprovider")


class CollectedTests:
    """A server's process, from its first request on.

    Args:
        root: of the project.
        environment: of the process.
        scratch: a folder for what tests write.
        stop: once it is set, all ends.
    """

    def __init__(self, root: Path, environment: Mapping[str, str], scratch: Path, stop: Event) -> None:
        self._stop = stop
        self._printed = scratch / "collected"
        with self._printed.open("w") as printed:
            self._process = self._started(root, environment, scratch, printed)
        if self._answer() is None:  # else all is imported: files may change from now on
            print(f"Slow, as tests cannot be collected once for all:\n{self._printed.read_text()}", file=sys.stderr)

    def _started(
        self, root: Path, environment: Mapping[str, str], scratch: Path, printed: IO[str]
    ) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-m", "tests.mutants.fork_server", *OPTIONS, f"--basetemp={scratch / 'forked'}"],
            cwd=root,
            env=dict(environment),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=printed,
            text=True,
            start_new_session=True,
        )

    def run(self, tests: Sequence[str], change: tuple[str, str, str] | None, limit: float) -> TestRun | None:
        """Tests in this order, until the first failure or until they have used their limit.

        Args:
            tests: by name.
            change: a file, its text, and another that its functions take their code from; None for no change.
            limit: of what they use of a processor [s].

        Returns:
            None where no function is changed, as of what a module does when it is imported.

        Raises:
            InterruptedError: once it is to stop.
        """
        answer = self._asked({"tests": list(tests), "change": change, "limit": limit})
        if answer is None or answer["ended"] in (UNCHANGED, BROKEN):
            return None
        said = "\n".join(f"FAILED {test}" for test in answer["failed"])
        return TestRun(answer["ended"] == PASSED, answer["ended"] not in OUT_OF_TIME, answer["used"], said)

    def close(self) -> None:
        """End it."""
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with suppress(BrokenPipeError):
                    pipe.close()

    def _asked(self, request: Mapping[str, Any]) -> Any:
        """The answer to a request."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(request) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            return None
        return self._answer()

    def _answer(self) -> Any:
        """What the process says next; None where it has ended, as when tests cannot be collected."""
        assert self._process.stdout is not None
        while not select.select([self._process.stdout], [], [], 0.1)[0]:
            if self._stop.is_set():
                raise InterruptedError("stopped")
        line = self._process.stdout.readline()
        return json.loads(line) if line else None
