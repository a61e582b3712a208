"""The page of what is derived of every scheme and engine, beside the catalogue: `python -m report.derived_table`.

Derived from steps alone, and held against what the catalogue has: for a scheme the step matrix that theory makes of its
own function on linearised equations, and the order it declares; for an engine the schemes that it claims to be.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from engines.engine import registry
from reference.derivation.consequences import order_of
from reference.derivation.difference_equation import DifferenceEquation, difference_equation
from reference.derivation.explanation import Explanation
from reference.derivation.oscillators import oscillator, runs_of
from reference.derivation.pasts import pasts
from reference.derivation.seen import Seen, slopes_of, tried
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.errors import InputError, SolverError, Unsupported
from reference.identification import Identification
from reference.lecture.listings import listings
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.stepper import SchemeStepper, Stepper, catalogued, stepper_named
from reference.theory.equilibria import spring_equilibrium
from reference.theory.oscillators import step_matrices
from reference.theory.step_map import step_jacobian
from report.derived import difference_lines, matrix_lines
from report.page.derived_formulas import FILE as OF_ENGINES

FILE = Path(__file__).parent / "docs" / "derived.md"

#: What stands above the tables.
HEAD = """# What is derived of every scheme and engine

Written by `python -m report.derived_table` and `python -m report.page.derived_formulas`; nothing here is typed by hand.
Derived means: from steps alone, as by `springlab explain`; a = h^2 k/m, b = h c/m, d = h Cd/m, E = exp(-b),
D = exp(-d), and m11 to m22 multiply (x, h v). Of a method that asks for slopes its tableau or update formulas are
shown instead; of one with a memory what positions obey, step after step; of one that makes several steps of h/n its
formulas in these; of rods those of their small swings, with a = h^2 g/L.

The last column holds all that against what theory makes of the scheme's own function, linearised about rest: step
matrices, or, of what remembers, the polynomials whose roots a whole step multiplies by, memory and all. One mass does
not show everything: what `heun_aliased` does to a chain lowers its order there, which is the declared one.

"""

#: Oscillators at which matrices are held against one another; how near they have to be, and those of differences.
A, B, D, SAME, NEAR = (0.7, 1.9), (0.2, 0.9), 0.3, 1e-9, 1e-6


def steppers() -> list[str]:
    """All schemes that `springlab list` has, and those with the parameters that an engine is known to have."""
    every = [*catalogued(), *listings(), *catalogue.constraint_schemes(), *catalogue.wide_schemes()]
    claims = {claim for engine in registry().values() for claim in engine.identified_as.values()}
    given = sorted({_in_double(claim) for claim in claims if "(" in claim} - set(every))
    return [*every, *given]


def _in_double(name: str) -> str:
    """A scheme's name without the precision: formulas are the same."""
    return catalogue.find(name).with_parameters(single=False).name if "single=" in name else catalogue.find(name).name


def row_of(name: str) -> list[str]:
    """A scheme's: what is derived, its order as derived and as declared, and whether it is the catalogue's."""
    stepper: Stepper = listings()[name] if name in listings() else stepper_named(name)
    scheme = stepper.scheme if isinstance(stepper, SchemeStepper) else None
    runs = runs_of(stepper)
    reasons: list[str] = []
    seen = slopes_of(stepper, reasons)
    matrix = tried(lambda: step_matrix(runs), reasons, "")
    difference = _of_memory(stepper, matrix)
    declared = "-" if scheme is None else str(scheme.order)
    derived = _written(name, seen, matrix, difference) or f"cannot be told: {'; '.join(reasons)}"
    same = _same_as_listing(matrix) if scheme is None else _same(scheme, matrix, difference)
    return [f"`{name}`", derived, _order(seen, matrix, difference), declared, same]


def _of_memory(stepper: Stepper, matrix: StepMatrix | None) -> DifferenceEquation | None:
    """What positions obey, of a stepper that remembers earlier steps."""
    if matrix is None or pasts(runs_of(stepper), "double", matrix.damped, matrix.dragged, matrix.of_swings).one_step:
        return None
    return tried(lambda: difference_equation(runs_of(stepper)), [], "")


def _order(seen: Seen, matrix: StepMatrix | None, difference: DifferenceEquation | None) -> str:
    by_slopes = seen.tableau or seen.multistep or difference
    if by_slopes is not None:
        return str(by_slopes.order)
    return "-" if matrix is None else str(order_of(matrix, False, False))


