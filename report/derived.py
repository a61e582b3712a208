"""What was derived of a stepper, in words: for the terminal, for pages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from reference.derivation.formula import Formula
from reference.errors import InputError

if TYPE_CHECKING:
    from reference.derivation.consequences import Consequences, Windows
    from reference.derivation.explanation import Explanation
    from reference.derivation.formula import Number
    from reference.derivation.over_dts import OverDts

#: What the letters of a step matrix mean.
LETTERS = "a = h^2 k/m, b = h c/m, d = h Cd/m, E = exp(-b), D = exp(-d)"

#: Steps in a row that are told, as they are more than a few.
MANY_STEPS = 100

#: When an order by a tableau holds whose c are not the sums of its rows.
WITHOUT_TIME = " where slopes do not depend on time"

#: So many intervals of stability above the first are told.
TOLD = 3


def matrix_lines(explanation: Explanation) -> list[str]:
    """The step matrix, a line for each row, with what its letters mean; g = b + d, where it asks for their sum only."""
    matrix = explanation.matrix
    if matrix is None:
        return []
    entries, letters = _in_letters(matrix.entries)
    if matrix.of_swings:
        letters = f"{letters.replace('k/m', 'g/L')}, of small swings of a rod of length L: x is its angle, v its rate"
    s = "h" if matrix.substeps == 1 else "s"
    lines = [
        f"{new} = {_added(_times(of_x, 'x'), _times(of_v, f'{s} v'))}"
        for new, of_x, of_v in (("x'", *entries[:2]), (f"{s} v'", *entries[2:]))
    ]
    if matrix.substeps > 1:
        of_part = letters.replace("= h", "= s")
        letters = f"{of_part}, s = h/{matrix.substeps}: a step of h is {matrix.substeps} of these"
    without = _without(matrix.damped or matrix.of_swings, matrix.dragged)
    only = f"; at h = {matrix.only_at:g} s only: h stands in it by itself" if matrix.only_at is not None else ""
    return [*lines, f"with {letters}{without}{only}"]


def _in_letters(entries: Sequence[Formula]) -> tuple[list[str], str]:
    """Formulas as they are written, and what their letters mean: with g = b + d, where they ask for that sum only."""
    summed = [str(of_sum).replace("b", "g") for entry in entries if (of_sum := entry.of_sum()) is not None]
    if len(summed) == len(entries) and any(entry.asks("b") for entry in entries):
        return summed, "a = h^2 k/m, g = h (c + Cd)/m"
    asked = [part for part in LETTERS.split(", ") if any(entry.asks(part[0]) for entry in entries)]
    return [str(entry) for entry in entries], ", ".join(asked)


def _without(damped: bool, dragged: bool) -> str:
    """What formulas were seen without, behind a semicolon."""
    seen = [word for word, there in (("damping", damped), ("drag", dragged)) if not there]
    return f"; without {' and '.join(seen)}" if seen else ""


def _times(entry: str, of: str) -> str:
    return of if entry == "1" else f"-{of}" if entry == "-1" else f"({entry}) {of}"


def _added(*terms: str) -> str:
    return " + ".join(terms).replace("+ -", "- ")


def difference_lines(explanation: Explanation) -> list[str]:
    """What positions obey step after step, with what its letters mean; x1 is the new one, x0 that before."""
    difference = explanation.difference
    if difference is None:
        return []
    new, *old = difference.parts
    of_old = [Formula({m: -c for m, c in part.numerator.items()}) for part in old]
    (first, *others), letters = _in_letters([new, *of_old])
    places = ["x0", *(f"x[-{j}]" for j in range(1, len(others)))]
    terms = _added(*(_times(entry, place) for entry, place in zip(others, places, strict=True) if entry != "0"))
    without = _without(difference.damped, difference.dragged)
    return [f"{_times(first, 'x1')} = {terms}", f"with {letters}{without}"]


def tableau_lines(explanation: Explanation) -> list[str]:
    """The Butcher tableau as textbooks draw it: c and a, below them b."""
    tableau = explanation.tableau
    if tableau is None:
        return []
    text = tableau.text()
    rows = [[str(c), *map(str, row)] for c, row in zip(text["c"], text["a"], strict=True)]
    rows.append(["", *map(str, text["b"])])
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = [cell.rjust(width) for cell, width in zip(row, widths, strict=True)]
        lines.append(f"{cells[0]} | {'  '.join(cells[1:])}")
    *above, below = lines
    return [*above, "-" * len(below), below]


def force_lines(explanation: Explanation) -> list[str]:
    """Where a stepper that only steps takes forces, and what it makes of them."""
    from reference.derivation.formula import product

    taken = explanation.seen.taken
    if not taken:
        return []
    lines = [
        f"{new} = {old}{_of_forces(power, terms)}"
        for new, old, power, terms in (
            ("x'", "x + h v", "h^2", _weighted([force.in_position for force in taken])),
            ("v'", "v", "h", _weighted([force.in_velocity for force in taken])),
        )
    ]
    on = [f" + {product(force.at, 'h v')}" if force.at else "" for force in taken]
    places = [f"F{i + 1} at x{where}" for i, where in enumerate(on)]
    moved = ", but for what earlier forces add (h^2 F/m)" if any(abs(f.by_earlier) > 1e-6 for f in taken) else ""
    return [*lines, f"with forces {', '.join(places)}{moved}"]


def _of_forces(power: str, terms: Sequence[str]) -> str:
    """A sum of weighted forces over m, times a power of h; nothing of none."""
    total = _added(*terms)
    return f" + {power} {f'({total})' if len(terms) > 1 or '/' in total else total}/m" if terms else ""


def _weighted(weights: Sequence[Number]) -> list[str]:
    from reference.derivation.formula import product

    terms = [(w, f"F{i + 1}") for i, w in enumerate(weights) if w]
    return [f"-{product(-w, name)}" if w < 0 else product(w, name) for w, name in terms]


def name_line(explanation: Explanation) -> str:
    """What it is: its name, or that it has none, and what it is then."""
    found = explanation.identification
    if found.identified_as == explanation.stepper:
        ties = f"; on the string it was run on it cannot be told from {', '.join(found.ties)}" if found.ties else ""
        return f"{explanation.stepper} is what the catalogue has by this name{ties}"
    if found.identified_as is not None:
        autonomous = f",{WITHOUT_TIME}" if explanation.tableau and explanation.tableau.times_at_odds else ""
        return f"{found}{autonomous}{_only_at_some(explanation.held)}. {found.remark}".rstrip(". ")
    if not found.ranking:
        return f"{explanation.stepper} cannot be told: {found.reason}"
    words = f"{explanation.stepper} is not in the catalogue"
    if in_catalogue(explanation.stepper):
        words = f"{explanation.stepper} is in the catalogue by this name, but its motion was not identified"
    if explanation.tableau is not None:
        kind = "an explicit" if explanation.tableau.explicit else "an implicit"
        words += f": {kind} Runge-Kutta method of {explanation.tableau.stages} stages and order {explanation.order}"
        words += WITHOUT_TIME if explanation.tableau.times_at_odds else ""
    multistep = explanation.seen.multistep
    if multistep is not None:
        kind = "an explicit" if multistep.explicit else "an implicit"
        words += f": {kind} multistep method of {len(multistep.alpha)} steps and order {multistep.order}"
    if explanation.begun:
        return f"{words}{';' if ':' in words else ':'} by its coefficients it is {explanation.begun}"
    # beside a nearest one by motion, which is among the reasons
    by = "" if explanation.nearest.startswith(("its ", "without damping its ")) else "nearest by coefficients: "
    return words + (f"; {by}{explanation.nearest}" if explanation.nearest else "")


def _only_at_some(held: OverDts | None) -> str:
    """At which dt a name does not hold, behind a comma; and at which to what part of a step's size."""
    if held is None:
        return ""
    changed = [f"not at {dt:g} s" + (f" (there {name})" if name else "") for dt, name in held.changed]
    loose = [f"at {dt:g} s to {off:.1g} only" for dt, off in held.loose]
    return "".join([f", but not at every dt: {', '.join(changed)}"] * bool(changed) + [f", {one}" for one in loose])


