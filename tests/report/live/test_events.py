"""Events of viewers without a browser: handled in their order."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from types import SimpleNamespace

from report.live.events import handler


def test_events_are_handled_in_their_order_with_the_value_of_then() -> None:
    """And what the page has set itself is not among them."""
    done: list[object] = []
    waiting: list[Callable[[], None]] = []
    hear = handler(waiting.append, done.append)
    target = SimpleNamespace(value=0)

    async def move() -> None:
        for value, client in ((1, "viewer"), (2, None), (3, "viewer")):
            target.value = value
            await hear(SimpleNamespace(client=client, target=target))

    asyncio.run(move())
    assert done == []
    for action in waiting:
        action()
    assert done == [1, 3]
