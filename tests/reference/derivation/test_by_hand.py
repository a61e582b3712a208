"""What is told of formulas, matrices and multistep methods that are written down here: by hand, and by textbooks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from reference.derivation.consequences import FAR, by_jury, consequences, windows
from reference.derivation.fit import Samples
from reference.derivation.formula import ONE, Formula, exact_text, product, written
from reference.derivation.irrational import irrational
from reference.derivation.multistep import Multistep, multistep_of
from reference.derivation.near import begun_otherwise, nearest_known
from reference.derivation.of_schemes import updates_of_scheme
from reference.derivation.oscillators import runs_of
from reference.derivation.over_dts import DTS, OverDts, _off, over_dts
from reference.derivation.small_fractions import fraction_or_itself, recognised, simplest_within
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.motion import Motion
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.state import Array, State
from reference.stepper import SchemeStepper, stepper_named

F = Fraction
A, B, D, E, DECAY = (1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0), (0, 0, 0, 1, 0), (0, 0, 0, 0, 1)

# --- Formulas ---


def test_a_formula_is_what_it_says() -> None:
    """(2 E - a b^2/3) / (1 + d + D/2), with E = exp(-b) and D = exp(-d), at two points."""
    formula = Formula({E: F(2), (1, 2, 0, 0, 0): F(-1, 3)}, {ONE: F(1), D: F(1), DECAY: F(1, 2)})
    a, b, d = np.array([0.3, 1.2]), np.array([0.7, 0.1]), np.array([0.2, 0.9])
    expected = (2 * np.exp(-b) - a * b**2 / 3) / (1 + d + np.exp(-d) / 2)
    np.testing.assert_allclose(formula.at(a, b, d), expected, rtol=1e-15)
    assert str(Formula(formula.numerator, {ONE: F(1), D: F(1)})) == "(2 E - a b^2/3)/(1 + d)"
    assert [formula.asks(v) for v in "abdED"] == [True] * 5
    assert [formula.divided_by(v) for v in "abdED"] == [False, False, True, False, True]
    assert formula.exact
    assert not formula.is_polynomial
    rough = Formula({ONE: 0.123456, A: F(1, 3)}, {ONE: F(1), B: -0.98765})
    assert not rough.exact
    assert rough.rounded(2) == Formula({ONE: 0.12, A: F(1, 3)}, {ONE: F(1), B: -0.99})


def test_what_depends_on_a_sum_only_is_written_by_one_letter() -> None:
    """(1 + (b + d)^2)/(1 + 3 b + 3 d) is; with another factor before the mixed term, or below, it is not."""
    above = {ONE: F(1), (0, 2, 0, 0, 0): F(1), (0, 1, 1, 0, 0): F(2), (0, 0, 2, 0, 0): F(1)}
    below = {ONE: F(1), B: F(3), D: F(3)}
    assert str(Formula(above, below).of_sum()) == "(1 + b^2)/(1 + 3 b)"
    assert Formula({**above, (0, 1, 1, 0, 0): F(1)}, below).of_sum() is None
    assert Formula(above, {**below, D: F(2)}).of_sum() is None
    # an exponential is of one of the two alone
    assert Formula({(0, 1, 0, 1, 0): F(1), (0, 0, 1, 1, 0): F(1)}).of_sum() is None
    assert Formula({DECAY: F(1)}).of_sum() is None


def test_terms_are_written_by_powers_of_h() -> None:
    """Signs, factors of one, fractions and numbers; nothing is 0."""
    assert written({(0, 1, 1, 0, 0): F(-1), A: 0.5, B: F(-2, 3), ONE: F(-1)}) == "-1 - 2 b/3 + 0.5 a - b d"
    assert written({}) == "0"
    assert [product(c, "a") for c in (F(1), F(3), F(1, 2), F(3, 4), 0.25)] == ["a", "3 a", "a/2", "3 a/4", "0.25 a"]
    assert [exact_text(c) for c in (F(1, 2), 0.5 + 3**0.5 / 6, 0.1234567891)] == ["1/2", "1/2 + sqrt(3)/6", "0.1234568"]


# --- Numbers ---


@pytest.mark.parametrize(
    ("x", "text"),
    [
        *[(n**0.5 / 3 - 0.25, f"-1/4 + sqrt({n})/3") for n in (2, 3, 5, 6, 7, 10, 15)],
        (-(7**0.5), "-sqrt(7)"),
        (2 * 3**0.5 + 1, "1 + 2 sqrt(3)"),
        (2 ** (1 / 3) / 4 - 3 * 4 ** (1 / 3), "cbrt(2)/4 - 3 cbrt(4)"),
        (3 * 2 ** (1 / 3) - 4 ** (1 / 3) / 12, "3 cbrt(2) - cbrt(4)/12"),
        (1 + 2 ** (1 / 3) / 2, "1 + cbrt(2)/2"),
        (4 ** (1 / 3) / 3, "cbrt(4)/3"),
        (0.25, None),
        (-7 / 12, None),
        (11**0.5, None),
        (3 * 3**0.5, None),
    ],
)
def test_roots_are_told(x: float, text: str | None) -> None:
    """Of each of those looked for, the largest factors among them; of no other."""
    assert irrational(x) == text


def test_fractions_on_either_side_of_what_chance_gives() -> None:
    """A denominator q is taken where tol q^2 < 1e-4; what is within tol of zero is zero, with either sign."""
    assert [recognised(1 / 99, 1e-8), recognised(1 / 101, 1e-8)] == [F(1, 99), None]
    assert [recognised(-1 / 99, 1e-8), simplest_within(-0.334, 0.01)] == [F(-1, 99), F(-1, 3)]
    assert [fraction_or_itself(x, 1e-6) for x in (5e-7, -5e-7, 2**0.5)] == [0, 0, 2**0.5]
    assert [simplest_within(x, 0.25) for x in (0.2, -0.2, 2.9, 0.3)] == [0, 0, 3, F(1, 2)]


# --- Step matrices ---


def of(*entries: dict[Any, Any] | Formula, damped: bool = False, dragged: bool = False) -> StepMatrix:
    """With these entries, polynomials or quotients."""
    at = Samples(np.zeros(1), np.zeros(1), np.zeros(1))
    made = tuple(entry if isinstance(entry, Formula) else Formula(entry) for entry in entries)
    return StepMatrix(made, damped, dragged, at, np.zeros((1, 2, 2)))  # type: ignore[arg-type]


def test_orders_by_hand() -> None:
    """Of M - exp([[0, 1], [-a, -b]]): Taylor's polynomial of order 3; a term less; exponentials, which count as series.

    Kicked, with exact damping, and then drifted: of order 1.
    """
    third = {
        "m11": {ONE: F(1), A: F(-1, 2)},
        "m12": {ONE: F(1), B: F(-1, 2), A: F(-1, 6), (0, 2, 0, 0, 0): F(1, 6)},
        "m21": {A: F(-1), (1, 1, 0, 0, 0): F(1, 2)},
        "m22": {
            ONE: F(1), B: F(-1), A: F(-1, 2), (0, 2, 0, 0, 0): F(1, 2), (1, 1, 0, 0, 0): F(1, 3),
            (0, 3, 0, 0, 0): F(-1, 6),
        },
    }  # fmt: skip
    third["m11"][(1, 1, 0, 0, 0)] = F(1, 6)
    third["m21"] |= {(2, 0, 0, 0, 0): F(1, 6), (1, 2, 0, 0, 0): F(-1, 6)}
    taylor = consequences(of(*third.values(), damped=True))
    assert (taylor.order, taylor.undamped_order) == (3, 3)
    dragged = [{(m[0], 0, m[1], 0, 0): c for m, c in entry.items()} for entry in third.values()]
    assert consequences(of(*dragged, dragged=True)).order == 3
    less = {**third, "m11": {ONE: F(1), A: F(-1, 2)}}
    assert (consequences(of(*less.values(), damped=True)).order, consequences(of(*less.values())).order) == (2, 3)
    series = {**third, "m22": {E: F(1), A: F(-1, 2), (1, 1, 0, 0, 0): F(1, 3)}}
    assert consequences(of(*series.values(), damped=True)).order == 3
    kicked = of({ONE: F(1), A: F(-1)}, {E: F(1)}, {A: F(-1)}, {E: F(1)}, damped=True)
    assert (consequences(kicked).order, consequences(kicked).undamped_order) == (1, 1)


def test_stability_by_hand() -> None:
    """Matrices within and without, on each side of D = 1, T = 1 + D and T = -1 - D (Jury 1964)."""
    inside = [(1.9, 0.95), (-1.9, 0.95), (0.3, 1.0), (2.0, 1.0), (0.0, -1.0), (0.5, -0.5)]
    outside = [(1.96, 0.95), (-1.96, 0.95), (0.3, 1.001), (0.0, -1.001), (0.51, -0.5), (2.0, 0.99)]
    # with the trace T and the determinant D: [[T, -D], [1, 0]]
    matrices = np.array([[[t, -d], [1.0, 0.0]] for t, d in inside + outside])
    assert by_jury(matrices).tolist() == [True] * len(inside) + [False] * len(outside)
    # Jury's conditions may be missed by 1e-11 of 1 + |T| + |D|
    assert by_jury(np.array([[[0.3, -1 - 2e-11], [1, 0]], [[0.3, -1 - 3e-11], [1, 0]]])).tolist() == [True, False]


@pytest.mark.parametrize(
    ("stable", "found"),
    [
        (lambda s: s < 2.0, ((0.0, 2.0),)),
        (lambda s: (s < 2.0) | ((s > 3.0) & (s < 100.0)), ((0.0, 2.0), (3.0, 100.0))),
        (lambda s: s > 3.0, ((0.0, 0.0), (3.0, FAR))),
        (lambda s: s > 0, ((0.0, FAR),)),
        (lambda s: s < 0, ((0.0, 0.0),)),
    ],
)
def test_windows_of_stability(stable: Callable[[Array], Any], found: tuple[tuple[float, float], ...]) -> None:
    """Their edges to 1e-12; the first begins at 0, if as an empty one; to FAR means without limit."""
    assert windows(stable) == pytest.approx(np.array(found), rel=1e-11)


def test_what_is_divided_by_is_implicit() -> None:
    """Each of the three; and a step back undoes one with equal diagonal entries and the determinant 1."""
    below = Formula({ONE: F(1)}, {ONE: F(1), B: F(1), D: F(1)})
    found = consequences(of({ONE: F(1)}, below, {A: F(-1)}, below, damped=True, dragged=True))
    assert found.implicit == ("damping", "drag")
    # undamped it is [[1, 1], [-a, 1]] of determinant 1 + a
    assert (found.symplectic, found.reversible, found.periods) == (False, False, ())
    turned = consequences(of({ONE: F(1), A: F(-1, 2)}, {ONE: F(1), A: F(-1, 4)}, {A: F(-1)}, {ONE: F(1), A: F(-1, 2)}))
    assert (turned.symplectic, turned.reversible, turned.implicit) == (True, True, ())
    assert turned.imaginary_axis[0] == pytest.approx((0.0, 2.0), abs=1e-6)
    # of determinant 1, and with equal diagonal entries at a = 1 only
    apart = consequences(of({A: F(1)}, {ONE: F(1)}, {ONE: F(-1), A: F(1)}, {ONE: F(1)}))
    assert (apart.symplectic, apart.reversible) == (True, False)


def test_periods_are_told_below_the_first_limit_only() -> None:
    """Of [[1, 1], [m21, 1 - a]] with the determinant 1 + a (a - 0.09) (1 - a): it grows from h w = 0.3 to 1."""
    m21 = {A: F(-91, 100), (2, 0, 0, 0, 0): F(-109, 100), (3, 0, 0, 0, 0): F(1)}
    found = consequences(of({ONE: F(1)}, {ONE: F(1)}, m21, {ONE: F(1), A: F(-1)}))
    first, second = found.imaginary_axis
    assert (first[1], second[0]) == pytest.approx((0.3, 1.0), abs=1e-6)
    ((s, _, amplitude),) = found.periods
    assert (s, amplitude < 1) == (0.1, True)


# --- The nearest scheme ---


def lopsided_verlet(motion: Motion, state: State, dt: float) -> State:
    """Verlet with 1/3 for the first half, and 1/4 and 3/4 for the others."""
    a = motion.acceleration(state)
    x = state.positions + dt * state.velocities + dt**2 * a / 3
    b = motion.acceleration(State(state.time + dt, x, state.velocities + dt * a))
    return State(state.time + dt, x, state.velocities + dt * (a + 3 * b) / 4)


def half_drifted(motion: Motion, state: State, dt: float) -> State:
    """Kick-drift that drifts by the mean velocity."""
    kicked = state.kick(dt * motion.acceleration(state))
    return State(kicked.time + dt, state.positions + dt / 2 * (state.velocities + kicked.velocities), kicked.velocities)


@pytest.mark.rotating(3)
def test_the_nearest_is_told_with_what_differs() -> None:
    """By formulas, each coefficient where it stands; by step matrices, each entry; and who is begun otherwise."""
    assert nearest_known(None, updates_of_scheme(Scheme(lopsided_verlet, 2)), None) == (
        "h^2 a1 in x where a2 is taken is 1/3 where velocity_verlet has 1/2, "
        "h^2 a1 in x at the end is 1/3 where velocity_verlet has 1/2, "
        "h a1 in v at the end is 1/4 where velocity_verlet has 1/2, "
        "h a2 in v at the end is 3/4 where velocity_verlet has 1/2"
    )
    drifted = Scheme(half_drifted, 1)
    assert (
        nearest_known(None, updates_of_scheme(drifted), None) == "h^2 a1 in x at the end is 1/2 where kick_drift has 1"
    )
    matrix = step_matrix(runs_of(SchemeStepper(drifted)))
    words = "m11 is 1 - a/2 where euler has 1, m12 is 1 - b/2 - d/2 where euler has 1"
    assert nearest_known(None, None, matrix) == words
    many = replace(matrix, substeps=3)
    assert nearest_known(None, None, many) == f"its step is 3 of h/3, each of which {words}"
    same = step_matrix(runs_of(stepper_named("heun")))
    assert nearest_known(None, None, same).startswith("its step matrix is that of heun: they differ in motion that is")
    two_steps, one_step = updates_of_scheme(find("adams_bashforth_2")), updates_of_scheme(find("euler"))
    told = [begun_otherwise(later, None, first) for later, first in ((two_steps, one_step), (two_steps, None))]
    assert told == ["adams_bashforth_2, begun with euler", "adams_bashforth_2, begun otherwise"]
    assert begun_otherwise(one_step, None, one_step) == ""


# --- Multistep methods ---

#: Of HNW III.1 and the tables there: alpha, beta with that of f(y1) first, order.
METHODS = {
    "AB2": ("1 0", "0 3/2 -1/2", 2),
    "AB3": ("1 0 0", "0 23/12 -4/3 5/12", 3),
    "AB4": ("1 0 0 0", "0 55/24 -59/24 37/24 -3/8", 4),
    "AM3": ("1 0", "5/12 2/3 -1/12", 3),
    "AM4": ("1 0 0", "3/8 19/24 -5/24 1/24", 4),
    "BDF3": ("18/11 -9/11 2/11", "6/11 0 0 0", 3),
    "BDF4": ("48/25 -36/25 16/25 -3/25", "12/25 0 0 0 0", 4),
    "Milne": ("0 1", "1/3 4/3 1/3", 4),
    "Nystrom": ("0 1", "0 2 0", 2),
}


def method(name: str) -> Multistep:
    """One of them."""
    alpha, beta, _ = METHODS[name]
    return Multistep(tuple(map(F, alpha.split())), tuple(map(F, beta.split())))


def row(name: str, count: int) -> tuple[float, list[Array], list[Array]]:
    """The step, states and slopes of a row of steps of two swings, y' = A y, from an exact past."""
    h, found = 0.1, method(name)
    matrix = np.array([[0.0, 1, 0, 0], [-3, -0.2, 1, 0], [0, 0, 0, 1], [0.5, 0, -1, -0.1]])
    values, vectors = np.linalg.eig(matrix)
    flow = (vectors * np.exp(h * values) @ np.linalg.inv(vectors)).real
    states = [np.array([1.0, -0.5, 0.3, 2.0])]
    for _ in range(3):
        states.append(flow @ states[-1])
    for _ in range(count):
        past = states[::-1]
        right = sum(float(a) * y for a, y in zip(found.alpha, past, strict=False))
        right = right + sum(h * float(b) * matrix @ y for b, y in zip(found.beta[1:], past, strict=False))
        states.append(np.linalg.solve(np.eye(4) - h * float(found.beta[0]) * matrix, right))
    return h, states, [matrix @ y for y in states]