def in_catalogue(name: str) -> bool:
    """Whether a scheme can be asked for by that name, solvers and names with parameters included."""
    from reference.stepper import stepper_named

    try:
        stepper_named(name)
    except InputError:
        return False
    return True


def property_lines(explanation: Explanation) -> Iterator[str]:
    """What holds of it, a sentence each without its stop."""
    past = explanation.pasts
    if past is not None:
        if not past.deterministic:
            yield "The same step twice is not the same"
        elif past.one_step is False:
            after = f" after {past.steps - 1} others" if past.steps > MANY_STEPS else ""
            yield f"It remembers earlier steps: begun anew, a step{after} is {past.apart:.2g} of the displacement off"
        else:
            many = f", as far as {past.steps} steps in a row show" if past.steps > MANY_STEPS else ""
            yield f"One step: it depends on positions and velocities alone{many}"
    if explanation.held is not None and not explanation.held.other and str(explanation.held):
        yield str(explanation.held)
    if explanation.explicit is not None:
        yield "Explicit: no equations are solved" if explanation.explicit else "Implicit: equations are solved"
    if explanation.updates is not None:
        reused = ", one of them that of the step before" if explanation.updates.reused else ""
        calls = explanation.updates.calls + explanation.updates.reused
        yield f"Slopes or forces taken in a step: {calls}{reused}{_where_derived(explanation, of_slopes=True)}"
    yield from _order(explanation)
    yield from _stability(explanation)
    if explanation.follows is not None and explanation.of_one_step:
        yield from _of_matrix(explanation, explanation.follows)
    if explanation.difference is not None and explanation.difference.of_fast is not None:
        yield f"What swings infinitely fast is multiplied by {explanation.difference.of_fast:.4g} in a step"


