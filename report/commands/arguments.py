"""What the words of options mean: KEY=VALUE, T:KEY=VALUE, KEY=LOW:HIGH."""

from __future__ import annotations

from collections.abc import Iterable

from reference.changes import Change
from reference.errors import InputError


def parse_settings(words: Iterable[str]) -> dict[str, str]:
    """KEY=VALUE as a dictionary. Raises InputError for a word of another form."""
    settings = {}
    for word in words:
        key, equals, value = word.partition("=")
        if not (key and equals and value):
            raise InputError(f"--set {word!r}: expected KEY=VALUE")
        settings[key] = value
    return settings


def parse_changes(words: Iterable[str]) -> tuple[Change, ...]:
    """T:KEY=VALUE as changes on the fly; VALUE is one number, or one for each mass, spring or axis.

    Raises:
        InputError: for a word of another form.
    """
    changes = []
    for word in words:
        time, _, setting = word.partition(":")
        key, _, value = setting.partition("=")
        try:
            numbers = [float(number) for number in value.split(",")]
            changes.append(Change(float(time), key, numbers[0] if len(numbers) == 1 else numbers))
        except ValueError:
            raise InputError(f"--change {word!r}: expected T:KEY=VALUE with two numbers") from None
    return tuple(changes)


def parse_ranges(words: Iterable[str]) -> dict[str, tuple[float, float]]:
    """KEY=LOW:HIGH as a dictionary of pairs. Raises InputError for a word of another form."""
    ranges = {}
    for word in words:
        name, _, values = word.partition("=")
        low, _, high = values.partition(":")
        try:
            ranges[name] = float(low), float(high)
        except ValueError:
            raise InputError(f"--range {word!r}: expected KEY=LOW:HIGH with two numbers") from None
    return ranges
