"""Files of the user's own that may step a lane: those named when the lab was opened, and no others.

A page may ask for any name, and a file is a program: what is not named by whoever started the lab is not run.
"""

from __future__ import annotations

from collections.abc import Mapping

from engines.own.stepper import OwnFile, OwnStepper, is_own, own_stepper
from reference.derivation.explanation import identified_on_a_string
from reference.errors import InputError
from reference.identification import Identification
from reference.printable import printable
from reference.system import MassSpringSystem

#: As they were named, by how they are shown.
_OPENED: dict[str, str] = {}

#: What each text was found to be, with damping and drag and without: (path, function, text), damped, dragged.
_FOUND: dict[tuple[tuple[str, str, str], bool, bool], Identification] = {}


def opened() -> Mapping[str, str]:
    """Those there are."""
    return _OPENED


def admit(name: str) -> str:
    """Let a file step lanes, FILE.py, FILE.py:FUNCTION or FILE.c; other names are left as they are.

    Returns:
        What it is shown as.

    Raises:
        InputError: where it cannot be used.
    """
    if not is_own(name):
        return name
    own_stepper(name)
    shown = printable(name)
    _OPENED[shown] = name
    return shown


def file_of(shown: str) -> OwnFile:
    """A file that was admitted, as its text is now: a lane that begins again has what was written meanwhile.

    Raises:
        InputError: where it cannot be used any more.
    """
    return _engine(own_stepper(_OPENED[shown]))


def identified(shown: str, system: MassSpringSystem) -> Identification:
    """Which scheme it is, on a string with damping and drag if the system has them. Raises InputError as `file_of`."""
    stepper = own_stepper(_OPENED[shown])
    file, damped, dragged = _engine(stepper), bool(system.damping.any()), bool(system.drag)
    key = (file.path, file.function, file.source), damped, dragged
    if key not in _FOUND:
        _FOUND[key] = identified_on_a_string(stepper, damped, dragged)
    return _FOUND[key]


def _engine(stepper: OwnStepper) -> OwnFile:
    if not isinstance(stepper.engine, OwnFile):
        raise InputError(f"{stepper.name}: expected a file")
    return stepper.engine
