"""Steppers run on a scene: what it did under each, how far that is from the true motion, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from reference.state import Array, Trajectory
from springlab.plot import Plot
from springlab.setting import AnyScene, Changing, Scene, setup_of
from springlab.steppers import AnyStepper, all_of, steppers_of
from springlab.table import Table, frame

if TYPE_CHECKING:
    from experiments.runs.comparison import Comparison as ComparedAll
    from experiments.runs.comparison import Run as ComparedOne
    from experiments.simulation.simulation import Run as SimulatedOne
    from experiments.simulation.simulation import Simulation as SimulatedAll
    from reference.outcome import Outcome
    from reference.scenes import Setup

R = TypeVar("R", bound="_Ran")


@dataclass(frozen=True)
class _Ran:
    """What any run of a stepper has."""

    _setup: Setup
    _run: Any

    @property
    def stepper(self) -> str:
        """Its name."""
        return str(self._run.stepper.name)

    @property
    def version(self) -> str | None:
        """Of an engine's package."""
        version: str | None = self._run.stepper.version
        return version

    @property
    def outcome(self) -> str:
        """How it ended: done, diverged, crashed, timed out or unsupported."""
        return self._outcome.ending

    @property
    def reason(self) -> str:
        """Why it ended so, in a line; empty where it is done."""
        return self._outcome.reason

    @property
    def times(self) -> Array:
        """Of all states there are [s], shape (m,)."""
        return self._motion.times

    @property
    def positions(self) -> Array:
        """At those times [m], shape (m, n, d)."""
        return self._motion.positions

    @property
    def velocities(self) -> Array:
        """At those times [m/s], shape (m, n, d)."""
        return self._motion.velocities

    def to_pandas(self) -> Any:
        """A row for every mass at every time: time [s], mass, x, y, ... [m], vx, vy, ... [m/s].

        Raises:
            ImportError: where pandas is not installed.
        """
        m, n, d = self.positions.shape
        columns: dict[str, Any] = {"time": np.repeat(self.times, n), "mass": np.tile(np.arange(n), m)}
        for name, values in (("", self.positions), ("v", self.velocities)):
            columns |= {f"{name}{'xyz'[axis]}": values[..., axis].ravel() for axis in range(d)}
        return frame(columns)

    @property
    def _outcome(self) -> Outcome:
        outcome: Outcome = self._run.outcome
        return outcome

    @property
    def _motion(self) -> Trajectory:
        """What it left; nothing, of the right shape, where it left nothing."""
        nothing = np.zeros((0, *self._setup.system.positions.shape))
        return self._outcome.trajectory or Trajectory(np.zeros(0), nothing, nothing)


@dataclass(frozen=True)
class Run(_Ran):
    """What a scene did under one stepper, up to where it ended."""

    _run: SimulatedOne

    @property
    def blew_up_at(self) -> float | None:
        """When [s]; None where it did not."""
        return self._run.blew_up_at

    @property
    def document(self) -> dict[str, Any]:
        """The state at the end and the largest of everything, as `springlab simulate --json` has it."""
        return self._run.document

    @cached_property
    def spring_forces(self) -> Array:
        """With which every spring pulls [N], tension positive, shape (m, s); NaN where rods stand for springs."""
        forces = self._springs("force")
        known = self._run.motion is not None and self._run.motion.forces is not None
        return forces if known else np.full_like(forces, np.nan)

    @cached_property
    def stretches(self) -> Array:
        """Length less rest length of every spring [m], shape (m, s)."""
        return self._springs("stretch")

    @cached_property
    def energies(self) -> dict[str, Array]:
        """Kinetic, elastic, gravitational and total [J], each of shape (m,)."""
        from experiments.simulation.spring_state import energies

        return energies(self._setup, self._motion, range(len(self._motion))) if len(self._motion) else {}

    def _springs(self, what: str) -> Array:
        from experiments.simulation.spring_state import spring_frames

        parts = [getattr(part, what) for part in spring_frames(self._setup, self._motion)] if len(self._motion) else []
        return np.concatenate([np.zeros((0, len(self._setup.system.springs))), *parts])