@pytest.mark.parametrize("name", METHODS)
def test_methods_of_the_textbook(name: str) -> None:
    """Their order; whether they solve equations; and each found again from its steps, and told from the others."""
    known = method(name)
    assert (known.order, known.explicit) == (METHODS[name][2], METHODS[name][1].startswith("0 "))
    found = multistep_of(*row(name, 12))
    assert found is not None
    assert found == known
    h, states, slopes = row(name, 12)  # one more, that stands still
    assert multistep_of(h, [np.append(y, 1.0) for y in states], [np.append(f, 0.0) for f in slopes]) == known
    assert [other for other in METHODS if known.same(method(other))] == [name]
    assert not known.same(replace(known, beta=(*known.beta[:-1], known.beta[-1] + 2e-8)))
    assert known.same(replace(known, beta=(*known.beta[:-1], float(known.beta[-1]) + 0.5e-8)))


def test_methods_are_written_as_formulas() -> None:
    """Factors of one and zero are not; the first term may be less than nothing."""
    assert str(method("AB2")) == "y1 = y0 + 3 h f(y0)/2 - h f(y-1)/2"
    assert str(Multistep((F(-1), F(2)), (F(0), F(1), F(0)))) == "y1 = -y0 + 2 y-1 + h f(y0)"
    assert method("AB2").text() == {"alpha": ["1", "0"], "beta": ["0", "3/2", "-1/2"]}


