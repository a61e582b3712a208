"""What viewers move, heard in the order in which they moved it, and done later, between two frames.

viser calls plain functions from a pool of threads, in any order: a mass that was let go could be taken hold of once
more by a move before that. Coroutines it runs one after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

#: Has something done between two frames.
Later = Callable[[Callable[[], None]], None]


def heard(later: Later, action: Callable[[Any], None]) -> Callable[[Any], Coroutine[Any, Any, None]]:
    """What to give to viser for a button, a menu, a slider: the action is told what it was set to.

    What the page itself sets comes back, too, but from no viewer: that is no news.
    """

    async def hear(event: Any) -> None:
        if event.client is not None:
            value = event.target.value
            later(lambda: action(value))

    return hear
