"""Parts of the page that go: hidden first, removed later."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from report.live.deferred_removal import LATER, DeferredRemoval


def test_what_goes_is_hidden_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """And removed once, when it has been for long enough."""
    clock, removed = [100.0], []
    monkeypatch.setattr("report.live.deferred_removal.time.monotonic", lambda: clock[0])
    part = SimpleNamespace(visible=True, remove=lambda: removed.append(clock[0]))
    removal = DeferredRemoval()
    removal.hide(part)
    assert not part.visible
    for clock[0] in (100.0, 99.9 + LATER, 100.1 + LATER, 200.0 + LATER):
        removal.remove_old()
    assert removed == [100.1 + LATER]
