"""Steps made of equal ones are told so by their update formulas; methods of several steps, by how they begin."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import in_this_process
from reference.derivation.equal_parts import equal_parts, repeated
from reference.derivation.explanation import Explanation, explain
from reference.derivation.near import known_tableaux, known_updates, name_of_updates, parts_of
from reference.derivation.of_schemes import updates_of_scheme
from reference.derivation.updates import Coefficient, Symbol, Updates, updates_of
from reference.schemes.catalogue import find
from report.derived import matrix_lines, name_line

HALVES = """
def heun(f, y, t, h):
    k1 = f(y, t)
    return y + h / 2 * (k1 + f(y + h * k1, t + h))


def step(f, y, t, dt):
    return heun(f, heun(f, y, t, {first} * dt), t + {first} * dt, (1 - {first}) * dt)
"""

HALVES_OF_FORCES = """
def heun(x, v, h, system):
    a = system.acceleration(x, v)
    u = v + h * a
    return x + h / 2 * (v + u), v + h / 2 * (a + system.acceleration(x + h * v, u))


def step(x, v, dt, system):
    return heun(*heun(x, v, dt / 2, system), dt / 2, system)
"""

VERLET_THRICE = """
def step(a, x, v, dt):
    h, here = dt / 3, a(x)
    for _ in range(3):
        v = v + h / 2 * here
        x = x + h * v
        here = a(x)
        v = v + h / 2 * here
    return x, v
"""

WRONG_TWICE = """
def step(f, y, t, dt):
    for _ in range(2):
        k = f(y, t)
        y = y + dt / 2 * (2 * k + f(y + dt / 2 * k, t)) / 3
    return y
"""

ADAMS = """
old = None


def step(f, y, t, dt):
    global old
    here = f(y, t)
    new = y + dt * {begin} if old is None else y + dt * (3 * here - old) / 2
    old = here
    return new
"""

#: Kutta's third order, whose second slope is asked for twice.
HALFWAY = "f(y + dt / 2 * here, t + dt / 2)"
KUTTA = f"(here + 4 * {HALFWAY} + f(y - dt * here + 2 * dt * {HALFWAY}, t + dt)) / 6"

BDF2 = """
old = None


def step(f, y, t, dt):
    global old
    new = y
    for _ in range(80):
        new = y + dt * f((y + new) / 2) if old is None else (4 * y - old) / 3 + 2 / 3 * dt * f(new)
    old = y
    return new
"""


def explained(folder: Path, text: str) -> Explanation:
    """Of a file with that text."""
    (folder / "mine.py").write_text(text, encoding="utf-8")
    return explain(stepper(folder))


def stepper(folder: Path) -> OwnStepper:
    """The file that was written."""
    return OwnStepper(own_stepper(str(folder / "mine.py")).engine, isolate=in_this_process)


ONE_STEP = [name for name, updates in known_updates().items() if not updates.looks_back and not updates.reused]


@pytest.mark.parametrize("count", [2, 3])
def test_repeated_schemes_are_told_as_what_they_are(count: int) -> None:
    """Of every scheme of the catalogue that asks for accelerations: that many, or a multiple of it."""
    for name in ONE_STEP:
        whole = repeated(known_updates()[name], count)
        assert whole is not None
        found = equal_parts(whole, known_updates)
        assert found is not None, name
        assert found.count % count == 0, name
        if name in known_tableaux() and found.count == count:
            assert name_of_updates(found.one) == name


def test_no_scheme_is_several_of_another() -> None:
    """So none is told so that is not repeated: the check above could say it of anything."""
    assert [name for name, updates in known_updates().items() if equal_parts(updates, known_updates)] == []


def test_two_half_steps_of_heun(tmp_path: Path) -> None:
    """Named as that, with Heun's step matrix; order and limits are those of the whole step."""
    found = explained(tmp_path, HALVES.format(first=0.5))
    assert found.nearest == "its step is 2 sub-steps of heun, each of h/2"
    assert name_line(found).endswith("4 stages and order 2; its step is 2 sub-steps of heun, each of h/2")
    assert (found.document["substeps"], found.document["substep_scheme"]) == (2, "heun")
    assert matrix_lines(found)[0] == "x' = (1 - a/2) x + (1 - g/2) s v"
    assert matrix_lines(found)[-1].endswith("s = h/2: a step of h is 2 of these")
    assert found.limits[1] is not None
    assert found.limits[1][0][1] == pytest.approx(4, abs=1e-6)  # Heun alone: 2


