"""The report as one self-contained HTML page: what was found, then everything that was asked and what it rests on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from engines.engine import available_version, registry
from experiments.runs.environment import environment
from report.browser.beside import BESIDE
from report.figures import Picture
from report.figures.overview import Explained
from report.page import overview
from report.page.engine_cards import Package, packages
from report.page.inline_svg import dark_colours, inline
from report.page.overview import explained
from report.page.scheme_equations import Shown, scheme_equations
from report.page.section import Section
from report.plain import plain

#: Findings that are shown, and rows of a table that is open; more is folded.
FINDINGS, ROWS = 2, 12

#: Of the first figure's table.
ENGINE_COLUMNS = (
    "engine setting",
    "identified as",
    "measured: from the true motion [m]",
    "identified: from its scheme [m]",
)


@dataclass(frozen=True)
class Undone:
    """What an experiment could not do, and why."""

    experiment: str
    title: str
    reasons: Sequence[str]


@dataclass(frozen=True)
class First:
    """The first screen: a title, what the page is about, sentences, a figure and its table, to be downloaded too."""

    title: str
    lead: str
    sentences: Sequence[str]
    caption: str
    picture: str
    columns: Sequence[str]
    rows: Sequence[Sequence[object]]
    above: int = 3  # sentences, before the figure
    made_by: str = ""
    downloads: Sequence[tuple[str, str]] = ()


def page(sections: Sequence[Section], lab: str = "") -> str:
    """The report of experiments as HTML that asks for nothing from anywhere.

    Args:
        lab: the file of the lab in a browser that stands beside it, to be linked; empty where there is none.
    """
    engines = explained(next((section for section in sections if section.experiment.name == "divergence"), None))
    first = First(
        "springlab report",
        "The lab that explains physics engines: it finds the scheme that each one steps by.",
        overview.sentences(sections),
        "what is left of an engine's error once its scheme is known",
        _overview(engines),
        ENGINE_COLUMNS,
        [[engine.engine, engine.scheme, engine.error, engine.deviation] for engine in engines],
    )
    return _rendered(first, sections, sections, packages(_identified(engines)), lab, scheme_equations(engines))


def scene_page(name: str, sections: Sequence[Section]) -> str:
    """The report of a user's own scene: what its first section says, then the others."""
    advice, *others = sections
    result = advice.result
    failed = f"Which dt to use is not known: {advice.failure}."
    first = First(
        f"{name}: which dt",
        f"springlab on the scene {name}: up to which step each engine is stable on it, predicted and measured.",
        [failed] if result is None else result.findings,
        "largest stable steps of engines, and the scene's own",
        inline(advice.svg, advice.experiment.name, advice.alt) if advice.svg else "",
        [] if result is None else result.tables[0].columns,
        [] if result is None else result.tables[0].rows,
        above=1,
        made_by=advice.command,
        downloads=advice.downloads,
    )
    known = {row["engine"]: row["identified as"] for row in overview.records(advice, "advice") if row["identified as"]}
    return _rendered(first, others, sections, packages(known))


def _rendered(
    first: First,
    shown: Sequence[Section],
    sections: Sequence[Section],
    cards: Sequence[Package],
    lab: str = "",
    schemes: Sequence[Shown] = (),
) -> str:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    templates = Environment(
        loader=PackageLoader("report"), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    templates.filters["plain"] = plain
    html = templates.get_template("page.html.j2").render(
        first=first,
        sections=shown,
        pictures={s.experiment.name: inline(s.svg, s.experiment.name, s.alt) for s in shown if s.svg},
        packages=cards,
        schemes=schemes,
        undone=_undone(sections),
        environment=_environment(),
        script=_script() if any(section.motions for section in shown) else "",
        beside=BESIDE if lab else {},
        lab=lab,
        findings=FINDINGS,
        rows=ROWS,
    )
    dark = "".join(f"{name}: {value}; " for name, value in dark_colours(html))
    return html.replace("/* greys and series in the dark */", dark)


def _script() -> str:
    from report.film.animations import SCRIPT

    return SCRIPT


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
    return {**environment(), **{name: available_version(name) or "not installed" for name in names}}
