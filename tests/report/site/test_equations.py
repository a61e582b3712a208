"""The equations on the site are what schemes compute: they are evaluated, and compared with the schemes' own steps."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from reference.compiled.expressions import OPERATIONS, Expression
from reference.compiled.tracing import Program, trace, why_not_compiled
from reference.forces import SpringMotion
from reference.motion import Motion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find, schemes
from reference.state import State
from report.site import solved_form
from report.site.generated import schemes_page
from report.site.linear_form import Equations, NotLinear, Sum, equations
from report.site.mathml import of_equations
from report.site.solved_form import equations_of

TRACED = [name for name, scheme in schemes().items() if why_not_compiled(scheme) is None]

#: Those that a trace does not show, but their steps do; of the wide catalogue, too.
SOLVED = ["backward_euler", "implicit_midpoint", "beeman", "newmark", "hht", "hht(alpha=-0.3)", "generalised_alpha"]
SOLVED += ["bdf2", "radau_iia", "adams_bashforth_2"]

#: Step [s], and up to which part of itself a sum may differ in another order of its terms.
H, ROUNDING = 0.01, 1e-12


def value(what: Sum, numbers: dict[str, Any], h: float = H) -> Any:
    """A sum for some numbers."""
    return sum(
        float(factor) * h**power * numbers[name]
        for name, coefficient in what.items()
        for power, factor in coefficient.items()
    )


def stepped(written: Equations, motion: Any, state: State) -> tuple[Any, Any]:
    """The new state by the equations alone."""
    numbers: dict[str, Any] = {"x": state.positions, "v": state.velocities}
    for i, (x, v) in enumerate(written.stages):
        numbers[f"a{i}"] = motion.acceleration(State(0.0, value(x, numbers), value(v, numbers)))
    return value(written.end[0], numbers), value(written.end[1], numbers)


def check(written: Equations, scheme: Scheme) -> None:
    """The equations and the scheme's own step come to the same on a damped string in motion."""
    system = find_scene("string").system({"masses": 4, "damping": 0.3, "drag": 0.1})
    motion = SpringMotion(system)
    random = np.random.default_rng(5)
    moving = ~system.fixed[:, None]
    start = State(
        0.0, system.positions + 0.05 * moving * random.normal(size=(5, 2)), moving * random.normal(size=(5, 2))
    )
    end = scheme.on(motion)(start, H)
    x, v = stepped(written, motion, start)
    assert x == pytest.approx(end.positions, rel=ROUNDING, abs=ROUNDING)
    assert v == pytest.approx(end.velocities, rel=ROUNDING, abs=ROUNDING)


@pytest.mark.parametrize("name", TRACED)
def test_the_equations_step_as_the_scheme_does(name: str) -> None:
    """Every scheme that can be traced; the tolerance is rounding, of sums in another order."""
    check(equations(trace(find(name))), find(name))


