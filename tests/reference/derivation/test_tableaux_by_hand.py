"""What is told of tableaux, forces and update formulas that are written down here."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from reference.derivation.equal_parts import (
    by_accelerations,
    equal_parts,
    of_tableau,
    repeated,
    same_updates,
    without_damping,
)
from reference.derivation.force_jumps import Taken
from reference.derivation.implicit import implicit_multistep, implicit_tableau
from reference.derivation.near import parts_of
from reference.derivation.of_schemes import tableau_of_scheme, updates_of_scheme
from reference.derivation.stages import MOST, _forces, _same_betas, tableau_by_jumps
from reference.derivation.tableau import Tableau, nearest, tableau_of
from reference.derivation.updates import Coefficient, Symbol, Updates, in_words
from reference.schemes.catalogue import find
from reference.state import Array


def tableau(a: str, b: str, c: str | None = None) -> Tableau:
    """Of text: rows are separated by semicolons; c are the sums of rows where they are left out."""
    rows = tuple(tuple(map(Fraction, row.split())) for row in a.split(";"))
    sums = tuple(sum(row, start=Fraction(0)) for row in rows)
    return Tableau(rows, tuple(map(Fraction, b.split())), tuple(map(Fraction, c.split())) if c else sums)


HEUN = tableau("0 0; 1 0", "1/2 1/2")
MIDPOINT = tableau("1/2", "1")
#: Trapezoid rule: explicit in its first slope only.
LOBATTO = tableau("0 0; 1/2 1/2", "1/2 1/2")
#: Two half steps of the midpoint rule (Sanz-Serna 1988).
TWO_MIDPOINTS = tableau("1/4 0; 1/2 1/4", "1/2 1/2")
RK4 = tableau("0 0 0 0; 1/2 0 0 0; 0 1/2 0 0; 0 0 1 0", "1/6 1/3 1/3 1/6")


# --- Tableaux ---


@pytest.mark.parametrize(
    ("found", "explicit", "symplectic", "order"),
    [
        (HEUN, True, False, 2),
        (MIDPOINT, False, True, 2),
        (LOBATTO, False, False, 2),
        (TWO_MIDPOINTS, False, True, 2),
        (tableau("1/6 0; 1/3 1/3", "1/3 2/3"), False, True, 2),  # of a third of a step and of two thirds
        (RK4, True, False, 4),
        (tableau("1", "1"), False, False, 1),
    ],
)
def test_what_a_tableau_is(found: Tableau, explicit: bool, symplectic: bool, order: int) -> None:
    """Any entry on the diagonal or above makes it implicit; b_i a_ij + b_j a_ji = b_i b_j makes it symplectic."""
    assert (found.explicit, found.symplectic, found.order) == (explicit, symplectic, order)
    assert (found.exact, found.times_at_odds) == (True, ())
    rough = replace(found, b=(float(found.b[0]), *found.b[1:]))
    assert (rough.exact, rough.order) == (False, order)


def test_step_matrices_and_limits_by_hand() -> None:
    """Heun's, with damping: 1 + Z + Z^2/2; its limits are 2 on the real axis, none on the imaginary; RK4's 2 sqrt 2."""
    a, damped = np.array([0.3, 1.1]), np.array([0.2, 0.7])
    for i, found in enumerate(HEUN.step_matrices(a, damped)):
        z = np.array([[0.0, 1.0], [-a[i], -damped[i]]])
        np.testing.assert_allclose(found, np.eye(2) + z + z @ z / 2, atol=1e-14)
    assert HEUN.step_matrices(a)[1, 1].tolist() == pytest.approx([-1.1, 1 - 0.55])
    assert (HEUN.stable_along(-1)[0][1], HEUN.stable_along(1j)[0][1]) == pytest.approx((2.0, 0.0), abs=1e-6)
    assert RK4.stable_along(1j)[0][1] == pytest.approx(8**0.5, abs=1e-6)
    assert MIDPOINT.stable_along(-1)[0][1] > 1e3


def test_slopes_taken_twice_and_slopes_not_used_are_left_out() -> None:
    """Kutta's third order with its second slope asked for twice; and a slope that is asked for and thrown away."""
    twice = tableau("0 0 0 0; 1/2 0 0 0; 1/2 0 0 0; -1 1 1 0", "1/6 1/3 1/3 1/6")
    merged = twice.without_repeated()
    assert (merged.a[2], merged.b, merged.c) == (
        (-1, 2, 0),
        (Fraction(1, 6), Fraction(2, 3), Fraction(1, 6)),
        (0, Fraction(1, 2), 1),
    )
    # also from its formulas, but where they are to stay as they are written
    stages = [tableau_of(of_tableau(twice), repeated=repeated) for repeated in (False, True)]
    assert [found.stages for found in stages if found is not None] == [3, 4]
    assert tableau_of(of_tableau(twice)) == stages[0]
    # at other times they are two
    assert replace(twice, c=(Fraction(0), Fraction(1, 2), Fraction(1), Fraction(1))).without_repeated().stages == 4
    idle = tableau("0 0 0; 1/3 0 0; 1 0 0", "1/2 0 1/2")
    assert idle.without_unused().same(HEUN)
    assert HEUN.without_unused() is HEUN.without_repeated() is HEUN


