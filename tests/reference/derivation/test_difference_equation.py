"""What positions obey step after step under methods with a memory, against the textbooks' closed forms."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import in_this_process
from reference.derivation.consequences import FAR
from reference.derivation.difference_equation import DifferenceEquation, difference_equation
from reference.derivation.explanation import explain
from reference.derivation.formula import Number
from reference.derivation.oscillators import runs_of
from reference.errors import Unsupported
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import Scheme, find
from reference.schemes.structural import hht
from reference.state import State
from reference.stepper import SchemeStepper
from report.derived import sections

#: Coefficients of a polynomial, the highest power first: exact.
Polynomial = list[Fraction]

#: Generalised alpha as a user would write it, solved by iterating; rho = 0.8.
FILE = """
acc = None


def step(a, x, v, h):
    global acc
    am, af = 0.6 / 1.8, 0.8 / 1.8
    beta, gamma = (1 - am + af) ** 2 / 4, 0.5 - am + af
    old = a(x, v) if acc is None else acc
    new = old
    for _ in range(60):
        x1 = x + h * v + h * h * ((0.5 - beta) * old + beta * new)
        v1 = v + h * ((1 - gamma) * old + gamma * new)
        new = (a((1 - af) * x1 + af * x, (1 - af) * v1 + af * v) - am * old) / (1 - am)
    acc = new
    return x1, v1
"""


def of(scheme: Scheme) -> DifferenceEquation:
    """That of a scheme."""
    return difference_equation(runs_of(SchemeStepper(scheme)))


def by_stiffness(found: DifferenceEquation) -> tuple[list[Number], list[Number]]:
    """What stands beside nothing, and beside a."""
    one, a = (0, 0, 0, 0, 0), (1, 0, 0, 0, 0)
    constants, stiff = ([part.numerator.get(which, Fraction(0)) for part in found.parts] for which in (one, a))
    return constants, stiff


def times(one: Polynomial, other: Polynomial) -> Polynomial:
    """Of two polynomials."""
    return [sum((one[i] * other[n - i] for i in range(len(one)) if 0 <= n - i < len(other)), start=Fraction(0))
            for n in range(len(one) + len(other) - 1)]  # fmt: skip


@pytest.mark.parametrize("alpha", [Fraction(-1, 10), Fraction(-1, 4), Fraction(-1, 3)])
def test_hilber_hughes_and_taylors(alpha: Fraction) -> None:
    """x1 - 2 A1 x0 + A2 x-1 - A3 x-2 = 0 with their A1, A2 and A3, exactly (1977).

    D A1 = D - W [(1 + alpha)(gamma + 1/2) - alpha beta]/2, D A2 = D - W [gamma - 1/2 + 2 alpha (gamma - beta)],
    D A3 = alpha W (beta - gamma + 1/2), D = 1 + (1 + alpha) beta W, W = a. Of what is
    infinitely fast (1 + alpha)/(1 - alpha) is left.
    """
    found = of(find("hht").with_parameters(alpha=float(alpha)))
    beta, gamma = (1 - alpha) ** 2 / 4, Fraction(1, 2) - alpha
    d = (1 + alpha) * beta
    a1 = d - ((1 + alpha) * (gamma + Fraction(1, 2)) - alpha * beta) / 2
    a2 = d - (gamma - Fraction(1, 2) + 2 * alpha * (gamma - beta))
    a3 = alpha * (beta - gamma + Fraction(1, 2))
    assert by_stiffness(found) == ([1, -2, 1, 0], [d, -2 * a1, a2, -a3])
    assert found.of_fast == pytest.approx(float((1 + alpha) / (1 - alpha)), abs=1e-4)  # roots near one another
    assert (found.order, found.explicit, found.imaginary_axis) == (2, False, ((0.0, FAR),))


@pytest.mark.parametrize("radius", [Fraction(4, 5), Fraction(1, 2), Fraction(0)])
def test_chung_and_hulberts(radius: Fraction) -> None:
    """((1 - m) z + m)(z - 1)^2 + a ((1 - f) z + f)(beta z^2 + (gamma + 1/2 - 2 beta) z + 1/2 + beta - gamma) = 0.

    Exactly, over 1 - m, with m, f, beta and gamma of the radius (1993): their three equations, velocities and
    accelerations eliminated. Of what is infinitely fast the radius is left: three roots at one, which rounding moves by
    its third root.
    """
    found = of(find("generalised_alpha").with_parameters(radius=float(radius)))
    m, f = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    beta, gamma = (1 - m + f) ** 2 / 4, Fraction(1, 2) - m + f
    free = times([1 - m, m], [Fraction(1), Fraction(-2), Fraction(1)])
    sprung = times([1 - f, f], [beta, gamma + Fraction(1, 2) - 2 * beta, Fraction(1, 2) + beta - gamma])
    expected = [c / (1 - m) for c in free], [c / (1 - m) for c in sprung]
    seen = by_stiffness(found)
    back = len(seen[0])  # at radius 0 the last coefficients are 0
    assert seen == (expected[0][:back], expected[1][:back])
    assert not any(expected[0][back:] + expected[1][back:])
    assert found.of_fast == pytest.approx(float(radius), abs=1e-4)


def test_a_wrong_one_is_told_from_the_textbooks() -> None:
    """HHT that loses some velocity has another equation; one whose first step is another's has its own."""

    def begun_by_another(motion: MotionOfSprings, state: State, dt: float) -> State:
        return hht(motion, state, dt, alpha=-0.1) if state.memory else hht(motion, state, dt, alpha=-0.2)

    def losing(motion: MotionOfSprings, state: State, dt: float) -> State:
        end = hht(motion, state, dt)
        return replace(end, velocities=end.velocities * (1 - 0.1 * dt))

    begun = of(Scheme(begun_by_another, 2, implicit=True, one_step=False, linear=False))
    assert by_stiffness(begun) == by_stiffness(of(find("hht")))
    other = of(Scheme(losing, 2, implicit=True, one_step=False, linear=False))
    assert by_stiffness(other) != by_stiffness(of(find("hht")))


