"""How far each scheme of the catalogue is from a stepper, and up to where one is named."""

from __future__ import annotations

from reference.errors import InputError
from reference.identification import Identification
from report.figures import COLOURS, IDENTIFIED, MEASURED, SMALL, TITLE, Picture, from_nothing, new_figure

#: So many schemes are drawn, the nearest; and where no difference at all is drawn [m].
MOST, FLOOR = 15, 1e-18


def draw(found: Identification) -> Picture:
    """A ring for each scheme that does the same to rounding, a dot for each that does not; the tolerance as a line.

    Raises:
        InputError: where nothing could be compared.
    """
    if not found.ranking:
        raise InputError(f"nothing to plot of {found.stepper}: {found.reason}")
    shown = found.ranking[:MOST]
    errors = [match.error for match in shown]
    largest = max((e for e in errors if e < float("inf")), default=1.0)
    beyond = 10 * largest or 1.0  # where what is infinitely far is drawn
    figure, axes = new_figure(figsize=(8, 1.2 + 0.28 * len(shown)))
    axes.set_xscale("log")
    for y, error in enumerate(errors):
        same = error <= found.tolerance
        look = IDENTIFIED if same else MEASURED
        axes.plot(min(max(error, FLOOR), beyond), y, color=COLOURS[2 if same else 1], markersize=8, **look)
    axes.axvline(max(found.tolerance, FLOOR), color="#777777", linestyle="--", linewidth=1)
    axes.annotate(
        "named up to here ",
        (max(found.tolerance, FLOOR), -0.75),
        fontsize=SMALL,
        color="#555555",
        ha="right",
        va="center",
    )
    axes.set_yticks(range(len(shown)), [match.scheme for match in shown])
    axes.set_ylim(len(shown) - 0.5, -1.2)
    axes.set_xlim(FLOOR / 3, max(3 * beyond, 10 * found.tolerance, 1e-2))
    from_nothing(axes.xaxis, FLOOR)
    axes.set_xlabel("largest distance in a step [m]" if found.by_single_steps else "largest distance [m]")
    axes.set_title(f"{found.stepper}: its distance from schemes of the catalogue", fontsize=TITLE, loc="left")
    each = (f"{match.scheme}: {match.error:.1e} m" for match in shown)
    return Picture(figure, f"{found}. {'; '.join(each)}.")