def _written(name: str, seen: Seen, matrix: StepMatrix | None, difference: DifferenceEquation | None) -> str:
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
    nameless = Identification(name, (), 0.0)
    found = Explanation(name, nameless, matrix=matrix, difference=difference)
    if difference is not None:
        return "; ".join(difference_lines(found))
    if matrix is not None and (matrix.of_swings or matrix.substeps > 1):
        return "; ".join(matrix_lines(found))
    if matrix is None:
        return ""
    return "; ".join(
        f"m{i}{j} = {entry}" for (i, j), entry in zip(((1, 1), (1, 2), (2, 1), (2, 2)), matrix.entries, strict=True)
    )


def _same(scheme: Scheme, matrix: StepMatrix | None, difference: DifferenceEquation | None) -> str:
    """Whether it is what theory has, at some oscillators; why it was not held against that, where it was not."""
    if matrix is None:
        return "no step matrix"
    of = difference or matrix
    for a, b in zip(A, B, strict=True):
        at = a, b * of.damped, D * of.dragged
        try:
            expected = _by_theory(scheme, *at)
        except (Unsupported, InputError, SolverError) as error:
            return f"theory has no matrix of it: {error}"
        values = [np.array([value]) for value in at]
        if difference is not None:
            found = difference.at(values[0], values[1], values[2])[0]
        else:
            found = matrix.at(values[0], values[1], values[2])[0]
        if not _alike(found, expected, SAME if scheme.linear else NEAR):
            return "**no**"
    return "yes"


def _alike(found: Array, expected: Array, within: float) -> bool:
    """Whether a matrix is the expected one; of what remembers, whether both have the same roots beside zeros."""
    if found.shape == expected.shape == (2, 2):
        return bool(np.abs(found - expected).max() <= within)
    polynomials = [np.poly(m) if m.ndim == 2 else m / m[0] for m in (found, expected)]
    size = max(map(len, polynomials))
    one, other = (np.concatenate([p, np.zeros(size - len(p))]) for p in polynomials)
    return bool(np.abs(one - other).max() <= NEAR)


def _by_theory(scheme: Scheme, a: float, b: float, d: float) -> Array:
    """The step matrix of x'' = -(k x + (c + Cd) x')/m: of linearised equations, or by differences about the rest.

    Of a scheme that remembers, of (x, h v) and of that.
    """
    h = 0.5
    if scheme.linear and scheme.one_step:
        (matrix,) = step_matrices(scheme, h, np.ones(1), np.array([a / h**2]), np.array([b / h]), d / h)
        return matrix
    rest = spring_equilibrium(oscillator(a, b, d, dt=h))
    return step_jacobian(scheme, rest, h)


def _same_as_listing(matrix: StepMatrix | None) -> str:
    """Of a listing of the lecture: the schemes that have its step matrix."""
    if matrix is None:
        return "no step matrix"
    return ", ".join(
        f"`{name}`" for name, scheme in catalogue.schemes().items() if _same(scheme, matrix, None) == "yes"
    )


def engine_rows() -> Iterator[list[str]]:
    """What is kept of engines (`report.page.derived_formulas`), with the schemes that have the same formulas."""
    kept = json.loads(OF_ENGINES.read_text(encoding="utf-8"))
    for name in registry():
        found = kept.get(name)
        if found is None:
            yield [f"`{name}`", "cannot be told: it was not installed where this was made", "-"]
        elif "reason" in found:
            near = f"within {found['within']} of `{found['near']}`, at 40 a" if "near" in found else "-"
            yield [f"`{name}` {found['version']}, {found['on']}", f"cannot be told: {found['reason']}", near]
        else:
            same = ", ".join(f"`{scheme}`" for scheme in found["same_as"]) or "**none**"
            yield [f"`{name}` {found['version']}, {found['on']}", "; ".join(found["lines"]), same]


def page() -> str:
    """The whole page."""
    head = ["scheme", "derived", "order derived, without damping", "order declared", "the same as the catalogue's"]
    parts = [HEAD, "## Schemes\n", *_table(head, [row_of(name) for name in steppers()])]
    parts += ["\n## Engines\n", *_table(["engine", "derived", "the same as its claim"], list(engine_rows()))]
    return "\n".join(parts) + "\n"


def _table(head: list[str], rows: list[list[str]]) -> list[str]:
    return [line_of(head), "|" + " --- |" * len(head), *map(line_of, rows)]


def line_of(cells: list[str]) -> str:
    """A row of the page."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


if __name__ == "__main__":
    with np.errstate(all="ignore"):
        FILE.write_text(page(), encoding="utf-8")