@dataclass(frozen=True)
class Compared(_Ran):
    """One stepper's run beside the true motion, and beside the scheme that it is."""

    _run: ComparedOne

    @property
    def error(self) -> Array | None:
        """The largest distance of any mass from the true motion at each time [m], shape (m,); None if not known."""
        return self._run.error

    @property
    def identified_as(self) -> str | None:
        """The scheme that reproduces it to rounding; None where there is none, and `row` says why."""
        return self._run.identification.identified_as

    @property
    def ties(self) -> tuple[str, ...]:
        """Other schemes that do the same on this scene."""
        return self._run.identification.ties

    @property
    def deviation(self) -> Array | None:
        """The largest distance from the identified scheme at each time [m], shape (m,); None where there is none."""
        return self._run.deviation

    @property
    def row(self) -> dict[str, Any]:
        """The run in plain numbers and words, as `springlab compare --json` has it."""
        return self._run.row


@dataclass(frozen=True)
class _Runs(Generic[R]):
    """Runs by the names of their steppers, or by number, in the order they were asked for."""

    runs: tuple[R, ...]

    def __getitem__(self, key: str | int) -> R:
        """Raises KeyError, IndexError where there is none."""
        if isinstance(key, int):
            return self.runs[key]
        names = [run.stepper for run in self.runs]
        if key not in names:
            raise KeyError(f"{key!r}: expected one of {', '.join(names)}")
        return self.runs[names.index(key)]

    def __len__(self) -> int:
        return len(self.runs)


@dataclass(frozen=True)
class Simulation(_Runs[Run]):
    """All steppers on one scene, with what it did under each. By name: `simulation["heun"]`.

    Attributes:
        runs: one for each stepper.
    """

    _all: SimulatedAll

    @property
    def scene(self) -> Scene:
        """What was run."""
        return Scene(self._all.setup)

    @property
    def table(self) -> Table:
        """What there is to say of each run in a few lines."""
        from report.shown import of_simulation

        return Table.of(of_simulation(self._all))

    @property
    def document(self) -> dict[str, Any]:
        """As `springlab simulate --json` prints it."""
        return self._all.document

    def plot(self, what: str = "paths") -> Plot:
        """Paths of masses, "energy", "forces" of springs, or a coordinate of a mass over time, as "10:y".

        Raises:
            InputError: for another word; where no run has left a motion.
        """
        from report.figures.simulation import draw, wanted

        system = self._all.setup.system
        return Plot(draw(self._all, wanted(what, len(system.masses), system.dimension)))

    def to_pandas(self) -> Any:
        """As of each run, one below the other, with the stepper's name first. Raises ImportError without pandas."""
        parts = {run.stepper: run.to_pandas() for run in self.runs}
        import pandas

        return pandas.concat(parts, names=["stepper", "row"]).reset_index("stepper")

    def __str__(self) -> str:
        return str(self.table)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


@dataclass(frozen=True)
class Comparison(_Runs[Compared]):
    """All steppers on one scene: how far from the true motion, and why. By name: `comparison["heun"]`.

    Attributes:
        runs: one for each stepper.
    """

    _all: ComparedAll

    @property
    def scene(self) -> Scene:
        """What was run."""
        return Scene(self._all.setup)

    @property
    def times(self) -> Array:
        """Of all steps [s], shape (m,)."""
        return self._all.times

    @property
    def true_positions(self) -> Array | None:
        """The true motion [m], shape (m, n, d); None where it is not known, and the table says why."""
        return None if self._all.true is None else self._all.true.positions

    @property
    def table(self) -> Table:
        """A row for each stepper."""
        from report.shown import of_comparison

        return Table.of(of_comparison(self._all))

    @property
    def document(self) -> dict[str, Any]:
        """As `springlab compare --json` prints it."""
        return self._all.document

    def plot(self) -> Plot:
        """Distances over time: measured, from the true motion; and what is left of them beside the identified scheme.

        Raises:
            InputError: where no run has an error.
        """
        from reference.errors import InputError
        from report.figures.divergence import draw_runs

        if all(run.error is None for run in self.runs):
            raise InputError(
                f"nothing to plot of {self.scene.name}: expected a run with a distance from the true motion"
            )
        return Plot(draw_runs(self._all, self._all.runs))

    def to_pandas(self) -> Any:
        """A row for each stepper, as in `document`. Raises ImportError without pandas."""
        return Table.of_documents("", self.document["runs"]).to_pandas()

    def __str__(self) -> str:
        return str(self.table)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