def test_limits_of_multistep_methods_are_the_textbooks() -> None:
    """Adams-Bashforth 2 to h c/m = 1 and nothing without damping (HNW V.1); Stormer's to h w = 2; BDF2 everywhere."""
    adams, verlet, bdf2 = (of(find(name)) for name in ("adams_bashforth_2", "stormer_verlet", "bdf2"))
    assert adams.real_axis is not None
    assert adams.real_axis[0][1] == pytest.approx(1.0, abs=1e-9)
    assert adams.imaginary_axis == ((0.0, 0.0),)
    assert verlet.text() == ["1", "-2 + a", "1"]
    assert verlet.imaginary_axis[0][1] == pytest.approx(2.0, abs=1e-9)
    assert (bdf2.imaginary_axis, bdf2.real_axis, bdf2.of_fast) == (((0.0, FAR),), ((0.0, FAR),), 0.0)


@pytest.mark.rotating(3)
def test_a_users_own_is_told_in_text_and_json(tmp_path: Path) -> None:
    """Generalised alpha, iterated."""
    path = tmp_path / "mine.py"
    path.write_text(FILE, encoding="utf-8")
    found = explain(OwnStepper(own_stepper(str(path)).engine, isolate=in_this_process))
    assert found.identification.identified_as == "generalised_alpha"
    assert found.document["difference_equation"][0] == "1 + 55 b/108 + 55 d/108 + 125 a/486"
    told = dict(sections(found))
    assert told["Derived: what an oscillator's positions obey, step after step"] == [
        "(1 + 55 g/108 + 125 a/486) x1 = (3/2 - 2 g/9 - 50 a/81) x0 + (17 g/36 - 40 a/81) x[-1] "
        "+ (-1/2 + 7 g/27 - 32 a/243) x[-2]",
        "with a = h^2 k/m, g = h (c + Cd)/m",
    ]
    assert "- What swings infinitely fast is multiplied by 0.8 in a step." in told["What follows"]


def test_what_follows_none_is_said_to() -> None:
    """A step whose stiffness depends on how often it was called."""

    def counting(motion: MotionOfSprings, state: State, dt: float) -> State:
        calls = state.memory[0] + 1 if state.memory else np.ones(1)
        return state.kick(dt * (1 + 0.1 * np.sin(calls)) * motion.acceleration(state)).drift(dt).remembering(calls)

    with pytest.raises(Unsupported, match="no linear equation"):
        of(Scheme(counting, 1, one_step=False))
