"""The rows of `springlab translate`: what to type, what it then is, predicted and measured, and warnings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from engines.process.available import available_version, how_to_install
from engines.translation.translation import NoSpringError, Settings, Spring, Stepping, Translation, translations
from experiments.translation.measured import measured_spring, steps_to_watch
from experiments.translation.oscillation import largest_stable_dt, spring_of_step, step_matrix, system_of
from reference.errors import InputError, SolverError, Unsupported

#: What is called the same.
SAME = 0.01

#: Of critical damping, what is rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Row:
    """One engine.

    Attributes:
        engine: the translation's name.
        title: the engine and the kind of spring.
        settings: what to type, in the engine's own words.
        snippet: a program that does, or the calls.
        wanted: the spring meant, k [N/m] and c [N s/m].
        effective: those of the step at this dt, predicted; None where it is no spring.
        measured: those of the engine, running the snippet; None where it is not run.
        largest_stable_dt: [s], for this spring alone; None where there is no limit.
        reason: warnings, and why something is missing.
    """

    engine: str
    title: str
    settings: Settings
    snippet: str | None
    wanted: tuple[float, float]
    effective: tuple[float, float] | None
    measured: tuple[float, float] | None
    largest_stable_dt: float | None
    reason: str

    @property
    def document(self) -> dict[str, Any]:
        """As JSON has it."""
        effective, measured = self.effective or (None, None), self.measured or (None, None)
        return {
            "engine": self.engine,
            "settings": dict(self.settings),
            "snippet": self.snippet,
            "effective_stiffness": effective[0],
            "effective_damping": effective[1],
            "measured_stiffness": measured[0],
            "measured_damping": measured[1],
            "stiffness": self.wanted[0],
            "damping": self.wanted[1],
            "largest_stable_dt_s": self.largest_stable_dt,
            "reason": self.reason,
        }


def forward(spring: Spring, stepping: Stepping, chosen: Sequence[Translation] = (), measure: bool = True) -> list[Row]:
    """What to type into each engine, all where none is chosen, for a spring."""
    rows = []
    for translation in chosen or translations().values():
        if chosen:
            translation.check(stepping)
        known = stepping if chosen else fitting(translation, stepping)
        rows.append(row_of(translation, translation.settings(spring, known), spring, known, measure))
    return rows


def backward(
    translation: Translation, typed: Settings, masses: Spring, stepping: Stepping, measure: bool = True
) -> Row:
    """What an engine's own numbers mean.

    Raises:
        InputError: for a field it does not have, one that is missing, or numbers that are no spring.
    """
    translation.check(stepping)
    whole = translation.typed(typed)
    for field, value in typed.items():
        if not isfinite(value):
            raise InputError(f"{translation.name}: {field} = {value:g}: expected a finite number")
    words = ", ".join(f"{field} = {value:g}" for field, value in typed.items())
    try:
        spring = translation.meaning(whole, masses, stepping)
    except Unsupported as error:
        raise InputError(f"{translation.name}: {error}") from None
    except NoSpringError as error:
        if error.field in typed:
            raise
        raise InputError(f"{translation.name}: {words}: this would be {error}") from None
    except OverflowError:
        raise InputError(f"{translation.name}: {words}: expected a spring whose numbers are finite") from None
    except ZeroDivisionError:
        zero = ", ".join(f"{field} = 0" for field, value in typed.items() if value == 0)
        raise InputError(f"{translation.name}: {zero}: expected a number that is not zero") from None
    return row_of(translation, whole, spring, stepping, measure)


def fitting(translation: Translation, stepping: Stepping) -> Stepping:
    """Without the sub-steps or iterations that an engine does not have."""
    return Stepping(
        stepping.dt,
        stepping.substeps if translation.substeps else None,
        stepping.iterations if translation.iterations else None,
    )


def row_of(translation: Translation, typed: Settings, spring: Spring, stepping: Stepping, measure: bool) -> Row:
    """Of settings that are to be a spring."""
    scheme, dt = translation.scheme(stepping), stepping.dt
    nominal = translation.meaning(typed, spring, stepping)
    limit = largest_stable_dt(scheme, nominal)
    effective = _effective(scheme, nominal, dt)
    reasons = list(warnings(translation, spring, effective, limit, dt))
    try:
        dimension = min(translation.dimensions)
        snippet = translation.snippet(system_of(spring, dimension), stepping, steps_to_watch(spring, dt), [typed])
    except Unsupported as error:
        snippet, reasons = None, [*reasons, str(error)]
    measured = None
    why_not = _why_not_run(translation)
    if why_not:
        reasons.append(why_not)
    elif measure and snippet is not None:
        found = measured_spring(translation, snippet, spring, dt)
        measured, said = (None, [found]) if isinstance(found, str) else (found, [])
        reasons += said
    if translation.note:
        reasons.append(translation.note)
    wanted = (spring.stiffness, spring.damping)
    return Row(
        translation.name, translation.title, typed, snippet, wanted, effective, measured, limit, "; ".join(reasons)
    )


def _why_not_run(translation: Translation) -> str:
    """Why a snippet is not run here."""
    if translation.package is None:
        return "not run here: predicted only"
    if translation.package and available_version(translation.package) is None:
        return f"not measured: {how_to_install(translation.package)}"
    return ""


def _effective(scheme: str, spring: Spring, dt: float) -> tuple[float, float] | None:
    try:
        matrix = step_matrix(scheme, spring, dt)
    except SolverError:
        return None
    return spring_of_step(matrix, spring, dt) if np.isfinite(matrix).all() else None


def warnings(
    translation: Translation, spring: Spring, effective: tuple[float, float] | None, limit: float | None, dt: float
) -> list[str]:
    """What stands against it: that it blows up, or is another spring than was meant."""
    if limit is not None and dt >= limit:
        return [f"it blows up at this dt: expected dt < {limit:.3g} s"]
    if effective is None:
        return ["at this dt the step is that of no spring: it turns over in every step"]
    said = []
    stiffness, damping = effective
    if abs(stiffness / spring.stiffness - 1) > SAME:
        said.append(f"really {stiffness / spring.stiffness:.1%} as stiff")
    critical = 2 * spring.effective_mass * spring.omega
    if abs(damping - spring.damping) > SAME * max(spring.damping, SAME * critical):
        really = 0.0 if abs(damping) < ROUNDING * critical else damping
        part = f"{really / critical:.3g} of critical"
        said.append(f"really {really:.3g} N s/m of damping ({part}), not {spring.damping:.3g}")
    return said