def simulate(
    scene: AnyScene,
    *steppers: AnyStepper | Sequence[AnyStepper],
    stepper: AnyStepper | Sequence[AnyStepper] = (),
    dt: float | None = None,
    duration: float | None = None,
    changes: Sequence[Changing] = (),
    time_limit: float | None = None,
    **parameters: Any,
) -> Simulation:
    """Run a scene, and say what it did: where masses went, what springs carried, what became of its energy.

    >>> import springlab as lab
    >>> run = lab.simulate("oscillator", "rk4", duration=0.5)["rk4"]
    >>> run.outcome, run.positions.shape
    ('done', (501, 2, 1))

    Args:
        scene: a name, a TOML file, or what `scene` or `system` gave.
        steppers: names of schemes and engines, files or functions of your own; `heun` where there is none.
        stepper: the same by keyword: one more, or several.
        dt: the step [s]; the scene's own where left out.
        duration: how long [s]; the scene's own where left out.
        changes: what changes on the fly: (time [s], parameter, value), `Change`, `Ramp` or `Sine`.
        time_limit: how long an engine may take [s].
        parameters: of the scene, in SI units.

    Raises:
        InputError: naming what makes no sense, and what was expected.
    """
    from experiments.simulation.simulation import simulate_all

    found = simulate_all(
        setup_of(scene, dt, duration, changes, parameters),
        steppers_of(all_of(steppers, stepper) or ("heun",), time_limit),
    )
    return Simulation(tuple(Run(found.setup, run) for run in found.runs), found)


def compare(
    scene: AnyScene,
    *steppers: AnyStepper | Sequence[AnyStepper],
    stepper: AnyStepper | Sequence[AnyStepper] = (),
    dt: float | None = None,
    duration: float | None = None,
    changes: Sequence[Changing] = (),
    time_limit: float | None = None,
    **parameters: Any,
) -> Comparison:
    """Run steppers on one scene: how far each is from the true motion, and which scheme each one is.

    >>> import springlab as lab
    >>> compared = lab.compare("string", "heun", "euler", masses=4, duration=0.1)
    >>> bool(compared["euler"].error[-1] > 10 * compared["heun"].error[-1])
    True

    Args:
        scene: a name, a TOML file, or what `scene` or `system` gave.
        steppers: names of schemes and engines, files or functions of your own; all there are where there is none, but
            for those that would take long.
        stepper: the same by keyword: one more, or several.
        dt: the step [s]; the scene's own where left out.
        duration: how long [s]; the scene's own where left out.
        changes: what changes on the fly: (time [s], parameter, value), `Change`, `Ramp` or `Sine`.
        time_limit: how long an engine may take [s].
        parameters: of the scene, in SI units.

    Raises:
        InputError: naming what makes no sense, and what was expected.
    """
    from experiments.runs import comparison
    from experiments.runs.steppers import default_steppers

    named = all_of(steppers, stepper)
    chosen = steppers_of(named or [each.name for each in default_steppers()], time_limit)
    found = comparison.compare(setup_of(scene, dt, duration, changes, parameters), chosen, patient=bool(named))
    return Comparison(tuple(Compared(found.setup, run) for run in found.runs), found)
