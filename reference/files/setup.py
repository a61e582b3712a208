"""What a scene means wherever one is asked for: its name, or a TOML file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from reference.changes import Change, Drive, Driven
from reference.errors import InputError
from reference.scenes import Setup, find


def setup_for(
    scene: str,
    dt: float | None = None,
    duration: float | None = None,
    settings: Mapping[str, str] | None = None,
    changes: tuple[Change, ...] = (),
    drives: tuple[Drive, ...] = (),
) -> Setup:
    """The setup of a scene, by name or TOML file, with dt, duration, parameters and changes of one's own.

    Args:
        scene: a name, or a file's path.
        dt: the step [s]; the scene's own where left out.
        duration: how long [s]; the scene's own where left out.
        settings: parameters of the scene, as text.
        changes: parameters that change on the fly, besides those the scene changes itself.
        drives: parameters that change all the time.

    Raises:
        InputError: for anything that makes no sense; changes are tried out on the system here, not midway in a run.
    """
    settings = settings or {}
    if is_file(scene):
        from reference.files.scene_file import load

        setup = load(Path(scene), settings, dt, duration)
    else:
        setup = find(scene).setup(settings, dt, duration)
    setup = replace(setup, changes=(*setup.changes, *changes, *_driven(setup, changes, drives)))
    setup.check()
    return setup


def _driven(setup: Setup, changes: tuple[Change, ...], drives: tuple[Drive, ...]) -> tuple[Change, ...]:
    """What drives change. Raises InputError for a parameter that changes otherwise, too."""
    for drive in drives:
        if any(change.parameter == drive.parameter for change in (*setup.changes, *changes)):
            raise InputError(f"{drive.parameter} is driven, and changed besides: expected one of the two")
    return Driven(setup.system, drives).changes(setup.dt, setup.duration)


def is_file(scene: str) -> bool:
    """Whether a scene is meant as a file, and not as a name."""
    # where the system does not take such a name (too long, a zero in it), `os.path` says no and `Path` raises
    return Path(scene).suffix == ".toml" or os.path.isfile(scene)
