"""Systems and scenes as the page reads them: plain numbers, where they come to rest, and what it refuses."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.compiled.tracing import numbers_of
from reference.errors import SolverError, Unsupported
from reference.scenes import Setup
from reference.state import Array
from reference.system import MassSpringSystem
from report.browser.changes import changes_data, drives_data

if TYPE_CHECKING:  # this imports SciPy
    from reference.theory.contacts import Contacts
    from reference.theory.equilibria import Equilibrium

#: Systems of more masses are refused: a browser would not step them in time.
MOST_MASSES = 2_500

#: What of a system the page knows. Whatever else a system comes to have is refused until the page has it too.
KNOWN = frozenset(
    {
        *("positions", "springs", "masses", "rest_lengths", "stiffness", "damping", "drag", "gravity"),
        *("velocities", "fixed", "obstacles", "nonlinear", "angular_springs"),
    }
)

#: What people call those that it does not.
_WORDS = {
    "collisions": "masses that collide",
    "pulls": "forces that pull on masses",
}


def system_data(system: MassSpringSystem) -> dict[str, Any]:
    """A system as JSON's numbers: arrays row by row; one number where all are the same.

    Raises:
        Unsupported: with the reason, for what the page cannot do.
    """
    refuse_beyond(system)
    n, d = system.positions.shape
    return {
        "n": n,
        "s": len(system.springs),
        "d": d,
        "positions": system.positions.ravel().tolist(),
        "velocities": _compact(system.velocities),
        "springs": system.springs.ravel().tolist(),
        "masses": _compact(system.masses),
        "rest_lengths": _compact(system.rest_lengths),
        "stiffness": _compact(system.stiffness),
        "damping": _compact(system.damping),
        **_kinds(system),
        **_bending(system),
        "drag": system.drag,
        "gravity": system.gravity.tolist(),
        "fixed": np.flatnonzero(system.fixed).tolist(),
        "obstacles": [{"kind": f"{o.kind}{o.dimension}", "values": numbers_of([o])} for o in system.obstacles],
    }


def _kinds(system: MassSpringSystem) -> dict[str, Any]:
    """What springs have besides stiffness and damping, where any has; JSON has no infinity: there it is no number."""
    law = system.nonlinear
    if law is None:
        return {}
    values = {name: getattr(law, name).astype(float).tolist() for name in law.asked}
    return {"nonlinear": {name: [v if np.isfinite(v) else None for v in row] for name, row in values.items()}}


def _bending(system: MassSpringSystem) -> dict[str, Any]:
    """What resists bending, where anything does: three masses of each, stiffness and rest angle."""
    angular = system.angular_springs
    if angular is None:
        return {}
    numbers = {name: getattr(angular, name).tolist() for name in ("stiffness", "rest_angles")}
    return {"angular": {"masses": angular.masses.ravel().tolist(), **numbers}}


def refuse_beyond(system: MassSpringSystem) -> None:
    """Refuse what the page cannot do. Raises Unsupported, with the way out."""
    if len(system.masses) > MOST_MASSES:
        raise Unsupported(f"{len(system.masses)} masses: the page takes at most {MOST_MASSES:,}")
    for field in fields(system):
        if field.name not in KNOWN and _is_set(system, field.name):
            what = _WORDS.get(field.name, field.name)
            raise Unsupported(f"{what}: the page does not know them yet; `springlab live` does")


def _is_set(system: MassSpringSystem, name: str) -> bool:
    """Whether a field has another value than it has where it is left out."""
    plain = MassSpringSystem(
        positions=np.array([[0.0], [1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.ones(1),
        rest_lengths=np.ones(1),
        stiffness=np.ones(1),
    )
    value, default = getattr(system, name), getattr(plain, name)
    if isinstance(value, np.ndarray):
        return bool((value != np.asarray(default).ravel()[0]).any()) if np.size(default) else value.size > 0
    return bool(value != default)


def scene_data(setup: Setup, summary: str = "", slides: str = "", command: str = "") -> dict[str, Any]:
    """A scene with its dt, duration, changes and drives, where it comes to rest, and the command line's words for it.

    Raises:
        Unsupported: with the reason, for what the page cannot do.
    """
    rest = rest_data(setup.system)
    return {
        "name": setup.name,
        "summary": summary,
        "slides": slides,
        "command": command or setup.name,
        "dt": setup.dt,
        "duration": setup.duration,
        "changes": changes_data(setup.changes),
        "drives": drives_data(setup),
        "system": system_data(setup.system),
        **rest,
    }


def rest_data(system: MassSpringSystem) -> dict[str, Any]:
    """Where it comes to rest, from which the page goes on when parameters change; `rest` is empty where nowhere.

    Of a rest on obstacles also where it would be without them, as `alone`.
    """
    from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium

    still = replace(system, velocities=np.zeros_like(system.velocities))
    found: Equilibrium | None = None
    with suppress(SolverError):
        found = equilibrium_on_obstacles(still)[0] if still.obstacles else spring_equilibrium(still)
    if found is None:
        return {"rest": [], "contacts": [], "about": ""}
    about = _about(found) if still.obstacles else ""
    rest = {"rest": found.state.positions.ravel().tolist(), "about": about}
    if found.contacts is None:
        return rest | {"contacts": []}
    with suppress(SolverError):
        alone = spring_equilibrium(replace(still, obstacles=()))
        rest |= {"alone": alone.state.positions.ravel().tolist()}
    return rest | {"contacts": contact_data(found.contacts, system)}


def _about(found: Equilibrium) -> str:
    """About which rest of a scene with obstacles a prediction is, by the page's word for it."""
    if not found.system.obstacles:
        return "without_obstacles"
    return "no_contact" if found.contacts is None else "on_obstacles"


def contact_data(contacts: Contacts, system: MassSpringSystem) -> list[Mapping[str, Any]]:
    """Which masses press on obstacles, each with the way out, and whether the surface curves there."""
    rows = zip(contacts.masses.tolist(), contacts.normals.tolist(), contacts.obstacles.tolist(), strict=True)
    curved = [hasattr(obstacle, "radius") for obstacle in system.obstacles]
    return [{"mass": mass, "normal": normal, "curved": curved[of]} for mass, normal, of in rows]


def _compact(values: Array) -> Any:
    """One number where all are the same, the sign of zero too."""
    flat = values.ravel()
    if len(flat) and flat.tobytes() == flat[:1].tobytes() * len(flat):
        return float(flat[0])
    return flat.tolist()
