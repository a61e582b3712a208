"""Which scheme a stepper is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from springlab.plot import Plot
from springlab.setting import AnyScene, Changing, setup_of
from springlab.steppers import AnyStepper, stepper_of
from springlab.table import Table

if TYPE_CHECKING:
    from reference.identification import Identification


@dataclass(frozen=True)
class Identified:
    """What a stepper was found to be on a scene."""

    _found: Identification

    @property
    def stepper(self) -> str:
        """Its name."""
        return self._found.stepper

    @property
    def identified_as(self) -> str | None:
        """The scheme that reproduces it to rounding, of several the simplest; None where there is none."""
        return self._found.identified_as

    @property
    def ties(self) -> tuple[str, ...]:
        """Other schemes that do the same on this scene."""
        return self._found.ties

    @property
    def error(self) -> float:
        """How far the nearest scheme is [m]; infinite where nothing could be compared."""
        return self._found.error

    @property
    def tolerance(self) -> float:
        """Up to which distance a scheme is named [m]."""
        return self._found.tolerance

    @property
    def reason(self) -> str:
        """Why there is no name; empty where there is one."""
        return self._found.reason

    @property
    def table(self) -> Table:
        """The catalogue, nearest first."""
        from report.shown import of_identification

        return Table.of(of_identification(self._found))

    def plot(self) -> Plot:
        """How far each scheme of the catalogue is from the stepper, and up to where one is named.

        Raises:
            InputError: where nothing could be compared.
        """
        from report.figures.identification import draw

        return Plot(draw(self._found))

    def to_pandas(self) -> Any:
        """The catalogue, nearest first. Raises ImportError without pandas."""
        return self.table.to_pandas()

    def __str__(self) -> str:
        return "\n".join(part for part in (str(self._found), self._found.remark) if part)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


def identify(
    stepper: AnyStepper,
    scene: AnyScene = "string",
    *,
    dt: float | None = None,
    duration: float | None = None,
    changes: Sequence[Changing] = (),
    time_limit: float | None = None,
    **parameters: Any,
) -> Identified:
    """Which scheme of the catalogue reproduces a stepper on a scene to rounding.

    >>> import springlab as lab
    >>> found = lab.identify("semi_implicit_euler", masses=4, duration=0.1)
    >>> found.identified_as, found.error
    ('kick_drift', 0.0)
    >>> def step(a, x, v, dt):
    ...     x = x + dt * v
    ...     return x, v + dt * a(x, v)
    >>> lab.identify(step, masses=4, duration=0.1).identified_as
    'drift_kick'

    Args:
        stepper: the name of a scheme or engine, or a file or function of your own.
        scene: a name, a TOML file, or what `scene` or `system` gave.
        dt: the step [s]; the scene's own where left out.
        duration: how long [s]; the scene's own where left out.
        changes: what changes on the fly: (time [s], parameter, value), `Change`, `Ramp` or `Sine`.
        time_limit: how long an engine may take [s].
        parameters: of the scene, in SI units.

    Raises:
        InputError: naming what makes no sense, and what was expected.
    """
    from reference import identification

    setup = setup_of(scene, dt, duration, changes, parameters)
    found = stepper_of(stepper, time_limit)
    return Identified(identification.identify(found, setup.system, setup.dt, setup.steps, setup.changes))
