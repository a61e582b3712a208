"""Deferred removal: parts of the page are hidden at once, and removed when nothing is on its way to them any more.

viser's page does what it is told in batches, and sets values last: one that comes in the same batch as the removal of
what it is for is an error in the browser's console.
"""

from __future__ import annotations

import time
from collections import deque
from typing import Any

#: By then the slowest browser has done what it was told before [s].
LATER = 60.0


class DeferredRemoval:
    """Parts that are hidden, and when they were, the first to be removed first."""

    def __init__(self) -> None:
        self._parts: deque[tuple[float, Any]] = deque()

    def hide(self, part: Any) -> None:
        """It is not to be seen any more, and nothing is told to it from now on."""
        part.visible = False
        self._parts.append((time.monotonic(), part))

    def remove_old(self) -> None:
        """Remove those that have been hidden long enough."""
        while self._parts and self._parts[0][0] < time.monotonic() - LATER:
            self._parts.popleft()[1].remove()
