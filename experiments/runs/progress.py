"""How a long piece of work says what it is at."""

from __future__ import annotations

from collections.abc import Callable

#: Called with what is being done now.
Progress = Callable[[str], None]
