"""The equations of schemes that engines were identified as, from the schemes' own definitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reference.compiled.tracing import trace
from reference.errors import Unsupported
from reference.schemes.catalogue import schemes
from report.figures.overview import Explained
from report.site.linear_form import NotLinear, equations
from report.site.mathml import of_equations


@dataclass(frozen=True)
class Shown:
    """A scheme on the page.

    Attributes:
        name: the catalogue's.
        summary: what it is.
        order: predicted.
        engines: that were identified as it.
        equations: of a step, as MathML.
    """

    name: str
    summary: str
    order: int
    engines: Sequence[str]
    equations: str


def scheme_equations(engines: Sequence[Explained]) -> list[Shown]:
    """Those of the textbook's schemes that are sums, and of all that an engine was identified as.

    Schemes that solve equations in a step have no such row of sums, and are left out; so are those with rods for
    springs.
    """
    shown = []
    for name, scheme in schemes().items():
        here = [engine.engine for engine in engines if engine.scheme == name]
        if not here and scheme.kind != "scheme":
            continue
        try:
            text = of_equations(equations(trace(scheme)))
        except (Unsupported, NotLinear):
            continue
        shown.append(Shown(name, scheme.summary, scheme.order, here, text))
    return shown
