"""The scheme nearest to a stepper that has no name, and in which of its numbers the stepper differs."""

from __future__ import annotations

from functools import cache
from itertools import product

import numpy as np

from reference.derivation.formula import number
from reference.derivation.implicit import implicit_tableau
from reference.derivation.of_schemes import tableau_of_scheme
from reference.derivation.oscillators import runs_of
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.derivation.tableau import Tableau, nearest
from reference.errors import Unsupported
from reference.schemes import catalogue
from reference.stepper import SchemeStepper


def nearest_known(name: str, tableau: Tableau | None, matrix: StepMatrix | None) -> str:
    """In words: "b2 is 1/3 where heun has 1/2"; empty where nothing is near.

    Args:
        name: of the stepper, which is not compared with itself.
    """
    if tableau is not None:
        found = nearest(tableau, [(n, t) for n, t in known_tableaux().items() if n != name])
        if found is None or len(found[1]) > tableau.stages + 1:
            return ""
        scheme, differences = found
        if not differences:
            return f"its tableau is that of {scheme}"
        return ", ".join(
            f"{which} is {number(mine)} where {scheme} has {number(its)}" for which, mine, its in differences
        )
    if matrix is None:
        return ""
    text = matrix.text()
    if not all(matrix.asks(letter) for letter in "abd"):
        return ""
    places = list(product(range(2), range(2)))
    differing = {
        scheme: [(i, j) for i, j in places if known[i][j] != text[i][j]]
        for scheme, known in known_matrices().items()
        if scheme != name
    }
    # first by what they do without damping: a mistake is often in that alone
    scheme = min(differing, key=lambda s: (_apart_undamped(matrix, s), len(differing[s]), _apart(matrix, s)))
    if len(differing[scheme]) > 2 and _apart_undamped(matrix, scheme):
        return ""
    if not differing[scheme]:
        return f"its step matrix is that of {scheme}: they differ in motion that is not linear"
    known = known_matrices()[scheme]
    return ", ".join(f"m{i + 1}{j + 1} is {text[i][j]} where {scheme} has {known[i][j]}" for i, j in differing[scheme])


@cache
def known_tableaux() -> dict[str, Tableau]:
    """The catalogue's, by scheme."""
    every = {**catalogue.schemes(), **catalogue.wide_schemes()}.items()
    found = {name: tableau_of_scheme(scheme) or implicit_tableau(scheme) for name, scheme in every}
    return {name: tableau for name, tableau in found.items() if tableau is not None}


@cache
def known_matrices() -> dict[str, list[list[str]]]:
    """The catalogue's step matrices, as they are written, by scheme: those of one-step schemes."""
    found = {}
    for name, scheme in {**catalogue.schemes(), **catalogue.wide_schemes()}.items():
        if scheme.one_step:
            try:
                found[name] = _matrix_of(name).text()
            except Unsupported:
                continue
    return found


@cache
def _matrix_of(scheme: str) -> StepMatrix:
    return step_matrix(runs_of(SchemeStepper(catalogue.find(scheme))))


def _apart_undamped(matrix: StepMatrix, scheme: str) -> int:
    """In how many entries two step matrices differ without damping and drag."""
    a, nothing = matrix.samples.a, 0 * matrix.samples.a
    off = np.abs(_matrix_of(scheme).at(a, nothing, nothing) - matrix.at(a, nothing, nothing)).max(axis=0)
    return int((off > 1e-9).sum())


def _apart(matrix: StepMatrix, scheme: str) -> float:
    """How far two step matrices are apart where one was measured."""
    at = matrix.samples
    return float(np.abs(_matrix_of(scheme).at(at.a, at.b, at.d) - matrix.measured).mean())
