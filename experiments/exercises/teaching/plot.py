"""A small plot of where an answer differs from the right one: in the terminal, and as a PNG."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np

from experiments.exercises.teaching.writing import write_anew
from experiments.exercises.verdict.first_difference import Lines

#: Columns and rows of the plot in the terminal.
WIDTH, HEIGHT = 56, 9

#: Marks in the terminal: right, given, both in one place.
RIGHT, GIVEN, BOTH = "o", "x", "*"


def magnified(lines: Lines) -> Lines:
    """The numbers; or, where the two lie less than a row apart, what is left when the right ones are taken off."""
    count = min(len(lines.right), len(lines.given))
    left = lines.given[:count] - lines.right[:count]
    low, high = _range(lines)
    if not np.isfinite(left).all() or np.abs(left).max() > (high - low) / (HEIGHT - 1):
        return lines
    return Lines(lines.over, f"yours less expected, of {lines.what}", np.zeros(count), left)


def in_terminal(lines: Lines) -> str:
    """The plot, as text."""
    lines = magnified(lines)
    low, high = _range(lines)
    grid = [[" "] * WIDTH for _ in range(HEIGHT)]
    count = max(len(lines.right), len(lines.given))
    for numbers, mark in ((lines.right, RIGHT), (lines.given, GIVEN)):
        for i, number in enumerate(numbers.tolist()):
            if np.isfinite(number) and low <= number <= high:
                column = round(i / max(1, count - 1) * (WIDTH - 1))
                row = HEIGHT - 1 - round((number - low) / (high - low) * (HEIGHT - 1))
                grid[row][column] = mark if grid[row][column] in (" ", mark) else BOTH
    first = 1 if lines.over == "step" else 0
    labels = [f"{high:>10.3g} |", *[" " * 10 + " |"] * (HEIGHT - 2), f"{low:>10.3g} |"]
    text = [f"{lines.what}   {RIGHT} expected  {GIVEN} yours  {BOTH} both"]
    text += [label + "".join(row).rstrip() for label, row in zip(labels, grid, strict=True)]
    axis = f"{first}".ljust(WIDTH - len(str(count - 1 + first))) + f"{count - 1 + first}"
    return "\n".join([*text, " " * 11 + "+" + "-" * WIDTH, " " * 12 + f"{axis}  {lines.over}"])


def as_png(lines: Lines, file: Path, title: str) -> None:
    """The plot, as a picture, in a file that is made anew."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    lines = magnified(lines)
    figure = Figure(figsize=(6, 3.2), dpi=150, layout="constrained")
    axes = figure.subplots()
    first = 1 if lines.over == "step" else 0
    styles = (("expected", lines.right, "#0072B2", "o", "-"), ("yours", lines.given, "#D55E00", "s", "--"))
    low, high = _range(lines)
    for name, numbers, colour, marker, dash in styles:
        at = np.arange(first, first + len(numbers))
        axes.plot(at, numbers, color=colour, marker=marker, linestyle=dash, markersize=4, label=name)
    margin = 0.05 * (high - low)
    axes.set(xlabel=lines.over, ylabel=lines.what, title=title, ylim=(low - margin, high + margin))
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, loc="best")
    picture = BytesIO()
    figure.savefig(picture, format="png")
    write_anew(file, picture.getvalue())


def _range(lines: Lines) -> tuple[float, float]:
    """What is shown: all that is right, and of what was given as much as is not ten times as far away."""
    low, high = float(lines.right.min()), float(lines.right.max())
    # where nothing but zeros is right, all that was given is shown
    given = np.abs(lines.given[np.isfinite(lines.given)]).max(initial=1e-12)
    reach = max(high - low, 1e-3 * abs(high)) or float(given)
    near = lines.given[np.isfinite(lines.given) & (np.abs(lines.given - (low + high) / 2) < 10 * reach)]
    low, high = min([low, *near.tolist()]), max([high, *near.tolist()])
    return (low, high) if high > low else (low - reach, high + reach)
