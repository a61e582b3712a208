"""The parts of README.md that are made from the project: `python -m report.readme` writes table and pictures."""

from __future__ import annotations

import tempfile
from pathlib import Path

from engines.engine import Engine, registry, version
from engines.process.isolation import EngineStepper
from experiments.engine_versions.conformance import IDENTIFIED, identified
from experiments.experiment import find
from reference.errors import InputError
from reference.outcome import Outcome
from report.commands.runner_options import STORE, chosen_runner
from report.commands.terminal import progress
from report.page.overview import explained
from report.page.sections import all_sections

README = Path(__file__).parents[1] / "README.md"
BEGIN, END = "<!-- engines: written by `python -m report.readme` -->\n", "<!-- end of engines -->"

PICTURES = Path(__file__).parent / "pictures"


def engine_table() -> str:
    """The engines and the schemes they are identified with, as a Markdown table: each is run.

    Raises:
        InputError: where one is not installed.
    """
    rows = [engine_row(engine) for engine in registry().values()]
    return "\n".join(["| engine | undamped | damped springs | drag |", "| --- | --- | --- | --- |", *rows]) + "\n"


def engine_row(engine: Engine) -> str:
    """What short runs of an engine identify it as; "-" where it refuses, and why where it is nothing that is known.

    Raises:
        InputError: where it is not installed.
    """
    if version(engine) is None:
        raise InputError(f"engine {engine.name!r} is not installed: expected {engine.package}, as the table is of runs")
    return f"| `{engine.name}` | " + " | ".join(_cell(engine, case) for case in IDENTIFIED) + " |"


def _cell(engine: Engine, case: str) -> str:
    found = identified(EngineStepper(engine), case)
    if isinstance(found, Outcome):
        return "-" if found.ending == "unsupported" else found.ending
    return f"`{found.identified_as}`" if found.identified_as else "not identified"


def with_engine_table(text: str) -> str:
    """README's text with the table between its two marks."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{engine_table()}\n{END}{after}"


def write_pictures() -> None:
    """The report's first figure, and its maps: what is kept of them from the last report, else made now."""
    from report.figures.overview import draw

    asked = [find("divergence"), find("maps")]
    with tempfile.TemporaryDirectory() as folder, chosen_runner(True, STORE), progress("pictures") as tell:
        divergence, maps = all_sections(asked, Path(folder), tell, STORE)
    (PICTURES / "found.svg").write_text(draw(explained(divergence)).svg(), encoding="utf-8")
    (PICTURES / "maps.svg").write_text(maps.svg, encoding="utf-8")


if __name__ == "__main__":
    README.write_text(with_engine_table(README.read_text(encoding="utf-8")), encoding="utf-8")
    write_pictures()
