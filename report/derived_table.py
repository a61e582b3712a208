"""The page of what is derived of every scheme and engine, beside the catalogue: `python -m report.derived_table`.

Derived from steps alone, and held against what the catalogue has: for a scheme the step matrix that theory makes of its
own function on linearised equations, and the order it declares; for an engine the schemes that it claims to be.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from engines.engine import registry
from reference.derivation.oscillators import oscillator, runs_of
from reference.derivation.seen import Seen, slopes_of, tried
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.errors import InputError, SolverError, Unsupported
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.stepper import SchemeStepper
from reference.theory.equilibria import spring_equilibrium
from reference.theory.oscillators import step_matrices
from reference.theory.step_map import step_jacobian
from report.page.derived_formulas import FILE as OF_ENGINES

FILE = Path(__file__).parent / "docs" / "derived.md"

#: What stands above the tables.
HEAD = """# What is derived of every scheme and engine

Written by `python -m report.derived_table` and `python -m report.page.derived_formulas`; nothing here is typed by hand.
Derived means: from steps alone, as by `springlab explain`; a = h^2 k/m, b = h c/m, d = h Cd/m, E = exp(-b),
D = exp(-d), and m11 to m22 multiply (x, h v). Of a method that asks for slopes its tableau or update formulas are shown
instead. The last column holds step matrices against those that theory makes of the scheme's own function. One mass does
not show all: what `heun_aliased` does to a chain lowers its order there, which is the declared one.

"""

#: What is said of the engines that are not in the table.
NONE = "Of these there is none here: springs are rods to them, they know no single spring, or they are apart:"

#: Oscillators at which matrices are held against one another; how near they have to be, and those of differences.
A, B, D, SAME, NEAR = (0.7, 1.9), (0.2, 0.9), 0.3, 1e-9, 1e-6


def schemes() -> Mapping[str, Scheme]:
    """All on springs: those that identification tries, the wide catalogue, solvers of constraints."""
    return {**catalogue.schemes(), **catalogue.wide_schemes(), **catalogue.constraint_schemes()}


def row_of(name: str) -> list[str]:
    """A scheme's: what is derived, its order as derived and as declared, and whether it is the catalogue's."""
    scheme = schemes()[name]
    stepper = SchemeStepper(scheme)
    reasons: list[str] = []
    seen = slopes_of(stepper, reasons)
    matrix = tried(lambda: step_matrix(runs_of(stepper)), reasons, "")
    order = seen.tableau.order if seen.tableau else seen.multistep.order if seen.multistep else None
    if order is None and matrix is not None and scheme.one_step:
        from reference.derivation.consequences import order_of

        order = order_of(matrix, False, False)
    derived = _written(seen, matrix) or "; ".join(reasons)
    return [f"`{name}`", derived, "-" if order is None else str(order), str(scheme.order), _same(scheme, matrix)]


def _written(seen: Seen, matrix: StepMatrix | None) -> str:
    if seen.tableau is not None:
        text = seen.tableau.text()
        stages = range(seen.tableau.stages)
        a = [f"a{i + 1}{j + 1} = {text['a'][i][j]}" for i in stages for j in stages if seen.tableau.a[i][j]]
        return "; ".join([f"c = ({', '.join(map(str, text['c']))})", *a, f"b = ({', '.join(map(str, text['b']))})"])
    if seen.multistep is not None:
        return str(seen.multistep)
    if seen.updates is not None:
        from reference.derivation.updates import in_words

        return "; ".join(in_words(seen.updates))
    if matrix is None:
        return ""
    return "; ".join(
        f"m{i}{j} = {entry}" for (i, j), entry in zip(((1, 1), (1, 2), (2, 1), (2, 2)), matrix.entries, strict=True)
    )


def _same(scheme: Scheme, matrix: StepMatrix | None) -> str:
    """Whether the matrix is that of theory, at some oscillators; why it was not held against that, where it was not."""
    if matrix is None:
        return "no step matrix"
    if not (scheme.linear or scheme.one_step):
        return "theory's has what it remembers in it"
    for a, b in zip(A, B, strict=True):
        at = a, b * matrix.damped, D * matrix.dragged
        try:
            expected = _by_theory(scheme, *at)
        except (Unsupported, InputError, SolverError) as error:
            return f"theory has no matrix of it: {error}"
        if np.abs(matrix.at(*(np.array([value]) for value in at))[0] - expected).max() > (
            SAME if scheme.linear else NEAR
        ):
            return "**no**"
    return "yes"


def _by_theory(scheme: Scheme, a: float, b: float, d: float) -> Array:
    """The step matrix of x'' = -(k x + (c + Cd) x')/m: of linearised equations, or by differences about the rest."""
    h = 0.5
    if scheme.linear:
        return step_matrices(scheme, h, np.ones(1), np.array([a / h**2]), np.array([b / h]), d / h)[0]
    rest = spring_equilibrium(oscillator(a, b, d, dt=h))
    return step_jacobian(scheme, rest, h)


def engine_rows() -> Iterator[list[str]]:
    """What is kept of engines (`report.page.derived_formulas`), with the schemes that have the same formulas."""
    for name, kept in json.loads(OF_ENGINES.read_text(encoding="utf-8")).items():
        same = ", ".join(f"`{scheme}`" for scheme in kept["same_as"]) or "**none**"
        yield [f"`{name}` {kept['version']}", "; ".join(kept["lines"]), same]


def page() -> str:
    """The whole page."""
    head = ["scheme", "derived", "order derived, without damping", "order declared", "the same as the catalogue's"]
    parts = [HEAD, "## Schemes\n", *_table(head, [row_of(name) for name in schemes()])]
    parts += ["\n## Engines\n", *_table(["engine", "derived", "the same as its claim"], list(engine_rows()))]
    missing = [f"`{name}`" for name in registry() if name not in json.loads(OF_ENGINES.read_text(encoding="utf-8"))]
    parts += ["", NONE, "", ", ".join(missing) + "."]
    return "\n".join(parts) + "\n"


def _table(head: list[str], rows: list[list[str]]) -> list[str]:
    return [line_of(head), "|" + " --- |" * len(head), *map(line_of, rows)]


def line_of(cells: list[str]) -> str:
    """A row of the page."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


if __name__ == "__main__":
    with np.errstate(all="ignore"):
        FILE.write_text(page(), encoding="utf-8")
