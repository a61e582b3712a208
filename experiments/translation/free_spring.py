"""What an engine makes of a spring of which no damping is asked: what it damps is its own.

The page of findings shows it (`report.players`), and `versions` measures it in every version that is kept.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from engines.process.packages import APART
from engines.translation.translation import Spring, Stepping, Translation, translations
from experiments.translation.measured import measured_spring, steps_to_watch
from experiments.translation.oscillation import system_of
from experiments.translation.rows import fitting

#: The spring: 1 kg that swings 4 times a second, with no damping at all; at the steps of a game and of a robot [s].
SPRING, STEPS = Spring(1.0, 0.0, 1.0).with_oscillation(4.0, 0.0), (1 / 60, 1 / 240)


def told(stiffness: float, damping: float) -> tuple[str, str]:
    """Frequency [Hz] and damping ratio of a k [N/m] and c [N s/m] on SPRING's mass, to the figures that are told.

    >>> told(631.6547, 5.0)
    ('4.000', '0.0995')
    """
    omega = np.sqrt(stiffness / SPRING.effective_mass)
    return f"{omega / (2 * np.pi):.3f}", f"{abs(damping) / (2 * SPRING.effective_mass * omega):.4f}"


def of_package(package: str) -> list[Translation]:
    """What is run of a package in an environment of its own; what comes with the lab its tests run each day."""
    return [found for found in translations().values() if package in APART and found.package == package]


def measured(translation: Translation, python: Path) -> dict[str, str]:
    """At each of STEPS, what an engine with an interpreter makes of SPRING; or why there is nothing."""
    rows = {}
    for dt in STEPS:
        typed = translation.settings(SPRING, fitting(translation, Stepping(dt)))
        system = system_of(SPRING, min(translation.dimensions))
        snippet = translation.snippet(system, Stepping(dt), steps_to_watch(SPRING, dt), [typed])
        found = measured_spring(translation, snippet, SPRING, dt, python)
        words = found if isinstance(found, str) else "{} Hz, damping ratio {}".format(*told(*found))
        rows[f"4 Hz at 1/{round(1 / dt)} s, {translation.name}"] = words
    return rows
