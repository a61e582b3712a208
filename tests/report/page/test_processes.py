"""What sections' processes begin with, and when."""

from __future__ import annotations

import pytest

from engines.process.worker import FOR_SCHEMES
from report.page import processes


@pytest.mark.parametrize("at_once", [False, True])
def test_processes_begin_when_they_are_asked_for_or_at_once(at_once: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """With what schemes need and what draws."""
    done: list[object] = []
    monkeypatch.setattr(processes, "import_beforehand", lambda *names: done.append(names))
    monkeypatch.setattr(processes, "start_beforehand", lambda: done.append("started"))
    processes.prepare_processes(at_once)
    assert done[1:] == ["started"] * at_once
    assert {FOR_SCHEMES, "matplotlib.figure", "report.page.sections"} <= {*done[0]}  # type: ignore[misc]
    done.clear()
    processes.prepare_processes()
    assert len(done) == 1
