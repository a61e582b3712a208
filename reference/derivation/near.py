"""The scheme nearest to a stepper that has no name, and in which of its numbers the stepper differs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product

import numpy as np

from reference.derivation.equal_parts import (
    EqualParts,
    by_accelerations,
    equal_parts,
    of_tableau,
    same_updates,
    without_damping,
)
from reference.derivation.formula import Number, number
from reference.derivation.implicit import implicit_multistep, implicit_tableau
from reference.derivation.multistep import Multistep
from reference.derivation.of_schemes import tableau_of_scheme, updates_of_scheme
from reference.derivation.oscillators import matrices_at, runs_of
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.derivation.tableau import Tableau, nearest, tableau_of
from reference.derivation.updates import Coefficient, Symbol, Updates
from reference.errors import Unsupported
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.stepper import SchemeStepper

#: So many numbers may differ; with more the nearest is not near.
MOST = 4

#: How what is said of one with a known tableau begins.
SAME_TABLEAU = "its tableau is that of "

#: Entries of step matrices that are as near as this are the same.
SAME = 1e-9

NOTHING = Coefficient(Fraction(0), 0)


def nearest_known(
    tableau: Tableau | None, updates: Updates | None, matrix: StepMatrix | None, parts: EqualParts | None = None
) -> str:
    """In words: "b2 is 1/3 where heun has 1/2"; empty where nothing is near.

    Args:
        parts: what the step is made of, where it is made of several equal ones: then of one of these.
    """
    if parts is not None:
        return _by_parts(parts)
    if tableau is not None:
        return _by_tableau(tableau, updates)
    words = _by_updates(updates) if updates is not None else ""
    return words or (_by_matrix(matrix) if matrix is not None else "")


def parts_of(tableau: Tableau | None, updates: Updates | None) -> EqualParts | None:
    """The equal sub-steps that a step is made of, by its formulas; None where it is not, or they are not known."""
    if updates is None and (tableau is None or not tableau.explicit):
        return None
    whole = updates or of_tableau(tableau)  # type: ignore[arg-type]
    found = equal_parts(whole, known_updates)
    if found is not None or not whole.asks_only_accelerations or len(whole.points) < 2:
        return found
    found = equal_parts(without_damping(whole), known_without_damping)
    return replace(found, undamped=True) if found is not None else None


def name_of_parts(parts: EqualParts) -> str:
    """The scheme that a sub-step is; empty where it is none."""
    if not parts.undamped:
        return name_of_updates(parts.one)
    return next((name for name, known in known_without_damping().items() if same_updates(parts.one, known)), "")


def name_of_updates(updates: Updates) -> str:
    """The scheme that has these very formulas; empty where there is none."""
    tableau = tableau_of(updates, timed=False)
    for name, known in known_tableaux().items():
        if tableau is not None and tableau.same(replace(known, c=tableau.c)):
            return name
    known_ones = known_updates()
    if updates.asks_only_accelerations:
        known_ones = {name: by_accelerations(known) for name, known in known_ones.items()}
    return next((name for name, known in known_ones.items() if same_updates(updates, known)), "")


def _by_parts(parts: EqualParts) -> str:
    n, name = parts.count, name_of_parts(parts)
    step = "without damping its step" if parts.undamped else "its step"
    if name:
        return f"{step} is {n} sub-steps of {name}, each of h/{n}"
    words = "" if parts.undamped else nearest_known(tableau_of(parts.one, timed=False), parts.one, None)
    return f"{step} is {n} equal sub-steps of h/{n}" + (f", in each of which {words}" if words else "")


def begun_otherwise(updates: Updates | None, multistep: Multistep | None, first: Updates | None) -> str:
    """In words: "adams_bashforth_2, begun with euler"; empty where it is no known method of several steps.

    Args:
        updates, multistep: the formulas of later steps. first: those of the first.
    """
    name = ""
    if updates is not None and updates.looks_back:
        name = name_of_updates(updates)
    elif multistep is not None:
        schemes = ((name, implicit_multistep(scheme)) for name, scheme in _known().items())
        name = next((name for name, known in schemes if known is not None and known.same(multistep)), "")
    if not name:
        return ""
    begun = name_of_updates(first) if first is not None else ""
    return f"{name}, begun {f'with {begun}' if begun else 'otherwise'}"


def _by_tableau(tableau: Tableau, updates: Updates | None) -> str:
    """By its stages as written, a slope taken twice at one point being two; or being one, where that is nearer."""
    alike = [(name, known) for name, known in known_tableaux().items() if known.explicit == tableau.explicit]
    written = None if updates is None else tableau_of(updates, timed=False, repeated=True)
    both = [nearest(each, alike) for each in (written, tableau) if each is not None]
    found = min((each for each in both if each is not None), key=lambda each: len(each[1]), default=None)
    if found is None or len(found[1]) > MOST:
        return ""
    scheme, differences = found
    if not differences:
        return f"{SAME_TABLEAU}{scheme}"
    return ", ".join(f"{which} is {number(mine)} where {scheme} has {number(its)}" for which, mine, its in differences)


def _by_updates(updates: Updates) -> str:
    """Of those that take as many accelerations, at as many points: the one with the fewest other coefficients."""
    differing = {
        name: list(_differences(updates, known))
        for name, known in known_updates().items()
        if len(known.points) == len(updates.points) and known.asks_only_accelerations
    }
    name = min(differing, key=lambda n: len(differing[n]), default=None)
    if name is None or not updates.asks_only_accelerations or not 0 < len(differing[name]) <= MOST:
        return ""
    return ", ".join(
        f"{where} is {number(mine)} where {name} has {number(its)}" for where, mine, its in differing[name]
    )


def _differences(one: Updates, other: Updates) -> Iterator[tuple[str, Number, Number]]:
    """Which coefficients differ: where, the one's and the other's."""
    pairs = list(zip((*one.points, one.end), (*other.points, other.end), strict=True))
    for i, (mine, its) in enumerate(pairs):
        place = f"where a{i + 1} is taken" if i < len(one.points) else "at the end"
        for letter, form, known in (("x", mine[0], its[0]), ("v", mine[1], its[1])):
            for symbol in dict.fromkeys((*form, *known)):
                here, there = form.get(symbol, NOTHING), known.get(symbol, NOTHING)
                if here != there:
                    power = (here if here.number else there).power
                    yield f"{_said(symbol, power)} in {letter} {place}", here.number, there.number


def _said(symbol: Symbol, power: int) -> str:
    """A symbol times its power of h: h^2 a1."""
    name = symbol.kind if symbol.kind in "xv" else f"a{symbol.call + 1}"
    name += f"[{-symbol.age}]" if symbol.age else ""
    return name if power == 0 else f"h {name}" if power == 1 else f"h^{power} {name}"


def _by_matrix(matrix: StepMatrix) -> str:
    """Of all one-step schemes: first by what they do without damping, as a mistake is often in that alone."""
    if matrix.substeps > 1:
        n, (name, words) = matrix.substeps, _alike(replace(matrix, substeps=1))
        each = f"with the step matrix of {name}" if name and not words else f"of which {words}"
        return f"its step is {n} of h/{n}, each {each}" if name else ""
    name, words = _alike(matrix)
    if name and not words:
        return f"its step matrix is that of {name}: they differ in motion that is not linear, or by rounding"
    return words


def _alike(matrix: StepMatrix) -> tuple[str, str]:
    """The scheme, and in which entries it is another; of none, nothing."""
    at = matrix.samples
    undamped = type(at)(at.a, 0 * at.a, 0 * at.a)
    found: dict[str, tuple[int, int]] = {}
    for name, scheme in _known().items():
        if scheme.one_step:
            runs = runs_of(SchemeStepper(scheme))
            apart = [np.abs(matrices_at(runs, s) - matrix.at(s.a, s.b, s.d)).max(axis=0) > SAME for s in (undamped, at)]
            found[name] = int(apart[0].sum()), int(apart[1].sum())
    name = min(found, key=lambda n: found[n])
    if found[name][0] and found[name][1] > MOST // 2:
        return "", ""
    if not any(found[name]):
        return name, ""
    mine, its = matrix.text(), step_matrix(runs_of(SchemeStepper(catalogue.find(name)))).text()
    places = [(i, j) for i, j in product(range(2), range(2)) if mine[i][j] != its[i][j]]
    return name, ", ".join(f"m{i + 1}{j + 1} is {mine[i][j]} where {name} has {its[i][j]}" for i, j in places)


def _known() -> dict[str, Scheme]:
    return {**catalogue.schemes(), **catalogue.wide_schemes()}


@cache
def known_tableaux() -> dict[str, Tableau]:
    """The catalogue's, by scheme."""
    found = {name: tableau_of_scheme(scheme) or implicit_tableau(scheme) for name, scheme in _known().items()}
    return {name: tableau for name, tableau in found.items() if tableau is not None}


@cache
def known_without_damping() -> dict[str, Updates]:
    """The same without the velocities at which accelerations are taken, of one-step schemes."""
    known = {name: by_accelerations(updates) for name, updates in known_updates().items()}
    return {name: without_damping(updates) for name, updates in known.items() if not updates.looks_back}


@cache
def known_updates() -> dict[str, Updates]:
    """The catalogue's update formulas, by scheme."""
    found = {}
    for name, scheme in _known().items():
        try:
            found[name] = updates_of_scheme(scheme)
        except Unsupported:
            continue
    return found
