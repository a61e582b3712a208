"""The command that predicts and measures stability limits, and maps growth over a plane: stability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reference.errors import InputError
from reference.printable import printable
from report.commands.options import (
    dt_option,
    json_option,
    out_option,
    ranges_option,
    scene_argument,
    settings_option,
    steppers_option,
)
from report.commands.terminal import RESULTS, exit_if_files_failed, json_text, progress, show_result

if TYPE_CHECKING:
    from experiments.limits.limit_rows import Row


@click.command("stability")
@scene_argument
@steppers_option()
@settings_option
@click.option("--map", "axes", nargs=2, metavar="X Y", help="Map growth over two of dt, masses, damping, stiffness ...")
@dt_option
@ranges_option
@json_option
@out_option(RESULTS / "stability")
def stability_command(
    scene: str,
    names: tuple[str, ...],
    settings: Mapping[str, str],
    axes: tuple[str, str] | None,
    dt: float | None,
    ranges: Mapping[str, tuple[float, float]],
    as_json: bool,
    out: Path,
) -> None:
    """Predict and measure the largest stable dt of steppers on SCENE, about its equilibrium; or map growth.

    Without --set damping or drag, as it is, and in the cases the report shows, where SCENE has such a parameter:
    damping 0.1 and 0.5, drag 0.1 N s/m.
    --dt is the step of a map that has no dt axis.
    """
    without = [word for word, given in (("--dt", dt is not None), ("--range", bool(ranges))) if given and not axes]
    if without:
        raise InputError(f"{' and '.join(without)}: expected with --map X Y only")
    if axes:
        _write_maps(scene, settings, dt, axes, ranges, names or ("heun",), out)
    else:
        rows = _limits(scene, settings, names)
        _write_limits(rows, as_json, out)
        exit_if_files_failed((row.kind, row.outcome) for row in rows)


def _limits(scene: str, settings: Mapping[str, str], names: Sequence[str]) -> list[Row]:
    """The limits of steppers of these names, or of all that theory knows on springs."""
    from experiments.limits.limit_rows import stability_rows_of
    from experiments.runs.steppers import find_steppers, steppers_here
    from reference.files.setup import setup_for

    known = steppers_here().values()
    steppers = find_steppers(names) if names else [s for s in known if s.kind not in ("lecture", "pendulum")]
    systems = [setup_for(scene, settings={**settings, **case}).system for case in cases(scene, settings)]
    with progress("stability") as tell:
        return stability_rows_of(systems, steppers, [tell] * len(systems))


def cases(scene: str, settings: Mapping[str, str]) -> list[dict[str, str]]:
    """What is set besides: damping and drag as the report has them, as far as a scene has parameters of that name."""
    from experiments.stability import CASES
    from reference.files.setup import is_file
    from reference.scenes import find

    if is_file(scene) or {"damping", "drag"} & settings.keys():
        return [{}]
    known = find(scene).parameters.keys()
    return [{key: str(value) for key, value in case.items()} for case in CASES if case.keys() <= known]


def _write_limits(rows: Sequence[Row], as_json: bool, out: Path) -> None:
    """Tables and a figure into a folder; what was found on standard output."""
    from experiments.experiment import write_tables
    from experiments.stability import EXPERIMENT, result_of
    from report.figures import draw

    result = result_of(rows)
    written = [*write_tables(result, out), out / "stability.svg"]
    written[-1].write_text(draw("stability", result).svg(), encoding="utf-8")
    if as_json:
        click.echo(json_text([row.document for row in rows]))
        return
    show_result(EXPERIMENT, result)
    click.echo(printable(f"written: {', '.join(map(str, written))}"))


def _write_maps(
    scene: str,
    settings: Mapping[str, str],
    dt: float | None,
    names: tuple[str, str],
    ranges: Mapping[str, tuple[float, float]],
    steppers: Sequence[str],
    out: Path,
) -> None:
    """A map of each stepper, as a figure and as CSV, into a folder."""
    from experiments.limits.map_axes import axes_for, system_maker
    from experiments.limits.stability_map import stability_map, write_map
    from experiments.runs.steppers import find_steppers
    from report.figures.stability_map import draw_map

    found = find_steppers(steppers)
    system_at, step = system_maker(scene, settings, dt)
    x, y = axes_for(names, ranges, system_at({}))
    out.mkdir(parents=True, exist_ok=True)
    for stepper in found:
        with progress(f"map of {stepper.name}") as tell:
            made = stability_map(stepper, system_at, step, x, y, tell)
        name = f"{stepper.name}-{x.name}-{y.name}"
        (out / f"{name}.svg").write_text(draw_map(made).svg(), encoding="utf-8")
        write_map(made, out / f"{name}.csv")
        click.echo(printable(f"written: {out / name}.svg, {out / name}.csv"))
