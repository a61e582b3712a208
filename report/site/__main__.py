"""Write the site: pages from report/docs, README, CONTRIBUTING and CHANGELOG, and those made from the project."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import click

from report.browser.lab_page import lab_page
from report.browser.presets import PRESETS
from report.commands.terminal import RESULTS, in_one_line, say
from report.site.accessible import mend
from report.site.generated import PAGES
from report.site.sources import write_sources

HERE = Path(__file__).parent


def build(out: Path, *, notebooks: bool = True) -> int:
    """Make the site in a folder, which is emptied first; a warning, as of a link that leads nowhere, is an error.

    Args:
        notebooks: whether they are run; else they are shown without what comes out of them.

    Returns:
        Sphinx's exit code.
    """
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder)
        write_sources(source)
        for name, page in PAGES.items():
            (source / f"{name}.md").write_text(page(), encoding="utf-8")
        shutil.rmtree(out, ignore_errors=True)
        words = ["-q", "-W", "--keep-going", "-b", "html", "-c", str(HERE), "-d", str(source / ".doctrees")]
        words += [] if notebooks else ["-D", "nb_execution_mode=off"]
        code = subprocess.run([sys.executable, "-m", "sphinx", *words, str(source), str(out)]).returncode
    mend(out)
    return code


@click.command()
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS / "docs", show_default=True)
@click.option("--notebooks/--no-notebooks", default=True, help="Run them, or show them as they are.")
def main(out: Path, notebooks: bool) -> None:
    """Write the documentation as a site into a folder, with the lab for a browser beside it, lab.html."""
    code = 0

    def made() -> None:
        nonlocal code
        code = build(out, notebooks=notebooks)
        if code == 0:
            (out / "lab.html").write_text(lab_page(PRESETS), encoding="utf-8")

    code = in_one_line(made) or code
    if code == 0:
        say(f"written: {out / 'index.html'}")
    sys.exit(code)


if __name__ == "__main__":
    main()
