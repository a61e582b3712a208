"""The report: every experiment's answer on one self-contained HTML page."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from experiments.comparison import Progress
from experiments.console import plain
from experiments.environment import environment
from experiments.experiment import Experiment, Result, write_tables
from report.figures import draw


@dataclass(frozen=True)
class Section:
    """One experiment on the page: its answer, or why there is none."""

    experiment: Experiment
    result: Result | None = None
    svg: str = ""
    alt: str = ""
    downloads: Sequence[tuple[str, str]] = ()
    failure: str = ""


def section(experiment: Experiment, folder: Path, progress: Progress) -> Section:
    """Run an experiment and draw it, leaving its figure and tables in a folder. Its failure is its section's only."""
    try:
        result = experiment.run(progress)
        picture = draw(experiment.name, result)
        files = write_tables(result, folder)
        svg = picture.svg()
        (folder / f"{experiment.name}.svg").write_text(svg, encoding="utf-8")
    except OSError:
        raise
    except Exception as error:
        return Section(experiment, failure=f"{type(error).__name__}: {error}")
    return Section(experiment, result, svg, picture.alt, [(file.name, _embedded(file)) for file in files])


def page(sections: Sequence[Section]) -> str:
    """The whole page as HTML that asks for nothing from anywhere."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    templates = Environment(loader=PackageLoader("report"), autoescape=True, undefined=StrictUndefined)
    templates.filters["plain"] = plain
    return templates.get_template("page.html.j2").render(sections=sections, environment=environment())


def _embedded(file: Path) -> str:
    """A file as a link that carries it."""
    return "data:text/csv;base64," + base64.b64encode(file.read_bytes()).decode()
