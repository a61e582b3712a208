"""What springs may have besides stiffness and damping: ropes, struts, springs that harden, yield or break.

The law that follows from it is in `nonlinear_law`, and what breaks when in `breaking`. Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.checked_numbers import LARGEST, in_range, refuse, shaped, truths
from reference.errors import InputError
from reference.state import Array

BoolArray = npt.NDArray[np.bool_]

#: What springs may have besides stiffness and damping, with what it is and in which unit.
KINDS = {
    "tension_only": "1 for springs that only pull, as ropes do",
    "compression_only": "1 for springs that only push, as struts do that nothing fastens",
    "hardening": "N/m^3, k3 of a force k s + k3 s^3",
    "largest_force": "N, of springs that yield there",
    "breaking_force": "N, above which a spring that pulls breaks",
    "breaking_stretch": "m, above which a spring breaks",
}

#: Those of them that are true or not.
ONE_SIDED = ("tension_only", "compression_only")


@dataclass(frozen=True, eq=False)
class NonlinearSprings:
    """What the springs of a system have besides stiffness and damping. One number stands for all springs.

    Attributes:
        tension_only: whether it only pulls, shape (s,).
        compression_only: whether it only pushes, shape (s,).
        hardening: k3 [N/m^3], shape (s,), each >= 0.
        largest_force: [N], shape (s,), each > 0; infinite where there is none.
        breaking_force: of tension [N], shape (s,), each > 0; infinite where there is none.
        breaking_stretch: [m], shape (s,), each > 0; infinite where there is none.

    Raises:
        InputError: in `checked`, naming the field, the index, the value, and what was expected.
    """

    tension_only: BoolArray = field(default_factory=lambda: np.zeros(1, dtype=bool))
    compression_only: BoolArray = field(default_factory=lambda: np.zeros(1, dtype=bool))
    hardening: Array = field(default_factory=lambda: np.zeros(1))
    largest_force: Array = field(default_factory=lambda: np.full(1, np.inf))
    breaking_force: Array = field(default_factory=lambda: np.full(1, np.inf))
    breaking_stretch: Array = field(default_factory=lambda: np.full(1, np.inf))

    def checked(self, count: int) -> NonlinearSprings | None:
        """The same with one number for each of so many springs, read-only; None where all of them are linear."""
        values: dict[str, Any] = {
            name: shaped(name, truths(name, getattr(self, name), "spring"), (count,)) for name in ONE_SIDED
        }
        values["hardening"] = in_range("hardening", self.hardening, (count,), "N/m^3")
        for name, unit in (("largest_force", "N"), ("breaking_force", "N"), ("breaking_stretch", "m")):
            values[name] = _limits(name, getattr(self, name), count, unit)
        _refuse_both(values["tension_only"] & values["compression_only"], "tension_only", "compression_only")
        _refuse_both((values["hardening"] > 0) & np.isfinite(values["largest_force"]), "hardening", "largest_force")
        for name, array in values.items():
            values[name] = np.ascontiguousarray(array).copy()
            values[name].flags.writeable = False
        whole = NonlinearSprings(**values)
        return whole if whole.asked else None

    @property
    def asked(self) -> list[str]:
        """Which of KINDS any spring has."""
        has = {name: getattr(self, name) for name in KINDS}
        return [name for name, array in has.items() if (array.any() if array.dtype == bool else _given(name, array))]

    @property
    def breaks(self) -> bool:
        """Whether any spring can break."""
        return bool(self.may_break.any())

    @property
    def may_break(self) -> BoolArray:
        """Which springs can break, shape (s,)."""
        return np.asarray(np.isfinite(self.breaking_force) | np.isfinite(self.breaking_stretch))

    @property
    def may_open(self) -> BoolArray:
        """Which springs leave their masses alone at any length: they only push, or break. Shape (s,)."""
        return np.asarray(self.compression_only | self.may_break)

    def of(self, which: Any) -> NonlinearSprings:
        """Those of some springs, by their numbers or a slice."""
        return NonlinearSprings(**{name: getattr(self, name)[which] for name in KINDS})

    def without(self, which: Any) -> NonlinearSprings | None:
        """The same with some springs linear from now on."""
        values = {name: getattr(self, name).copy() for name in KINDS}
        for name, array in values.items():
            array[which] = getattr(_LINEAR, name)
        return NonlinearSprings(**values).checked(len(self.hardening))

    def followed_by_linear(self, count: int) -> NonlinearSprings:
        """The same with so many linear springs listed after them."""
        ends = {name: np.broadcast_to(getattr(_LINEAR, name), count) for name in KINDS}
        return NonlinearSprings(**{name: np.concatenate([getattr(self, name), end]) for name, end in ends.items()})

    def to_dict(self) -> dict[str, Any]:
        """Plain lists of what any spring has; None for an infinite number."""
        lists = {name: getattr(self, name).tolist() for name in self.asked}
        return {name: [None if value == np.inf else value for value in values] for name, values in lists.items()}


def with_kinds(law: NonlinearSprings | None, values: Mapping[str, Any]) -> NonlinearSprings:
    """What springs have, with some of KINDS set: numbers, one or one for each; of ONE_SIDED 1 or 0.

    Raises:
        InputError: for a number that says neither yes nor no. The rest is checked by the system.
    """
    arrays: dict[str, Any] = {}
    for name, value in values.items():
        array = np.asarray(value, dtype=np.float64)
        if name in ONE_SIDED:
            refuse(name, array, ~np.isin(array, (0, 1)), "1 for springs that do, 0 for others")
        arrays[name] = array == 1 if name in ONE_SIDED else array
    return replace(law or _LINEAR, **arrays)


#: Of a spring that is linear.
_LINEAR = NonlinearSprings()


def _given(name: str, array: Array) -> bool:
    return bool((array > 0).any() if name == "hardening" else np.isfinite(array).any())


def _limits(name: str, value: npt.ArrayLike, count: int, unit: str) -> Array:
    """Numbers above zero, or infinite where there is no limit."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {value!r}: expected numbers [{unit}]") from None
    refuse(name, array, ~(array > 0), f"a number > 0 [{unit}]")
    refuse(name, array, np.isfinite(array) & (array > LARGEST), f"a number of at most {LARGEST:g} [{unit}]")
    return np.asarray(shaped(name, array, (count,)))


def _refuse_both(bad: BoolArray, one: str, other: str) -> None:
    if bad.any():
        raise InputError(f"{one} and {other} of spring {np.argmax(bad)}: expected one of the two")
