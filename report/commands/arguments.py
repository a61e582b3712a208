"""What the command line's words mean: KEY=VALUE, T:KEY=VALUE, a scene's name or file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from reference.changes import Change
from reference.errors import InputError
from reference.scenes import Setup, find


def parse_settings(words: Iterable[str]) -> dict[str, str]:
    """KEY=VALUE as a dictionary."""
    settings = {}
    for word in words:
        key, equals, value = word.partition("=")
        if not (key and equals and value):
            raise InputError(f"--set {word!r}: expected KEY=VALUE")
        settings[key] = value
    return settings


def parse_changes(words: Iterable[str]) -> tuple[Change, ...]:
    """T:KEY=VALUE as changes on the fly; VALUE is one number, or one for each mass, spring or axis."""
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


def setup_for(
    scene: str,
    dt: float | None = None,
    duration: float | None = None,
    settings: Mapping[str, str] | None = None,
    changes: tuple[Change, ...] = (),
) -> Setup:
    """The setup of a scene, by name or TOML file, with dt, duration, parameters and changes of one's own.

    Raises:
        InputError: for anything that makes no sense; changes are tried out on the system here, not midway in a run.
    """
    path = Path(scene)
    if path.suffix == ".toml" or path.is_file():
        from reference.files.scene_file import load

        setup = load(path, settings or {}, dt, duration)
    else:
        setup = find(scene).setup(settings or {}, dt, duration)
    setup = replace(setup, changes=(*setup.changes, *changes))
    setup.check()
    return setup
