"""A process that has collected all tests of a project, and runs some of them in forks of itself.

To collect tests and import what they need takes ten times as long as most tests. In each fork the functions of one file
may be given the code that they have in another text of it. Started by `collected_tests`, which speaks to it by lines of
JSON: a request says which tests run, for how long, and with which file changed; the answer, which of them failed first.
"""

from __future__ import annotations

import gc
import json
import os
import resource
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from types import CodeType, FunctionType
from typing import Any

import pytest

from tests.mutants.ending import MEMORY, ended

#: What a fork ends with: all passed; one failed; no function could be given the code that was to be changed.
PASSED, FAILED, UNCHANGED, BROKEN = 0, 1, 2, 3


class ForkServer:
    """A plug-in of pytest: in place of running all tests, it answers requests until there are no more.

    Args:
        requests: where they come from.
        answers: where answers go to.
    """

    def __init__(self, requests: int, answers: int) -> None:
        self._requests, self._answers = os.fdopen(requests), os.fdopen(answers, "w", buffering=1)

    def pytest_configure(self) -> None:
        """The first example that fails is enough: nobody reads a simpler one."""
        import hypothesis  # pytest itself is to be the first

        phases = (hypothesis.Phase.explicit, hypothesis.Phase.generate)
        hypothesis.settings.register_profile("mutants", hypothesis.settings.default, phases=phases, database=None)
        hypothesis.settings.load_profile("mutants")

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Answer, one request after the other."""
        items = {item.nodeid: item for item in session.items}
        gc.unfreeze()  # so that the functions can be found
        self._say({"collected": len(items)})
        for line in self._requests:
            self._say(self._answer(session, items, json.loads(line)))
        return True

    def _say(self, answer: Mapping[str, object]) -> None:
        self._answers.write(json.dumps(answer) + "\n")

    def _answer(self, session: pytest.Session, items: Mapping[str, pytest.Item], request: Any) -> Mapping[str, object]:
        """Run what is asked for in a fork."""
        tests = [items[test] for test in request["tests"] if test in items]  # what was written down may be gone
        reading, writing = os.pipe()
        pid = os.fork()
        if not pid:
            status = BROKEN
            try:
                os.setsid()
                _limit(request["limit"])
                status = self._in_fork(session, tests, request["change"], writing)
            finally:
                os._exit(status)
        status, used = ended(pid, lambda: False)
        with suppress(ProcessLookupError):
            os.killpg(pid, signal.SIGKILL)  # what its tests have started
        failed = os.read(reading, 10_000).decode() if status == FAILED else ""
        os.close(reading)
        os.close(writing)
        return {"ended": status, "used": used, "failed": failed.splitlines()}

    def _in_fork(
        self, session: pytest.Session, items: Sequence[pytest.Item], change: Sequence[str] | None, writing: int
    ) -> int:
        """Run tests until one fails, whose name is written down."""
        if change is not None and not change_code(*change):
            return UNCHANGED
        before = session.testsfailed
        for item, following in zip(items, [*items[1:], None], strict=False):
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            if session.testsfailed > before:
                os.write(writing, f"{item.nodeid}\n".encode())
                return FAILED
        return PASSED


def change_code(file: str, before: str, after: str) -> bool:
    """Give all functions of a file the code that they have in another text of it. False where there is none to change.

    Args:
        file: its path, as its functions know it.
        before: the text they were compiled from.
        after: the text with a mistake.
    """
    changed = {}
    for old, new in zip(_codes(file, before), _codes(file, after), strict=False):
        if old != new and old.co_qualname == new.co_qualname:
            changed[old] = new
    found = [f for f in gc.get_objects() if isinstance(f, FunctionType) and f.__code__.co_filename == file]
    found = [function for function in found if function.__code__ in changed]
    for function in found:
        function.__code__ = changed[function.__code__]
    return bool(found)


def _codes(file: str, text: str) -> Iterator[CodeType]:
    """The codes of all functions of a text, those within others after them."""

    def within(code: CodeType) -> Iterator[CodeType]:
        for constant in code.co_consts:
            if isinstance(constant, CodeType):
                yield constant
                yield from within(constant)

    yield from within(compile(text, file, "exec"))


def _limit(seconds: float) -> None:
    """What a fork may use of a processor [s], and of memory."""
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
    resource.setrlimit(resource.RLIMIT_DATA, (1000 * MEMORY, 1000 * MEMORY))


def main(options: Sequence[str]) -> int:
    """Run pytest with this plug-in; what tests print goes where errors go, and they read nothing."""
    server = ForkServer(os.dup(0), os.dup(1))
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    return pytest.main([*options], plugins=[server])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
