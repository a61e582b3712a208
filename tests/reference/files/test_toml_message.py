"""Messages about the contents of a file are people's: keys with suggestions, types in words."""

from __future__ import annotations

import msgspec
import pytest

from reference.files.toml_message import plain


class Part(msgspec.Struct, forbid_unknown_fields=True):
    """A table within."""

    stiffness: float


class File(msgspec.Struct, forbid_unknown_fields=True):
    """A file."""

    part: Part | None = None
    parts: list[Part] = []
    numbers: float | list[float] | None = None
    fixed: list[int] = []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("prt = 1", "unknown key 'prt': did you mean 'part'?"),
        ("[part]\nstifness = 1.0", "part: unknown key 'stifness': did you mean 'stiffness'?"),
        (
            "[[parts]]\nstiffness = 1.0\n[[parts]]\nstifness = 1.0",
            "parts[1]: unknown key 'stifness': did you mean 'stiffness'?",
        ),
        ('numbers = "x"', "numbers: expected a number or a list, got text"),
        ("fixed = [true]", "fixed[0]: expected a whole number, got true or false"),
        ("part = 3", "part: expected a table, got a whole number"),
        ("[part]", "part.stiffness is missing"),
    ],
)
def test_a_mistake_is_told_in_peoples_words(text: str, said: str) -> None:
    """As the validator itself finds it."""
    with pytest.raises(msgspec.ValidationError) as found:
        msgspec.toml.decode(text, type=File)
    assert plain(str(found.value), File) == said
