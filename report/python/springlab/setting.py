"""What is to move, for how long and in which steps: scenes by name, from files, or of one's own masses and springs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from reference.changes import Change, Drive
from reference.errors import InputError, unknown_name
from reference.scenes import Setup
from reference.system import MassSpringSystem

#: A parameter that changes on the fly: (time [s], parameter, value), a Change, or a Ramp or Sine.
Changing = tuple[float, str, Any] | Change | Drive

#: What a system of one's own is run with, unless told otherwise [s].
DT, DURATION = 1e-3, 0.5


@dataclass(frozen=True)
class Scene:
    """A system, and how it is to be run: what every function takes as its scene.

    Attributes:
        setup: as the other rooms know it.
    """

    setup: Setup

    @property
    def name(self) -> str:
        """Of the scene, or of its file."""
        return self.setup.name

    @property
    def system(self) -> MassSpringSystem:
        """Masses, springs and parameters; arrays by name, as `positions` [m], shape (n, d)."""
        return self.setup.system

    @property
    def dt(self) -> float:
        """The step [s]."""
        return self.setup.dt

    @property
    def duration(self) -> float:
        """How long it is run [s]."""
        return self.setup.duration

    def __repr__(self) -> str:
        n, s = len(self.system.masses), len(self.system.springs)
        return f"<scene {self.name}: {n} masses, {s} springs, dt = {self.dt:g} s, {self.duration:g} s>"


#: What every function takes as a scene.
AnyScene = str | Path | Scene | MassSpringSystem


def scene(
    name: AnyScene,
    *,
    dt: float | None = None,
    duration: float | None = None,
    changes: Sequence[Changing] = (),
    **parameters: Any,
) -> Scene:
    """A scene, with parameters of one's own.

    >>> import springlab as lab
    >>> lab.scene("string", masses=5, duration=0.2)
    <scene string: 6 masses, 5 springs, dt = 0.001 s, 0.2 s>

    Args:
        name: of `scenes()`; or a TOML file, an earlier `scene`, or a `system`.
        dt: the step [s]; the scene's own where left out.
        duration: how long [s]; the scene's own where left out.
        changes: what changes on the fly: (time [s], parameter, value), `Change`, `Ramp` or `Sine`.
        parameters: of the scene, in SI units; `scenes()` lists them.

    Raises:
        InputError: naming what makes no sense, and what was expected.
    """
    from reference.files.setup import setup_for

    _refuse_no_number(dt=dt, duration=duration)
    fixed, drives = _changing(changes)
    if isinstance(name, str | Path):
        return Scene(setup_for(str(name), dt, duration, parameters, fixed, drives))
    if parameters:
        raise InputError(f"{next(iter(parameters))}: expected no parameters, the system is there already")
    own = name.setup if isinstance(name, Scene) else None
    if own is None and not isinstance(name, MassSpringSystem):
        raise InputError(f"scene {name!r}: expected a name, a TOML file, or what scene() or system() gave")
    setup = own or Setup("system", name, DT, DURATION)  # type: ignore[arg-type]
    setup = replace(setup, dt=setup.dt if dt is None else dt, duration=setup.duration if duration is None else duration)
    for drive in drives:
        fixed = (*fixed, *drive.changes(setup.system, setup.dt, setup.duration))
    setup = replace(setup, changes=(*setup.changes, *fixed))
    setup.check()
    return Scene(setup)


def _refuse_no_number(**times: Any) -> None:
    """Times are numbers; whether they make sense is looked at where the setup is."""
    from numbers import Real

    for name, value in times.items():
        if value is not None and not isinstance(value, Real):
            raise InputError(f"{name} = {value!r}: expected a number > 0 [s]")


def system(positions: Any, springs: Any, *, masses: Any, stiffness: Any, **others: Any) -> MassSpringSystem:
    """A system of one's own masses and springs. A single number does for all masses, or all springs.

    >>> import springlab as lab
    >>> pair = lab.system([[0.0, 0.0], [0.5, 0.0]], [[0, 1]], masses=0.1, stiffness=40.0, fixed=[0], gravity=9.81)
    >>> lab.simulate(pair, "rk4", dt=1e-3, duration=0.1)["rk4"].positions.shape
    (101, 2, 2)

    Args:
        positions: where masses start [m], shape (n, d), d = 1, 2 or 3.
        springs: the two masses each spring joins, shape (s, 2).
        masses: [kg], shape (n,).
        stiffness: k [N/m], shape (s,).
        others: what else a table [system] of a scene file may have: rest_lengths [m], as long as the springs are where
            left out; damping [N s/m] along springs; drag [N s/m] on masses; gravity [m/s^2], a number downwards, 9.81
            where left out; velocities [m/s], shape (n, d); fixed, the numbers of masses that never move;
            angular_stiffness [N m/rad], of an angular spring at every mass where two springs meet.

    Raises:
        InputError: naming the field, the index, the value, and what was expected.
    """
    from reference.files.system_tables import SystemTable

    fields = {"positions": positions, "springs": springs, "masses": masses, "stiffness": stiffness, **others}
    for name in fields:
        if name not in SystemTable.__struct_fields__:
            raise unknown_name("field of a system", name, SystemTable.__struct_fields__)
    return SystemTable(**{name: _plain(value) for name, value in fields.items()}).system()


def setup_of(scene_like: AnyScene, dt: Any, duration: Any, changes: Sequence[Changing], parameters: Any) -> Setup:
    """The setup of whatever a function was given. Raises InputError as `scene` does."""
    return scene(scene_like, dt=dt, duration=duration, changes=changes, **parameters).setup


def _plain(value: Any) -> Any:
    """An array as the lists that a file has; anything else as it is."""
    return value.tolist() if hasattr(value, "tolist") else value


def _changing(given: Sequence[Changing]) -> tuple[tuple[Change, ...], tuple[Drive, ...]]:
    """Changes, and what drives parameters all the time. Raises InputError for anything else."""
    changes, drives = [], []
    for item in given:
        if isinstance(item, tuple) and len(item) == 3:
            time, parameter, value = item
            changes.append(Change(float(time), parameter, _plain(value)))
        elif isinstance(item, Change):
            changes.append(item)
        elif hasattr(item, "parameter") and hasattr(item, "changes"):
            drives.append(item)
        else:
            raise InputError(f"change {item!r}: expected (time, parameter, value), a Change, a Ramp or a Sine")
    return tuple(changes), tuple(drives)
