"""One worker, task after task: what is said of a task that does not answer is that task's own doing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from engines.process.worker import NoAnswerError, Worker
from reference.outcome import Outcome
from tests.engines.process import misbehaving, used

#: [s], and [bytes]: nothing comes near.
LIMITS = 60.0, 4 * 2**30


@pytest.mark.parametrize(
    ("task", "arguments", "reason"),
    [
        (misbehaving.leave, (4,), "ended with exit code 4 and no answer"),
        (misbehaving.abort, (), "killed by SIGABRT; it said: no iterations: cannot go on"),
    ],
    ids=["silent", "with words"],
)
def test_the_last_words_are_those_of_the_task_that_failed(
    task: Callable[..., Any], arguments: tuple[Any, ...], reason: str
) -> None:
    """Not what an earlier task of the same process has printed."""
    worker = Worker()
    try:
        first = worker.do(used.say, ("all is well",), *LIMITS)
        assert worker.do(used.say, ("mass 3 is far away",), *LIMITS) == first
        with pytest.raises(NoAnswerError) as caught:
            worker.do(task, arguments, *LIMITS)
        assert caught.value.outcome == Outcome("crashed", reason)
        assert not caught.value.from_outside
    finally:
        worker.end()
