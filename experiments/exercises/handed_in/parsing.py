"""Python's parser of texts, used by one thread at a time.

CPython 3.11 counts the depth of a syntax tree for all threads together: two that parse at once may end in an error.
"""

from __future__ import annotations

import ast
import threading

#: Held by whoever parses, or makes syntax trees.
PARSING = threading.RLock()


def parsed(source: str) -> ast.Module:
    """A text's syntax tree. Raises what `ast.parse` raises."""
    with PARSING:
        return ast.parse(source)
