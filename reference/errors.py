"""What the lab says when it is given something it cannot use, or cannot go on."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class InputError(ValueError):
    """Bad input. The message is one line: the field, the value it had, and what was expected."""


class SolverError(ArithmeticError):
    """An implicit scheme's equation could not be solved; the message says at what step size."""


class Unsupported(Exception):  # noqa: N818 - one of the five words a run ends with
    """A stepper cannot do what is asked of it; the message is the reason."""


class Fault(Exception):  # noqa: N818 - not ours
    """What a user's own file does that no step may; the message names the file and says what, in a line."""


def unknown_name(kind: str, name: str, known: Iterable[str]) -> InputError:
    """The error for a name nobody has: names those that begin so, the nearest one, or all of them.

    >>> print(unknown_name("scheme", "huen", ["euler", "heun"]))
    unknown scheme 'huen': did you mean 'heun'?
    >>> print(unknown_name("engine", "mujoco", ["mujoco_flex", "mujoco_rope", "pymunk_springs"]))
    unknown engine 'mujoco': expected one of mujoco_flex, mujoco_rope
    """
    names = sorted(known)
    begun = [each for each in names if each.startswith(f"{name}_")]
    if len(begun) > 1:
        return InputError(f"unknown {kind} {name!r}: expected one of {', '.join(begun)}")
    near = difflib.get_close_matches(name, names, n=1)
    hint = f"did you mean {near[0]!r}?" if near else f"expected one of {', '.join(names)}"
    return InputError(f"unknown {kind} {name!r}: {hint}")
