"""Catalogued schemes as steppers that ask for slopes, to be recorded."""

from __future__ import annotations

from functools import cache

from reference.derivation.recording import Advance, Slopes, record
from reference.derivation.tableau import Tableau, tableau_of
from reference.derivation.updates import Updates, updates_of
from reference.errors import Unsupported
from reference.schemes.catalogue import Scheme
from reference.state import Array, Slope, State


class Answering:
    """Equations of motion that answer what they are told to: `motion.Motion`."""

    def __init__(self, slopes: Slopes) -> None:
        self._slopes = slopes

    def acceleration(self, state: State, /) -> Array:
        """Only that of velocities."""
        return self._slopes(state.time, state.positions, state.velocities)[1]

    def slope(self, state: State, /) -> Slope:
        """Both."""
        return Slope(1.0, *self._slopes(state.time, state.positions, state.velocities))


@cache
def updates_of_scheme(scheme: Scheme) -> Updates:
    """The update formulas of a scheme of accelerations.

    Raises:
        Unsupported: where it has none, with the reason.
    """
    if scheme.needs != "accelerations":
        raise Unsupported(f"it needs {scheme.needs}")

    def make() -> Advance:
        return lambda slopes, state, h: scheme.on(Answering(slopes))(state, h)

    return updates_of(record(make))


@cache
def tableau_of_scheme(scheme: Scheme) -> Tableau | None:
    """The tableau of a scheme of accelerations; None where it has none."""
    try:
        return tableau_of(updates_of_scheme(scheme))
    except Unsupported:
        return None
