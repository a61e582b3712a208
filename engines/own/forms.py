"""The forms that people write a step in, told by the names of its parameters, in any order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from reference.errors import InputError

#: What a parameter may be called, by what it is.
NAMES = {
    "slope": ("f", "fun", "func", "F", "rhs", "slope", "deriv", "derivative", "derivatives", "dydt", "ode"),
    "acceleration": ("a", "acc", "accel", "acceleration", "accelerations"),
    "state": ("y", "y0", "yn", "u", "state", "z"),
    "positions": ("x", "x0", "xn", "q", "pos", "positions", "r"),
    "velocities": ("v", "v0", "vn", "vel", "velocities"),
    "time": ("t", "t0", "tn", "time"),
    "dt": ("dt", "h", "step_size", "delta_t", "tau"),
    "system": ("system", "mesh", "s", "scene"),
    "string": ("string",),
    "spring": ("spring",),
}

#: The parameters of each form, beside the time, which any may have.
Form = Literal["slope", "acceleration", "system", "string", "spring"]
FORMS: dict[Form, frozenset[str]] = {
    "slope": frozenset({"slope", "state", "dt"}),
    "acceleration": frozenset({"acceleration", "positions", "velocities", "dt"}),
    "system": frozenset({"positions", "velocities", "dt", "system"}),
    "string": frozenset({"positions", "velocities", "dt", "string"}),
    "spring": frozenset({"state", "velocities", "dt", "spring"}),
}

#: As they are said.
EXPECTED = "expected step(x, v, dt, system), step(f, y, t, dt) or step(a, x, v, dt), in any order"


def roles_of(where: str, names: Sequence[str]) -> tuple[str, ...]:
    """What each parameter is, by its name.

    Args:
        where: file and function, for the message.

    Raises:
        InputError: where they are none of FORMS.
    """
    roles = tuple(next((role for role, known in NAMES.items() if name in known), "") for name in names)
    if "" in roles or len(set(roles)) < len(roles) or form_of(roles) is None:
        raise InputError(f"{where}({', '.join(names)}): {EXPECTED}")
    return roles


def form_of(roles: Sequence[str]) -> Form | None:
    """The form with these parameters."""
    given = frozenset(roles) - {"time"}
    return next((form for form, asked in FORMS.items() if asked == given), None)
