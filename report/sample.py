"""The small sample report that is kept in the project: `python -m report.sample` writes report/sample/index.html."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from experiments.experiment import find
from report.commands.runner_options import STORE, chosen_runner
from report.commands.terminal import progress
from report.page.page import page
from report.page.sections import all_sections

SAMPLE = Path(__file__).parent / "sample" / "index.html"

#: What it shows: the first figure, the slides' listings, and the limit of stiff springs.
NAMES = ("divergence", "errata", "stiff_limit")


def main() -> None:
    """Write the page, without the downloads that a report carries."""
    with tempfile.TemporaryDirectory() as folder, chosen_runner(True, STORE), progress("sample") as tell:
        sections = all_sections([find(name) for name in NAMES], Path(folder), tell, STORE)
    SAMPLE.parent.mkdir(exist_ok=True)
    SAMPLE.write_text(page([replace(section, downloads=()) for section in sections]), encoding="utf-8")


if __name__ == "__main__":
    main()