def check_solved(written: Equations, scheme: Scheme) -> None:
    """A second step, from what a first one remembers: accelerations are put into their own equations again and again.

    They come nearer by h^2 k / m = 0.01 each time, to what Newton's method leaves: a billionth.
    """
    system, h = find_scene("string").system({"masses": 4, "damping": 0.03, "drag": 0.1}), 1e-3
    motion, chance = SpringMotion(system), np.random.default_rng(5)
    moving = ~system.fixed[:, None]
    start = State(
        0.0, system.positions + 0.05 * moving * chance.normal(size=(5, 2)), moving * chance.normal(size=(5, 2))
    )
    here = scheme.on(motion)(start, h)
    end = scheme.on(motion)(here, h)
    numbers: dict[str, Any] = {
        "x": here.positions,
        "v": here.velocities,
        "x-1": start.positions,
        "v-1": start.velocities,
    }
    numbers |= {"a-1": motion.acceleration(start), **{f"m{i}": kept for i, kept in enumerate(here.memory)}}
    numbers |= {f"a{i}": 0 * here.positions for i in range(len(written.stages))}
    for _ in range(30):
        for i, (x, v) in enumerate(written.stages):
            numbers[f"a{i}"] = motion.acceleration(State(0.0, value(x, numbers, h), value(v, numbers, h)))
    found = [value(what, numbers, h) for what in (*written.end, *written.remembers.values())]
    kept = [end.memory[int(name[1:])] for name in written.remembers]
    for one, other in zip(found, [end.positions, end.velocities, *kept], strict=True):
        assert one == pytest.approx(other, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", SOLVED)
def test_equations_that_are_solved_are_those_of_the_step(name: str) -> None:
    """Of springs in motion, which are not linear, though they were seen on linear motion."""
    check_solved(equations_of(find(name)), find(name))


def test_a_wrong_equation_is_caught() -> None:
    """Shown to fail: backward Euler's are not the implicit midpoint rule's; HHT's memory is no other's."""
    with pytest.raises(AssertionError):
        check_solved(equations_of(find("backward_euler")), find("implicit_midpoint"))
    hht = equations_of(find("hht"))
    with pytest.raises(AssertionError):
        check_solved(replace(hht, remembers={"m0": {"a1": {0: Fraction(1)}}}), find("hht"))


def test_solved_equations_are_written_as_in_a_textbook() -> None:
    """Backward Euler: a0 = a(x', v'); BDF2 looks back at x-1 and v-1, HHT remembers its own acceleration."""
    euler, bdf2, hht = (of_equations(equations_of(find(name))) for name in ("backward_euler", "bdf2", "hht"))
    plain = re.sub(r"<[^>]*>", "", euler)
    assert plain == "a\u2080=a(x\u2032,v\u2032)x\u2032=x+hv+h\u00b2a\u2080v\u2032=v+ha\u2080"
    assert "x\u208b\u2081" in bdf2
    assert "m\u2080\u2032" in hht
    assert "m\u2080" not in bdf2


@pytest.mark.parametrize(
    "name", ["euler_in_place", "drift_kick_exponential_damping", "stormer_verlet", "kick_drift_implicit_drag"]
)
def test_what_is_no_set_of_sums_has_none(name: str) -> None:
    """It goes from mass to mass, has exponentials, divides by dt, or by what drag makes of it."""
    with pytest.raises(NotLinear):
        equations_of(find(name))


def test_a_wrong_coefficient_is_caught() -> None:
    """Shown to fail: Heun's equations are not kick-drift's, and one with a third in place of a half is neither."""
    heun = equations(trace(find("heun")))
    with pytest.raises(AssertionError):
        check(heun, find("kick_drift"))
    third = {**heun.end[1], "a0": {1: Fraction(1, 3)}}
    with pytest.raises(AssertionError):
        check(Equations(heun.stages, (heun.end[0], third)), find("heun"))


def test_heun_is_written_as_in_a_textbook() -> None:
    """X' = x + h v + h^2/2 a0, v' = v + h/2 a0 + h/2 a1, the second slope at x + h v, v + h a0."""
    one, half = Fraction(1), Fraction(1, 2)
    heun = equations(trace(find("heun")))
    assert heun.stages[1] == ({"x": {0: one}, "v": {1: one}}, {"v": {0: one}, "a0": {1: one}})
    assert heun.end == (
        {"x": {0: one}, "v": {1: one}, "a0": {2: half}},
        {"v": {0: one}, "a0": {1: half}, "a1": {1: half}},
    )


def test_what_is_no_sum_is_not_written_as_one() -> None:
    """A square of positions; a coefficient that is no power of dt."""
    x, v = Expression("x"), Expression("v")
    with pytest.raises(NotLinear):
        equations(Program(((x, v),), (Expression("{} * {}", (x, x)), v)))
    with pytest.raises(NotLinear):
        equations(Program(((x, v),), (Expression("{} * {}", (Expression("c0"), x)), v), (("exp", np.exp),)))


def test_every_operation_is_multiplied_out() -> None:
    """By hand: 3 (h/2 x - v) / 4 and -(v - +x) h/2, with coefficients before and behind."""
    x, v, h, three, four = (Expression(name) for name in ("x", "v", "c0", "(3.0)", "4.0"))
    write = {function.__name__: lambda *parts, t=text: Expression(t, parts) for function, text in OPERATIONS.items()}
    inner = write["subtract"](write["multiply"](h, x), v)
    place = write["divide"](write["multiply"](three, inner), four)
    speed = write["multiply"](write["negative"](write["subtract"](v, write["positive"](x))), h)
    (made,) = equations(Program(((place, speed),), (x, write["add"](v, x)), (("dt / 2", lambda dt: dt / 2),))).stages
    assert made == (
        {"x": {1: Fraction(3, 8)}, "v": {0: Fraction(-3, 4)}},
        {"v": {1: Fraction(-1, 2)}, "x": {1: Fraction(1, 2)}},
    )
    for odd in (write["divide"](x, h), write["divide"](x, v), write["multiply"](x, v), write["square"](x)):
        with pytest.raises(NotLinear):
            equations(Program(((x, v),), (odd, v), (("dt / 2", lambda dt: dt / 2),)))


def test_a_parameter_is_a_fraction_in_the_equations() -> None:
    """A scheme of two stages, the second slope two thirds of a step on."""

    def ralston(motion: Motion, state: State, dt: float) -> State:
        """Ralston."""
        here = motion.slope(state)
        there = motion.slope(state + 2 / 3 * dt * here)
        return state + dt * (0.25 * here + 0.75 * there)

    scheme = Scheme(ralston, 2)
    written = equations(trace(scheme))
    assert written.stages[1][0]["v"] == {1: Fraction(2, 3)}
    check(written, scheme)


def test_the_page_has_every_scheme_with_its_equations_or_its_function() -> None:
    """Those that cannot be traced stand as they are written."""
    page = schemes_page()
    sections = {part.partition("\n")[0].strip(): part for part in page.split("\n### ")[1:]}
    assert sections.keys() == schemes().keys()
    for name, text in sections.items():
        assert ("<math" in text) == (name in [*TRACED, *SOLVED])
        assert f"def {name}(" in text
    assert of_equations(equations(trace(find("rk4")))) in sections["rk4"]


@pytest.mark.parametrize(
    ("at", "expected"),
    [
        ([0.0, 0.0, 0.0], None),
        ([0.5, 0.5, 0.5], (0, Fraction(1, 2))),
        ([1 / 32, 1 / 64, 1 / 16], (1, Fraction(1, 2))),
        ([1 / 256, 1 / 1024, 1 / 64], (2, Fraction(1))),
    ],
)
def test_a_coefficient_is_a_fraction_times_a_power_of_dt(
    at: list[float], expected: tuple[int, Fraction] | None
) -> None:
    """By its values at 1/16, 1/32 and 1/8 s."""
    assert solved_form._term(np.array(at)) == expected


@pytest.mark.parametrize("at", [[0.0, 1e-3, 1.0], [1.0, 1e-3, 0.0], [1 / 16, 1 / 64, 1 / 8], [16.0, 32.0, 8.0]])
def test_what_is_no_power_of_dt_is_refused(at: list[float]) -> None:
    """Nothing at one step and something at another; two powers; one over dt."""
    with pytest.raises(NotLinear, match="no fraction times a power of dt"):
        solved_form._term(np.array(at))