def test_the_nearest_of_as_many_stages_is_told_with_what_differs() -> None:
    """By the number of coefficients that do; none where there is none of as many."""
    third = tableau("0 0; 1 0", "2/3 1/3")
    known = [("rk4", RK4), ("ralston", tableau("0 0; 2/3 0", "1/4 3/4")), ("heun", HEUN)]
    half, one, two = Fraction(1, 2), Fraction(1, 3), Fraction(2, 3)
    assert nearest(third, known) == ("heun", [("b1", two, half), ("b2", one, half)])
    assert nearest(MIDPOINT, known) is None
    assert HEUN.differences(known[1][1]) == [
        ("a21", Fraction(1), two),
        ("b1", half, Fraction(1, 4)),
        ("b2", half, Fraction(3, 4)),
    ]
    late = replace(HEUN, c=(Fraction(0), half))
    assert late.differences(HEUN) == [("c2", half, Fraction(1))]
    assert (late.same(HEUN), HEUN.same(HEUN), HEUN.same(RK4)) == (False, True, False)
    assert late.times_at_odds == ("slope 2 is taken 1 of a step on, and is told the time 1/2 of it on",)


def form(**coefficients: tuple[Any, int]) -> dict[Symbol, Coefficient]:
    """Of symbols as x0, p01: kind, age, call."""
    return {
        Symbol(name[0], int(name[1]), int(name[2:] or 0)): Coefficient(Fraction(number), power)  # type: ignore[arg-type]
        for name, (number, power) in coefficients.items()
    }


X, V = form(x0=(1, 0)), form(v0=(1, 0))


def test_a_tableau_needs_both_halves_alike() -> None:
    """Every coefficient; 1 times what they were; powers of h; slopes of this step: anything else is none."""
    k2 = form(x0=(1, 0), p00=(1, 1)), form(v0=(1, 0), q00=(1, 1))
    end = form(x0=(1, 0), p00=("1/2", 1), p01=("1/2", 1)), form(v0=(1, 0), q00=("1/2", 1), q01=("1/2", 1))

    def of(x: Any = end[0], v: Any = end[1]) -> Tableau | None:
        return tableau_of(Updates(((X, V), k2), (Fraction(0), Fraction(1)), (x, v)))

    assert of() == HEUN
    assert of(v=form(v0=(1, 0), q00=("1/2", 1), q01=("1/4", 1))) is None
    assert of(v=form(v0=(1, 0), q00=("1/4", 1), q01=("1/2", 1))) is None
    assert of(v=form(v0=(2, 0), q00=("1/2", 1), q01=("1/2", 1))) is None
    assert of(x=form(x0=(1, 0), p00=("1/2", 1), p01=("1/2", 2))) is None
    assert of(x=form(x0=(1, 0), v0=("1/2", 1), p01=("1/2", 1))) is None
    assert of(x=form(x0=(1, 0), p00=("1/2", 1), p10=("1/2", 1))) is None


def test_older_slopes_stand_behind_all_of_this_step() -> None:
    """By powers of h, then age, then call."""
    v = form(q10=("-1/3", 1), q01=(2, 1), v0=(1, 0), q00=(-1, 1))
    words = in_words(Updates(((X, V), (X, V)), (Fraction(0), Fraction(1)), (form(x0=(1, 0), p00=(1, 1)), v)))
    assert words[-1] == "v' = v - h f1.v + 2 h f2.v - h f1.v[-1]/3"
    v = form(v0=(1, 0), q00=(1, 2), q10=(1, 1))
    assert in_words(Updates(((X, V),), (Fraction(0),), (X, v)))[-1] == "v' = v + h a1[-1] + h^2 a1"


# --- Equal parts ---


def test_formulas_of_a_tableau_are_those_of_its_scheme() -> None:
    """And of no other: another number of calls, another weight, nothing."""
    heun, euler = updates_of_scheme(find("heun")), updates_of_scheme(find("euler"))
    assert same_updates(of_tableau(HEUN), heun)
    assert not same_updates(of_tableau(tableau("0 0; 1 0", "2/3 1/3")), heun)
    assert not same_updates(euler, heun)
    assert not same_updates(None, heun)
    assert [tableau_of_scheme(find(name)) for name in ("heun", "rk4", "kick_drift")] == [HEUN, RK4, None]
    assert tableau_of_scheme(find("backward_euler")) is None


def test_sub_steps_of_one_method_are_found_in_the_formulas() -> None:
    """Two of Heun's by its tableau alone; nothing of one step, of implicit ones, or of nothing."""
    both = repeated(of_tableau(HEUN), 2)
    assert both is not None
    whole = tableau_of(both)
    assert whole is not None
    assert (whole.stages, whole.order) == (4, 2)
    found = parts_of(whole, None)
    assert found is not None
    assert (found.count, found.undamped) == (2, False)
    assert same_updates(found.one, of_tableau(HEUN))
    assert [parts_of(one, None) for one in (HEUN, TWO_MIDPOINTS, None)] == [None] * 3


