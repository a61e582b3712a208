"""What was found, for people who read no further: three sentences and the numbers of one figure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from reference.stepper import stepper_named
from report.figures.overview import Explained
from report.page.section import Section

#: Units of length, the largest first [m]; what is shorter is rounding, and in powers of ten as everywhere on the page.
UNITS = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}


def explained(section: Section | None) -> list[Explained]:
    """The engines that ran, of the experiment `divergence`; none where that is missing or failed."""
    rows = records(section, "divergence")
    return [
        Explained(row["stepper"], row["identified as"] or None, row["error [m]"], row["deviation [m]"])
        for row in rows
        if row["kind"] == "engine"
        and row["outcome"] == "done"
        and row["error [m]"]
        and row["deviation [m]"] is not None
    ]


def sentences(sections: Sequence[Section]) -> list[str]:
    """Whether engines are explained, whether limits are as predicted, and what differs; or why that cannot be said.

    Of a page without the experiment `stability`, as the sample is, limits are left out.
    """
    found = {section.experiment.name: section for section in sections}
    limits = [_limits(found)] if "stability" in found or not found else []
    return [_explanation(found), *limits, _differences(found)]


def records(section: Section | None, table: str) -> list[dict[str, Any]]:
    """A table's rows by its columns; none where the section has no such table."""
    tables = section.result.tables if section is not None and section.result is not None else []
    return [dict(zip(found.columns, row, strict=True)) for found in tables if found.name == table for row in found.rows]


def _explanation(found: Mapping[str, Section]) -> str:
    engines = explained(found.get("divergence"))
    if not engines:
        return f"Whether engines are explained is not known: {_why_not(found, 'divergence', 'no engine ran')}."
    known = [engine for engine in engines if engine.scheme]
    strangers = ", ".join(engine.engine for engine in engines if not engine.scheme)
    if not known:
        return f"None of {len(engines)} engine settings is explained by a scheme of the catalogue: {strangers}."
    worst = max(engine.deviation for engine in known)
    count = f"All {len(engines)}" if not strangers else f"{len(known)} of {len(engines)}"
    but = f" Not explained: {strangers}." if strangers else ""
    return (
        f"{count} engine settings are explained: each moves a string as a scheme of a few lines does, to "
        f"{length(worst)} or better, which is rounding.{but}"
    )


def _limits(found: Mapping[str, Section]) -> str:
    differences = [
        abs(row["relative difference"])
        for row in records(found.get("stability"), "stability")
        if row["relative difference"] is not None
    ]
    if not differences:
        why = _why_not(found, "stability", "no limit was both predicted and measured")
        return f"Whether stability limits are as predicted is not known: {why}."
    return (
        f"Up to which step each of them stays stable follows from its scheme: {len(differences)} limits were predicted "
        f"and then measured, and they agree to {100 * max(differences):.1g} % or better."
    )


def _differences(found: Mapping[str, Section]) -> str:
    engines = [engine for engine in explained(found.get("divergence")) if engine.scheme]
    if not engines:
        return f"What differs between engines is not known: {_why_not(found, 'divergence', 'none is identified')}."
    on_rods = [engine for engine in engines if takes_springs_for_rods(engine)]
    on_springs = [engine for engine in engines if engine not in on_rods]
    if not on_springs:
        return "What differs between engines is not known: all that ran put rods for springs."
    best, worst = min(on_springs, key=_error), max(on_springs, key=_error)
    schemes = len({engine.scheme for engine in on_springs})
    furthest = max(map(_error, on_rods), default=0.0)
    rods = f"; with rods for its springs, as {len(on_rods)} have, up to {length(furthest)}"
    return (
        f"What differs is the scheme: with the same step, {len(on_springs)} settings with {schemes} schemes come from "
        f"within {length(best.error)} ({best.scheme}) to {length(worst.error)} ({worst.scheme}) of the string's true "
        f"motion{rods if on_rods else ''}."
    )


def length(metres: float) -> str:
    """A length as people say it, two figures and a unit; a power of ten where it is rounding."""
    for unit, size in UNITS.items():
        if metres >= 0.0999 * size:
            return f"{float(f'{metres / size:.2g}'):g} {unit}"
    return f"{metres:.1e} m"


def takes_springs_for_rods(engine: Explained) -> bool:
    """Whether the scheme an engine is identified as is one of rods: what it steps is not quite the string."""
    return engine.scheme is not None and stepper_named(engine.scheme).on_rods


def _error(engine: Explained) -> float:
    return engine.error


def _why_not(found: Mapping[str, Section], name: str, otherwise: str) -> str:
    if name not in found:
        return f"the experiment {name} is not on this page"
    failure = found[name].failure
    return f"the experiment {name} did not come to its end ({failure})" if failure else otherwise
