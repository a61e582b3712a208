"""The command that writes the lab as one file for a browser: page."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("page")
@click.argument("scenes", nargs=-1, metavar="[SCENE]...")
@click.option(
    "--record",
    "steppers",
    multiple=True,
    metavar="NAME",
    help="Record a stepper on every SCENE, as an engine that no browser runs, to be laid over the page's own lanes.",
)
@click.option(
    "--with",
    "engines",
    multiple=True,
    metavar="NAME",
    help="Carry an engine that is WebAssembly, to be stepped in the page: jolt_soft_body, jolt_soft_body_once.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False),
    default=Path("lab.html"),
    show_default=True,
    help="The file.",
)
@click.option("--open", "show", is_flag=True, help="Open it in the browser.")
def page_command(
    scenes: tuple[str, ...], steppers: tuple[str, ...], engines: tuple[str, ...], out: Path, show: bool
) -> None:
    """Write the lab as one file that runs in a browser, with nothing installed and nothing asked for.

    SCENE is a name or a TOML file; left out, the lecture's scenes.
    """
    from reference.errors import InputError
    from report.browser.lab_page import lab_page
    from report.browser.presets import PRESETS, Preset
    from report.browser.recordings import Recording

    recordings = tuple(Recording(name) for name in steppers)
    presets = [Preset(scene, recordings=recordings) for scene in dict.fromkeys(scenes)] or PRESETS
    if recordings and not scenes:
        raise InputError("--record is of scenes that are named: expected a SCENE with it")
    text = lab_page(presets, engines)
    out.write_text(text, encoding="utf-8")
    click.echo(f"written: {out} ({len(text.encode()) / 1e6:.2f} MB)")
    if show:
        import webbrowser

        webbrowser.open(out.resolve().as_uri())
