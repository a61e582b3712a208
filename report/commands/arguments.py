"""What the words of options mean: KEY=VALUE, T:KEY=VALUE, KEY=LOW:HIGH."""

from __future__ import annotations

from collections.abc import Iterable

from reference.changes import Change, Drive
from reference.errors import InputError

#: What has an option of its own, and is often taken for a parameter.
OPTIONS = ("dt", "duration")


def parse_settings(words: Iterable[str]) -> dict[str, str]:
    """KEY=VALUE as a dictionary. Raises InputError for a word of another form."""
    settings = {}
    for word in words:
        key, equals, value = word.partition("=")
        if not (key and equals and value):
            raise InputError(f"--set {word!r}: expected KEY=VALUE")
        if key in OPTIONS:
            raise InputError(f"--set {word!r}: {key} is no parameter of a scene: expected --{key} {value}")
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
            numbers = [float(number) for number in value.split(",")] if "," in value else float(value)
            changes.append(Change(float(time), key, numbers))
        except ValueError:
            raise InputError(f"--change {word!r}: expected T:KEY=VALUE with two numbers") from None
    return tuple(changes)


def parse_ramps(words: Iterable[str]) -> tuple[Drive, ...]:
    """BEGIN:END:KEY=VALUE as parameters that go to a value. Raises InputError for a word of another form."""
    from reference.drives import Ramp

    ramps = []
    for word in words:
        times, _, value = word.partition("=")
        try:
            begin, end, key = times.split(":")
            numbers = float(begin), float(end), float(value)
        except ValueError:
            raise InputError(f"--ramp {word!r}: expected BEGIN:END:KEY=VALUE with three numbers") from None
        ramps.append(Ramp(key, *numbers))
    return tuple(ramps)


def parse_sines(words: Iterable[str]) -> tuple[Drive, ...]:
    """BEGIN:KEY=AMPLITUDE@FREQUENCY as parameters that swing. Raises InputError for a word of another form."""
    from reference.drives import Sine

    sines = []
    for word in words:
        key, _, swing = word.partition("=")
        try:
            begin, name = key.split(":")
            amplitude, frequency = swing.split("@")
            numbers = float(begin), float(amplitude), float(frequency)
        except ValueError:
            raise InputError(f"--sine {word!r}: expected BEGIN:KEY=AMPLITUDE@FREQUENCY with three numbers") from None
        sines.append(Sine(name, *numbers))
    return tuple(sines)


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