# --- Over dt ---


def test_a_rule_that_is_kept_or_not_is_told_in_a_sentence() -> None:
    """Where it is the same, another, without a name, off, not told; a name is a name in whatever step."""
    assert str(OverDts("heun", (0.1, 0.2))) == "It is heun at dt = 0.1, 0.2 s, too"
    assert str(OverDts("heun", ())) == ""
    assert str(OverDts("heun", (), failed=(0.1,))) == "not told at 0.1 s, where a step fails"
    other = OverDts("heun", (0.3,), (1e-5, 0.1, 0.2), (None, "euler", None), (1.0, 2.0, 3.0))
    assert other.changed == ((1e-5, None), (0.1, "euler"), (0.2, None))
    assert (other.loose, other.is_another) == ((), True)
    assert str(other) == (
        "it changes its rule with dt: it is heun at the dt that named it and at 0.3 s, but not at 1e-05 s, where it "
        "was not identified, as rounding probably hides which scheme it is; 0.1 s, where it is euler; 0.2 s, where it "
        "was not identified"
    )
    assert str(replace(other, iterates=True)).startswith("it is not the same at every dt: ")
    assert not OverDts("heun", (), (0.1,), (None,), (1.0,)).is_another


def test_each_dt_is_tried_by_itself() -> None:
    """Heun, but Euler at one dt, no numbers at another, no step at a third; in single precision short ones drown."""
    heun, euler = runs_of(stepper_named("heun")), runs_of(stepper_named("euler"))

    def runs(asked: Any) -> list[Outcome]:
        found = []
        for run in asked:
            (outcome,) = (euler if run.dt == DTS[3] else heun)([run])
            if run.dt == DTS[2]:
                outcome.trajectory.velocities[-1, 1] = np.nan
            found.append(Outcome("crashed", "gone") if run.dt == DTS[4] else outcome)
        return found

    system = find_scene("string").system({"masses": 4, "angle": 30.0})
    held = over_dts(runs, "heun", system, "double", lambda on, dt: f"{on.stiffness[0]:.0f} at {dt:g}")
    assert (held.same, held.other, held.failed, held.drowned) == (DTS[:2], DTS[3:4], (DTS[2], DTS[4]), ())
    single = over_dts(runs, "heun", system, "single", lambda on, dt: None)
    assert (single.drowned, single.failed) == (DTS[:2], held.failed)
    assert held.named_there == ("200 at 0.02",)
    assert 0.01 < held.off[0] < 10


