"""The report as one self-contained HTML page: what was found, then everything that was asked and what it rests on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from engines.engine import installed_version, registry
from experiments.console import plain
from experiments.environment import environment
from report import overview
from report.cards import packages
from report.figures import Picture
from report.inline_svg import dark_colours, inline
from report.overview import Explained, explained
from report.sections import Section

#: So many findings are shown, and a table of so many rows is open; more is folded.
FINDINGS, ROWS = 2, 12


@dataclass(frozen=True)
class Undone:
    """What an experiment could not do, and why."""

    experiment: str
    title: str
    reasons: Sequence[str]


def page(sections: Sequence[Section]) -> str:
    """The whole page as HTML that asks for nothing from anywhere."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    templates = Environment(
        loader=PackageLoader("report"), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    templates.filters["plain"] = plain
    engines = explained(next((section for section in sections if section.experiment.name == "divergence"), None))
    html = templates.get_template("page.html.j2").render(
        sections=sections,
        sentences=overview.sentences(sections),
        engines=engines,
        overview=_overview(engines),
        pictures={s.experiment.name: inline(s.svg, s.experiment.name, s.alt) for s in sections if s.svg},
        packages=packages(_identified(engines)),
        undone=_undone(sections),
        environment=_environment(),
        findings=FINDINGS,
        rows=ROWS,
    )
    dark = "".join(f"{name}: {value}; " for name, value in dark_colours(html))
    return html.replace("/* greys and series in the dark */", dark)


def _overview(engines: Sequence[Explained]) -> str:
    """The first figure, where there is something to draw."""
    if not engines:
        return ""
    from report.figures.overview import draw

    picture: Picture = draw(engines)
    return inline(picture.svg(), "overview", picture.alt)


def _identified(engines: Sequence[Explained]) -> Mapping[str, str]:
    return {
        engine.engine: f"{engine.scheme}, to {engine.deviation:.1e} m"
        if engine.scheme
        else "no scheme of the catalogue"
        for engine in engines
    }


def _undone(sections: Sequence[Section]) -> list[Undone]:
    """Everything that did not come to its end."""
    found = []
    for section in sections:
        failures = [section.failure] if section.result is None else section.result.failures
        if failures:
            found.append(Undone(section.experiment.name, section.experiment.title, failures))
    return found


def _environment() -> dict[str, str]:
    """What everything rests on, with all packages that engines come in."""
    names = sorted({engine.package for engine in registry().values()})
    return {**environment(), **{name: installed_version(name) or "not installed" for name in names}}
