"""What is derived, in words, of explanations made by hand: limits, names, forces, tableaus, reasons."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from reference.derivation.consequences import FAR, Consequences, Windows
from reference.derivation.explanation import Explanation
from reference.derivation.force_jumps import Taken
from reference.derivation.over_dts import OverDts
from reference.derivation.pasts import Pasts
from reference.derivation.seen import NOTHING
from reference.derivation.tableau import Tableau
from reference.identification import Identification, Match
from report.derived import force_lines, limits, name_line, property_lines, sections, stability, tableau_lines

HEUN = Tableau(
    ((Fraction(0), Fraction(0)), (Fraction(1), Fraction(0))),
    (Fraction(1, 2), Fraction(1, 2)),
    (Fraction(0), Fraction(1)),
)
MIDPOINT = Tableau(((Fraction(1, 2),),), (Fraction(1),), (Fraction(1, 2),))


def named(scheme: str = "", *ties: str, reason: str = "none is near") -> Identification:
    """As a scheme, with those it cannot be told from; or as none, though RK4 is nearest."""
    ranking = (*(Match(name, 1e-15) for name in (scheme, *ties) if name), Match("rk4", 1e-3))
    return Identification("mine", ranking, 1e-12, "" if scheme else reason)


def explained(found: Identification | None = None, stepper: str = "mine", **fields: Any) -> Explanation:
    """Of a stepper."""
    return Explanation(stepper, found or named(), **fields)


def seen(**fields: Any) -> Any:
    """What it does with slopes and forces."""
    return NOTHING._replace(**fields)


@pytest.mark.parametrize(
    ("windows", "said"),
    [
        (((0.0, FAR),), "Stable without damping at any dt"),
        (((0.0, 0.0),), "Unstable without damping at any dt"),
        (((0.0, 2.0),), "Stable up to h w = 2 without damping"),
        (((0.0, 1 / 3), (1.0, 2.0)), "Stable up to h w = 0.333333, and again from 1 to 2 without damping"),
        (((0.0, 0.0), (1.0, 2.0)), "Stable up to h w = 0, and again from 1 to 2 without damping"),
        (((0.0, 1.0), (2.0, FAR)), "Stable up to h w = 1, and again from 2 on without damping"),
    ],
)
def test_limits_are_told_with_where_it_is_stable_again(windows: Windows, said: str) -> None:
    """Or that there is none, or nothing else."""
    assert stability("h w", windows, "damping") == said


def test_no_more_than_three_further_intervals_are_told() -> None:
    """In their order; an interval without an end is any length."""
    four = tuple((float(i), i + 0.5) for i in range(5))
    assert limits(four) == "0.5, and again from 1 to 1.5, from 2 to 2.5, from 3 to 3.5"
    assert limits(((0.0, FAR),)) == "any length"


def test_a_tableau_is_drawn_as_in_textbooks() -> None:
    """C to the left, b below; of nothing, nothing."""
    assert tableau_lines(explained()) == []
    lines = tableau_lines(explained(seen=seen(tableau=HEUN)))
    assert [line.split() for line in lines[:2]] == [["0", "|", "0", "0"], ["1", "|", "1", "0"]]
    assert set(lines[2]) == {"-"}
    assert lines[3].split() == ["|", "1/2", "1/2"]
    assert len({line.index("|") for line in (*lines[:2], lines[3])}) == 1
    assert len({len(line) for line in lines}) == 1


@pytest.mark.parametrize(
    ("taken", "lines"),
    [
        ([], []),
        (
            [Taken(Fraction(0), Fraction(1), Fraction(1))],
            ["x' = x + h v + h^2 F1/m", "v' = v + h F1/m", "with forces F1 at x"],
        ),
        (
            [
                Taken(Fraction(0), Fraction(1, 2), Fraction(1, 2)),
                Taken(Fraction(1), Fraction(1, 2), Fraction(0), by_earlier=0.5),
            ],
            [
                "x' = x + h v + h^2 (F1/2)/m",
                "v' = v + h (F1/2 + F2/2)/m",
                "with forces F1 at x, F2 at x + h v, but for what earlier forces add (h^2 F/m)",
            ],
        ),
        (
            [
                Taken(Fraction(1, 2), Fraction(2), Fraction(0), by_earlier=1e-7),
                Taken(Fraction(1), Fraction(-1), Fraction(0)),
            ],
            ["x' = x + h v", "v' = v + h (2 F1 - F2)/m", "with forces F1 at x + h v/2, F2 at x + h v"],
        ),
    ],
)
def test_forces_are_told_with_where_they_are_taken(taken: list[Taken], lines: list[str]) -> None:
    """Weights as in formulas; those that are nothing are left out."""
    assert force_lines(explained(seen=seen(taken=tuple(taken)))) == lines


def test_a_name_is_told_with_what_ties_and_where_it_does_not_hold() -> None:
    """Of a scheme by its own name; of another; at which dt it is something else."""
    own = Identification("heun", (Match("heun", 0.0), Match("midpoint", 0.0)), 1e-12)
    assert name_line(explained(own, "heun")) == (
        "heun is what the catalogue has by this name; on the string it was run on it cannot be told from midpoint"
    )
    alone = Identification("heun", (Match("heun", 0.0),), 1e-12)
    assert name_line(explained(alone, "heun")) == "heun is what the catalogue has by this name"
    assert name_line(explained(named("heun"))) == "mine is heun, to 1e-15 m"
    tied = name_line(explained(named("heun", "midpoint")))
    assert tied == "mine is heun, to 1e-15 m. On this scene it cannot be told from midpoint"
    held = OverDts("heun", (0.01,), (0.1, 0.5), ("euler", None), (1.0, 1.0))
    said = name_line(explained(named("heun"), held=held))
    assert said.startswith("mine is heun, to 1e-15 m, but not at every dt: not at 0.1 s (there euler), not at 0.5 s")


def test_without_a_name_it_is_told_what_it_is() -> None:
    """Why nothing can be told; a Runge-Kutta method, explicit or not; the nearest."""
    nothing = Identification("mine", (), 1e-12, "it crashed")
    assert name_line(explained(nothing)) == "mine cannot be told: it crashed"
    assert name_line(explained()) == "mine is not in the catalogue"
    assert name_line(explained(stepper="heun")) == (
        "heun is in the catalogue by this name, but its motion was not identified"
    )
    explicit, implicit = (name_line(explained(seen=seen(tableau=tableau))) for tableau in (HEUN, MIDPOINT))
    assert explicit == "mine is not in the catalogue: an explicit Runge-Kutta method of 2 stages and order 2"
    assert implicit == "mine is not in the catalogue: an implicit Runge-Kutta method of 1 stages and order 2"
    assert name_line(explained(nearest="heun, but for b1")) == (
        "mine is not in the catalogue; nearest by coefficients: heun, but for b1"
    )
    assert name_line(explained(nearest="its motion is near heun's")) == (
        "mine is not in the catalogue; its motion is near heun's"
    )
    assert name_line(explained(begun="AB2")) == "mine is not in the catalogue: by its coefficients it is AB2"
    both = name_line(explained(begun="AB2", seen=seen(tableau=HEUN)))
    assert both.endswith("of 2 stages and order 2; by its coefficients it is AB2")


@pytest.mark.parametrize(
    ("pasts", "said"),
    [
        (Pasts(True, True, 0.0, 5), "One step: it depends on positions and velocities alone"),
        (
            Pasts(True, True, 0.0, 101),
            "One step: it depends on positions and velocities alone, as far as 101 steps in a row show",
        ),
        (Pasts(None, False, 0.0, 5), "The same step twice is not the same"),
        (
            Pasts(False, True, 0.125, 100),
            "It remembers earlier steps: begun anew, a step is 0.12 of the displacement off",
        ),
        (
            Pasts(False, True, 0.25, 101),
            "It remembers earlier steps: begun anew, a step after 100 others is 0.25 of the displacement off",
        ),
    ],
)
def test_memory_is_told_first(pasts: Pasts, said: str) -> None:
    """How many steps were looked at, where they are many."""
    assert next(property_lines(explained(pasts=pasts))) == said


def test_reasons_are_told_once() -> None:
    """Those that the line with the name has not; the same failure under its first heading alone."""
    reasons = ("step matrix: it crashed", "slopes: it crashed", "order: too stiff", "none is near")
    found = dict(sections(explained(reasons=reasons)))
    assert found["What cannot be told, and why"] == [
        "- step matrix: it crashed.",
        "- order: too stiff.",
        "- none is near.",
    ]
    nothing = Identification("mine", (), 1e-12, "it crashed")
    assert dict(sections(explained(nothing, reasons=reasons)))["What cannot be told, and why"] == [
        "- order: too stiff.",
        "- none is near.",
    ]
    assert "What it should not do" not in found
    rude = dict(sections(explained(seen=seen(remarks=("it writes into the state",)))))
    assert rude["What it should not do"] == ["- it writes into the state."]


def test_consequences_need_the_whole_step() -> None:
    """Of a Runge-Kutta method without a matrix limits come from its tableau."""
    lines = list(property_lines(explained(seen=seen(tableau=HEUN))))
    assert "Explicit: no equations are solved" in lines
    assert "Unstable without damping at any dt" in lines
    assert "Stable up to h c/m = 2 without stiffness" in lines
    solved = list(property_lines(explained(seen=seen(tableau=MIDPOINT))))
    assert "Implicit: equations are solved" in solved
    assert "Stable without stiffness at any dt, where its equations are solved" in solved
    follows = Consequences(((0.0, 2.0),), None, 1, 1, True, True, (), ())
    assert not [line for line in property_lines(explained(follows=follows)) if "stiffness" in line]
