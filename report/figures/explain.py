"""The stability region of a derived step matrix, and steps that were measured in it."""

from __future__ import annotations

import numpy as np

from reference.derivation.consequences import FAR, Windows
from reference.derivation.explanation import Explanation
from reference.derivation.fit import Samples
from reference.derivation.oscillators import matrices_at, runs_of
from reference.derivation.swings import swing_matrices
from reference.state import Array
from reference.stepper import Stepper
from report.figures import COLOURS, TITLE, Picture, new_figure

#: The plane is shown so far beyond the first limits, and up to here at most; this far where there is no limit.
BEYOND, MOST, UNLIMITED = 1.3, 5.0, 4.0

#: Derived on a grid of so many points each way, measured on one of so many.
FINE, COARSE = 240, 9

#: Growth in a step below which there is none.
NONE = 1e-9


def draw(explanation: Explanation, stepper: Stepper) -> Picture:
    """Where a step of the damped oscillator does not grow: the derived region as a field, measured steps as marks."""
    figure, axes = new_figure(figsize=(7.5, 5.4))
    title = f"{explanation.stepper}: where a step of the damped oscillator does not grow"
    axes.set_title(title, loc="left", fontsize=TITLE)
    axes.set_xlabel("h w = h sqrt(k/m) [1]")
    matrix, follows = explanation.matrix, explanation.follows
    if matrix is None or follows is None:
        why = explanation.reasons[0] if explanation.reasons else "no step matrix"
        axes.text(0.5, 0.5, why, transform=axes.transAxes, ha="center", va="center", wrap=True)
        return Picture(figure, f"No stability region of {explanation.stepper}: {why}.")
    across, letter = (True, "c") if matrix.damped else (False, "Cd")
    axes.set_ylabel(f"h {letter}/m [1]" if matrix.damped or matrix.dragged else "no damping: it can do none")
    widest = _extent(follows.imaginary_axis)
    highest = _extent(follows.real_axis) if follows.real_axis is not None else 1.0
    w, damping = np.meshgrid(np.linspace(0, widest, FINE), np.linspace(0, highest, FINE))
    growth = _growth(matrix.at(w**2, *_damped(damping, across)))
    axes.contourf(w, damping, growth, levels=[-2, NONE], colors=[COLOURS[5]], alpha=0.5)
    axes.contour(w, damping, growth, levels=[NONE], colors=[COLOURS[6]], linewidths=1.6)
    some = [(np.arange(COARSE) + 0.5) / COARSE * most for most in (widest, highest)]
    x, y = (values.ravel() for values in np.meshgrid(*some))
    y = y if matrix.damped or matrix.dragged else 0 * y
    measure = swing_matrices if matrix.of_swings else matrices_at
    measured = measure(runs_of(stepper), Samples(x**2, *_damped(y, across)))
    grows = _growth(measured) > NONE
    axes.plot(x[~grows], y[~grows], "o", color=COLOURS[0], label="measured: does not grow")
    axes.plot(x[grows], y[grows], "x", color=COLOURS[1], label="measured: grows")
    axes.plot([], [], "-", color=COLOURS[6], label="derived: limit")
    axes.set_xlim(0, widest)
    axes.set_ylim(0, highest)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=3)
    odd = int((grows != (_growth(matrix.at(x**2, *_damped(y, across))) > NONE)).sum())
    return Picture(
        figure,
        f"Stability region of {explanation.stepper}: derived, {(growth <= NONE).mean():.0%} of the plane of h w up to "
        f"{widest:.3g} and h {letter}/m up to {highest:.3g}; of {len(x)} measured steps {len(x) - odd} agree with it.",
    )


def _damped(values: Array, by_spring: bool) -> tuple[Array, Array]:
    return (values, 0 * values) if by_spring else (0 * values, values)


def _growth(matrices: Array) -> Array:
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=-1) - 1)


def _extent(windows: Windows) -> float:
    """How far an axis is shown."""
    limit = windows[0][1]
    return UNLIMITED if limit >= FAR else min(MOST, max(1.0, BEYOND * limit))