@pytest.mark.parametrize(("refused", "moving"), [(DTS, [True, False]), (DTS[4:], [True])])
def test_a_string_is_set_in_motion_where_the_stepper_can_begin_so(refused: Any, moving: list[bool]) -> None:
    """It is asked again at rest where it can begin so at no dt; one that it cannot is told as that."""
    heun, asked = runs_of(stepper_named("heun")), []

    def runs(those: Any) -> list[Outcome]:
        asked.append(bool(those[0].system.velocities.any()))
        at_rest = Outcome("unsupported", "at rest only")
        return [at_rest if r.dt in refused and r.system.velocities.any() else heun([r])[0] for r in those]

    system = find_scene("string").system({"masses": 4, "angle": 30.0})
    held = over_dts(runs, "heun", system, "double", lambda on, dt: None)
    assert asked == moving
    assert held.failed == (() if len(moving) == 2 else (DTS[4],))
    assert DTS[3] in held.same


def test_a_step_is_off_by_a_part_of_its_largest_number() -> None:
    """Of a metre at least."""
    assert _off(np.array([1e-3, 102.0]), np.array([1e-3, 100.0])) == pytest.approx(0.02)
    assert _off(np.array([1e-3, 0.02]), np.array([1e-3, 0.01])) == pytest.approx(0.01)
