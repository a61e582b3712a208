"""A step of any form on a system: it is given copies, and what it returns is looked at."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from engines.own.forms import Form, form_of
from engines.own.system import OwnSystem, exercise_spring, exercise_string
from reference.errors import Fault, Unsupported
from reference.state import Array
from reference.system import MassSpringSystem

#: A user's function.
Function = Callable[..., Any]


class OwnStep:
    """A function with the roles of its parameters (`forms`), ready to step a system.

    Args:
        name: of the file, for what is said.
        source: the path that its code says it is from.

    Attributes:
        changes_input: whether it has written into what it was given.
        tells_time: whether it has told f a time.
    """

    def __init__(self, name: str, function: Function, roles: Sequence[str], system: MassSpringSystem) -> None:
        self.name, self.function, self.roles = name, function, roles
        form = form_of(roles)
        assert form is not None
        self.form: Form = form
        self.fixed, self.start, self.up = system.fixed, system.positions, system.vertical_axis
        self.given: Any = None
        if form == "string":
            self.given = exercise_string(system)
        elif form == "spring":
            self.given = exercise_spring(system)
        else:
            self.given = OwnSystem(system)
        self.changes_input = self.tells_time = False

    def __call__(self, x: Array, v: Array, time: float, dt: float) -> tuple[Array, Array]:
        """Positions and velocities after dt [s], each (n, d). Raises Fault for what it does that a step may not."""
        end = {"slope": self._by_slope, "acceleration": self._by_arrays, "system": self._by_arrays}.get(
            self.form, self._of_exercise
        )(x, v, time, dt)
        # what is held stays, whatever the function makes of it
        held = self.fixed[:, None]
        return np.where(held, self.start, end[0]), np.where(held, 0.0, end[1])

    def called(self, **given: Any) -> Any:
        """What the function returns; each argument by its role. Raises Fault where it raises.

        Raises Unsupported where it asks for what would mislead it (`system.OwnSystem`).
        """
        try:
            return self.function(*(given[role] for role in self.roles))
        except Unsupported as error:
            raise Unsupported(f"{self.name}{_line(error, self.function)} {error}") from None
        except (Exception, SystemExit) as error:  # whose process this is, too, must not end
            said = f"{type(error).__name__}: {error}".removesuffix(": ")
            raise Fault(f"{self.name}{_line(error, self.function)}: {said}") from None

    def _by_slope(self, x: Array, v: Array, time: float, dt: float) -> tuple[Array, Array]:
        shape, size = x.shape, x.size

        def slope(t: float, y: Array) -> Array:
            here, rate = y[:size].reshape(shape), y[size:].reshape(shape)
            return np.concatenate([np.where(self.fixed[:, None], 0.0, rate), self.given.acceleration(here, rate)], None)

        y = np.concatenate([x, v], axis=None)
        end = self.after(y, time, dt, slope)
        return end[:size].reshape(shape), end[size:].reshape(shape)

    def after(self, y: Array, time: float, dt: float, slope: Callable[[float, Array], Array]) -> Array:
        """Y after dt, of a step that is given a slope."""

        def asked(*arguments: Any) -> Array:
            t, where = self._told_apart(arguments, y.shape, time)
            return slope(t, where)

        given = y.copy()
        end = self.called(slope=asked, state=given, time=time, dt=dt)
        self.changes_input |= not np.array_equal(given, y, equal_nan=True)
        return self._array(end, "y", y.shape)

    def _told_apart(self, arguments: Sequence[Any], shape: tuple[int, ...], time: float) -> tuple[float, Array]:
        """The time and y of the arguments of f, in whichever order."""
        arrays = [np.asarray(a, dtype=float) for a in arguments if np.shape(a) == shape]
        times = [float(a) for a in arguments if np.shape(a) == ()]
        if len(arrays) != 1 or len(times) > 1 or len(arguments) != len(arrays) + len(times):
            raise TypeError(f"f is called with {len(arguments)} arguments: expected y of shape {shape}, and t")
        self.tells_time |= bool(times)
        (where,), (when,) = arrays, times or [time]
        return when, where.copy()

    def _by_arrays(self, x: Array, v: Array, time: float, dt: float) -> tuple[Array, Array]:
        return self.after_pair(x, v, time, dt, self.given.acceleration, self.given)

    def after_pair(
        self, x: Array, v: Array, time: float, dt: float, acceleration: Callable[..., Array], system: Any
    ) -> tuple[Array, Array]:
        """Positions and velocities after dt, of a step that is given these."""

        def asked(*arguments: Any) -> Array:
            arrays = [np.asarray(a, dtype=float) for a in arguments if np.shape(a) == x.shape]
            if not 1 <= len(arrays) <= 2 or len(arguments) - len(arrays) > 1:
                raise TypeError(f"a is called with {len(arguments)} arguments: expected x, v of shape {x.shape}")
            return acceleration(arrays[0].copy(), (arrays[1] if len(arrays) == 2 else v).copy())

        given = x.copy(), v.copy()
        end = self.called(positions=given[0], velocities=given[1], time=time, dt=dt, acceleration=asked, system=system)
        self.changes_input |= not all(np.array_equal(*pair, equal_nan=True) for pair in zip(given, (x, v), strict=True))
        return self._pair(end, x.shape)

    def _of_exercise(self, x: Array, v: Array, time: float, dt: float) -> tuple[Array, Array]:
        """Of a string without its fixed mass; of one mass, by its height below or above that."""
        single = self.form == "spring"
        up, anchor = self.up, float(self.start[0, self.up])
        here, rate = (x[1, up] - anchor, v[1, up]) if single else (x[1:].copy(), v[1:].copy())
        end = self.called(
            **{"positions": here, "state": here, "velocities": rate, "time": time, "dt": dt, self.form: self.given}
        )
        ends = self._pair(end, () if single else x[1:].shape)
        new_x, new_v = x.copy(), v.copy()
        if single:
            new_x[1, up], new_v[1, up] = ends[0] + anchor, ends[1]
        else:
            self.changes_input |= not (np.array_equal(here, x[1:]) and np.array_equal(rate, v[1:]))
            new_x[1:], new_v[1:] = ends
        return new_x, new_v

    def _pair(self, value: Any, shape: tuple[int, ...]) -> tuple[Array, Array]:
        if value is None:
            raise Fault(f"{self.name} returns nothing: a return is missing")
        if not isinstance(value, tuple | list | np.ndarray) or len(value) != 2:
            raise Fault(f"{self.name} returns {_said(value)}: expected positions and velocities")
        return self._array(value[0], "positions", shape), self._array(value[1], "velocities", shape)

    def _array(self, value: Any, what: str, shape: tuple[int, ...]) -> Array:
        """As numbers of the shape there was."""
        if value is None:
            raise Fault(f"{self.name} returns nothing: a return is missing")
        found = np.asarray(value) if not isinstance(value, tuple) or what != "y" else np.empty(0, dtype=object)
        if found.dtype.kind not in "biuf":
            raise Fault(f"{self.name} returns {_said(value)} for {what}: expected real numbers")
        if found.shape != shape:
            raise Fault(f"{self.name} returns {what} of shape {found.shape}: expected {shape}")
        return np.array(found, dtype=float)


def _line(error: BaseException, function: Function) -> str:
    """Where in the function's own file an error was raised."""
    code = getattr(function, "__code__", None)
    file = code.co_filename if code else ""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file]
    return f", line {lines[-1]}" if lines else ""


def _said(value: Any) -> str:
    """What something is, in a word or two."""
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} of shape {value.shape}"
    return f"{len(value)} things" if isinstance(value, tuple | list) else f"a {type(value).__name__}"