def _order(explanation: Explanation) -> Iterator[str]:
    order = explanation.order_of_one_mass
    if explanation.seen.adapts:
        yield "No order in dt: it makes steps of its own by a tolerance, and its error is that tolerance's, not dt's"
    if explanation.tableau is not None and explanation.tableau.fails:
        nearly = explanation.tableau.nearly
        digits = f"; to six digits it is of order {nearly}" if nearly > explanation.tableau.order else ""
        where = WITHOUT_TIME if explanation.tableau.times_at_odds else ""
        at = _where_derived(explanation, of_slopes=True)
        yield f"Order {order}{where}, by the conditions on its tableau{at}: {explanation.tableau.fails}{digits}"
    elif explanation.seen.multistep is not None:
        yield f"Order {order}, by its coefficients"
    elif order is not None:
        follows, of_one_mass = explanation.follows, explanation.order_on_oscillators
        known = []
        matrix = explanation.matrix
        left_out = ", as drag is not in it" if matrix and matrix.dragged and not matrix.asks("d") else ""
        if follows is not None and explanation.of_one_step:
            where = "small swings" if matrix and matrix.of_swings else "the oscillator"
            seen = (
                [word for word, there in (("damping", matrix.damped), ("drag", matrix.dragged)) if there]
                if matrix
                else []
            )
            resisted = f", {follows.order} with {' and '.join(seen)}{left_out}" if seen else ""
            at = _where_derived(explanation, of_slopes=False)
            known.append(f"{follows.undamped_order} on {where}{resisted}{at}")
        elif of_one_mass is not None:
            known.append(f"{of_one_mass} on the oscillator, by its difference equation")
        if explanation.nonlinear_order is not None:
            begun = "" if explanation.of_one_step else ", its first steps included"
            known.append(f"{explanation.nonlinear_order} measured on a spring that turns, without damping{begun}")
        yield f"Order {order} without damping: {'; '.join(known)}"
    if explanation.lower_among_masses:
        yield (
            f"Order {explanation.order} among several masses, measured on two that move one another, without damping: "
            "what is derived above, of one mass, does not show that"
        )


def _where_derived(explanation: Explanation, of_slopes: bool) -> str:
    """At which dt something was derived, behind a comma, of what is not the same at every dt."""
    from reference.derivation.oscillators import DT
    from reference.derivation.recording import LENGTHS

    if not explanation.changes_with_dt:
        return ""
    asked = of_slopes and (explanation.updates is not None or explanation.seen.iterates)
    return f", at dt = {' and '.join(f'{dt:g}' for dt in LENGTHS)} s" if asked else f", at dt = {DT:g} s"


