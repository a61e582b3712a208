"""The command between k and c in SI units and what engines call them: translate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import click

from reference.errors import InputError
from report.commands.options import json_option
from report.commands.terminal import json_text, progress, show_lines, show_table

#: Of k and c, as parts of the larger of them, what is rounding.
ROUNDING = 1e-12

if TYPE_CHECKING:
    from engines.translation.translation import Spring, Translation
    from experiments.translation.rows import Row


@click.command("translate")
@click.argument("words", nargs=-1, metavar="[SCENE] | [SETTING=VALUE]...")
@click.option("--stiffness", type=float, metavar="K", help="Stiffness of the spring [N/m].")
@click.option("--damping", type=float, metavar="C", help="Damping along the spring [N s/m]; 0 where left out.")
@click.option("--mass", type=float, metavar="M", help="Mass on the spring [kg]; 1 where left out.")
@click.option("--mass-b", "other", type=float, metavar="M2", help="Mass at its other end [kg]; fixed where left out.")
@click.option("--dt", type=float, help="Step [s]; 1/60, or the scene's own, where left out.")
@click.option("--substeps", type=int, help="Sub-steps, where an engine has them to set; its own where left out.")
@click.option("--iterations", type=int, help="Iterations, likewise.")
@click.option("--engine", "names", multiple=True, metavar="NAME", help="These only.")
@click.option("--from", "source", metavar="NAME", help="What SETTING=VALUE... of this engine mean.")
@click.option("--predict", is_flag=True, help="Predict only: run no engine.")
@json_option
def translate_command(
    words: tuple[str, ...],
    stiffness: float | None,
    damping: float | None,
    mass: float | None,
    other: float | None,
    dt: float | None,
    substeps: int | None,
    iterations: int | None,
    names: tuple[str, ...],
    source: str | None,
    predict: bool,
    as_json: bool,
) -> None:
    """Say what to type into engines for a spring of k and c, or for the springs of SCENE; with --from, the reverse.

    Of each: the stiffness and damping that it really has at this dt, predicted from the matrix of its step, and
    measured by a run of the snippet where the engine is installed; the largest stable dt, for the spring alone.
    As in: springlab translate --from box2d hertz=4 damping_ratio=0.7
    """
    from engines.translation.translation import Stepping, find

    if source is None:
        rows = _forward(words, (stiffness, damping, mass, other), (dt, substeps, iterations), names, not predict)
    else:
        from experiments.translation.rows import backward

        if stiffness is not None or damping is not None or names:
            raise InputError("--from: expected no --stiffness, --damping or --engine beside it")
        translation = find(source)
        translation, typed = _typed(translation, words)
        stepping = Stepping(1 / 60 if dt is None else dt, substeps, iterations)
        rows = [backward(translation, typed, _spring(1.0, 0.0, mass, other), stepping, not predict)]
    if as_json:
        click.echo(json_text([row.document for row in rows]))
        return
    _show(rows, bool(source) or len(rows) == 1)


def _forward(
    words: Sequence[str],
    numbers: tuple[float | None, float | None, float | None, float | None],
    steps: tuple[float | None, int | None, int | None],
    names: Sequence[str],
    measure: bool,
) -> list[Row]:
    """Rows of a spring, or of a scene's."""
    from engines.translation.translation import Stepping, find
    from experiments.translation.rows import forward

    chosen = [find(name) for name in names]
    stiffness, damping, mass, other = numbers
    dt, substeps, iterations = steps
    if words:
        from experiments.translation.scene_rows import rows_of_scene
        from reference.files.setup import setup_for

        if len(words) > 1 or any(number is not None for number in numbers):
            raise InputError("translate: expected SCENE alone, or --stiffness K --mass M, or --from NAME SETTING=VALUE")
        setup = setup_for(words[0], dt)
        with progress("translate") as tell:
            return rows_of_scene(setup.system, Stepping(setup.dt, substeps, iterations), chosen, tell, measure)
    if stiffness is None:
        raise InputError("translate: expected SCENE, or --stiffness K --mass M, or --from NAME SETTING=VALUE...")
    spring = _spring(stiffness, damping or 0.0, mass, other)
    with progress("translate") as tell:
        tell("springs")
        return forward(spring, Stepping(1 / 60 if dt is None else dt, substeps, iterations), chosen, measure)


def _spring(stiffness: float, damping: float, mass: float | None, other: float | None) -> Spring:
    from engines.translation.translation import Spring

    return Spring(stiffness, damping, 1.0 if mass is None else mass, other)


def _typed(translation: Translation, words: Sequence[str]) -> tuple[Translation, Mapping[str, float]]:
    """What was typed: numbers by name, or several to a name (solref="0.02 1"), which has a translation of its own."""
    from engines.translation.translation import find, translations

    typed: dict[str, float] = {}
    for word in words:
        name, _, text = word.partition("=")
        try:
            values = [float(number) for number in text.replace(",", " ").split()]
        except ValueError:
            values = []
        if not values:
            raise InputError(f"{word!r}: expected SETTING=NUMBER, or numbers as in solref=0.02,1")
        if name == "solref" and len(values) != 2:
            raise InputError(f"{word!r}: expected two numbers, as in solref=0.02,1")
        names = [name] if len(values) == 1 else [f"{name}_{i}" for i in range(len(values))]
        typed |= dict(zip(names, values, strict=True))
    for other in translations().values():
        related = other.name.startswith(f"{translation.name}_")
        if related and typed and not set(typed) <= set(translation.fields) and set(typed) <= set(other.fields):
            return find(other.name), typed
    return translation, typed


def _show(rows: Sequence[Row], whole: bool) -> None:
    """What to type, and what that is, each in a table; all there is to say; of a single row the snippet."""
    wanted = {row.wanted for row in rows}
    title = "".join(f"meant: k = {k:.6g} N/m, c = {c:.6g} N s/m" for k, c in wanted) if len(wanted) == 1 else ""
    lines = [
        (row.engine if first else "", f"{name}={value:.6g}")
        for row in rows
        for name, value, first in zip(row.settings, row.settings.values(), (True, *[False] * 9), strict=False)
    ]
    show_table(title, ["engine", "type"], lines)
    measured = any(row.measured for row in rows)
    columns = ["k predicted", "c predicted", *(["k measured", "c measured"] if measured else [])]
    cells = []
    for row in rows:
        springs = [row.effective, *([row.measured] if measured else [])]
        limit = "none" if row.largest_stable_dt is None else f"{row.largest_stable_dt:.4g}"
        cells.append([row.engine, *(text for spring in springs for text in _numbers(spring, row.wanted)), limit])
    show_table("", ["engine", *columns, "largest stable dt [s]"], cells)
    show_lines([f"{row.engine}, {row.title}" + (f": {row.reason}" if row.reason else "") for row in rows])
    if whole and rows[0].snippet:
        click.echo(f"\n{rows[0].snippet}")


def _numbers(spring: tuple[float, float] | None, wanted: tuple[float, float]) -> tuple[str, str]:
    """Stiffness and damping; rounding is no damping, and no stiffness."""
    if spring is None:
        return "-", "-"
    small = ROUNDING * max(*map(abs, spring), *wanted)
    stiffness, damping = (0.0 if abs(q) < small else q for q in spring)
    return f"{stiffness:.5g}", f"{damping:.4g}"
