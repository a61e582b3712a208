"""A scene's springs, engine by engine: what to type for each kind of spring in it, and the whole scene as a snippet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from engines.translation.translation import Spring, Stepping, Translation, translations
from experiments.runs.progress import Progress
from experiments.translation.measured import steps_to_watch
from experiments.translation.rows import Row, fitting, row_of
from reference.errors import InputError, SolverError, Unsupported
from reference.system import MassSpringSystem

#: Solvers of constraints are differenced at every dt: for more coordinates than that it takes too long to wait for.
SOLVERS_UP_TO = 6


def springs_of(system: MassSpringSystem) -> list[Spring]:
    """Every spring with the masses it joins; those between two fixed masses as if one of them were free.

    Raises:
        InputError: for a spring without stiffness.
    """
    made = []
    for j, (a, b) in enumerate(system.springs.tolist()):
        if not system.stiffness[j] > 0:
            raise InputError(f"stiffness[{j}] = {system.stiffness[j]:g}: expected > 0 to be translated")
        free = [float(system.masses[i]) for i in (b, a) if not system.fixed[i]] or [float(system.masses[b])]
        made.append(Spring(float(system.stiffness[j]), float(system.damping[j]), *free[:2]))
    if not made:
        raise InputError("the scene has no springs to translate")
    return made


def rows_of_scene(
    system: MassSpringSystem,
    stepping: Stepping,
    chosen: Sequence[Translation],
    progress: Progress,
    measure: bool = True,
) -> list[Row]:
    """A row for each engine and each kind of spring; the snippet is the whole scene's, the largest dt too.

    What a spring really is at this dt is told of the spring alone, with the masses it joins.
    """
    springs = springs_of(system)
    kinds = list(dict.fromkeys(springs))
    rows = []
    for translation in chosen or translations().values():
        progress(translation.name)
        if chosen:
            translation.check(stepping)
        known = fitting(translation, stepping)
        limit, said = _limit(translation.scheme(known), system)
        for kind in kinds:
            row = row_of(translation, translation.settings(kind, known), kind, known, measure)
            which = f"{springs.count(kind)} of {len(springs)} springs"
            reasons = [which, said, row.reason, *_beyond(translation, system)]
            snippet = None if _beyond(translation, system) else _snippet(translation, system, known, springs)
            joined = "; ".join(filter(None, reasons))
            rows.append(replace(row, snippet=snippet, largest_stable_dt=limit, reason=joined))
    return rows


def _beyond(translation: Translation, system: MassSpringSystem) -> list[str]:
    """What of the system the snippet cannot have."""
    said = []
    dimension = max(2, system.dimension)
    if dimension not in translation.dimensions:
        said.append(f"{translation.name} cannot do motion in {dimension} dimensions")
    if system.nonlinear is not None or system.collisions is not None:
        said.append("snippets have linear springs, and masses that do not collide")
    if system.angular_springs is not None:
        said.append("snippets have no springs that resist bending")
    if system.pulls.any():
        said.append("snippets have no force that pulls on a mass")
    if system.obstacles or system.drag:
        said.append("snippets have neither obstacles nor drag")
    return said


def _snippet(
    translation: Translation, system: MassSpringSystem, stepping: Stepping, springs: Sequence[Spring]
) -> str | None:
    try:
        typed = [translation.settings(spring, stepping) for spring in springs]
        return translation.snippet(system, stepping, steps_to_watch(springs[0], stepping.dt), typed)
    except Unsupported:
        return None


def _limit(scheme: str, system: MassSpringSystem) -> tuple[float | None, str]:
    """The largest stable dt [s] of a scene about its rest, by theory; or why there is none."""
    from reference.schemes.catalogue import find
    from reference.theory.equilibria import spring_equilibrium
    from reference.theory.limits import stability_limit

    free = int((~system.fixed).sum()) * system.dimension
    if find(scheme).kind == "constraint_scheme" and free > SOLVERS_UP_TO:
        return (
            None,
            f"the scene's largest stable dt takes long to predict: springlab stability SCENE --stepper '{scheme}'",
        )
    try:
        with np.errstate(all="ignore"):
            found = stability_limit(find(scheme), spring_equilibrium(system))
    except (SolverError, InputError, Unsupported) as error:
        return None, str(error)
    return found.dt, found.reason