def test_two_whole_steps_are_no_halves() -> None:
    """Euler's step twice, each of h: the mistake of Heun without its half, which is told as that."""
    one = updates_of_scheme(find("euler"))
    twice = repeated(replace(one, end=tuple({s: _doubled(s, c) for s, c in form.items()} for form in one.end)), 2)
    assert twice is not None
    assert [float(c.number) for s, c in twice.end[1].items() if s.kind == "q"] == [1.0, 1.0]
    assert equal_parts(twice, known_updates) is None


def _doubled(symbol: Symbol, c: Coefficient) -> Coefficient:
    return c._replace(number=2 * c.number) if symbol.kind in "pq" else c


def test_two_steps_of_other_lengths_are_no_halves(tmp_path: Path) -> None:
    """A quarter and three quarters of dt: four stages, and nothing is said of sub-steps."""
    (tmp_path / "mine.py").write_text(HALVES.format(first=0.25), encoding="utf-8")
    recording = stepper(tmp_path).recording()
    assert recording is not None
    assert parts_of(None, updates_of(recording)) is None


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HALVES_OF_FORCES, "its step is 2 sub-steps of heun, each of h/2"),
        (VERLET_THRICE, "without damping its step is 3 sub-steps of velocity_verlet, each of h/3"),
        (
            WRONG_TWICE,
            "its step is 2 equal sub-steps of h/2, in each of which b1 is 2/3 where heun has 1/2, "
            "b2 is 1/3 where heun has 1/2",
        ),
    ],
)
def test_other_forms_and_mistakes(text: str, words: str, tmp_path: Path) -> None:
    """Heun by forces; velocity Verlet whose last force is the next one's first; a step that is wrong, twice."""
    assert explained(tmp_path, text).nearest == words


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ADAMS.format(begin="here"), "adams_bashforth_2, begun with euler"),
        (ADAMS.format(begin=KUTTA), "adams_bashforth_2, begun with rk3"),
        (ADAMS.format(begin="(3 * here + f(y, t)) / 5"), "adams_bashforth_2, begun otherwise"),
        (ADAMS.format(begin="here").replace("(3 * here - old)", "(4 * here - 2 * old)"), ""),
        (BDF2, "bdf2, begun with implicit_midpoint"),
    ],
)
def test_methods_that_begin_otherwise_are_told(text: str, words: str, tmp_path: Path) -> None:
    """By their coefficients and by those of the first step; another method of two steps has no such name."""
    found = explained(tmp_path, text)
    assert found.identification.identified_as is None
    assert found.begun == words
    assert found.document["nearest"] == (words or None)
    assert (f"by its coefficients it is {words}" in name_line(found)) == bool(words)


@pytest.mark.rotating(4, in_turn=True)
def test_what_changes_with_dt_has_a_key_of_its_own(tmp_path: Path) -> None:
    """At which dt which rule was found, and where formulas were derived; of Heun alone there is nothing."""
    other = "    return y + dt * f(y, t) if dt < 1e-3 else heun(f, y, t, dt)"
    heun = HALVES.partition("    return heun(f, heun")[0] + other
    told = explained(tmp_path, heun).document["changes_with_dt"]
    assert {rule["dt_s"]: rule["identified_as"] for rule in told["rules"]}[2e-4] == "euler"
    assert {rule["dt_s"]: rule["identified_as"] for rule in told["rules"]}[2e-3] == "heun"
    assert (told["step_matrix_at_s"], told["slopes_at_s"]) == (1 / 16, [1 / 4, 1 / 8])
    same = heun.replace("if dt < 1e-3", "if dt < 0")
    assert explained(tmp_path, same).document["changes_with_dt"] is None


def test_formulas_of_one_part_are_in_its_own_h() -> None:
    """Two of kick-drift in a step: x' = x + h v + h^2 a1 of one; the whole has 1/2 and 1/4."""
    one = updates_of_scheme(find("kick_drift"))
    whole = repeated(one, 2)
    assert isinstance(whole, Updates)
    assert [float(c.number) for s, c in whole.end[0].items() if s.kind == "q"] == [0.5, 0.25]
    found = equal_parts(whole, known_updates)
    assert found is not None
    assert [float(c.number) for s, c in found.one.end[0].items() if s.kind == "q"] == [1.0]