def _stability(explanation: Explanation) -> Iterator[str]:
    if explanation.changes_with_dt:
        if explanation.matrix is None or explanation.matrix.only_at is None:  # else it is among the reasons
            yield "No limits of stability follow, as its rule is another at another dt"
        return
    imaginary, real = explanation.limits
    if explanation.tableau is not None and explanation.follows is None and explanation.of_one_step:
        solved = "" if explanation.explicit else ", where its equations are solved"
        yield stability("h w", imaginary or (), "damping") + solved
        yield stability("h c/m", real or (), "stiffness") + solved
        return
    if imaginary is not None:
        yield stability("h w", imaginary, "damping")
    if real is not None:
        of = explanation.matrix if explanation.of_one_step else explanation.difference
        without = "gravity" if explanation.matrix is not None and explanation.matrix.of_swings else "stiffness"
        yield stability(f"h {'c' if of is not None and of.damped else 'Cd'}/m", real, without)


def _of_matrix(explanation: Explanation, follows: Consequences) -> Iterator[str]:
    symplectic = "symplectic" if explanation.symplectic else "not symplectic"
    reversible = "reversible" if follows.reversible else "not reversible"
    at = _where_derived(explanation, of_slopes=False)
    yield f"{symplectic.capitalize()}, and {reversible}, without damping{at}"
    if follows.implicit:
        yield f"Implicit in {' and '.join(follows.implicit)}{at}"
    for s, period, amplitude in follows.periods:
        yield f"At h w = {s:g}: period x {period:.5f}, amplitude x {amplitude:.4g} in a period{at}"


def stability(of: str, windows: Windows, without: str) -> str:
    """Up to which step it is stable, in a sentence."""
    from reference.derivation.consequences import FAR

    if windows[0][1] >= FAR:
        return f"Stable without {without} at any dt"
    if windows == ((0.0, 0.0),):
        return f"Unstable without {without} at any dt"
    return f"Stable up to {of} = {limits(windows)} without {without}"


def limits(windows: Windows) -> str:
    """Where stability ends, and where there is some again."""
    from reference.derivation.consequences import FAR

    first, *others = windows
    words = "any length" if first[1] >= FAR else f"{first[1]:.6g}"
    again = [f"from {low:.6g} to {high:.6g}" if high < FAR else f"from {low:.6g} on" for low, high in others[:TOLD]]
    return words + (f", and again {', '.join(again)}" if again else "")


def sections(explanation: Explanation) -> list[tuple[str, list[str]]]:
    """Everything there is to say, under headings; what there is nothing of is left out."""
    from reference.derivation.updates import in_words

    multistep = explanation.seen.multistep
    of_one = ", as one mass shows it" if explanation.lower_among_masses else ""
    of_swings = explanation.matrix is not None and explanation.matrix.of_swings
    at, of_slopes = (_where_derived(explanation, of_slopes=each) for each in (False, True))
    found = [
        (
            f"Derived: a step of {'small swings of a rod' if of_swings else 'the damped oscillator'}{at}",
            matrix_lines(explanation),
        ),
        (
            f"Derived: the update formulas{of_slopes}",
            list(in_words(explanation.updates)) if explanation.updates else [],
        ),
        (f"Derived: where forces of springs are taken, without damping{at}", force_lines(explanation)),
        (f"Derived: the multistep method{of_slopes}", [str(multistep)] if multistep else []),
        (f"Derived: what an oscillator's positions obey, step after step{at}", difference_lines(explanation)),
        (f"Derived: the Butcher tableau{of_one}{of_slopes}", tableau_lines(explanation)),
        ("What follows", [f"- {line}." for line in property_lines(explanation)]),
        ("What cannot be told, and why", [f"- {reason}." for reason in _beside_the_name(explanation)]),
        ("What it should not do", [f"- {remark}." for remark in explanation.remarks]),
    ]
    return [(title, lines) for title, lines in found if lines]


def _beside_the_name(explanation: Explanation) -> list[str]:
    """The reasons that the line with the name does not have; each failure once, under its first heading."""
    found = explanation.identification
    said = set() if found.ranking or found.identified_as else {found.reason}
    left: list[str] = []
    for reason in explanation.reasons:
        what = reason.partition(": ")[2] or reason
        if not {reason, what} & said:
            left.append(reason)
        said |= {reason, what}
    return left
