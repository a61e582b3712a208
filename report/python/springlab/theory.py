"""What theory says of a scene: up to which dt steppers are stable on it, and at which frequencies it swings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.state import Array
from springlab.plot import Plot
from springlab.setting import AnyScene, setup_of
from springlab.steppers import AnyStepper, all_of, steppers_of
from springlab.table import Table

if TYPE_CHECKING:
    from experiments.limits.limit_rows import Row
    from experiments.simulation.modes_of_scene import Modes as ModesFound


@dataclass(frozen=True)
class Stability:
    """The largest stable dt of steppers on a scene about its rest, predicted and measured."""

    _rows: tuple[Row, ...]

    @property
    def predicted(self) -> dict[str, float | None]:
        """By theory, of each stepper [s]; None where there is no limit, or it is not known: the table says which."""
        return {row.stepper: row.predicted.dt for row in self._rows}

    @property
    def measured(self) -> dict[str, float | None]:
        """From runs, of each stepper [s]; None where there is none."""
        return {row.stepper: row.measured.dt for row in self._rows}

    @property
    def document(self) -> list[dict[str, Any]]:
        """As `springlab stability --json` prints it."""
        return [row.document for row in self._rows]

    @property
    def table(self) -> Table:
        """A row for each stepper."""
        from experiments.stability import result_of

        result = result_of(self._rows)
        (table,) = result.tables
        return Table("", tuple(table.columns), tuple(map(tuple, table.rows)), tuple(result.findings))

    def plot(self) -> Plot:
        """Predicted limits as bars, measured ones as dots."""
        from experiments.stability import result_of
        from report.figures import draw

        return Plot(draw("stability", result_of(self._rows)))

    def to_pandas(self) -> Any:
        """A row for each stepper, as in `document`. Raises ImportError without pandas."""
        return Table.of_documents("", self.document).to_pandas()

    def __str__(self) -> str:
        return str(self.table)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


def stability(
    scene: AnyScene,
    *steppers: AnyStepper | Sequence[AnyStepper],
    stepper: AnyStepper | Sequence[AnyStepper] = (),
    **parameters: Any,
) -> Stability:
    """Up to which dt steppers are stable on a scene about its rest: predicted by theory, and measured.

    >>> import springlab as lab
    >>> limits = lab.stability("oscillator", "kick_drift")  # 2 / sqrt(k/m) = 2 sqrt(m/k)
    >>> system = lab.scene("oscillator").system
    >>> 2 * (system.masses[1] / system.stiffness[0]) ** 0.5 / limits.predicted["kick_drift"]
    np.float64(1.0)

    Args:
        scene: a name, a TOML file, or what `scene` or `system` gave.
        steppers: names of schemes and engines, files or functions of your own; where there is none, all that theory
            knows on springs, which takes long.
        stepper: the same by keyword: one more, or several.
        parameters: of the scene, in SI units.

    Raises:
        InputError: naming what makes no sense, and what was expected.
        SolverError: where the scene comes to no rest.
    """
    from experiments.limits.limit_rows import stability_rows
    from experiments.runs.steppers import steppers_here

    known = [s.name for s in steppers_here().values() if s.kind not in ("lecture", "pendulum")]
    system = setup_of(scene, None, None, (), parameters).system
    return Stability(tuple(stability_rows(system, steppers_of(all_of(steppers, stepper) or known), lambda _: None)))


@dataclass(frozen=True)
class Modes:
    """How a scene swings about its rest."""

    _found: ModesFound

    @property
    def frequencies(self) -> Array:
        """Natural, without damping, slowest first [Hz], shape (k,); zero where nothing brings a mass back."""
        return self._found.natural.frequencies

    @property
    def damping_ratios(self) -> Array:
        """Of each mode, shape (k,); NaN where its frequency is zero."""
        return self._found.natural.damping_ratios

    @property
    def shapes(self) -> Array:
        """Moves of all masses, the largest 1, shape (k, n, d)."""
        return self._found.natural.shapes

    @property
    def equilibrium(self) -> Array:
        """Where masses are at rest [m], shape (n, d)."""
        return self._found.rest.state.positions

    @property
    def spring_forces(self) -> Array:
        """What springs carry at rest [N], tension positive, shape (s,)."""
        return self._found.forces

    @property
    def document(self) -> dict[str, Any]:
        """As `springlab modes --json` prints it."""
        return self._found.document

    @property
    def table(self) -> Table:
        """A row for each mode."""
        from report.shown import of_modes

        return Table.of(of_modes(self._found))

    def plot(self) -> Plot:
        """The slowest modes, a panel each."""
        from report.figures.modes import draw

        return Plot(draw(self._found))

    def to_pandas(self) -> Any:
        """A row for each mode. Raises ImportError without pandas."""
        return self.table.to_pandas()

    def __str__(self) -> str:
        return str(self.table)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


def modes(scene: AnyScene, *, lowest: int | None = None, **parameters: Any) -> Modes:
    """Natural frequencies, damping ratios and shapes of a scene about its rest, and what its springs carry there.

    >>> import springlab as lab
    >>> found = lab.modes("oscillator")
    >>> found.frequencies.shape, found.equilibrium.shape
    ((1,), (2, 1))

    Args:
        scene: a name, a TOML file, or what `scene` or `system` gave.
        lowest: only so many modes, the slowest.
        parameters: of the scene, in SI units.

    Raises:
        InputError: naming what makes no sense, and what was expected.
        SolverError: where the scene comes to no rest.
    """
    from experiments.simulation.modes_of_scene import modes_of
    from reference.errors import InputError

    if lowest is not None and lowest < 1:
        raise InputError(f"lowest = {lowest}: expected a number >= 1")
    return Modes(modes_of(setup_of(scene, None, None, (), parameters), lowest))