def test_sub_steps_that_share_a_slope_are_found_among_those_that_are_known() -> None:
    """Velocity Verlet twice, the slope between taken once: v' = v + h (a1 + 2 a2 + a3)/4."""
    verlet = without_damping(by_accelerations(updates_of_scheme(find("velocity_verlet"))))
    points = (
        form(x0=(1, 0)),
        form(x0=(1, 0), v0=("1/2", 1), q00=("1/8", 2)),
        form(x0=(1, 0), v0=(1, 1), q00=("1/4", 2), q01=("1/4", 2)),
    )
    end = points[2], form(v0=(1, 0), q00=("1/4", 1), q01=("1/2", 1), q02=("1/4", 1))
    whole = Updates(tuple((x, {}) for x in points), (Fraction(0), Fraction(1, 2), Fraction(1)), end)
    found = equal_parts(whole, lambda: {"velocity_verlet": verlet})
    assert found is not None
    assert (found.count, found.one) == (2, verlet)
    other = replace(whole, end=(end[0], form(v0=(1, 0), q00=("1/4", 1), q01=("1/4", 1), q02=("1/2", 1))))
    assert equal_parts(other, lambda: {"velocity_verlet": verlet}) is None
    moved = replace(whole, end=(form(x0=(1, 0), v0=(1, 1), q00=("1/2", 2)), end[1]))
    assert equal_parts(moved, lambda: {"velocity_verlet": verlet}) is None
    assert equal_parts(whole, dict) is None


@pytest.mark.parametrize("name", ["heun", "adams_bashforth_2", "backward_euler"])
def test_coefficients_of_what_solves_equations_are_no_others(name: str) -> None:
    """A scheme of accelerations has its formulas, whether or not it looks back; one of one step its tableau."""
    assert implicit_multistep(find(name)) is None
    assert (implicit_tableau(find(name)) is None) == (name != "backward_euler")


# --- Forces seen from outside ---


@dataclass
class OfTableau:
    """A step matrix that is a tableau's."""

    tableau: Tableau
    damped: bool = True
    dragged: bool = True

    def at(self, a: Array, b: Array, d: Array) -> Array:
        """At these."""
        return self.tableau.step_matrices(a, b + d)


def taken(found: Tableau) -> list[Taken]:
    """The forces that it takes: c, b, beta = b A, and A^2 F of the forces before, of a mass that flies past."""
    a, b = np.array(found.a, float), np.array(found.b, float)
    c = a.sum(axis=1)
    beta, squared = b @ a, a @ a
    earlier = [0.0 if not c[i] else float(squared[i] @ _forces(c, i)) for i in range(len(b))]
    return [Taken(found.c[i], found.b[i], Fraction(beta[i]).limit_denominator(1000), earlier[i]) for i in range(len(b))]


@pytest.mark.parametrize("known", [tableau("0", "1"), HEUN, tableau("0 0 0; 1/2 0 0; -1 2 0", "1/6 2/3 1/6"), RK4])
def test_a_tableau_by_its_forces(known: Tableau) -> None:
    """From c, b, beta and the shifts; with one of these wrong, or the step matrix another's, there is none."""
    forces, matrix = taken(known), OfTableau(known)
    found = tableau_by_jumps(forces, matrix)  # type: ignore[arg-type]
    assert found is not None
    assert found.same(known)
    others = []
    for i, force in enumerate(forces):
        spoilt = [replace(force, **{name: getattr(force, name) + 1}) for name in ("in_position", "in_velocity")]
        spoilt += [replace(force, by_earlier=force.by_earlier + 0.3)] * bool(i)  # nothing is before the first
        others += [[*forces[:i], wrong, *forces[i + 1 :]] for wrong in spoilt]
    assert [tableau_by_jumps(other, matrix) for other in others] == [None] * len(others)  # type: ignore[arg-type]
    another = OfTableau(tableau("0 0; 1 0", "1/4 3/4"))
    assert tableau_by_jumps(forces, another) is None  # type: ignore[arg-type]


def test_fractions_have_to_give_every_beta() -> None:
    """To 1e-8, each of them."""
    forces = taken(HEUN)
    assert _same_betas(HEUN, forces)
    for i in range(2):
        for off, same in ((2e-8, False), (5e-9, True)):
            other = [
                replace(force, in_position=float(force.in_position) + off * (i == j)) for j, force in enumerate(forces)
            ]
            assert _same_betas(HEUN, other) == same


def test_forces_that_are_none_too_many_or_not_at_the_start_give_no_tableau() -> None:
    """A method takes its first slope at the start, and at most five are told."""
    matrix: Any = OfTableau(HEUN)
    assert tableau_by_jumps([], matrix) is None
    assert tableau_by_jumps([Taken(Fraction(1), Fraction(1), Fraction(0))], matrix) is None
    many = [Taken(Fraction(i, MOST), Fraction(1, MOST + 1), Fraction(0)) for i in range(MOST + 1)]
    assert tableau_by_jumps(many, matrix) is None
