"""What is wrong with the contents of a file, in people's words: the validator's messages are a programmer's."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, get_args, get_type_hints

import msgspec

from reference.errors import unknown_name

#: The validator's names of types, and people's.
WORDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "array": "a list",
    "object": "a table",
    "bool": "true or false",
}


def plain(message: str, root: type[msgspec.Struct]) -> str:
    """The validator's message as ours are: key path first, types in words, a suggestion for an unknown key.

    >>> class File(msgspec.Struct):
    ...     stiffness: float
    >>> plain("Object contains unknown field `stifness`", File)
    "unknown key 'stifness': did you mean 'stiffness'?"
    >>> plain("Expected `float | null`, got `str` - at `$.dt`", File)
    'dt: expected a number, got text'
    >>> plain("Object missing required field `stiffness` - at `$.system`", File)
    'system.stiffness is missing'

    Args:
        root: what the file as a whole is read as.
    """
    what, _, where = message.partition(" - at `$")
    path = where.rstrip("`").removeprefix(".")
    unknown = re.fullmatch(r"Object contains unknown field `(.*)`", what)
    missing = re.fullmatch(r"Object missing required field `(.*)`", what)
    table = _table(root, path)
    if missing:
        return f"{path}.{missing[1]} is missing" if path else f"{missing[1]} is missing"
    if unknown and table is not None:
        what = str(unknown_name("key", unknown[1], table.__struct_fields__))
    else:
        what = re.sub(r"(?<=ected |, got )`([a-z| ]+)`", lambda types: _in_words(types[1]), what[0].lower() + what[1:])
    return f"{path}: {what}" if path else what


def _in_words(types: str) -> str:
    return " or ".join(WORDS.get(name, name) for name in types.split(" | ") if name != "null")


def _table(root: type[msgspec.Struct], path: str) -> type[msgspec.Struct] | None:
    """What a key path leads to, if it is a table with known keys."""
    found: type[msgspec.Struct] | None = root
    for key in re.findall(r"[A-Za-z_]\w*", path):
        if found is None or key not in found.__struct_fields__:
            return None
        found = next(_tables(get_type_hints(found)[key]), None)
    return found


def _tables(hint: Any) -> Iterator[type[msgspec.Struct]]:
    """The tables among what a key may hold."""
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        yield hint
    for part in get_args(hint):
        yield from _tables(part)
