"""The equations of schemes that engines were identified as, from the schemes' own definitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reference.schemes.catalogue import schemes
from report.figures.overview import Explained
from report.site.linear_form import NotLinear
from report.site.mathml import of_equations
from report.site.solved_form import equations_of


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

    Those that are no sums, as with dampers that are implicit while springs are not, are left out; so are those with
    rods for springs.
    """
    shown = []
    for name, scheme in schemes().items():
        here = [engine.engine for engine in engines if engine.scheme == name]
        if not here and scheme.kind != "scheme":
            continue
        try:
            text = of_equations(equations_of(scheme))
        except NotLinear:
            continue
        shown.append(Shown(name, scheme.summary, scheme.order, here, text))
    return shown
