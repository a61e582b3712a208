"""Events of viewers: handled in the order in which they happened, between two frames.

viser calls plain functions from a pool of threads, in any order: a mass that was let go could be taken hold of once
more by a movement before that. Coroutines it runs one after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

#: Has something done between two frames.
Later = Callable[[Callable[[], None]], None]


def handler(later: Later, action: Callable[[Any], None]) -> Callable[[Any], Coroutine[Any, Any, None]]:
    """What to give to viser for a button, a menu, a slider: the action is told what it was set to.

    What the page itself sets comes back, too, but from no viewer: that is no event of theirs.
    """

    async def handle(event: Any) -> None:
        if event.client is not None:
            value = event.target.value
            later(lambda: action(value))

    return handle
